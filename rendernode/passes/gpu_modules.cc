// Module parameters and pixel tables.
#include "rendernode/passes/gpu_modules.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <thread>

#include "calibration/curved_screen.h"
#include "rendernode/geometry/clip_map.h"

namespace lfd {
namespace {

using glm::vec4;

vec4 row_of(const glm::dmat3& m, int row, double w = 0) { return {m[0][row], m[1][row], m[2][row], w}; }

// The same homography with entries of at most 1, which single precision holds.
glm::dmat3 of_unit_size(const glm::dmat3& h) {
  double largest = 0;
  for (int column = 0; column < 3; ++column) {
    const glm::dvec3 sizes = glm::abs(h[column]);
    largest = std::max({largest, sizes.x, sizes.y, sizes.z});
  }
  return h / largest;
}

void fill_homography(shared::ModuleParams& params, const glm::dmat3& any_scale) {
  const glm::dmat3 image_from_screen = of_unit_size(any_scale);
  const glm::dmat3 inverse = of_unit_size(glm::inverse(image_from_screen));
  params.image_from_screen_0 = row_of(image_from_screen, 0);
  params.image_from_screen_1 = row_of(image_from_screen, 1);
  params.image_from_screen_2 = row_of(image_from_screen, 2);
  params.screen_from_image_0 = row_of(inverse, 0);
  params.screen_from_image_1 = row_of(inverse, 1);
  params.screen_from_image_2 = row_of(inverse, 2);
}

void fill_pinhole(shared::ModuleParams& params, const PinholeMap& map) {
  const glm::dmat3 rotation = module_from_physical_rotation(map);
  const glm::dvec3 offset = -(rotation * to_glm(map.position));
  params.pinhole_0 = row_of(rotation, 0, offset.x);
  params.pinhole_1 = row_of(rotation, 1, offset.y);
  params.pinhole_2 = row_of(rotation, 2, offset.z);
  params.focal_principal = {map.focal_u_px, map.focal_v_px, map.principal_u_px, map.principal_v_px};
  const double limit = std::min(distortion_limit(map), 1e9);
  params.distortion = {map.k1, map.k2, map.k3, limit * limit};
  params.tangential = {map.p1, map.p2, 0, 0};
}

void fill_table(shared::ModuleParams& params, const WarpTable& table, int layer) {
  fill_homography(params, table.image_from_screen);
  params.pinhole_0 = {table.low.x, table.low.y, 1 / table.cell.x, 1 / table.cell.y};
  params.pinhole_1 = {table.columns, table.rows, layer, 0};
}

// One layer of an array texture of two floats a texel.
void upload_layer(const gl::Texture& texture, std::size_t layer, int width, int height, const void* texels) {
  glTextureSubImage3D(texture.name(), 0, 0, 0, static_cast<GLint>(layer), width, height, 1, GL_RG, GL_FLOAT, texels);
}

// Whether pixels get their screen point from a table: where the inverse has no closed form.
bool needs_pixel_table(const ModuleCalibration& module) {
  return std::holds_alternative<PinholeMap>(module.map) || std::holds_alternative<GridMap>(module.map);
}

gl::Flags map_flags(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules) {
  gl::Flags flags;
  if (display.optics.screen_radius_m == 0) flags.emplace_back("PLANAR_SCREEN");
  if (display.optics.diffuser == Diffuser::kLinear) flags.emplace_back("LINEAR_DIFFUSER");
  const auto is_pinhole = [&](auto k) { return std::holds_alternative<PinholeMap>(display.modules[k].map); };
  if (std::ranges::none_of(modules, is_pinhole)) flags.emplace_back("NO_PINHOLE");
  return flags;
}

void fill_rows(const DisplayCalibration& display, const ModuleCalibration& module, int first, int last, float* out) {
  constexpr float kNowhere = 1e30F;
  for (int row = first; row < last; ++row) {
    for (int column = 0; column < display.image.width; ++column) {
      const auto s = screen_from_image(display, module, centre_of({column, row}));
      float* texel = out + 2 * (static_cast<std::size_t>(row) * display.image.width + column);
      texel[0] = s ? static_cast<float>(s->x) : kNowhere;
      texel[1] = s ? static_cast<float>(s->y) : kNowhere;
    }
  }
}

}  // namespace

shared::ModuleParams module_params(const DisplayCalibration& display, const ModuleCalibration& module,
                                   const WarpTable* warp, TableLayers layers) {
  shared::ModuleParams params{};
  const Optics& optics = display.optics;
  const auto* pinhole = std::get_if<PinholeMap>(&module.map);
  const int kind = pinhole != nullptr ? 1 : warp != nullptr ? 2 : 0;
  params.emitter = {module.emitter.x, module.emitter.y, module.emitter.z, kind};
  params.observer = {optics.observer_height_m, optics.observer_distance_m,
                     optics.diffuser == Diffuser::kConical ? 1 : 0, layers.pixels};
  params.screen = {display.screen.width_m, display.screen.height_m, display.image.width, display.image.height};
  if (optics.screen_radius_m != 0) {
    const double level = CurvedScreen(optics.screen_radius_m).level({0, optics.observer_distance_m});
    params.surface = {1 / optics.screen_radius_m, optics.observer_arc ? level : 0, 0, 0};
  }
  if (pinhole != nullptr) {
    fill_pinhole(params, *pinhole);
  } else if (warp != nullptr) {
    fill_table(params, *warp, layers.warp);
  } else if (const auto* homography = std::get_if<HomographyMap>(&module.map)) {
    fill_homography(params, homography->image_from_screen);
  } else {
    fill_homography(params, ideal_homography(display.screen, display.image));
  }
  return params;
}

std::vector<float> pixel_table(const DisplayCalibration& display, const ModuleCalibration& module) {
  std::vector<float> table(2 * static_cast<std::size_t>(display.image.width) * display.image.height);
  const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<std::jthread> threads;
  for (int i = 0; i < workers; ++i) {
    const int first = display.image.height * i / workers, last = display.image.height * (i + 1) / workers;
    threads.emplace_back([&, first, last] { fill_rows(display, module, first, last, table.data()); });
  }
  threads.clear();
  return table;
}

GpuModules upload_modules(const DisplayCalibration& display, const std::vector<std::uint32_t>& modules,
                          const WarpTables& tables, GuardBand band) {
  std::vector<shared::ModuleParams> params;
  std::vector<std::uint32_t> with_pixels;
  std::vector<const WarpTable*> warps;
  for (std::size_t i = 0; i < modules.size(); ++i) {
    const ModuleCalibration& module = display.modules[modules[i]];
    const WarpTable* warp = tables.of_module[i] ? &*tables.of_module[i] : nullptr;
    TableLayers layers;
    if (needs_pixel_table(module)) {
      layers.pixels = static_cast<int>(with_pixels.size());
      with_pixels.push_back(modules[i]);
    }
    if (warp != nullptr) {
      layers.warp = static_cast<int>(warps.size());
      warps.push_back(warp);
    }
    params.push_back(module_params(display, module, warp, layers));
    params.back().tangential.z = static_cast<float>(modules[i]);  // noise is the module's own, whichever node draws it
    params.back().tangential.w = static_cast<float>(band.px);
    params.back().surface.z = static_cast<float>(band.screen.width_m);
    params.back().surface.w = static_cast<float>(band.screen.height_m);
  }
  params.resize(MODULES_PER_NODE);
  GpuModules gpu{gl::make_buffer(params),         {},      {},
                 upload_colors(display, modules), band.px, map_flags(display, modules)};
  if (!with_pixels.empty()) {
    gpu.pixel_tables = gl::make_array_texture(GL_RG32F, display.image, static_cast<int>(with_pixels.size()));
  }
  for (std::size_t layer = 0; layer < with_pixels.size(); ++layer) {
    const auto table = pixel_table(display, display.modules[with_pixels[layer]]);
    upload_layer(gpu.pixel_tables, layer, display.image.width, display.image.height, table.data());
  }
  if (warps.empty()) return gpu;
  const ImageSize size{warps.front()->columns, warps.front()->rows};
  gpu.warp_tables = gl::make_array_texture(GL_RG32F, size, static_cast<int>(warps.size()));
  for (std::size_t layer = 0; layer < warps.size(); ++layer) {
    upload_layer(gpu.warp_tables, layer, size.width, size.height, warps[layer]->residual_px.data());
  }
  return gpu;
}

}  // namespace lfd
