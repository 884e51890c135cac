// The decisions of a frame.
#include "rendernode/plan/frame_plan.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/hash.h"
#include "base/log.h"

namespace lfd {
namespace {

class Planner {
 public:
  explicit Planner(const PlanInputs& inputs) : in_(inputs), everything_(!inputs.settings.plan) {}

  FramePlan plan() {
    if (in_.settings.pattern.is_shown()) {
      choose_pattern();
    } else {
      choose_draws();
      choose_passes();
    }
    hash_inputs();
    if (in_.drawn != nullptr && !everything_) drop_unchanged();
    return std::move(plan_);
  }

 private:
  void leave_out(const char* what, const std::string& which, const char* why, std::uint64_t count = 1) {
    proto::LeftOut left;
    left.set_what(what);
    left.set_which(which);
    left.set_why(why);
    left.set_count(count);
    plan_.left_out.push_back(std::move(left));
  }

  // Every layer is drawn, if only black: what sinks make of empty images is the scene's background.
  void choose_pattern() {
    constexpr const char* kWhy = "a test pattern is shown";
    plan_.pattern = true;
    plan_.z_prepass = plan_.position = plan_.normal = plan_.ao = plan_.blur = plan_.post = false;
    plan_.inputs.resize(in_.modules->size());
    for (std::uint32_t layer = 0; layer < in_.modules->size(); ++layer) {
      plan_.active_layers.push_back(layer);
      if (in_.settings.pattern.is_shown_by(static_cast<int>((*in_.modules)[layer])))
        plan_.pattern_layers.push_back(layer);
    }
    if (!in_.items->empty()) leave_out("draw", "of every module", kWhy, in_.items->size() * in_.modules->size());
    for (const char* pass : {"z_prepass", "gbuffer", "ao", "blur", "post"}) leave_out("pass", pass, kWhy);
    for (const char* target : {"position", "normal"}) leave_out("target", target, kWhy);
    leave_out("correction", "colour", kWhy);
  }

  bool is_lit() const {
    return !in_.settings.unlit && std::ranges::any_of(*in_.items, [&](const GeometryItem& item) {
      return !(*in_.materials)[item.material].unlit;
    });
  }

  bool is_bent_possible() const { return in_.settings.ao.bent_normals && in_.settings.ao.method->directions; }
  bool reads_ao() const {
    return is_lit() || in_.buffers.has(proto::AO) || (is_bent_possible() && in_.buffers.has(proto::BENT_NORMAL));
  }

  // A guard band serves ambient occlusion that is read, and nothing else: even where everything is planned.
  bool has_guard_band() const { return in_.banded != nullptr && in_.settings.ao.enabled && reads_ao(); }

  // The items that a module draws; none where all that it sees of them lies in the guard band.
  std::vector<std::uint32_t> items_of(const ModuleCalibration& module, const ModuleCalibration* banded) const {
    std::vector<std::uint32_t> drawn;
    bool seen = everything_;
    for (std::uint32_t i = 0; i < in_.items->size(); ++i) {
      const GeometryItem& item = (*in_.items)[i];
      const bool is_seen = everything_ || may_be_seen(*in_.display, module, item.low, item.high);
      seen = seen || is_seen;
      if (is_seen || (banded != nullptr && may_be_seen(*in_.banded, *banded, item.low, item.high))) drawn.push_back(i);
    }
    return seen ? drawn : std::vector<std::uint32_t>();
  }

  void choose_draws() {
    const bool has_band = has_guard_band();
    std::map<std::pair<int, bool>, DrawGroup> groups;
    plan_.inputs.resize(in_.modules->size());
    for (std::uint32_t layer = 0; layer < in_.modules->size(); ++layer) {
      const std::uint32_t number = (*in_.modules)[layer];
      const ModuleCalibration& module = in_.display->modules[number];
      const auto drawn = items_of(module, has_band ? &in_.banded->modules[number] : nullptr);
      const bool seen = !drawn.empty();
      const std::uint64_t unseen = in_.items->size() - drawn.size();
      for (const std::uint32_t i : drawn) {
        const GeometryItem& item = (*in_.items)[i];
        plan_.inputs[layer] += item.content;
        const MaterialFacts& material = (*in_.materials)[item.material];
        DrawGroup& group = groups[{material.texture_group, material.alpha_mask}];
        group.texture_group = material.texture_group;
        group.alpha_mask = material.alpha_mask;
        group.draws.push_back({i, layer});
      }
      any_seen_ = any_seen_ || seen || everything_;
      plan_.color = plan_.color || module.color.has_value();
      if (seen || everything_ || module.color) {
        plan_.active_layers.push_back(layer);
      } else {
        leave_out("module", std::to_string(number), "no geometry in its view");
      }
      if (seen && unseen > 0)
        leave_out("draw", fmt::format("of module {}", number), "outside the module's view", unseen);
    }
    // Opaque groups before masked ones: they fill the depth that spares the others work.
    for (const bool masked : {false, true}) {
      for (auto& [key, group] : groups) {
        if (key.second == masked) plan_.groups.push_back(std::move(group));
      }
    }
  }

  void choose_passes() {
    const bool any = any_seen_;
    const bool lit = is_lit();
    const bool textured = std::ranges::any_of(
        *in_.items, [&](const GeometryItem& item) { return (*in_.materials)[item.material].texture_group >= 0; });
    if (!textured && any) leave_out("texture", "base colour", "no material has one");

    const bool ao_asked = in_.settings.ao.enabled;
    plan_.ao = ao_asked && (everything_ || (any && reads_ao()));
    if (!ao_asked) {
      leave_out("pass", "ao", "switched off");
    } else if (!plan_.ao) {
      leave_out("pass", "ao", any ? "every surface is unlit" : "no module sees geometry");
    }
    if (in_.settings.ao.guard_band_px > 0) choose_guard_band();
    plan_.upsample = plan_.ao && in_.settings.ao.half_resolution;
    choose_sharing();
    plan_.blur = plan_.ao && in_.settings.ao.blur_enabled;
    if (!plan_.blur) leave_out("pass", "blur", plan_.ao ? "switched off" : "there is no ambient occlusion to blur");

    const occlusion::Method& method = *in_.settings.ao.method;
    if (plan_.ao && method.pyramid != occlusion::Pyramid::kNone)
      plan_.pyramid_levels = static_cast<int>(in_.settings.ao.parameter("levels")) - 1;
    plan_.pyramid_factor = method.pyramid == occlusion::Pyramid::kAveraged ? 3 : 2;

    if (!plan_.color) leave_out("correction", "colour", "no module has a colour calibration");
    const bool lights = everything_ || (any && lit);
    plan_.post = lights || plan_.color;
    if (!plan_.post) leave_out("pass", "post", any ? "every surface is unlit" : "no module sees geometry");
    plan_.bent = plan_.ao && is_bent_possible() &&
                 (everything_ || in_.buffers.has(proto::BENT_NORMAL) || (lights && in_.lights.need_normal));
    if (plan_.ao && in_.settings.ao.bent_normals && !plan_.bent)
      leave_out("target", "bent normal", is_bent_possible() ? "nothing reads it" : "the method has no directions");
    plan_.position = everything_ || plan_.ao || in_.buffers.has(proto::POSITION) || in_.buffers.has(proto::DEPTH) ||
                     in_.buffers.has(proto::AO) || (lights && in_.lights.need_position);
    if (!plan_.position) leave_out("target", "position", "nothing reads it");
    plan_.normal = everything_ || in_.buffers.has(proto::NORMAL) || in_.buffers.has(proto::BENT_NORMAL) || plan_.bent ||
                   (lights && in_.lights.need_normal) || (plan_.ao && in_.settings.ao.method->normal) ||
                   plan_.upsample || plan_.share || (plan_.blur && in_.settings.ao.blur == AoBlur::kGeometry);
    if (!plan_.normal) leave_out("target", "normal", "nothing reads it");
    choose_prepass(any, textured);
  }

  void choose_guard_band() {
    if (plan_.ao && has_guard_band()) {
      plan_.guard_band_px = (in_.banded->image.width - in_.display->image.width) / 2;
    } else {
      leave_out("target", "guard band",
                !in_.settings.ao.enabled ? "there is no ambient occlusion that needs it"
                : !any_seen_             ? "no module sees geometry"
                                         : "nothing reads ambient occlusion");
    }
  }

  // Everything or not, the same modules share: one that sees nothing has nothing to tell.
  void choose_sharing() {
    if (!plan_.ao || in_.settings.ao.shared_neighbours == 0) return;
    std::vector<bool> sees;
    for (const std::uint32_t number : *in_.modules) {
      sees.push_back(std::ranges::any_of(*in_.items, [&](const GeometryItem& item) {
        return may_be_seen(*in_.display, in_.display->modules[number], item.low, item.high);
      }));
    }
    plan_.sharing = share_among(*in_.display, *in_.modules, sees, in_.settings.ao.shared_neighbours);
    plan_.share = everything_ || plan_.sharing.has_neighbours();
    if (plan_.share) return;
    leave_out("pass", "share",
              in_.modules->size() == 1 ? "the node has one module" : "no module has a neighbour that sees geometry");
  }

  // What a layer's picture shows beside its items is the same for all layers.
  void hash_inputs() {
    const std::string passes = fmt::format("{}{}{}{}{}{}{}{}{}{}{} {}", plan_.pattern, plan_.upsample, plan_.share,
                                           plan_.bent, plan_.pyramid_levels, plan_.position, plan_.normal, plan_.ao,
                                           plan_.blur, plan_.post, plan_.color, plan_.guard_band_px);
    for (std::string& items : plan_.inputs)
      items = content_hash(fmt::format("{}|{}|{}|{}", in_.shared, passes, in_.buffers.bits, items));
  }

  void drop_unchanged() {
    const auto is_unchanged = [&](std::uint32_t layer) { return (*in_.drawn)[layer] == plan_.inputs[layer]; };
    // A picture shows what its neighbours found, of which the blurred pictures in hand know no more.
    if (plan_.share && *in_.drawn != plan_.inputs) return;
    std::erase_if(plan_.active_layers, [&](std::uint32_t layer) {
      if (!is_unchanged(layer)) return false;
      plan_.unchanged_layers.push_back(layer);
      leave_out("module", std::to_string((*in_.modules)[layer]), "inputs unchanged since the last frame");
      return true;
    });
    for (DrawGroup& group : plan_.groups)
      std::erase_if(group.draws, [&](const DrawGroup::Draw& draw) { return is_unchanged(draw.layer); });
    std::erase_if(plan_.groups, [](const DrawGroup& group) { return group.draws.empty(); });
  }

  // The prepass pays where a hidden fragment would cost texture fetches. That is a rule for GPUs, which it has not been
  // measured on yet. Software rasterisers pay for the vertices twice: 7 % of a frame of Sponza, 24 % of the ribbed
  // shell, 48 % where nothing is textured (bench/results/frame-llvmpipe.md).
  void choose_prepass(bool any, bool textured) {
    plan_.z_prepass = everything_ || (any && textured && !in_.is_software);
    if (plan_.z_prepass) return;
    leave_out("pass", "z_prepass",
              !any        ? "no module sees geometry"
              : !textured ? "no texture is fetched: hidden fragments are cheap"
                          : "a software rasteriser pays more for vertices than for hidden fragments");
  }

  const PlanInputs& in_;
  const bool everything_;
  bool any_seen_ = false;  // a module sees geometry
  FramePlan plan_;
};

}  // namespace

FramePlan plan_frame(const PlanInputs& inputs) { return Planner(inputs).plan(); }

}  // namespace lfd
