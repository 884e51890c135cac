// Rays, or the file that they were kept in.
#include "bench/ao/reference_picture.h"

#include <cmath>
#include <cstdlib>

#include "base/clock.h"
#include "base/hash.h"
#include "base/log.h"
#include "bench/ao/planes_file.h"
#include "bench/reference/ray_occlusion.h"
#include "bench/reference/silhouette.h"

namespace lfd::bench {
namespace {

constexpr int kCastBy = 1;  // to be raised when bench/reference answers otherwise

std::string key_of(const ShownScene& scene, std::uint32_t module, const std::vector<double>& radius_m, int rays) {
  std::string key = fmt::format("rays of {} module {} by {}: {} rays, scene {}, radii", scene.name(), module, kCastBy,
                                rays, scene.hash());
  for (const double radius : radius_m) key += fmt::format(" {}", radius);
  return key;
}

Openness openness_of(const reference::RayOcclusionImage& image, const std::vector<float>& hidden, std::size_t radius) {
  Openness open{image.size, std::vector<float>(hidden.size() / image.radii)};
  for (std::size_t pixel = 0; pixel < open.value.size(); ++pixel) {
    const float ao = hidden[pixel * image.radii + radius];
    open.value[pixel] = ao < 0 ? -1.0F : 1 - std::min(ao, 1.0F);
  }
  return open;
}

Planes cast(const ShownScene& scene, std::uint32_t module, const reference::HitImage& hits,
            const std::vector<double>& radius_m, int rays, std::string key) {
  const auto view = scene.view(module);
  const auto image = reference::ray_occlusion_of_module(scene.intersector(), view, hits, radius_m, {rays, 1});
  Planes planes{std::move(key), {}, {}};
  for (std::size_t k = 0; k < radius_m.size(); ++k) planes.pictures.push_back(openness_of(image, image.cosine, k));
  for (std::size_t k = 0; k < radius_m.size(); ++k) planes.pictures.push_back(openness_of(image, image.uniform, k));
  const auto near = reference::near_silhouette(scene.intersector(), view, hits);
  planes.pictures.push_back({hits.size, std::vector<float>(near.begin(), near.end())});
  return planes;
}

}  // namespace

Result<ReferencePicture> reference_picture(const ShownScene& scene, std::uint32_t module,
                                           const reference::HitImage& hits, const std::vector<double>& radius_m,
                                           int rays, const std::filesystem::path& cache) {
  const std::string key = key_of(scene, module, radius_m, rays);
  const std::filesystem::path file = cache / fmt::format("rays-{}.planes", content_hash(key));
  ReferencePicture picture{radius_m, {}, {}, {}, 0};
  auto planes = read_planes(file, key);
  if (!planes) {
    log::info("{}, module {}: casting {} rays for every pixel", scene.name(), module, rays);
    const auto start = Clock::now();
    planes = cast(scene, module, hits, radius_m, rays, key);
    planes->note = fmt::format("{:.0f} ms", milliseconds(Clock::now() - start));
    LFD_TRY_STATUS(write_planes(file, *planes));
    planes = read_planes(file, key);  // rounded as in every later run
    if (!planes) return Error(fmt::format("{}: written, but not to be read", file.string()));
  }
  picture.cast_ms = std::strtod(planes->note.c_str(), nullptr);
  const auto split = static_cast<std::ptrdiff_t>(radius_m.size());
  picture.cosine.assign(planes->pictures.begin(), planes->pictures.begin() + split);
  picture.uniform.assign(planes->pictures.begin() + split, planes->pictures.begin() + 2 * split);
  picture.silhouette = planes->pictures.back();
  return picture;
}

}  // namespace lfd::bench
