// lfd keys: the program as a person uses it, and a cluster that comes up with what it made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>

#include "base/file.h"
#include "base/log.h"
#include "proto/key_files.h"
#include "tests/support/unwrapped.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace fs = std::filesystem;
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::UnorderedElementsAre;
using testing_support::unwrapped;

struct Ended {
  int code = -1;
  std::vector<std::string> lines;
};

Ended run(std::vector<std::string> arguments) {
  const auto process = start_program("lfd", std::move(arguments));
  const auto exit = process->wait(kClusterPatience);
  return {exit ? exit->code : -1, process->lines()};
}

// Its lines; its exit code is expected to be this.
std::vector<std::string> lines_of(const Ended& ended, int code = 0) {
  EXPECT_EQ(ended.code, code) << testing::PrintToString(ended.lines);
  return ended.lines;
}

unsigned mode_of(const fs::path& path) {
  struct stat facts {};
  EXPECT_EQ(::stat(path.c_str(), &facts), 0) << path;
  return facts.st_mode & 07777;
}

class LfdKeys : public testing::Test {
 protected:
  std::string key(const std::string& name) const { return (keys_ / (name + ".key")).string(); }
  Ended make(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"keys", "make", deployment_.string()});
    return run(std::move(more));
  }
  // What every file of the folder holds.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::directory_iterator(keys_))
      all[entry.path().filename()] = unwrapped(read_file(entry.path()));
    return all;
  }

  const Workbench bench_{ImageSize{64, 48}};
  const fs::path deployment_ = bench_.deployment("security { keys: \"keys\" }"), keys_ = bench_.folder() / "keys";
};

TEST_F(LfdKeys, MakeWritesAKeyForItsOwnersEyesAndALineForEachMember) {
  const Ended made = make({"--operator", "ann", "--viewer", "guest"});
  ASSERT_EQ(made.code, 0) << testing::PrintToString(made.lines);
  EXPECT_THAT(made.lines, UnorderedElementsAre(key("ann"), key("controller"), key("display"), key("guest"), key("left"),
                                               key("right")));
  const std::map<std::string, proto::Allowed::Right> rights{
      {"ann", proto::Allowed::CONTROL},     {"controller", proto::Allowed::CONTROLLER},
      {"display", proto::Allowed::DISPLAY}, {"guest", proto::Allowed::STATUS},
      {"left", proto::Allowed::NODE},       {"right", proto::Allowed::NODE}};
  const AllowList list = unwrapped(read_allow_list(keys_ / kAllowFile));
  EXPECT_EQ(list.members.size(), rights.size());
  const Ended shown = run({"keys", "show", deployment_.string()});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.lines.size(), rights.size());
  for (const auto& [name, right] : rights) {
    EXPECT_EQ(mode_of(key(name)), 0600U) << name;
    const Allowed* member = list.named(name);
    ASSERT_NE(member, nullptr) << name;
    EXPECT_THAT(member->rights, ElementsAre(right)) << name;
    const proto::KeyFile own = unwrapped(read_key_file(key(name)));
    EXPECT_EQ(own.name(), name);
    EXPECT_EQ(own.public_key(), member->public_key) << name;
    EXPECT_THAT(shown.lines, Contains(AllOf(testing::StartsWith(name + " "), HasSubstr(member->public_key),
                                            HasSubstr(proto::Allowed::Right_Name(right)))));
  }
  EXPECT_EQ(mode_of(keys_ / kAllowFile) & 0022U, 0U) << "nobody else may add a line";
}

TEST_F(LfdKeys, MakeLeavesWhatIsThere) {
  ASSERT_EQ(make().code, 0);
  const auto before = contents();
  const Ended again = make();
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.lines, ElementsAre("nothing to make: " + (keys_ / kAllowFile).string() + " lists all"));
  EXPECT_EQ(contents(), before);
  const Ended more = make({"--viewer", "guest"});
  EXPECT_EQ(more.code, 0);
  EXPECT_THAT(more.lines, ElementsAre(key("guest")));
  auto after = contents();
  EXPECT_THAT(after[std::string(kAllowFile)], HasSubstr("guest"));
  for (const auto& [name, content] : before) {
    if (name == kAllowFile) continue;
    EXPECT_EQ(after[name], content) << name;
  }
}

// The line of a key was removed to shut somebody out: neither is it listed again, nor is the file written over.
TEST_F(LfdKeys, MakeRefusesToWriteOverAKeyThatIsNotListed) {
  ASSERT_EQ(make().code, 0);
  AllowList list = unwrapped(read_allow_list(keys_ / kAllowFile));
  std::erase_if(list.members, [](const Allowed& member) { return member.name == "left"; });
  ASSERT_TRUE(write_allow_list(keys_ / kAllowFile, list));
  const auto before = contents();
  const Ended again = make();
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.lines, Contains(AllOf(HasSubstr("error: "), HasSubstr(key("left") + ": is there, and"))));
  EXPECT_EQ(contents(), before);
}

TEST_F(LfdKeys, MakeNeedsADeploymentThatNamesAFolder) {
  const Ended made = run({"keys", "make", bench_.deployment("", "plain.textproto").string()});
  EXPECT_EQ(made.code, 1);
  EXPECT_THAT(made.lines, Contains(HasSubstr("security { keys: \"keys\" }")));
}

TEST_F(LfdKeys, AClusterComesUpWithThem) {
  ASSERT_EQ(make({"--operator", "ann"}).code, 0);
  const Running running = run_cluster(deployment_);
  ASSERT_FALSE(running.endpoint.empty());
  EXPECT_TRUE(draws({running.endpoint, key("ann")}, 3));
  EXPECT_FALSE(status_at(running.endpoint)) << "nobody is heard without a key";
}

TEST_F(LfdKeys, NamesThatNobodyCanHaveAreWrongUse) {
  for (const char* const option : {"--operator", "--viewer"}) {
    EXPECT_THAT(lines_of(make({option, "../evil"}), 2),
                Contains(AllOf(HasSubstr(fmt::format("error: {}: \"../evil\": 1 to 64 letters", option)))));
    lines_of(make({option, "ann,a b"}), 2);
  }
  EXPECT_FALSE(fs::exists(keys_));
  EXPECT_FALSE(fs::exists(bench_.folder() / "evil.key"));
}

TEST_F(LfdKeys, ThatAreNotThereAreNamedWithWhatToDo) {
  EXPECT_THAT(lines_of(make({"--operator", "ann"})), SizeIs(5));  // controller, display, two nodes and ann
  EXPECT_THAT(lines_of(make()), ElementsAre(HasSubstr("nothing to make: ")));
  fs::remove(key("left"));
  EXPECT_THAT(lines_of(make()), ElementsAre(HasSubstr("nothing to make: "), HasSubstr("not in this folder: left (")));
  fs::remove(key("ann"));
  const std::string remedy = fmt::format("`lfd keys make {} --operator NAME`", deployment_.string());
  EXPECT_THAT(lines_of(make()), Contains(HasSubstr(remedy)));
  EXPECT_THAT(lines_of(run({"run", deployment_.string()}), 1),
              Contains(HasSubstr("`lfd keys make DEPLOYMENT --operator NAME` makes one")));
  EXPECT_THAT(lines_of(make({"--operator", "bob"})),
              AllOf(Contains(HasSubstr("bob.key")), Not(Contains(HasSubstr(remedy)))));
}

}  // namespace
}  // namespace lfd::harness
