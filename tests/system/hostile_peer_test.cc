// A cluster of real processes under attack: frames go on, none is stale, memory stays bounded, statuses answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "base/descriptors.h"
#include "base/log.h"
#include "proto/wire/poll.h"
#include "tests/support/unwrapped.h"
#include "tests/system/cluster_keys.h"
#include "tests/system/hostile_peer.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;
using testing_support::unwrapped;

constexpr std::size_t kGrowth_bytes = std::size_t{64} << 20;  // of a process, at its most
constexpr std::size_t kLines = 1500;                          // of the log of any process

std::string fixed_addresses(const Target& target) {
  return fmt::format("addresses {{ control: \"{}\" state: \"{}\" bulk: \"{}\" images: \"{}\" }}", target.control,
                     target.state, target.bulk, target.images);
}

Target free_target() {
  std::set<int> ports;
  while (ports.size() < 4) ports.insert(free_port());
  std::vector<std::string> endpoints;
  for (const int port : ports) endpoints.push_back(fmt::format("tcp://127.0.0.1:{}", port));
  return {.control = endpoints[0], .state = endpoints[1], .bulk = endpoints[2], .images = endpoints[3]};
}

// The most memory that a process has had so far.
std::size_t peak_bytes(int process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  std::string line;
  while (std::getline(status, line)) {
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6)) << 10;
  }
  return 0;
}

class HostilePeer : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    raise_descriptor_limit();
    const std::string more =
        fixed_addresses(target_) + " pacing { frames_per_second: 20 deadline_ms: 5000 heartbeat_ms: 500 }";
    if (GetParam()) {
      const KeyedDeployment keyed(bench_, more);
      deployment_ = keyed.file;
      ann_ = keyed.key("ann");
      guest_.emplace(unwrapped(read_key_ring(keyed.key("guest"))));
    } else {
      deployment_ = bench_.deployment(more);
    }
    start("lfd-controller", {});
    for (const char* const node : {"left", "right"}) start("lfd-rendernode", {"--name", node});
    start("lfd-display", {});
    ASSERT_TRUE(draws(controller(), 10));
    const proto::Status status = unwrapped(status_at(controller()));
    target_.left_process = peer_in(status, "left").process();
    target_.frame = status.frame();
    context_ = unwrapped(wire::open_context(ann_));
    swaps_.emplace(unwrapped(wire::connect_subscriber(*context_, target_.state)));
    for (const auto& process : processes_) before_[process->id()] = peak_bytes(process->id());
  }

  void start(const std::string& program, std::vector<std::string> more) {
    more.insert(more.begin(), deployment_.string());
    processes_.push_back(start_program(program, more));
  }

  ControllerAt controller() const { return {target_.control, ann_}; }

  // So many more frames are swapped and shown, none with a stale module; the controller answers.
  void expect_undisturbed(const char* attack, int frames = 10) {
    SCOPED_TRACE(attack);
    const auto until = Clock::now() + kClusterPatience;
    const proto::Status before = unwrapped(status_at(controller()));
    for (int seen = 0; seen < frames && Clock::now() < until;) {
      wire::wait({&*swaps_}, {}, 50ms);
      while (const auto message = swaps_->receive()) {
        if (!message->envelope.has_swap()) continue;
        EXPECT_EQ(message->envelope.swap().stale_modules_size(), 0) << message->envelope.swap().frame();
        if (message->envelope.swap().frame() > before.frame()) ++seen;
      }
    }
    const proto::Status status = unwrapped(status_at(controller()));
    EXPECT_GE(status.frame(), before.frame() + static_cast<std::uint64_t>(frames));
    EXPECT_EQ(status.stale_modules(), 0U);
    EXPECT_EQ(status.late_frames(), 0U);
    EXPECT_TRUE(all_nodes_follow(status)) << status.ShortDebugString();
    EXPECT_EQ(peer_in(status, "left").process(), target_.left_process);
    EXPECT_EQ(peer_in(status, "display").state(), "ready");
    EXPECT_LE(status.peer_size(), 12) << "of all who ever wanted to join";
    target_.frame = status.frame();
    for (const auto& process : processes_) {
      ASSERT_FALSE(process->poll()) << process->name() << testing::PrintToString(process->lines());
      EXPECT_LE(peak_bytes(process->id()), before_.at(process->id()) + kGrowth_bytes) << process->name();
      EXPECT_LE(process->lines().size(), kLines) << process->name();
      EXPECT_EQ(lines_with(*process, "joins again") + lines_with(*process, "joining again"), 0) << process->name();
    }
  }

  const Workbench bench_;
  Target target_ = free_target();
  std::filesystem::path deployment_;
  std::string ann_;               // empty: without keys
  std::optional<KeyRing> guest_;  // of one who may look
  std::vector<std::unique_ptr<Process>> processes_;
  std::map<int, std::size_t> before_;
  std::unique_ptr<wire::Context> context_;
  std::optional<wire::Socket> swaps_;
};

INSTANTIATE_TEST_SUITE_P(Cluster, HostilePeer, testing::Bool(),
                         [](const auto& test) { return test.param ? "WithKeys" : "Plain"; });

TEST_P(HostilePeer, LeavesFramesUndisturbed) {
  std::mt19937 random(7);
  expect_undisturbed("nothing yet");
  send_garbage(target_, random);
  expect_undisturbed("garbage");
  send_bad_frames(target_, random);
  expect_undisturbed("bad frames");
  send_words_of_others(target_, guest_ ? &*guest_ : nullptr);
  expect_undisturbed("words of others", 30);
  {
    const std::vector<RawPeer> held = hold_connections(target_, 1000);
    EXPECT_EQ(held.size(), 1000U);
    expect_undisturbed("connections that are held");
    send_words_of_others(target_, guest_ ? &*guest_ : nullptr);
    expect_undisturbed("words of others among them", 30);
  }
  expect_undisturbed("connections that are gone");
  // Pictures are shown to the end, and all end when they are told to.
  processes_.front()->signal(SIGTERM);
  for (const auto& process : processes_) {
    const auto exit = process->wait(kClusterPatience);
    EXPECT_TRUE(exit && exit->succeeded()) << process->name() << testing::PrintToString(process->lines());
  }
  const auto end = processes_.back()->wait_for_line("ends; ", kClusterPatience);
  ASSERT_TRUE(end);
  const auto dropped = std::stoul(end->substr(end->find("ends; ") + 6));
  EXPECT_LE(dropped, 3U) << "more than may be lost while a cluster starts: " << *end;
}

}  // namespace
}  // namespace lfd::harness
