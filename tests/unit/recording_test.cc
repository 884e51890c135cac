// Recordings: what is written is read, and what is no recording is refused with the place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "proto/settings.h"
#include "tests/support/made.h"
#include "tests/support/recorded_show.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::made_data;
using testing_support::read_recording;
using testing_support::RecordedShow;
using testing_support::unwrapped;
using testing_support::whole_state;

DisplayCalibration display() {
  DisplayCalibration display;
  display.name = "one";
  display.screen = {1.6, 0.9};
  display.image = {16, 8};
  display.optics.diffuser = Diffuser::kLinear;
  display.angular_scattering_rad = 0.4;
  display.modules.push_back({Emitter{0, 0, -1}, IdealMap{}});
  return display;
}

// Two frames of a scene, then one of another buffers' wish.
RecordedShow small_show() {
  RecordedShow show(display());
  const SceneData data = made_data("plane");
  show.snapshot(whole_state(data, write_roi(testing_support::whole_scene(data.scene, display()))));
  show.frame(7);
  show.assets(data.assets);
  proto::Update update;
  update.set_buffers(1);
  show.update(update);
  show.frame(8);
  show.frame(11);
  return show;
}

std::string refusal_of(const std::string& bytes) {
  const auto recording = read_recording(bytes);
  return recording ? "it is read" : recording.error().message();
}

TEST(Recording, GivesOutWhatWasWrittenInItsOrder) {
  RecordedShow show = small_show();
  show.end("enough");
  Recording recording = unwrapped(read_recording(show.bytes));
  EXPECT_EQ(recording.header().calibration_hash(), calibration_hash(display()));
  EXPECT_EQ(recording.contents().frames, 3U);
  EXPECT_EQ(recording.contents().first_frame, 7U);
  EXPECT_EQ(recording.contents().last_frame, 11U);
  EXPECT_EQ(recording.contents().updates, 1U);
  EXPECT_EQ(recording.contents().end, "enough");
  EXPECT_EQ(recording.contents().note, "");
  std::vector<int> kinds;
  std::uint64_t last = 0;
  while (const auto event = unwrapped(recording.next())) {
    kinds.push_back(event->what.what_case());
    EXPECT_GE(event->what.nanoseconds(), last);
    last = event->what.nanoseconds();
  }
  using Event = proto::RecordingEvent;
  EXPECT_EQ(kinds, (std::vector<int>{Event::kSnapshot, Event::kBegin, Event::kSwap, Event::kUpdate, Event::kBegin,
                                     Event::kSwap, Event::kBegin, Event::kSwap}));
  EXPECT_EQ(recording.contents().nanoseconds, last);
  for (const auto& [hash, content] : made_data("plane").assets) EXPECT_EQ(*unwrapped(recording.asset(hash)), *content);
}

TEST(Recording, AssetsComeInPiecesAndMayBeEmpty) {
  RecordedShow show = small_show();
  const std::string large(1000, 'x');
  show.asset(large, 300);
  show.asset("");
  show.end();
  Recording recording = unwrapped(read_recording(show.bytes));
  EXPECT_EQ(*unwrapped(recording.asset(content_hash(large))), large);
  EXPECT_EQ(*unwrapped(recording.asset(content_hash(""))), "");
  EXPECT_FALSE(recording.has_asset(content_hash("else")));
}

// A killed recorder, a full disk: wherever the file ends.
TEST(Recording, IsReadUpToWhereverItWasCutOff) {
  RecordedShow show = small_show();
  const std::size_t whole = show.bytes.size();
  show.end();
  std::uint64_t most_frames = 0;
  int refused = 0;
  for (std::size_t size = 0; size < show.bytes.size(); ++size) {
    const auto recording = read_recording(show.bytes.substr(0, size));
    if (!recording) {
      EXPECT_EQ(most_frames, 0U) << "once there is a state, nothing of it is lost: " << recording.error().message();
      ++refused;
      continue;
    }
    EXPECT_GE(recording->contents().frames, most_frames) << size;
    most_frames = recording->contents().frames;
    EXPECT_EQ(recording->contents().end, "");
    EXPECT_THAT(recording->contents().note, StartsWith(size == whole ? "it was cut off at offset" : "it was cut off"));
  }
  EXPECT_EQ(most_frames, 3U);
  EXPECT_GT(refused, 0) << "without a state there is nothing to replay";
  EXPECT_EQ(refusal_of(""), "offset 0: not a recording: it does not begin as one");
  EXPECT_THAT(refusal_of(recording_beginning()), HasSubstr("the file ends before its header"));
}

TEST(Recording, AbsurdLengthsAreRefusedWithTheirPlace) {
  RecordedShow show = small_show();
  const std::string offset = std::to_string(show.bytes.size());
  EXPECT_EQ(refusal_of(show.bytes + "\xef\xbe\xad\xde" + std::string(100, 'x')),
            "offset " + offset + ": a record of 3735928559 bytes; at most 68157440 are possible");
  EXPECT_EQ(refusal_of(show.bytes + std::string("\4\0\0\0", 4) + "\xff\xff\xff\xff"),
            "offset " + offset + ": a record that cannot be parsed");
  EXPECT_EQ(refusal_of(show.bytes + std::string("\0\0\0\0", 4)), "offset " + offset + ": a record of no known kind");
}

TEST(Recording, WhatCannotBeIsRefused) {
  const RecordedShow good = small_show();
  const std::string place = "offset " + std::to_string(good.bytes.size()) + ": ";
  proto::RecordingRecord record;
  const auto refusal_with = [&] { return refusal_of(good.bytes + record_bytes(record)); };
  record.mutable_piece()->set_hash(content_hash("other"));
  record.mutable_piece()->set_total(5);
  record.mutable_piece()->set_content("forge");
  EXPECT_EQ(refusal_with(), place + "asset " + content_hash("other") + ": its content has another hash");
  record.mutable_piece()->set_total(4);
  EXPECT_THAT(refusal_with(), HasSubstr("a piece of 5 bytes at 0 of 4 does not fit"));
  record.mutable_piece()->set_total(std::uint64_t{1} << 40);
  EXPECT_THAT(refusal_with(), HasSubstr("1099511627776 bytes; at most 2147483648 are possible"));
  record.mutable_piece()->set_total(9);
  record.mutable_piece()->set_offset(4);
  EXPECT_THAT(refusal_with(), HasSubstr("a piece of 5 bytes at 4 of 9 does not fit"));
  record.mutable_event()->mutable_begin()->set_frame(11);
  record.mutable_event()->set_nanoseconds(good.now_ns);
  EXPECT_EQ(refusal_with(), place + "frame 11 begins after frame 11");
  record.mutable_event()->set_nanoseconds(3);
  EXPECT_THAT(refusal_with(), StartsWith(place + "it happens 3 ns after the start; the event before it, "));
  record.mutable_header();
  EXPECT_EQ(refusal_with(), place + "a second header");
  EXPECT_THAT(refusal_of(recording_beginning() + record_bytes(proto::RecordingRecord())),
              HasSubstr("the first record is no header"));
  RecordedShow stateless(display());
  stateless.end();
  EXPECT_THAT(refusal_of(stateless.bytes), HasSubstr("there is no state in it"));
  record.mutable_header()->set_version("9.9");
  for (const std::uint32_t format : {1, 3}) {  // in 1, states have other hashes
    record.mutable_header()->set_format(format);
    EXPECT_THAT(refusal_of(recording_beginning() + record_bytes(record)),
                HasSubstr("format " + std::to_string(format) + ", recorded by version 9.9; format 2 is read here"));
  }
  RecordedShow longer = good;
  longer.end();
  EXPECT_THAT(refusal_of(longer.bytes + "x"), HasSubstr("1 bytes after its end"));
}

TEST(Recording, ARangeIsTwoNumbersOrOne) {
  EXPECT_EQ(unwrapped(parse_frame_range("3-20")).first, 3U);
  EXPECT_EQ(unwrapped(parse_frame_range("3-20")).last, 20U);
  EXPECT_EQ(unwrapped(parse_frame_range("7")).last, 7U);
  for (const char* const wrong : {"", "-", "3-", "-3", "20-3", "a-b", "1-2-3", "1.5", "99999999999999999999"})
    EXPECT_FALSE(parse_frame_range(wrong)) << wrong;
}

TEST(RecordingWriter, WritesWhatIsRead) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  const auto path = folder.path() / "show.lfdrec";
  const std::string large(std::size_t{3} << 20, 'x');
  proto::RecordingEvent event;
  *event.mutable_snapshot() = small_show().state;
  {
    proto::RecordingHeader header;
    header.set_calibration_hash("h");
    RecordingWriter writer = unwrapped(RecordingWriter::create(path, header));
    ASSERT_TRUE(writer.event(event));
    ASSERT_TRUE(writer.asset(content_hash(large), large));
    ASSERT_TRUE(writer.asset(content_hash(""), ""));
    ASSERT_TRUE(writer.end("enough"));
    EXPECT_EQ(writer.bytes(), std::filesystem::file_size(path));
  }
  Recording recording = unwrapped(Recording::open(path));
  EXPECT_EQ(recording.header().calibration_hash(), "h");
  EXPECT_EQ(recording.contents().end, "enough");
  EXPECT_EQ(*unwrapped(recording.asset(content_hash(large))), large);
  EXPECT_TRUE(recording.has_asset(content_hash("")));
  EXPECT_TRUE(same_message(unwrapped(recording.next())->what, event));
  const auto again = RecordingWriter::create(path, {});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().message(), path.string() + ": exists already; it is not overwritten");
}

TEST(RecordingWriter, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const auto writer = RecordingWriter::create("/dev/full", {});
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().message(), "/dev/full: cannot be written: No space left on device; 0 bytes of it are");
}

TEST(Recording, ErrorsNameTheFile) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  const auto path = folder.path() / "no.lfdrec";
  ASSERT_TRUE(write_file(path, "something else"));
  const auto read = Recording::open(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message(), path.string() + ": offset 0: not a recording: it does not begin as one");
}

}  // namespace
}  // namespace lfd
