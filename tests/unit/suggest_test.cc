// Suggestions: edit distances with known answers, and when nothing is near enough to be suggested.
#include "base/suggest.h"

#include <gtest/gtest.h>

#include <vector>

namespace lfd {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("fromat", "format"), 1u);
  EXPECT_EQ(edit_distance("make", "made"), 1u);
}

TEST(Closest, SuggestsWhatIsNearOrBeginsAsWritten) {
  const std::vector<std::string> known = {"make", "import", "info", "check"};
  EXPECT_EQ(closest("mak", known), "make");
  EXPECT_EQ(closest("improt", known), "import");
  EXPECT_EQ(closest("ch", known), "check");
  EXPECT_EQ(closest("something", known), std::nullopt);
  EXPECT_EQ(closest("make", {}), std::nullopt);
}

}  // namespace
}  // namespace lfd
