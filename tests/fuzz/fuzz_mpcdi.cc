// Fuzz target: MPCDI archives are refused, or can be exported again.
//
// What does not begin with "PK" is no archive but its content: mpcdi.xml, a zero byte, and the warp left.pfm. So
// changes reach both without having to mend checksums.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "calibration/import/mpcdi.h"
#include "calibration/import/zip_archive.h"

namespace {

std::string archive_of(std::string_view data) {
  if (data.starts_with("PK")) return std::string(data);
  const std::size_t end = std::min(data.find('\0'), data.size());
  const auto archive = lfd::write_zip(std::vector<lfd::ZipEntry>{
      {"mpcdi.xml", std::string(data.substr(0, end))},
      {"left.pfm", std::string(data.substr(std::min(end + 1, data.size())))},
  });
  LFD_CHECK(archive, "two entries can be packed");
  return *archive;
}

// What the file does not say, said.
lfd::DisplayCalibration display_like_it() {
  lfd::DisplayCalibration display{"like", {2, 1}, {8, 6}, {lfd::Diffuser::kLinear, 0, 3}, 0.1, {}};
  display.modules.push_back({{0, 0, -2}, lfd::IdealMap{}});
  return display;
}

void import(const std::string& archive, const lfd::MpcdiImportOptions& options) {
  const auto import = lfd::import_mpcdi(archive, "f", options);
  if (!import) {
    LFD_CHECK(import.error().message().starts_with("f: "), "every refusal names the file");
    return;
  }
  LFD_CHECK(lfd::validate(import->display), "what is imported is valid");
  LFD_CHECK(lfd::export_mpcdi(import->display, lfd::ImageSize{3, 2}), "what is imported can be exported");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const lfd::DisplayCalibration kLike = display_like_it();
  const std::string archive = archive_of({reinterpret_cast<const char*>(data), size});
  import(archive, {});
  lfd::MpcdiImportOptions told;
  told.like = &kLike;
  told.origin = lfd::Point3<lfd::Physical>{0.5, 0.5, 0};
  told.thinning.most_nodes = 5;
  import(archive, told);
  return 0;
}
