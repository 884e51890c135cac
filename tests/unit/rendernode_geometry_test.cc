// Triangles as they are drawn: cut within the limits, on their planes, without cracks between neighbours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "bench/reference/scene_maker.h"
#include "proto/mesh_arrays.h"
#include "rendernode/geometry/physical_geometry.h"
#include "tests/unit/rendernode_displays.h"

namespace lfd {
namespace {

using reference::SceneMaker;
using testing_support::kDiffusers;
using testing_support::kMapKinds;
using testing_support::Random;
using testing_support::random_display;
using testing_support::uniform;

constexpr int kRows = 7;

// A closed surface (a crumpled torus) that reaches far beyond both limits in z: every edge belongs to two triangles.
MeshArrays crumpled_torus(Random& random) {
  MeshArrays mesh;
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kRows; ++j) {
      const double theta = 2 * M_PI * i / kRows, phi = 2 * M_PI * j / kRows, r = 0.6 + 0.35 * std::cos(phi);
      const glm::dvec3 p(r * std::cos(theta) * 0.8, 0.4 * std::sin(phi), 3 * r * std::sin(theta));
      const glm::dvec3 off(uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05), uniform(random, -0.2, 0.2));
      mesh.position.emplace_back(p + off);
      mesh.normal.emplace_back(0, 0, 1);
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>((i % kRows) * kRows + j % kRows); };
  for (int i = 0; i < kRows; ++i) {
    for (int j = 0; j < kRows; ++j) {
      mesh.index.insert(mesh.index.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.index.insert(mesh.index.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

struct Built {
  DepthLimits limits;
  PhysicalGeometry geometry;
};

template <class Visit>
void for_random_surfaces(Visit visit) {
  Random random(3);
  for (const auto diffuser : kDiffusers) {
    for (const auto kind : kMapKinds) {
      const DisplayCalibration display = random_display(diffuser, kind, random);
      SceneMaker maker;
      maker.add_mesh(crumpled_torus(random), maker.add_material({}));
      const DepthLimits limits = depth_limits(display, {});
      const WarpTables tables = warp_tables(display, {0, 1, 2});
      const EdgeRule rule(display, {0, 1, 2}, tables, limits, 0.1);
      MeshCache cache;
      const auto geometry =
          build_geometry(maker.data().scene, maker.data().assets, cache, reference::same_spaces(), limits, rule);
      ASSERT_TRUE(geometry) << geometry.error().message();
      EXPECT_GT(geometry->cut_triangles, 0U);
      EXPECT_GT(geometry->planes.size(), 2U * geometry->source_triangles);
      const auto too_many = build_geometry(maker.data().scene, maker.data().assets, cache, reference::same_spaces(),
                                           limits, rule, geometry->planes.size() - 1);
      ASSERT_FALSE(too_many);
      EXPECT_THAT(too_many.error().message(), testing::StartsWith("instance 0: more than "));
      visit(Built{limits, *geometry});
    }
  }
}

using Place = std::array<float, 3>;

Place place_of(const PhysicalGeometry& geometry, std::size_t index) {
  const float* p = geometry.vertices[geometry.indices[index]].position;
  return {p[0], p[1], p[2]};
}

// Of a closed surface only cuts leave edges without a twin; split points of neighbours are the same to the last bit.
TEST(RendernodeGeometry, NeighboursMeetWithoutCracks) {
  for_random_surfaces([](const Built& built) {
    std::map<std::pair<Place, Place>, int> uses;
    for (std::size_t t = 0; t < built.geometry.planes.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Place a = place_of(built.geometry, 3 * t + i), b = place_of(built.geometry, 3 * t + (i + 1) % 3);
        if (a == b) continue;  // closed up by rounding to single precision
        uses[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    const auto front = static_cast<float>(built.limits.front), back = static_cast<float>(built.limits.back);
    for (const auto& [edge, balance] : uses) {
      if (balance == 0) continue;
      const float z0 = edge.first[2], z1 = edge.second[2];
      EXPECT_TRUE((z0 == front && z1 == front) || (z0 == back && z1 == back))
          << "an edge without its twin at z " << z0 << ", " << z1;
    }
  });
}

TEST(RendernodeGeometry, LiesWithinTheLimits) {
  for_random_surfaces([](const Built& built) {
    for (const auto& vertex : built.geometry.vertices) {
      EXPECT_GE(vertex.position[2], static_cast<float>(built.limits.back));
      EXPECT_LE(vertex.position[2], static_cast<float>(built.limits.front));
    }
  });
}

// Corners, normals and offsets are rounded to single precision (6e-8) at sizes of up to 3 m.
TEST(RendernodeGeometry, EveryCornerLiesOnItsPlane) {
  for_random_surfaces([](const Built& built) {
    for (std::size_t i = 0; i < built.geometry.indices.size(); ++i) {
      const Place p = place_of(built.geometry, i);
      const auto& plane = built.geometry.planes[i / 3];
      const double beside =
          static_cast<double>(plane.normal_offset.x) * p[0] + static_cast<double>(plane.normal_offset.y) * p[1] +
          static_cast<double>(plane.normal_offset.z) * p[2] - static_cast<double>(plane.normal_offset.w);
      EXPECT_NEAR(beside, 0, 1e-6);
      // Ranges of z are those of the scene's triangles, before they were cut.
      EXPECT_GE(p[2], plane.range.x);
      EXPECT_LE(p[2], plane.range.y);
    }
  });
}

}  // namespace
}  // namespace lfd
