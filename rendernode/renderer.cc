// The state of a node's renderer, and its frames.
#include "rendernode/renderer.h"

#include <algorithm>
#include <iterator>

#include "base/hash.h"
#include "base/log.h"
#include "calibration/guard_band.h"
#include "proto/scene_numbers.h"
#include "proto/state.h"
#include "rendernode/gl/memory.h"

namespace lfd {
namespace {

// Of what the picture of every module depends on.
std::string hash_of_shared(const proto::State& state) {
  proto::State shared;
  *shared.mutable_roi() = state.roi();
  *shared.mutable_render() = state.render();
  *shared.mutable_scene()->mutable_material() = state.scene().material();
  *shared.mutable_scene()->mutable_light() = state.scene().light();
  return content_hash(shared.SerializeAsString());
}

// Of what is drawn, 0: none.
int guard_band_px(const RenderSettings& settings) {
  return settings.ao.enabled ? even_guard_band_px(settings.ao.guard_band_px) : 0;
}

void warn_of(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log::warn("{}", warning);
}

}  // namespace

Renderer::Renderer(const gl::Context& context, DisplayCalibration display, std::vector<std::uint32_t> modules)
    : display_(std::move(display)),
      modules_(std::move(modules)),
      description_(context.description()),
      is_software_(context.is_software()),
      targets_(display_.image, static_cast<int>(modules_.size())) {
  LFD_CHECK(modules_.size() <= MODULES_PER_NODE, "more modules than a node can have");
}

Status Renderer::set_state(const proto::State& state, const Assets& assets) {
  if (state_ && same_message(*state_, state)) return {};
  LFD_TRY_STATUS(rebuild(state, assets));
  // A new sequence number alone changes no picture.
  proto::State before = state_.value_or(proto::State());
  before.set_sequence(state.sequence());
  if (!state_ || !same_message(before, state)) state_changed_ = true;
  state_ = state;
  shared_inputs_ = hash_of_shared(state);
  return {};
}

// Everything is made first and moved in last, so that an error leaves the running state alone.
Status Renderer::rebuild(const proto::State& state, const Assets& assets) {
  const auto start = Clock::now();
  LFD_TRY(const RenderSettings settings, read_settings(state.render()));
  LFD_TRY(const RegionOfInterest roi, read_roi(state.roi()));
  LFD_TRY_STATUS(check_radius(settings.ao, roi));
  if (const Status numbers = check_numbers(state.scene()); !numbers) return numbers.error().within("scene");
  const bool first = !state_.has_value();
  const bool new_tables = first || settings.warp_level != settings_.warp_level;
  const int band_px = guard_band_px(settings);
  const bool new_band = first || new_tables || band_px != guard_band_px(settings_);
  const bool new_rule = new_band || settings.subdivision_px != settings_.subdivision_px ||
                        settings.near_z_m != settings_.near_z_m || settings.far_z_m != settings_.far_z_m;
  const bool new_geometry = new_rule || !(roi == roi_) || !same_instances(state.scene(), state_->scene());
  const bool new_materials =
      first || settings.unlit != settings_.unlit || !same_materials(state.scene(), state_->scene());

  std::unique_ptr<const DrawnModules> own, banded;
  if (new_tables) {
    LFD_TRY(own, draw_modules(display_, modules_, settings.warp_level, 0));
  }
  if (new_band && band_px > 0) {
    LFD_TRY(banded, draw_modules(display_, modules_, settings.warp_level, band_px));
  }
  DepthLimits limits = limits_;
  std::unique_ptr<EdgeRule> rule;
  if (new_rule) {
    const DrawnModules& largest = banded ? *banded : band_px > 0 ? *banded_ : own ? *own : *own_;
    limits = depth_limits(display_, settings);
    if (band_px > 0) limits = widened_to(limits, largest.display);
    rule = std::make_unique<EdgeRule>(largest.display, modules_, largest.tables, limits, settings.subdivision_px);
  }
  std::optional<PhysicalGeometry> geometry;
  if (new_geometry) {
    LFD_TRY(geometry,
            build_geometry(state.scene(), assets, meshes_, roi, limits, rule ? *rule : *rule_, most_triangles()));
  }
  GpuGeometry gpu_geometry;
  if (geometry) {
    gpu_geometry = upload_geometry(*geometry);
    LFD_TRY_STATUS(gl::memory_status(fmt::format("{} triangles", geometry->planes.size())));
  }
  std::optional<GpuMaterials> materials;
  if (new_materials) {
    LFD_TRY(materials, upload_materials(state.scene(), assets, settings.unlit));
    LFD_TRY_STATUS(gl::memory_status("the textures of the scene"));
  }
  std::erase_if(meshes_, [&](const auto& mesh) {
    return std::ranges::none_of(state.scene().instance(),
                                [&](const auto& instance) { return instance.mesh() == mesh.first; });
  });
  if (rule) rule_ = std::move(rule);
  if (own) {
    own_ = std::move(own);
    warn_of(own_->warnings);
  }
  if (new_band) {
    banded_ = std::move(banded);
    if (banded_) warn_of(banded_->warnings);
  }
  limits_ = limits;
  if (geometry) {
    geometry_ = std::move(*geometry);
    gpu_geometry_ = std::move(gpu_geometry);
  }
  if (materials) gpu_materials_ = std::move(*materials);
  gpu_lights_ = upload_lights(state.scene(), roi);
  settings_ = settings;
  roi_ = roi;
  geometry_ms_ += milliseconds(Clock::now() - start);
  if (const std::string why = why_nothing_is_seen(); new_geometry && !why.empty())
    log::warn("nothing of the scene is seen: {}", why);
  return {};
}

std::string Renderer::why_nothing_is_seen() const {
  if (geometry_.items.empty())
    return fmt::format("no triangle of it lies between z = {:.4g} and {:.4g} m", limits_.back, limits_.front);
  Point3<Physical> low = geometry_.items.front().low, high = geometry_.items.front().high;
  for (const GeometryItem& item : geometry_.items) {
    low = {std::min(low.x, item.low.x), std::min(low.y, item.low.y), low.z};
    high = {std::max(high.x, item.high.x), std::max(high.y, item.high.y), high.z};
  }
  const double pixel_m = display_.screen.width_m / display_.image.width;
  const double extent_m = std::max(high.x - low.x, high.y - low.y);
  return extent_m < pixel_m ? fmt::format("it is {:.2g} m wide, less than a pixel", extent_m) : "";
}

Status Renderer::draw(const FrameOptions& options) {
  LFD_CHECK(under_way_ < 2, "two frames are under way");
  if (!state_) return Error("there is no state to draw yet");
  Slot& slot = slots_[static_cast<std::size_t>(next_slot_)];
  const auto start = Clock::now();
  LFD_TRY_STATUS(choose_occlusion(options));
  slot.options = options;
  slot.roi = roi_;
  slot.ao = settings_.ao;
  slot.occlusion_choice = occlusion_choice_;
  slot.geometry_ms = std::exchange(geometry_ms_, 0);
  // Frames are collected in order: by then the images of the one that this repeats are there.
  slot.reused = options.reuse && settings_.plan && !state_changed_ && drawn_buffers_ == options.buffers;
  if (!slot.reused) {
    LFD_TRY(slot.plan, submit(options, slot.timers));
    LFD_TRY_STATUS(slot.readback.start(options.read_back ? wanted(slot) : std::vector<ReadbackItem>(), display_.image,
                                       {slot.plan.guard_band_px, slot.plan.guard_band_px}));
    drawn_buffers_.reset();
    drawn_inputs_.clear();
    if (options.read_back) {
      drawn_buffers_ = options.buffers;
      drawn_inputs_ = slot.plan.inputs;
    }
    state_changed_ = false;
  }
  slot.submit_ms = milliseconds(Clock::now() - start);
  next_slot_ = 1 - next_slot_;
  ++under_way_;
  return {};
}

FramePlan Renderer::plan(const FrameOptions& options) const {
  const bool may_reuse = options.reuse && drawn_buffers_ == options.buffers && !drawn_inputs_.empty();
  return plan_frame({&display_, &modules_, &geometry_.items, &gpu_materials_.facts, gpu_lights_.facts, settings_,
                     options.buffers, shared_inputs_, may_reuse ? &drawn_inputs_ : nullptr, is_software_,
                     banded_ ? &banded_->display : nullptr});
}

Result<FramePlan> Renderer::submit(const FrameOptions& options, PassTimers& timers) {
  FramePlan made = plan(options);
  const CommandList commands = make_commands(made, geometry_.items, gpu_materials_.facts, options.time_modules);
  const DrawnModules& drawn = made.guard_band_px > 0 ? *banded_ : *own_;
  if (targets_.size() != drawn.display.image) targets_ = Targets(drawn.display.image, targets_.layers());
  LFD_TRY_STATUS(passes_.submit(
      made, commands, {drawn.gpu, gpu_materials_, gpu_geometry_, gpu_lights_, roi_, settings_, limits_, drawn.display},
      targets_, timers));
  return made;
}

bool Renderer::finished(Clock::duration at_most) {
  LFD_CHECK(under_way_ > 0, "no frame is under way");
  Slot& oldest = slots_[static_cast<std::size_t>((next_slot_ + 2 - under_way_) % 2)];
  return oldest.reused || oldest.readback.finished(at_most);
}

FrameResult Renderer::collect() {
  LFD_CHECK(under_way_ > 0, "no frame is under way");
  Slot& slot = slots_[static_cast<std::size_t>((next_slot_ + 2 - under_way_) % 2)];
  FrameResult result;
  result.position_origin = position_origin(slot.roi);
  const auto start = Clock::now();
  if (slot.reused) {
    result.images = last_images_;
  } else {
    while (!slot.readback.finished(std::chrono::milliseconds(100))) {
    }
    if (slot.options.read_back) {
      result.images = images_of(slot);
      last_images_ = result.images;
    }
  }
  fill_report(slot, result.report);
  auto* readback = result.report.add_pass();
  readback->set_pass("readback");
  readback->set_cpu_ms(milliseconds(Clock::now() - start));
  --under_way_;
  return result;
}

}  // namespace lfd
