// What GL's debug output reports is counted and logged.
#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/log.h"
#include "tests/support/rendering.h"

namespace lfd {
namespace {

using testing::HasSubstr;

TEST(GlDebug, ErrorsAreCountedAndReachTheLog) {
  const int before = gl::Context::error_count();
  testing::internal::CaptureStderr();
  start_log("test", "error");  // base/log.h: without it the log goes to standard output
  glEnable(0xdead);
  const std::string said = testing::internal::GetCapturedStderr();
  while (glGetError() != GL_NO_ERROR) {
  }
  EXPECT_EQ(gl::Context::error_count(), before + 1);
  EXPECT_THAT(said, HasSubstr("GL: "));
}

}  // namespace
}  // namespace lfd
