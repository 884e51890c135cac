// The reference's casting, against an independent intersection of every triangle and against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "bench/reference/scene_maker.h"
#include "proto/pictures/png.h"

namespace lfd::reference {
namespace {

class CasterOf : public testing::TestWithParam<Diffuser> {};
INSTANTIATE_TEST_SUITE_P(Diffusers, CasterOf, testing::Values(Diffuser::kLinear, Diffuser::kConical),
                         [](const auto& parameter) {
                           return parameter.param == Diffuser::kLinear ? "Linear" : "Conical";
                         });

// Every triangle, by solving for (z, barycentrics) as a linear system: another way than the caster's. Largest z wins.
std::optional<Point3<Physical>> brute_force(const WorldScene& scene, const ModuleView& view, PixelPoint pixel) {
  const auto line = pixel_line(view.display, view.module, pixel);
  const glm::dvec3 o = to_glm(line->on_screen), d = to_glm(line->on_observer_line - line->on_screen);
  const double singular = line->singular_depth;
  std::optional<Point3<Physical>> best;
  for (const Triangle& t : scene.triangle) {
    const glm::dvec3 a = to_glm(scene.corner(t, 0).physical), b = to_glm(scene.corner(t, 1).physical),
                     c = to_glm(scene.corner(t, 2).physical);
    const glm::dmat3 system(b - a, c - a, -d);
    const double determinant = glm::determinant(system);
    if (determinant == 0) continue;
    const glm::dvec3 solution = glm::inverse(system) * (o - a);
    if (solution.x < 0 || solution.y < 0 || solution.x + solution.y > 1) continue;
    const glm::dvec3 p = o + solution.z * d;
    const bool front = glm::dot(glm::cross(b - a, c - a), d) > 0;  // the line runs toward the viewer
    if (!front && !scene.material[t.material].double_sided) continue;
    if (p.z >= std::min(view.display.optics.observer_distance_m, view.limits.near_z_m)) continue;
    if (p.z <= std::max(singular, view.limits.far_z_m)) continue;
    if (!best || p.z > best->z) best = point_of<Physical>(p);
  }
  return best;
}

TEST_P(CasterOf, RandomTrianglesEqualBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> side(-1, 1);
  for (int round = 0; round < 4; ++round) {
    SceneMaker maker;
    const std::uint32_t one_sided = maker.add_material({}), two_sided = maker.add_material({.double_sided = true});
    std::vector<Corners> triangles[2];
    for (int i = 0; i < 60; ++i) {
      const glm::vec3 centre(0.8F * side(random), 0.5F * side(random), 1.6F * side(random));
      const float size = round < 2 ? 0.3F : 1.5F;  // some reach beyond the observer and behind the emitter
      Corners corners;
      for (glm::vec3& p : corners) p = centre + size * glm::vec3(side(random), side(random), side(random));
      triangles[i % 2].push_back(corners);
    }
    maker.add_triangles(triangles[0], one_sided);
    maker.add_triangles(triangles[1], two_sided);
    const WorldScene scene = scene_of(maker);
    const Intersector intersector(scene);
    const DisplayCalibration display = one_module(GetParam());
    const ModuleView view{display, display.modules[0], {0.9 * 3.0, -1.2}};
    const HitImage image = cast_module(intersector, view);
    int surfaces = 0;
    for (int row = 0; row < image.size.height; ++row) {
      for (int column = 0; column < image.size.width; ++column) {
        const auto expected = brute_force(scene, view, centre_of({column, row}));
        const auto& hit = image.at({column, row});
        ASSERT_EQ(hit.has_value(), expected.has_value()) << column << ", " << row;
        if (!hit) continue;
        ++surfaces;
        // 1e-11: rounding of some metres, at triangles down to a thousandth of their size thick as seen.
        EXPECT_LT(length(hit->physical - *expected), 1e-11) << column << ", " << row;
        EXPECT_LT(length(hit->physical - scene.physical_from_world * hit->world), 1e-11);
      }
    }
    EXPECT_GT(surfaces, image.size.width * image.size.height / 4) << "the scene must be worth looking at";
  }
}

TEST_P(CasterOf, HitsLieOnThePixelsOwnLine) {
  SceneMaker maker;
  maker.add_mesh(sphere({0, 0, 0.1F}, 0.3F, 40), maker.add_material({}));
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(GetParam(), {128, 96});
  const HitImage image = cast_module(intersector, {display, display.modules[0], {}});
  int surfaces = 0;
  for (int row = 0; row < 96; ++row) {
    for (int column = 0; column < 128; ++column) {
      const auto& hit = image.at({column, row});
      if (!hit) continue;
      ++surfaces;
      const auto back = image_from_physical(display, display.modules[0], hit->physical);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->u, column + 0.5, 1e-9);
      EXPECT_NEAR(back->v, row + 0.5, 1e-9);
      // A chord of 40 rings sags by 0.3 (1 - cos(pi / 80)) in each of two directions at most.
      EXPECT_NEAR(length(hit->physical - Point3<Physical>{0, 0, 0.1}), 0.3, 0.3 * 2 * (1 - std::cos(M_PI / 80)));
      EXPECT_GT(hit->physical.z, 0.1 - 0.3) << "the side toward the viewer";
      EXPECT_GT(dot(hit->shading_normal, hit->geometric_normal), 0.99);
    }
  }
  EXPECT_GT(surfaces, 1000);
}

TEST_P(CasterOf, APlaneIsHitWhereTheForwardMapSays) {
  // World z = 0.2 is physical z = 0.5 x 0.2 + 0.05 = 0.15 under a region of interest that stretches each axis
  // differently.
  RegionOfInterest roi;
  roi.world_size = {2, 3, 4};
  roi.physical_size = {1, 1, 2};
  roi.physical_centre = {0, 0, 0.05};
  SceneMaker maker;
  maker.add_quad({-9, -9, 0.2F}, {9, -9, 0.2F}, {9, 9, 0.2F}, {-9, 9, 0.2F}, maker.add_material({}));
  const WorldScene scene = scene_of(maker, roi);
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(GetParam());
  for (const PixelPoint pixel : {PixelPoint{0.5, 0.5}, PixelPoint{40.25, 11.75}, PixelPoint{63.9, 47.9}}) {
    const auto hit = cast_point(intersector, {display, display.modules[0], {}}, pixel);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->physical.z, 0.5 * static_cast<double>(0.2F) + 0.05, 1e-14);
    EXPECT_NEAR(hit->world.z, static_cast<double>(0.2F), 1e-14);
    const auto back = image_from_physical(display, display.modules[0], hit->physical);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->u, pixel.x, 1e-10);
    EXPECT_NEAR(back->v, pixel.y, 1e-10);
    EXPECT_NEAR(hit->geometric_normal.z, 1, 1e-15);
  }
}

TEST_P(CasterOf, TheFrontOfTwoPlanesAMillionthApartIsChosenEverywhere) {
  // Float32 cannot tell z = 0.3 from 0.3 + 3e-8 m; the far one is added first, so that order does not help.
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({});
  const float far_z = 0.3F, near_z = std::nextafter(far_z, 1.0F);
  maker.add_quad({-2, -2, far_z}, {2, -2, far_z}, {2, 2, far_z}, {-2, 2, far_z}, material);
  maker.add_quad({-2, -2, near_z}, {2, -2, near_z}, {2, 2, near_z}, {-2, 2, near_z}, material);
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(GetParam());
  const HitImage image = cast_module(intersector, {display, display.modules[0], {}});
  for (const auto& hit : image.hit) {
    ASSERT_TRUE(hit);
    EXPECT_EQ(scene.triangle[hit->triangle].instance, 1U);
  }
}

TEST_P(CasterOf, FineMeshesHaveNoCracks) {
  // A sheet of 2 x 200 x 200 triangles with wavy depth covers the whole image: no line may slip between neighbours.
  MeshArrays mesh;
  const int n = 200;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const float x = 3.2F * (static_cast<float>(j) / n - 0.5F), y = 2.0F * (static_cast<float>(i) / n - 0.5F);
      mesh.position.emplace_back(x, y, 0.05F * std::sin(9 * x) * std::cos(7 * y));
      mesh.normal.emplace_back(0, 0, 1);
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.index.insert(mesh.index.end(), {a, b, d, a, d, c});
    }
  }
  SceneMaker maker;
  maker.add_mesh(mesh, maker.add_material({}));
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(GetParam(), {400, 300});
  const HitImage image = cast_module(intersector, {display, display.modules[0], {}});
  EXPECT_THAT(image.hit, testing::Each(testing::Ne(std::nullopt)));
}

TEST(Caster, BackFacesAreSeenOnlyOnDoubleSidedSurfaces) {
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  for (const bool double_sided : {false, true}) {
    SceneMaker maker;
    maker.add_quad({-2, 2, 0}, {2, 2, 0}, {2, -2, 0}, {-2, -2, 0}, maker.add_material({.double_sided = double_sided}));
    const WorldScene scene = scene_of(maker);
    const Intersector intersector(scene);
    const auto hit = cast_point(intersector, {display, display.modules[0], {}}, {20.5, 20.5});
    ASSERT_EQ(hit.has_value(), double_sided);
    if (!hit) continue;
    EXPECT_EQ(hit->geometric_normal.z, -1) << "normals belong to the front, which is turned away";
  }
}

TEST(Caster, FacingIsDecidedByThePixelsOwnLine) {
  // The plane x = -0.2 shows the side that looks left; an emitter to its left sees it, one to its right sees its back.
  SceneMaker maker;
  maker.add_quad({-0.2F, -1, -0.5F}, {-0.2F, -1, 0.5F}, {-0.2F, 1, 0.5F}, {-0.2F, 1, -0.5F}, maker.add_material({}));
  const WorldScene scene = scene_of(maker);
  ASSERT_EQ(to_glm(scene.vertex[0].normal), glm::dvec3(-1, 0, 0));
  const Intersector intersector(scene);
  DisplayCalibration display = one_module(Diffuser::kLinear);
  for (const double side : {-1.0, 1.0}) {
    display.modules[0].emitter.x = -0.2 + side;
    int surfaces = 0;
    for (const auto& hit : cast_module(intersector, {display, display.modules[0], {}}).hit) surfaces += hit.has_value();
    // A pixel's line leaves the screen away from the emitter: those of one on the right run to the left, to whom the
    // plane turns.
    EXPECT_EQ(surfaces > 0, side > 0) << surfaces;
  }
}

TEST(Caster, MirroredInstancesKeepTheirFront) {
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  SceneMaker maker;
  MeshArrays mesh = SceneMaker::mesh_of({{{{-2, -2, 0}, {2, -2, 0}, {0, 4, 0}}}});
  std::swap(mesh.index[1], mesh.index[2]);  // as scene.proto asks of a mesh that is placed mirrored
  maker.add_mesh(mesh, maker.add_material({}), {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const auto hit = cast_point(intersector, {display, display.modules[0], {}}, {32, 24});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->geometric_normal.z, 1);
  EXPECT_EQ(hit->shading_normal.z, 1);
}

TEST(Caster, LimitsCutGeometry) {
  const DisplayCalibration display = one_module(Diffuser::kConical);
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({});
  for (const float z : {1.0F, 0.2F, -0.6F}) maker.add_quad({-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}, material);
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const auto z_within = [&](ZLimits limits) -> std::optional<double> {
    const auto hit = cast_point(intersector, {display, display.modules[0], limits}, {30.5, 17.5});
    if (!hit) return std::nullopt;
    return std::round(hit->physical.z * 1e6) / 1e6;
  };
  EXPECT_EQ(z_within({}), 1.0);
  EXPECT_EQ(z_within({0.9, -1}), 0.2);
  EXPECT_EQ(z_within({0.1, -1}), -0.6);
  EXPECT_EQ(z_within({0.1, -0.5}), std::nullopt);
  EXPECT_EQ(z_within({-1, -0.5}), std::nullopt) << "no room between the limits";
}

TEST(Caster, MaskedTexelsAreSeenThrough) {
  // The left half of the picture is transparent, the right half opaque; the cutoff falls on the middle.
  SceneMaker maker;
  const std::uint32_t material = maker.add_material({.alpha_cutoff = 0.5F});
  proto::Texture& texture = *maker.data().scene.mutable_material(0)->mutable_texture();
  proto::Picture picture;
  picture.set_file(*encode_png({2, 1, {255, 255, 255, 0, 255, 255, 255, 255}}));
  texture.set_picture("picture");
  texture.set_wrap_s(proto::Texture::CLAMP_TO_EDGE);
  maker.data().assets["picture"] = std::make_shared<const std::string>(picture.SerializeAsString());
  maker.add_quad({-0.8F, -1, 0}, {0.8F, -1, 0}, {0.8F, 1, 0}, {-0.8F, 1, 0}, material);
  const WorldScene scene = scene_of(maker, same_spaces());
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  const ModuleView view{display, display.modules[0], {}};
  EXPECT_FALSE(cast_point(intersector, view, {31.9, 20.5}));
  EXPECT_TRUE(cast_point(intersector, view, {32.1, 20.5}));
}

TEST(WorldScene, BrokenScenesAreRefusedByName) {
  const auto message_of = [](SceneMaker& maker) {
    const auto scene = world_scene(maker.data(), same_spaces());
    return scene ? std::string("accepted") : scene.error().message();
  };
  SceneMaker no_mesh;
  no_mesh.add_triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}, no_mesh.add_material({}));
  no_mesh.data().assets.clear();
  EXPECT_THAT(message_of(no_mesh),
              testing::AllOf(testing::StartsWith("instance 0: mesh "), testing::EndsWith(" is missing")));
  SceneMaker no_material;
  no_material.add_triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}, 3);
  EXPECT_EQ(message_of(no_material), "instance 0: material 3 of 0");
  SceneMaker no_matrix;
  no_matrix.add_triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}, no_matrix.add_material({}));
  no_matrix.data().scene.mutable_instance(0)->clear_world_from_mesh();
  EXPECT_EQ(message_of(no_matrix), "instance 0: world_from_mesh: 0 numbers, 12 are needed");
}

TEST(Caster, AnEmptySceneShowsNothing) {
  SceneMaker maker;
  const WorldScene scene = scene_of(maker);
  const Intersector intersector(scene);
  const DisplayCalibration display = one_module(Diffuser::kLinear);
  EXPECT_THAT(cast_module(intersector, {display, display.modules[0], {}}).hit,
              testing::Each(testing::Eq(std::nullopt)));
}

}  // namespace
}  // namespace lfd::reference
