// Messages to those who take them, as their daemons hand them on.
#include "tests/fuzz/peers.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "base/check.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/version.h"
#include "controller/scene/made/made_scenes.h"
#include "proto/state.h"

namespace lfd::fuzz {
namespace {

using namespace std::chrono_literals;

constexpr int kModules = 2;
constexpr ImageSize kImage{2, 1};
const std::vector<std::string> kNodes{"left", "right"};

Deployment small_deployment() {
  Deployment deployment;
  deployment.display.name = "small";
  deployment.display.screen = {1.6, 0.9};
  deployment.display.image = kImage;
  deployment.display.angular_scattering_rad = 0.4;
  for (int k = 0; k < kModules; ++k) deployment.display.modules.push_back({Emitter{0.4 * k, 0, -1}, IdealMap{}});
  return deployment;
}

controller::Stage stage_with_a_scene() {
  static const SceneData kPlane = scene::make_scene("plane", 1)->data;
  auto stage = controller::Stage::of(small_deployment());
  LFD_CHECK(stage, stage.error().message());
  LFD_CHECK(stage->show({.data = kPlane, .animations = {}, .warnings = {}}), "a made scene can be shown");
  return *std::move(stage);
}

proto::Join join_of(const std::string& name, proto::Role role) {
  proto::Join join;
  join.set_role(role);
  join.set_name(name);
  join.set_version(kVersion);
  join.set_calibration_hash("c0");
  join.set_process(1);
  return join;
}

}  // namespace

std::optional<proto::Envelope> envelope_of(std::string_view bytes) {
  proto::Envelope envelope;
  if (!envelope.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return std::nullopt;
  if (envelope.protocol() != kProtocolVersion && !envelope.has_refused()) return std::nullopt;
  return envelope;
}

Peers::Peers()
    : members_({.version = kVersion, .calibration_hash = "c0", .nodes = kNodes, .patience = 3s, .heartbeat = 500ms}),
      stage_(stage_with_a_scene()) {
  for (const auto& [name, address] : {std::pair{"left", "L"}, {"right", "R"}, {"display", "D"}}) {
    const proto::Role role = *address == 'D' ? proto::DISPLAY : proto::NODE;
    const auto joined = members_.join(join_of(name, role), address, now_);
    LFD_CHECK(joined && *joined, "it may join");
    members_.welcomed(name, now_);
    members_.holds(address, stage_.store().hash(), true);
  }
  follower_.snapshot_came(stage_.store().state());
  proto::Scene scene;
  scene.add_instance()->set_mesh(content_hash(kAsset));
  gatherer_.want(scene);
  assembly_.configure(kModules, kImage);
  for (const char* const node : {"L", "R"}) LFD_CHECK(assembly_.node_came(node, now_), "there is room for it");
  tick();
  check();
}

void Peers::take(const std::string& sender, const proto::Envelope& envelope, std::string_view payload) {
  to_controller(sender, envelope);
  to_node(envelope, payload);
  to_display(sender, envelope, payload);
  bystanders_.take(sender, envelope, now_);
  tick();
}

void Peers::wait(Clock::duration how_long) {
  now_ += how_long;
  tick();
}

// As controller/daemon does.
void Peers::to_controller(const std::string& sender, const proto::Envelope& envelope) {
  members_.heard(sender, now_);
  const controller::Peer* peer = members_.at(sender);
  switch (envelope.body_case()) {
    case proto::Envelope::kJoin:
      if (const auto name = members_.join(envelope.join(), sender, now_); name && *name) {
        barrier_.gone(**name);
        members_.welcomed(**name, now_);
      }
      break;
    case proto::Envelope::kHeartbeat:
      members_.holds(sender, envelope.heartbeat().state_hash(),
                     stage_.store().remembers(envelope.heartbeat().state_hash()));
      break;
    case proto::Envelope::kLeave:
      if (const auto name = members_.leave(sender)) barrier_.gone(*name);
      break;
    case proto::Envelope::kDrawn:
      if (peer != nullptr) barrier_.drawn(peer->name, envelope.drawn().frame());
      break;
    case proto::Envelope::kReady:
      if (peer == nullptr) break;
      log_.reported(envelope.ready().frame(), peer->name, envelope.ready().report());
      if (envelope.ready().report().error().empty()) {
        barrier_.ready(peer->name, envelope.ready().frame());
      } else {
        barrier_.failed(peer->name, envelope.ready().frame());
      }
      break;
    case proto::Envelope::kShown:
      if (peer != nullptr && peer->role == proto::DISPLAY) log_.shown(envelope.shown().frame(), now_);
      break;
    case proto::Envelope::kRequest:
      to_stage(envelope.request());
      break;
    default:
      break;
  }
}

void Peers::to_stage(const proto::Request& request) {
  const std::uint64_t before = stage_.store().sequence();
  const std::string hash_before = stage_.store().hash();
  std::optional<Result<proto::Update>> update;
  if (request.has_roi()) update = stage_.set_roi(request.roi());
  if (request.has_render()) update = stage_.set_render(request.render());
  if (request.has_ao()) update = stage_.set_ao(request.ao());
  if (request.has_pattern()) update = stage_.set_pattern(request.pattern());
  if (!update) return;
  if (*update) {
    LFD_CHECK(stage_.store().sequence() == before + 1 && (**update).sequence() == before + 1, "updates count by one");
    LFD_CHECK(read_settings(stage_.store().state().render()), "what is shown can be read");
    LFD_CHECK(read_roi(stage_.store().state().roi()), "what is shown can be read");
    follower_.update_came(**update);
  } else {
    LFD_CHECK(!update->error().message().empty(), "every refusal has a reason");
    LFD_CHECK(stage_.store().sequence() == before && stage_.store().hash() == hash_before,
              "what is refused changes nothing");
  }
  LFD_CHECK(state_hash(stage_.store().state()) == stage_.store().hash(), "the hash is the state's");
}

// As rendernode/node does.
void Peers::to_node(const proto::Envelope& envelope, std::string_view payload) {
  switch (envelope.body_case()) {
    case proto::Envelope::kSnapshot:
      follower_.snapshot_came(envelope.snapshot().state());
      break;
    case proto::Envelope::kUpdate: {
      const std::uint64_t before = follower_.sequence();
      follower_.update_came(envelope.update());
      LFD_CHECK(follower_.sequence() == before || follower_.sequence() == before + 1, "updates count by one");
      break;
    }
    case proto::Envelope::kBegin:
      follower_.pulse_came(envelope.begin().sequence());
      break;
    case proto::Envelope::kPulse:
      follower_.pulse_came(envelope.pulse().sequence());
      break;
    case proto::Envelope::kChunk:
      if (!gatherer_.piece_came(envelope.chunk(), payload)) LFD_CHECK(gatherer_.missing() <= 1, "one is wanted");
      break;
    case proto::Envelope::kNotFound:
      gatherer_.not_found(envelope.not_found().hash());
      break;
    default:
      return;
  }
  (void)read_settings(follower_.state()->render());
  (void)read_roi(follower_.state()->roi());
  for (const proto::Want& want : gatherer_.next_requests(now_))
    LFD_CHECK(want.length() == kPiece_bytes && want.offset() < AssetGatherer::kMaxAsset_bytes, "pieces are asked for");
}

// As display/display_images.cc does.
void Peers::to_display(const std::string& sender, const proto::Envelope& envelope, std::string_view payload) {
  if (envelope.has_image()) {
    const auto bytes = std::make_shared<const std::string>(payload);
    const Status taken = assembly_.image_came(sender, envelope.image(), wire::Payload(bytes), now_);
    LFD_CHECK(taken || !taken.error().message().empty(), "every refusal has a reason");
  }
  if (!envelope.has_swap()) return;
  const auto& stale = envelope.swap().stale_modules();
  assembly_.swapped(envelope.swap().frame(), {stale.data(), static_cast<std::size_t>(stale.size())});
}

void Peers::tick() {
  for (const std::string& name : members_.expire(now_)) barrier_.gone(name);
  while (const auto swap = barrier_.swap(now_)) {
    LFD_CHECK(!last_swap_ || swap->frame > *last_swap_, "frames swap in order");
    last_swap_ = swap->frame;
    log_.swapped(*swap, {}, now_);
  }
  const std::vector<std::string> ready = members_.ready_nodes();
  if (barrier_.may_begin() && !ready.empty())
    log_.begun(barrier_.begin(ready, now_), stage_.roi(), stage_.store().hash(), now_);
  for (const char* const node : {"L", "R"}) assembly_.credit_for(node);
  while (const auto frame = assembly_.next_frame(now_)) {
    LFD_CHECK(!last_shown_ || frame->frame > *last_shown_, "frames are shown in order");
    LFD_CHECK(frame->modules.size() == kModules, "a frame has all modules");
    last_shown_ = frame->frame;
  }
}

void Peers::check() const {
  std::size_t displays = 0;
  for (const controller::Peer* peer : members_.peers()) {
    const bool is_node = std::ranges::count(kNodes, peer->name) > 0;
    LFD_CHECK(is_node == (peer->role == proto::NODE), "the deployment's names are nodes' alone");
    if (peer->role == proto::DISPLAY && peer->lives()) ++displays;
  }
  LFD_CHECK(members_.peers().size() <= kNodes.size() + 1 + controller::Membership::kGoneDisplays,
            "who has gone is forgotten");
  LFD_CHECK(displays <= 1, "there is one display");
  for (const std::string& node : members_.ready_nodes())
    LFD_CHECK(std::ranges::count(kNodes, node) == 1, "only nodes of the deployment draw");
  LFD_CHECK(barrier_.in_flight() <= controller::FrameBarrier::kInFlight, "so many frames are open at most");
  for (const proto::FrameReport& report : log_.reports(0, 1u << 20))
    LFD_CHECK(report.node_size() <= static_cast<int>(kNodes.size() + 1), "each reports a frame once");
  // Two frames of each node, with all their buffers.
  LFD_CHECK(assembly_.waiting_images() <= std::size_t{2} * 2 * kModules * display::kBufferKinds,
            "credits bound what waits");
  LFD_CHECK(follower_.state() != nullptr, "a state stays");
  if (gatherer_.complete())
    LFD_CHECK(*gatherer_.assets().at(content_hash(kAsset)) == kAsset, "only the asset itself is taken for it");
}

}  // namespace lfd::fuzz
