// Rendering, casting, comparing.
#include "tests/gl/truth_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "bench/reference/silhouette.h"
#include "bench/reference/truth.h"
#include "proto/pictures/png.h"
#include "tests/support/rendering.h"

namespace lfd::testing_support {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

Rgb color_of(bool is_drawn, const std::optional<reference::Hit>& hit, bool near_silhouette, double error) {
  if (hit.has_value() != is_drawn) return is_drawn ? Rgb{60, 60, 255} : Rgb{255, 40, 40};
  if (!hit) return {0, 0, 0};
  if (near_silhouette) return {60, 60, 60};
  const double share = std::clamp((std::log10(std::max(error, 1e-30)) + 7) / 4, 0.0, 1.0);
  const auto byte = static_cast<std::uint8_t>(std::lround(255 * share));
  return {byte, static_cast<std::uint8_t>(90 + 165 * byte / 255), byte};
}

Picture8 difference_picture(const reference::HitImage& hits, const std::vector<std::uint8_t>& near_silhouette,
                            const PictureF& rendered, Point3<World> origin, double diagonal_m) {
  Picture8 picture = black_picture(rendered.width, rendered.height);
  for (std::size_t i = 0; i < hits.hit.size(); ++i) {
    const float* p = &rendered.rgba[4 * i];
    const auto& hit = hits.hit[i];
    const double error = hit ? length(origin + Vector3<World>{p[0], p[1], p[2]} - hit->world) / diagonal_m : 0;
    const Rgb rgb = color_of(p[3] > 0.5F, hit, near_silhouette[i] != 0, error);
    std::copy(rgb.begin(), rgb.end(), &picture.rgba[4 * i]);
    picture.rgba[4 * i + 3] = 255;
  }
  return picture;
}

void print(const std::string& name, const reference::Truth& truth) {
  const std::size_t in_any = truth.in_both + truth.only_in_reference + truth.only_in_rendered;
  fmt::print(
      "{}: {} of {} compared; median {:.1e}, 99 % {:.1e}, max {:.1e} at ({}, {}); {} only in the reference, {} only "
      "rendered: {:.4f} %\n",
      name, truth.compared, in_any, truth.median, truth.percent_99, truth.max, truth.worst.column, truth.worst.row,
      truth.only_in_reference, truth.only_in_rendered, 100 * truth.mismatch_share);
}

}  // namespace

void expect_true(const TruthCase& test_case) {
  const DisplayCalibration& display = test_case.display;
  Renderer renderer(context(), display, test_case.modules);
  proto::RenderSettings settings;
  settings.mutable_ao()->set_enabled(false);
  const auto result = draw_once(renderer, state_of(test_case.data, test_case.roi, settings), test_case.data.assets,
                                {buffers({proto::POSITION})});
  const auto scene = reference::world_scene(test_case.data, test_case.roi);
  ASSERT_TRUE(scene) << scene.error().message();
  const reference::Intersector intersector(*scene);
  const DepthLimits limits = depth_limits(display, {});
  for (const auto module : test_case.modules) {
    const std::string name = fmt::format("{}, module {}", test_case.name, module);
    const ModuleImage* image = find_image(result, module, proto::POSITION);
    ASSERT_NE(image, nullptr) << name;
    const PictureF rendered{display.image.width, display.image.height, floats_of(*image)};
    const reference::ModuleView view{display, display.modules[module], {limits.front, limits.back}};
    const auto hits = reference::cast_module(intersector, view);
    const auto near_silhouette = reference::near_silhouette(intersector, view, hits);
    const double diagonal_m = test_case.roi.diagonal_m();
    const auto truth = reference::compare(hits, near_silhouette, rendered, result.position_origin, diagonal_m);
    print(name, truth);
    EXPECT_GT(truth.compared, 0U) << name;
    auto broken = reference::broken_bounds(truth);
    for (const std::string& line : bench::missed_bounds(truth, test_case.way)) broken.push_back(line);
    if (broken.empty()) continue;
    const auto path = std::filesystem::path(LFD_BIN_DIR) / ".." / fmt::format("difference of {}.png", name);
    const Status written =
        write_png(path, difference_picture(hits, near_silhouette, rendered, result.position_origin, diagonal_m));
    ADD_FAILURE() << name << ": " << testing::PrintToString(broken) << "\n"
                  << (written ? "see " + path.string() : written.error().message());
  }
}

}  // namespace lfd::testing_support
