// Copies of bytes.
#include "bench/common/frame_picture.h"

#include <algorithm>
#include <cstring>

#include "base/check.h"

namespace lfd::bench {

PictureF picture_of(const ModuleImage& image) {
  LFD_CHECK(image.kind != proto::COLOR, "colour has bytes, not floats");
  PictureF picture{image.size.width, image.size.height, {}};
  picture.rgba.resize(static_cast<std::size_t>(image.size.width) * image.size.height * 4);
  if (image.empty) return picture;
  LFD_CHECK(image.bytes->size() == picture.rgba.size() * sizeof(float), "four floats a pixel");
  std::memcpy(picture.rgba.data(), image.bytes->data(), image.bytes->size());
  return picture;
}

const ModuleImage& image_of(const FrameResult& frame, proto::BufferKind kind) {
  const auto image = std::ranges::find(frame.images, kind, &ModuleImage::kind);
  LFD_CHECK(image != frame.images.end(), "every buffer that was asked for");
  return *image;
}

PictureF picture_of(const FrameResult& frame, proto::BufferKind kind) { return picture_of(image_of(frame, kind)); }

}  // namespace lfd::bench
