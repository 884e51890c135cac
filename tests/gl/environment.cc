// Every test of the gl ring has a current context, whichever runs first or alone.
#include "tests/support/rendering.h"

namespace lfd {
namespace {

class CurrentContext : public testing::Environment {
  void SetUp() override { testing_support::context(); }
};

[[maybe_unused]] const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new CurrentContext);

}  // namespace
}  // namespace lfd
