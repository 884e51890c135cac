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
      const Status written = write_image_file(path, image.header, image.payload.text());
      if (written) continue;
      const std::string& message = written.error().message();
      if (!causes_.insert(message.substr(message.rfind(": ") + 1)).second) continue;
      log::error("{}; frames go on, further pictures that fail for this reason are not named", message);
    }
  }
  if (left_out > 0) log::warn("{} pictures are not written any more: the node ends", left_out);
}

}  // namespace lfd::node
