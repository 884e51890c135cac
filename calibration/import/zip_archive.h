// ZIP archives in memory, in and out; the one door of libzip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

struct zip;  // libzip's

namespace lfd {

struct ZipEntry {
  std::string name, content;
};

// Nothing is ever unpacked to disk: entries are found by name, so that a name cannot lead anywhere.
class ZipReader {
 public:
  // `archive` must outlive the reader. `total_limit_bytes` is what all calls of read() together may unpack. Refuses
  // damaged archives and more than 10000 entries.
  static Result<ZipReader> open(std::string_view archive, std::uint64_t total_limit_bytes);

  // The entry of this name, letters in either case. Its size is checked against both limits before memory is taken, and
  // against what was unpacked. Errors begin with the name.
  Result<std::string> read(const std::string& name, std::uint64_t limit_bytes);

 private:
  struct Closer {
    void operator()(zip* archive) const;
  };

  ZipReader(zip* archive, std::uint64_t left_bytes) : archive_(archive), left_bytes_(left_bytes) {}

  std::unique_ptr<zip, Closer> archive_;
  std::uint64_t left_bytes_;
};

// Entries in this order, deflated, dated 1980-01-01 so that equal entries give equal archives.
Result<std::string> write_zip(std::span<const ZipEntry> entries);

}  // namespace lfd
