// Records in from a file, each checked against those before it.
#include "proto/recording_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <string_view>

#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/version.h"
#include "proto/asset_gatherer.h"
#include "proto/recording_writer.h"

namespace lfd {
namespace {

constexpr std::size_t kLength_bytes = 4;

std::string frames_text(std::uint64_t count) { return fmt::format("{} frame{}", count, count == 1 ? "" : "s"); }

bool parse_number(std::string_view text, std::uint64_t& number) {
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  return failure == std::errc() && end == text.data() + text.size();
}

}  // namespace

Result<FrameRange> parse_frame_range(const std::string& text) {
  const std::size_t dash = text.find('-');
  FrameRange range;
  const bool has_first = parse_number(std::string_view(text).substr(0, dash), range.first);
  range.last = range.first;
  const bool has_last = dash == std::string::npos || parse_number(std::string_view(text).substr(dash + 1), range.last);
  if (has_first && has_last && range.first <= range.last) return range;
  return Error(fmt::format("{}: A-B is expected, the first and the last frame", text));
}

struct Recording::Scan {
  bool has_header = false, has_snapshot = false;
  std::string asset, content;  // the asset whose pieces come, and what is here of it
  std::uint64_t asset_offset = 0, asset_total = 0;
};

Recording::Recording(std::string name, std::unique_ptr<std::istream> stream, std::uint64_t size)
    : name_(std::move(name)), stream_(std::move(stream)), size_(size) {}

Result<Recording> Recording::open(const std::filesystem::path& path) {
  LFD_TRY_STATUS(check_readable(path));
  auto stream = std::make_unique<std::ifstream>(path, std::ios::binary);
  stream->seekg(0, std::ios::end);
  if (!*stream) return Error(fmt::format("{}: cannot be read", path.string()));
  const auto size = static_cast<std::uint64_t>(stream->tellg());
  Recording recording(path.string(), std::move(stream), size);
  LFD_TRY_STATUS(recording.look_through());
  return recording;
}

Result<Recording> Recording::read(std::unique_ptr<std::istream> stream) {
  stream->seekg(0, std::ios::end);
  const auto size = static_cast<std::uint64_t>(stream->tellg());
  Recording recording("", std::move(stream), size);
  LFD_TRY_STATUS(recording.look_through());
  return recording;
}

Error Recording::at(std::uint64_t offset, const Error& error) const {
  const Error placed = error.within(fmt::format("offset {}", offset));
  return name_.empty() ? placed : placed.within(name_);
}

Result<std::optional<Recording::Record>> Recording::record_at(std::uint64_t offset) {
  if (offset + kLength_bytes > size_) return std::optional<Record>();
  std::array<unsigned char, kLength_bytes> length_bytes{};
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(offset));
  stream_->read(reinterpret_cast<char*>(length_bytes.data()), kLength_bytes);
  std::uint64_t length = 0;
  for (std::size_t i = 0; i < kLength_bytes; ++i) length |= std::uint64_t{length_bytes[i]} << 8 * i;
  if (length > kMostRecord_bytes)
    return at(offset, Error(fmt::format("a record of {} bytes; at most {} are possible", length, kMostRecord_bytes)));
  if (offset + kLength_bytes + length > size_) return std::optional<Record>();
  std::string bytes(length, '\0');
  if (!stream_->read(bytes.data(), static_cast<std::streamsize>(length)))
    return at(offset, Error("the file cannot be read"));
  Record record{.what = {}, .offset = offset, .end = offset + kLength_bytes + length};
  if (!record.what.ParseFromString(bytes)) return at(offset, Error("a record that cannot be parsed"));
  return std::optional(std::move(record));
}

Status Recording::look_through() {
  std::string mark(std::min<std::uint64_t>(size_, kRecordingMark.size()), '\0');
  stream_->clear();
  stream_->seekg(0);
  stream_->read(mark.data(), static_cast<std::streamsize>(mark.size()));
  if (mark != kRecordingMark) return at(0, Error("not a recording: it does not begin as one"));
  Scan scan;
  whole_ = next_ = kRecordingMark.size();
  while (contents_.end.empty()) {
    LFD_TRY(const std::optional<Record> record, record_at(whole_));
    if (!record) break;
    if (const Status seen = see(*record, scan); !seen) return at(record->offset, seen.error());
    whole_ = record->end;
  }
  if (!scan.has_header) return at(whole_, Error("the file ends before its header"));
  if (!contents_.end.empty() && whole_ < size_)
    return at(whole_, Error(fmt::format("{} bytes after its end", size_ - whole_)));
  if (!scan.has_snapshot) return at(whole_, Error("there is no state in it"));
  if (contents_.end.empty()) {
    contents_.note = fmt::format("it was cut off {}; {} of it can be replayed",
                                 whole_ < size_ ? fmt::format("in the middle of a record, at offset {}", whole_)
                                                : fmt::format("at offset {}, before its end", whole_),
                                 frames_text(contents_.frames));
  }
  return {};
}

Status Recording::see(const Record& record, Scan& scan) {
  const proto::RecordingRecord& what = record.what;
  if (what.has_header() == scan.has_header)
    return Error(scan.has_header ? "a second header" : "the first record is no header");
  const bool continues = what.has_piece() && what.piece().offset() > 0;
  if (!scan.asset.empty() && !continues) return Error(fmt::format("asset {} has not all its pieces", scan.asset));
  switch (what.what_case()) {
    case proto::RecordingRecord::kHeader:
      scan.has_header = true;
      header_ = what.header();
      if (header_.format() != kRecordingFormat) {
        return Error(fmt::format("format {}, recorded by version {}; format {} is read here (version {})",
                                 header_.format(), header_.version(), kRecordingFormat, kVersion));
      }
      if (header_.protocol() == kProtocolVersion) return {};
      return Error(fmt::format("messages of protocol {}, recorded by version {}; protocol {} is spoken here",
                               header_.protocol(), header_.version(), kProtocolVersion));
    case proto::RecordingRecord::kEvent:
      return see_event(what.event(), scan);
    case proto::RecordingRecord::kPiece:
      return see_piece(what.piece(), record.offset, scan);
    case proto::RecordingRecord::kEnd:
      contents_.end = what.end().reason().empty() ? "no reason is said" : what.end().reason();
      return {};
    case proto::RecordingRecord::WHAT_NOT_SET:
      break;
  }
  return Error("a record of no known kind");
}

Status Recording::see_event(const proto::RecordingEvent& event, Scan& scan) {
  if (event.nanoseconds() < contents_.nanoseconds) {
    return Error(fmt::format("it happens {} ns after the start; the event before it, {} ns", event.nanoseconds(),
                             contents_.nanoseconds));
  }
  contents_.nanoseconds = event.nanoseconds();
  if (!event.has_snapshot() && !scan.has_snapshot) return Error("the first event is no state");
  switch (event.what_case()) {
    case proto::RecordingEvent::kSnapshot:
      scan.has_snapshot = true;
      return {};
    case proto::RecordingEvent::kUpdate:
      ++contents_.updates;
      return {};
    case proto::RecordingEvent::kBegin: {
      const std::uint64_t frame = event.begin().frame();
      if (contents_.frames > 0 && frame <= contents_.last_frame)
        return Error(fmt::format("frame {} begins after frame {}", frame, contents_.last_frame));
      if (contents_.frames++ == 0) contents_.first_frame = frame;
      contents_.last_frame = frame;
      return {};
    }
    case proto::RecordingEvent::kSwap:
      if (event.swap().stale_modules_size() > 0) ++contents_.stale_frames;
      return {};
    case proto::RecordingEvent::WHAT_NOT_SET:
      break;
  }
  return Error("an event of no known kind");
}

// The content grows as it comes: what a piece says of the whole costs nothing.
Status Recording::see_piece(const proto::RecordingPiece& piece, std::uint64_t offset, Scan& scan) {
  if (piece.offset() == 0) {
    if (piece.hash().empty()) return Error("an asset without a hash");
    if (assets_.contains(piece.hash())) return Error(fmt::format("asset {} is there already", piece.hash()));
    if (piece.total() > AssetGatherer::kMaxAsset_bytes) {
      return Error(fmt::format("asset {}: {} bytes; at most {} are possible", piece.hash(), piece.total(),
                               AssetGatherer::kMaxAsset_bytes));
    }
    scan.asset = piece.hash();
    scan.content.clear();
    scan.asset_offset = offset;
    scan.asset_total = piece.total();
  }
  const std::uint64_t left = scan.asset_total - scan.content.size();
  const bool fits = piece.hash() == scan.asset && !scan.asset.empty() && piece.offset() == scan.content.size() &&
                    piece.total() == scan.asset_total && piece.content().size() <= left &&
                    (!piece.content().empty() || left == 0);
  if (!fits) {
    return Error(fmt::format("asset {}: a piece of {} bytes at {} of {} does not fit", piece.hash(),
                             piece.content().size(), piece.offset(), piece.total()));
  }
  scan.content += piece.content();
  if (scan.content.size() < scan.asset_total) return {};
  if (content_hash(scan.content) != scan.asset)
    return Error(fmt::format("asset {}: its content has another hash", scan.asset));
  assets_[scan.asset] = scan.asset_offset;
  scan.asset.clear();
  scan.content.clear();
  return {};
}

Result<std::shared_ptr<const std::string>> Recording::asset(const std::string& hash) {
  std::uint64_t offset = assets_.at(hash);
  const std::uint64_t begin = offset;
  std::string content;
  while (true) {
    LFD_TRY(const std::optional<Record> record, record_at(offset));
    if (!record || record->what.piece().hash() != hash) break;
    content += record->what.piece().content();
    offset = record->end;
    if (content.size() >= record->what.piece().total()) break;
  }
  if (content_hash(content) != hash) return at(begin, Error(fmt::format("asset {} has changed meanwhile", hash)));
  return std::make_shared<const std::string>(std::move(content));
}

Result<std::optional<Recording::Event>> Recording::next() {
  while (next_ < whole_) {
    LFD_TRY(std::optional<Record> record, record_at(next_));
    if (!record) return at(next_, Error("the file has changed meanwhile"));
    next_ = record->end;
    if (!record->what.has_event()) continue;
    return std::optional(Event{std::move(*record->what.mutable_event()), record->offset});
  }
  return std::optional<Event>();
}

}  // namespace lfd
