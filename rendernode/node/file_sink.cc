// Writing on a thread of its own.
#include "rendernode/node/file_sink.h"

#include <chrono>

#include "base/log.h"
#include "proto/frame_files.h"

namespace lfd::node {
namespace {

constexpr auto kLastWrites = std::chrono::milliseconds(500);

}  // namespace

FileSink::~FileSink() {
  give_up_at_ = Clock::now() + kLastWrites;
  frames_.close();
}

void FileSink::work() {
  std::size_t left_out = 0;
  while (true) {
    auto images = frames_.take_within(std::chrono::seconds(1));
    if (!images && frames_.closed()) break;
    if (!images) continue;
    for (const auto& image : *images) {
      if (Clock::now() > give_up_at_.load()) {
        ++left_out;
        continue;
      }
      const auto path = image_path(folder_, image.header.frame(), image.header.module(), image.header.buffer());
      note(write_image_file(path, image.header, image.payload.text()));
    }
  }
  if (left_out > 0) log::warn("{} pictures are not written any more: the node ends", left_out);
}

void FileSink::note(const Status& written) {
  if (written) {
    if (const auto missing = news_.worked(Clock::now())) log::info("pictures are written again; {} failed", *missing);
    return;
  }
  const std::string& message = written.error().message();
  if (!news_.failed(message.substr(message.rfind(": ") + 1), Clock::now())) return;  // without the path in front
  log::error("{}; frames go on, further pictures that fail for this reason are not named", message);
}

}  // namespace lfd::node
