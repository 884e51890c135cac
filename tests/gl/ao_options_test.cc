// The options of ambient occlusion all at once, with every method: numbers stay numbers, and neither planner nor timing
// changes a picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/make.h"
#include "tests/gl/ao_share_stage.h"
#include "tests/gl/ao_stage.h"

namespace lfd {
namespace {

using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::floats_of;
using testing_support::from_above;
using testing_support::made;
using testing_support::state_of;

class AoOptions : public testing::TestWithParam<const occlusion::Method*> {
 protected:
  // What the method goes with of everything there is.
  static proto::AmbientOcclusion all_options(proto::AmbientOcclusion::Blur::Kind blur) {
    const occlusion::Method& method = *GetParam();
    proto::AmbientOcclusion ao;
    ao.set_method(std::string(method.name));
    ao.set_radius_m(0.3);
    ao.set_radii(2);
    ao.set_half_resolution(true);
    ao.set_guard_band_px(6);
    ao.set_bent_normals(method.directions);
    ao.set_least_samples(method.name == "schmitt" ? 0 : 2);
    ao.mutable_shared()->set_neighbours(2);
    ao.mutable_shared()->set_open_air(method.points);
    ao.mutable_blur()->set_kind(blur);
    return ao;
  }

  // Its pinholes' images reach beside the screen.
  static DisplayCalibration display() {
    DisplayCalibration desk = *make_display("desk");
    desk.image = {48, 36};
    return perturbed(desk, 7);
  }
};
INSTANTIATE_TEST_SUITE_P(All, AoOptions, testing::ValuesIn(occlusion::methods().begin(), occlusion::methods().end()),
                         [](const auto& method) { return std::string(method.param->name); });

const std::vector<std::uint32_t> kModules{2, 3, 4, 5};
const FrameOptions kOptions{.buffers = buffers({proto::AO, proto::BENT_NORMAL, proto::NORMAL, proto::POSITION}),
                            .reuse = false};

FrameResult drawn(const char* scene, const RegionOfInterest& roi, const proto::AmbientOcclusion& ao,
                  const DisplayCalibration& display,
                  proto::RenderSettings::Planner planner = proto::RenderSettings::PLAN, bool time_modules = false) {
  Renderer renderer(context(), display, kModules);
  proto::RenderSettings settings;
  *settings.mutable_ao() = ao;
  settings.set_planner(planner);
  const SceneData data = made(scene);
  FrameOptions options = kOptions;
  options.time_modules = time_modules;
  return draw_once(renderer, state_of(data, roi, settings), data.assets, options);
}

TEST_P(AoOptions, TogetherLeaveNumbersInTheirRange) {
  for (const auto blur : {proto::AmbientOcclusion::Blur::GAUSSIAN, proto::AmbientOcclusion::Blur::GEOMETRY}) {
    const FrameResult frame = drawn("corner", from_above(), all_options(blur), display());
    int occluded = 0;
    for (const std::uint32_t module : kModules) {
      const auto ao = floats_of(*find_image(frame, module, proto::AO));
      const auto bent = floats_of(*find_image(frame, module, proto::BENT_NORMAL));
      const auto position = floats_of(*find_image(frame, module, proto::POSITION));
      int surfaces = 0;
      for (std::size_t i = 0; i < ao.size(); i += 4) {
        ASSERT_TRUE(ao[i] >= 0 && ao[i] <= 1) << "module " << module << ", pixel " << i / 4 << ": " << ao[i];
        // Half floats, and means of unit vectors: their lengths are off by less than 1e-2.
        const float length = std::hypot(bent[i], bent[i + 1], bent[i + 2]);
        ASSERT_TRUE(length <= 1.01F) << "module " << module << ", pixel " << i / 4 << ": " << length;
        ASSERT_EQ(ao[i + 3], position[i + 3])
            << "found wherever a surface is; module " << module << ", pixel " << i / 4;
        surfaces += ao[i + 3] > 0 ? 1 : 0;
        occluded += ao[i] > 0.02F ? 1 : 0;
      }
      EXPECT_GT(surfaces, 500) << "module " << module;
    }
    EXPECT_GT(occluded, 20) << "corners are darker";
  }
}

TEST_P(AoOptions, TogetherDoNotKnowOfPlannerAndTiming) {
  const auto ao = all_options(proto::AmbientOcclusion::Blur::GAUSSIAN);
  const FrameResult planned = drawn("corner", from_above(), ao, display());
  const FrameResult everything = drawn("corner", from_above(), ao, display(), proto::RenderSettings::EVERYTHING);
  const FrameResult timed = drawn("corner", from_above(), ao, display(), proto::RenderSettings::PLAN, true);
  for (const ModuleImage& image : planned.images) {
    EXPECT_EQ(*image.bytes, *find_image(everything, image.module, image.kind)->bytes)
        << "module " << image.module << ", " << image.kind;
    EXPECT_EQ(*image.bytes, *find_image(timed, image.module, image.kind)->bytes)
        << "module " << image.module << ", " << image.kind;
  }
}

// Bent normals are shared as occlusion is: where nothing hides anything they are the surface's own.
TEST_P(AoOptions, OfAnOpenPlaneBentNormalsAreItsOwn) {
  if (!GetParam()->directions) GTEST_SKIP() << "the method has no directions";
  const SceneData data = made("plane");
  const RegionOfInterest roi = *complete_roi({}, data.scene, display().screen);
  const FrameResult frame = drawn("plane", roi, all_options(proto::AmbientOcclusion::Blur::GAUSSIAN), display());
  const auto bent = floats_of(*find_image(frame, 3, proto::BENT_NORMAL)),
             normal = floats_of(*find_image(frame, 3, proto::NORMAL));
  const auto ao = floats_of(*find_image(frame, 3, proto::AO));
  for (std::size_t i = 0; i < bent.size(); i += 4) {
    if (ao[i + 3] == 0 || ao[i] > 0.02F) continue;  // samples of a ball lie behind the plane too
    const float length = std::hypot(bent[i], bent[i + 1], bent[i + 2]);
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_NEAR(bent[i + k] / length, normal[i + k], 1e-2) << "half floats; pixel " << i / 4;
  }
}

// No message can ask for it, but nothing divides by it either.
TEST_P(AoOptions, WithoutARadiusNothingIsHiddenOrAllIsANumber) {
  for (const bool shared : {false, true}) {
    testing_support::SharingStage stage(made("corner"), from_above(), display(), kModules);
    proto::AmbientOcclusion ao;
    ao.set_method(std::string(GetParam()->name));
    ao.mutable_shared()->set_neighbours(shared ? 2 : 0);
    for (const auto& layer : stage.draw(ao, true, false)) {
      for (const float value : layer.ao) ASSERT_TRUE(value == -1 || (value >= 0 && value <= 1)) << value;
    }
  }
}

}  // namespace
}  // namespace lfd
