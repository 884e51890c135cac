// A cluster of real processes under attack: frames go on, none is stale, memory stays bounded, statuses answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include "base/descriptors.h"
#include "base/log.h"
#include "bench/common/process_facts.h"
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
constexpr int kHeld = 1000;                                   // connections
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
    // With 20 frames in it, it is long enough for a busy machine, and short enough to be missed by who is held up.
    const std::string more =
        fixed_addresses(target_) + " pacing { frames_per_second: 20 deadline_ms: 1000 heartbeat_ms: 500 }";
    if (GetParam()) {
      const KeyedDeployment keyed(bench_, more);
      deployment_ = keyed.file;
      ann_ = keyed.key("ann");
      mallory_.emplace(unwrapped(read_key_ring(keyed.add("mallory", proto::Allowed::NODE))));
      guest_.emplace(unwrapped(read_key_ring(keyed.key("guest"))));
      stolen_ = {.control = &*guest_, .images = &*mallory_};
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
    target_.calibration_hash = Workbench::display_hash();
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

  Process& controller_process() { return *processes_.front(); }
  Process& display_process() { return *processes_.back(); }
  std::uint64_t refused_messages() const { return unwrapped(status_at(controller())).refused_messages(); }

  int descriptors() const {
    int all = 0;
    for (const auto& process : processes_) all += bench::facts_of(process->id())->descriptors;
    return all;
  }

  // So much that was sent has come to where it is refused: an attack that reaches nobody proves nothing.
  void expect_arrived(const char* attack, std::uint64_t refused_before, std::uint64_t messages) {
    EXPECT_TRUE(becomes(controller(), [&](const proto::Status& status) {
      return status.refused_messages() >= refused_before + messages;
    })) << attack;
  }

  const Workbench bench_;
  Target target_ = free_target();
  std::filesystem::path deployment_;
  std::string ann_;                         // empty: without keys
  std::optional<KeyRing> guest_, mallory_;  // of one who may look, and of a node that is here no more
  StolenKeys stolen_;
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
  EXPECT_EQ(send_garbage(target_, random), 4);
  expect_undisturbed("garbage");
  std::uint64_t before = refused_messages();
  EXPECT_EQ(send_bad_frames(target_, random), GetParam() ? 0 : 4);
  if (!GetParam()) expect_arrived("bad frames", before, 100);
  expect_undisturbed("bad frames");
  before = refused_messages();
  send_bad_messages(target_, random, stolen_);
  expect_arrived("bad messages", before, 2000);  // 650 each at control and bulk, 1000 subscriptions
  EXPECT_TRUE(says(display_process(), target_.images + ": a")) << "at the display";
  expect_undisturbed("bad messages");
  before = refused_messages();
  send_words_of_others(target_, stolen_);
  expect_arrived("words of others", before, 5);
  EXPECT_TRUE(says(display_process(), "speaks for"));
  expect_undisturbed("words of others", 30);
  {
    const int open_before = descriptors();
    const std::vector<RawPeer> held = hold_connections(target_, kHeld);
    EXPECT_EQ(held.size(), static_cast<std::size_t>(kHeld));
    // With keys, those that greet without one are not kept; others may end in the meantime.
    const auto until = Clock::now() + kClusterPatience;
    while (descriptors() < open_before + kHeld * 2 / 5 && Clock::now() < until) std::this_thread::sleep_for(1ms);
    EXPECT_GE(descriptors(), open_before + kHeld * 2 / 5) << "they are not taken in";
    expect_undisturbed("connections that are held");
    before = refused_messages();
    send_words_of_others(target_, stolen_);
    expect_arrived("words of others among them", before, 5);
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
