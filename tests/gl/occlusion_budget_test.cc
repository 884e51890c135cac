// A renderer that is given a budget times the front's settings itself, says what it took, and draws with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "proto/occlusion/front.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing_support::draw_once;

class OcclusionBudget : public testing::Test {
 protected:
  OcclusionBudget() {
    auto display = make_display("desk");
    LFD_CHECK(display, "a known display");
    display->image = {32, 24};
    display_ = *display;
    auto made = scene::make_scene("corner", 1);
    LFD_CHECK(made, "a known scene");
    scene_ = made->data;
    auto roi = complete_roi({}, scene_.scene, display_.screen);
    LFD_CHECK(roi, "the scene has bounds");
    roi_ = *roi;
  }

  proto::State state_with(const proto::AmbientOcclusion& ao) const {
    proto::RenderSettings render;
    *render.mutable_ao() = ao;
    return testing_support::state_of(scene_, roi_, render);
  }

  FrameResult draw(Renderer& renderer, const proto::AmbientOcclusion& ao) const {
    return draw_once(
        renderer, state_with(ao), scene_.assets,
        {.buffers = testing_support::buffers({proto::AO}), .time_modules = false, .reuse = true, .read_back = true});
  }

  DisplayCalibration display_;
  SceneData scene_;
  RegionOfInterest roi_;
};

proto::AmbientOcclusion budget(double ms) {
  proto::AmbientOcclusion ao;
  ao.set_budget_ms(ms);
  return ao;
}

// The same settings said outright.
proto::AmbientOcclusion entry_of(int i) { return occlusion::with_entry({}, occlusion::committed_front().entry(i)); }

TEST_F(OcclusionBudget, AGenerousOneGetsTheMostAccurate) {
  Renderer renderer(testing_support::context(), display_, {0, 1, 2, 3, 4, 5, 6, 7});
  const FrameResult chosen = draw(renderer, budget(1e6));
  const int last = occlusion::committed_front().entry_size() - 1;
  EXPECT_THAT(chosen.report.occlusion_choice(), HasSubstr(occlusion::committed_front().entry(last).name()));
  const FrameResult outright = draw(renderer, entry_of(last));
  EXPECT_EQ(outright.report.occlusion_choice(), "");
  for (const std::uint32_t module : {0U, 4U}) {
    EXPECT_EQ(testing_support::floats_of(*testing_support::find_image(chosen, module, proto::AO)),
              testing_support::floats_of(*testing_support::find_image(outright, module, proto::AO)));
  }
}

TEST_F(OcclusionBudget, AnImpossibleOneGetsAFastOneAndSaysSo) {
  Renderer renderer(testing_support::context(), display_, {3});
  const FrameResult frame = draw(renderer, budget(1e-6));
  EXPECT_THAT(frame.report.occlusion_choice(), HasSubstr("nothing fits in 1e-06 ms"));
}

TEST_F(OcclusionBudget, AMethodByNameWins) {
  Renderer renderer(testing_support::context(), display_, {3});
  proto::AmbientOcclusion ao = budget(1e-6);
  ao.set_method("hbao");
  const FrameResult frame = draw(renderer, ao);
  EXPECT_THAT(frame.report.occlusion_choice(), HasSubstr("hbao: it is asked for by name"));
  ao.set_budget_ms(0);
  const FrameResult plain = draw(renderer, ao);
  EXPECT_EQ(testing_support::floats_of(*testing_support::find_image(frame, 3, proto::AO)),
            testing_support::floats_of(*testing_support::find_image(plain, 3, proto::AO)));
}

// What was chosen stays while the settings do, also where nothing is drawn again.
TEST_F(OcclusionBudget, IsChosenOnce) {
  Renderer renderer(testing_support::context(), display_, {3});
  const FrameResult first = draw(renderer, budget(1e6));
  proto::State moved = state_with(budget(1e6));
  moved.mutable_roi()->mutable_world_centre()->set_x(0.01);
  moved.set_sequence(2);
  const FrameResult second = draw_once(renderer, moved, scene_.assets, {});
  EXPECT_EQ(second.report.occlusion_choice(), first.report.occlusion_choice())
      << "the very times: it was not timed again";
  const FrameResult third = draw(renderer, budget(1e-6));
  EXPECT_NE(third.report.occlusion_choice(), first.report.occlusion_choice()) << "another budget";
  // Nothing has changed, and the next frame is begun before this one is collected: each says what it was drawn with.
  const proto::State same = state_with(budget(1e6));
  ASSERT_TRUE(renderer.set_state(same, scene_.assets));
  const FrameOptions again{.buffers = testing_support::buffers({proto::AO}), .reuse = false};
  ASSERT_TRUE(renderer.draw(again));
  ASSERT_TRUE(renderer.draw(again));
  const FrameResult one = renderer.collect(), other = renderer.collect();
  EXPECT_FALSE(one.report.occlusion_choice().empty());
  EXPECT_EQ(one.report.occlusion_choice(), other.report.occlusion_choice());
  EXPECT_EQ(testing_support::floats_of(*testing_support::find_image(one, 3, proto::AO)),
            testing_support::floats_of(*testing_support::find_image(other, 3, proto::AO)));
}

TEST_F(OcclusionBudget, WithoutOcclusionNothingIsTimed) {
  Renderer renderer(testing_support::context(), display_, {3});
  proto::AmbientOcclusion ao = budget(5);
  ao.set_enabled(false);
  EXPECT_EQ(draw(renderer, ao).report.occlusion_choice(), "");
}

}  // namespace
}  // namespace lfd
