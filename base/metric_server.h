// Where Prometheus fetches a process's metrics: an HTTP server with threads of its own, which hands out what it was
// told last.
#pragma once

#include <memory>
#include <string>

#include "base/metric_page.h"
#include "base/result.h"

namespace lfd {

// Of the option --metrics.
inline constexpr const char* kMetricsHelp =
    "Answer Prometheus at http://ADDRESS:PORT/metrics; without an address on the loopback interface; port 0 or * "
    "chooses a free one; the address is printed on standard output (docs/metrics.md says what each metric is)";

class MetricServer {
 public:
  // "PORT" or "ADDRESS:PORT", of IPv4. Make it once signals are blocked: it starts threads. Errors: no such
  // place, the port is taken.
  static Result<std::unique_ptr<MetricServer>> open(const std::string& place);
  ~MetricServer();

  // "http://127.0.0.1:9464/metrics", with the real port.
  const std::string& url() const { return url_; }

  // From now on this is handed out, with the process's memory, descriptors and start.
  void publish(MetricPage page);

 private:
  struct Exposed;
  MetricServer(std::unique_ptr<Exposed> exposed, std::string url);

  std::unique_ptr<Exposed> exposed_;
  std::string url_;
};

// The same with the line on standard output that says where: "PROGRAM: metrics URL". Null where the place is empty:
// nobody asked.
Result<std::unique_ptr<MetricServer>> open_metrics(const char* program, const std::string& place);

}  // namespace lfd
