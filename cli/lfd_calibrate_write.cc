// lfd-calibrate make and import: calibrations written to files.
#include <algorithm>
#include <iostream>
#include <memory>

#include "base/file.h"
#include "base/log.h"
#include "base/suggest.h"
#include "calibration/import/format.h"
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
  std::string out;
};

struct ImportOptions {
  std::string file, format, out;
};

int write_display(const DisplayCalibration& display, const std::string& out) {
  if (out.empty()) {
    std::cout << print_text(write_calibration(display)) << std::flush;
    return std::cout ? kExitDone : fail(Error("standard output: cannot be written"));
  }
  if (auto status = save_calibration(out, display); !status) return fail(status.error());
  return kExitDone;
}

int run_make(const MakeOptions& options) {
  const auto display = make_display(options.name, options.modules);
  if (!display) {
    const auto names = display_names();
    const bool is_known = std::find(names.begin(), names.end(), options.name) != names.end();
    const auto near = is_known ? std::nullopt : closest(options.name, names);
    return wrong_use(near ? Error(fmt::format("{}; did you mean {}?", display.error().message(), *near))
                          : display.error());
  }
  DisplayCalibration made = options.seed ? perturbed(*display, *options.seed) : *display;
  if (options.color_seed) made = colored(made, *options.color_seed);
  return write_display(made, options.out);
}

Result<DisplayCalibration> import_file(const ImportOptions& options) {
  LFD_TRY(const std::string text, read_file(options.file, kTextFileLimit_bytes));
  const auto found = foreign_format_of(text);
  if (options.format.empty() && !found) {
    return Error("neither a HoloVizio model (JSON) nor an LFDisplay configuration (YAML)").within(options.file);
  }
  const ForeignFormat format = options.format.empty()          ? *found
                               : options.format == "holovizio" ? ForeignFormat::kHolovizioJson
                                                               : ForeignFormat::kLfdisplayYaml;
  return import_display(format, text, options.file);
}

int run_import(const ImportOptions& options) {
  const auto display = import_file(options);
  if (!display) return fail(display.error());
  return write_display(*display, options.out);
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
      ->type_name("SEED");
  command
      ->add_option("--color", options->color_seed,
                   "Give every module a colour calibration: vignetting, gamma, primaries")
      ->type_name("SEED");
  command->add_option("--modules", options->modules, "So many modules within the same span")->type_name("N");
  command->add_option("--out", options->out, "File to write; standard output without it")->type_name("FILE");
}

void add_import_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* command = add_command(app, "import", "Turn a foreign file into a calibration", exit_code,
                                  [options] { return run_import(*options); });
  command->add_option("FILE", options->file, "HoloVizio model (JSON) or LFDisplay configuration (YAML)")->required();
  command->add_option("--format", options->format, "holovizio or lfdisplay; found from the content without it")
      ->check(CLI::IsMember({"holovizio", "lfdisplay"}));
  command->add_option("--out", options->out, "File to write; standard output without it")->type_name("FILE");
}

}  // namespace lfd
