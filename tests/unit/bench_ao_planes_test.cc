// Pictures in files: what comes back, and what must not be believed.
#include "bench/ao/planes_file.h"

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temporary_folder.h"

namespace lfd::bench {
namespace {

class AoPlanes : public testing::Test {
 protected:
  void SetUp() override {
    Openness picture{{3, 2}, {0, 1, 0.25F, -1, 0.123456F, 0.999F}}, other{{3, 2}, {1, 1, 1, 1, 0, -1}};
    planes_ = {"what it is of", "a note", {picture, other}};
    ASSERT_TRUE(write_planes(file_, planes_));
  }

  TemporaryFolder folder_ = *TemporaryFolder::make("lfd-planes");
  std::filesystem::path file_ = folder_.path() / "some/where/pictures.planes";
  Planes planes_;
};

TEST_F(AoPlanes, ComeBack) {
  const auto read = read_planes(file_, planes_.key);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->pictures.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(read->pictures[k].size, planes_.pictures[k].size);
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(read->pictures[k].value[i], planes_.pictures[k].value[i], 0.5 / 65534 + 1e-7);
  }
  EXPECT_EQ(read->note, "a note");
  EXPECT_EQ(read->pictures[0].value[3], -1);
  EXPECT_EQ(read->pictures[0].value[0], 0);
  EXPECT_EQ(read->pictures[0].value[1], 1);
}

TEST_F(AoPlanes, AreUsedForWhatTheyAreOfOnly) {
  EXPECT_FALSE(read_planes(file_, "something else"));
  EXPECT_FALSE(read_planes(folder_.path() / "missing", planes_.key));
}

TEST_F(AoPlanes, DamagedOnesAreNotBelieved) {
  const std::string whole = *read_file(file_);
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    ASSERT_TRUE(write_file(file_, whole.substr(0, cut)));
    EXPECT_FALSE(read_planes(file_, planes_.key)) << cut;
  }
  ASSERT_TRUE(write_file(file_, whole + "x"));
  EXPECT_FALSE(read_planes(file_, planes_.key));
  for (const char* sizes :
       {"2 0 2", "2 99999999999 99999999999", "2 -3 2", "2 3", "two 3 2", "", "18446744073709551615 3 2"}) {
    ASSERT_TRUE(write_file(file_, planes_.key + "\n\n" + sizes + "\n" + whole.substr(whole.size() - 24)));
    EXPECT_FALSE(read_planes(file_, planes_.key)) << sizes;
  }
}

}  // namespace
}  // namespace lfd::bench
