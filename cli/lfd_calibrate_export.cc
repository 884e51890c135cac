// lfd-calibrate export: calibrations written for other programs.
#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "calibration/import/mpcdi.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"

namespace lfd {
namespace {

struct ExportOptions {
  std::string file, out, grids;
  std::vector<int> size;  // none or two
};

// A warp has a number for the middle of each of its pixels, and whoever reads it knows no map beyond the outermost.
void warn_of_border(const DisplayCalibration& display, ImageSize size) {
  log::warn(
      "--size {} {}: the maps end at the middles of the warps' outermost pixels, {:g} px from the left and right "
      "borders of the modules' images and {:g} px from the upper and lower ones",
      size.width, size.height, 0.5 * display.image.width / size.width, 0.5 * display.image.height / size.height);
}

int run_export(const ExportOptions& options) {
  const auto display = load_calibration(options.file);
  if (!display) return fail(display.error());
  if (options.out.ends_with(".textproto")) {
    const auto status = save_calibration(options.out, *display, grid_format_of(options.grids));
    return status ? kExitDone : fail(status.error());
  }
  if (!options.out.ends_with(".mpcdi")) {
    return wrong_use(Error(fmt::format("--out {}: its name must end in .mpcdi or .textproto", options.out)));
  }
  std::optional<ImageSize> size;
  if (!options.size.empty()) size = ImageSize{options.size[0], options.size[1]};
  if (size && *size != display->image) warn_of_border(*display, *size);
  const auto archive = export_mpcdi(*display, size);
  if (!archive) return fail(archive.error().within(options.file));
  const auto coloured =
      std::ranges::count_if(display->modules, [](const auto& module) { return module.color.has_value(); });
  if (coloured > 0)
    log::warn("the colour calibration of {} modules is left out: import --like {} takes it over again", coloured,
              options.file);
  const auto status = write_file(options.out, *archive);
  return status ? kExitDone : fail(status.error());
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* command = add_command(app, "export", "Write a calibration for other programs", exit_code,
                                  [options] { return run_export(*options); });
  command->add_option("FILE", options->file, "Calibration file (*.textproto)")->required();
  command
      ->add_option("--out", options->out,
                   "File to write: *.mpcdi (MPCDI 2.0, profile a3) or *.textproto (a calibration again, see --grids)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option(
          "--size", options->size,
          "MPCDI: pixels of each module's warp; the image's own size without it. Half a warp's pixel along the border "
          "of the image is without a map in the file")
      ->expected(2)
      ->check(whole_number_within(1, kMaxGridSide))
      ->type_name("WIDTH HEIGHT");
  add_grids_option(*command, options->grids);
}

}  // namespace lfd
