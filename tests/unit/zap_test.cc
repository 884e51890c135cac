// Who is let in at which door, and what a request must be like.
#include "proto/wire/zap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "proto/wire/curve.h"

namespace lfd::wire {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Request = std::vector<std::string>;

// 32 bytes that nobody makes by accident.
std::string key_bytes(char first) {
  std::string key(32, '\7');
  key[0] = first;
  return key;
}

AllowList everybody() {
  using proto::Allowed;
  AllowList list;
  for (const auto& [name, right] : {std::pair{"node", Allowed::NODE},
                                    {"display", Allowed::DISPLAY},
                                    {"boss", Allowed::CONTROL},
                                    {"viewer", Allowed::STATUS},
                                    {"controller", Allowed::CONTROLLER}})
    list.members.push_back({name, z85_of(key_bytes(name[0])), {right}});
  return list;
}

Request request(Listener listener, const std::string& key) {
  return {"1.0", "7", zap_domain(listener), "10.0.0.9", "", "CURVE", key};
}

TEST(Zap, LetsInWhoIsListedAndSaysItsName) {
  for (const char* const name : {"node", "display", "boss", "viewer"}) {
    const ZapAnswer answer = answer_zap(request(Listener::kController, key_bytes(name[0])), everybody());
    EXPECT_THAT(answer.frames, ElementsAre("1.0", "7", "200", "OK", name, ""));
    EXPECT_THAT(answer.refusal, IsEmpty());
  }
}

TEST(Zap, RefusesWhoIsNotListed) {
  const ZapAnswer answer = answer_zap(request(Listener::kController, key_bytes('?')), everybody());
  EXPECT_THAT(answer.frames, ElementsAre("1.0", "7", "400", "refused", "", ""));
  EXPECT_THAT(answer.refusal, HasSubstr("10.0.0.9: the key " + z85_of(key_bytes('?')) + " is not in allow.textproto"));
  EXPECT_EQ(answer_zap(request(Listener::kController, key_bytes('n')), {}).frames[2], "400");
}

TEST(Zap, TheDisplayLetsInNodesAlone) {
  EXPECT_EQ(answer_zap(request(Listener::kDisplay, key_bytes('n')), everybody()).frames[2], "200");
  for (const char first : {'d', 'b', 'v', 'c'})
    EXPECT_EQ(answer_zap(request(Listener::kDisplay, key_bytes(first)), everybody()).frames[2], "400") << first;
  EXPECT_EQ(answer_zap(request(Listener::kController, key_bytes('c')), everybody()).frames[2], "400");
}

TEST(Zap, RefusesWhatIsNoRequestForAKey) {
  const Request good = request(Listener::kController, key_bytes('n'));
  std::vector<Request> bad{{}, {"1.0"}, good, good, good, good, good, good};
  bad[2][0] = "2.0";
  bad[3][5] = "NULL";
  bad[4][5] = "PLAIN";
  bad[5][6].pop_back();
  bad[6].push_back("more");
  bad[7][2] = "";  // of no domain of ours
  for (const Request& one : bad)
    EXPECT_EQ(answer_zap(one, everybody()).frames[2], "400") << testing::PrintToString(one);
}

TEST(Zap, LettersStandForBytes) {
  // Bytes and letters that the specification of Z85 shows, four times.
  const std::string eight("\x86\x4F\xD2\x6F\xB5\x59\xF7\x5B", 8);
  EXPECT_EQ(z85_of(eight + eight + eight + eight), "HelloWorldHelloWorldHelloWorldHelloWorld");
  EXPECT_EQ(z85_of("short"), "");
}

}  // namespace
}  // namespace lfd::wire
