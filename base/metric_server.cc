// prometheus-cpp, whose one door this is.
#include "base/metric_server.h"

#include <arpa/inet.h>
#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <prometheus/metric_family.h>
#include <unistd.h>

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <mutex>

#include "base/log.h"

namespace lfd {
namespace {

constexpr const char* kThreads = "2";
constexpr const char* kPatience_ms = "5000";  // of a request

prometheus::ClientMetric::Histogram exposed(const DurationHistogram& histogram) {
  prometheus::ClientMetric::Histogram out;
  const std::vector<double>& bounds = DurationHistogram::bounds_s();
  for (std::size_t i = 0; i < histogram.counts().size(); ++i) {
    out.sample_count += histogram.counts()[i];
    out.bucket.push_back({out.sample_count, i < bounds.size() ? bounds[i] : std::numeric_limits<double>::infinity()});
  }
  out.sample_sum = histogram.sum_s();
  return out;
}

prometheus::MetricFamily exposed(const MetricFamily& family) {
  prometheus::MetricFamily out{family.name, family.help, prometheus::MetricType::Gauge, {}};
  if (family.kind == MetricKind::kCounter) out.type = prometheus::MetricType::Counter;
  if (family.kind == MetricKind::kHistogram) out.type = prometheus::MetricType::Histogram;
  for (const MetricSample& sample : family.samples) {
    prometheus::ClientMetric metric;
    for (const auto& [name, value] : sample.labels) metric.label.push_back({name, value});
    metric.counter.value = metric.gauge.value = sample.value;
    if (family.kind == MetricKind::kHistogram) metric.histogram = exposed(sample.histogram);
    out.metric.push_back(std::move(metric));
  }
  return out;
}

// By the names that Prometheus' own libraries use.
void add_process(MetricPage& page) {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  std::error_code failure;
  const auto descriptors = std::distance(std::filesystem::directory_iterator("/proc/self/fd", failure), {});
  page.gauge("process_resident_memory_bytes", "Memory of the process.",
             static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  page.gauge("process_open_fds", "Open descriptors of the process.", static_cast<double>(descriptors));
}

// "ADDRESS:PORT" as the server wants it: a numeric address and a port.
Result<std::string> listening_place(const std::string& place) {
  const std::size_t colon = place.rfind(':');
  std::string address = colon == place.npos ? "" : place.substr(0, colon);
  std::string port = colon == place.npos ? place : place.substr(colon + 1);
  if (address.empty() || address == "localhost") address = "127.0.0.1";
  if (port == "*") port = "0";
  in_addr parsed{};
  if (::inet_pton(AF_INET, address.c_str(), &parsed) != 1)  // Debian's civetweb knows no IPv6
    return Error(fmt::format("\"{}\": \"{}\" is no IPv4 address", place, address));
  int number = -1;
  const auto [end, failure] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (failure != std::errc() || end != port.data() + port.size() || number < 0 || number > 65535)
    return Error(fmt::format("\"{}\": the port must be 0 to 65535, or *", place));
  return fmt::format("{}:{}", address, number);
}

}  // namespace

struct MetricServer::Exposed final : prometheus::Collectable {
  std::vector<prometheus::MetricFamily> Collect() const override {
    MetricPage all;
    {
      const std::lock_guard lock(mutex);
      all = page;
    }
    add_process(all);
    std::vector<prometheus::MetricFamily> families;
    for (const MetricFamily& family : all.families()) families.push_back(exposed(family));
    return families;
  }

  mutable std::mutex mutex;
  MetricPage page;                                  // guarded
  std::shared_ptr<prometheus::Collectable> handle;  // the server holds a weak one
  std::unique_ptr<prometheus::Exposer> server;      // last: its threads call Collect
};

MetricServer::MetricServer(std::unique_ptr<Exposed> exposed, std::string url)
    : exposed_(std::move(exposed)), url_(std::move(url)) {}

MetricServer::~MetricServer() { exposed_->server.reset(); }

Result<std::unique_ptr<MetricServer>> MetricServer::open(const std::string& place) {
  const auto listening = listening_place(place);
  if (!listening) return listening.error().within("metrics");
  auto exposed = std::make_unique<Exposed>();
  try {
    exposed->server = std::make_unique<prometheus::Exposer>(std::vector<std::string>{
        "listening_ports", *listening, "num_threads", kThreads, "request_timeout_ms", kPatience_ms});
  } catch (const std::exception&) {  // it says no reason
    return Error(fmt::format(
        "metrics: {} cannot be listened at: it is no address of this machine, or the port is taken", *listening));
  }
  exposed->handle = std::shared_ptr<prometheus::Collectable>(exposed.get(), [](auto*) {});
  exposed->server->RegisterCollectable(exposed->handle);
  std::string url = fmt::format("http://{}:{}/metrics", listening->substr(0, listening->rfind(':')),
                                exposed->server->GetListeningPorts().at(0));
  return std::unique_ptr<MetricServer>(new MetricServer(std::move(exposed), std::move(url)));
}

void MetricServer::publish(MetricPage page) {
  const std::lock_guard lock(exposed_->mutex);
  exposed_->page = std::move(page);
}

Result<std::unique_ptr<MetricServer>> open_metrics(const char* program, const std::string& place) {
  if (place.empty()) return std::unique_ptr<MetricServer>();
  auto server = MetricServer::open(place);
  if (!server) return server.error();
  std::printf("%s: metrics %s\n", program, (*server)->url().c_str());
  std::fflush(stdout);
  return server;
}

}  // namespace lfd
