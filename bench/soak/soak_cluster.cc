// Files, processes and looking.
#include "bench/soak/soak_cluster.h"

#include <poll.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "base/file.h"
#include "base/log.h"
#include "bench/common/free_endpoint.h"
#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "controller/scene/scene_file.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "proto/pictures/png.h"

namespace lfd::bench {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr int kModules = 8;
constexpr ImageSize kImage{64, 48};
constexpr std::size_t kMiddle = std::size_t{4} * (kImage.height / 2 * kImage.width + kImage.width / 2);
constexpr const char* kProcesses[] = {"controller", "display", "left", "right", "reserve"};
constexpr Rgb8 kFirstColor{210, 60, 100}, kOtherColor{40, 170, 220};     // what covers the middle pixels
constexpr std::uint64_t kFramesBetweenLosses = 300, kMostLosses = 1000;  // of the context of "left"
constexpr auto kChangePause = 150ms, kRest = 400ms, kLookPause = 100ms, kTick = 10ms;
constexpr int kChangesBetweenRests = 4;
constexpr auto kAnswerPatience = 300ms;  // the controller may be stopped
constexpr auto kScenePatience = 30s;
constexpr auto kFileClock = 20ms;           // files are stamped by ticks of the kernel, 1 to 10 ms apart
constexpr std::uint64_t kFramesInHand = 4;  // of a display's writers, and one more

// A picture of this seed, and before its middle a rectangle of this colour. Few triangles: llvmpipe keeps those of the
// last frames in up to 36 MiB, or does not, as its threads happen to be done with them (LP_SCENE_MAX_SIZE).
Result<SceneData> colored_scene(std::uint64_t seed, const Rgb8& color) {
  LFD_TRY(LoadedScene made, scene::make_scene("quad", seed, {.width_m = 0.8, .height_m = 0.9}));  // beside it: nothing
  proto::Scene& scene = made.data.scene;
  proto::Instance& middle = *scene.add_instance();
  middle = scene.instance(0);
  middle.set_material(static_cast<std::uint32_t>(scene.material_size()));
  middle.clear_world_from_mesh();
  for (const double entry : {0.5, 0.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 1.0, 0.05})
    middle.add_world_from_mesh(entry);
  *scene.add_material() = scene.material(0);
  give_own_color(scene, color);
  return std::move(made.data);
}

}  // namespace

Status SoakCluster::write_files() {
  LFD_TRY(DisplayCalibration display, make_display("desk", kModules));
  display.image = kImage;
  LFD_TRY_STATUS(save_calibration(folder_.path() / "display.textproto", display));
  for (const auto& [file, seed, color] :
       {std::tuple{"other.glb", 2u, kOtherColor}, std::tuple{"first.glb", 1u, kFirstColor}}) {
    LFD_TRY(const SceneData scene, colored_scene(seed, color));
    LFD_TRY_STATUS(scene::write_glb(folder_.path() / file, scene));
    first_scene_ = scene.scene;
  }
  control_ = free_endpoint();
  state_ = free_endpoint();
  return write_file(
      folder_.path() / "soak.textproto",
      fmt::format("name: \"soak\" display: \"display.textproto\" scene {{ file: \"first.glb\" }} sink: DISPLAY\n"
                  "node {{ name: \"left\" }} node {{ name: \"right\" }} node {{ name: \"reserve\" spare: true }}\n"
                  "pacing {{ frames_per_second: {} heartbeat_ms: {} deadline_ms: {} }}\n"
                  "addresses {{ control: \"{}\" state: \"{}\" bulk: \"{}\" images: \"{}\" }}\n",
                  kFramesPerSecond, kHeartbeat_ms, kDeadline_ms, control_, state_, free_endpoint(), free_endpoint()));
}

Result<std::unique_ptr<SoakCluster>> SoakCluster::start(StopSignals& signals) {
  LFD_TRY(TemporaryFolder folder, TemporaryFolder::make("lfd-soak"));
  auto cluster = std::unique_ptr<SoakCluster>(new SoakCluster(signals, std::move(folder)));
  LFD_TRY_STATUS(cluster->write_files());
  cluster->daemons_ = std::make_unique<Daemons>(own_folder(), cluster->folder_.path() / "soak.textproto",
                                                cluster->folder_.path() / "shown");
  LFD_TRY(cluster->listener_, Listener::open(cluster->state_));
  LFD_TRY(ControlClient client, ControlClient::connect(cluster->control_));
  cluster->client_ = std::make_unique<ControlClient>(std::move(client));
  for (const char* const name : kProcesses) LFD_TRY_STATUS(cluster->start_daemon(name));
  return cluster;
}

Status SoakCluster::start_daemon(const std::string& name) {
  Daemons::Start how;
  if (name == "left") {
    std::vector<std::string> losses;
    for (std::uint64_t i = 1; i <= kMostLosses; ++i)
      losses.push_back(fmt::format("lose-context@drawing:{}", last_frame() + i * kFramesBetweenLosses));
    how.environment["LFD_FAULTS"] = fmt::format("{}", fmt::join(losses, ","));
  }
  LFD_TRY_STATUS(daemons_->start(name, std::move(how)));
  return {};
}

std::optional<proto::Status> SoakCluster::status() {
  proto::Request request;
  request.mutable_status();
  const auto reply = client_->ask(request, kAnswerPatience);
  if (!reply) return std::nullopt;
  late_now_ = std::max(late_now_, reply->status().late_frames());
  counts.late_frames = late_before_ + late_now_;
  return reply->status();
}

Status SoakCluster::change_scene() {
  other_scene_ = !other_scene_;
  proto::Request request;
  request.set_scene_file(folder_.path() / (other_scene_ ? "other.glb" : "first.glb"));
  LFD_TRY(const proto::Reply reply, client_->ask(request, kScenePatience));
  return reply.error().empty() ? Status() : Status(Error(reply.error()));
}

bool SoakCluster::is_whole() {
  const auto now = status();
  if (!now || now->stale_modules() > 0) return false;
  const bool all_ready = std::ranges::all_of(now->peer(), [&](const proto::PeerStatus& peer) {
    if (static_cast<int>(peer.process()) != daemons_->at(peer.name()).id()) return false;  // that one has gone
    const bool holds = peer.role() != proto::NODE || peer.state_hash() == now->state_hash();
    return holds && (peer.state() == "ready" || peer.state() == "late");
  });
  return all_ready && now->peer_size() == 4;
}

bool SoakCluster::spare_draws() {
  const auto now = status();
  return now && std::ranges::any_of(now->peer(), [](const proto::PeerStatus& peer) {
           return peer.spare() && peer.module_size() > 0 && peer.state() == "ready";
         });
}

Status SoakCluster::look_for(Clock::duration time) {
  LFD_TRY([[maybe_unused]] const bool never, look_until([] { return false; }, time));
  return {};
}

Result<bool> SoakCluster::look_until(const std::function<bool()>& done, Clock::duration at_most) {
  const auto deadline = Clock::now() + at_most;
  while (true) {
    if (signals_.take()) return Error("ended by a signal");
    hear();
    change_state();
    look_at_frames();
    if (done()) return true;
    if (Clock::now() >= deadline) return false;
    pollfd signal{.fd = signals_.descriptor(), .events = POLLIN, .revents = 0};
    ::poll(&signal, 1, static_cast<int>(kTick.count()));
  }
}

Clock::duration SoakCluster::longest_pause() {
  hear();
  return pauses_.longest(Clock::now());
}

void SoakCluster::forget_pauses() {
  hear();
  pauses_.start_anew();
}

std::vector<std::string> SoakCluster::dead() const {
  std::vector<std::string> dead;
  for (const char* const name : kProcesses) {
    const auto exit = daemons_->at(name).poll();
    if (!exit) continue;
    const std::vector<std::string> lines = daemons_->at(name).lines();
    dead.push_back(fmt::format("{} has ended ({}): {}", name, exit->text(), lines.empty() ? "no words" : lines.back()));
  }
  return dead;
}

void SoakCluster::hear() {
  const auto on_session = [this] {
    checker_.restarted();
    begun_at_.clear();
    checker_.scene(0, first_scene_);
    other_scene_ = false;
    late_before_ += late_now_;
    late_now_ = 0;
  };
  listener_->hear(on_session, [this](const proto::Envelope& envelope, Clock::time_point at) {
    if (envelope.has_update() && envelope.update().has_scene())
      checker_.scene(envelope.update().sequence(), envelope.update().scene());
    if (envelope.has_update() && envelope.update().has_render())
      checker_.background(envelope.update().sequence(), envelope.update().render().background());
    if (envelope.has_begin()) {
      checker_.begun(envelope.begin().frame(), envelope.begin().sequence());
      const auto ago = std::chrono::duration_cast<fs::file_time_type::duration>(Clock::now() - at);
      begun_at_[envelope.begin().frame()] = fs::file_time_type::clock::now() - ago;
      if (begun_at_.size() > FrameChecker::kRemembered) begun_at_.erase(begun_at_.begin());
    }
    if (!envelope.has_swap()) return;
    const auto& stale = envelope.swap().stale_modules();
    checker_.swapped(envelope.swap().frame(), {stale.begin(), stale.end()});
    pauses_.swapped(at);
  });
}

void SoakCluster::change_state() {
  if (Clock::now() < next_change_) return;
  // Nodes say with their heartbeats what they hold: in a rest all are seen to hold the same.
  next_change_ = Clock::now() + (++changes_ % kChangesBetweenRests == 0 ? kRest : kChangePause);
  const auto now = status();
  if (!now) return;
  proto::Request request;
  *request.mutable_render() = now->render();
  *request.mutable_render()->mutable_background() = background_of(++painted_);
  if (const auto reply = client_->ask(request, kAnswerPatience); !reply) log::debug("{}", reply.error().message());
}

void SoakCluster::look_at_frames() {
  if (Clock::now() < next_look_) return;
  next_look_ = Clock::now() + kLookPause;
  const std::set<std::uint64_t> frames = frames_in(daemons_->shown());
  std::error_code failure;
  const std::uint64_t last_swapped = last_frame();
  for (const std::uint64_t frame : frames) {
    if (frame > last_swapped + kFramesInHand) {  // of another life of the controller
      fs::remove_all(frame_path(daemons_->shown(), frame), failure);
    } else if (frames.upper_bound(frame + kFramesInHand - 1) != frames.end() &&
               *frames.rbegin() <= last_swapped + kFramesInHand) {
      look_at_frame(frame);
      fs::remove_all(frame_path(daemons_->shown(), frame), failure);
    }
  }
}

// Written after the frame began. A frame that the display dropped may have pictures of the same number left from before
// the controller was killed.
bool SoakCluster::is_of_this_life(const fs::path& picture, std::uint64_t frame) const {
  std::error_code failure;
  const auto written = fs::last_write_time(picture, failure);
  const auto begun = begun_at_.find(frame);
  return !failure && begun != begun_at_.end() && written >= begun->second - kFileClock;
}

void SoakCluster::look_at_frame(std::uint64_t frame) {
  std::map<std::uint32_t, FrameChecker::Pixels> seen;
  for (std::uint32_t module = 0; module < kModules; ++module) {
    const auto path = image_path(daemons_->shown(), frame, module, proto::COLOR);
    if (!is_of_this_life(path, frame)) continue;
    const auto picture = read_png(path);
    if (!picture || picture->rgba.size() <= kMiddle + 2) continue;
    const auto pixel = [&picture](std::size_t at) {
      return Rgb8{picture->rgba[at], picture->rgba[at + 1], picture->rgba[at + 2]};
    };
    seen[module] = {.background = pixel(0), .scene = pixel(kMiddle)};
  }
  const auto verdict = checker_.judge(frame, seen);
  if (!verdict) return;
  ++counts.shown_frames;
  counts.judged_modules += static_cast<std::uint64_t>(verdict->fresh);
  if (verdict->fresh < kModules) ++counts.stale_frames;
  if (verdict->wrong > 0) ++counts.mixed_frames;
  for (const std::string& error : verdict->errors) log::warn("{}", error);
}

}  // namespace lfd::bench
