// Blending of the modules' images, row by row on all cores.
#include "display/viewer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "base/log.h"
#include "display/module_light.h"
#include "proto/pictures/srgb.h"

namespace lfd::display {
namespace {

constexpr double kSigmaOfScattering = 1.11741;
// Modules of less than a millionth of the best one's weight change no 8-bit value.
const double kLogNegligible = std::log(1e-6);

struct Candidate {
  int module;
  double log_weight;
};

struct View {
  const DisplayCalibration& display;
  std::span<const Picture8* const> images;
  std::vector<ModuleLight> lights;  // by module
  Eye eye;
  int width_px, height_px;

  ScreenPoint at(int column, int row) const {
    return {((column + 0.5) / width_px - 0.5) * display.screen.width_m,
            (0.5 - (row + 0.5) / height_px) * display.screen.height_m};
  }
};

// Modules that have an image, the heaviest first.
void find_candidates(const View& view, ScreenPoint s, std::vector<Candidate>& candidates) {
  candidates.clear();
  for (std::size_t m = 0; m < view.images.size(); ++m) {
    if (view.images[m] == nullptr) continue;
    candidates.push_back({static_cast<int>(m), log_weight(view.display, view.display.modules[m], s, view.eye)});
  }
  std::sort(candidates.begin(), candidates.end(), [](auto a, auto b) { return a.log_weight > b.log_weight; });
}

// What a module contributes at a point: the light it emits, and how much of it there would be in full light.
struct Contribution {
  glm::dvec3 emitted{0}, full{0};
};

// Bilinear in linear light between texel centres, the border texels continued outward.
Contribution sample(const Picture8& image, const ModuleLight& light, PixelPoint p) {
  const double u = std::clamp(p.x - 0.5, 0.0, image.width - 1.0), v = std::clamp(p.y - 0.5, 0.0, image.height - 1.0);
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, image.width - 1), bottom = std::min(top + 1, image.height - 1);
  const double fu = u - left, fv = v - top;
  Contribution sum;
  const auto add = [&](int column, int row, double weight) {
    sum.emitted += weight * light.emitted(&image.rgba[4 * (std::size_t(row) * image.width + column)]);
    sum.full += weight * light.gain({column, row});
  };
  add(left, top, (1 - fu) * (1 - fv));
  add(right, top, fu * (1 - fv));
  add(left, bottom, (1 - fu) * fv);
  add(right, bottom, fu * fv);
  return sum;
}

glm::dvec3 blend(const View& view, ScreenPoint s, std::span<const Candidate> candidates) {
  Contribution sum;
  std::optional<double> best;
  for (const auto& [module, log_weight] : candidates) {
    if (best && log_weight < *best + kLogNegligible) break;
    const auto pixel = image_from_screen(view.display, view.display.modules[module], s);
    if (!pixel) continue;
    const Contribution one = sample(*view.images[module], view.lights[module], *pixel);
    if (one.full == glm::dvec3(0)) continue;
    if (!best) best = log_weight;
    const double weight = std::exp(log_weight - *best);
    sum.emitted += weight * one.emitted;
    sum.full += weight * one.full;
  }
  glm::dvec3 light(0);
  for (int c = 0; c < 3; ++c) {
    if (sum.full[c] > 0) light[c] = sum.emitted[c] / sum.full[c];
  }
  return light;
}

void write_row(const View& view, int row, std::span<const std::vector<Candidate>> by_column, Picture8& picture) {
  std::vector<Candidate> own;
  for (int column = 0; column < view.width_px; ++column) {
    const ScreenPoint s = view.at(column, row);
    if (by_column.empty()) find_candidates(view, s, own);
    const glm::dvec3 light = blend(view, s, by_column.empty() ? own : by_column[column]);
    std::uint8_t* pixel = &picture.rgba[4 * (std::size_t(row) * view.width_px + column)];
    pixel[0] = srgb8_from_linear(light.r);
    pixel[1] = srgb8_from_linear(light.g);
    pixel[2] = srgb8_from_linear(light.b);
    pixel[3] = 255;
  }
}

Status check(const DisplayCalibration& display, std::span<const Picture8* const> images, const Eye& eye, int width,
             int height) {
  if (!is_finite(eye) || !(eye.z > 0)) {
    return Error(fmt::format("eye: ({}, {}, {}) is not before the screen (z > 0)", eye.x, eye.y, eye.z));
  }
  if (width < 1 || height < 1 || std::size_t(width) * std::size_t(height) > kMaxPicturePixels) {
    return Error(fmt::format("picture: {} x {} pixels; 1 to {} in all are possible", width, height, kMaxPicturePixels));
  }
  if (images.size() != display.modules.size()) {
    return Error(fmt::format("{} images; the display has {} modules", images.size(), display.modules.size()));
  }
  for (std::size_t m = 0; m < images.size(); ++m) {
    if (images[m] == nullptr || ImageSize{images[m]->width, images[m]->height} == display.image) continue;
    return Error(fmt::format("module {}: an image of {} x {} pixels; the display's have {} x {}", m, images[m]->width,
                             images[m]->height, display.image.width, display.image.height));
  }
  return {};
}

}  // namespace

double log_weight(const DisplayCalibration& display, const ModuleCalibration& module, ScreenPoint s, const Eye& eye) {
  const double sigma = display.angular_scattering_rad / kSigmaOfScattering;
  const Emitter& e = module.emitter;
  double difference = 0;
  if (display.optics.diffuser == Diffuser::kLinear) {
    const Point3<Physical> at = surface_point(display.optics, s);
    difference = std::atan2(at.x - e.x, at.z - e.z) - std::atan2(eye.x - at.x, eye.z - at.z);
  } else {
    difference = (s.x - e.x) / std::hypot(s.y - e.y, e.z) - (eye.x - s.x) / std::hypot(eye.y - s.y, eye.z);
  }
  return -(difference / sigma) * (difference / sigma);
}

double nearest_light_rad(const DisplayCalibration& display, const Eye& eye) {
  constexpr int kColumns = 33;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < kColumns; ++i) {
    const ScreenPoint s{(double(i) / (kColumns - 1) - 0.5) * display.screen.width_m, 0};
    for (const ModuleCalibration& module : display.modules) best = std::max(best, log_weight(display, module, s, eye));
  }
  return std::sqrt(-best) * display.angular_scattering_rad / kSigmaOfScattering;
}

Result<Picture8> viewer_picture(const DisplayCalibration& display, std::span<const Picture8* const> images,
                                const Eye& eye, int width_px, int height_px) {
  LFD_TRY_STATUS(check(display, images, eye, width_px, height_px));
  View view{display, images, {}, eye, width_px, height_px};
  for (const ModuleCalibration& module : display.modules) view.lights.emplace_back(module, display.image);
  // Horizontal angles are the same in all rows; of a conical diffuser they are not.
  std::vector<std::vector<Candidate>> by_column;
  if (display.optics.diffuser == Diffuser::kLinear) {
    by_column.resize(width_px);
    for (int column = 0; column < width_px; ++column) find_candidates(view, view.at(column, 0), by_column[column]);
  }
  Picture8 picture = black_picture(width_px, height_px);
  std::atomic<int> next_row = 0;
  const auto work = [&] {
    for (int row = next_row++; row < height_px; row = next_row++) write_row(view, row, by_column, picture);
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) helpers.emplace_back(work);
    work();
  }
  return picture;
}

}  // namespace lfd::display
