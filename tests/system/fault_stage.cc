// Daemons by their names.
#include "tests/system/fault_stage.h"

#include <cstdio>
#include <iostream>
#include <thread>

#include "base/check.h"
#include "base/file.h"
#include "base/log.h"
#include "proto/frame_files.h"

namespace lfd::harness {
namespace fs = std::filesystem;
namespace {

constexpr auto kPause = std::chrono::milliseconds(20);
constexpr int kModules = 4;
constexpr double kMostPause_s = 0.05 + 2 * 0.25;

// Of the stamp that a line of a log begins with, HH:MM:SS.mmm.
double time_of_day_s(const std::string& line) {
  int hours = 0, minutes = 0;
  double seconds = 0;
  LFD_CHECK(std::sscanf(line.c_str(), "%d:%d:%lf", &hours, &minutes, &seconds) == 3, "a line of the log has a stamp");
  return 3600.0 * hours + 60.0 * minutes + seconds;
}

}  // namespace

FaultStage::FaultStage(const std::string& more, std::string pacing, const std::string& host) {
  const auto address = [&host] { return fmt::format("tcp://{}:{}", host, free_port()); };
  endpoint_ = address();
  deployment_ = bench_.deployment(
      fmt::format("sink: DISPLAY addresses {{ control: \"{}\" state: \"{}\" bulk: \"{}\" images: \"{}\" }} {} {}",
                  endpoint_, address(), address(), address(), pacing, more));
  daemons_.emplace(LFD_BIN_DIR, deployment_, shown());
}

FaultStage::~FaultStage() {
  constexpr std::size_t kLastWords = 40;
  if (!testing::Test::HasFailure()) return;
  for (const std::string& name : started_) {
    const std::vector<std::string> lines = daemons_->at(name).lines();
    for (std::size_t i = lines.size() - std::min(lines.size(), kLastWords); i < lines.size(); ++i)
      std::cout << name << " | " << lines[i] << "\n";
  }
}

Process& FaultStage::start_as(const std::string& name, bench::Daemons::Start how) {
  started_.insert(name);
  const auto started = daemons_->start(name, std::move(how));
  LFD_CHECK(started, started.error().message());
  if (name == "controller") {
    EXPECT_TRUE((*started)->wait_for_line("control tcp", kClusterPatience));
  }
  return **started;
}

void FaultStage::kill(const std::string& name) { daemons_->kill(name); }

testing::AssertionResult FaultStage::frames_went_on() {
  constexpr double kDay_s = 24 * 3600;
  std::optional<double> before;
  int swaps = 0;
  for (const std::string& line : (*this)["controller"].lines()) {
    if (line.find(": swap after ") == std::string::npos) continue;
    const double now = time_of_day_s(line);
    const double pause_s = before ? now - *before + (now < *before ? kDay_s : 0) : 0;
    if (pause_s > kMostPause_s) return testing::AssertionFailure() << pause_s << " s without a frame before: " << line;
    before = now;
    ++swaps;
  }
  if (swaps < 10) return testing::AssertionFailure() << "only " << swaps << " swaps in the controller's log";
  return testing::AssertionSuccess();
}

std::uint64_t FaultStage::last_frame() const {
  const Result<proto::Status> status = status_at(endpoint_);
  EXPECT_TRUE(status);
  return status ? status->frame() : 0;
}

testing::AssertionResult FaultStage::is_whole() const {
  const auto whole = becomes(endpoint_, [](const proto::Status& status) {
    return status.stale_modules() == 0 && peer_in(status, "left").state() == "ready" &&
           peer_in(status, "right").state() == "ready" && peer_in(status, "display").state() == "ready" &&
           all_nodes_follow(status);
  });
  if (!whole) return whole;
  return shows_frames_after(last_frame() + 3);
}

testing::AssertionResult FaultStage::is_whole_by_spare() const {
  return becomes(endpoint_, [](const proto::Status& status) {
    return peer_in(status, "right").state() == "out" && peer_in(status, "reserve").state() == "ready" &&
           status.stale_modules() == 0;
  });
}

std::map<int, std::string> FaultStage::pictures_from(std::uint64_t frame) const {
  const auto deadline = Clock::now() + kClusterPatience;
  while (Clock::now() < deadline) {
    const std::uint64_t last = last_shown_frame().value_or(0);
    for (std::uint64_t at = frame; at < last; ++at) {
      const std::map<int, std::string> pictures = pictures_of(at);
      if (pictures.size() == kModules) return pictures;
    }
    std::this_thread::sleep_for(kPause);
  }
  ADD_FAILURE() << "no whole frame is written from frame " << frame << " on";
  return {};
}

std::map<int, std::string> FaultStage::pictures_of(std::uint64_t frame) const {
  std::map<int, std::string> pictures;
  for (int module = 0; module < kModules; ++module) {
    const auto path = image_path(shown(), frame, static_cast<std::uint32_t>(module), proto::COLOR);
    if (!fs::exists(path)) break;
    if (auto bytes = read_file(path)) pictures[module] = *std::move(bytes);
  }
  return pictures;
}

std::optional<std::uint64_t> FaultStage::last_shown_frame() const {
  const std::set<std::uint64_t> frames = frames_in(shown());
  return frames.empty() ? std::nullopt : std::optional(*frames.rbegin());
}

testing::AssertionResult FaultStage::shows_frames_after(std::uint64_t frame) const {
  const auto deadline = Clock::now() + kClusterPatience;
  while (last_shown_frame().value_or(0) <= frame && Clock::now() < deadline) std::this_thread::sleep_for(kPause);
  const std::uint64_t last = last_shown_frame().value_or(0);
  if (last > frame) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "the last frame shown is " << last << "; one after " << frame << " is expected";
}

}  // namespace lfd::harness
