// `lfd keys make` as a person uses it: what is refused, and what is said of keys that are not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class LfdKeysMake : public testing::Test {
 protected:
  // Its lines; its exit code is expected to be this.
  std::vector<std::string> make(std::vector<std::string> more, int code = 0) const {
    more.insert(more.begin(), {"keys", "make", wall_});
    return lfd(std::move(more), code);
  }
  static std::vector<std::string> lfd(const std::vector<std::string>& arguments, int code) {
    const auto process = start_program("lfd", arguments);
    const auto exit = process->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->code == code)
        << testing::PrintToString(arguments) << testing::PrintToString(process->lines());
    return process->lines();
  }

  const Workbench bench_;
  const std::string wall_ = bench_.deployment("sink: NONE security { keys: \"keys\" }");
  const fs::path keys_ = bench_.folder() / "keys";
};

TEST_F(LfdKeysMake, NamesThatNobodyCanHaveAreWrongUse) {
  for (const char* const option : {"--operator", "--viewer"}) {
    EXPECT_THAT(make({option, "../evil"}, 2),
                Contains(AllOf(HasSubstr(fmt::format("error: {}: \"../evil\": 1 to 64 letters", option)))));
    make({option, "ann,a b"}, 2);
  }
  EXPECT_FALSE(fs::exists(keys_));
  EXPECT_FALSE(fs::exists(bench_.folder() / "evil.key"));
}

TEST_F(LfdKeysMake, KeysThatAreNotThereAreNamedWithWhatToDo) {
  EXPECT_THAT(make({"--operator", "ann"}), SizeIs(5));  // controller, display, two nodes and ann
  EXPECT_THAT(make({}), ElementsAre(HasSubstr("nothing to make: ")));
  fs::remove(keys_ / "left.key");
  EXPECT_THAT(make({}), ElementsAre(HasSubstr("nothing to make: "), HasSubstr("not in this folder: left (")));
  fs::remove(keys_ / "ann.key");
  const std::string remedy = fmt::format("`lfd keys make {} --operator NAME`", wall_);
  EXPECT_THAT(make({}), Contains(HasSubstr(remedy)));
  EXPECT_THAT(lfd({"run", wall_}, 1), Contains(HasSubstr("`lfd keys make DEPLOYMENT --operator NAME` makes one")));
  EXPECT_THAT(make({"--operator", "bob"}), AllOf(Contains(HasSubstr("bob.key")), Not(Contains(HasSubstr(remedy)))));
}

}  // namespace
}  // namespace lfd::harness
