// lfd bench stream: what encodings of images lose and take, and the throughput of the images channel.
#include <signal.h>

#include <iostream>
#include <memory>

#include "base/command_line.h"
#include "base/file.h"
#include "bench/stream/stream_bench.h"
#include "cli/lfd_bench.h"
#include "cli/lfd_commands.h"

namespace lfd {
namespace {

struct StreamArguments {
  bench::StreamBenchOptions options;
  std::string display;  // a file instead of the deployment's; may be empty
  int round_mib = 2048;
  std::filesystem::path out;
};

Status write_results(const std::filesystem::path& folder, const bench::StreamTable& table) {
  LFD_TRY_STATUS(write_file(folder / "stream.txt", bench::text_of(table)));
  LFD_TRY_STATUS(write_file(folder / "stream.csv", bench::csv_of(table)));
  for (const std::string& scene : table.scenes()) {
    const std::string stem = scene.substr(0, scene.find_first_of(". "));
    LFD_TRY_STATUS(write_file(folder / ("stream-" + stem + ".svg"), bench::svg_of(table, scene)));
  }
  return {};
}

int bench_stream(StreamArguments& a) {
  if (!a.display.empty()) a.options.overrides.display = a.display;
  a.options.throughput.round_bytes = static_cast<std::size_t>(a.round_mib) << 20;
  if (a.options.throughput.rounds == 0) a.options.throughput.image_bytes.clear();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, end_bench_by_signal);
  if (!a.out.empty()) {
    if (const Status folder = make_folder(a.out); !folder) return fail(folder.error());
  }
  const auto table = bench::stream_bench(a.options);
  if (!table) return fail(table.error());
  std::cout << bench::text_of(*table);
  if (!a.out.empty()) {
    if (const Status written = write_results(a.out, *table); !written) return fail(written.error());
  }
  const int printed = end_of_output();
  return bench::missed_bound(*table).empty() ? printed : kExitFailed;
}

}  // namespace

void add_bench_stream(CLI::App& bench, int& exit_code) {
  auto arguments = std::make_shared<StreamArguments>();
  StreamArguments& a = *arguments;
  CLI::App* stream = add_command(
      bench, "stream",
      "Encodings of module images: error against run time and bytes; and how much of the message library's throughput "
      "the images channel keeps (exit code 1 below four fifths)",
      exit_code, [arguments] { return bench_stream(*arguments); });
  stream->add_option("DEPLOYMENT", a.options.deployment, "Deployment file (*.textproto)")->required();
  stream->add_option("--out", a.out, "Folder for stream.txt, stream.csv and stream-SCENE.svg");
  stream
      ->add_option("--scene", a.options.scenes,
                   "Show these glTF files, one after the other, instead of the deployment's scene")
      ->delimiter(',')
      ->allow_extra_args(false);
  stream->add_option("--display", a.display, "Use this calibration file instead of the deployment's");
  stream
      ->add_option("--module", a.options.modules,
                   "Numbers of modules (default: the middle one, the first and the last)")
      ->delimiter(',')
      ->allow_extra_args(false);
  stream->add_option("--repeats", a.options.repeats, "How often each image is encoded; what is slow, less often")
      ->check(whole_number_within(1, 1000))
      ->capture_default_str();
  stream->add_option("--rounds", a.options.throughput.rounds, "Rounds of throughput, in turn; 0: none")
      ->check(whole_number_within(0, 1000))
      ->capture_default_str();
  stream->add_option("--round-mib", a.round_mib, "What travels in each of them")
      ->check(whole_number_within(1, 1 << 20))
      ->capture_default_str();
  stream->add_option("--gpu", a.options.gpu, "Number in lfd-rendernode --list-gpus (default: the first that works)");
}

}  // namespace lfd
