// Runs a fuzz target over the files of its corpus, where no fuzzer is built in: a crash, a hang and a wish for absurd
// memory fail the test.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <string_view>
#include <vector>

#include "base/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr rlim_t kMemoryLimit_bytes = rlim_t{2} << 30;
constexpr std::size_t kAllocationLimit_bytes = std::size_t{1} << 30;  // as -malloc_limit_mb of the fuzzers
constexpr unsigned kFileLimit_s = 20;  // as their -timeout: for a loaded machine; all take milliseconds

}  // namespace

// An allocation that is refused could be caught, and the file be called damaged: here it ends the test.
void* operator new(std::size_t size) {
  if (size > kAllocationLimit_bytes) {
    std::cerr << "wants " << size << " bytes at once" << std::endl;
    std::abort();
  }
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

int main(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "--help";
  if (first == "--help" || first == "-h" || first == "-help=1") {
    std::cout << "Runs a fuzz target over every file of the folders given, where no fuzzer is built in.\n"
                 "Usage: "
              << argv[0] << " FOLDER...\n"
              << "Exit codes: 0 done, 1 a file cannot be read or there is none, a signal where the target crashed.\n"
                 "The `fuzz` preset (clang) makes a libFuzzer program of the same name: see its -help=1.\n";
    return argc > 1 ? 0 : 2;
  }
  const rlimit limit{kMemoryLimit_bytes, kMemoryLimit_bytes};
  if (setrlimit(RLIMIT_AS, &limit) != 0) return 1;
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
    alarm(kFileLimit_s);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(content->data()), content->size());
  }
  std::cout << files.size() << " files\n";
  return files.empty() ? 1 : 0;
}
