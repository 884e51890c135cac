// The parts of `lfd bench` that stand in files of their own.
#pragma once

namespace CLI {
class App;
}

namespace lfd {

// For signals: nothing is left behind that would have to be tidied up, and frames cannot be interrupted otherwise.
// Exits with 1.
void end_bench_by_signal(int);

void add_bench_ao(CLI::App& bench, int& exit_code);
void add_bench_cluster(CLI::App& bench, int& exit_code);
void add_bench_soak(CLI::App& bench, int& exit_code);
void add_bench_stream(CLI::App& bench, int& exit_code);

}  // namespace lfd
