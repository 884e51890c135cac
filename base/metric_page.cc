// Collecting samples into families.
#include "base/metric_page.h"

#include <algorithm>

#include "base/check.h"

namespace lfd {

const std::vector<double>& DurationHistogram::bounds_s() {
  static const std::vector<double> kBounds{0.0005, 0.001, 0.002, 0.004, 0.008, 0.012, 0.016, 0.02, 0.025, 0.034,
                                           0.05,   0.07,  0.1,   0.2,   0.5,   1,     2,     5,    10,    60};
  return kBounds;
}

void DurationHistogram::observe_ms(double ms) {
  const double s = ms / 1000;
  const auto bucket = std::ranges::lower_bound(bounds_s(), s) - bounds_s().begin();
  ++counts_[static_cast<std::size_t>(bucket)];
  sum_s_ += s;
}

void MetricPage::counter(const char* name, const char* help, double value, MetricLabels labels) {
  add(name, help, MetricKind::kCounter, std::move(labels)).value = value;
}

void MetricPage::gauge(const char* name, const char* help, double value, MetricLabels labels) {
  add(name, help, MetricKind::kGauge, std::move(labels)).value = value;
}

void MetricPage::histogram(const char* name, const char* help, const DurationHistogram& value, MetricLabels labels) {
  add(name, help, MetricKind::kHistogram, std::move(labels)).histogram = value;
}

MetricSample& MetricPage::add(const char* name, const char* help, MetricKind kind, MetricLabels labels) {
  auto family = std::ranges::find(families_, name, &MetricFamily::name);
  if (family == families_.end()) family = families_.insert(families_.end(), {name, help, kind, {}});
  LFD_CHECK(family->kind == kind, name);
  labels.insert(labels.begin(), common_.begin(), common_.end());
  return family->samples.emplace_back(MetricSample{std::move(labels), 0, {}});
}

}  // namespace lfd
