// Sockets with keys over the real loopback interface: who is heard, who is not, and what each side learns of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "base/log.h"
#include "base/temporary_folder.h"
#include "base/version.h"
#include "proto/wire/curve.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "tests/support/unwrapped.h"
#include "tests/system/raw_peer.h"

namespace lfd::wire {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::unwrapped;

constexpr auto kPatience = 30s;
constexpr auto kSilence = 300ms;  // after which nothing comes any more of what was sent to this machine itself

// The keys of a controller, a display, two nodes and one whom nobody knows.
class WireKeys : public testing::TestWithParam<const char*> {
 protected:
  WireKeys() {
    add("controller", proto::Allowed::CONTROLLER);
    add("display", proto::Allowed::DISPLAY);
    add("left", proto::Allowed::NODE);
    add("boss", proto::Allowed::CONTROL);
    keys_["stranger"] = unwrapped(make_key("stranger"));
  }

  void add(const std::string& name, Right right) {
    keys_[name] = unwrapped(make_key(name));
    allowed_.members.push_back({name, keys_[name].public_key(), {right}});
  }

  KeyRing ring(const std::string& name) const { return {keys_.at(name), allowed_}; }

  std::string place() const {
    return std::string(GetParam()) == "ipc" ? "ipc://" + (folder_.path() / "socket").string() : "tcp://127.0.0.1:*";
  }

  std::map<std::string, proto::KeyFile> keys_;
  AllowList allowed_;
  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-wire");
};

INSTANTIATE_TEST_SUITE_P(Over, WireKeys, testing::Values("tcp", "ipc"),
                         [](const auto& test) { return std::string(test.param); });

proto::Envelope words(const std::string& text) {
  proto::Envelope envelope;
  envelope.mutable_heartbeat()->set_state_hash(text);
  return envelope;
}

// Sends until it has gone and something has arrived, or until nothing more is to be expected.
std::optional<Message> carried(Socket& dealer, Socket& router, Clock::duration at_most, const Payload& payload = {}) {
  const auto until = Clock::now() + at_most;
  bool sent = false;
  while (Clock::now() < until) {
    if (!sent) sent = static_cast<bool>(dealer.send(words("hello"), payload));
    if (auto message = router.receive()) return message;
    wait({&router, &dealer}, {}, 10ms);
  }
  return std::nullopt;
}

// Waits until the dealer knows why it is not connected.
std::string trouble_of(Socket& dealer, Socket& router) {
  const auto until = Clock::now() + kPatience;
  while (dealer.trouble().empty() && Clock::now() < until) {
    [[maybe_unused]] const Status sent = dealer.send(words("hello"));
    EXPECT_FALSE(router.receive());
    wait({&router}, {}, 10ms);
  }
  return dealer.trouble();
}

TEST_P(WireKeys, WhoIsListedIsHeardUnderItsName) {
  Context server(ring("controller")), client(ring("left"));
  Socket router = unwrapped(bind_router(server, place()));
  Socket dealer = unwrapped(connect_dealer(client, router.endpoint()));
  const auto message = carried(dealer, router, kPatience);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->user, "left");
  EXPECT_EQ(message->envelope.heartbeat().state_hash(), "hello");
  ASSERT_TRUE(router.send_to(message->peer, words("answer")));
  std::optional<Message> answer;
  for (int i = 0; i < 3000 && !answer; ++i) {
    wait({&dealer}, {}, 10ms);
    answer = dealer.receive();
  }
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->user, "") << "the listener is known by its key";
  EXPECT_THAT(dealer.trouble(), IsEmpty());
}

TEST_P(WireKeys, ThePayloadPathKeepsTheNameAndTakesTheLargestParts) {
  Context server(ring("controller")), client(ring("left"));
  Socket router = unwrapped(bind_router(server, place(), kChunks));
  Socket dealer = unwrapped(connect_dealer(client, router.endpoint(), kChunks));
  const auto message =
      carried(dealer, router, kPatience, Payload(std::make_shared<const std::string>(kChunk_bytes, 'x')));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->user, "left");
  EXPECT_EQ(message->payload.size(), kChunk_bytes);
}

TEST_P(WireKeys, AKeyThatIsNotListedIsRefusedAndLearnsIt) {
  Context server(ring("controller")), client(ring("stranger"));
  Socket router = unwrapped(bind_router(server, place()));
  Socket dealer = unwrapped(connect_dealer(client, router.endpoint()));
  EXPECT_THAT(trouble_of(dealer, router), HasSubstr("the key is refused"));
  EXPECT_FALSE(carried(dealer, router, kSilence));
  // The same key, listed.
  allowed_.members.push_back({"friend", keys_["stranger"].public_key(), {proto::Allowed::STATUS}});
  Context other(ring("controller"));
  Socket second = unwrapped(bind_router(other, "tcp://127.0.0.1:*"));
  Socket welcome = unwrapped(connect_dealer(client, second.endpoint()));
  const auto message = carried(welcome, second, kPatience);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->user, "friend");
}

TEST_P(WireKeys, AtTheDisplayOnlyNodesAreHeard) {
  Context server(ring("display")), boss(ring("boss")), left(ring("left"));
  Socket router = unwrapped(bind_router(server, place(), kImages, Listener::kDisplay));
  Socket refused = unwrapped(connect_dealer(boss, router.endpoint(), kImages, Listener::kDisplay));
  EXPECT_THAT(trouble_of(refused, router), HasSubstr("the key is refused"));
  Socket dealer = unwrapped(connect_dealer(left, router.endpoint(), kImages, Listener::kDisplay));
  const auto message = carried(dealer, router, kPatience);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->user, "left");
}

TEST_P(WireKeys, AListenerWithAnotherKeyIsNotSpokenTo) {
  allowed_.members[0].public_key = keys_["stranger"].public_key();  // whom the client takes for the controller
  Context client(ring("left"));
  allowed_.members[0].public_key = keys_["controller"].public_key();
  Context server(ring("controller"));
  Socket router = unwrapped(bind_router(server, place()));
  Socket dealer = unwrapped(connect_dealer(client, router.endpoint()));
  EXPECT_THAT(trouble_of(dealer, router), HasSubstr("another than the allow-list names"));
  EXPECT_FALSE(carried(dealer, router, kSilence));
}

TEST_P(WireKeys, WithAndWithoutKeysDoNotMix) {
  Context keyed_server(ring("controller")), plain, keyed(ring("left"));
  Socket router = unwrapped(bind_router(keyed_server, place()));
  Socket dealer = unwrapped(connect_dealer(plain, router.endpoint()));
  EXPECT_THAT(trouble_of(dealer, router), HasSubstr("one side works with keys, the other without"));
  Socket open_router = unwrapped(bind_router(plain, "tcp://127.0.0.1:*"));
  Socket wary = unwrapped(connect_dealer(keyed, open_router.endpoint()));
  EXPECT_THAT(trouble_of(wary, open_router),
              AnyOf(HasSubstr("one side works with keys, the other without"), HasSubstr("the listener has no key")));
}

TEST_P(WireKeys, WhatIsPublishedReachesMembersAlone) {
  Context server(ring("controller")), left(ring("left")), stranger(ring("stranger")), plain;
  Socket publisher = unwrapped(bind_publisher(server, place(), kUpdates));
  Socket member = unwrapped(connect_subscriber(left, publisher.endpoint()));
  Socket unknown = unwrapped(connect_subscriber(stranger, publisher.endpoint()));
  Socket keyless = unwrapped(connect_subscriber(plain, publisher.endpoint()));
  const auto until = Clock::now() + kPatience;
  int heard = 0;
  while (heard < 20 && Clock::now() < until) {
    ASSERT_TRUE(publisher.send(words("news")));
    wait({&member}, {}, 20ms);
    while (member.receive()) ++heard;
  }
  EXPECT_GE(heard, 20);
  EXPECT_FALSE(unknown.receive());
  EXPECT_FALSE(keyless.receive());
}

TEST_P(WireKeys, WithoutTheListenersKeyNothingIsConnected) {
  allowed_.members.erase(allowed_.members.begin());
  Context client(ring("left"));
  const auto dealer = connect_dealer(client, "tcp://127.0.0.1:1");
  ASSERT_FALSE(dealer);
  EXPECT_THAT(dealer.error().message(), HasSubstr("allow.textproto has nobody with right CONTROLLER"));
}

// A plain peer may call itself anything in its greeting; nobody is to believe it.
TEST(WirePlain, WhatAPeerSaysOfItselfMakesItNoUser) {
  Context context;
  Socket router = unwrapped(bind_router(context, "tcp://127.0.0.1:*"));
  harness::RawPeer peer(router.endpoint());
  ASSERT_TRUE(peer.shake_hands({{"Socket-Type", "DEALER"}, {"Identity", ""}, {"User-Id", "left"}}));
  proto::Envelope envelope = words("hello");
  envelope.set_protocol(kProtocolVersion);
  peer.send_frame(envelope.SerializeAsString());
  std::optional<Message> message;
  for (int i = 0; i < 3000 && !message; ++i) {
    wait({&router}, {}, 10ms);
    message = router.receive();
  }
  ASSERT_TRUE(message);
  EXPECT_EQ(message->user, "");
}

TEST(WirePlain, OfStrangersOnlyShortEnvelopesAreRead) {
  Context context;
  Socket router = unwrapped(bind_router(context, "tcp://127.0.0.1:*"));
  Socket dealer = unwrapped(connect_dealer(context, router.endpoint()));
  const auto first = carried(dealer, router, kPatience);
  ASSERT_TRUE(first);
  const auto take = [&](const proto::Envelope& envelope, bool is_known) {
    EXPECT_TRUE(dealer.send(envelope));
    EXPECT_TRUE(dealer.send(words("end")));
    std::vector<std::string> texts;
    for (int i = 0; i < 3000 && (texts.empty() || texts.back() != "end"); ++i) {
      wait({&router}, {}, 10ms);
      const auto message = router.receive([&](const std::string& peer) { return is_known && peer == first->peer; });
      if (message) texts.push_back(message->envelope.heartbeat().state_hash());
    }
    return texts.size();
  };
  const proto::Envelope is_long = words(std::string(static_cast<std::size_t>(kShort_bytes) + 1, 'x'));
  EXPECT_EQ(take(is_long, false), 1U);
  EXPECT_EQ(router.refused(), 1U);
  EXPECT_EQ(take(is_long, true), 2U);
  EXPECT_EQ(take(words("short"), false), 2U);
}

}  // namespace
}  // namespace lfd::wire
