// A controller that is asked for more than it can give, without end, by who never reads an answer: its memory and its
// log stay bounded, heartbeats go on, and it ends when it is told to.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <fstream>
#include <thread>
#include <zmq.hpp>

#include "base/file.h"
#include "base/log.h"
#include "base/version.h"
#include "bench/common/process_facts.h"
#include "proto/wire/poll.h"
#include "tests/harness/workbench.h"
#include "tests/support/unwrapped.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

constexpr int kPeers = 8;
constexpr auto kHeartbeat = 500ms;

std::string text_of(proto::Envelope envelope) {
  envelope.set_protocol(kProtocolVersion);
  return envelope.SerializeAsString();
}

std::string request_text(const std::function<void(proto::Request&)>& fill) {
  proto::Envelope envelope;
  fill(*envelope.mutable_request());
  return text_of(envelope);
}

// Peers that send one message without end until they are destroyed.
class Flood {
 public:
  Flood(const std::string& endpoint, const std::string& message) {
    for (int i = 0; i < kPeers; ++i) {
      zmq::socket_t& socket = sockets_.emplace_back(context_, zmq::socket_type::dealer);
      socket.set(zmq::sockopt::linger, 0);
      socket.set(zmq::sockopt::rcvhwm, 1);
      socket.connect(endpoint);
    }
    thread_ = std::thread([this, message] {
      while (!ended_) {
        bool any = false;
        for (zmq::socket_t& socket : sockets_) {
          const bool sent = socket.send(zmq::buffer(message), zmq::send_flags::dontwait).has_value();
          any = any || sent;
          if (sent) ++sent_;
        }
        if (!any) std::this_thread::sleep_for(1ms);
      }
    });
  }
  ~Flood() {
    ended_ = true;
    thread_.join();
  }
  std::uint64_t sent() const { return sent_; }

 private:
  zmq::context_t context_;
  std::vector<zmq::socket_t> sockets_;
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> sent_{0};
  std::thread thread_;
};

// The same triangle again and again: a state of about 2 MiB.
std::filesystem::path scene_of_many(const std::filesystem::path& folder) {
  std::string nodes, roots;
  for (int i = 0; i < 10'000; ++i) {
    const char* const comma = i == 0 ? "" : ",";
    nodes += fmt::format("{}{{\"mesh\":0,\"translation\":[{},{},0]}}", comma, i % 100, i / 100);
    roots += fmt::format("{}{}", comma, i);
  }
  const std::string text = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],\"nodes\":[{}],"
      "\"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}],"
      "\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
      "\"min\":[0,0,0],\"max\":[1,1,0]}}],\"bufferViews\":[{{\"buffer\":0,\"byteLength\":36}}],"
      "\"buffers\":[{{\"byteLength\":36,\"uri\":\"triangle.bin\"}}]}}",
      roots, nodes);
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  EXPECT_TRUE(write_file(folder / "triangle.bin", {reinterpret_cast<const char*>(corners), sizeof(corners)}));
  EXPECT_TRUE(write_file(folder / "many.gltf", text));
  return folder / "many.gltf";
}

class HostileFlood : public testing::Test {
 protected:
  HostileFlood() {
    const auto deployment =
        bench_.deployment(fmt::format("pacing {{ heartbeat_ms: {} }} addresses {{ bulk: \"tcp://127.0.0.1:{}\" }}",
                                      std::chrono::milliseconds(kHeartbeat).count(), bulk_port_));
    controller_.emplace(start_controller(deployment, {"--scene", scene_of_many(bench_.folder()).string()}));
    proto::Request follow;
    follow.mutable_follow();
    ControlClient client = unwrapped(ControlClient::connect(controller_->endpoint));
    for (const auto until = Clock::now() + kClusterPatience; Clock::now() < until; std::this_thread::sleep_for(20ms)) {
      const auto reply = client.ask(follow, kClusterPatience);
      if (!reply) continue;
      follow_ = reply->follow();
      break;
    }
    before_mib_ = memory_mib();
  }

  double memory_mib() const { return bench::facts_of(controller_->process->id())->resident_mib; }

  // How long the controller is silent at most while this lasts.
  Clock::duration longest_silence(Clock::duration lasts) {
    const auto context = unwrapped(wire::open_context(""));
    wire::Socket state = unwrapped(wire::connect_subscriber(*context, follow_.state_endpoint()));
    auto last = Clock::now();
    Clock::duration longest{};
    for (const auto until = last + lasts; Clock::now() < until;) {
      wire::wait({&state}, {}, 20ms);
      bool any = false;
      while (state.receive()) any = true;
      longest = std::max(longest, Clock::now() - last);
      if (any) last = Clock::now();
    }
    return longest;
  }

  // It goes on within the patience of nodes, six heartbeats, and ends in the time that is promised of it: 2 s, and the
  // second that last words may take.
  void expect_undisturbed() {
    EXPECT_LT(longest_silence(4s), 6 * kHeartbeat);
    EXPECT_LT(controller_->process->lines().size(), 200U);
    controller_->process->signal(SIGTERM);
    const auto exit = controller_->process->wait(3s);
    EXPECT_TRUE(exit && exit->succeeded());
  }

  const Workbench bench_;
  const int bulk_port_ = free_port();
  std::optional<RunningController> controller_;
  proto::Follow follow_;
  double before_mib_ = 0;
};

TEST_F(HostileFlood, OfWhoWantsTheStateAndDoesNotReadIt) {
  ASSERT_GT(follow_.snapshot().ByteSizeLong(), std::size_t{1} << 20) << "or a flood would ask for little";
  ASSERT_EQ(follow_.snapshot().state().scene().instance_size(), 10'000);
  const Flood flood(controller_->endpoint, request_text([](proto::Request& r) { r.mutable_follow(); }));
  std::this_thread::sleep_for(4s);
  EXPECT_GT(flood.sent(), 1000U);
  // What may be out at once, one state more, the copies of one in the making, and what the allocator keeps of them.
  EXPECT_LT(memory_mib(), before_mib_ + 128);
  expect_undisturbed();
}

TEST_F(HostileFlood, OfRequests) {
  const Flood flood(controller_->endpoint, request_text([](proto::Request& r) { r.mutable_status(); }));
  expect_undisturbed();
  EXPECT_GT(flood.sent(), 1000U);
}

TEST_F(HostileFlood, OfWantsAndOfJoins) {
  proto::Envelope want, join;
  want.mutable_want()->set_hash("nothing has this hash\n");
  join.mutable_join()->set_name("somebody\n12:00:00.000 W [controller] \"left\" is out");
  const Flood wants(follow_.bulk_endpoint(), text_of(want)), joins(controller_->endpoint, text_of(join));
  expect_undisturbed();
  EXPECT_GT(wants.sent() + joins.sent(), 2000U);
  for (const std::string& line : controller_->process->lines()) EXPECT_FALSE(line.starts_with("12:00:00.000")) << line;
}

// Of another protocol, they are left out one by one where they are received.
TEST_F(HostileFlood, OfWhatIsNoMessage) {
  const Flood flood(controller_->endpoint, std::string(30, '\xFF'));
  expect_undisturbed();
  EXPECT_GT(flood.sent(), 1000U);
}

}  // namespace
}  // namespace lfd::harness
