// What daemons listen at is free again once they have ended: files of ipc sockets are gone, ports can be bound.
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <set>
#include <string>

#include "base/log.h"
#include "proto/wire/socket.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;

// Whether it cannot be listened at, since somebody does already.
bool is_taken(const std::string& endpoint) {
  wire::Context context;
  return !wire::bind_router(context, endpoint);
}

// Another one at each call.
std::string tcp_endpoint() {
  static std::set<int> used;
  int port = free_port();
  while (!used.insert(port).second) port = free_port();
  return fmt::format("tcp://127.0.0.1:{}", port);
}

class DaemonAddresses : public testing::TestWithParam<const char*> {
 protected:
  fs::path socket_file(const char* channel) const { return bench_.folder() / channel; }

  std::string endpoint(const char* channel) const {
    if (GetParam() == std::string("ipc")) return fmt::format("ipc://{}", socket_file(channel).string());
    return tcp_endpoint();
  }

  void expect_taken(const std::string& address) const {
    EXPECT_TRUE(is_taken(address)) << address;
    if (address.starts_with("ipc://")) {
      EXPECT_TRUE(fs::exists(address.substr(6))) << address;
    }
  }

  void expect_free(const std::string& address) const {
    if (address.starts_with("ipc://")) {
      EXPECT_FALSE(fs::exists(address.substr(6))) << address;
    }
    EXPECT_FALSE(is_taken(address)) << address;
  }

  static void expect_end(Process& daemon) {
    daemon.signal(SIGTERM);
    const auto exit = daemon.wait(kClusterPatience);
    ASSERT_TRUE(exit) << daemon.name();
    EXPECT_TRUE(exit->succeeded()) << daemon.name() << ": " << exit->text();
  }

  const Workbench bench_;
  const std::string control_ = endpoint("control"), state_ = endpoint("state"), bulk_ = endpoint("bulk"),
                    images_ = endpoint("images");
};
INSTANTIATE_TEST_SUITE_P(Transports, DaemonAddresses, testing::Values("ipc", "tcp"),
                         [](const auto& transport) { return std::string(transport.param); });

TEST_P(DaemonAddresses, AreFreeOnceTheirDaemonHasEnded) {
  const fs::path deployment = bench_.deployment(
      fmt::format("pacing {{ heartbeat_ms: 100 }} addresses {{ control: \"{}\" state: \"{}\" bulk: \"{}\" "
                  "images: \"{}\" }}",
                  control_, state_, bulk_, images_));
  const RunningController controller = start_controller(deployment);
  EXPECT_EQ(controller.endpoint, control_);
  const auto display = start_program("lfd-display", {deployment});
  const auto left = start_program("lfd-rendernode", {deployment, "--name", "left"});
  const auto right = start_program("lfd-rendernode", {deployment, "--name", "right"});
  ASSERT_TRUE(draws(control_, 1));
  for (const std::string& address : {control_, state_, bulk_, images_}) expect_taken(address);

  expect_end(*display);
  expect_free(images_);
  for (const std::string& address : {control_, state_, bulk_}) expect_taken(address);
  expect_end(*left);
  expect_end(*right);
  expect_end(*controller.process);
  for (const std::string& address : {control_, state_, bulk_}) expect_free(address);
}

}  // namespace
}  // namespace lfd::harness
