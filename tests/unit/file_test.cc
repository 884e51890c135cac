// Files that are written: what is replaced, what is written to as it is, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "base/file.h"
#include "base/temporary_folder.h"
#include "proto/frame_files.h"

namespace lfd {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public testing::Test {
 protected:
  const TemporaryFolder temporary_ = *TemporaryFolder::make("lfd-files");
  const fs::path folder_ = temporary_.path();
};

TEST_F(Files, AreReplacedWholeAndKeepTheirPermissions) {
  ASSERT_TRUE(write_file(folder_ / "a", "old"));
  fs::permissions(folder_ / "a", fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_TRUE(write_file(folder_ / "a", "new"));
  EXPECT_EQ(*read_file(folder_ / "a"), "new");
  EXPECT_EQ(fs::status(folder_ / "a").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Files, AreWrittenThroughLinks) {
  fs::create_directory(folder_ / "there");
  fs::create_symlink("there/b", folder_ / "a");
  for (const char* content : {"first", "second"}) {  // the link leads nowhere at first
    ASSERT_TRUE(write_file(folder_ / "a", content));
    EXPECT_TRUE(fs::is_symlink(folder_ / "a"));
    EXPECT_EQ(*read_file(folder_ / "there" / "b"), content);
  }
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THAT(write_file(folder_ / "circle", "").error().message(), HasSubstr("links"));
}

TEST_F(Files, ThatAreNoneAreWrittenToAsTheyAre) {
  fs::create_symlink("/dev/null", folder_ / "a");
  EXPECT_TRUE(write_file(folder_ / "a", "gone"));
  EXPECT_TRUE(fs::is_character_file(folder_ / "a"));
  EXPECT_THAT(write_file("/dev/full", "x").error().message(), HasSubstr("/dev/full: cannot be written"));
}

TEST_F(Files, AreRefusedWhereTheyCannotBe) {
  EXPECT_THAT(write_file(folder_ / "no" / "a", "").error().message(), HasSubstr("there is no folder"));
  EXPECT_FALSE(fs::exists(folder_ / "no"));
  EXPECT_THAT(write_file(folder_, "").error().message(), HasSubstr("is a folder"));
  ASSERT_TRUE(write_file(folder_ / "a", "kept"));
  EXPECT_FALSE(make_folder(folder_ / "a"));
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everything";
  fs::permissions(folder_ / "a", fs::perms::owner_read);
  EXPECT_THAT(write_file(folder_ / "a", "").error().message(), HasSubstr("cannot be written"));
  EXPECT_EQ(*read_file(folder_ / "a"), "kept");
}

TEST_F(Files, HaveTheirFolderToOneWriterAtATime) {
  {
    const auto first = FolderLock::take(folder_);
    ASSERT_TRUE(first);
    const auto second = FolderLock::take(folder_);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().message(), HasSubstr("another process writes there"));
  }
  EXPECT_TRUE(FolderLock::take(folder_));
  EXPECT_TRUE(FolderLock::wait(folder_));  // that it waits: KeyFiles.WhoeverMakesKeysAtTheSameTimeMakesOneSet
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_FALSE(FolderLock::take(folder_ / "none"));
  EXPECT_FALSE(FolderLock::wait(folder_ / "none"));
}

TEST_F(Files, ForAWhileNeedAFolderThatIsThere) {
  const char* const before = std::getenv("TMPDIR");
  const std::optional<std::string> kept = before != nullptr ? std::optional<std::string>(before) : std::nullopt;
  const fs::path none = folder_ / "none";
  ::setenv("TMPDIR", none.c_str(), 1);
  const auto missing = TemporaryFolder::make("lfd-files");
  ::setenv("TMPDIR", folder_.c_str(), 1);
  fs::path place;
  {
    const TemporaryFolder made = *TemporaryFolder::make("lfd-files");
    place = made.path();
    EXPECT_TRUE(fs::is_directory(place));
    EXPECT_EQ(place.parent_path(), folder_);
  }
  kept ? ::setenv("TMPDIR", kept->c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_FALSE(fs::exists(place));
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("TMPDIR " + none.string()));
}

TEST_F(Files, OfFramesTellTheirNumbers) {
  EXPECT_TRUE(frames_in(folder_ / "none").empty());
  for (const char* const name : {"frame-0007", "frame-12345", "frame-", "frame-3x", "frame", "picture-0001"})
    ASSERT_TRUE(make_folder(folder_ / name));
  EXPECT_EQ(frames_in(folder_), (std::set<std::uint64_t>{7, 12345}));
}

TEST_F(Files, OfEarlierFramesAreRemovedAndNoOthers) {
  const fs::path out = folder_ / "out";
  for (int frame : {0, 1}) ASSERT_TRUE(make_folder(frame_path(out, static_cast<std::uint64_t>(frame))));
  const std::vector<fs::path> own{report_path(out), image_path(out, 0, 3, proto::COLOR),
                                  image_path(out, 1, 3, proto::AO)};
  const std::vector<fs::path> others{out / "notes.txt", frame_path(out, 1) / "module-003.color.png.txt",
                                     out / "frame-0002.png"};
  for (const auto& files : {own, others}) {
    for (const fs::path& file : files) ASSERT_TRUE(write_file(file, "x"));
  }
  const auto removed = remove_frames(out);
  ASSERT_TRUE(removed);
  EXPECT_EQ(*removed, 2);
  for (const fs::path& file : own) EXPECT_FALSE(fs::exists(file)) << file;
  for (const fs::path& file : others) EXPECT_TRUE(fs::exists(file)) << file;
  EXPECT_FALSE(fs::exists(frame_path(out, 0)));
  EXPECT_EQ(*remove_frames(out), 0);
}

}  // namespace
}  // namespace lfd
