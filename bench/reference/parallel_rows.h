// Rows of an image or of a table, worked on by every core; what a row computes must not depend on other rows.
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace lfd::reference {

// Calls work(row) once for each row 0 .. rows - 1, from several threads, in no order. Returns when all are done.
template <class Work>
void for_each_row(int rows, const Work& work) {
  std::atomic<int> next{0};
  const auto take_rows = [&] {
    for (int row = next++; row < rows; row = next++) work(row);
  };
  const unsigned helpers = std::max(1U, std::thread::hardware_concurrency()) - 1;
  std::vector<std::jthread> threads;
  for (unsigned i = 0; i < helpers; ++i) threads.emplace_back(take_rows);
  take_rows();
}

}  // namespace lfd::reference
