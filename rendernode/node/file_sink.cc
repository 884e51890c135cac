// Writing on a thread of its own.
#include "rendernode/node/file_sink.h"

#include <chrono>

#include "base/log.h"
#include "proto/frame_files.h"

namespace lfd::node {

FileSink::~FileSink() { frames_.close(); }

void FileSink::work() {
  while (true) {
    auto images = frames_.take_within(std::chrono::seconds(1));
    if (!images && frames_.closed()) return;
    if (!images) continue;
    for (const auto& image : *images) {
      const auto path = image_path(folder_, image.header.frame(), image.header.module(), image.header.buffer());
      const Status written = write_image_file(path, image.header, image.payload.text());
      if (written) continue;
      const std::string& message = written.error().message();
      if (!causes_.insert(message.substr(message.rfind(": ") + 1)).second) continue;
      log::error("{}; frames go on, further pictures that fail for this reason are not named", message);
    }
  }
}

}  // namespace lfd::node
