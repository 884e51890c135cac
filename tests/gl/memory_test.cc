// A GPU without the memory for what is asked of it: one error, and the renderer goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rendernode/gl/memory.h"
#include "rendernode/passes/targets.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing::MatchesRegex;

TEST(GpuMemory, IsAnErrorWhereTheTargetsDoNotFitAndKeepsNothing) {
  FramePlan plan;
  plan.position = true;
  // 8192 x 8192 x 256 pixels of 28 bytes are 448 GiB.
  Targets targets({8192, 8192}, 256);
  const Status prepared = targets.prepare(plan);
  ASSERT_FALSE(prepared);
  // Some drivers promise the memory, and refuse to draw into it.
  EXPECT_THAT(prepared.error().message(),
              MatchesRegex("the GPU (has no memory for|cannot draw into) the pictures of 256 modules of 8192x8192.*"));
  EXPECT_EQ(targets.albedo(), 0u);
  EXPECT_EQ(targets.position(), 0u);
}

TEST(GpuMemory, IsForgottenOnceTold) {
  FramePlan plan;
  Targets huge({8192, 8192}, 256), small({8, 8}, 2);
  ASSERT_FALSE(huge.prepare(plan));
  EXPECT_TRUE(gl::memory_status("nothing"));
  EXPECT_TRUE(small.prepare(plan));
  EXPECT_NE(small.albedo(), 0u);
}

}  // namespace
}  // namespace lfd
