// Deployment files: shares, defaults and overrides, and every bad field by file and line.
#include "proto/deployment_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.h"
#include "calibration/make.h"
#include "proto/calibration_file.h"
#include "proto/endpoint.h"

namespace lfd {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::string_view kText =
    "name: \"wall\"\n"                                                                       // 1
    "display: \"desk.textproto\"\n"                                                          // 2
    "scene {\n file: \"scenes/a.glb\" }\n"                                                   // 3, 4
    "roi {\n world_size { x: 1 y: 1 z: 1 } }\n"                                              // 5, 6
    "render {\n ao {\n  samples: 8 }\n}\n"                                                   // 7 to 10
    "node { name: \"a\"\n modules: \"0-2\"\n modules: \"4\" }\n"                             // 11, 12, 13
    "node {\n name: \"b\"\n modules: \"3\" }\n"                                              // 14, 15, 16
    "sink: FILES\n"                                                                          // 17
    "addresses {\n control: \"tcp://127.0.0.1:5550\"\n state: \"tcp://127.0.0.1:5551\" }\n"  // 18, 19, 20
    "pacing {\n deadline_ms: 100\n heartbeat_ms: 250 }\n";                                   // 21, 22, 23

// The folder of one test with a display of eight modules in it, gone when the test ends.
class DeploymentFile : public testing::Test {
 protected:
  DeploymentFile() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("deployment-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    EXPECT_TRUE(save_calibration(folder_ / "desk.textproto", *make_display("desk")));
  }
  ~DeploymentFile() override { std::filesystem::remove_all(folder_); }

  Result<Deployment> load(std::string_view text, const DeploymentOverrides& overrides = {}) {
    EXPECT_TRUE(write_file(folder_ / "wall.textproto", text));
    return load_deployment(folder_ / "wall.textproto", overrides);
  }

  // The error, without its folder, of loading kText with one part replaced.
  std::string error_with(std::string_view part, std::string_view replacement) {
    std::string text(kText);
    EXPECT_NE(text.find(part), text.npos) << part;
    text.replace(text.find(part), part.size(), replacement);
    const auto deployment = load(text);
    return deployment ? "" : deployment.error().message().substr(folder_.string().size() + 1);
  }

  std::filesystem::path folder_;
};

TEST_F(DeploymentFile, IsReadWithItsPathsResolved) {
  const auto deployment = load(kText);
  ASSERT_TRUE(deployment) << deployment.error().message();
  EXPECT_EQ(deployment->display, *make_display("desk"));
  EXPECT_EQ(deployment->scene_file, folder_ / "scenes/a.glb");
  EXPECT_EQ(deployment->message.sink(), proto::Deployment::FILES);
  ASSERT_EQ(deployment->nodes.size(), 2u);
  EXPECT_EQ(deployment->nodes[0].name, "a");
  EXPECT_THAT(deployment->nodes[0].modules, ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(deployment->nodes[1].modules, ElementsAre(3));
  EXPECT_EQ(deployment->addresses.control, "tcp://127.0.0.1:5550");
  EXPECT_EQ(deployment->addresses.images, "tcp://127.0.0.1:*");
  EXPECT_EQ(deployment->pacing.deadline.count(), 100);
  EXPECT_EQ(deployment->pacing.heartbeat.count(), 250);
  EXPECT_EQ(deployment->animation_frames_per_second, 60);
}

TEST_F(DeploymentFile, NodesWithoutListsShareEqually) {
  const auto deployment = load(
      "display: \"desk.textproto\" scene { made { name: \"ribbed-shell\" } }"
      "node { name: \"a\" } node { name: \"b\" } node { name: \"c\" }");
  ASSERT_TRUE(deployment) << deployment.error().message();
  EXPECT_FALSE(deployment->scene_file);
  EXPECT_THAT(deployment->nodes[0].modules, ElementsAre(0, 1, 2));
  EXPECT_THAT(deployment->nodes[1].modules, ElementsAre(3, 4, 5));
  EXPECT_THAT(deployment->nodes[2].modules, ElementsAre(6, 7));
}

TEST_F(DeploymentFile, ANodeWithoutAListBesideOneWithIsRefused) {
  const auto deployment = load(
      "display: \"desk.textproto\" scene { made { name: \"x\" } }"
      "node { name: \"a\" modules: \"0-7\" } node { name: \"spare\" }");
  ASSERT_FALSE(deployment);
  EXPECT_THAT(deployment.error().message(), testing::HasSubstr("node 1: modules: \"spare\" has none"));
}

TEST_F(DeploymentFile, SparesHaveNoModulesOfTheirOwn) {
  const std::string start = "display: \"desk.textproto\" scene { made { name: \"x\" } } ";
  const auto shared = load(start + "node { name: \"a\" } node { name: \"s\" spare: true } node { name: \"b\" }");
  ASSERT_TRUE(shared) << shared.error().message();
  EXPECT_THAT(shared->nodes[0].modules, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(shared->nodes[1].modules, testing::IsEmpty());
  EXPECT_TRUE(shared->nodes[1].spare);
  EXPECT_THAT(shared->nodes[2].modules, ElementsAre(4, 5, 6, 7));
  const auto listed = load(start + "node { name: \"a\" modules: \"0-7\" } node { name: \"s\" spare: true }");
  ASSERT_TRUE(listed) << listed.error().message();
  EXPECT_THAT(listed->nodes[1].modules, testing::IsEmpty());
  const auto both = load(start + "node { name: \"a\" } node { name: \"s\" spare: true modules: \"3\" }");
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().message(), testing::HasSubstr("node 1: modules: \"s\" is a spare"));
  const auto idle = load(start + "node { name: \"s\" spare: true }");
  ASSERT_FALSE(idle);
  EXPECT_THAT(idle.error().message(), testing::HasSubstr("at least one has to draw"));
}

TEST_F(DeploymentFile, StreamsAreHeldToTheirRanges) {
  const std::string start = "display: \"desk.textproto\" scene { made { name: \"x\" } } node { name: \"a\" } ";
  EXPECT_TRUE(load(start + "stream { codec: JPEG_IMAGES quality: 100 waiting_mib: 64 assets_mib: 64 }"));
  EXPECT_TRUE(load(start + "stream { codec: ZSTD_IMAGES level: 19 }"));
  for (const char* const wrong :
       {"quality: 0", "quality: 101", "level: 0", "level: 20", "waiting_mib: 65537", "assets_mib: 65"}) {
    const auto deployment = load(start + "stream { " + wrong + " }");
    ASSERT_FALSE(deployment) << wrong;
    const std::string field(wrong, std::string_view(wrong).find(':'));
    EXPECT_THAT(deployment.error().message(), testing::HasSubstr("stream: " + field));
  }
}

TEST_F(DeploymentFile, AnotherDisplayIsSharedEqually) {
  ASSERT_TRUE(save_calibration(folder_ / "four.textproto", *make_display("desk", 4)));
  const auto deployment = load(kText, {folder_ / "four.textproto", "other.glb"});
  ASSERT_TRUE(deployment) << deployment.error().message();
  EXPECT_EQ(deployment->scene_file, "other.glb");
  EXPECT_THAT(deployment->nodes[0].modules, ElementsAre(0, 1));
  EXPECT_THAT(deployment->nodes[1].modules, ElementsAre(2, 3));
}

TEST_F(DeploymentFile, AGuardBandMustFitTheDisplay) {
  DisplayCalibration large = *make_display("desk", 4);
  large.image = {8000, 600};
  ASSERT_TRUE(save_calibration(folder_ / "large.textproto", large));
  std::string text(kText);
  text.replace(text.find("samples: 8"), 10, "guard_band_px: 100");
  EXPECT_TRUE(load(text));
  const auto refused = load(text, {folder_ / "large.textproto", "other.glb"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(),
              testing::HasSubstr("9: render: ao.guard_band_px: images of 8000x600 px become 8200x800"));
}

TEST_F(DeploymentFile, EveryBadFieldIsNamedWithItsLine) {
  struct Case {
    std::string_view part, replacement, error;
  };
  const Case cases[] = {
      {"modules: \"3\"", "modules: \"2\"", "16: node \"b\": modules: 2 is owned by node \"a\" already"},
      {"modules: \"4\"", "modules: \"8\"", "13: node \"a\": modules: 8; the display has modules 0 to 7"},
      {"modules: \"4\"", "modules: \"6-4\"", "13: node \"a\": modules: \"6-4\" runs backwards"},
      {"modules: \"4\"", "modules: \"4-\"", "13: node \"a\": modules: "},
      {"modules: \"4\"", "modules: \"-4\"", "13: node \"a\": modules: "},
      {"modules: \"4\"", "modules: \"99999999999\"", "13: node \"a\": modules: "},
      {"modules: \"4\"", "modules: \"1\"", "13: node \"a\": modules: 1 is owned by node \"a\" already"},
      {"name: \"b\"", "name: \"a\"", "15: node 1: name: \"a\" is the name of node 0 already"},
      {"name: \"b\"", "name: \"a b\"", "15: node 1: name: "},
      {"name: \"b\"", "name: \"..\"", "15: node 1: name: 1 to 64 letters"},
      {"name: \"b\"", "name: \"display\"", "15: node 1: name: \"display\" is the display's own"},
      {"name: \"b\"", "name: \"controller\"", "15: node 1: name: \"controller\" is the controller's own"},
      {"name: \"b\"", "", "14: node 1: name: is missing"},
      {"name: \"b\"", "name: \"b\" gpu: -1", "15: node 1: gpu: "},
      {"display: \"desk.textproto\"", "", ": display: "},
      {"desk.textproto", "none.textproto", ":2: display: "},
      {"file: \"scenes/a.glb\"", "", "3: scene: "},
      {"file: \"scenes/a.glb\"", "file: \"a\" frames_per_second: -1", "4: scene: frames_per_second: "},
      {"world_size { x: 1 y: 1 z: 1 }", "world_size { x: 1 y: -1 z: 1 }", "6: roi: world_size: "},
      {"samples: 8", "samples: 1000", "9: render: ao.samples: 1000"},
      {"samples: 8 }", "samples: 8 } pattern { kind: GRID spacing_px: -3 }", "9: render: pattern.spacing_px: -3; 1 to"},
      {"samples: 8 }", "samples: 8 }\n pattern { kind: SOLID\n modules: \"1\"\n modules: \"6-8\" }",
       "12: render: pattern.modules 1: 8; the display has modules 0 to 7"},
      {"samples: 8 }", "samples: 8 } pattern { kind: STRIPES }", "9: "},
      {"sink: FILES", "sink: 7", "17: "},
      {"tcp://127.0.0.1:5550", "127.0.0.1:5550", "19: addresses: control: "},
      {"tcp://127.0.0.1:5550", "tcp://localhost:5550",
       "19: addresses: control: \"tcp://localhost:5550\": neither names"},
      {"tcp://127.0.0.1:5551", "tcp://*:5551", "20: addresses: state: \"tcp://*:5551\": peers are told"},
      {"tcp://127.0.0.1:5550", "tcp://10.0.0.1:5550", "19: addresses: control: \"tcp://10.0.0.1:5550\": plain tcp"},
      {"tcp://127.0.0.1:5551", "tcp://127.0.0.1:5550",
       "20: addresses: state: \"tcp://127.0.0.1:5550\" is the address of control already"},
      {"deadline_ms: 100", "deadline_ms: -1", "22: pacing: deadline_ms: "},
      {"heartbeat_ms: 250", "heartbeat_ms: 1", "23: pacing: heartbeat_ms: "},
      {"heartbeat_ms: 250", "heartbeat: 1", "23: "},
  };
  for (const Case& c : cases) {
    const std::string begin =
        std::string("wall.textproto") + (c.error.starts_with(':') ? "" : ":") + std::string(c.error);
    EXPECT_THAT(error_with(c.part, c.replacement), StartsWith(begin)) << c.replacement;
  }
  EXPECT_THAT(load("name: \"x\"").error().message(), testing::HasSubstr("node: at least one is needed"));
}

TEST(EqualShares, CoverEveryModuleOnceInOrder) {
  for (const int modules : {1, 2, 7, 8, 64, 72, 1024}) {
    for (int nodes = 1; nodes < 20; ++nodes) {
      int next = 0;
      for (const auto& share : equal_shares(modules, nodes)) {
        EXPECT_GE(static_cast<int>(share.size()), modules / nodes);
        EXPECT_LE(static_cast<int>(share.size()), (modules + nodes - 1) / nodes);
        for (const int module : share) EXPECT_EQ(module, next++);
      }
      EXPECT_EQ(next, modules);
    }
  }
}

TEST(Endpoint, IsTcpWithPortOrIpcWithPath) {
  for (const char* good :
       {"tcp://127.0.0.1:5550", "tcp://*:1", "tcp://wall-3.local:65535", "tcp://[::1]:*", "ipc:///tmp/x"}) {
    EXPECT_TRUE(validate_endpoint(good)) << good;
  }
  for (const char* bad : {"", "tcp://", "tcp://host", "tcp://host:", "tcp://:5550", "tcp://host:0", "tcp://host:65536",
                          "tcp://host:5x", "tcp://ho st:1", "udp://host:1", "ipc://", "inproc://x", "tcp://a/b:1"}) {
    EXPECT_FALSE(validate_endpoint(bad)) << bad;
  }
  EXPECT_FALSE(validate_endpoint("ipc://" + std::string(108, 'x')));
}

TEST(Endpoint, ToListenAtIsANumberOrAnInterface) {
  for (const char* good : {"tcp://127.0.0.1:5550", "tcp://*:1", "tcp://eth0:*", "tcp://enp0s31f6:1", "tcp://eth0.100:1",
                           "tcp://lo:1", "tcp://10.1:1", "ipc:///tmp/x"}) {
    EXPECT_TRUE(validate_bound_endpoint(good)) << good;
  }
  for (const char* bad :
       {"tcp://localhost:5550", "tcp://wall-3.local:1", "tcp://eth0.example.org:1", "tcp://300.1.1.1:1",
        "tcp://a-long-host-name:1", "tcp://eth0.:1", "tcp://[::1]:1", "tcp://1.2.3.4.5:1"}) {
    EXPECT_FALSE(validate_bound_endpoint(bad)) << bad;
  }
}

TEST(CommittedDeployments, AreAccepted) {
  const std::filesystem::path folder = std::filesystem::path(LFD_SOURCE_DIR) / "configs";
  const auto desk = load_deployment(folder / "desk.textproto");
  ASSERT_TRUE(desk) << desk.error().message();
  EXPECT_EQ(desk->nodes.size(), 2u);
  const auto wall = load_deployment(folder / "640rc.textproto");
  ASSERT_TRUE(wall) << wall.error().message();
  ASSERT_EQ(wall->nodes.size(), 4u);
  EXPECT_EQ(wall->nodes[3].modules.size(), 16u);
  const auto demo = load_deployment(folder / "demo.textproto");
  ASSERT_TRUE(demo) << demo.error().message();
  EXPECT_EQ(demo->nodes.size(), 2u);
  EXPECT_EQ(demo->display.modules.size(), 128u);
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".textproto") continue;
    const auto deployment = load_deployment(file.path());
    EXPECT_TRUE(deployment) << deployment.error().message();
  }
}

}  // namespace
}  // namespace lfd
