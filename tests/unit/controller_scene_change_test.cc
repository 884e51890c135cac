// SceneChange: a scene is shown by all nodes or by none.
#include "controller/scene_change.h"

#include <gtest/gtest.h>

namespace lfd::controller {
namespace {

using Verdict = SceneChange::Verdict;

TEST(SceneChange, WaitsForEveryNode) {
  SceneChange change;
  EXPECT_FALSE(change.is_pending());
  const auto number = change.start({"a", "b"});
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.prepared("a", number, "");
  change.prepared("a", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.prepared("b", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kShow);
  EXPECT_TRUE(change.is_pending());
  change.finish();
  EXPECT_FALSE(change.is_pending());
}

TEST(SceneChange, WithoutNodesIsShownAtOnce) {
  SceneChange change;
  change.start({});
  EXPECT_EQ(change.verdict(), Verdict::kShow);
}

TEST(SceneChange, DoesNotWaitForWhoIsGone) {
  SceneChange change;
  const auto number = change.start({"a", "b"});
  change.gone("b");
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.prepared("a", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kShow);
}

// Restarted in between: the new process has prepared nothing yet.
TEST(SceneChange, WaitsForWhoJoinsWhileItIsPending) {
  SceneChange change;
  change.joins("early");
  const auto number = change.start({"a", "b"});
  change.gone("b");
  change.joins("b");
  change.joins("c");
  change.prepared("a", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.prepared("b", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.gone("c");
  EXPECT_EQ(change.verdict(), Verdict::kShow);
  change.joins("c");
  change.prepared("c", number, "no memory");
  EXPECT_EQ(change.verdict(), Verdict::kRefuse);
}

TEST(SceneChange, IsRefusedWhereOneNodeCannot) {
  SceneChange change;
  const auto number = change.start({"a", "b", "c"});
  change.prepared("b", number, "no memory");
  EXPECT_EQ(change.verdict(), Verdict::kRefuse);
  change.prepared("a", number, "another reason");
  change.prepared("c", number, "");
  EXPECT_EQ(change.verdict(), Verdict::kRefuse);
  EXPECT_EQ(change.error(), "node \"b\": no memory");
}

TEST(SceneChange, PassesOverWordsOfAnEarlierOneAndOfStrangers) {
  SceneChange change;
  const auto first = change.start({"a"});
  change.finish();
  const auto second = change.start({"a", "b"});
  EXPECT_NE(first, second);
  change.prepared("a", first, "too late");
  change.prepared("nobody", second, "who?");
  EXPECT_EQ(change.verdict(), Verdict::kWait);
  change.prepared("a", second, "");
  change.prepared("b", second, "");
  EXPECT_EQ(change.verdict(), Verdict::kShow);
}

}  // namespace
}  // namespace lfd::controller
