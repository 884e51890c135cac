// Fuzz target: recordings are refused with the place, or all of them can be replayed up to an error with its place.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

#include "base/check.h"
#include "base/log.h"
#include "calibration/make.h"
#include "controller/replay/replay.h"
#include "controller/stage.h"

namespace {

constexpr int kMostFrames = 1000;

lfd::Result<lfd::Recording> read(const std::string& bytes) {
  return lfd::Recording::read(std::make_unique<std::istringstream>(bytes));
}

void check_placed(const lfd::Error& error) {
  LFD_CHECK(error.message().starts_with("offset "), "every refusal names the place");
}

void replay(const std::string& bytes, const lfd::Deployment& deployment) {
  namespace controller = lfd::controller;
  auto recording = read(bytes);
  LFD_CHECK(recording, "it was read before");
  const std::uint64_t frames = recording->contents().frames;
  auto replay = controller::Replay::of(*std::move(recording), deployment.display, {.any_display = true});
  if (!replay) {
    LFD_CHECK(!replay.error().message().empty(), "every refusal has a reason");
    return;
  }
  auto stage = controller::Stage::of(deployment);
  LFD_CHECK(stage, "a deployment has a stage");
  std::uint64_t begun = 0;
  for (int i = 0; i < kMostFrames && replay->next() != nullptr; ++i) {
    const std::string hash = replay->next()->state_hash;
    if (auto change = replay->take_change()) {
      if (!stage->show_recorded(std::move(change->update), std::move(change->assets))) return;
    }
    LFD_CHECK(stage->store().hash() == hash, "what is shown is what was recorded");
    ++begun;
    if (const lfd::Status next = replay->begun({}); !next) return check_placed(next.error());
  }
  LFD_CHECK(begun <= frames, "no frame is there that was not recorded");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  [[maybe_unused]] static const bool kQuiet = (lfd::start_log("fuzz", "off"), true);
  static const lfd::Deployment kDeployment = [] {
    lfd::Deployment deployment;
    deployment.display = *lfd::make_display("desk");
    return deployment;
  }();
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  auto recording = read(bytes);
  if (!recording) {
    check_placed(recording.error());
    return 0;
  }
  const lfd::Recording::Contents contents = recording->contents();
  LFD_CHECK(contents.end.empty() != contents.note.empty(), "it ends, or was cut off");
  std::uint64_t frames = 0, last_ns = 0;
  while (true) {
    const auto event = recording->next();
    LFD_CHECK(event, "what was looked through can be read");
    if (!*event) break;
    LFD_CHECK((*event)->what.nanoseconds() >= last_ns, "time goes on");
    last_ns = (*event)->what.nanoseconds();
    if ((*event)->what.has_begin()) ++frames;
  }
  LFD_CHECK(frames == contents.frames, "as many frames as were found");
  replay(bytes, kDeployment);
  return 0;
}
