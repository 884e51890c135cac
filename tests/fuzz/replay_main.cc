// Runs a fuzz target over the files of its corpus, where no fuzzer is built in: a crash fails the test.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <vector>

#include "base/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const auto& path : files) {
    const auto content = lfd::read_file(path);
    if (!content) {
      std::cerr << content.error().message() << "\n";
      return 1;
    }
    std::cout << path.string() << std::endl;  // before the run: the last line names what crashed
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content->data()), content->size());
  }
  std::cout << files.size() << " files\n";
  return files.empty() ? 1 : 0;
}
