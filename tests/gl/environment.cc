// Every test of the gl ring has a current context, whichever runs first or alone, and leaves no GL error behind.
#include <string_view>

#include "tests/support/rendering.h"

namespace lfd {
namespace {

class NoGlErrors : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { before_ = gl::Context::error_count(); }
  void OnTestEnd(const testing::TestInfo& test) override {
    const std::string_view suite = test.test_suite_name();
    if (suite == "GpuMemory" || suite == "GlDebug") return;  // they ask for errors
    EXPECT_EQ(gl::Context::error_count(), before_) << "GL reported errors: see the log";
  }
  int before_ = 0;
};

class CurrentContext : public testing::Environment {
  void SetUp() override {
    testing_support::context();
    testing::UnitTest::GetInstance()->listeners().Append(new NoGlErrors);
  }
};

[[maybe_unused]] const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new CurrentContext);

}  // namespace
}  // namespace lfd
