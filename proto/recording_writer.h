// Writes a recording of a show (schema: proto/recording.proto), record by record, so that what is written can be read
// whatever becomes of the writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "proto/recording.pb.h"

namespace lfd {

inline constexpr std::string_view kRecordingMark = "lfd recording\n";
inline constexpr std::uint32_t kRecordingFormat = 2;

// No record is longer: a snapshot fits into one message of the control channel, and assets are written in pieces.
inline constexpr std::size_t kMostRecord_bytes = std::size_t{65} << 20;

// The file's bytes up to its first record, and those of one record.
std::string recording_beginning();
std::string record_bytes(const proto::RecordingRecord& record);

class RecordingWriter {
 public:
  // Makes the file and writes its header. An existing regular file is refused: a recording cannot be made again.
  static Result<RecordingWriter> create(const std::filesystem::path& path, proto::RecordingHeader header);

  RecordingWriter(RecordingWriter&& other) noexcept
      : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), bytes_(other.bytes_) {}
  RecordingWriter& operator=(RecordingWriter&&) = delete;
  ~RecordingWriter();

  // Each hands its bytes to the system before it returns. The error says why it could not (the disk is full): write
  // nothing more then.
  Status event(proto::RecordingEvent event);
  Status asset(const std::string& hash, std::string_view content);
  Status end(const std::string& reason);

  std::uint64_t bytes() const { return bytes_; }  // written so far

 private:
  RecordingWriter(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  Status write(const proto::RecordingRecord& record);
  Status write(std::string_view bytes);

  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t bytes_ = 0;
};

}  // namespace lfd
