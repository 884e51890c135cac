// The verdict on rendered positions: exact pictures pass, known errors are found as they are, wrong pictures fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bench/reference/scene_maker.h"
#include "bench/reference/silhouette.h"
#include "bench/reference/truth.h"

namespace lfd::reference {
namespace {

constexpr ImageSize kSize{160, 120};

// A picture that holds exactly what the hits say, relative to `origin`.
PictureF picture_of(const HitImage& image, Point3<World> origin = {}) {
  PictureF picture{image.size.width, image.size.height, std::vector<float>(4 * image.hit.size())};
  for (std::size_t i = 0; i < image.hit.size(); ++i) {
    if (!image.hit[i]) continue;
    const Vector3<World> p = image.hit[i]->world - origin;
    float* to = &picture.rgba[4 * i];
    to[0] = static_cast<float>(p.x);
    to[1] = static_cast<float>(p.y);
    to[2] = static_cast<float>(p.z);
    to[3] = 1;
  }
  return picture;
}

// A sphere before a slanted wall that covers most of the image.
class TruthOfAScene : public testing::Test {
 protected:
  static SceneMaker made() {
    SceneMaker maker;
    const std::uint32_t material = maker.add_material({});
    maker.add_mesh(sphere({0.1F, 0, 0.1F}, 0.25F, 40), material);
    maker.add_quad({-0.6F, -2, -0.1F}, {5, -2, -0.5F}, {5, 2, -0.5F}, {-0.6F, 2, -0.1F}, material);
    return maker;
  }

  Truth truth_of(const PictureF& rendered, Point3<World> origin = {}) const {
    return compare(image_, near_, rendered, origin, kDiagonal_m);
  }

  static constexpr double kDiagonal_m = 2;
  WorldScene scene_ = scene_of(made());
  Intersector intersector_{scene_};
  DisplayCalibration display_ = one_module(Diffuser::kConical, kSize);
  ModuleView view_{display_, display_.modules[0], {}};
  HitImage image_ = cast_module(intersector_, view_);
  std::vector<std::uint8_t> near_ = near_silhouette(intersector_, view_, image_);
};

TEST_F(TruthOfAScene, AnExactPictureKeepsAllBounds) {
  const Truth truth = truth_of(picture_of(image_));
  EXPECT_THAT(broken_bounds(truth), testing::IsEmpty());
  EXPECT_LT(truth.max, 1e-7) << "float32 of metres";
  EXPECT_GT(truth.compared, image_.hit.size() / 2);
  EXPECT_GT(truth.near_silhouette, 100U);
  EXPECT_EQ(truth.in_both, truth.compared + truth.near_silhouette);
  EXPECT_EQ(truth.mismatch_share, 0);
}

TEST_F(TruthOfAScene, PositionsAreRelativeToTheirOrigin) {
  const Point3<World> origin{0.25, -8, 3};
  EXPECT_THAT(broken_bounds(truth_of(picture_of(image_, origin), origin)), testing::IsEmpty());
  EXPECT_THAT(broken_bounds(truth_of(picture_of(image_, origin))), testing::Not(testing::IsEmpty()));
}

TEST_F(TruthOfAScene, SurfacesInOnlyOneAreCountedWhereverTheyLie) {
  PictureF rendered = picture_of(image_);
  std::size_t removed = 0, added = 0;
  for (std::size_t i = 0; i < image_.hit.size(); ++i) {
    if (image_.hit[i] && i % 101 == 0) {
      rendered.rgba[4 * i + 3] = 0;
      ++removed;
    } else if (!image_.hit[i] && i % 7 == 0) {
      rendered.rgba[4 * i + 3] = 1;
      ++added;
    }
  }
  ASSERT_GT(added, 10U);
  const Truth truth = truth_of(rendered);
  EXPECT_EQ(truth.only_in_reference, removed);
  EXPECT_EQ(truth.only_in_rendered, added);
  EXPECT_DOUBLE_EQ(truth.mismatch_share,
                   static_cast<double>(removed + added) / static_cast<double>(truth.in_both + removed + added));
  EXPECT_THAT(broken_bounds(truth), testing::ElementsAre(testing::StartsWith("share of pixels")));
}

TEST_F(TruthOfAScene, WrongPicturesFail) {
  const auto broken = [&](const PictureF& rendered) { return broken_bounds(truth_of(rendered)); };
  const PictureF exact = picture_of(image_);

  PictureF shifted = exact;  // by one pixel to the right
  std::copy(exact.rgba.begin(), exact.rgba.end() - 4, shifted.rgba.begin() + 4);
  EXPECT_THAT(broken(shifted), testing::SizeIs(testing::Ge(3U)));

  DisplayCalibration linear = display_;
  linear.optics.diffuser = Diffuser::kLinear;
  EXPECT_THAT(broken(picture_of(cast_module(intersector_, {linear, linear.modules[0], {}}))),
              testing::SizeIs(testing::Ge(3U)));

  PictureF upside_down = exact;
  for (int row = 0; row < kSize.height; ++row) {
    const auto from = exact.rgba.begin() + std::ptrdiff_t{4} * kSize.width * row;
    std::copy(from, from + 4 * kSize.width, upside_down.rgba.end() - std::ptrdiff_t{4} * kSize.width * (row + 1));
  }
  EXPECT_THAT(broken(upside_down), testing::SizeIs(testing::Ge(3U)));

  PictureF one_wrong = exact;  // a single pixel inside a surface, 1 % of the diagonal off
  const auto inside = std::ranges::find(near_, 0, [&](const std::uint8_t& n) {
    return n != 0 || !image_.hit[static_cast<std::size_t>(&n - near_.data())];
  });
  one_wrong.rgba[4 * (inside - near_.begin())] += 0.02F;
  EXPECT_THAT(broken(one_wrong), testing::ElementsAre(testing::StartsWith("largest error")));

  EXPECT_THAT(broken(PictureF{kSize.width, kSize.height, std::vector<float>(exact.rgba.size())}),
              testing::Contains(testing::StartsWith("compared: 0 of")));

  PictureF not_a_number = exact;
  for (std::size_t i = 0; i < image_.hit.size(); ++i) not_a_number.rgba[4 * i] = NAN;
  EXPECT_THAT(broken(not_a_number), testing::SizeIs(3)) << "median, 99 % and largest";
}

TEST(Truth, StatisticsOfKnownErrors) {
  // 10 x 10 pixels; pixel i is off by (i + 1) thousandths of the diagonal; one pixel near a silhouette is off by far
  // more.
  HitImage reference{{10, 10}, std::vector<std::optional<Hit>>(100)};
  std::vector<std::uint8_t> near(100);
  PictureF rendered{10, 10, std::vector<float>(400, 1)};
  const auto error_of = [](int i) { return (i + 1) / 1000.0; };
  for (int i = 0; i < 100; ++i) {
    reference.hit[i] = Hit{};
    reference.hit[i]->world = {1, 1 + 4 * error_of(i), 1};
  }
  near[99] = 1;
  reference.hit[99]->world = {50, 0, 0};
  const Truth truth = compare(reference, near, rendered, {}, 4);
  EXPECT_EQ(truth.compared, 99U);
  EXPECT_EQ(truth.near_silhouette, 1U);
  EXPECT_NEAR(truth.median, error_of(49), 1e-15);
  EXPECT_NEAR(truth.percent_99, error_of(98), 1e-15) << "99 % of 99 are 98.01: rank 99";
  EXPECT_NEAR(truth.max, error_of(98), 1e-15);
  EXPECT_EQ(truth.worst, (PixelIndex{8, 9}));
}

TEST(Truth, NothingAgainstNothingIsTrue) {
  const HitImage reference{{4, 4}, std::vector<std::optional<Hit>>(16)};
  const std::vector<std::uint8_t> near(16);
  const Truth truth = compare(reference, near, {4, 4, std::vector<float>(64)}, {}, 1);
  EXPECT_EQ(truth.mismatch_share, 0);
  EXPECT_THAT(broken_bounds(truth), testing::IsEmpty());
}

}  // namespace
}  // namespace lfd::reference
