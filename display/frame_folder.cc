// The colour images of a folder.
#include "display/frame_folder.h"

#include <charconv>

#include "base/log.h"
#include "calibration/display.h"
#include "proto/pictures/png.h"

namespace lfd::display {
namespace {

namespace fs = std::filesystem;

// The K of module-K.color.png.
std::optional<int> module_of(const std::string& name) {
  constexpr std::string_view kBefore = "module-", kAfter = ".color.png";
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter)) return std::nullopt;
  const char* end = name.data() + name.size() - kAfter.size();
  int module = -1;
  const auto [stop, failure] = std::from_chars(name.data() + kBefore.size(), end, module);
  if (failure != std::errc() || stop != end || module < 0 || module >= kMaxModules) return std::nullopt;
  return module;
}

}  // namespace

Result<std::vector<std::optional<Picture8>>> read_color_images(const fs::path& frame_folder, int modules) {
  std::error_code failure;
  std::vector<std::optional<Picture8>> pictures(modules);
  bool found = false;
  for (fs::directory_iterator entry(frame_folder, failure), end; !failure && entry != end; entry.increment(failure)) {
    const auto module = module_of(entry->path().filename().string());
    if (!module || (modules > 0 && *module >= modules)) continue;
    if (static_cast<std::size_t>(*module) >= pictures.size()) pictures.resize(*module + 1);
    LFD_TRY(pictures[*module], read_png(entry->path()));
    found = true;
  }
  if (failure) return Error(fmt::format("{}: {}", frame_folder.string(), failure.message()));
  if (!found) return Error(fmt::format("{}: there is no module-*.color.png", frame_folder.string()));
  return pictures;
}

std::vector<const Picture8*> pointers_to(const std::vector<std::optional<Picture8>>& pictures) {
  std::vector<const Picture8*> pointers;
  for (const auto& picture : pictures) pointers.push_back(picture ? &*picture : nullptr);
  return pointers;
}

}  // namespace lfd::display
