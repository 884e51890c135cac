// Drawing in turn, and sorting the times by pass.
#include "bench/frame/pass_times.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/clock.h"
#include "base/log.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

constexpr int kWarmUpFrames = 2;  // of each kind: shaders are compiled, targets made, clocks raised
constexpr auto kProgress = std::chrono::seconds(5);
constexpr FrameOptions kOnlyDraw{.buffers = {}, .time_modules = false, .reuse = false, .read_back = false};

// All frames of one kind.
struct Series {
  std::vector<std::pair<std::string, std::vector<double>>> passes;
  std::vector<double> sums, walls;
  std::vector<std::string> left_out;

  void add(const proto::NodeReport& report, double wall_ms) {
    double sum = 0;
    std::map<std::string, double> of_frame;  // a pass may be timed in parts
    for (const proto::PassTime& pass : report.pass()) {
      if (pass.pass() == "geometry" || pass.pass() == "readback") continue;  // the CPU's
      of_frame[pass.pass()] += pass.gpu_ms();
      sum += pass.gpu_ms();
    }
    for (const auto& [pass, gpu_ms] : of_frame) {
      auto known = std::ranges::find(passes, pass, &decltype(passes)::value_type::first);
      if (known == passes.end()) known = passes.insert(passes.end(), {pass, {}});
      known->second.push_back(gpu_ms);
    }
    sums.push_back(sum);
    walls.push_back(wall_ms);
    left_out.clear();
    for (const proto::LeftOut& left : report.left_out()) {
      left_out.push_back(fmt::format("{} {}: {}", left.what(), left.which(), left.why()));
      if (left.count() > 1) left_out.back() += fmt::format(" ({})", left.count());
    }
  }

  std::optional<Spread> spread(const std::string& pass) const {
    const auto known = std::ranges::find(passes, pass, &decltype(passes)::value_type::first);
    if (known == passes.end()) return std::nullopt;
    return spread_of(known->second);
  }
};

Status draw_one(Renderer& renderer, const proto::State& state, const Assets& assets, Series* series) {
  LFD_TRY_STATUS(renderer.set_state(state, assets));
  const auto start = Clock::now();
  LFD_TRY_STATUS(renderer.draw(kOnlyDraw));
  const FrameResult result = renderer.collect();
  if (series != nullptr) series->add(result.report, milliseconds(Clock::now() - start));
  return {};
}

PassTimes table_of(const Series& without, const Series& with, int frames) {
  PassTimes times;
  times.frames = frames;
  for (const std::string pass :
       {"z_prepass", "gbuffer", "pyramid", "ao", "ao_upsample", "blur_horizontal", "blur_vertical", "post"}) {
    const bool is_rare =
        pass == "pyramid" || pass == "ao_upsample";  // shown where the method or the settings ask for them
    if (is_rare && !with.spread(pass)) continue;
    times.pass.push_back({pass, without.spread(pass), with.spread(pass)});
  }
  times.sum = {"all passes", spread_of(without.sums), spread_of(with.sums)};
  times.wall = {"wall clock", spread_of(without.walls), spread_of(with.walls)};
  times.left_out_without_ao = without.left_out;
  times.left_out_with_ao = with.left_out;
  return times;
}

}  // namespace

Result<PassTimes> time_passes(Renderer& renderer, const proto::State& state, const Assets& assets, int frames) {
  proto::State without = state;
  without.mutable_render()->mutable_ao()->set_enabled(false);
  Series series_without, series_with;
  auto next_progress = Clock::now() + kProgress;
  for (int frame = -kWarmUpFrames; frame < frames; ++frame) {
    const bool counts = frame >= 0;
    LFD_TRY_STATUS(draw_one(renderer, without, assets, counts ? &series_without : nullptr));
    LFD_TRY_STATUS(draw_one(renderer, state, assets, counts ? &series_with : nullptr));
    if (Clock::now() < next_progress) continue;
    log::info("frame {} of {}", frame + 1, frames);
    next_progress = Clock::now() + kProgress;
  }
  return table_of(series_without, series_with, frames);
}

}  // namespace lfd::bench
