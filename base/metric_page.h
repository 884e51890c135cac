// What a process tells Prometheus, as plain values: counters, gauges and histograms by name and labels.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lfd {

// How often a duration was how long. Prometheus adds up those of several processes, so all have the same bounds.
class DurationHistogram {
 public:
  DurationHistogram() : counts_(bounds_s().size() + 1) {}

  void observe_ms(double ms);

  // Upper bounds of the buckets, ascending; one more bucket has none.
  static const std::vector<double>& bounds_s();
  const std::vector<std::uint64_t>& counts() const { return counts_; }  // of each bucket alone
  double sum_s() const { return sum_s_; }

 private:
  std::vector<std::uint64_t> counts_;
  double sum_s_ = 0;
};

using MetricLabels = std::vector<std::pair<std::string, std::string>>;  // name and value

enum class MetricKind { kCounter, kGauge, kHistogram };

struct MetricSample {
  MetricLabels labels;
  double value = 0;             // of counters and gauges
  DurationHistogram histogram;  // of histograms
};

struct MetricFamily {
  std::string name, help;
  MetricKind kind = MetricKind::kGauge;
  std::vector<MetricSample> samples;
};

class MetricPage {
 public:
  // Labels that every sample of the page has, before its own.
  explicit MetricPage(MetricLabels common = {}) : common_(std::move(common)) {}

  // A sample each; those of one name are one family, of one kind and with one help.
  void counter(const char* name, const char* help, double value, MetricLabels labels = {});
  void gauge(const char* name, const char* help, double value, MetricLabels labels = {});
  void histogram(const char* name, const char* help, const DurationHistogram& value, MetricLabels labels = {});

  const std::vector<MetricFamily>& families() const { return families_; }

 private:
  MetricSample& add(const char* name, const char* help, MetricKind kind, MetricLabels labels);

  MetricLabels common_;
  std::vector<MetricFamily> families_;
};

}  // namespace lfd
