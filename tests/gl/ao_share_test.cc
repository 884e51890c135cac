// What neighbouring modules share: the mean of what they found on the same surface, beside its twin in double
// precision; nothing of other surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/log.h"
#include "bench/reference/scene_maker.h"
#include "calibration/make.h"
#include "rendernode/passes/gpu_sharing.h"
#include "tests/gl/ao_scenes.h"
#include "tests/gl/ao_share_stage.h"
#include "tests/gl/compute.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::ball_before_floor;
using testing_support::LayerPicture;
using testing_support::SharingStage;

DisplayCalibration display_of(int modules, ImageSize image = {96, 72}) {
  auto made = make_display("640rc", modules);
  LFD_CHECK(made, made.error().message());
  made->image = image;
  return *made;
}

proto::AmbientOcclusion march(double radius_m, int directions, int neighbours) {
  proto::AmbientOcclusion ao;
  ao.set_method("march");
  ao.set_radius_m(radius_m);
  ao.set_samples(directions);
  ao.mutable_shared()->set_neighbours(neighbours);
  return ao;
}

glm::dvec3 three(const glm::vec4& v) { return {v.x, v.y, v.z}; }

// The neighbourhood of one pixel in double precision, from what its module and the others found for themselves.
class Twin {
 public:
  Twin(const SharingStage& stage, const std::vector<LayerPicture>& alone, int each_side)
      : stage_(stage), alone_(alone), each_side_(each_side) {}

  // Absent where a decision lies within roundings of its threshold.
  std::optional<double> shared(std::size_t layer, PixelIndex at) const {
    const LayerPicture& own = alone_[layer];
    const std::size_t i = number(at);
    double sum = own.ao[i], count = 1;
    for (std::size_t other = 0; other < alone_.size(); ++other) {
      if (other == layer || alone_[other].ao.empty() || steps_between(layer, other) > each_side_) continue;
      const auto found = seen_by(other, layer, at);
      if (!found) return std::nullopt;
      if (*found < 0) continue;
      sum += *found;
      ++count;
    }
    return sum / count;
  }

 private:
  std::size_t number(PixelIndex at) const {
    return static_cast<std::size_t>(at.row) * stage_.display().image.width + at.column;
  }

  // Emitters of the node from one to the other.
  int steps_between(std::size_t a, std::size_t b) const {
    const double x = stage_.module(a).emitter.x, y = stage_.module(b).emitter.x;
    int steps = 0;
    for (std::size_t i = 0; i < alone_.size(); ++i) {
      const double between = stage_.module(i).emitter.x;
      steps += between > std::min(x, y) && between <= std::max(x, y) ? 1 : 0;
    }
    return steps;
  }

  // -1: the neighbour does not show the same surface; absent: too near to a threshold.
  std::optional<double> seen_by(std::size_t other, std::size_t layer, PixelIndex at) const {
    const auto near = [](double value, double threshold, double roundings) {
      return std::abs(value - threshold) < roundings;
    };
    constexpr double kPixel = 0.01;
    const std::size_t i = number(at);
    const glm::dvec3 p = three(alone_[layer].position[i]), n = glm::normalize(three(alone_[layer].normal[i]));
    const Point3<World> world{p.x + stage_.roi().world_centre.x, p.y + stage_.roi().world_centre.y,
                              p.z + stage_.roi().world_centre.z};
    const auto q =
        image_from_physical(stage_.display(), stage_.module(other), physical_from_world(stage_.roi()) * world);
    if (!q) return -1;
    const double from_border =
        std::min({q->u, q->v, stage_.display().image.width - q->u, stage_.display().image.height - q->v});
    if (from_border < kPixel || near(q->u, std::round(q->u), kPixel) || near(q->v, std::round(q->v), kPixel))
      return std::nullopt;
    const std::size_t there = number({static_cast<int>(q->u), static_cast<int>(q->v)});
    if (alone_[other].position[there].w == 0) return -1;
    const glm::dvec3 v = three(alone_[other].position[there]) - p;
    const double pixel_m = pixel_size(layer, at, p);
    const double off = std::abs(glm::dot(v, n)) / pixel_m, apart = glm::length(v) / pixel_m;
    const double alike = glm::dot(n, three(alone_[other].normal[there]));
    if (near(off, 1, 0.02) || near(apart, 8, 0.1) || near(alike, 0.9, 0.003)) return std::nullopt;
    return off < 1 && apart < 8 && alike > 0.9 ? static_cast<double>(alone_[other].ao[there]) : -1;
  }

  // From the lines of the neighbouring pixels, where they have the point's depth; these displays' worlds are scaled
  // alike in all directions.
  double pixel_size(std::size_t layer, PixelIndex at, glm::dvec3 p) const {
    const Point3<Physical> physical =
        physical_from_world(stage_.roi()) * (stage_.roi().world_centre + Vector3<World>{p.x, p.y, p.z});
    const auto point = [&](double column, double row) {
      const auto line = pixel_line(stage_.display(), stage_.module(layer), {column, row});
      LFD_CHECK(line.has_value(), "it has a surface");
      const double t = physical.z / stage_.display().optics.observer_distance_m;
      return line->on_screen + t * (line->on_observer_line - line->on_screen);
    };
    const double u = at.column + 0.5, v = at.row + 0.5, du = at.column > 0 ? -0.5 : 0.5, dv = at.row > 0 ? -0.5 : 0.5;
    const double wide = 2 * length(point(u + du, v) - point(u, v)), high = 2 * length(point(u, v + dv) - point(u, v));
    return std::sqrt(wide * high) * stage_.roi().world_size.x / stage_.roi().physical_size.x;
  }

  const SharingStage& stage_;
  const std::vector<LayerPicture>& alone_;
  int each_side_;
};

// A ball in a wall that the modules at the right see almost from its edge: the pixel that shows one of its points shows
// others far away.
SceneData ball_in_grazed_wall() {
  SceneMaker maker;
  const auto white = maker.add_material({true});
  maker.add_mesh(reference::sphere({0.1F, 0, 0.1F}, 0.25F, 16), white);
  maker.add_quad({-0.1F, -0.4F, 0.4F}, {-0.1F, 0.4F, 0.4F}, {0.1F, 0.4F, -0.4F}, {0.1F, -0.4F, -0.4F}, white);
  return maker.data();
}

struct Case {
  const char* name;
  DisplayCalibration display;
  std::vector<std::uint32_t> modules;
  int each_side;
  bool aside = false;  // the scene is so far to the right that some modules do not see it
  const char* method = "march";
  bool half = false;
  SceneData scene = ball_before_floor();
};

std::vector<Case> cases() {
  DisplayCalibration conical = display_of(5);
  conical.optics = {Diffuser::kConical, 0.1, 3.0};
  const DisplayCalibration lenses = perturbed(display_of(5), 3);
  const auto grids = measured(display_of(5), 33, 25, 2, 4), bent = curved(display_of(5), 8, true);
  LFD_CHECK(grids && bent, "displays that can be made");
  return {{"lenses", lenses, {0, 1, 2, 3, 4}, 2},
          {"measured maps", *grids, {0, 1, 2, 3, 4}, 2},
          {"curved screen", *bent, {0, 1, 2, 3, 4}, 2},
          {"all, first and last among them", display_of(12), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 4},
          {"fewer than asked for", display_of(12), {4, 5, 6}, 8},
          {"not consecutive, not sorted", display_of(12), {9, 0, 4, 6, 3}, 1},
          {"a method with neither samples nor directions of its own", display_of(12), {3, 4, 5, 6}, 2, false, "gtao"},
          {"conical", conical, {0, 1, 2, 3, 4}, 2},
          {"half resolution", display_of(12), {3, 4, 5, 6}, 2, false, "march", true},
          {"grazed", display_of(64), {40, 41, 42, 43, 44}, 2, false, "march", false, ball_in_grazed_wall()},
          {"modules that see nothing", display_of(12), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 3, true}};
}

TEST(AoShare, IsTheMeanOfNeighboursOnTheSameSurface) {
  for (const Case& one : cases()) {
    RegionOfInterest roi;
    roi.world_centre = {0.02, -0.01, 0.03};
    if (one.aside) {
      roi.physical_size *= 0.4;
      roi.physical_centre = {1.0, 0.1, 1.2};
    }
    SharingStage stage(one.scene, roi, one.display, one.modules);
    auto ao = march(0.15, one.method == std::string("march") ? 4 : 0, one.each_side);
    ao.set_method(one.method);
    ao.set_half_resolution(one.half);
    const auto alone = stage.draw(ao, false), together = stage.draw(ao, true);
    std::size_t surfaces = 0, judged = 0, moved = 0, empty = 0;
    const int width = one.display.image.width;
    for (std::size_t layer = 0; layer < alone.size(); ++layer) {
      empty += alone[layer].ao.empty() ? 1 : 0;
      const Twin twin(stage, alone, one.each_side);
      for (std::size_t i = 0; i < alone[layer].ao.size(); ++i) {
        ASSERT_EQ(alone[layer].ao[i] < 0, together[layer].ao[i] < 0) << one.name;
        if (alone[layer].ao[i] < 0) continue;
        ++surfaces;
        const auto expected = twin.shared(layer, {static_cast<int>(i) % width, static_cast<int>(i) / width});
        if (!expected) continue;
        ++judged;
        // A half float, which GL may round either way: 2^-11 below 1.
        ASSERT_NEAR(together[layer].ao[i], *expected, 1.0 / 2048 + 1e-5)
            << one.name << ", layer " << layer << ", pixel " << i;
        moved += std::abs(alone[layer].ao[i] - *expected) > 0.01 ? 1 : 0;
      }
    }
    EXPECT_EQ(empty > 0, one.aside) << one.name;
    EXPECT_GT(judged, surfaces / 2) << one.name << ": a few thresholds in a hundred for each of up to eight neighbours";
    EXPECT_GT(moved, surfaces / 50) << one.name << ": sharing does something";
  }
}

// A plate floats before a wall, nearer than the radius: the wall beside it is occluded, the plate wholly open.
TEST(AoShare, NothingBleedsAcrossASilhouette) {
  SceneMaker maker;
  const auto plain = maker.add_material({});
  maker.add_quad({-1.2F, -1, 0}, {1.2F, -1, 0}, {1.2F, 1, 0}, {-1.2F, 1, 0}, plain);
  maker.add_quad({-0.3F, -0.2F, 0.05F}, {0.3F, -0.2F, 0.05F}, {0.3F, 0.2F, 0.05F}, {-0.3F, 0.2F, 0.05F}, plain);
  std::vector<std::uint32_t> modules{0, 1, 2, 3, 4, 5, 6, 7, 8};
  SharingStage stage(maker.data(), {}, display_of(9), modules);
  const auto pictures = stage.draw(march(0.2, 8, 4), true);
  double darkest_wall = 0;
  std::size_t on_plate = 0;
  for (const LayerPicture& picture : pictures) {
    for (std::size_t i = 0; i < picture.ao.size(); ++i) {
      if (picture.ao[i] < 0) continue;
      if (picture.position[i].z < 0.04F) {
        darkest_wall = std::max(darkest_wall, static_cast<double>(picture.ao[i]));
      } else {
        ++on_plate;
        ASSERT_EQ(picture.ao[i], 0) << "pixel " << i;
      }
    }
  }
  EXPECT_GT(on_plate, 1000U);
  EXPECT_GT(darkest_wall, 0.1);
}

// The numbers that a world point gets do not know where the region of interest is, and run over 8 to 16 pixels.
TEST(AoShare, NoiseSticksToTheWorld) {
  const DisplayCalibration display = display_of(1, {1024, 768});
  const auto points = testing_support::random_points(500, {-0.4F, -0.4F, -0.4F}, {0.4F, 0.4F, 0.4F}, 3);
  const auto noise_of = [&](const glm::dvec3& centre, const glm::dvec3& world) {
    RegionOfInterest roi;
    roi.world_centre = {world.x + centre.x, world.y + centre.y, world.z + centre.z};
    const glm::vec4 origin = noise_origin(roi, display);
    std::vector<glm::vec4> from_centre;
    for (const glm::vec4& p : points) from_centre.emplace_back(glm::dvec3(p) - centre, 0);
    return testing_support::compute(
        "#include \"shared/module_params.glsl\"\n#include \"shared/frame_params.glsl\"\n#include \"lib/optics.glsl\"\n"
        "#include \"lib/surface_noise.glsl\"",
        fmt::format("vec4 origin = vec4({:.9g}, {:.9g}, {:.9g}, {:.1f});"
                    "b[0] = vec4(surface_noise(a.xyz, origin, 0.0015), 0.0);"
                    "b[1] = vec4(surface_noise(a.xyz + vec3(0.0075, 0.0, 0.0), origin, 0.0015), 0.0);",
                    origin.x, origin.y, origin.z, origin.w),
        from_centre, 2);
  };
  const glm::dvec3 far_away(1e6 + 0.123, -3e5, 7.5);
  for (const glm::dvec3& world : {glm::dvec3(0), far_away}) {
    const auto here = noise_of({0, 0, 0}, world);
    double spread = 0;
    for (const glm::dvec3& centre : {glm::dvec3(0.01, 0, 0), glm::dvec3(-0.3, 0.2, 0.7)}) {
      const auto moved = noise_of(centre, world);
      ASSERT_EQ(here.size(), moved.size());
      for (std::size_t i = 0; i < here.size(); i += 2) {
        for (int c = 0; c < 3; ++c) {
          const double off = std::abs(here[i][c] - moved[i][c]);
          // Floats of a metre, a few roundings of 6e-8, over runs of 0.0156 m.
          ASSERT_LT(std::min(off, 1 - off), 5e-5);
          spread += std::abs(here[i][c] - 0.5) / (3.0 * static_cast<double>(here.size()));
          const double step = std::abs(here[i + 1][c] - here[i][c]);
          const double turned = std::min(step, 1 - step);
          // Five pixels along x turn by 5 / 8 at most; that, or its complement, times the axis's cosine to x.
          const double cosine[] = {0.573137855449, 0.740348840461, 0.351278512124};
          const double whole = 0.0075 / 0.015625 * cosine[c];
          ASSERT_NEAR(turned, std::min(whole, 1 - whole), 5e-5);
        }
      }
    }
    EXPECT_NEAR(spread, 0.25, 0.02) << "all numbers come up alike";
  }
}

}  // namespace
}  // namespace lfd
