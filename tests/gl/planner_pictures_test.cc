// What the planner leaves out changes no picture; what does not change is not drawn again, and what does is.
#include <gtest/gtest.h>

#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "tests/support/made.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing_support::buffers;
using testing_support::context;
using testing_support::draw_once;
using testing_support::find_image;
using testing_support::made_data;
using testing_support::state_of;
using testing_support::whole_scene;

constexpr proto::BufferKind kAllKinds[] = {proto::COLOR, proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH};

DisplayCalibration small_display(int modules) {
  auto made = make_display("640rc", modules);
  LFD_CHECK(made, made.error().message());
  made->image = {96, 72};
  return *made;
}

std::vector<std::uint32_t> all_modules(const DisplayCalibration& display) {
  std::vector<std::uint32_t> modules(display.modules.size());
  for (std::uint32_t k = 0; k < modules.size(); ++k) modules[k] = k;
  return modules;
}

// The scene small and at the right, far before the screen: some modules do not see it, and others do not see all of it.
RegionOfInterest aside(const SceneData& data, const DisplayCalibration& display) {
  RegionOfInterest roi = whole_scene(data.scene, display);
  roi.physical_size *= 0.35;
  roi.physical_centre = {1.1, 0.1, 1.2};
  return roi;
}

bool says(const FrameResult& result, const std::string& what) {
  return std::ranges::any_of(result.report.left_out(), [&](const proto::LeftOut& left) { return left.what() == what; });
}

// An empty image is all background, without a surface.
std::string bytes_of(const ModuleImage& image, const std::string& background) {
  if (!image.empty) return *image.bytes;
  const std::size_t pixels = static_cast<std::size_t>(image.size.width) * image.size.height;
  if (image.kind != proto::COLOR) return std::string(16 * pixels, '\0');
  std::string bytes;
  for (std::size_t i = 0; i < pixels; ++i) bytes += background;
  return bytes;
}

// Bit-identical: both draw the same triangles with the same shaders in the same order, only more of them where nothing
// is seen.
void expect_same(const FrameResult& a, const FrameResult& b, const std::vector<std::uint32_t>& modules,
                 const std::string& background) {
  for (const auto module : modules) {
    for (const auto kind : kAllKinds) {
      const ModuleImage *one = find_image(a, module, kind), *other = find_image(b, module, kind);
      ASSERT_TRUE(one != nullptr && other != nullptr) << "module " << module << ", " << proto::BufferKind_Name(kind);
      EXPECT_TRUE(bytes_of(*one, background) == bytes_of(*other, background))
          << "module " << module << ", " << proto::BufferKind_Name(kind);
    }
  }
}

struct Scenario {
  const char* scene;
  bool aside, ao;
};

class PlannerPictures : public testing::TestWithParam<Scenario> {};
std::string name_of(const testing::TestParamInfo<Scenario>& info) {
  std::string name = info.param.scene;
  std::erase(name, '-');
  return name + (info.param.aside ? "Aside" : "Whole") + (info.param.ao ? "WithAo" : "WithoutAo");
}
INSTANTIATE_TEST_SUITE_P(Scenes, PlannerPictures,
                         testing::Values(Scenario{"room", false, true}, Scenario{"room", true, true},
                                         Scenario{"room", true, false}, Scenario{"ribbed-shell", false, true},
                                         Scenario{"ribbed-shell", true, true}, Scenario{"ribbed-shell", false, false},
                                         Scenario{"depth-steps", false, true}, Scenario{"depth-steps", true, false}),
                         name_of);

TEST_P(PlannerPictures, AreThoseOfEverything) {
  const DisplayCalibration display = small_display(6);
  const auto modules = all_modules(display);
  const SceneData data = made_data(GetParam().scene);
  const RegionOfInterest roi = GetParam().aside ? aside(data, display) : whole_scene(data.scene, display);
  proto::RenderSettings planned, everything;
  planned.mutable_ao()->set_enabled(GetParam().ao);
  everything = planned;
  everything.set_planner(proto::RenderSettings::EVERYTHING);
  const FrameOptions options{.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH})};
  Renderer renderer(context(), display, modules);
  const FrameResult a = draw_once(renderer, state_of(data, roi, planned), data.assets, options);
  const FrameResult b = draw_once(renderer, state_of(data, roi, everything), data.assets, options);
  expect_same(a, b, modules, std::string("\0\0\0\xff", 4));

  // Colour alone leaves more out, and gives the same colour.
  const FrameResult bare = draw_once(renderer, state_of(data, roi, planned), data.assets, {});
  for (const auto module : modules) {
    const ModuleImage *one = find_image(a, module, proto::COLOR), *other = find_image(bare, module, proto::COLOR);
    EXPECT_EQ(one->empty, other->empty);
    EXPECT_TRUE(one->empty || *one->bytes == *other->bytes) << "module " << module;
  }
  EXPECT_EQ(says(a, "module"), GetParam().aside) << "of the six, some see nothing of a scene aside";
}

TEST(PlannerReports, DrawsOutsideOfAModulesView) {
  const DisplayCalibration display = small_display(6);
  const SceneData data = made_data("depth-steps");  // six instances
  RegionOfInterest roi = whole_scene(data.scene, display);
  roi.physical_centre = {1.0, 0, 0.3};
  Renderer renderer(context(), display, all_modules(display));
  const FrameResult result = draw_once(renderer, state_of(data, roi), data.assets, {});
  EXPECT_TRUE(says(result, "draw"));
  EXPECT_TRUE(says(result, "pass")) << "unlit: no occlusion, blur or post processing";
  EXPECT_TRUE(says(result, "target"));
  EXPECT_FALSE(says(result, "texture"));
}

class Reuse : public testing::Test {
 protected:
  Reuse()
      : display_(small_display(3)), renderer_(context(), display_, all_modules(display_)), data_(made_data("room")) {}

  FrameResult draw(const proto::State& state, bool reuse = true) {
    return draw_once(renderer_, state, data_.assets,
                     {.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH}), .reuse = reuse});
  }

  proto::State state() const { return state_of(data_, whole_scene(data_.scene, display_)); }

  static bool reused(const FrameResult& result) {
    return std::ranges::any_of(result.report.left_out(), [](const proto::LeftOut& left) {
      return left.why() == "inputs unchanged since the last frame";
    });
  }

  DisplayCalibration display_;
  Renderer renderer_;
  SceneData data_;
};

TEST_F(Reuse, OfUnchangedInputsGivesTheSameImages) {
  const FrameResult first = draw(state());
  proto::State renumbered = state();
  renumbered.set_sequence(17);
  const FrameResult second = draw(renumbered), again = draw(state(), false);
  EXPECT_FALSE(reused(first));
  EXPECT_TRUE(reused(second)) << "a new number alone changes nothing";
  EXPECT_FALSE(reused(again)) << "not allowed";
  expect_same(first, second, renderer_.modules(), "");
  expect_same(first, again, renderer_.modules(), "");
}

TEST_F(Reuse, AMovedInstanceIsDrawnAgain) {
  const FrameResult first = draw(state());
  proto::State moved = state();
  moved.mutable_scene()->mutable_instance(0)->set_world_from_mesh(3, 0.1);
  const FrameResult second = draw(moved);
  EXPECT_FALSE(reused(second));
  for (const auto module : renderer_.modules()) {
    EXPECT_FALSE(*find_image(first, module, proto::POSITION)->bytes ==
                 *find_image(second, module, proto::POSITION)->bytes);
  }
  // As if it had always stood there, and back again.
  Renderer fresh(context(), display_, renderer_.modules());
  const FrameOptions options{.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH})};
  expect_same(second, draw_once(fresh, moved, data_.assets, options), renderer_.modules(), "");
  expect_same(first, draw(state()), renderer_.modules(), "");
}

TEST_F(Reuse, EveryOtherInputCountsToo) {
  const auto changed = [&](auto change) {
    proto::State next = state();
    change(next);
    draw(state());
    return !reused(draw(next));
  };
  EXPECT_TRUE(changed([](proto::State& s) { s.mutable_roi()->mutable_world_centre()->set_x(0.2); }));
  EXPECT_TRUE(changed([](proto::State& s) { s.mutable_render()->mutable_ao()->set_radius_m(0.3); }));
  EXPECT_TRUE(changed([](proto::State& s) { s.mutable_render()->mutable_background()->set_r(0.5); }));
  EXPECT_TRUE(changed([](proto::State& s) { s.mutable_scene()->mutable_light(0)->set_color(0, 0.1F); }));
  EXPECT_TRUE(changed([](proto::State& s) { s.mutable_scene()->mutable_material(0)->set_base_color(0, 0.1F); }));
  draw(state());
  const FrameResult other_buffers = draw_once(renderer_, state(), data_.assets, {.buffers = buffers({proto::DEPTH})});
  EXPECT_FALSE(reused(other_buffers));
}

// Six walls one behind another, far to the right before the screen, so that each module sees another part of them.
TEST(ReuseOfModules, ThatDoNotSeeWhatMovedGivesTheSameImages) {
  const DisplayCalibration display = small_display(12);
  const auto modules = all_modules(display);
  const SceneData data = made_data("depth-steps");
  const RegionOfInterest roi = aside(data, display);
  const FrameOptions options{.buffers = buffers({proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH})};
  const auto unchanged = [](const FrameResult& result) {
    return std::ranges::count(result.report.left_out(), "inputs unchanged since the last frame", &proto::LeftOut::why);
  };
  std::ptrdiff_t fewest = 12, most = 0;
  proto::State state = state_of(data, roi);
  Renderer renderer(context(), display, modules);
  draw_once(renderer, state, data.assets, options);
  for (int i = 0; i < state.scene().instance_size(); ++i) {
    auto& x = *state.mutable_scene()->mutable_instance(i)->mutable_world_from_mesh();
    x[3] += 0.02;
    const FrameResult moved = draw_once(renderer, state, data.assets, options);
    Renderer fresh(context(), display, modules);
    const FrameResult expected = draw_once(fresh, state, data.assets, options);
    EXPECT_EQ(unchanged(expected), 0);
    expect_same(moved, expected, modules, std::string("\0\0\0\xff", 4));
    fewest = std::min(fewest, unchanged(moved));
    most = std::max(most, unchanged(moved));
  }
  EXPECT_GT(most, 0) << "some modules do not see what moved";
  EXPECT_LT(fewest, 12) << "some modules do";
  // Light reaches all of them.
  state.mutable_render()->mutable_ao()->set_enabled(false);
  state.mutable_scene()->mutable_light(0)->set_color(0, 0.5F);
  EXPECT_EQ(unchanged(draw_once(renderer, state, data.assets, options)), 0);
  // Nothing in hand: the last frame was not read back.
  state.mutable_scene()->mutable_light(0)->set_color(0, 0.25F);
  draw_once(renderer, state, data.assets, {.buffers = options.buffers, .read_back = false});
  state.mutable_scene()->mutable_instance(0)->mutable_world_from_mesh()->Set(3, 0.3);
  EXPECT_EQ(unchanged(draw_once(renderer, state, data.assets, options)), 0);
}

}  // namespace
}  // namespace lfd
