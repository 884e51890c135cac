// What daemons tell Prometheus is what docs/metrics.md says and what the dashboard asks for; who may ask.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>

#include "base/file.h"
#include "base/log.h"
#include "tests/harness/http.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;

const std::filesystem::path kSource = LFD_SOURCE_DIR;

struct Metric {
  std::string kind;
  std::set<std::string> labels;
  bool operator==(const Metric&) const = default;
};
void PrintTo(const Metric& metric, std::ostream* out) {
  *out << metric.kind << " " << testing::PrintToString(metric.labels);
}
using Metrics = std::map<std::string, Metric>;

std::string text_of(const std::filesystem::path& path) {
  const auto text = read_file(kSource / path);
  LFD_CHECK(text, text.error().message());
  return *text;
}

// The rows of docs/metrics.md.
Metrics documented() {
  const std::string text = text_of("docs/metrics.md");
  const std::regex row(R"re(\| `(\w+)` \| (\w+) \| ([\w, ]*?) ?\| [^|\n]+ \|\n)re"), word(R"re(\w+)re");
  Metrics metrics;
  for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it) {
    Metric& metric = metrics[it->str(1)];
    metric.kind = it->str(2);
    const std::string labels = it->str(3);
    for (std::sregex_iterator label(labels.begin(), labels.end(), word); label != end; ++label)
      metric.labels.insert(label->str());
  }
  return metrics;
}

// The families of a page of Prometheus' text format, with the labels of their samples.
void add_exposed(const std::string& page, Metrics& metrics) {
  const std::regex type(R"re(# TYPE (\w+) (\w+)\n)re"), label(R"re(([a-z]+)="[^"]*")re");
  const std::sregex_iterator end;
  for (std::sregex_iterator it(page.begin(), page.end(), type); it != end; ++it) {
    const std::string name = it->str(1);
    EXPECT_THAT(page, HasSubstr("# HELP " + name + " ")) << "every metric explains itself";
    Metric& metric = metrics[name];
    metric.kind = it->str(2);
    const std::regex sample("\n" + name + "(_bucket|_sum|_count)?\\{([^\n]*)\\} ");
    for (std::sregex_iterator one(page.begin(), page.end(), sample); one != end; ++one) {
      const std::string labels = one->str(2);
      for (std::sregex_iterator each(labels.begin(), labels.end(), label); each != end; ++each)
        metric.labels.insert(each->str(1));
    }
  }
}

int port_of(const std::string& line) { return std::stoi(line.substr(line.rfind(':') + 1)); }

// The port that the process says its metrics are at.
int metrics_port(const Process& process, const std::string& address = "127.0.0.1") {
  const std::string mark = fmt::format("metrics http://{}:", address);
  LFD_CHECK(says(process, mark), mark);
  for (const std::string& line : process.lines()) {
    if (line.find(mark) != line.npos) return port_of(line);
  }
  return 0;
}

// The page, once `wanted` is in it.
std::string page_with(int port, const std::string& wanted) {
  const auto deadline = Clock::now() + kClusterPatience;
  while (true) {
    const auto page = http_get("127.0.0.1", port, "/metrics");
    EXPECT_TRUE(page) << page.error().message();
    if (!page || std::regex_search(*page, std::regex(wanted))) return page ? *page : "";
    EXPECT_LT(Clock::now(), deadline) << wanted << " does not come: " << *page;
    if (Clock::now() >= deadline) return *page;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

TEST(Metrics, OfARunningClusterAreThoseOfTheDocument) {
  const Workbench bench;
  const std::string file = bench.deployment("pacing { heartbeat_ms: 100 frames_per_second: 30 }");
  auto controller = start_controller(file, {"--metrics", "0"});
  const auto start = [&](const char* program, std::vector<std::string> more) {
    more.insert(more.end(), {"--controller", controller.endpoint, "--metrics", "*"});
    return start_program(program, more);
  };
  const auto left = start("lfd-rendernode", {file, "--name", "left"});
  const auto right = start("lfd-rendernode", {file, "--name", "right"});
  const auto display = start("lfd-display", {});
  const int controller_port = metrics_port(*controller.process), left_port = metrics_port(*left),
            display_port = metrics_port(*display);
  const std::string of_controller =
      page_with(controller_port, "lfd_controller_peer_begin_to_ready_seconds\\{peer=\"right\",role=\"node\"\\} 0\\.");
  const std::string of_display = page_with(display_port, "\nlfd_display_shown_frames_total\\{[^\n]*\\} [1-9]");
  const std::string of_left =
      page_with(left_port, "lfd_node_stage_seconds_count\\{node=\"left\",pass=\"gbuffer\"\\} [1-9]");

  Metrics exposed;
  for (const std::string& page : {of_controller, of_left, of_display}) add_exposed(page, exposed);
  for (const char* name : {"process_resident_memory_bytes", "process_open_fds"})
    for (const char* label : {"node", "display"}) EXPECT_EQ(exposed[name].labels.erase(label), 1u);
  exposed["exposer_request_latencies"].labels.erase("quantile");
  for (auto& [name, metric] : exposed) metric.labels.erase("le");
  EXPECT_EQ(exposed, documented());

  EXPECT_THAT(of_controller, HasSubstr("\nlfd_controller_modules 4\n"));
  EXPECT_THAT(of_controller, HasSubstr("\nlfd_controller_peer_modules{peer=\"left\",role=\"node\"} 2\n"));
  EXPECT_THAT(of_left, HasSubstr("\nlfd_node_joined{node=\"left\"} 1\n"));
  EXPECT_THAT(of_display, HasSubstr("\nlfd_display_modules{display=\"display\"} 4\n"));
  EXPECT_THAT(of_display, Not(HasSubstr("process_open_fds{display=\"display\"} 0\n")));
}

TEST(Metrics, AreForThisMachineAloneUnlessAnAddressIsNamed) {
  const Workbench bench;
  const std::string file = bench.deployment("");
  auto alone = start_controller(file, {"--metrics", "0"});
  const int port = metrics_port(*alone.process);
  EXPECT_TRUE(http_get("127.0.0.1", port, "/metrics"));
  EXPECT_FALSE(http_get("127.0.0.2", port, "/metrics")) << "that is this machine too, but another address";
  EXPECT_FALSE(http_get("127.0.0.1", port, "/"));
  auto open = start_controller(file, {"--metrics", "0.0.0.0:0"});
  EXPECT_TRUE(http_get("127.0.0.2", metrics_port(*open.process, "0.0.0.0"), "/metrics"));
}

TEST(Metrics, APlaceThatCannotBeIsAnError) {
  const Workbench bench;
  const std::string file = bench.deployment("");
  auto first = start_controller(file, {"--metrics", "0"});
  const std::string taken = std::to_string(metrics_port(*first.process));
  for (const auto& [place, why] : {std::pair<std::string, std::string>("80x", "the port must be 0 to 65535"),
                                   {"99999", "the port must be 0 to 65535"},
                                   {"host:80", "\"host\" is no IPv4 address"},
                                   {taken, "127.0.0.1:" + taken + " cannot be listened at"}}) {
    const auto second = start_program("lfd-controller", {file, "--metrics", place});
    const auto exit = second->wait(kClusterPatience);
    ASSERT_TRUE(exit) << place;
    EXPECT_EQ(exit->code, 1);
    EXPECT_THAT(second->lines(), Contains(AllOf(HasSubstr("error: metrics: "), HasSubstr(why))));
  }
}

TEST(Dashboard, AsksForMetricsThatThereAre) {
  const Metrics metrics = documented();
  ASSERT_GT(metrics.size(), 40u);
  const auto dashboard = nlohmann::json::parse(text_of("configs/grafana/lfd.json"));
  const std::regex word(R"re([a-z_]+)re"), by(R"re(by \(([a-z, ]+)\))re");
  const std::sregex_iterator end;
  std::vector<std::string> strange;
  std::size_t asked = 0;
  for (const auto& panel : dashboard["panels"]) {
    for (const auto& target : panel["targets"]) {
      const std::string expression = target["expr"];
      std::set<std::string> labels{"le"};
      for (std::sregex_iterator it(expression.begin(), expression.end(), word); it != end; ++it) {
        std::string name = it->str();
        if (!name.starts_with("lfd_") && !name.starts_with("process_")) continue;
        ++asked;
        const std::string whole = name;
        for (const char* suffix : {"_bucket", "_sum", "_count"}) {
          if (name.ends_with(suffix)) name.resize(name.size() - std::string(suffix).size());
        }
        const auto metric = metrics.find(name);
        if (metric == metrics.end() || (metric->second.kind == "histogram") != (name != whole))
          strange.push_back(whole);
        else
          labels.insert(metric->second.labels.begin(), metric->second.labels.end());
      }
      std::smatch grouped;
      if (!std::regex_search(expression, grouped, by)) continue;
      const std::string names = grouped.str(1);
      for (std::sregex_iterator it(names.begin(), names.end(), word); it != end; ++it)
        if (!labels.contains(it->str())) strange.push_back(expression + ": " + it->str());
    }
  }
  EXPECT_THAT(strange, IsEmpty());
  EXPECT_GT(asked, 15u);
}

}  // namespace
}  // namespace lfd::harness
