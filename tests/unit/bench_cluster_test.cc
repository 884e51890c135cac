// What the cluster bench shows and concludes: scenes of many have what it says, and growth is said and missed.
#include "bench/cluster/cluster_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/cluster/crowd.h"
#include "controller/scene/loaded_scene.h"
#include "tests/unit/gltf_maker.h"

namespace lfd::bench {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

TEST(ClusterCrowd, RestsButForAFew) {
  const test::Folder folder;
  for (const int resting : {0, 1, 300}) {
    const auto file = write_crowd(folder.path(), resting);
    ASSERT_TRUE(file);
    const auto scene = load_scene(*file);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->data.scene.instance_size(), resting + kCrowdMoving);
    EXPECT_EQ(scene->data.assets.size(), 1U);
    EXPECT_EQ(scene->animations.duration_s(), 2);
    const scene::Moved early = scene->animations.at(0.25), late = scene->animations.at(0.5);
    ASSERT_EQ(early.instances.size(), static_cast<std::size_t>(kCrowdMoving));
    for (std::size_t i = 0; i < early.instances.size(); ++i)
      EXPECT_NE(early.instances[i].world_from_mesh(3), late.instances[i].world_from_mesh(3));
  }
}

ClusterRow row_of(int resting, double controller_us, double state_bytes) {
  ClusterRow row{.nodes = 4, .modules = 64, .scene = "crowd", .resting = resting};
  row.controller_us = controller_us;
  row.state_bytes = state_bytes;
  return row;
}

TEST(ClusterVerdict, GrowthWithWhatRestsIsMissed) {
  ClusterTable table;
  table.by_rest = {row_of(1, 1000, 800), row_of(10'000, 1499, 1199)};
  EXPECT_EQ(missed_bound(table), "");
  EXPECT_THAT(text_of(table),
              EndsWith("\nkept: what rests makes a frame cost the controller at most 1.5 times as much\n"));
  table.by_rest = {row_of(10'000, 1501, 800), row_of(1, 1000, 800)};
  EXPECT_EQ(missed_bound(table),
            "a frame takes 1501 us of the controller where 10000 instances rest, 1000 where 1 do; at most 1.5 times as "
            "much is wanted");
  EXPECT_THAT(text_of(table), EndsWith("\nmissed: " + missed_bound(table) + "\n"));
  table.by_rest = {row_of(1, 1000, 800), row_of(10'000, 900, 1201)};
  EXPECT_THAT(missed_bound(table), HasSubstr("1201 bytes published"));
  table.by_rest.pop_back();
  EXPECT_EQ(missed_bound(table), "") << "there is nothing to compare";
  EXPECT_THAT(text_of(table), Not(HasSubstr("kept")));
}

}  // namespace
}  // namespace lfd::bench
