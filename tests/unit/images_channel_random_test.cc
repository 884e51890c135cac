// Nodes, spares and a display over connections that break at any time: frames are never mixed, memory stays bounded,
// and the show goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <random>
#include <set>

#include "display/image_peers.h"
#include "rendernode/node/image_outbox.h"
#include "tests/unit/one_pixel_images.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kModulesPerNode = 2;
constexpr std::uint64_t kFrames = 60, kLastFrames = 20;  // with faults, and after them

// What a module shows in a frame: it changes now and then.
std::uint8_t content_of(std::uint64_t frame, std::uint32_t module) {
  return static_cast<std::uint8_t>(frame / (1 + module % 3) * 7 + module);
}

// A node as its daemon drives it: draws what has begun, sends as far as the outbox says.
struct Node {
  std::string name, peer;  // peer: of its connection; empty: dead
  node::ImageOutbox outbox;
  std::map<std::uint32_t, wire::Payload> pixels;  // the last of each module; handed out again where nothing changed
  std::deque<std::pair<std::uint64_t, std::vector<std::uint32_t>>> drawn;  // frames that wait for the outbox, modules
  std::deque<proto::Envelope> inbox;
  std::deque<std::pair<proto::Envelope, wire::Payload>> outgoing;  // on their way to the display

  void push(std::uint64_t frame, const std::vector<std::uint32_t>& modules) {
    std::vector<node::OutgoingImage> images;
    for (const std::uint32_t module : modules) {
      const std::string bytes{char(name[0]), char(module), char(content_of(frame, module)), 'p'};
      wire::Payload& last = pixels[module];
      if (last.text() != bytes) last = std::make_shared<const std::string>(bytes);
      images.push_back({display::image_of(frame, module, static_cast<std::uint32_t>(modules.size())), last});
    }
    outbox.push(std::move(images));
  }
};

class Cluster {
 public:
  Cluster(unsigned seed, bool has_deadline, std::size_t waiting_bytes)
      : random_(seed), has_deadline_(has_deadline), waiting_bytes_(waiting_bytes), nodes_(2 + random_() % 3) {
    modules_ = static_cast<std::uint32_t>(nodes_.size() - 1) * kModulesPerNode;  // the last node is a spare
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i].name = std::string(1, static_cast<char>('a' + i));
      connect(nodes_[i]);
    }
    for (std::uint32_t module = 0; module < modules_; ++module) at_home_.push_back(module / kModulesPerNode);
    configure();
  }

  void run() {
    while (swapped_ < kFrames && steps_ < 200000) step(true);
    for (Node& node : nodes_) {
      if (node.peer.empty()) connect(node);
    }
    const std::uint64_t shown_before = shown_;
    while (shown_ < kFrames + kLastFrames && steps_ < 400000) step(false);
    EXPECT_GT(shown_, shown_before);
    EXPECT_EQ(shown_, kFrames + kLastFrames) << "the last frame is shown; swapped: " << swapped_;
  }

  std::uint64_t shown_count_ = 0, unchanged_ = 0;

 private:
  bool chance(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }
  Clock::time_point now() const { return Clock::time_point{} + 1h + std::chrono::milliseconds(steps_); }

  void configure() {
    assembly_.configure(static_cast<int>(modules_), display::kOnePixel, {}, waiting_bytes_);
    heard_.clear();
  }

  void connect(Node& node) {
    node.peer = std::to_string(++peers_made_);
    node.inbox.clear();
    node.outgoing.clear();
  }

  // The process is gone, and everything it knew.
  void kill(Node& node) {
    const std::string name = node.name;
    node = {};
    node.name = name;
  }

  void step(bool with_faults) {
    ++steps_;
    const std::uint32_t who = random_() % (2 * nodes_.size() + 2);
    if (who < nodes_.size()) {
      move(nodes_[who]);
    } else if (who < 2 * nodes_.size()) {
      display_hears(nodes_[who - nodes_.size()]);
    } else if (who == 2 * nodes_.size()) {
      begin();
    } else {
      swap();
    }
    display_speaks();
    while (const auto frame = assembly_.next_frame(now())) check(*frame);
    EXPECT_LE(assembly_.waiting_bytes(),
              nodes_.size() * std::max<std::size_t>(waiting_bytes_, std::size_t{16} * modules_));
    if (with_faults && chance(0.01)) fault(nodes_[random_() % nodes_.size()]);
  }

  void fault(Node& node) {
    if (node.peer.empty()) return connect(node);
    const double what = std::uniform_real_distribution<double>(0, 1)(random_);
    if (what < 0.5) return connect(node);  // the connection broke: what was on its way is lost, nobody is told
    if (what < 0.8) return kill(node);
    peers_.restart(now());  // the display was welcomed anew
    configure();
    shown_ = 0;
  }

  // The controller: modules of dead nodes go to the spare, or to nobody.
  void begin() {
    if (begun_ >= swapped_ + 2 || begun_ >= kFrames + kLastFrames) return;
    ++begun_;
    std::map<std::uint32_t, std::uint32_t>& owners = owners_[begun_];
    const auto spare = static_cast<std::uint32_t>(nodes_.size() - 1);
    for (std::uint32_t module = 0; module < modules_; ++module) {
      const std::uint32_t home = at_home_[module];
      owners[module] = nodes_[home].peer.empty() ? spare : home;
    }
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].peer.empty()) continue;
      std::vector<std::uint32_t> modules;
      for (const auto& [module, owner] : owners) {
        if (owner == i) modules.push_back(module);
      }
      if (!modules.empty()) nodes_[i].drawn.emplace_back(begun_, modules);
    }
  }

  void swap() {
    if (swapped_ >= begun_) return;
    const std::uint64_t frame = swapped_ + 1;
    std::vector<std::uint32_t> stale;
    display::FrameAssembly::Owners names;
    for (const auto& [module, owner] : owners_[frame]) {
      const Node& node = nodes_[owner];
      const bool is_drawing =
          !node.peer.empty() && std::ranges::count(node.drawn, frame, [](const auto& d) { return d.first; }) > 0;
      if (is_drawing && !has_deadline_) return;
      if (ready_[frame].contains(owner)) {
        names[module] = node.name;
      } else {
        stale.push_back(module);
      }
    }
    ++swapped_;
    stale_[frame] = {stale.begin(), stale.end()};
    heard_.insert(frame);
    assembly_.swapped(frame, stale, names);
  }

  void move(Node& node) {
    if (node.peer.empty()) return;
    for (; !node.inbox.empty(); node.inbox.pop_front()) node.outbox.credit_came(node.inbox.front().credit());
    if (node.outbox.greets(now())) {
      proto::Envelope hello;
      hello.mutable_hello()->set_node(node.name);
      node.outgoing.emplace_back(hello, wire::Payload());
    }
    if (!node.drawn.empty() && (node.outbox.idle() || has_deadline_)) {
      const auto [frame, modules] = node.drawn.front();
      node.drawn.pop_front();
      if (node.outbox.idle()) {
        node.push(frame, modules);
        ready_[frame].insert(static_cast<std::uint32_t>(&node - nodes_.data()));
      }
    }
    if (auto image = node.outbox.next()) {
      proto::Envelope envelope;
      *envelope.mutable_image() = image->header;
      unchanged_ += image->header.has_same_as_frame() ? 1 : 0;
      node.outgoing.emplace_back(std::move(envelope), image->payload);
      node.outbox.sent();
    }
  }

  void display_hears(Node& node) {
    if (node.outgoing.empty()) return;
    auto [envelope, payload] = std::move(node.outgoing.front());
    node.outgoing.pop_front();
    if (envelope.has_hello()) {
      EXPECT_TRUE(peers_.hello(node.peer, envelope.hello().node(), now()));
    } else if (const auto sender = peers_.sender(node.peer)) {
      (void)static_cast<bool>(assembly_.image_came(*sender, envelope.image(), std::move(payload), now()));
    }
  }

  void display_speaks() {
    for (const auto& [peer, credit] : peers_.words(now())) {
      const auto node = std::ranges::find(nodes_, peer, &Node::peer);
      if (node == nodes_.end()) {
        peers_.gone(peer, now());
        continue;
      }
      proto::Envelope envelope;
      *envelope.mutable_credit() = credit;
      node->inbox.push_back(std::move(envelope));
    }
  }

  void check(const display::ShownFrame& frame) {
    EXPECT_GT(frame.frame, shown_);
    shown_ = frame.frame;
    ++shown_count_;
    for (std::uint32_t module = 0; module < modules_; ++module) {
      const display::ShownModule& shown = frame.modules[module];
      if (heard_.contains(frame.frame)) {
        EXPECT_EQ(shown.stale, stale_[frame.frame].contains(module));
      }
      const auto& image = shown.image[proto::COLOR];
      if (!shown.stale) {
        ASSERT_NE(image, nullptr) << "frame " << frame.frame << ", module " << module;
        EXPECT_EQ(image->what.frame(), frame.frame);
      }
      if (image == nullptr) continue;
      const std::uint64_t of = image->what.frame();
      const std::string& owner = nodes_[owners_.at(of).at(module)].name;
      EXPECT_EQ(image->payload.text(), (std::string{owner[0], char(module), char(content_of(of, module)), 'p'}));
    }
  }

  std::mt19937 random_;
  const bool has_deadline_;
  const std::size_t waiting_bytes_;
  std::vector<Node> nodes_;
  std::uint32_t modules_ = 0;
  std::vector<std::uint32_t> at_home_;  // the node of each module
  display::FrameAssembly assembly_;
  display::ImagePeers peers_{assembly_};
  int peers_made_ = 0;
  long steps_ = 0;
  std::uint64_t begun_ = 0, swapped_ = 0, shown_ = 0;
  std::map<std::uint64_t, std::map<std::uint32_t, std::uint32_t>> owners_;  // of each frame and module: a node
  std::map<std::uint64_t, std::set<std::uint32_t>> ready_, stale_;
  std::set<std::uint64_t> heard_;  // swaps, by the display as it is
};

TEST(ImagesChannel, FramesStayWholeAndTheShowGoesOnWhateverBreaks) {
  std::uint64_t shown = 0, unchanged = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    for (const std::size_t waiting_bytes : {1, 40, 1000}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << waiting_bytes << " bytes");
      Cluster cluster(seed, seed % 2 == 0, waiting_bytes);
      cluster.run();
      shown += cluster.shown_count_;
      unchanged += cluster.unchanged_;
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(shown, 600u * kFrames / 2) << "faults cost some frames only";
  EXPECT_GT(unchanged, 1000u);
}

}  // namespace
}  // namespace lfd
