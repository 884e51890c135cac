// A render node on another host whose cable is cut, loses packets, is narrow, or answers late: frames go on, and it is
// back when the cable is.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <deque>
#include <thread>

#include "base/log.h"
#include "cli/control_client.h"
#include "tests/system/fault_stage.h"
#include "tests/system/network_hosts.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;

// Turns the region of interest to and fro, about once a frame, so that images have to travel; in the end it is as it
// was.
class Turning {
 public:
  explicit Turning(std::string endpoint)
      : thread_([this, endpoint = std::move(endpoint)](const std::stop_token& stop) {
          auto client = ControlClient::connect(endpoint);
          ASSERT_TRUE(client);
          for (int i = 0; !stop.stop_requested(); ++i) {
            ASSERT_TRUE(turn(*client, 0.3 * std::sin(0.1 * i)));
            std::this_thread::sleep_for(40ms);
          }
          ASSERT_TRUE(turn(*client, 0));
        }) {}

 private:
  static testing::AssertionResult turn(ControlClient& client, double angle_rad) {
    proto::Request request;
    auto* const orientation = request.mutable_roi()->mutable_world_orientation();
    orientation->set_w(std::cos(angle_rad / 2));
    orientation->set_z(std::sin(angle_rad / 2));
    const auto reply = client.ask(request, kClusterPatience);
    if (!reply) return testing::AssertionFailure() << reply.error().message();
    return testing::AssertionSuccess();
  }

  std::jthread thread_;
};

class NetworkFaults : public testing::Test {
 protected:
  void SetUp() override {
    auto host = SecondHost::make();
    if (!host) GTEST_SKIP() << "no second host can be made here: " << host.error().message();
    host_ = std::move(*host);
    stage_.emplace("security { accept_plain_tcp_beyond_loopback: true } stream { codec: RAW_IMAGES }",
                   FaultStage::kPacing, host_->here());
    for (const char* const name : {"controller", "display", "left"}) stage_->start(name);
    stage_->start_as("right", {.prefix = host_->prefix()});
    ASSERT_TRUE(stage_->is_whole());
    before_ = stage_->pictures_from(stage_->last_frame());
  }

  // Frames go on to be shown now.
  void expect_frames() {
    const std::uint64_t frame = stage_->last_frame();
    EXPECT_TRUE(stage_->shows_frames_after(frame + 5));
  }

  std::uint64_t hindered_packets() const {
    const auto packets = host_->hindered_packets();
    EXPECT_TRUE(packets);
    return packets ? *packets : 0;
  }

  void expect_all_as_before() {
    ASSERT_TRUE(stage_->is_whole());
    // What waits in the cable's queues comes first.
    const auto until = Clock::now() + kClusterPatience;
    bool as_before = false;
    while (!as_before && Clock::now() < until) as_before = stage_->pictures_from(stage_->last_frame()) == before_;
    EXPECT_TRUE(as_before);
    for (const char* const name : {"controller", "display", "left", "right"})
      EXPECT_FALSE((*stage_)[name].poll()) << name;
    EXPECT_TRUE(stage_->frames_went_on());
  }

  std::unique_ptr<SecondHost> host_;
  std::optional<FaultStage> stage_;
  std::map<int, std::string> before_;
};

TEST_F(NetworkFaults, ACutCableCostsTheNodeAndItIsBackOnceTheCableIs) {
  ASSERT_TRUE(host_->cut());
  ASSERT_TRUE(becomes(stage_->endpoint(), [](const proto::Status& status) {
    return peer_in(status, "right").state() == "out" && status.stale_modules() == 2;
  }));
  expect_frames();
  ASSERT_TRUE(host_->restore());
  expect_all_as_before();
}

// Shorter than the heartbeat limit: nobody is out; what was lost on the way is sent again by TCP or left out.
TEST_F(NetworkFaults, AShortCutCostsFramesOnly) {
  ASSERT_TRUE(host_->cut());
  ASSERT_TRUE(becomes(stage_->endpoint(), [](const proto::Status& status) { return status.late_frames() > 0; }));
  ASSERT_TRUE(host_->restore());
  expect_frames();
  expect_all_as_before();
}

TEST_F(NetworkFaults, ALossOfFivePercentIsEndured) {
  if (const Status lossy = host_->lose_packets(5); !lossy) GTEST_SKIP() << lossy.error().message();
  {
    const Turning turning(stage_->endpoint());
    const std::uint64_t frame = stage_->last_frame();
    ASSERT_TRUE(stage_->shows_frames_after(frame + 40));
  }
  EXPECT_GT(hindered_packets(), 0U);
  EXPECT_FALSE((*stage_)["right"].poll());
  ASSERT_TRUE(host_->clear());
  expect_all_as_before();
}

// 20 frames a second of two modules are about 4 Mbit/s where all change; where less goes through, frames are dropped,
// not kept.
TEST_F(NetworkFaults, ANarrowCableCostsFramesOnly) {
  if (const Status narrow = host_->limit_bandwidth(1000); !narrow) GTEST_SKIP() << narrow.error().message();
  {
    const Turning turning(stage_->endpoint());
    const std::uint64_t frame = stage_->last_frame();
    EXPECT_TRUE(becomes(stage_->endpoint(), [](const proto::Status& status) { return status.stale_modules() == 2; }));
    ASSERT_TRUE(stage_->shows_frames_after(frame + 40));
  }
  EXPECT_GT(hindered_packets(), 0U);
  EXPECT_FALSE((*stage_)["right"].poll());
  ASSERT_TRUE(host_->clear());
  expect_all_as_before();
}

// Passes bytes on both ways between whoever connects and a port, each so much later.
class SlowRelay {
 public:
  SlowRelay(int to_port, Clock::duration delay) : to_port_(to_port), delay_(delay) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = loopback(0);
    socklen_t length = sizeof address;
    LFD_CHECK(::bind(listener_, reinterpret_cast<sockaddr*>(&address), length) == 0, "some port is free");
    LFD_CHECK(::listen(listener_, 8) == 0, "a socket listens");
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ::ntohs(address.sin_port);
    thread_ = std::jthread([this](std::stop_token stop) { work(stop); });
  }
  ~SlowRelay() {
    thread_.request_stop();
    thread_.join();
    for (const Way& way : ways_) ::close(way.from);
    ::close(listener_);
  }
  int port() const { return port_; }
  std::uint64_t passed_bytes() const { return passed_; }

 private:
  struct Piece {
    Clock::time_point due;
    std::string bytes;
  };
  struct Way {
    int from, to;
    std::deque<Piece> pieces;
  };

  static sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    address.sin_port = ::htons(static_cast<std::uint16_t>(port));
    return address;
  }

  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::vector<pollfd> sources{{listener_, POLLIN, 0}};
      for (const Way& way : ways_) sources.push_back({way.from, POLLIN, 0});
      ::poll(sources.data(), sources.size(), 5);
      if ((sources[0].revents & POLLIN) != 0) accept_one();
      for (std::size_t i = 1; i < sources.size(); ++i) {
        if (sources[i].revents == 0) continue;
        char bytes[65536];
        const ssize_t count = ::recv(ways_[i - 1].from, bytes, sizeof bytes, MSG_DONTWAIT);
        if (count > 0) ways_[i - 1].pieces.push_back({Clock::now() + delay_, {bytes, static_cast<std::size_t>(count)}});
      }
      for (Way& way : ways_) {
        while (!way.pieces.empty() && way.pieces.front().due <= Clock::now()) {
          passed_ += way.pieces.front().bytes.size();
          ::send(way.to, way.pieces.front().bytes.data(), way.pieces.front().bytes.size(), MSG_NOSIGNAL);
          way.pieces.pop_front();
        }
      }
    }
  }

  void accept_one() {
    const int one = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int other = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(to_port_);
    if (::connect(other, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      ::close(one);
      ::close(other);
      return;
    }
    ways_.push_back({one, other, {}});
    ways_.push_back({other, one, {}});
  }

  int to_port_;
  Clock::duration delay_;
  int listener_ = -1, port_ = 0;
  std::vector<Way> ways_;  // of the thread, until it has ended
  std::atomic<std::uint64_t> passed_ = 0;
  std::jthread thread_;
};

// The words of one node travel 100 ms each way: its ready comes after the deadline of 250 ms for no frame, so it takes
// part.
TEST(DelayedNode, TakesPartInWholeFrames) {
  FaultStage stage("");
  stage.start("controller");
  const int port = std::stoi(stage.endpoint().substr(stage.endpoint().rfind(':') + 1));
  const SlowRelay relay(port, 100ms);
  stage.start("display");
  stage.start("left");
  stage.start_as("right", {.more = {"--controller", fmt::format("tcp://127.0.0.1:{}", relay.port())}});
  ASSERT_TRUE(stage.is_whole());
  EXPECT_GT(relay.passed_bytes(), 0U);
  const std::uint64_t frame = stage.last_frame();
  ASSERT_TRUE(stage.shows_frames_after(frame + 5));
  EXPECT_EQ(stage.pictures_from(frame).size(), 4U);
}

}  // namespace
}  // namespace lfd::harness
