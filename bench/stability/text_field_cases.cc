// Bad numbers in files that are text: observations, and the XML of MPCDI archives.
#include <array>
#include <cmath>

#include "base/log.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "bench/stability/tally.h"
#include "calibration/fit/observations.h"
#include "calibration/import/mpcdi.h"
#include "calibration/import/pfm.h"
#include "calibration/import/zip_archive.h"

namespace lfd::bench {
namespace {

constexpr std::array kBadTexts{"nan",
                               "inf",
                               "-inf",
                               "1e309",
                               "-1e309",
                               "1e300",
                               "-1e300",
                               "1e39",
                               "1e12",
                               "-1e12",
                               "1e-12",
                               "1e-40",
                               "4.9e-324",
                               "1e-400",
                               "0",
                               "-0",
                               "-1",
                               "",
                               "1e",
                               "0x10",
                               "1;5",
                               "--1",
                               "9999999999999999999"};

bool is_finite(const Observation& o) {
  return std::isfinite(o.in_image.x) && std::isfinite(o.in_image.y) && std::isfinite(o.on_screen.x) &&
         std::isfinite(o.on_screen.y) && o.sigma_px > 0 && std::isfinite(o.sigma_px);
}

// Empty, or what is wrong with observations that were read.
std::string harm_of(const Observations& observations) {
  for (const Observation& o : observations.points) {
    if (!is_finite(o)) return "a number that is not finite";
    if (o.module < 0) return fmt::format("module {}", o.module);
  }
  const auto again = parse_observations(print_observations(observations), observations.source);
  if (!again) return "what was read cannot be written: " + again.error().message();
  return again->points == observations.points ? "" : "what was read changes by writing";
}

constexpr std::array kColumns{"module", "u", "v", "s", "y", "sigma"};
constexpr std::array kSound{"0", "3.5", "4.5", "0.1", "-0.1", "0.2"};

StabilityCase observation_case(std::size_t column) {
  const std::string name = kColumns[column];
  return {"fields of files of text", "observations: " + name, kEachRefusedOrHarmless,
          [column, name](const gl::Context&) {
            Tally tally({name});
            for (const std::string value : kBadTexts) {
              std::string text = "module,u,v,s,y,sigma\n";
              for (std::size_t i = 0; i < kSound.size(); ++i)
                text += (i > 0 ? "," : "") + (i == column ? value : std::string(kSound[i]));
              const auto read = parse_observations(text + "\n", "observations.csv");
              read ? tally.accepted(value, harm_of(*read)) : tally.refused(value, read.error().message());
            }
            return tally.outcome();
          }};
}

// A region of 30 x 20 pixels whose warp has 3 x 2 points, one number of which is `value`.
std::string xml_with(const std::string& field, const std::string& value) {
  const auto number = [&](const char* name, const char* sound) { return field == name ? value : std::string(sound); };
  return fmt::format(
      R"(<MPCDI profile="a3" version="2.0"><display><buffer id="b"><region id="r" xResolution="{}" yResolution="{}">)"
      "<coordinateFrame><posx>{}</posx><posy>{}</posy><posz>{}</posz></coordinateFrame></region></buffer></display>"
      R"(<files><fileset region="r"><geometryWarpFile><path>w.pfm</path><interpolation>linear</interpolation>)"
      "<geometricUnit>m</geometricUnit><originOf3DData>centerOfMass</originOf3DData></geometryWarpFile></fileset>"
      "</files></MPCDI>",
      number("xResolution", "30"), number("yResolution", "20"), number("posx", "0.1"), number("posy", "-0.2"),
      number("posz", "-1.5"));
}

DisplayCalibration like() {
  DisplayCalibration display{"like", {2.4, 1.4}, {30, 20}, {Diffuser::kLinear, 0.25, 3, 0, false}, 0.1, {}};
  display.modules.push_back({{0.5, 0.25, -1}, IdealMap{}});
  return display;
}

std::string archive_of(const std::string& xml, const PfmPixels& warp) {
  const std::array<ZipEntry, 2> entries{{{"mpcdi.xml", xml}, {"w.pfm", print_pfm(warp)}}};
  const auto archive = write_zip(entries);
  LFD_CHECK(archive, archive.error().message());
  return *archive;
}

const PfmPixels& sound_warp() {
  static const PfmPixels kWarp{
      3, 2, {-1, 0.5F, 0, 0.1F, 0.55F, 0, 1.05F, 0.6F, 0, -1.1F, -0.45F, 0, 0.05F, -0.5F, 0, 1, -0.65F, 0}};
  return kWarp;
}

void try_archive(Tally& tally, const std::string& value, const std::string& archive) {
  const DisplayCalibration display = like();
  MpcdiImportOptions options;
  options.like = &display;
  const auto read = import_mpcdi(archive, "f.mpcdi", options);
  read ? tally.accepted(value, bench::harm_of(read->display)) : tally.refused(value, read.error().message());
}

StabilityCase mpcdi_case(const std::string& field) {
  return {"fields of files of text", "MPCDI: " + field, kEachRefusedOrHarmless, [field](const gl::Context&) {
            Tally tally({field, "coordinateFrame", "resolution"});
            for (const std::string value : kBadTexts)
              try_archive(tally, value, archive_of(xml_with(field, value), sound_warp()));
            return tally.outcome();
          }};
}

StabilityCase warp_case(std::size_t number) {
  return {"fields of files of text", fmt::format("MPCDI: warp, number {}", number), kEachRefusedOrHarmless,
          [number](const gl::Context&) {
            Tally tally({"w.pfm"});
            for (const float value :
                 {NAN, INFINITY, -INFINITY, 3e38F, -3e38F, 1e30F, 1e12F, -1e5F, 1e-7F, 1e-30F, 1e-44F, 0.0F, -0.0F}) {
              PfmPixels warp = sound_warp();
              warp.numbers[number] = value;
              try_archive(tally, fmt::format("{}", value), archive_of(xml_with("", ""), warp));
            }
            return tally.outcome();
          }};
}

}  // namespace

void add_text_field_cases(StabilityCases& cases) {
  for (std::size_t column = 0; column < 6; ++column) cases.push_back(observation_case(column));
  for (const char* field : {"xResolution", "yResolution", "posx", "posy", "posz"}) cases.push_back(mpcdi_case(field));
  for (const std::size_t number : {0, 4, 17}) cases.push_back(warp_case(number));
}

}  // namespace lfd::bench
