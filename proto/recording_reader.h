// Reads a recording of a show (schema: proto/recording.proto): looks through all of it first, then gives out its events
// one by one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/recording.pb.h"

namespace lfd {

// The numbers of frames of a recording, both included.
struct FrameRange {
  std::uint64_t first = 0, last = 0;
};

// "3-20", or "7" alone.
Result<FrameRange> parse_frame_range(const std::string& text);

class Recording {
 public:
  // Errors name file and place: `show.lfdrec: offset 1234: a record of 3735928559 bytes; at most 68157440 are
  // possible`. A file that ends too early is no error: what is whole of it is there, and note() says so.
  static Result<Recording> open(const std::filesystem::path& path);
  // The same of any bytes; errors do not name them.
  static Result<Recording> read(std::unique_ptr<std::istream> stream);

  const proto::RecordingHeader& header() const { return header_; }

  // What was found when it was looked through.
  struct Contents {
    std::uint64_t frames = 0;                       // that were begun
    std::uint64_t first_frame = 0, last_frame = 0;  // where there are any
    std::uint64_t nanoseconds = 0;                  // of the last event
    std::uint64_t updates = 0;
    std::uint64_t stale_frames = 0;  // that swapped with stale modules
    std::string end;                 // why it ends; empty where it was cut off
    std::string note;                // for people, where it was cut off; empty otherwise
  };
  const Contents& contents() const { return contents_; }

  bool has_asset(const std::string& hash) const { return assets_.contains(hash); }
  // Read from the file each time. The asset is there; errors: the file has changed meanwhile.
  Result<std::shared_ptr<const std::string>> asset(const std::string& hash);

  struct Event {
    proto::RecordingEvent what;
    std::uint64_t offset = 0;  // in the file
  };
  // The next event; absent after the last one.
  Result<std::optional<Event>> next();

  // `error` at a place of the file, as the errors of this class are.
  Error at(std::uint64_t offset, const Error& error) const;

 private:
  struct Record {
    proto::RecordingRecord what;
    std::uint64_t offset = 0;
    std::uint64_t end = 0;
  };
  struct Scan;  // what has to be remembered from record to record while the file is looked through

  Recording(std::string name, std::unique_ptr<std::istream> stream, std::uint64_t size);
  Status look_through();
  Status see(const Record& record, Scan& scan);
  Status see_event(const proto::RecordingEvent& event, Scan& scan);
  Status see_piece(const proto::RecordingPiece& piece, std::uint64_t offset, Scan& scan);
  // The record there; absent where the file ends before the record does.
  Result<std::optional<Record>> record_at(std::uint64_t offset);

  std::string name_;  // of the file; may be empty
  std::unique_ptr<std::istream> stream_;
  std::uint64_t size_ = 0;
  proto::RecordingHeader header_;
  Contents contents_;
  std::map<std::string, std::uint64_t> assets_;  // offset of the first piece, by hash
  std::uint64_t whole_ = 0;                      // where the last whole record ends
  std::uint64_t next_ = 0;                       // where next() reads on
};

}  // namespace lfd
