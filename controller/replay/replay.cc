// Recorded events to frames.
#include "controller/replay/replay.h"

#include <utility>

#include "base/log.h"
#include "proto/asset_gatherer.h"
#include "proto/calibration_file.h"
#include "proto/scene_numbers.h"
#include "proto/state.h"

namespace lfd::controller {
namespace {

constexpr std::size_t kRememberedHashes = 64;  // more than frames are under way

std::string count_text(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

bool is_within(std::uint64_t frame, const std::optional<FrameRange>& range) {
  return !range || (frame >= range->first && frame <= range->last);
}

}  // namespace

Result<Replay> Replay::open(const std::filesystem::path& file, const DisplayCalibration& display,
                            const Options& options) {
  LFD_TRY(Recording recording, Recording::open(file));
  Result<Replay> replay = of(std::move(recording), display, options);
  if (!replay && !replay.error().message().starts_with(file.string())) return replay.error().within(file.string());
  return replay;
}

Result<Replay> Replay::of(Recording recording, const DisplayCalibration& display, const Options& options) {
  const proto::RecordingHeader& header = recording.header();
  const std::string hash = calibration_hash(display);
  if (header.calibration_hash() != hash && !options.any_display) {
    return Error(fmt::format(
        "it was recorded on display \"{}\" (calibration {}), and is to be shown on \"{}\" (calibration {}); "
        "--any-display replays it all the same",
        header.display().name(), header.calibration_hash(), display.name, hash));
  }
  Replay replay(std::move(recording), options);
  LFD_TRY_STATUS(replay.read_on());
  if (replay.next_) {
    replay.first_at_ = replay.next_->at;
    return replay;
  }
  const Recording::Contents& contents = replay.recording_.contents();
  if (contents.frames == 0) return Error("there is no frame in it");
  const std::string why =
      replay.left_out_ > 0 ? "the scene of each was not recorded whole" : "none of them is asked for";
  return Error(fmt::format("it has frames {} to {}; {}", contents.first_frame, contents.last_frame, why));
}

std::optional<Replay::Change> Replay::take_change() {
  return next_ ? std::exchange(next_->change, std::nullopt) : std::nullopt;
}

std::optional<Clock::time_point> Replay::due_at() const {
  if (!next_ || !started_ || options_.speed == 0) return std::nullopt;
  const std::chrono::duration<double, std::nano> after = (next_->at - first_at_) / options_.speed;
  return *started_ + std::chrono::duration_cast<Clock::duration>(after);
}

bool Replay::due(Clock::time_point now) const {
  if (!next_) return false;
  const auto at = due_at();
  return !at || now >= *at;
}

Status Replay::begun(Clock::time_point now) {
  LFD_CHECK(next_.has_value(), "only what is there begins");
  if (!started_) started_ = now;
  last_frame_ = next_->frame;
  ++replayed_;
  hashes_[next_->frame] = next_->state_hash;
  if (hashes_.size() > kRememberedHashes) hashes_.erase(hashes_.begin());
  return read_on();
}

Status Replay::drawn(std::uint64_t frame, const std::string& node, const std::string& state_hash) {
  const auto recorded = hashes_.find(frame);
  if (recorded == hashes_.end()) return {};
  ++drawn_;
  if (recorded->second == state_hash) return {};
  ++differing_;
  return Error(fmt::format("frame {}: node \"{}\" drew state {}; state {} was recorded", frame, node, state_hash,
                           recorded->second));
}

Status Replay::read_on() {
  next_.reset();
  while (!next_) {
    LFD_TRY(std::optional<Recording::Event> event, recording_.next());
    if (!event) return {};
    const proto::RecordingEvent& what = event->what;
    if (!what.has_begin()) {
      if (const Status taken = take(what); !taken) return recording_.at(event->offset, taken.error());
      continue;
    }
    if (!is_within(what.begin().frame(), options_.frames)) continue;
    if (lacks_assets_) {
      if (left_out_++ == 0) log::warn("frame {} is left out: its scene was not recorded whole", what.begin().frame());
      continue;
    }
    auto cue = cue_of(what, event->offset);
    if (!cue) return recording_.at(event->offset, cue.error());
    next_ = *std::move(cue);
  }
  return {};
}

Status Replay::take(const proto::RecordingEvent& event) {
  if (event.has_snapshot()) {
    const proto::State& state = event.snapshot();
    if (!state.has_scene() || !state.has_roi() || !state.has_render()) return Error("a state that is not whole");
    state_ = state;
    hasher_ = StateHasher(state_);
    scene_changed_ = roi_changed_ = render_changed_ = buffers_changed_ = true;
    LFD_TRY_STATUS(check_numbers(state_.scene()));
    return take_assets();
  }
  if (!event.has_update()) return {};
  const proto::Update& update = event.update();
  LFD_TRY_STATUS(apply_update(state_, update));
  hasher_.updated(state_, update);
  scene_changed_ |= update.has_scene();
  for (const proto::MovedInstance& moved : update.moved_instance()) moved_instances_.insert(moved.index());
  for (const proto::MovedLight& moved : update.moved_light()) moved_lights_.insert(moved.index());
  roi_changed_ |= update.has_roi();
  render_changed_ |= update.has_render();
  buffers_changed_ |= update.has_buffers();
  LFD_TRY_STATUS(update.has_scene() ? check_numbers(state_.scene()) : check_moved_numbers(update));
  return names_assets(update) ? take_assets() : Status();
}

// Those that are here already stay as they are: most updates move things.
Status Replay::take_assets() {
  Assets assets;
  lacks_assets_ = false;
  for (const std::string& hash : asset_hashes(state_.scene())) {
    if (const auto known = assets_.find(hash); known != assets_.end()) {
      assets.insert(*known);
    } else if (recording_.has_asset(hash)) {
      LFD_TRY(assets[hash], recording_.asset(hash));
      scene_changed_ = true;
    } else {
      lacks_assets_ = true;
    }
  }
  assets_ = std::move(assets);
  return {};
}

Result<Replay::Cue> Replay::cue_of(const proto::RecordingEvent& event, std::uint64_t offset) {
  Cue cue{.frame = event.begin().frame(),
          .at = std::chrono::nanoseconds(event.nanoseconds()),
          .state_hash = hasher_.hash(),
          .change = {},
          .offset = offset};
  if (cue.state_hash != event.begin().state_hash()) {
    return Error(fmt::format("frame {}: its state has hash {}; {} was recorded", cue.frame, cue.state_hash,
                             event.begin().state_hash()));
  }
  Change change;
  proto::Update& update = change.update;
  if (scene_changed_) {
    *update.mutable_scene() = state_.scene();
    change.assets = assets_;
  } else {
    add_moved(update);
  }
  if (roi_changed_) *update.mutable_roi() = state_.roi();
  if (render_changed_) *update.mutable_render() = state_.render();
  if (buffers_changed_) update.set_buffers(state_.buffers());
  if (update.ByteSizeLong() > 0) cue.change = std::move(change);
  scene_changed_ = roi_changed_ = render_changed_ = buffers_changed_ = false;
  moved_instances_.clear();
  moved_lights_.clear();
  return cue;
}

void Replay::add_moved(proto::Update& update) const {
  for (const std::uint32_t index : moved_instances_) {
    const proto::Instance& instance = state_.scene().instance(static_cast<int>(index));
    proto::MovedInstance& moved = *update.add_moved_instance();
    moved.set_index(index);
    moved.set_mesh(instance.mesh());
    *moved.mutable_world_from_mesh() = instance.world_from_mesh();
  }
  for (const std::uint32_t index : moved_lights_) {
    proto::MovedLight& moved = *update.add_moved_light();
    moved.set_index(index);
    *moved.mutable_light() = state_.scene().light(static_cast<int>(index));
  }
}

std::string Replay::title() const {
  const Recording::Contents& contents = recording_.contents();
  std::string text = fmt::format("replays {}, {} to {}, of {:.3f} s, recorded by version {} on display \"{}\"",
                                 count_text(contents.frames, "frame"), contents.first_frame, contents.last_frame,
                                 static_cast<double>(contents.nanoseconds) * 1e-9, recording_.header().version(),
                                 recording_.header().display().name());
  if (options_.frames)
    text += fmt::format("; of these, frames {} to {}", options_.frames->first, options_.frames->last);
  if (contents.stale_frames > 0)
    text += fmt::format("; {} had stale modules, which are drawn now", count_text(contents.stale_frames, "frame"));
  return text;
}

std::string Replay::summary() const {
  std::string text = fmt::format("{} replayed; ", count_text(replayed_, "frame"));
  text += differing_ == 0 ? fmt::format("each of {} was of the recorded state", count_text(drawn_, "node's picture"))
                          : fmt::format("{} of {} were not of the recorded state", differing_,
                                        count_text(drawn_, "node's picture"));
  if (left_out_ > 0)
    text += fmt::format("; {} left out: scenes were not recorded whole", count_text(left_out_, "frame"));
  return text;
}

}  // namespace lfd::controller
