// Where deployments may listen: plain on this machine, beyond it with keys or in so many words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "calibration/make.h"
#include "proto/calibration_file.h"
#include "proto/deployment_file.h"
#include "proto/deployment_keys.h"

namespace lfd {
namespace {

using testing::HasSubstr;

constexpr const char* kRemote =
    "addresses { control: \"tcp://10.0.0.1:1\" state: \"tcp://10.0.0.1:2\" bulk: \"tcp://10.0.0.1:3\""
    " images: \"tcp://10.0.0.2:4\" } ";
constexpr const char* kKeys = "security { keys: \"keys\" }";
constexpr const char* kAccepts = "security { accept_plain_tcp_beyond_loopback: true }";

class DeploymentSecurity : public testing::Test {
 protected:
  DeploymentSecurity() { EXPECT_TRUE(save_calibration(folder_.path() / "desk.textproto", *make_display("desk"))); }

  Result<Deployment> load(const std::string& more) const {
    const auto path = folder_.path() / "wall.textproto";
    EXPECT_TRUE(write_file(
        path, "display: \"desk.textproto\" scene { made { name: \"plane\" } } node { name: \"left\" }\n" + more));
    return load_deployment(path);
  }
  std::string error(const std::string& more) const {
    const auto deployment = load(more);
    return deployment ? "" : deployment.error().message();
  }

  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-security");
};

TEST_F(DeploymentSecurity, PlainTcpBeyondThisMachineIsRefusedUnlessItSaysSo) {
  EXPECT_THAT(error(kRemote), HasSubstr("addresses: control: \"tcp://10.0.0.1:1\": plain tcp beyond this machine"));
  EXPECT_EQ(error(fmt::format("{}{}", kRemote, kKeys)), "");
  EXPECT_EQ(error(fmt::format("{}{}", kRemote, kAccepts)), "");
  EXPECT_THAT(error("addresses { images: \"tcp://10.0.0.2:4\" }"), HasSubstr("addresses: images: "));
}

TEST_F(DeploymentSecurity, KeysAndPlainTcpExcludeEachOther) {
  EXPECT_THAT(error("\nsecurity { keys: \"keys\"\n accept_plain_tcp_beyond_loopback: true }"),
              HasSubstr("wall.textproto:4: security: accept_plain_tcp_beyond_loopback: with keys"));
}

TEST_F(DeploymentSecurity, WhatOthersReachIsReachedWhole) {
  EXPECT_THAT(error("addresses { control: \"tcp://10.0.0.1:1\" state: \"tcp://127.0.0.1:2\" } " + std::string(kKeys)),
              HasSubstr("state: \"tcp://127.0.0.1:2\" cannot be reached from other machines"));
}

TEST_F(DeploymentSecurity, OnlyThisMachineIsThisMachine) {
  for (const char* const local :
       {"ipc:///run/x", "tcp://127.0.0.1:1", "tcp://127.8.9.1:*", "tcp://localhost:1", "tcp://[::1]:1"})
    EXPECT_TRUE(is_local_endpoint(local)) << local;
  for (const char* const remote :
       {"tcp://10.0.0.1:1", "tcp://127.example.org:1", "tcp://127.0.0.1.example.org:1", "tcp://localhost.example.org:1",
        "tcp://*:1", "tcp://0.0.0.0:1", "tcp://[::]:1", "tcp://eth0:1", "tcp://1270.0.0.1:1", "tcp://127.1:1"})
    EXPECT_FALSE(is_local_endpoint(remote)) << remote;
}

TEST_F(DeploymentSecurity, EndpointsOfCommandLinesFollowTheDeployment) {
  EXPECT_THAT(check_endpoint(*load(""), "tcp://10.0.0.1:1").error().message(), HasSubstr("give the deployment keys"));
  EXPECT_TRUE(check_endpoint(*load(""), "tcp://127.0.0.1:1"));
  EXPECT_TRUE(check_endpoint(*load(kKeys), "tcp://10.0.0.1:1"));
  EXPECT_TRUE(check_endpoint(*load(kAccepts), "tcp://10.0.0.1:1"));
}

TEST_F(DeploymentSecurity, WhereThereIsNoDeploymentOptionsAreNamed) {
  EXPECT_THAT(check_endpoint("tcp://10.0.0.1:1", false, false).error().message(),
              testing::AllOf(HasSubstr("with --key, or say --accept-plain-tcp-beyond-loopback"),
                             testing::Not(HasSubstr("deployment"))));
}

}  // namespace
}  // namespace lfd
