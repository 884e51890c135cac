// The table as text and as CSV.
#include <algorithm>

#include "base/log.h"
#include "bench/common/csv.h"
#include "bench/stream/stream_bench.h"

namespace lfd::bench {
namespace {

std::string spread_text(const Spread& spread) {
  return fmt::format("{:.2f} ({:.2f}..{:.2f})", spread.median, spread.percent_5, spread.percent_95);
}

std::string throughput_text(const StreamTable& table) {
  if (table.throughput.empty()) return "";
  std::string text =
      fmt::format("\n{:<14} {:>6} {:>22} {:>22} {:>22} {:>22}\n", "message bytes", "images", "channel GB/s (5..95 %)",
                  "library GB/s (5..95 %)", "ratio (5..95 %)", "with keys GB/s (5..95)");
  for (const ThroughputRow& row : table.throughput) {
    text += fmt::format("{:<14} {:>6} {:>22} {:>22} {:>22} {:>22}\n", row.image_bytes, row.images,
                        spread_text(row.channel_gb_s), spread_text(row.library_gb_s), spread_text(row.ratio),
                        spread_text(row.keyed_gb_s));
  }
  const std::string missed = missed_bound(table);
  return text + (missed.empty() ? fmt::format("kept: at least {} of what the message library alone reaches\n",
                                              kLeastThroughputRatio)
                                : "missed: " + missed + "\n");
}

}  // namespace

std::string missed_bound(const StreamTable& table) {
  for (const ThroughputRow& row : table.throughput) {
    if (row.ratio.median >= kLeastThroughputRatio) continue;
    return fmt::format("messages of {} bytes: {:.2f} of what the message library alone reaches; at least {} is wanted",
                       row.image_bytes, row.ratio.median, kLeastThroughputRatio);
  }
  return "";
}

std::string text_of(const StreamTable& table) {
  std::string text = fmt::format("display {}, {} x {} px, modules {}\n{}, lfd {}\n", table.display, table.image.width,
                                 table.image.height, fmt::join(table.modules, ", "), table.renderer, table.version);
  for (const std::string& scene : table.scenes()) {
    text += fmt::format("\n{:<32} {:<10} {:>9} {:>10} {:>8} {:>10} {:>10} {:>9}\n", scene, "codec", "images",
                        "KiB/image", "ratio", "encode ms", "decode ms", "PSNR dB");
    for (const CodecRow& row : table.rows) {
      if (row.scene != scene) continue;
      text +=
          fmt::format("{:<32} {:<10} {:>9} {:>10.1f} {:>8.2f} {:>10.2f} {:>10.2f} {:>9}\n", row.buffer, row.codec,
                      row.images, static_cast<double>(row.bytes) / row.images / 1024, row.ratio(), row.encode_ms.median,
                      row.decode_ms.median, row.psnr_db ? fmt::format("{:.1f}", *row.psnr_db) : "lossless");
    }
  }
  return text + throughput_text(table);
}

std::string csv_of(const StreamTable& table) {
  std::string csv =
      "scene,buffer,codec,images,pixel_bytes,bytes,ratio,encode_ms,encode_ms_5_percent,encode_ms_95_percent,decode_ms,"
      "decode_ms_5_percent,decode_ms_95_percent,psnr_db\n";
  for (const CodecRow& row : table.rows) {
    csv += fmt::format("{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", csv_cell(row.scene),
                       row.buffer, row.codec, row.images, row.pixel_bytes, row.bytes, row.ratio(), row.encode_ms.median,
                       row.encode_ms.percent_5, row.encode_ms.percent_95, row.decode_ms.median, row.decode_ms.percent_5,
                       row.decode_ms.percent_95, row.psnr_db ? fmt::format("{:.3f}", *row.psnr_db) : "");
  }
  csv += "\nmessage_bytes,images,channel_gb_s,library_gb_s,ratio,ratio_5_percent,ratio_95_percent,keyed_gb_s\n";
  for (const ThroughputRow& row : table.throughput) {
    csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", row.image_bytes, row.images,
                       row.channel_gb_s.median, row.library_gb_s.median, row.ratio.median, row.ratio.percent_5,
                       row.ratio.percent_95, row.keyed_gb_s.median);
  }
  return csv;
}

}  // namespace lfd::bench
