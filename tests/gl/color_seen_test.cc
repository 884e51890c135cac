// End to end: a display whose modules all differ in colour looks like one whose modules do not.
#include <gtest/gtest.h>

#include <cmath>

#include "base/log.h"
#include "base/srgb.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "controller/scene/made/made_scenes.h"
#include "display/viewer.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using namespace testing_support;

DisplayCalibration plain_display() {
  DisplayCalibration display = perturbed(*make_display("desk"), 2);
  display.image = {128, 96};
  return display;
}

std::vector<Picture8> rendered(const SceneData& data, const DisplayCalibration& display) {
  const auto &low = data.scene.bounds_low(), &high = data.scene.bounds_high();
  const auto roi = fit_to_screen({low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}, display.screen.width_m,
                                 display.screen.height_m);
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  settings.mutable_background()->set_b(0.2F);
  Renderer renderer(context(), display, {0, 1, 2, 3, 4, 5, 6, 7});
  const auto result = draw_once(renderer, state_of(data, roi, settings), data.assets, {});
  std::vector<Picture8> pictures;
  for (std::uint32_t k = 0; k < 8; ++k) {
    pictures.push_back(black_picture(display.image.width, display.image.height));
    const ModuleImage* image = find_image(result, k, proto::COLOR);
    LFD_CHECK(image != nullptr && !image->empty, "every module sees the scene");
    pictures.back().rgba.assign(image->bytes->begin(), image->bytes->end());
  }
  return pictures;
}

Picture8 seen(const DisplayCalibration& display, const std::vector<Picture8>& images) {
  std::vector<const Picture8*> pointers;
  for (const auto& image : images) pointers.push_back(&image);
  auto picture = display::viewer_picture(display, pointers, {0.06, 0.03, 0.8}, 160, 120);
  LFD_CHECK(picture, picture.error().message());
  return *std::move(picture);
}

struct Difference {
  double worst = 0, mean = 0;  // of linear light
};

Difference between(const Picture8& a, const Picture8& b) {
  Difference difference;
  for (std::size_t at = 0; at < a.rgba.size(); ++at) {
    const double d = std::abs(linear_from_srgb(a.rgba[at] / 255.0) - linear_from_srgb(b.rgba[at] / 255.0));
    difference.worst = std::max(difference.worst, d);
    difference.mean += d / (0.75 * static_cast<double>(a.rgba.size()));
  }
  return difference;
}

TEST(ColorSeen, ModulesOfDifferentColoursLookLikeOnesThatAreAlike) {
  const DisplayCalibration plain = plain_display(), display = colored(plain, 21);
  // Of linear light, where it is brightest: half a byte of sRGB is 2.4 / 1.055 / 510 = 0.0045, in the plain module
  // images (GL may be off by 0.6 levels: 0.0054) and in both pictures; half a byte of drive at gamma 2.4 is 2.4 / 510,
  // of which the inverse matrix makes 1.19 times at most and a gain of 0.8 1.25 times: 0.0070.
  constexpr double kQuantisation = 0.0054 + 2 * 0.0045 + 0.0070;
  for (const char* name : {"room", "depth-steps"}) {
    auto made = scene::make_scene(name, 1);
    ASSERT_TRUE(made) << made.error().message();
    const auto plain_images = rendered(made->data, plain), images = rendered(made->data, display);
    const Picture8 expected = seen(plain, plain_images);
    const Difference found = between(seen(display, images), expected);
    fmt::print("{}: worst {:.4f}, mean {:.5f} of full light\n", name, found.worst, found.mean);
    EXPECT_LE(found.worst, kQuantisation);
    // The check is sharp: a viewer who took the drives for sRGB would see something else.
    EXPECT_GT(between(seen(plain, images), expected).worst, 4 * kQuantisation);
  }
}

}  // namespace
}  // namespace lfd
