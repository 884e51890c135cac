// Records out to a file.
#include "proto/recording_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/file.h"
#include "base/log.h"
#include "base/version.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kPiece_bytes = std::size_t{1} << 20;

}  // namespace

std::string recording_beginning() { return std::string(kRecordingMark); }

std::string record_bytes(const proto::RecordingRecord& record) {
  const std::string content = record.SerializeAsString();
  LFD_CHECK(content.size() <= kMostRecord_bytes, "what goes through a control channel fits into a record");
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(content.size() >> shift & 0xFFu);
  return bytes + content;
}

Result<RecordingWriter> RecordingWriter::create(const fs::path& path, proto::RecordingHeader header) {
  LFD_TRY_STATUS(check_writable(path));
  const auto exists = [&] { return Error(fmt::format("{}: exists already; it is not overwritten", path.string())); };
  std::error_code failure;
  if (fs::is_regular_file(path, failure)) return exists();
  const int may_exist = fs::exists(path, failure) ? 0 : O_EXCL;  // a device, a pipe
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | may_exist, 0666);
  if (descriptor < 0 && errno == EEXIST) return exists();
  if (descriptor < 0) return Error(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
  RecordingWriter writer(path, descriptor);
  header.set_format(kRecordingFormat);
  header.set_version(kVersion);
  header.set_protocol(kProtocolVersion);
  proto::RecordingRecord record;
  *record.mutable_header() = std::move(header);
  LFD_TRY_STATUS(writer.write(recording_beginning()));
  LFD_TRY_STATUS(writer.write(record));
  return writer;
}

RecordingWriter::~RecordingWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status RecordingWriter::event(proto::RecordingEvent event) {
  proto::RecordingRecord record;
  *record.mutable_event() = std::move(event);
  return write(record);
}

Status RecordingWriter::asset(const std::string& hash, std::string_view content) {
  std::size_t offset = 0;
  do {
    const std::string_view piece = content.substr(offset, kPiece_bytes);
    proto::RecordingRecord record;
    record.mutable_piece()->set_hash(hash);
    record.mutable_piece()->set_offset(offset);
    record.mutable_piece()->set_total(content.size());
    record.mutable_piece()->set_content(std::string(piece));
    LFD_TRY_STATUS(write(record));
    offset += piece.size();
  } while (offset < content.size());
  return {};
}

Status RecordingWriter::end(const std::string& reason) {
  proto::RecordingRecord record;
  record.mutable_end()->set_reason(reason);
  return write(record);
}

Status RecordingWriter::write(const proto::RecordingRecord& record) { return write(record_bytes(record)); }

Status RecordingWriter::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      return Error(
          fmt::format("{}: cannot be written: {}; {} bytes of it are", path_.string(), std::strerror(errno), bytes_));
    }
    bytes_ += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace lfd
