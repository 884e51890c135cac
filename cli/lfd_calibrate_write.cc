// lfd-calibrate make and import: calibrations written to files.
#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/log.h"
#include "base/suggest.h"
#include "calibration/import/format.h"
#include "calibration/import/mpcdi.h"
#include "calibration/make.h"
#include "calibration/make_color.h"
#include "cli/lfd_calibrate.h"
#include "proto/calibration_file.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

struct MakeOptions {
  std::string name;
  std::optional<std::uint64_t> seed, color_seed;
  std::optional<int> modules;
  std::optional<double> radius_m;
  bool observer_arc = false;
  double warp_px = 0;
  std::string grid, grids, out;
};

struct ImportOptions {
  std::string file, format, like, grids, out;
  std::vector<double> origin;  // none or three
  MpcdiImportOptions mpcdi;
};

constexpr std::size_t kForeignFileLimit_bytes = std::size_t{1} << 31;

int write_display(const DisplayCalibration& display, const std::string& out,
                  std::optional<GridFileFormat> grids = std::nullopt) {
  if (out.empty()) {
    std::cout << print_text(write_calibration(display));
    return end_of_output();
  }
  if (auto status = save_calibration(out, display, grids); !status) return fail(status.error());
  return kExitDone;
}

// As it would be installed, then measured, then balanced.
Result<DisplayCalibration> with_wishes(const DisplayCalibration& display, const MakeOptions& options) {
  DisplayCalibration made = options.seed ? perturbed(display, *options.seed) : display;
  if (options.radius_m) {
    LFD_TRY(made, curved(made, *options.radius_m, options.observer_arc));
  }
  if (!options.grid.empty()) {
    LFD_TRY(const auto size, columns_and_rows("--grid", options.grid));
    auto grids = measured(made, size.first, size.second, options.warp_px, options.seed.value_or(1));
    if (!grids) return grids.error().within("--grid");
    made = *std::move(grids);
  }
  if (options.color_seed) made = colored(made, *options.color_seed);
  return made;
}

int run_make(const MakeOptions& options) {
  if (!options.grids.empty() && options.out.empty())
    return wrong_use(Error("--grids needs --out: files lie beside it"));
  const auto display = make_display(options.name, options.modules);
  if (!display) {
    const auto names = display_names();
    const bool is_known = std::find(names.begin(), names.end(), options.name) != names.end();
    const auto near = is_known ? std::nullopt : closest(options.name, names);
    return wrong_use(near ? Error(fmt::format("{}; did you mean {}?", display.error().message(), *near))
                          : display.error());
  }
  const auto made = with_wishes(*display, options);
  if (!made) return wrong_use(made.error());
  return write_display(*made, options.out, grid_format_of(options.grids));
}

constexpr std::pair<const char*, ForeignFormat> kFormats[] = {
    {"holovizio", ForeignFormat::kHolovizioJson},
    {"lfdisplay", ForeignFormat::kLfdisplayYaml},
    {"mpcdi", ForeignFormat::kMpcdi},
};

Result<ForeignFormat> format_of(const ImportOptions& options, std::string_view content) {
  for (const auto& [name, format] : kFormats) {
    if (options.format == name) return format;
  }
  const auto found = foreign_format_of(content);
  if (found) return *found;
  return Error("neither a HoloVizio model (JSON) nor an LFDisplay configuration (YAML) nor MPCDI (ZIP)");
}

Result<DisplayCalibration> import_mpcdi_file(const ImportOptions& options, std::string_view content) {
  MpcdiImportOptions mpcdi = options.mpcdi;
  std::optional<DisplayCalibration> like;
  if (!options.like.empty()) {
    LFD_TRY(like, load_calibration(options.like));
    mpcdi.like = &*like;
  }
  if (!options.origin.empty()) mpcdi.origin = {options.origin[0], options.origin[1], options.origin[2]};
  LFD_TRY(MpcdiImport import, import_mpcdi(content, options.file, mpcdi));
  for (const std::string& warning : import.warnings)
    std::cerr << fmt::format("{}: warning: {}\n", options.file, warning);
  return std::move(import.display);
}

Result<DisplayCalibration> import_file(const ImportOptions& options) {
  LFD_TRY(const std::string content, read_file(options.file, kForeignFileLimit_bytes));
  const auto format = format_of(options, content);
  if (!format) return format.error().within(options.file);
  return *format == ForeignFormat::kMpcdi ? import_mpcdi_file(options, content)
                                          : import_display(*format, content, options.file);
}

int run_import(const ImportOptions& options) {
  if (!options.grids.empty() && options.out.empty())
    return wrong_use(Error("--grids needs --out: files lie beside it"));
  const auto display = import_file(options);
  if (!display) return fail(display.error());
  return write_display(*display, options.out, grid_format_of(options.grids));
}

}  // namespace

void add_make_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App* command = add_command(app, "make", "Make the calibration of a display known by name", exit_code,
                                  [options] { return run_make(*options); });
  std::string names;
  for (const std::string& name : display_names()) names += (names.empty() ? "" : ", ") + name;
  command->add_option("NAME", options->name, "One of " + names)->required();
  command->add_option("--perturb", options->seed, "Add the errors of an installation by hand: pose, focal length, lens")
      ->check(seed_number())
      ->type_name("SEED");
  command
      ->add_option("--color", options->color_seed,
                   "Give every module a colour calibration: vignetting, gamma, primaries")
      ->type_name("SEED");
  command->add_option("--modules", options->modules, "So many modules within the same span")->type_name("N");
  auto* radius = command
                     ->add_option("--radius", options->radius_m,
                                  "Bend the screen to a vertical cylinder of this radius, m: positive convex, negative "
                                  "concave to the viewers")
                     ->type_name("M");
  command->add_flag("--observer-arc", options->observer_arc, "Viewers stand on an arc around the cylinder's axis")
      ->needs(radius);
  auto* grid = command
                   ->add_option("--grid", options->grid,
                                "Measure every module: a table of so many points of its image and where they lie on "
                                "the screen")
                   ->type_name("UxV");
  command
      ->add_option("--warp", options->warp_px,
                   "With --grid: bend each module's table smoothly by about so many pixels, as no lens does")
      ->needs(grid)
      ->check(number_within(-1000, 1000))
      ->type_name("PX");
  add_grids_option(*command, options->grids)->needs(grid);
  command->add_option("--out", options->out, "File to write; standard output without it")->type_name("FILE");
}

void add_import_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = add_command(app, "import", "Turn a foreign file into a calibration", exit_code,
                                  [options] { return run_import(*options); });
  command
      ->add_option("FILE", options->file,
                   "HoloVizio model (JSON), LFDisplay configuration (YAML) or MPCDI of profile a3 (ZIP)")
      ->required();
  command->add_option("--format", options->format, "holovizio, lfdisplay or mpcdi; found from the content without it")
      ->check(CLI::IsMember({"holovizio", "lfdisplay", "mpcdi"}));
  command->add_option("--out", options->out, "File to write; standard output without it")->type_name("FILE");
  command
      ->add_option("--like", options->like,
                   "MPCDI: calibration that gives the screen, the optics and the emitters of the modules, in the order "
                   "of the regions")
      ->type_name("DISPLAY");
  add_numbers(*command, "--origin", options->origin, "X,Y,Z",
              "MPCDI: where the origin of the file's points lies in physical space, m; what the file says without it");
  command
      ->add_option("--tolerance", options->mpcdi.tolerance_m,
                   "MPCDI: how far points may be off the screen's surface, m")
      ->check(number_within(1e-12, 1e12))
      ->type_name("M")
      ->capture_default_str();
  ThinningWish& thinning = options->mpcdi.thinning;
  command
      ->add_option("--tolerance-px", thinning.tolerance_px,
                   "MPCDI: how far thinning a warp to fewer nodes may move its points, px")
      ->check(number_within(0, 1e12))
      ->type_name("PX")
      ->capture_default_str();
  command->add_option("--nodes", thinning.most_nodes, "MPCDI: nodes of a map along each side at most, whatever is lost")
      ->check(whole_number_within(2, kMaxGridSide))
      ->type_name("N")
      ->capture_default_str();
  add_grids_option(*command, options->grids);
}

}  // namespace lfd
