// End to end: what a viewer sees through the modules against an ordinary perspective picture through the screen as a
// window.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/log.h"
#include "bench/reference/perspective.h"
#include "bench/reference/psnr.h"
#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "display/viewer.h"
#include "proto/pictures/png.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::state_of;

constexpr ScreenSize kScreen{0.4, 0.3};
constexpr double kObserver_m = 0.8;
constexpr int kWidth_px = 256, kHeight_px = 192;
// On the observer line; from each of them every point of the screen is in the field of the emitters.
constexpr std::array<double, 3> kEyes{-0.12, 0.0, 0.15};

// Emitters at equal pitch over 80 degrees; those of the conical display stand below the screen's centre.
DisplayCalibration display_of(int modules, Diffuser diffuser) {
  DisplayCalibration display{"test", kScreen, {kWidth_px, kHeight_px}, {diffuser, 0, kObserver_m}, 0, {}};
  const double distance = 0.6, half = distance * std::tan(40 * std::numbers::pi / 180);
  const double height = diffuser == Diffuser::kConical ? -0.15 : 0;
  for (int k = 0; k < modules; ++k) {
    display.modules.push_back({{half * (2.0 * k / (modules - 1) - 1), height, -distance}, IdealMap{}});
  }
  display.angular_scattering_rad = scattering_by_rule_rad(display.modules);
  return display;
}

// World and physical space are the same.
SceneData made(const char* name) {
  auto scene = scene::make_scene(name, 1, {kScreen.width_m, kScreen.height_m});
  LFD_CHECK(scene, scene.error().message());
  return std::move(scene->data);
}

std::vector<Picture8> rendered(const SceneData& data, const DisplayCalibration& display) {
  std::vector<std::uint32_t> modules(display.modules.size());
  for (std::uint32_t k = 0; k < modules.size(); ++k) modules[k] = k;
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  settings.set_unlit(true);
  Renderer renderer(context(), display, modules);
  const auto result = draw_once(renderer, state_of(data, RegionOfInterest{}, settings), data.assets, {});
  std::vector<Picture8> pictures;
  for (const auto k : modules) {
    pictures.push_back(black_picture(kWidth_px, kHeight_px));
    const ModuleImage* image = find_image(result, k, proto::COLOR);
    if (image != nullptr && !image->empty) pictures.back().rgba.assign(image->bytes->begin(), image->bytes->end());
  }
  return pictures;
}

// Pictures of the scene that viewers at (x, 0, on the observer line) should see, one for each of kEyes.
std::vector<Picture8> aimed_at(const SceneData& data) {
  const auto scene = reference::world_scene(data, RegionOfInterest{});
  LFD_CHECK(scene, scene.error().message());
  const reference::Intersector intersector(*scene);
  const reference::PerspectiveSettings settings{.size = {kWidth_px, kHeight_px}, .samples_per_side = 4};
  std::vector<Picture8> pictures;
  for (const double x : kEyes)
    pictures.push_back(reference::perspective(intersector, kScreen, {x, 0, kObserver_m}, settings).encoded);
  return pictures;
}

Picture8 seen(const DisplayCalibration& display, const std::vector<Picture8>& images, double x) {
  std::vector<const Picture8*> pointers;
  for (const auto& image : images) pointers.push_back(&image);
  auto picture = display::viewer_picture(display, pointers, {x, 0, kObserver_m}, kWidth_px, kHeight_px);
  LFD_CHECK(picture, picture.error().message());
  return *std::move(picture);
}

// Written only where a test fails, to look at.
void keep(const std::string& name, const Picture8& picture) {
  const Status written =
      write_png(std::filesystem::path(LFD_BIN_DIR) / ".." / ("end to end, " + name + ".png"), picture);
  EXPECT_TRUE(written) << written.error().message();
}

class EndToEnd : public testing::TestWithParam<Diffuser> {
 protected:
  static const char* name() { return GetParam() == Diffuser::kLinear ? "linear" : "conical"; }
};
INSTANTIATE_TEST_SUITE_P(Diffusers, EndToEnd, testing::Values(Diffuser::kLinear, Diffuser::kConical),
                         [](const auto& d) { return d.param == Diffuser::kLinear ? "linear" : "conical"; });

// All modules show the same there: their number does not matter.
TEST_P(EndToEnd, APictureOnTheScreenIsSeenAsItIs) {
  const SceneData data = made("quad");
  const auto expected = aimed_at(data);
  for (const int modules : {2, 3, 8, 15, 31, 61}) {
    const DisplayCalibration display = display_of(modules, GetParam());
    const auto images = rendered(data, display);
    for (std::size_t i = 0; i < kEyes.size(); ++i) {
      const Picture8 found = seen(display, images, kEyes[i]);
      const double db = reference::psnr_db(found, expected[i]);
      fmt::print("quad, {}, {} modules, eye {}: {:.2f} dB\n", name(), modules, kEyes[i], db);
      EXPECT_GE(db, 40);
      if (db >= 40) continue;
      keep(fmt::format("quad, {}, {} modules, eye {}, seen", name(), modules, kEyes[i]), found);
      keep(fmt::format("quad, {}, {} modules, eye {}, expected", name(), modules, kEyes[i]), expected[i]);
    }
  }
}

// Less of each other's neighbours is blended into what a viewer sees at depth.
TEST_P(EndToEnd, MoreModulesShowDepthBetter) {
  const SceneData data = made("depth-steps");
  const auto expected = aimed_at(data);
  std::vector<double> last(kEyes.size(), 0);
  for (const int modules : {15, 31, 61}) {
    const DisplayCalibration display = display_of(modules, GetParam());
    const auto images = rendered(data, display);
    for (std::size_t i = 0; i < kEyes.size(); ++i) {
      const Picture8 found = seen(display, images, kEyes[i]);
      const double db = reference::psnr_db(found, expected[i]);
      fmt::print("depth steps, {}, {} modules, eye {}: {:.2f} dB\n", name(), modules, kEyes[i], db);
      EXPECT_GT(db, last[i]);
      if (!(db > last[i])) {
        keep(fmt::format("depth steps, {}, {} modules, eye {}, seen", name(), modules, kEyes[i]), found);
        keep(fmt::format("depth steps, {}, {} modules, eye {}, expected", name(), modules, kEyes[i]), expected[i]);
      }
      last[i] = db;
    }
  }
}

// The check is sharp: it notices modules in the wrong places.
TEST_P(EndToEnd, ModulesInWrongPlacesCostThreeDecibels) {
  const SceneData data = made("depth-steps");
  const auto expected = aimed_at(data);
  const DisplayCalibration display = display_of(61, GetParam());
  const auto images = rendered(data, display);
  std::vector<Picture8> reversed(images.rbegin(), images.rend()), shifted = images;
  std::rotate(shifted.begin(), shifted.begin() + 1, shifted.end());
  for (std::size_t i = 0; i < kEyes.size(); ++i) {
    const double x = kEyes[i];
    const double right = reference::psnr_db(seen(display, images, x), expected[i]);
    const double turned = reference::psnr_db(seen(display, reversed, x), expected[i]);
    const double moved = reference::psnr_db(seen(display, shifted, x), expected[i]);
    fmt::print("depth steps, {}, 61 modules, eye {}: {:.2f} dB; reversed {:.2f}, shifted by one {:.2f}\n", name(), x,
               right, turned, moved);
    EXPECT_LE(turned, right - 3);
    EXPECT_LE(moved, right - 3);
  }
}

}  // namespace
}  // namespace lfd
