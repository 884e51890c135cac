// Looking through buffers.
#include "bench/stability/frame_fault.h"

#include <cmath>

#include "bench/common/frame_picture.h"

namespace lfd::bench {

std::string fault_of(const FrameResult& frame) {
  for (const ModuleImage& image : frame.images) {
    if (image.kind == proto::COLOR) continue;  // bytes
    for (const float value : picture_of(image).rgba) {
      if (!std::isfinite(value)) return proto::BufferKind_Name(image.kind) + " has a number that is not finite";
    }
  }
  return "";
}

}  // namespace lfd::bench
