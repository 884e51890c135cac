// Displays whose modules' images go on beside their borders, so that what lies just outside can be drawn too.
#pragma once

#include "calibration/display.h"

namespace lfd {

// Guard bands have an even width: of every other pixel the same ones are looked at as without.
constexpr int even_guard_band_px(int asked_px) { return asked_px + asked_px % 2; }

// Refuses a band with which an image would be larger than images may be: "images of 8192x600 px become 8320x728 with a
// guard band of 64 px; at most 8192 px a side are possible".
Status check_guard_band(ImageSize image, int px);

// The same display with images that are larger by px on every side: what lay at pixel (u, v) lies at (u + px, v + px).
// Ideal maps become homographies. The screen grows with the image; where other maps reach further, up to twice as far,
// and at most to half of a cylinder. A measured grid has no map beside its nodes. Gain maps of colour stay those of the
// images without a band.
DisplayCalibration with_guard_band(const DisplayCalibration& display, int px);

}  // namespace lfd
