// Triangles without area, too small, too large, and through every limit, in pictures.
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "base/log.h"
#include "bench/reference/scene_maker.h"
#include "bench/stability/drawing.h"
#include "bench/stability/groups.h"
#include "proto/mesh_arrays.h"

namespace lfd::bench {
namespace {

constexpr const char* kGroup = "pictures of triangles";

using reference::Corners;

// Triangles before a wall, in a region of interest that is the same in the world and in physical space.
Drawing before_wall(const DisplayCalibration& display, std::vector<Corners> triangles) {
  const RegionOfInterest roi = small_roi();
  reference::SceneMaker maker;
  const auto plain = maker.add_material({.double_sided = true});
  triangles.push_back({{{-0.3F, -0.3F, -0.13F}, {0.3F, -0.3F, -0.13F}, {0, 0.6F, -0.13F}}});
  MeshArrays mesh = reference::SceneMaker::mesh_of(triangles);
  // Normals of triangles without an area are anything of unit length.
  for (glm::vec3& normal : mesh.normal) {
    if (!(std::abs(glm::length(normal) - 1) < 1e-3)) normal = {0, 0, 1};
  }
  maker.add_mesh(mesh, plain);
  return {display, maker.data(), roi, {}};
}

// Many triangles of one size about the screen, each with its own place and turn.
std::vector<Corners> scattered(float size_m) {
  std::vector<Corners> triangles;
  for (int i = 0; i < 60; ++i) {
    const float a = 0.7F * static_cast<float>(i), x = 0.15F * std::cos(2 * a), y = 0.1F * std::sin(3 * a);
    const glm::vec3 at(x, y, 0.1F * std::sin(a));
    triangles.push_back({at, at + size_m * glm::vec3(std::cos(a), std::sin(a), 0),
                         at + size_m * glm::vec3(-std::sin(a), std::cos(a), 0.3F)});
  }
  return triangles;
}

// About the origin, where floats are dense enough for triangles of any size.
std::vector<Corners> at_origin(float size_m) {
  return {{{{0, 0, 0}, {size_m, 0, 0}, {0, size_m, 0}}}, {{{0, 0, 0}, {-size_m, 0, size_m}, {0, -size_m, -size_m}}}};
}

std::vector<Corners> degenerate() {
  const glm::vec3 a(-0.1F, 0, 0.05F), b(0.1F, 0.05F, 0.05F);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  return {{a, a, a},
          {a, b, a},
          {a, b, 0.5F * (a + b)},
          {a, b, glm::vec3(nan, 0, 0)},
          {a, b, glm::vec3(0, infinity, 0)},
          {a, b, glm::vec3(0, 0, -infinity)}};
}

// From border to border of the screen, `width_m` thin.
std::vector<Corners> needles(float width_m) {
  std::vector<Corners> triangles;
  for (int i = 0; i < 20; ++i) {
    const float y = -0.12F + 0.012F * static_cast<float>(i);
    triangles.push_back({glm::vec3{-0.25F, y, -0.1F}, {0.25F, 0.5F * y, 0.1F}, {0.25F, 0.5F * y + width_m, 0.1F}});
  }
  return triangles;
}

// Walls of `size_m`, one before the other on the left: parallel to the screen, and slanted about the vertical.
std::vector<Corners> giants(float size_m) {
  return {{{{-size_m, -size_m, -0.1F}, {size_m, -size_m, -0.1F}, {0, size_m, -0.1F}}},
          {{{-size_m, -size_m, 0.05F}, {0, -size_m, 0.05F}, {0, size_m, 0.05F}}}};
}

// A floor and a side wall from `from_z` to `to_z`.
std::vector<Corners> along_z(float from_z, float to_z) {
  return {{{{-1, -0.11F, to_z}, {1, -0.11F, to_z}, {1, -0.11F, from_z}}},
          {{{-1, -0.11F, to_z}, {1, -0.11F, from_z}, {-1, -0.11F, from_z}}},
          {{{0.15F, -1, from_z}, {0.15F, -1, to_z}, {0.15F, 1, to_z}}},
          {{{0.15F, -1, from_z}, {0.15F, 1, to_z}, {0.15F, 1, from_z}}}};
}

// A rasteriser's corners lie on 1/256 of a pixel: either edge of a needle may be off by half of that, and takes or
// leaves the pixels whose centre it passes, one of 512 in each of the columns that the needle crosses.
PictureBounds thin_bounds() {
  constexpr double kNeedles = 20, kColumns = 128, kEdges = 2, kShare = 1.0 / 512;
  PictureBounds bounds;
  bounds.percent_999 = bounds.max = 1;
  bounds.most_far_off = static_cast<std::size_t>(3 * kNeedles * kColumns * kEdges * kShare);
  bounds.why =
      "a needle thinner than a pixel is seen or missed where its edge is rounded to 1/256 px: 3 times the "
      "number to be expected";
  return bounds;
}

using Triangles = std::function<std::vector<Corners>()>;

StabilityCase picture(std::string name, Triangles triangles, Diffuser diffuser = Diffuser::kLinear) {
  return drawn_true(kGroup, std::move(name), [triangles = std::move(triangles), diffuser] {
    return before_wall(small_display(diffuser), triangles());
  });
}

// The same, judged by triangles of a common size that show the same.
StabilityCase picture_like(std::string name, Triangles triangles, Triangles seen,
                           Diffuser diffuser = Diffuser::kLinear) {
  return drawn_true(kGroup, std::move(name), [triangles = std::move(triangles), seen = std::move(seen), diffuser] {
    Drawing drawing = before_wall(small_display(diffuser), triangles());
    drawing.seen = before_wall(small_display(diffuser), seen()).data;
    return drawing;
  });
}

// The sphere in the box with other numbers at its vertices. What the loader of files mends, a node may still be sent.
SceneData with_arrays(const std::function<void(MeshArrays&)>& change) {
  SceneData data = sphere_in_box(small_roi());
  SceneData changed;
  for (proto::Instance instance : data.scene.instance()) {
    auto arrays = mesh_arrays(*data.assets.at(instance.mesh()));
    LFD_CHECK(arrays, arrays.error().message());
    change(*arrays);
    const auto bytes = std::make_shared<const std::string>(mesh_message(*arrays).SerializeAsString());
    instance.set_mesh(content_hash(*bytes));
    changed.assets[instance.mesh()] = bytes;
    *changed.scene.add_instance() = instance;
  }
  *changed.scene.mutable_material() = data.scene.material();
  return changed;
}

SceneData with_normals(const std::function<glm::vec3(std::size_t)>& normal_of) {
  return with_arrays([&](MeshArrays& arrays) {
    for (std::size_t i = 0; i < arrays.normal.size(); ++i) arrays.normal[i] = normal_of(i);
  });
}

// Texture coordinates change nothing where there is no texture; colours that are no numbers show some colour.
void add_uvs_and_colors(StabilityCases& cases) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e38F, 1e38F, 1e-44F}) {
    cases.push_back(drawn_true(kGroup, fmt::format("with texture coordinates of {:g}", bad), [bad] {
      const auto change = [bad](MeshArrays& arrays) { arrays.uv.assign(arrays.position.size(), {bad, 0.5F}); };
      return Drawing{small_display(), with_arrays(change), small_roi(), {}};
    }));
    cases.push_back(drawn_finite(kGroup, fmt::format("with vertex colours of {:g}", bad), [bad] {
      const auto change = [bad](MeshArrays& arrays) { arrays.color.assign(arrays.position.size(), {bad, 1, 1, 1}); };
      return Drawing{small_display(), with_arrays(change), small_roi(), {}};
    }));
  }
}

void add_normals(StabilityCases& cases) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
  const std::pair<const char*, std::function<glm::vec3(std::size_t)>> normals[] = {
      {"not a number", [](std::size_t) { return glm::vec3(0, kNaN, 1); }},
      {"infinite", [](std::size_t) { return glm::vec3(0, 0, kInfinity); }},
      {"zero", [](std::size_t) { return glm::vec3(0); }},
      {"of 1e-44", [](std::size_t) { return glm::vec3(0, 1e-44F, 0); }},
      {"of 1e38", [](std::size_t) { return glm::vec3(1e38F, 1e38F, 0); }},
      // Half-way between such neighbours they cancel.
      {"opposite to their neighbours'", [](std::size_t i) { return glm::vec3(0, 0, i % 2 == 0 ? 1 : -1); }},
  };
  for (const auto& [name, normal_of] : normals) {
    cases.push_back(drawn_true(kGroup, fmt::format("with normals {}", name), [normal_of = normal_of] {
      return Drawing{small_display(), with_normals(normal_of), small_roi(), {}};
    }));
  }
}

void add_limits(StabilityCases& cases) {
  for (const Diffuser diffuser : {Diffuser::kLinear, Diffuser::kConical}) {
    const std::string plane = diffuser == Diffuser::kLinear ? "emitter plane" : "z_c";
    const std::string of = diffuser == Diffuser::kLinear ? "linear: " : "conical: ";
    cases.push_back(picture(
        of + "through the " + plane, [] { return along_z(-5, 0.2F); }, diffuser));
    cases.push_back(picture(
        of + "through the observer line", [] { return along_z(-0.1F, 5); }, diffuser));
    cases.push_back(picture(
        of + "through both", [] { return along_z(-5, 5); }, diffuser));
    cases.push_back(picture_like(
        of + "through both, from and to 1e6 m", [] { return along_z(-1e6F, 1e6F); }, [] { return along_z(-5, 5); },
        diffuser));
    cases.push_back(picture_like(
        of + "through both, from and to 1e20 m", [] { return along_z(-1e20F, 1e20F); }, [] { return along_z(-5, 5); },
        diffuser));
  }
  cases.push_back(drawn_true(kGroup, "curved: of 1e20 m", [] {
    DisplayCalibration display = small_display();
    display.optics.screen_radius_m = 1;
    Drawing drawing = before_wall(display, giants(1e20F));
    drawing.seen = before_wall(display, giants(20)).data;
    return drawing;
  }));
  cases.push_back(drawn_true(kGroup, "curved: through the emitter and the observers", [] {
    DisplayCalibration display = small_display();
    display.optics.screen_radius_m = 1;
    return before_wall(display, along_z(-5, 5));
  }));
}

}  // namespace

void add_triangle_cases(StabilityCases& cases) {
  cases.push_back(picture_like("without an area, not finite", degenerate, [] { return std::vector<Corners>(); }));
  for (const float size_m : {1e-20F, 1e-30F, 1e-38F, 1e-44F}) {
    cases.push_back(picture(fmt::format("of {:g} m", size_m), [size_m] { return at_origin(size_m); }));
  }
  for (const float size_m : {1e-9F, 1e-6F, 1e-4F, 1e-2F}) {
    cases.push_back(picture(fmt::format("of {:g} m", size_m), [size_m] { return scattered(size_m); }));
  }
  for (const float width_m : {1e-9F, 1e-6F, 1e-4F, 3e-3F}) {
    const bool is_thin = width_m < 1e-3F;
    cases.push_back(drawn_true(
        kGroup, fmt::format("needles of {:g} m", width_m),
        [width_m] { return before_wall(small_display(), needles(width_m)); },
        is_thin ? thin_bounds() : PictureBounds{}));
  }
  for (const float size_m : {1e2F, 1e6F, 1e10F, 1e20F, 3e38F}) {
    cases.push_back(picture_like(
        fmt::format("of {:g} m", size_m), [size_m] { return giants(size_m); }, [] { return giants(20); }));
  }
  add_normals(cases);
  add_uvs_and_colors(cases);
  add_limits(cases);
}

}  // namespace lfd::bench
