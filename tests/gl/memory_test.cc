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
  // 20 TiB: some drivers promise what fits their address space, and only then look for it.
  Targets targets({16384, 16384}, 2048);
  const Status prepared = targets.prepare(plan);
  ASSERT_FALSE(prepared);
  EXPECT_THAT(
      prepared.error().message(),
      MatchesRegex("the GPU (has no memory for|cannot draw into) the pictures of 2048 modules of 16384x16384.*"));
  EXPECT_EQ(targets.albedo(), 0u);
  EXPECT_EQ(targets.position(), 0u);
}

TEST(GpuMemory, IsForgottenOnceTold) {
  FramePlan plan;
  Targets huge({16384, 16384}, 2048), small({8, 8}, 2);
  ASSERT_FALSE(huge.prepare(plan));
  EXPECT_TRUE(gl::memory_status("nothing"));
  EXPECT_TRUE(small.prepare(plan));
  EXPECT_NE(small.albedo(), 0u);
}

}  // namespace
}  // namespace lfd
