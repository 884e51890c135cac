// A context that was lost stays lost, however often the driver is asked.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <thread>
#include <utility>

#include "rendernode/gl/context.h"
#include "tests/support/unwrapped.h"

namespace lfd {
namespace {

GLenum next_status = GL_NO_ERROR;

// As drivers do: a reset is told of once.
GLenum GLAPIENTRY status_told_once() { return std::exchange(next_status, GL_NO_ERROR); }

// On a thread of its own: the other tests' context stays current on theirs.
TEST(GlContext, OnceLostIsLostForGood) {
  const auto drivers_own = std::exchange(epoxy_glGetGraphicsResetStatus, status_told_once);
  bool was_lost = false, is_told = false, stays = false;
  std::thread([&] {
    const auto context = testing_support::unwrapped(gl::Context::create(-1));
    was_lost = context->is_lost();
    next_status = GL_INNOCENT_CONTEXT_RESET;
    is_told = context->is_lost();
    stays = context->is_lost();
  }).join();
  epoxy_glGetGraphicsResetStatus = drivers_own;
  if (next_status != GL_NO_ERROR) GTEST_SKIP() << "this driver's contexts tell of no resets";
  EXPECT_FALSE(was_lost);
  EXPECT_TRUE(is_told);
  EXPECT_TRUE(stays);
}

}  // namespace
}  // namespace lfd
