// libzip over bytes in memory.
#include "calibration/import/zip_archive.h"

#include <zip.h>

#include <algorithm>

#include "base/log.h"

namespace lfd {
namespace {

constexpr zip_int64_t kMostEntries = 10000;

Error error_of(zip_error_t& error) {
  Error told(fmt::format("ZIP: {}", zip_error_strerror(&error)));
  zip_error_fini(&error);
  return told;
}

Error error_of(zip_t* archive) { return Error(fmt::format("ZIP: {}", zip_strerror(archive))); }

// An archive over `source`, which it takes.
Result<zip_t*> open_archive(zip_source_t* source, int flags) {
  zip_error_t error;
  zip_error_init(&error);
  zip_t* archive = zip_open_from_source(source, flags, &error);
  if (archive == nullptr) {
    zip_source_free(source);
    return error_of(error);
  }
  return archive;
}

Result<zip_source_t*> buffer_source(std::string_view content) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(content.data(), content.size(), 0, &error);
  if (source == nullptr) return error_of(error);
  return source;
}

Result<std::string> unpack(zip_t* archive, zip_uint64_t index, std::uint64_t size) {
  zip_file_t* file = zip_fopen_index(archive, index, 0);
  if (file == nullptr) return error_of(archive);
  std::string content(size + 1, '\0');  // one more, to see that nothing follows
  std::uint64_t got = 0;
  while (got < content.size()) {
    const zip_int64_t more = zip_fread(file, content.data() + got, content.size() - got);
    if (more <= 0) break;
    got += static_cast<std::uint64_t>(more);
  }
  const std::string reason = zip_error_strerror(zip_file_get_error(file));
  const bool is_whole = zip_fclose(file) == 0;  // checks the CRC
  if (got != size || !is_whole) return Error(fmt::format("ZIP: {} bytes unpacked of {}: {}", got, size, reason));
  content.resize(size);
  return content;
}

Status add_entry(zip_t* archive, const ZipEntry& entry) {
  zip_source_t* source = zip_source_buffer(archive, entry.content.data(), entry.content.size(), 0);
  if (source == nullptr) return error_of(archive);
  const zip_int64_t index = zip_file_add(archive, entry.name.c_str(), source, ZIP_FL_ENC_UTF_8);
  if (index < 0) {
    zip_source_free(source);
    return error_of(archive);
  }
  const auto at = static_cast<zip_uint64_t>(index);
  const zip_uint16_t first_day = (1 << 5) | 1;  // 1980-01-01, as DOS counts
  if (zip_file_set_dostime(archive, at, 0, first_day, 0) != 0 ||
      zip_set_file_compression(archive, at, ZIP_CM_DEFLATE, 1) != 0) {
    return error_of(archive);
  }
  return {};
}

Result<std::string> content_of(zip_source_t* source) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_source_stat(source, &stat) != 0 || zip_source_open(source) != 0) {
    return Error(fmt::format("ZIP: {}", zip_error_strerror(zip_source_error(source))));
  }
  std::string content(stat.size, '\0');
  const zip_int64_t got = zip_source_read(source, content.data(), content.size());
  zip_source_close(source);
  if (got < 0 || static_cast<std::uint64_t>(got) != content.size()) return Error("ZIP: cannot be read back");
  return content;
}

}  // namespace

void ZipReader::Closer::operator()(zip* archive) const { zip_discard(archive); }

Result<ZipReader> ZipReader::open(std::string_view archive, std::uint64_t total_limit_bytes) {
  LFD_TRY(zip_source_t* const source, buffer_source(archive));
  LFD_TRY(zip_t* const opened, open_archive(source, ZIP_RDONLY));
  ZipReader reader(opened, total_limit_bytes);
  const zip_int64_t entries = zip_get_num_entries(opened, 0);
  if (entries > kMostEntries) return Error(fmt::format("ZIP: {} entries; at most {} are read", entries, kMostEntries));
  return reader;
}

Result<std::string> ZipReader::read(const std::string& name, std::uint64_t limit_bytes) {
  zip_t* const archive = archive_.get();
  const zip_int64_t index = zip_name_locate(archive, name.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return Error(fmt::format("{}: no such entry in the archive", name));
  zip_stat_t stat;
  if (zip_stat_index(archive, static_cast<zip_uint64_t>(index), 0, &stat) != 0) return error_of(archive).within(name);
  if ((stat.valid & ZIP_STAT_SIZE) == 0) return Error(fmt::format("{}: ZIP: its size is not given", name));
  const std::uint64_t limit = std::min(limit_bytes, left_bytes_);
  if (stat.size > limit) {
    return Error(fmt::format("{}: {} bytes unpacked; at most {} are read here", name, stat.size, limit));
  }
  left_bytes_ -= stat.size;
  auto content = unpack(archive, static_cast<zip_uint64_t>(index), stat.size);
  if (!content) return content.error().within(name);
  return content;
}

Result<std::string> write_zip(std::span<const ZipEntry> entries) {
  LFD_TRY(zip_source_t* const source, buffer_source({}));
  zip_source_keep(source);  // the archive takes one reference, reading it back the other
  const std::unique_ptr<zip_source_t, void (*)(zip_source_t*)> kept(source, zip_source_free);
  LFD_TRY(zip_t* const archive, open_archive(source, ZIP_TRUNCATE));
  for (const ZipEntry& entry : entries) {
    if (auto status = add_entry(archive, entry); !status) {
      zip_discard(archive);
      return status.error().within(entry.name);
    }
  }
  if (zip_close(archive) != 0) {
    const Error error = error_of(archive);
    zip_discard(archive);
    return error;
  }
  return content_of(source);
}

}  // namespace lfd
