// Text files: errors name file and line, roads lead to the lines of fields.
#include "proto/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/calibration.pb.h"
#include "proto/deployment.pb.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string error_of(std::string_view text) {
  proto::Deployment message;
  const auto places = parse_text(text, "wall.textproto", message);
  return places ? "" : places.error().message();
}

TEST(TextFile, SyntaxErrorsAndUnknownFieldsNameTheirLine) {
  EXPECT_THAT(error_of("name: \"a\"\n\nnode {\n  nome: \"x\"\n}"), StartsWith("wall.textproto:4: "));
  EXPECT_THAT(error_of("name: \"a\"\n\nnode {\n  nome: \"x\"\n}"), HasSubstr("nome"));
  EXPECT_THAT(error_of("name: \"a\n"), StartsWith("wall.textproto:1: "));
  EXPECT_THAT(error_of("# comment\nnode {"), StartsWith("wall.textproto:2: "));
  EXPECT_THAT(error_of("pacing {\n deadline_ms: 1.5 }"), StartsWith("wall.textproto:2: "));
  EXPECT_THAT(error_of("sink: NOWHERE"), HasSubstr("NOWHERE"));
}

TEST(TextFile, AFieldGivenTwiceIsAnError) {
  EXPECT_THAT(error_of("name: \"a\"\nname: \"b\""), StartsWith("wall.textproto:2: "));
}

TEST(TextFile, AKeyGivenTwiceIsAnError) {
  const std::string twice =
      "render { ao { method: \"hbao\"\n parameter { key: \"steps\" value: 1 }\n parameter { key: \"bias\" value: 0 }\n"
      "parameter { key: \"steps\" value: 2 } } }";
  EXPECT_EQ(error_of(twice), "wall.textproto:4: parameter: key \"steps\" is given twice");
  proto::Deployment message;
  ASSERT_TRUE(parse_text(twice.substr(0, twice.find("parameter { key: \"bias\"")) + "} }", "f", message));
  EXPECT_EQ(message.render().ao().parameter().at("steps"), 1);
}

TEST(TextFile, CommentsAndListsAreRead) {
  proto::Deployment message;
  ASSERT_TRUE(parse_text("# one\nname: \"a\"  # two\nnode { modules: [\"0-3\", \"5\"] }", "f", message));
  EXPECT_EQ(message.node(0).modules_size(), 2);
}

TEST(TextFile, RoadsLeadToLines) {
  proto::DisplayCalibration message;
  const auto places = parse_text(
      "name: \"d\"\n"                               // 1
      "screen {\n  width_m: 1\n}\n"                 // 2 to 4
      "module { ideal {} }\n"                       // 5
      "module {\n  pinhole {\n    k1: 1\n  }\n}\n"  // 6 to 10
      "module {\n  homography { h: [1,\n 2] }\n}",  // 11
      "f", message);
  ASSERT_TRUE(places);
  EXPECT_EQ(places->of("name: is bad"), "f:1");
  EXPECT_EQ(places->of("screen: width_m: 1 is bad"), "f:3");
  EXPECT_EQ(places->of("screen.width_m: 1 is bad"), "f:3");
  EXPECT_EQ(places->of("screen: height_m: is missing"), "f:2");
  EXPECT_EQ(places->of("module 0: emitter: is missing"), "f:5");
  EXPECT_EQ(places->of("module 1: pinhole: k1: 1 is bad"), "f:8");
  EXPECT_EQ(places->of("module 1: pinhole: k2: 0 is bad"), "f:7");
  EXPECT_EQ(places->of("module 2: homography: h 1"), "f:12");
  EXPECT_EQ(places->of("module 7: emitter"), "f:11");  // the last one there is
  EXPECT_EQ(places->of("image: is missing"), "f");
  EXPECT_EQ(places->of(""), "f");
  EXPECT_EQ(places->of("Something: else"), "f");
}

TEST(TextFile, MissingFilesAndFoldersAreErrors) {
  proto::Deployment message;
  EXPECT_THAT(read_text_file("/no/such/file", message).error().message(), StartsWith("/no/such/file: "));
  EXPECT_FALSE(read_text_file("/", message));
}

TEST(TextFile, PrintedDoublesAreReadBackExactly) {
  proto::Vector message;
  message.set_x(0.1);
  message.set_y(1.0 / 3);
  message.set_z(-4.9406564584124654e-324);
  proto::Vector back;
  ASSERT_TRUE(parse_text(print_text(message), "f", back));
  EXPECT_EQ(back.x(), message.x());
  EXPECT_EQ(back.y(), message.y());
  EXPECT_EQ(back.z(), message.z());
}

}  // namespace
}  // namespace lfd
