// lfd bench ao: every method of ambient occlusion, error against run time.
#include <signal.h>

#include <charconv>
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "bench/ao/ao_bench.h"
#include "cli/lfd_bench.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

struct AoArguments {
  bench::AoBenchOptions options;
  std::string size, display;
  bool no_scaling = false;
};

Result<ImageSize> size_from(const std::string& text) {
  ImageSize size{};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const auto height = width.ptr == end ? width : std::from_chars(width.ptr + 1, end, size.height);
  if (width.ec != std::errc() || height.ec != std::errc() || *width.ptr != 'x' || height.ptr != end || size.width < 1 ||
      size.height < 1)
    return Error(fmt::format("--size: \"{}\"; WIDTHxHEIGHT in pixels is meant", text));
  return size;
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const occlusion::Method* method : occlusion::methods()) names.emplace_back(method->name);
  return names;
}

// What a bench that failed leaves of a folder that it made: nothing, unless there is something in it.
void leave_no_empty_folder(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code failure;
  for (const auto& entry : fs::recursive_directory_iterator(folder, failure)) {
    if (!entry.is_directory(failure)) return;
  }
  fs::remove_all(folder, failure);
}

Status write_results(const std::filesystem::path& out, const bench::AoTable& table) {
  LFD_TRY_STATUS(write_file(out / "ao.md", bench::text_of(table)));
  LFD_TRY_STATUS(write_file(out / "ao.csv", bench::csv_of(table)));
  LFD_TRY_STATUS(write_file(out / "ao.json", bench::json_of(table)));
  LFD_TRY_STATUS(write_file(out / "ao-front.textproto", bench::front_text_of(table)));
  for (const std::string& scene : table.scenes()) {
    LFD_TRY_STATUS(write_file(out / ("ao-" + bench::stem_of(scene) + ".svg"), bench::svg_of(table, scene)));
  }
  return {};
}

int bench_ao(AoArguments& a) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, end_bench_by_signal);
  if (!a.display.empty()) a.options.display = a.display;
  if (!a.size.empty()) {
    const auto size = size_from(a.size);
    if (!size) return wrong_use(size.error());
    a.options.size = *size;
  }
  if (a.no_scaling) {
    a.options.sizes.clear();
    a.options.module_counts.clear();
  }
  if (const Status possible = bench::check_options(a.options); !possible) return wrong_use(possible.error());
  std::error_code ignored;
  const bool is_new = !std::filesystem::exists(a.options.out, ignored);
  if (const Status folder = make_folder(a.options.out); !folder) return fail(folder.error());
  const auto table = bench::ao_bench(a.options);
  if (!table && is_new) leave_no_empty_folder(a.options.out);
  if (!table) return fail(table.error());
  if (const Status written = write_results(a.options.out, *table); !written) return fail(written.error());
  std::cout << bench::text_of(*table);
  return end_of_output();
}

}  // namespace

void add_bench_ao(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<AoArguments>();
  AoArguments& a = *arguments;
  CLI::App* ao =
      add_command(bench, "ao", "Ambient occlusion by every method against ray casting: error against run time",
                  exit_code, [arguments] { return bench_ao(*arguments); });
  ao->add_option("DEPLOYMENT", a.options.deployments, "Deployment files (*.textproto): each a scene on a display")
      ->required();
  ao->add_option("--out", a.options.out,
                 "Folder for ao.md, ao.csv, ao.json, ao-SCENE.svg, ao-front.textproto and strips/ (reference, method, "
                 "difference); "
                 "rays and pictures are kept in its folder cache/")
      ->required();
  ao->add_flag("--resume", a.options.resume,
               "Go on where an earlier run of the same program with the same options was ended (rays are cast once in "
               "any case)");
  ao->add_option("--scene", a.options.scenes, "Show these glTF files too, on the first deployment's display")
      ->delimiter(',')
      ->allow_extra_args(false);
  ao->add_option("--display", a.display, "Use this calibration file instead of the deployments'");
  ao->add_option("--size", a.size, "WIDTHxHEIGHT of the modules' images, px (default: the display's own)");
  ao->add_option("--frames", a.options.frames, "How many frames of each setting, in turn")
      ->check(whole_number_within(1, 100000))
      ->capture_default_str();
  ao->add_option("--rays", a.options.rays, "Of the reference, for each pixel")
      ->check(whole_number_within(4, 1000000))
      ->capture_default_str();
  ao->add_option("--radius", a.options.radii, "Radii, shares of the region of interest's diagonal")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  ao->add_option("--module", a.options.modules,
                 "Numbers of modules (default: the middle one, the first and, for sharing, the last)")
      ->delimiter(',')
      ->allow_extra_args(false);
  ao->add_option("--method", a.options.methods, "Methods (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of("method", method_names()));
  ao->add_flag("--no-scaling", a.no_scaling, "Neither other resolutions nor other numbers of modules");
  ao->add_option("--gpu", a.options.gpu, "Number in lfd-rendernode --list-gpus (default: the first that works)");
}

}  // namespace lfd
