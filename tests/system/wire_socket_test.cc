// Sockets over the real loopback interface: what arrives, what is refused, and who is told.
#include "proto/wire/socket.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>
#include <zmq.hpp>

#include "base/log.h"
#include "base/version.h"
#include "proto/wire/poll.h"

namespace lfd::wire {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr const char* kAnyPort = "tcp://127.0.0.1:*";

template <class T>
T ok(Result<T> result) {
  EXPECT_TRUE(result) << (result ? "" : result.error().message());
  return std::move(*result);
}

proto::Envelope heartbeat(const std::string& hash) {
  proto::Envelope envelope;
  envelope.mutable_heartbeat()->set_state_hash(hash);
  return envelope;
}

std::optional<Message> next(Socket& socket, Clock::duration at_most = 30s) {
  const auto until = Clock::now() + at_most;
  for (;;) {
    if (auto message = socket.receive()) return message;
    const auto left = until - Clock::now();
    if (left <= 0s) return std::nullopt;
    wait({&socket}, {}, left);
  }
}

// A dealer keeps nothing for a peer it has not reached yet: try until it has.
void send_when_connected(Socket& dealer, const proto::Envelope& envelope, const Payload& payload = {}) {
  const auto until = Clock::now() + 30s;
  while (!dealer.send(envelope, payload)) {
    ASSERT_LT(Clock::now(), until) << "never connected";
    wait({&dealer}, {}, 5ms);
  }
}

TEST(WireSocket, CarriesEnvelopesAndPayloadsBothWays) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort));
  EXPECT_THAT(router.endpoint(), testing::MatchesRegex("tcp://127\\.0\\.0\\.1:[0-9]+"));
  Socket dealer = ok(connect_dealer(context, router.endpoint()));
  send_when_connected(dealer, heartbeat("one"));
  const auto plain = next(router);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->envelope.heartbeat().state_hash(), "one");
  EXPECT_EQ(plain->envelope.protocol(), kProtocolVersion);
  EXPECT_TRUE(plain->payload.empty());
  EXPECT_FALSE(plain->peer.empty());
  ASSERT_TRUE(router.send_to(plain->peer, heartbeat("two"), Payload(std::make_shared<const std::string>("bytes"))));
  const auto answer = next(dealer);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->envelope.heartbeat().state_hash(), "two");
  EXPECT_EQ(answer->payload.text(), "bytes");
}

TEST(WireSocket, SendsLargePayloadsWithoutCopyAndLetsThemGo) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort, kImages));
  Socket dealer = ok(connect_dealer(context, router.endpoint(), kImages));
  auto pixels = std::make_shared<std::vector<std::uint32_t>>(1 << 20);
  std::iota(pixels->begin(), pixels->end(), 0u);
  send_when_connected(dealer, heartbeat("image"), Payload(pixels, std::as_bytes(std::span(*pixels))));
  const auto message = next(router);
  ASSERT_TRUE(message);
  ASSERT_EQ(message->payload.size(), pixels->size() * 4);
  EXPECT_EQ(std::memcmp(message->payload.bytes().data(), pixels->data(), message->payload.size()), 0);
  for (int i = 0; i < 30000 && pixels.use_count() > 1; ++i) wait({&dealer}, {}, 1ms);
  EXPECT_EQ(pixels.use_count(), 1) << "the transport still holds the payload";
}

TEST(WireSocket, DealerKeepsNothingForAPeerThatIsAway) {
  Context context;
  Socket dealer = ok(connect_dealer(context, "tcp://127.0.0.1:1"));
  const Status status = dealer.send(heartbeat("lost"));
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message(), HasSubstr("tcp://127.0.0.1:1: not connected"));
}

TEST(WireSocket, UnknownPeerIsAnError) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort));
  const Status status = router.send_to("nobody", heartbeat("x"));
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message(), HasSubstr("no such peer"));
}

TEST(WireSocket, RouterThatIsNotReadRefusesFurtherMessagesToThePeerInsteadOfGrowing) {
  Context context;
  constexpr Limits kTiny{1 << 20, 2};
  Socket router = ok(bind_router(context, kAnyPort, kTiny));
  Socket dealer = ok(connect_dealer(context, router.endpoint(), kTiny));
  send_when_connected(dealer, heartbeat("hello"));
  const auto hello = next(router);
  ASSERT_TRUE(hello);
  // Far more than the kernel's own buffers and both queues hold.
  const Payload megabyte(std::make_shared<const std::string>(1 << 20, 'x'));
  int taken = 0;
  while (taken < 1000 && router.send_to(hello->peer, heartbeat("fill"), megabyte)) ++taken;
  EXPECT_LT(taken, 1000);
}

TEST(WireSocket, RefusesToSendMoreThanItsLimit) {
  Context context;
  Socket dealer = ok(connect_dealer(context, "tcp://127.0.0.1:1", Limits{1000, 10}));
  const Status status = dealer.send(heartbeat("x"), Payload(std::make_shared<const std::string>(1001, 'x')));
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message(), HasSubstr("1001 bytes are too many to send; at most 1000 go"));
}

TEST(WireSocket, OversizedMessagesDoNotArriveAndOtherPeersGoOn) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort, Limits{10000, 10}));
  Socket rude = ok(connect_dealer(context, router.endpoint(), Limits{1 << 20, 10}));
  Socket polite = ok(connect_dealer(context, router.endpoint(), Limits{10000, 10}));
  send_when_connected(rude, heartbeat("too large"), Payload(std::make_shared<const std::string>(20000, 'x')));
  send_when_connected(polite, heartbeat("fine"), Payload(std::make_shared<const std::string>(10000, 'x')));
  const auto message = next(router);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->envelope.heartbeat().state_hash(), "fine");
  EXPECT_FALSE(next(router, 200ms));
}

TEST(WireSocket, AnotherProtocolVersionIsCountedAndBothSidesLearnWhy) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort));
  Socket dealer = ok(connect_dealer(context, router.endpoint()));
  proto::Envelope foreign = heartbeat("from the future");
  foreign.set_protocol(kProtocolVersion + 1);
  send_when_connected(dealer, foreign);
  for (int i = 0; i < 3000 && router.refused() == 0; ++i) EXPECT_FALSE(next(router, 10ms));
  const auto answer = next(dealer);
  ASSERT_TRUE(answer);
  EXPECT_THAT(answer->envelope.refused().reason(),
              HasSubstr(fmt::format("protocol {} is refused", kProtocolVersion + 1)));
  EXPECT_FALSE(router.receive());
  send_when_connected(dealer, heartbeat("now"));
  ASSERT_TRUE(next(router));
  EXPECT_EQ(router.refused(), 1u);
}

TEST(WireSocket, RefusedIsReceivedWhateverItsVersion) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort));
  Socket dealer = ok(connect_dealer(context, router.endpoint()));
  proto::Envelope refused;
  refused.set_protocol(kProtocolVersion + 7);
  refused.mutable_refused()->set_reason("too old");
  send_when_connected(dealer, refused);
  const auto message = next(router);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->envelope.refused().reason(), "too old");
}

TEST(WireSocket, ForeignBytesAreCountedAndLeftOut) {
  Context context;
  Socket router = ok(bind_router(context, kAnyPort));
  zmq::context_t foreign_context;
  zmq::socket_t foreign(foreign_context, zmq::socket_type::dealer);
  foreign.set(zmq::sockopt::linger, 0);
  foreign.connect(router.endpoint());
  foreign.send(zmq::str_buffer("\xff\xff not an envelope"), zmq::send_flags::none);
  for (int part = 0; part < 7; ++part) {
    foreign.send(zmq::str_buffer("part"), part < 6 ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
  foreign.send(zmq::message_t(), zmq::send_flags::none);  // an envelope of protocol 0
  testing::internal::CaptureStderr();
  foreign.send(zmq::str_buffer("\x22\x03\x0a\x01\xff"), zmq::send_flags::none);  // a hash that is no UTF-8
  Socket dealer = ok(connect_dealer(context, router.endpoint()));
  const auto until = Clock::now() + 30s;
  while (router.refused() < 4 && Clock::now() < until) EXPECT_FALSE(next(router, 10ms));
  EXPECT_EQ(router.refused(), 4u);
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("libprotobuf"), std::string::npos) << "strangers fill no logs";
  send_when_connected(dealer, heartbeat("still alive"));
  EXPECT_TRUE(next(router));
}

// Publishes until the subscriber hears it: what is published before the subscription arrives is lost by nature.
void subscribe_fully(Socket& publisher, Socket& subscriber) {
  const auto until = Clock::now() + 30s;
  do {
    ASSERT_LT(Clock::now(), until);
    ASSERT_TRUE(publisher.send(heartbeat("hello")));
  } while (!next(subscriber, 5ms));
  while (next(subscriber, 50ms)) {
  }
}

TEST(WireSocket, SlowSubscriberLosesMessagesAloneAndThePublisherKnows) {
  Context context;
  constexpr Limits kTiny{1 << 20, 2};
  Socket publisher = ok(bind_publisher(context, kAnyPort, kTiny));
  Socket slow = ok(connect_subscriber(context, publisher.endpoint(), kTiny));
  Socket quick = ok(connect_subscriber(context, publisher.endpoint(), Limits{1 << 20, 10000}));
  subscribe_fully(publisher, slow);
  subscribe_fully(publisher, quick);
  while (slow.receive()) {
  }
  const Payload large(std::make_shared<const std::string>(1 << 20, 'x'));
  for (std::uint64_t frame = 1; frame <= 100; ++frame) {
    proto::Envelope begin;
    begin.mutable_begin()->set_frame(frame);
    ASSERT_TRUE(publisher.send(begin, large));
    const auto message = next(quick);
    ASSERT_TRUE(message);
    ASSERT_EQ(message->envelope.begin().frame(), frame) << "the quick subscriber lost one";
  }
  EXPECT_GT(publisher.lost(), 0u);
}

TEST(WireSocket, BindErrorNamesEndpointAndOwnerOfThePort) {
  Context context;
  const Socket first = ok(bind_router(context, kAnyPort));
  const auto second = bind_router(context, first.endpoint());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message(),
            fmt::format("{}: the address is in use by process {} (lfd-test-system)", first.endpoint(), ::getpid()));
}

TEST(WireSocket, IpcPathIsNotTakenFromItsOwnerAndIsRemovedAtTheEnd) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("lfd-wire-test-{}.ipc", ::getpid());
  const std::string endpoint = "ipc://" + path.string();
  {
    Context context;
    Socket first = ok(bind_router(context, endpoint));
    EXPECT_TRUE(std::filesystem::exists(path));
    const auto second = bind_router(context, endpoint);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message(),
              fmt::format("{}: the address is in use by process {} (lfd-test-system)", endpoint, ::getpid()));
    Socket dealer = ok(connect_dealer(context, endpoint));
    send_when_connected(dealer, heartbeat("over a file"));
    EXPECT_TRUE(next(first));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(WireSocket, BadEndpointsAreErrorsThatNameThem) {
  Context context;
  for (const std::string endpoint :
       {"", "nonsense", "udp://1.2.3.4:5", "tcp://127.0.0.1:99999", "tcp://no.such.interface:5"}) {
    const auto socket = bind_router(context, endpoint);
    ASSERT_FALSE(socket) << endpoint;
    EXPECT_THAT(socket.error().message(), HasSubstr(endpoint));
  }
}

TEST(WireSocket, LastWordsLeaveWithinTheLingerTime) {
  Context receiving;
  Socket router = ok(bind_router(receiving, kAnyPort));
  {
    Context context;
    Socket dealer = ok(connect_dealer(context, router.endpoint()));
    dealer.linger(5s);
    send_when_connected(dealer, heartbeat("farewell"), Payload(std::make_shared<const std::string>(10 << 20, 'x')));
  }
  const auto message = next(router);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->envelope.heartbeat().state_hash(), "farewell");
}

}  // namespace
}  // namespace lfd::wire
