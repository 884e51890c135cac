// Read-back pixels in the form in which buffers leave the node.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "calibration/spaces/roi.h"
#include "proto/settings.h"
#include "proto/wire.pb.h"

namespace lfd {

struct PackInputs {
  const RegionOfInterest& roi;
  const AoSettings& ao;
  bool ao_pass = true;  // whether AO pixels are hidden shares (one float), or positions of a frame without that pass
  bool bent = false;    // whether BENT_NORMAL pixels lie in g, b and a of those hidden shares, or are normals
};

// COLOR: RGBA8, alpha set to 255. POSITION: counted from position_origin instead of the ROI centre. AO: after the
// curve, alpha 1 where there is a surface. DEPTH: physical z of the stored position, alpha likewise. BENT_NORMAL:
// likewise. Others as they are; RGBA float32.
std::shared_ptr<const std::string> pack_image(proto::BufferKind kind, std::span<const std::byte> pixels,
                                              const PackInputs& inputs);

}  // namespace lfd
