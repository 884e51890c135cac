// Bad numbers in every field of scenes and of requests: refused by name, or a sound picture.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/hash.h"
#include "base/log.h"
#include "bench/common/frame_picture.h"
#include "bench/stability/drawing.h"
#include "bench/stability/frame_fault.h"
#include "bench/stability/groups.h"
#include "bench/stability/harmless.h"
#include "bench/stability/message_fields.h"
#include "bench/stability/tally.h"
#include "controller/stage.h"
#include "proto/pictures/png.h"

namespace lfd::bench {
namespace {

proto::Light light_of(proto::Light::Kind kind) {
  proto::Light light;
  light.set_kind(kind);
  for (const float part : {0.2F, 0.3F, 0.1F}) light.add_color(part);
  light.mutable_position()->set_x(0.05);
  light.mutable_position()->set_y(0.1);
  light.mutable_position()->set_z(0.3);
  light.mutable_direction()->set_y(-0.6);
  light.mutable_direction()->set_z(-0.8);
  light.set_range_m(2);
  light.set_inner_cone_rad(0.3);
  light.set_outer_cone_rad(0.9);
  return light;
}

// Adds a picture of 2 x 2 pixels to the scene's material, through a transform.
void add_texture(SceneData& data) {
  const auto file = encode_png({2, 2, std::vector<std::uint8_t>(16, 200)});
  LFD_CHECK(file, file.error().message());
  proto::Picture picture;
  picture.set_file(*file);
  const auto bytes = std::make_shared<const std::string>(picture.SerializeAsString());
  const std::string hash = content_hash(*bytes);
  data.assets[hash] = bytes;
  auto& material = *data.scene.mutable_material(0);
  material.set_alpha_cutoff(0.5);
  material.mutable_texture()->set_picture(hash);
  for (const float entry : {1.0F, 0.2F, 0.1F, 0.0F, 1.0F, 0.3F}) material.mutable_texture()->add_uv_transform(entry);
}

// A scene with every field that has a number. Its first light is ambient and stays as it is.
SceneData whole_scene() {
  SceneData data = sphere_in_box(small_roi());
  add_texture(data);
  for (const auto kind : {proto::Light::AMBIENT, proto::Light::DIRECTIONAL, proto::Light::POINT, proto::Light::SPOT})
    *data.scene.add_light() = light_of(kind);
  return data;
}

DisplayCalibration tiny_display() {
  DisplayCalibration display = small_display();
  display.image = {32, 24};
  return display;
}

proto::State state_with(const proto::Scene& scene) {
  proto::State state;
  state.set_sequence(1);
  *state.mutable_scene() = scene;
  *state.mutable_roi() = write_roi(small_roi());
  return state;
}

Result<FrameResult> drawn_once(Renderer& renderer, const proto::State& state, const Assets& assets) {
  LFD_TRY_STATUS(renderer.set_state(state, assets));
  BufferSet buffers;
  for (const auto kind : {proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH}) buffers.bits |= 1U << kind;
  LFD_TRY_STATUS(renderer.draw({.buffers = buffers, .reuse = false}));
  return renderer.collect();
}

const std::string& color_bytes(const FrameResult& frame) {
  const auto image = std::ranges::find(frame.images, proto::COLOR, &ModuleImage::kind);
  LFD_CHECK(image != frame.images.end() && image->bytes, "colour is always read back");
  return *image->bytes;
}

// Light adds up: no pixel may be darker than with the ambient light alone. One that is no number would be.
std::string darker_than(const FrameResult& least, const FrameResult& frame) {
  const std::string& floor = color_bytes(least);
  const std::string& color = color_bytes(frame);
  for (std::size_t i = 0; i < color.size(); ++i) {
    const int got = static_cast<unsigned char>(color[i]), dark = static_cast<unsigned char>(floor[i]);
    if (got + 1 < dark) return fmt::format("byte {} of the colours is {}, {} with less light", i, got, dark);
  }
  return "";
}

std::string harm_of_frame(const FrameResult& frame, const std::optional<FrameResult>& least) {
  const std::string fault = fault_of(frame);
  if (!fault.empty() || !least) return fault;
  return darker_than(*least, frame);
}

// All fields of one part of the scene: "light 2". Spoilt lights only add to the ambient one.
Outcome spoil_part(const gl::Context& context, const std::string& part) {
  const SceneData data = whole_scene();
  Renderer renderer(context, tiny_display(), {0});
  std::optional<FrameResult> least;
  if (part.starts_with("light")) {
    proto::Scene ambient = data.scene;
    ambient.mutable_light()->DeleteSubrange(1, ambient.light_size() - 1);
    auto frame = drawn_once(renderer, state_with(ambient), data.assets);
    if (!frame) return {"error: " + frame.error().message(), 0, false};
    least = *std::move(frame);
  }
  int refused = 0, drawn = 0;
  for (const NumberField& field : number_fields(data.scene)) {
    if (!field.road.starts_with(part)) continue;
    Tally tally(field.words);
    for (const auto& [value, message] : field.spoilt) {
      const int errors = gl::Context::error_count();
      const auto& scene = dynamic_cast<const proto::Scene&>(*message);
      const auto frame = drawn_once(renderer, state_with(scene), data.assets);
      frame ? tally.accepted(value, harm_of_frame(*frame, least)) : tally.refused(value, frame.error().message());
      ++(frame ? drawn : refused);
      if (gl::Context::error_count() != errors) tally.accepted(value, "GL reported an error");
    }
    const Outcome outcome = tally.outcome();
    if (!outcome.passed) return {field.road + ": " + outcome.got, 0, false};
  }
  return {fmt::format("{} refused, {} drawn", refused, drawn), 0, refused > 0 && drawn > 0};
}

Deployment deployment_of_requests() {
  Deployment deployment;
  deployment.display = tiny_display();
  return deployment;
}

// Requests of control clients, as the controller takes them: the state that comes of them is what nodes draw.
template <class Wish, class Ask>
StabilityCase request_case(const std::string& name, const Wish& wish, Ask ask) {
  return {"fields of requests", name, kEachRefusedOrHarmless, [wish, ask](const gl::Context&) -> Outcome {
            const Deployment deployment = deployment_of_requests();
            int refused = 0, taken = 0;
            for (const NumberField& field : number_fields(wish)) {
              Tally tally(field.words);
              for (const auto& [value, message] : field.spoilt) {
                auto stage = controller::Stage::of(deployment);
                if (!stage || !stage->show({whole_scene(), {}, {}})) return {"the scene is refused", 0, false};
                const auto update = ask(*stage, dynamic_cast<const Wish&>(*message));
                ++(update ? taken : refused);
                if (!update) {
                  tally.refused(value, update.error().message());
                  continue;
                }
                const auto roi = read_roi(stage->store().state().roi());
                const auto settings = read_settings(stage->store().state().render());
                tally.accepted(value, roi && settings ? harm_of(deployment.display, *roi, *settings)
                                                      : "a state that nodes refuse");
              }
              const Outcome outcome = tally.outcome();
              if (!outcome.passed) return {field.road + ": " + outcome.got, 0, false};
            }
            return {fmt::format("{} refused, {} harmless", refused, taken), 0, refused > 0 && taken > 0};
          }};
}

proto::AmbientOcclusion whole_ao() {
  proto::AmbientOcclusion ao;
  ao.mutable_curve()->set_a(0.5);
  ao.mutable_curve()->set_b(1);
  ao.mutable_curve()->set_c(1);
  ao.mutable_blur()->set_sigma_px(1.5);
  return ao;
}

proto::TestPattern whole_pattern() {
  proto::TestPattern pattern;
  pattern.set_kind(proto::TestPattern::GRID);
  pattern.set_spacing_px(16);
  pattern.mutable_color()->set_r(0.5);
  return pattern;
}

}  // namespace

void add_scene_field_cases(StabilityCases& cases) {
  for (const char* part : {"instance 0", "material 0", "light 1", "light 2", "light 3"}) {
    cases.push_back({"fields of scenes", part,
                     "each value refused with the field's name, or drawn: all finite, none darker",
                     [part](const gl::Context& context) { return spoil_part(context, part); }});
  }
  using controller::Stage;
  cases.push_back(
      request_case("roi", write_roi(small_roi()), [](Stage& stage, const auto& wish) { return stage.set_roi(wish); }));
  cases.push_back(request_case("ao", whole_ao(), [](Stage& stage, const auto& wish) { return stage.set_ao(wish); }));
  proto::RenderSettings render;
  *render.mutable_ao() = whole_ao();
  render.mutable_background()->set_r(0.5);
  cases.push_back(
      request_case("render", render, [](Stage& stage, const auto& wish) { return stage.set_render(wish); }));
  cases.push_back(
      request_case("pattern", whole_pattern(), [](Stage& stage, const auto& wish) { return stage.set_pattern(wish); }));
}

}  // namespace lfd::bench
