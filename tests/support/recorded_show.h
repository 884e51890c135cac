// A small recorded show, put together record by record, with states whose hashes are true.
#pragma once

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "base/hash.h"
#include "base/version.h"
#include "calibration/display.h"
#include "proto/calibration_file.h"
#include "proto/recording_reader.h"
#include "proto/recording_writer.h"
#include "proto/scene_data.h"
#include "proto/state.h"
#include "tests/support/unwrapped.h"

namespace lfd::testing_support {

class RecordedShow {
 public:
  // The beginning of a file, and a header of this display.
  explicit RecordedShow(const DisplayCalibration& display) : bytes(recording_beginning()) {
    proto::RecordingRecord record;
    proto::RecordingHeader& header = *record.mutable_header();
    header.set_format(kRecordingFormat);
    header.set_version(kVersion);
    header.set_protocol(kProtocolVersion);
    *header.mutable_display() = write_calibration(display);
    header.set_calibration_hash(calibration_hash(display));
    add(record);
  }

  void add(const proto::RecordingRecord& record) { bytes += record_bytes(record); }

  void snapshot(proto::State whole) {
    state = std::move(whole);
    *event().mutable_snapshot() = state;
    add(record_);
  }
  void update(proto::Update one) {
    one.set_sequence(state.sequence() + 1);
    const Status applied = apply_update(state, one);
    LFD_CHECK(applied, applied.error().message());
    *event().mutable_update() = std::move(one);
    add(record_);
  }
  void frame(std::uint64_t number) {
    proto::RecordingBegin& begin = *event().mutable_begin();
    begin.set_frame(number);
    begin.set_state_hash(state_hash(state));
    add(record_);
    event().mutable_swap()->set_frame(number);
    add(record_);
  }
  // In pieces of so many bytes.
  void asset(const std::string& content, std::size_t piece_bytes = std::size_t{1} << 20) {
    for (std::size_t at = 0; at == 0 || at < content.size(); at += piece_bytes) {
      proto::RecordingRecord record;
      record.mutable_piece()->set_hash(content_hash(content));
      record.mutable_piece()->set_offset(at);
      record.mutable_piece()->set_total(content.size());
      record.mutable_piece()->set_content(content.substr(at, piece_bytes));
      add(record);
    }
  }
  void assets(const Assets& all) {
    for (const auto& [hash, content] : all) asset(*content);
  }
  void end(const std::string& reason = "the test is over") {
    proto::RecordingRecord record;
    record.mutable_end()->set_reason(reason);
    add(record);
  }

  std::string bytes;                   // of the file
  std::uint64_t now_ns = 0;            // of the next event
  std::uint64_t step_ns = 10'000'000;  // from event to event
  proto::State state;

 private:
  proto::RecordingEvent& event() {
    record_.Clear();
    record_.mutable_event()->set_nanoseconds(now_ns);
    now_ns += step_ns;
    return *record_.mutable_event();
  }
  proto::RecordingRecord record_;
};

inline Result<Recording> read_recording(const std::string& bytes) {
  return Recording::read(std::make_unique<std::istringstream>(bytes));
}

// A complete state of this scene.
inline proto::State whole_state(const SceneData& data, const proto::RegionOfInterest& roi) {
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = data.scene;
  *state.mutable_roi() = roi;
  state.mutable_render();
  return state;
}

}  // namespace lfd::testing_support
