// The cases of `lfd bench stability`, each a test of its own.
#include "bench/stability/suite.h"

#include <gtest/gtest.h>

#include <cctype>

#include "tests/support/rendering.h"

namespace lfd {
namespace {

class Stability : public testing::TestWithParam<bench::StabilityCase> {};

TEST_P(Stability, ComesOutAsStated) {
  const bench::StabilityCase& one = GetParam();
  const bench::Outcome outcome = one.run(testing_support::context());
  EXPECT_TRUE(outcome.passed) << one.group << ": " << one.name << "\nexpected: " << one.expected
                              << "\ngot: " << outcome.got << "\nworst error: " << outcome.worst;
}

// GoogleTest's names are letters and digits; the number keeps them apart.
std::string test_name(const testing::TestParamInfo<bench::StabilityCase>& info) {
  std::string name = std::to_string(info.index) + "_";
  for (const char c : info.param.group + "_" + info.param.name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain) {
      name += c;
    } else if (name.back() != '_') {
      name += '_';
    }
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::ValuesIn(bench::stability_cases()), test_name);

}  // namespace

namespace bench {
void PrintTo(const StabilityCase& one, std::ostream* out) { *out << one.group << ": " << one.name; }
}  // namespace bench
}  // namespace lfd
