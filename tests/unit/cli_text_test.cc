// What `lfd` writes for people and for programs: ranges of modules, buffers, image names, the report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/suggest.h"
#include "cli/ao_parameter.h"
#include "cli/lfd_commands.h"
#include "cli/report.h"
#include "cli/status_table.h"
#include "proto/frame_files.h"
#include "proto/module_ranges.h"

namespace lfd {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ModuleRanges, AreWrittenShort) {
  EXPECT_EQ(module_ranges({}), "");
  EXPECT_EQ(module_ranges(std::vector{7}), "7");
  EXPECT_EQ(module_ranges(std::vector{0, 1, 2, 3, 7, 9, 10}), "0-3,7,9-10");
}

TEST(PatternText, SaysWhatModulesShow) {
  proto::TestPattern pattern;
  EXPECT_EQ(pattern_text(pattern), "off");
  pattern.set_kind(proto::TestPattern::NUMBER);
  EXPECT_EQ(pattern_text(pattern), "number, colour 1,1,1");
  pattern.set_kind(proto::TestPattern::CHECKER);
  EXPECT_EQ(pattern_text(pattern), "checker, 32 px, colour 1,1,1");
  pattern.set_kind(proto::TestPattern::GRID);
  pattern.set_space(proto::TestPattern::SCREEN);
  EXPECT_EQ(pattern_text(pattern), "grid, a tenth of the screen's height, colour 1,1,1");
  pattern.set_spacing_m(0.05);
  pattern.mutable_color()->set_g(0.5);
  pattern.add_modules("17");
  pattern.add_modules("20-25");
  EXPECT_EQ(pattern_text(pattern), "grid, 0.05 m on the screen, colour 0,0.5,0, modules 17,20-25");
}

TEST(Buffers, AreBitsInTheOrderOfTheirKinds) {
  EXPECT_EQ(*parse_buffers({}), 0u);
  EXPECT_EQ(*parse_buffers({"color", "depth"}), 1u << proto::COLOR | 1u << proto::DEPTH);
  EXPECT_EQ(*parse_buffers({"position", "normal", "ao"}),
            1u << proto::POSITION | 1u << proto::NORMAL | 1u << proto::AO);
  EXPECT_EQ(*parse_buffers({"bent_normal"}), 1u << proto::BENT_NORMAL);
  EXPECT_THAT(parse_buffers({"colour"}).error().message(), HasSubstr("did you mean color?"));
}

TEST(AoParameter, IsANameAndANumber) {
  const auto read = parse_ao_parameter("steps=4");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, std::pair(std::string("steps"), 4.0));
  for (const auto& [text, error] : {std::pair{"steps", "\"steps\"; NAME=VALUE is expected"},
                                    {"=4", "\"=4\"; NAME=VALUE is expected"},
                                    {"shel=x", "shel=x: no method has a parameter shel"}}) {
    EXPECT_EQ(parse_ao_parameter(text).error().message(), error);
  }
  for (const char* const value : {"abc", "", "nan", "inf", "4x", "1e999", "99999999999", "0.5"}) {
    const auto refused = parse_ao_parameter(std::string("directions=") + value);
    ASSERT_FALSE(refused) << value;
    EXPECT_THAT(refused.error().message(),
                AllOf(HasSubstr("directions="), HasSubstr(": a number is needed, 1 to "), HasSubstr("for hbao")));
  }
}

TEST(AoParameter, IsHeldAgainstItsMethodWhereThatIsNamed) {
  EXPECT_TRUE(check_ao_parameters("", {{"directions", 16}}));
  EXPECT_TRUE(check_ao_parameters("hbao", {{"directions", 16}}));
  EXPECT_THAT(check_ao_parameters("hbao", {{"directions", 1.5}}).error().message(), HasSubstr("whole numbers"));
  EXPECT_THAT(check_ao_parameters("alchemy", {{"directions", 16}}).error().message(), HasSubstr("alchemy has"));
}

TEST(UnknownText, SaysWhatWasMeantOrWhatThereIs) {
  const std::vector<std::string> names{"grid", "number"};
  EXPECT_EQ(unknown_text("kind", "gird", names), "unknown kind gird; did you mean grid?");
  EXPECT_EQ(unknown_text("kind", "stripes", names), "unknown kind stripes; grid, number are possible");
}

TEST(ImageNames, HaveThreeDigitsAndTheBuffersName) {
  EXPECT_EQ(image_path("out", 12, 0, proto::COLOR), "out/frame-0012/module-000.color.png");
  EXPECT_EQ(image_path("out", 12, 17, proto::POSITION), "out/frame-0012/module-017.position.exr");
  EXPECT_EQ(image_path("out", 12, 17, proto::BENT_NORMAL), "out/frame-0012/module-017.bent_normal.exr");
  EXPECT_EQ(frame_path("out", 12), "out/frame-0012");
}

TEST(Report, GivesNumbersBackExactly) {
  proto::FrameReport frame;
  for (int i = 0; i < 16; ++i) frame.add_physical_from_world(1.0 / (3 + i));
  frame.mutable_position_origin()->set_y(0.1 + 0.2);
  frame.add_stale_module(4);
  proto::NodeReport& node = *frame.add_node();
  node.set_node("left");
  node.add_pass()->set_pass("ao");
  node.add_left_out()->set_what("module");
  const auto json = nlohmann::json::parse(report_json({}, "scene", {frame}, {}));
  const auto& read = json["frames"][0];
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(read["physical_from_world"][i].get<double>(), 1.0 / static_cast<double>(3 + i));
  }
  EXPECT_EQ(read["position_origin"][1].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(read["stale_modules"][0], 4);
  EXPECT_EQ(read["nodes"][0]["passes"][0]["pass"], "ao");
  EXPECT_EQ(read["nodes"][0]["left_out"][0]["what"], "module");
}

TEST(Report, SurvivesTextThatIsNoUtf8) {
  proto::FrameReport frame;
  EXPECT_NO_THROW(nlohmann::json::parse(report_json({}, "caf\xe9", {frame}, {})));
}

TEST(TimeTable, IsTheMeanOfTheFrames) {
  std::vector<proto::FrameReport> frames(2);
  for (double ms : {1.0, 3.0}) {
    proto::PassTime& pass = *frames[ms > 2 ? 1 : 0].add_node()->add_pass();
    pass.set_pass("gbuffer");
    pass.set_gpu_ms(ms);
  }
  EXPECT_THAT(time_table(frames), HasSubstr("2.000"));
}

TEST(TimeTable, LeavesOutFramesThatRepeatAnother) {
  std::vector<proto::FrameReport> frames(3);
  for (proto::FrameReport& frame : frames) frame.add_node()->set_node("left");
  proto::PassTime& pass = *frames[0].mutable_node(0)->add_pass();
  pass.set_pass("gbuffer");
  pass.set_gpu_ms(6);
  for (int repeated : {1, 2}) {
    proto::LeftOut& left = *frames[static_cast<std::size_t>(repeated)].mutable_node(0)->add_left_out();
    left.set_what("module");
    left.set_which("all");
  }
  EXPECT_THAT(time_table(frames), AllOf(HasSubstr("6.000"), HasSubstr("1 of 3 by left")));
}

TEST(Warnings, AreEachSaidOnceAndTellOfAFrameThatShowsNothing) {
  proto::FrameReport frame;
  for (const char* module : {"0", "1"}) {
    proto::LeftOut& left = *frame.add_node()->add_left_out();
    left.set_what("module");
    left.set_which(module);
    left.set_why("no geometry in its view");
  }
  EXPECT_THAT(warnings_of({frame, frame}, 3), IsEmpty());
  EXPECT_THAT(warnings_of({frame, frame}, 2), ElementsAre(HasSubstr("nothing of the scene is seen")));
  for (proto::NodeReport& node : *frame.mutable_node()) node.add_warning("nothing of the scene is seen: far away");
  EXPECT_THAT(warnings_of({frame, frame}, 2), ElementsAre(HasSubstr("far away")));
}

TEST(Warnings, TellOfNodesThatChoseDifferentOcclusion) {
  proto::FrameReport frame;
  frame.add_node()->set_node("left");
  frame.add_node()->set_node("right");
  frame.mutable_node(0)->set_occlusion_choice("gtao, 3 slices: 1.2 ms of 2 ms");
  frame.mutable_node(1)->set_occlusion_choice("gtao, 3 slices: 1.4 ms of 2 ms");
  EXPECT_THAT(warnings_of({frame}, 100), IsEmpty()) << "times differ, settings do not";
  frame.mutable_node(1)->set_occlusion_choice("hbao, 4 directions: 1.4 ms of 2 ms");
  EXPECT_THAT(warnings_of({frame}, 100), ElementsAre(HasSubstr("\"left\" and \"right\" chose different")));
}

}  // namespace
}  // namespace lfd
