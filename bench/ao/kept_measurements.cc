// One file of times, a line for each rung, and one of pictures.
#include "bench/ao/kept_measurements.h"

#include <sstream>

#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "bench/ao/planes_file.h"
#include "bench/common/built_commit.h"
#include "shaders/embedded.h"

namespace lfd::bench {
namespace {

std::string key_of(const KeptMeasurements::Subject& of, const MeasureOptions& options) {
  std::string all;
  for (const Rung& rung : of.rungs) all += rung.name + rung.settings.ShortDebugString() + "\n";
  // Commits of sources with changes are alike: pictures are the shaders' first of all.
  for (const EmbeddedShader& shader : embedded_shaders()) all += shader.source;
  return fmt::format("{} module {}, radius {}, {} frames by {}, commit {}, scene {}, rungs {}", of.scene.name(),
                     of.module, options.radius_m, options.frames, of.renderer, built_commit(), of.scene.hash(),
                     content_hash(all));
}

void print(std::ostream& out, const std::vector<double>& numbers) {
  out << ' ' << numbers.size();
  for (const double number : numbers) out << ' ' << number;
}

bool parse(std::istream& in, std::vector<double>& numbers) {
  constexpr std::size_t kMost = 1000000;
  std::size_t count = 0;
  if (!(in >> count) || count > kMost) return false;
  numbers.resize(count);
  for (double& number : numbers) in >> number;
  return static_cast<bool>(in);
}

}  // namespace

KeptMeasurements::KeptMeasurements(const Subject& subject, const MeasureOptions& options)
    : key_(key_of(subject, options)), rungs_(subject.rungs.size()) {
  times_ = options.cache / fmt::format("drawn-{}.txt", content_hash(key_));
  pictures_ = options.cache / fmt::format("drawn-{}.planes", content_hash(key_));
}

std::optional<std::vector<Measurement>> KeptMeasurements::read() const {
  const auto text = read_file(times_);
  auto planes = read_planes(pictures_, key_);
  if (!text || !planes) return std::nullopt;
  std::istringstream in(*text);
  std::string key;
  std::getline(in, key);
  const bool has_beside = planes->pictures.size() == 2 * rungs_;
  if (key != key_ || (planes->pictures.size() != rungs_ && !has_beside)) return std::nullopt;
  std::vector<Measurement> measurements(rungs_);
  for (std::size_t i = 0; i < rungs_; ++i) {
    Measurement& one = measurements[i];
    if (!(in >> one.layers) || !parse(in, one.occlusion_ms) || !parse(in, one.blur_ms) || !parse(in, one.ratio))
      return std::nullopt;
    one.open = std::move(planes->pictures[i]);
    if (has_beside) one.beside = std::move(planes->pictures[rungs_ + i]);
  }
  return measurements;
}

Status KeptMeasurements::write(const std::vector<Measurement>& measurements) const {
  Planes planes{key_, {}, {}};
  for (const Measurement& one : measurements) planes.pictures.push_back(one.open);
  for (const Measurement& one : measurements) {
    if (!one.beside.value.empty()) planes.pictures.push_back(one.beside);
  }
  LFD_TRY_STATUS(write_planes(pictures_, planes));
  std::ostringstream out;
  out.precision(9);
  out << key_ << '\n';
  for (const Measurement& one : measurements) {
    out << one.layers;
    for (const auto* numbers : {&one.occlusion_ms, &one.blur_ms, &one.ratio}) print(out, *numbers);
    out << '\n';
  }
  return write_file(times_, out.str());
}

}  // namespace lfd::bench
