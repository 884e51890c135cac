// Module images of a drawn frame through every encoding, one after the other on one thread.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/log.h"
#include "bench/common/built_commit.h"
#include "bench/common/shown_scene.h"
#include "bench/reference/psnr.h"
#include "bench/stream/stream_bench.h"
#include "proto/images/image_payload.h"
#include "rendernode/renderer.h"

namespace lfd::bench {
namespace {

// An image whose encoding takes long is not measured more often than this says.
constexpr double kMostPerImage_ms = 3000;

struct Codec {
  std::string name;
  proto::Stream stream;
};

std::vector<Codec> codecs_of(proto::BufferKind buffer) {
  std::vector<Codec> codecs{{"raw", {}}};
  for (const int level : {1, 3, 9, 19}) {
    Codec& codec = codecs.emplace_back(Codec{fmt::format("zstd {}", level), {}});
    codec.stream.set_codec(proto::ZSTD_IMAGES);
    codec.stream.set_level(level);
  }
  if (buffer != proto::COLOR) return codecs;
  for (const int quality : {50, 75, 90, 95, 100}) {
    Codec& codec = codecs.emplace_back(Codec{fmt::format("jpeg {}", quality), {}});
    codec.stream.set_codec(proto::JPEG_IMAGES);
    codec.stream.set_quality(quality);
  }
  return codecs;
}

struct Image {
  proto::Image header;
  wire::Payload pixels;
};

// The images that are not empty, of one buffer.
std::vector<Image> images_of(const FrameResult& frame, proto::BufferKind buffer) {
  std::vector<Image> images;
  for (const ModuleImage& one : frame.images) {
    if (one.kind != buffer || one.empty) continue;
    Image& image = images.emplace_back();
    image.header.set_module(one.module);
    image.header.set_buffer(one.kind);
    image.header.set_format(one.kind == proto::COLOR ? proto::RGBA8 : proto::RGBA32F);
    image.header.set_width_px(static_cast<std::uint32_t>(one.size.width));
    image.header.set_height_px(static_cast<std::uint32_t>(one.size.height));
    image.pixels = one.bytes;
  }
  return images;
}

Picture8 picture_of(const proto::Image& what, std::string_view pixels) {
  Picture8 picture = black_picture(static_cast<int>(what.width_px()), static_cast<int>(what.height_px()));
  std::copy(pixels.begin(), pixels.end(), picture.rgba.begin());
  return picture;
}

Result<CodecRow> measure(const Codec& codec, const std::vector<Image>& images, int repeats) {
  CodecRow row;
  row.codec = codec.name;
  row.images = static_cast<int>(images.size());
  PayloadEncoder encoder;
  std::vector<double> encode_ms, decode_ms;
  double worst_db = std::numeric_limits<double>::infinity();
  for (const Image& image : images) {
    proto::Image what = image.header;
    double spent_ms = 0;
    for (int repeat = 0; repeat < repeats && spent_ms < kMostPerImage_ms; ++repeat) {
      const auto start = Clock::now();
      const auto encoded = encoder.encode(codec.stream, what, image.pixels);
      const auto between = Clock::now();
      what.set_encoding(encoded->encoding);
      LFD_TRY(const wire::Payload decoded, decode_payload(what, encoded->payload));
      const auto end = Clock::now();
      encode_ms.push_back(milliseconds(between - start));
      decode_ms.push_back(milliseconds(end - between));
      spent_ms += milliseconds(end - start);
      if (repeat > 0) continue;
      row.pixel_bytes += image.pixels.size();
      row.bytes += encoded->payload.size();
      if (encoded->encoding == proto::JPEG)
        worst_db = std::min(
            worst_db, reference::psnr_db(picture_of(what, image.pixels.text()), picture_of(what, decoded.text())));
      else if (decoded.text() != image.pixels.text())
        return Error(fmt::format("{}: module {} does not come back as it was", codec.name, what.module()));
    }
  }
  if (std::isfinite(worst_db)) row.psnr_db = worst_db;
  row.encode_ms = spread_of(std::move(encode_ms));
  row.decode_ms = spread_of(std::move(decode_ms));
  return row;
}

Result<std::vector<std::uint32_t>> chosen_modules(const StreamBenchOptions& options, std::size_t count) {
  for (const std::uint32_t module : options.modules) {
    if (module >= count) return Error(fmt::format("module {}: the display has {}", module, count));
  }
  if (!options.modules.empty()) return options.modules;
  std::vector<std::uint32_t> modules{static_cast<std::uint32_t>(count / 2)};
  for (const std::size_t outermost : {std::size_t{0}, count - 1}) {
    const auto module = static_cast<std::uint32_t>(outermost);
    if (std::ranges::find(modules, module) == modules.end()) modules.push_back(module);
  }
  return modules;
}

Result<FrameResult> drawn(const gl::Context& context, const Deployment& deployment,
                          const std::vector<std::uint32_t>& modules) {
  log::info("drawing {}", shown_scene_name(deployment));
  LFD_TRY(const LoadedScene loaded, load_shown_scene(deployment));
  LFD_TRY(const RegionOfInterest roi,
          complete_roi(deployment.message.roi(), loaded.data.scene, deployment.display.screen));
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = loaded.data.scene;
  *state.mutable_roi() = write_roi(roi);
  *state.mutable_render() = deployment.message.render();
  Renderer renderer(context, deployment.display, modules);
  LFD_TRY_STATUS(renderer.set_state(state, loaded.data.assets));
  FrameOptions options;
  options.buffers.bits = 1U << proto::POSITION | 1U << proto::DEPTH;
  LFD_TRY_STATUS(renderer.draw(options));
  return renderer.collect();
}

Status add_rows(StreamTable& table, const std::string& scene, const FrameResult& frame, int repeats) {
  for (const auto& [buffer, name] :
       {std::pair{proto::COLOR, "color"}, {proto::POSITION, "position"}, {proto::DEPTH, "depth"}}) {
    const std::vector<Image> images = images_of(frame, buffer);
    if (images.empty()) return Error(fmt::format("{}: no module sees anything of it", scene));
    for (const Codec& codec : codecs_of(buffer)) {
      log::info("{}: {}, {}", scene, name, codec.name);
      LFD_TRY(CodecRow row, measure(codec, images, repeats));
      row.scene = scene;
      row.buffer = name;
      table.rows.push_back(std::move(row));
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> StreamTable::scenes() const {
  std::vector<std::string> names;
  for (const CodecRow& row : rows) {
    if (std::ranges::find(names, row.scene) == names.end()) names.push_back(row.scene);
  }
  return names;
}

Result<StreamTable> codec_bench(const gl::Context& context, const StreamBenchOptions& options) {
  StreamTable table;
  table.version = built_version();
  std::vector<std::optional<std::filesystem::path>> scenes(options.scenes.begin(), options.scenes.end());
  if (scenes.empty()) scenes.push_back(options.overrides.scene);
  for (const auto& scene : scenes) {
    DeploymentOverrides overrides = options.overrides;
    overrides.scene = scene;
    LFD_TRY(const Deployment deployment, load_deployment(options.deployment, overrides));
    LFD_TRY(table.modules, chosen_modules(options, deployment.display.modules.size()));
    table.display = deployment.display.name;
    table.image = deployment.display.image;
    LFD_TRY(const FrameResult frame, drawn(context, deployment, table.modules));
    table.renderer = frame.report.renderer();
    LFD_TRY_STATUS(add_rows(table, shown_scene_name(deployment), frame, options.repeats));
  }
  return table;
}

Result<StreamTable> stream_bench(const StreamBenchOptions& options) {
  LFD_TRY(std::vector<ThroughputRow> throughput, measure_throughput(options.throughput));
  LFD_TRY(const std::unique_ptr<gl::Context> context, gl::Context::create(options.gpu));
  LFD_TRY(StreamTable table, codec_bench(*context, options));
  table.throughput = std::move(throughput);
  return table;
}

}  // namespace lfd::bench
