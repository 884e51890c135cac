// Key files and allow-lists: what is read back, what is refused and where, and who is made a key.
#include "proto/key_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "calibration/make.h"
#include "cli/make_keys.h"
#include "proto/calibration_file.h"
#include "proto/deployment_keys.h"
#include "proto/member_name.h"
#include "proto/wire/curve.h"
#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing_support::unwrapped;

std::string key_letters(char first) {
  std::string key(40, '0');
  key[0] = first;
  return key;
}

class KeyFiles : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }

  // The error, without the folder, of an allow-list.
  std::string allow_error(const std::string& text) const {
    EXPECT_TRUE(write_file(path("allow.textproto"), text));
    const auto list = read_allow_list(path("allow.textproto"));
    return list ? "" : list.error().message().substr(folder_.path().string().size() + 1);
  }

  // A deployment with keys and these nodes.
  Deployment deployment(const std::string& nodes) const {
    EXPECT_TRUE(save_calibration(path("desk.textproto"), *make_display("desk")));
    EXPECT_TRUE(write_file(
        path("wall.textproto"),
        "display: \"desk.textproto\" scene { made { name: \"plane\" } } security { keys: \"keys\" } " + nodes));
    return unwrapped(load_deployment(path("wall.textproto")));
  }

  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-keys");
};

TEST_F(KeyFiles, AKeyIsReadBackAndIsItsOwnersAlone) {
  const proto::KeyFile key = unwrapped(wire::make_key("left"));
  ASSERT_TRUE(create_key_file(path("left.key"), key));
  struct stat info {};
  ASSERT_EQ(::stat(path("left.key").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600U);
  const proto::KeyFile read = unwrapped(read_key_file(path("left.key")));
  EXPECT_EQ(read.SerializeAsString(), key.SerializeAsString());
  EXPECT_TRUE(wire::check_pair(read));
}

TEST_F(KeyFiles, NothingIsOverwritten) {
  const proto::KeyFile first = unwrapped(wire::make_key("left"));
  ASSERT_TRUE(create_key_file(path("left.key"), first));
  const Status second = create_key_file(path("left.key"), unwrapped(wire::make_key("left")));
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message(), HasSubstr("left.key: cannot be made: File exists"));
  EXPECT_EQ(unwrapped(read_key_file(path("left.key"))).public_key(), first.public_key());
}

TEST_F(KeyFiles, AKeyThatOthersCanReadOrChangeIsRefused) {
  ASSERT_TRUE(create_key_file(path("left.key"), unwrapped(wire::make_key("left"))));
  for (const mode_t mode : {0640U, 0604U, 0620U, 0602U}) {
    ASSERT_EQ(::chmod(path("left.key").c_str(), mode), 0);
    const auto key = read_key_file(path("left.key"));
    ASSERT_FALSE(key) << mode;
    EXPECT_THAT(key.error().message(), HasSubstr("open to others")) << mode;
  }
  ASSERT_EQ(::chmod(path("left.key").c_str(), 0400), 0);
  EXPECT_TRUE(read_key_file(path("left.key")));
}

TEST_F(KeyFiles, ErrorsNameTheFieldAndNeverTheKey) {
  proto::KeyFile key = unwrapped(wire::make_key("left"));
  key.set_secret_key("too short to be one");
  ASSERT_TRUE(create_key_file(path("left.key"), key));
  const auto read = read_key_file(path("left.key"));
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message(), EndsWith("left.key:5: secret_key: must be 40 letters of Z85"));
}

TEST_F(KeyFiles, APairThatIsNoneIsFound) {
  proto::KeyFile key = unwrapped(wire::make_key("left"));
  key.set_public_key(unwrapped(wire::make_key("other")).public_key());
  EXPECT_THAT(wire::check_pair(key).error().message(), HasSubstr("not that of secret_key"));
}

TEST_F(KeyFiles, AnAllowListIsReadBack) {
  const AllowList list{{{"left", key_letters('a'), {proto::Allowed::NODE}},
                        {"boss", key_letters('b'), {proto::Allowed::CONTROL, proto::Allowed::STATUS}}}};
  ASSERT_TRUE(write_allow_list(path("allow.textproto"), list));
  const AllowList read = unwrapped(read_allow_list(path("allow.textproto")));
  ASSERT_EQ(read.members.size(), 2U);
  EXPECT_EQ(read.named("left")->public_key, key_letters('a'));
  EXPECT_EQ(read.with_key(key_letters('b'))->name, "boss");
  EXPECT_EQ(rights_text(*read.named("boss")), "CONTROL, STATUS");
  EXPECT_EQ(read.with_key(key_letters('c')), nullptr);
  EXPECT_EQ(read.with_right(proto::Allowed::CONTROLLER), nullptr);
}

TEST_F(KeyFiles, AnAllowListThatCannotBeIsRefusedByItsLine) {
  const std::string a = fmt::format("allowed {{ name: \"a\" public_key: \"{}\" right: DISPLAY }}\n", key_letters('a'));
  const auto with = [&](const std::string& name, char first, const std::string& right) {
    return a + fmt::format("allowed {{ name: \"{}\"\n public_key: \"{}\"\n {} }}", name, key_letters(first), right);
  };
  EXPECT_EQ(allow_error(with("b", 'b', "right: NODE")), "");
  EXPECT_THAT(allow_error(with("a", 'b', "right: NODE")),
              StartsWith("allow.textproto:2: allowed 1: name: \"a\" is there already"));
  EXPECT_THAT(allow_error(with("b", 'a', "right: NODE")),
              StartsWith("allow.textproto:3: allowed 1: public_key: it is the key of \"a\" already"));
  EXPECT_THAT(allow_error(with("b", '\'', "right: NODE")), HasSubstr("public_key: must be 40 letters of Z85"));
  EXPECT_THAT(allow_error(with("b", 'b', "")), HasSubstr("right: at least one is needed"));
  EXPECT_THAT(allow_error(with("b", 'b', "right: NONE")), HasSubstr("right: must be NODE"));
  EXPECT_THAT(allow_error(with("b", 'b', "right: ANYTHING")), HasSubstr("ANYTHING"));
  EXPECT_THAT(allow_error(with("b", 'b', "right: DISPLAY")), HasSubstr("DISPLAY is \"a\" already; one alone"));
  EXPECT_THAT(allow_error(with("../b", 'b', "right: NODE")), HasSubstr("name: 1 to 64 letters"));
}

TEST_F(KeyFiles, AnAllowListThatOthersMayWriteToIsRefused) {
  const mode_t before = ::umask(0);
  const Status written =
      write_allow_list(path("allow.textproto"), {{{"left", key_letters('a'), {proto::Allowed::NODE}}}});
  ::umask(before);
  ASSERT_TRUE(written);
  EXPECT_TRUE(read_allow_list(path("allow.textproto"))) << "whatever the umask is";
  for (const mode_t mode : {0664U, 0646U}) {
    ASSERT_EQ(::chmod(path("allow.textproto").c_str(), mode), 0);
    const auto list = read_allow_list(path("allow.textproto"));
    ASSERT_FALSE(list) << mode;
    EXPECT_THAT(list.error().message(), HasSubstr("allow.textproto: others may write to it")) << mode;
  }
}

TEST_F(KeyFiles, FilesOfOtherUsersAreRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make files of other users";
  ASSERT_TRUE(create_key_file(path("left.key"), unwrapped(wire::make_key("left"))));
  ASSERT_TRUE(write_allow_list(path("allow.textproto"), {{{"left", key_letters('a'), {proto::Allowed::NODE}}}}));
  for (const char* const name : {"left.key", "allow.textproto"}) ASSERT_EQ(::chown(path(name).c_str(), 12345, 0), 0);
  EXPECT_THAT(read_key_file(path("left.key")).error().message(), HasSubstr("left.key: belongs to user 12345"));
  EXPECT_THAT(read_allow_list(path("allow.textproto")).error().message(), HasSubstr("belongs to user 12345"));
}

TEST_F(KeyFiles, EveryMemberGetsAKeyAndLaterTheMissingOnesAlone) {
  const auto made = unwrapped(make_keys(deployment("node { name: \"left\" }"), {}));
  EXPECT_THAT(made, ElementsAre("controller", "display", "left", "operator"));
  const AllowList before = unwrapped(read_allow_list(path("keys/allow.textproto")));
  for (const std::string& name : made) {
    const KeyRing ring = unwrapped(read_key_ring(path("keys/" + name + ".key")));
    EXPECT_EQ(ring.own.name(), name);
    EXPECT_TRUE(wire::check_pair(ring.own)) << name;
    EXPECT_EQ(before.with_key(ring.own.public_key())->name, name);
  }
  std::filesystem::remove(path("keys/left.key"));  // it went to its machine
  const Deployment larger = deployment("node { name: \"left\" } node { name: \"right\" }");
  EXPECT_THAT(unwrapped(make_keys(larger, {.operators = {"ann"}, .viewers = {"guest"}})),
              ElementsAre("ann", "guest", "right"));
  EXPECT_THAT(unwrapped(make_keys(larger, {.operators = {"ann"}, .viewers = {}})), IsEmpty());
  const AllowList after = unwrapped(read_allow_list(path("keys/allow.textproto")));
  EXPECT_EQ(after.members.size(), 7U);
  for (const Allowed& member : before.members) EXPECT_EQ(after.named(member.name)->public_key, member.public_key);
  EXPECT_FALSE(std::filesystem::exists(path("keys/left.key")));
  EXPECT_TRUE(after.named("ann")->has(proto::Allowed::CONTROL));
  EXPECT_TRUE(after.named("guest")->has(proto::Allowed::STATUS));
  EXPECT_FALSE(after.named("guest")->has(proto::Allowed::CONTROL));
}

TEST_F(KeyFiles, NoNameIsThatOfTwoMembersAndNoKeyOfNobodyIsTaken) {
  const auto refusal = [](const Result<std::vector<std::string>>& made) { return made ? "" : made.error().message(); };
  EXPECT_THAT(refusal(make_keys(deployment("node { name: \"left\" }"), {.operators = {"display"}, .viewers = {}})),
              HasSubstr("\"display\" is the name of two members: DISPLAY and CONTROL"));
  EXPECT_THAT(refusal(make_keys(deployment("node { name: \"left\" }"), {.operators = {"left"}, .viewers = {}})),
              HasSubstr("\"left\" is the name of two members"));
  std::filesystem::create_directories(path("keys"));
  ASSERT_TRUE(create_key_file(path("keys/left.key"), unwrapped(wire::make_key("left"))));
  EXPECT_THAT(refusal(make_keys(deployment("node { name: \"left\" }"), {})), HasSubstr("left.key: is there, and"));
}

TEST_F(KeyFiles, NoNameLeadsOutOfTheFolder) {
  const Deployment wall = deployment("node { name: \"left\" }");
  for (const std::string& name :
       {std::string("../evil"), path("evil").string(), std::string("a b"), std::string("\xc3\xa9"), std::string("a\nb"),
        std::string("a\"b"), std::string(), std::string("."), std::string(".."), std::string(300, 'a')}) {
    for (const KeyHolders& people : {KeyHolders{{name}, {}}, KeyHolders{{"ann"}, {name}}}) {
      const auto made = make_keys(wall, people);
      ASSERT_FALSE(made) << name;
      EXPECT_THAT(made.error().message(), HasSubstr("1 to 64 letters, digits, '.', '-' and '_' are possible")) << name;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(path("keys"))) << "nothing is written";
  for (const std::string& name : {std::string("..."), std::string("a.b-c_1"), std::string(64, 'a')})
    EXPECT_TRUE(check_member_name(name)) << name;
  EXPECT_THAT(allow_error(fmt::format("allowed {{ name: \"..\" public_key: \"{}\" right: NODE }}", key_letters('a'))),
              HasSubstr("name: 1 to 64 letters"));
}

// Several rounds, since without a lock one of them may be lucky.
TEST_F(KeyFiles, WhoeverMakesKeysAtTheSameTimeMakesOneSet) {
  const Deployment wall = deployment("node { name: \"left\" } node { name: \"right\" }");
  for (int round = 0; round < 10; ++round) {
    std::filesystem::remove_all(path("keys"));
    std::atomic<int> made = 0, failed = 0;
    {
      std::vector<std::jthread> people;
      for (const char* const name : {"ann", "bob", "eve", "joe"})
        people.emplace_back([&, name] {
          const auto keys = make_keys(wall, {.operators = {name}, .viewers = {}});
          keys ? made += static_cast<int>(keys->size()) : ++failed;
        });
    }
    EXPECT_EQ(failed, 0);
    EXPECT_EQ(made, 8) << "controller, display, two nodes, four operators, each once";
    const AllowList list = unwrapped(read_allow_list(path("keys/allow.textproto")));
    EXPECT_EQ(list.members.size(), 8U);
    for (const Allowed& member : list.members)
      EXPECT_EQ(unwrapped(read_key_file(path("keys/" + member.name + ".key"))).public_key(), member.public_key);
    const std::filesystem::directory_iterator files(path("keys"));
    EXPECT_EQ(std::distance(begin(files), end(files)), 9) << "no lock is left";
  }
}

TEST_F(KeyFiles, AKeyIsHeldAgainstTheListBesideIt) {
  ASSERT_TRUE(make_keys(deployment("node { name: \"left\" } node { name: \"right\" }"), {{"ann"}, {}}));
  const auto refusal = [&](const std::string& key, Right right, std::string_view name = {}) {
    const Status held = check_key_holder(path("keys/" + key + ".key"), right, name);
    return held ? "" : held.error().message().substr(folder_.path().string().size() + 1);
  };
  EXPECT_EQ(refusal("left", proto::Allowed::NODE, "left"), "");
  EXPECT_EQ(refusal("right", proto::Allowed::NODE, "left"),
            "keys/right.key: the key of \"right\" is not that of \"left\"");
  EXPECT_EQ(refusal("ann", proto::Allowed::CONTROLLER), "keys/ann.key: the key of \"ann\" has no right CONTROLLER");
  EXPECT_EQ(refusal("controller", proto::Allowed::CONTROLLER), "");
  ASSERT_TRUE(create_key_file(path("keys/new.key"), unwrapped(wire::make_key("new"))));
  EXPECT_EQ(refusal("new", proto::Allowed::NODE, "left"), "") << "it may be listed later";
  EXPECT_THAT(refusal("new", proto::Allowed::CONTROLLER), HasSubstr("the key is not in allow.textproto"));
  EXPECT_TRUE(check_key_holder("", proto::Allowed::NODE, "left"));
}

TEST_F(KeyFiles, AProgramTakesTheKeyOfItsNameUnlessAnotherIsGiven) {
  Deployment wall = deployment("node { name: \"left\" }");
  EXPECT_EQ(unwrapped(choose_key_file(wall, "", "left")), path("keys/left.key"));
  EXPECT_EQ(unwrapped(choose_key_file(wall, "mine.key", "left")), "mine.key");
  wall.message.clear_security();
  EXPECT_EQ(unwrapped(choose_key_file(wall, "", "left")), "");
  EXPECT_FALSE(choose_key_file(wall, "mine.key", "left"));
}

TEST_F(KeyFiles, TheOperatorIsWhoseKeyIsThere) {
  ASSERT_TRUE(make_keys(deployment("node { name: \"left\" }"), {.operators = {"ann", "bob"}, .viewers = {"eve"}}));
  EXPECT_EQ(unwrapped(find_operator_key(path("keys"))), path("keys/ann.key"));
  std::filesystem::remove(path("keys/ann.key"));
  EXPECT_EQ(unwrapped(find_operator_key(path("keys"))), path("keys/bob.key"));
  std::filesystem::remove(path("keys/bob.key"));
  EXPECT_THAT(find_operator_key(path("keys")).error().message(),
              HasSubstr("`lfd keys make DEPLOYMENT --operator NAME` makes one"));
  EXPECT_THAT(unwrapped(keys_elsewhere(path("keys"))), ElementsAre("ann", "bob"));
}

}  // namespace
}  // namespace lfd
