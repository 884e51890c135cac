// Sums over windows by summed-area tables.
#include "bench/ao/metrics.h"

#include <array>
#include <cmath>

#include "base/check.h"

namespace lfd::bench {
namespace {

constexpr int kWindow = 11;
constexpr double kC1 = 0.001 * 0.001, kC2 = 0.03 * 0.03;

// Of every rectangle that begins in the top left corner: count, x, y, x^2, y^2, x y.
class Sums {
 public:
  using Moments = std::array<double, 6>;

  Sums(const Openness& a, const Openness& b) : width_(a.size.width + 1) {
    table_.resize(static_cast<std::size_t>(width_) * (a.size.height + 1));
    for (int row = 0; row < a.size.height; ++row) {
      Moments line{};
      for (int column = 0; column < a.size.width; ++column) {
        const std::size_t i = static_cast<std::size_t>(row) * a.size.width + column;
        if (a.value[i] >= 0 && b.value[i] >= 0) {
          const double x = a.value[i], y = b.value[i];
          const Moments own{1, x, y, x * x, y * y, x * y};
          for (std::size_t k = 0; k < own.size(); ++k) line[k] += own[k];
        }
        Moments& here = at(column + 1, row + 1);
        for (std::size_t k = 0; k < line.size(); ++k) here[k] = at(column + 1, row)[k] + line[k];
      }
    }
  }

  Moments of_window(int column, int row) const {
    Moments sum{};
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] = at(column + kWindow, row + kWindow)[k] - at(column, row + kWindow)[k] - at(column + kWindow, row)[k] +
               at(column, row)[k];
    }
    return sum;
  }

 private:
  Moments& at(int column, int row) { return table_[static_cast<std::size_t>(row) * width_ + column]; }
  const Moments& at(int column, int row) const { return table_[static_cast<std::size_t>(row) * width_ + column]; }

  int width_;
  std::vector<Moments> table_;
};

double similarity(const Sums::Moments& m) {
  const double n = m[0], x = m[1] / n, y = m[2] / n;
  const double xx = m[3] / n - x * x, yy = m[4] / n - y * y, xy = m[5] / n - x * y;
  return (2 * x * y + kC1) * (2 * xy + kC2) / ((x * x + y * y + kC1) * (xx + yy + kC2));
}

}  // namespace

AoDifference difference(const Openness& reference, const Openness& other) {
  LFD_CHECK(reference.size == other.size, "pictures of one size are compared");
  AoDifference found;
  double absolute = 0, signed_sum = 0;
  for (std::size_t i = 0; i < reference.value.size(); ++i) {
    if (reference.value[i] < 0 || other.value[i] < 0) continue;
    const double off = double{other.value[i]} - reference.value[i];
    absolute += std::abs(off);
    signed_sum += off;
    ++found.pixels;
  }
  if (found.pixels == 0) return found;
  found.mae = absolute / static_cast<double>(found.pixels);
  found.mean = signed_sum / static_cast<double>(found.pixels);
  const Sums sums(reference, other);
  double ssim = 0;
  for (int row = 0; row + kWindow <= reference.size.height; ++row) {
    for (int column = 0; column + kWindow <= reference.size.width; ++column) {
      const Sums::Moments moments = sums.of_window(column, row);
      if (moments[0] < kWindow * kWindow) continue;
      ssim += similarity(moments);
      ++found.windows;
    }
  }
  if (found.windows > 0) found.ssim = ssim / static_cast<double>(found.windows);
  return found;
}

}  // namespace lfd::bench
