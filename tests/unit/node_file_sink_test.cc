// The sink that writes a node's images itself: what was taken is written, but no end waits for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/temporary_folder.h"
#include "rendernode/node/file_sink.h"

namespace lfd::node {
namespace {

std::vector<OutgoingImage> images(std::uint64_t frame, std::uint32_t count, std::uint32_t side) {
  std::vector<OutgoingImage> made;
  std::string pixels(std::size_t{16} * side * side, '\0');
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<char>(i * 2654435761U >> 13U);  // hard to pack
  const auto bytes = std::make_shared<const std::string>(std::move(pixels));
  for (std::uint32_t module = 0; module < count; ++module) {
    OutgoingImage image;
    image.header.set_frame(frame);
    image.header.set_module(module);
    image.header.set_buffer(proto::POSITION);
    image.header.set_format(proto::RGBA32F);
    image.header.set_width_px(side);
    image.header.set_height_px(side);
    image.payload = wire::Payload(bytes);
    made.push_back(std::move(image));
  }
  return made;
}

std::ptrdiff_t files_below(const std::filesystem::path& folder) {
  const std::filesystem::recursive_directory_iterator all(folder);
  return std::count_if(begin(all), end(all), [](const auto& entry) { return entry.is_regular_file(); });
}

TEST(FileSink, WritesWhatItHasTaken) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  {
    FileSink sink(folder.path());
    EXPECT_TRUE(sink.put(images(0, 3, 4)));
  }
  EXPECT_EQ(files_below(folder.path()), 3);
}

// Hundreds of megabytes of pictures would take many seconds; a node has two to end.
TEST(FileSink, EndsBeforeItHasWrittenEverything) {
  const TemporaryFolder folder = *TemporaryFolder::make("lfd-test");
  Clock::time_point end;
  {
    FileSink sink(folder.path());
    EXPECT_TRUE(sink.put(images(0, 150, 512)));
    EXPECT_TRUE(sink.put(images(1, 150, 512)));
    end = Clock::now();
  }
  EXPECT_LT(Clock::now() - end, std::chrono::seconds(2));  // the bound of the node's clean stop
  EXPECT_LT(files_below(folder.path()), 300);
}

}  // namespace
}  // namespace lfd::node
