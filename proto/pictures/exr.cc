// OpenEXR over bytes in memory; its exceptions end here.
#include "proto/pictures/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "base/file.h"
#include "base/log.h"
#include "proto/pictures/exr_header.h"

namespace lfd {
namespace {

using ChannelNames = std::array<std::string, 4>;

const ChannelNames kChannels = {"R", "G", "B", "A"};
constexpr int kMostSide = 1 << 20;

class MemoryOut : public Imf::OStream {
 public:
  MemoryOut() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    if (at_ + count > content_.size()) content_.resize(at_ + count);
    std::memcpy(content_.data() + at_, bytes, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = to; }
  std::string take() { return std::move(content_); }

 private:
  std::string content_;
  std::size_t at_ = 0;
};

class MemoryIn : public Imf::IStream {
 public:
  explicit MemoryIn(std::string_view content) : Imf::IStream("memory"), content_(content) {}
  bool read(char bytes[], int count) override {
    if (count < 0 || at_ > content_.size() || static_cast<std::size_t>(count) > content_.size() - at_) {
      throw std::runtime_error("the file ends too early");
    }
    std::memcpy(bytes, content_.data() + at_, count);
    at_ += count;
    return at_ < content_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override { at_ = to; }
  void clear() override {}

 private:
  std::string_view content_;
  std::uint64_t at_ = 0;
};

// Slices of an interleaved picture whose first pixel is (x, y) of the data window.
Imf::FrameBuffer slices(const ChannelNames& names, float* rgba, int width, int x, int y) {
  Imf::FrameBuffer buffer;
  const std::size_t pixel = 4 * sizeof(float), row = pixel * width;
  for (std::size_t channel = 0; channel < names.size(); ++channel) {
    if (names[channel].empty()) continue;
    char* base = reinterpret_cast<char*>(rgba + channel) - static_cast<std::ptrdiff_t>(pixel) * x -
                 static_cast<std::ptrdiff_t>(row) * y;
    buffer.insert(names[channel], Imf::Slice(Imf::FLOAT, base, pixel, row));
  }
  return buffer;
}

// The file's header has been checked.
Result<PictureF> read(Imf::InputFile& file, const ChannelNames& names) {
  const auto& window = file.header().dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    const Imf::Channel* channel = file.header().channels().findChannel(name);
    if (channel == nullptr) return Error(fmt::format("EXR: no channel {}", name));
    if (channel->xSampling != 1 || channel->ySampling != 1)
      return Error(fmt::format("EXR: channel {} is subsampled", name));
  }
  PictureF picture{static_cast<int>(width), static_cast<int>(height),
                   std::vector<float>(std::size_t{4} * width * height)};
  file.setFrameBuffer(slices(names, picture.rgba.data(), picture.width, window.min.x, window.min.y));
  file.readPixels(window.min.y, window.max.y);
  return picture;
}

}  // namespace

Result<std::string> encode_exr(const PictureF& picture) {
  LFD_CHECK(picture.width > 0 && picture.height > 0, "an empty picture");
  LFD_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height, "a picture of the wrong size");
  try {
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& name : kChannels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    MemoryOut out;
    {
      Imf::OutputFile file(out, header);
      // OpenEXR only reads through this pointer.
      file.setFrameBuffer(slices(kChannels, const_cast<float*>(picture.rgba.data()), picture.width, 0, 0));
      file.writePixels(picture.height);
    }
    return out.take();
  } catch (const std::exception& error) {
    return Error(fmt::format("EXR: {}", error.what()));
  }
}

Result<PictureF> decode_exr_channels(std::string_view content, const ChannelNames& names, int most_side) {
  LFD_TRY_STATUS(check_exr_header(content, most_side));
  try {
    MemoryIn in(content);
    Imf::InputFile file(in);
    return read(file, names);
  } catch (const std::exception& error) {
    return Error(fmt::format("EXR: {}", error.what()));
  }
}

Result<PictureF> decode_exr(std::string_view content) { return decode_exr_channels(content, kChannels, kMostSide); }

Result<std::vector<std::string>> exr_channels(std::string_view content, int most_side) {
  LFD_TRY_STATUS(check_exr_header(content, most_side));
  try {
    MemoryIn in(content);
    const Imf::InputFile file(in);
    std::vector<std::string> names;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) names.emplace_back(channel.name());
    return names;
  } catch (const std::exception& error) {
    return Error(fmt::format("EXR: {}", error.what()));
  }
}

Status write_exr(const std::filesystem::path& path, const PictureF& picture) {
  const auto file = encode_exr(picture);
  if (!file) return file.error().within(path.string());
  return write_file(path, *file);
}

Result<PictureF> read_exr(const std::filesystem::path& path) {
  LFD_TRY(const std::string file, read_file(path));
  auto picture = decode_exr(file);
  if (!picture) return picture.error().within(path.string());
  return picture;
}

}  // namespace lfd
