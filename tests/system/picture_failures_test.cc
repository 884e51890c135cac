// Pictures that cannot be written for a while, and later once more: both times are told of, and the time in between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "base/failure_news.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "display/picture_writer.h"
#include "proto/frame_files.h"
#include "rendernode/node/file_sink.h"
#include "tests/unit/one_pixel_images.h"

namespace lfd {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

// What is logged while `act` runs.
std::string said_during(const std::function<void()>& act) {
  testing::internal::CaptureStderr();
  start_log("test", "info");
  act();
  return testing::internal::GetCapturedStderr();
}

void put_in_the_way(const fs::path& folder) {
  fs::remove_all(folder);
  std::ofstream(folder) << "a file";
}

// `write(frame)` writes a frame, and returns once that is done or has failed.
void expect_both_times_told(const fs::path& folder, const std::function<void(std::uint64_t frame)>& write) {
  std::uint64_t frame = 0;
  const auto write_some = [&] {
    for (int i = 0; i < 3; ++i) write(frame++);
  };
  const auto lines_with = [](const std::string& said, const std::string& text) {
    int lines = 0;
    for (auto at = said.find(text); at != std::string::npos; at = said.find(text, at + 1)) ++lines;
    return lines;
  };
  const auto fail = [&] {
    put_in_the_way(folder);
    write_some();
  };
  EXPECT_EQ(lines_with(said_during(fail), "frames go on"), 1);
  fs::remove(folder);
  EXPECT_THAT(said_during(write_some), IsEmpty()) << "it may fail again at once";
  std::this_thread::sleep_for(FailureNews::kQuiet);
  EXPECT_EQ(lines_with(said_during(write_some), "pictures are written again"), 1);
  EXPECT_EQ(lines_with(said_during(fail), "frames go on"), 1);
}

TEST(PictureFailures, OfADisplayAreToldOfEachTime) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  const fs::path shown = folder.path() / "shown";
  display::PictureWriter writer(shown);
  expect_both_times_told(shown, [&](std::uint64_t number) {
    proto::Image what = display::image_of(number, 0, 1);
    what.set_buffer(proto::COLOR);
    what.set_format(proto::RGBA8);
    display::ShownFrame frame{number, {{}}, 1};
    frame.modules[0].image[proto::COLOR] = std::make_shared<const display::ReceivedImage>(
        display::ReceivedImage{std::move(what), display::pixel_of(number, 0)});
    writer.write(std::move(frame));
    while (!writer.take_written()) std::this_thread::sleep_for(1ms);
  });
  EXPECT_EQ(writer.failed_images(), 6u);
}

TEST(PictureFailures, OfANodesFilesAreToldOfEachTime) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  const fs::path frames = folder.path() / "frames";
  node::FileSink sink(frames);
  expect_both_times_told(frames, [&](std::uint64_t number) {
    // Two may wait and one is being written: once the fourth is taken, the first is done.
    for (std::uint32_t module = 0; module < 4; ++module) {
      node::OutgoingImage image;
      image.header = display::image_of(number, module, 1);
      image.header.set_buffer(proto::COLOR);
      image.header.set_format(proto::RGBA8);
      image.payload = display::pixel_of(number, module);
      while (!sink.put({image})) std::this_thread::sleep_for(1ms);
    }
    const bool works = !fs::is_regular_file(frames);
    while (works && !fs::exists(image_path(frames, number, 3, proto::COLOR))) std::this_thread::sleep_for(1ms);
  });
}

}  // namespace
}  // namespace lfd
