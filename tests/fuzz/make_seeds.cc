// Writes the first inputs of the fuzzers of messages, glTF files and recordings, which are made of real messages:
// lfd-fuzz-seeds tests/fuzz/corpus.
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/hash.h"
#include "base/version.h"
#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "proto/settings.h"
#include "tests/fuzz/peers.h"
#include "tests/support/made.h"
#include "tests/support/recorded_show.h"
#include "tests/unit/gltf_maker.h"

namespace lfd {
namespace {

namespace fs = std::filesystem;
using test::GltfMaker;
using testing_support::RecordedShow;

std::string little(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xFF);
  return text;
}

struct Step {
  std::string name;
  proto::Envelope envelope;
  std::string payload = {};
  int sender = 0;
  int wait = 0;
};

proto::Envelope envelope_with(const std::function<void(proto::Envelope&)>& fill) {
  proto::Envelope envelope;
  envelope.set_protocol(kProtocolVersion);
  fill(envelope);
  return envelope;
}

// Each kind of message once, as a member sends it.
std::vector<Step> steps() {
  std::vector<Step> all;
  const auto add = [&](const std::string& name, const std::function<void(proto::Envelope&)>& fill,
                       const std::string& payload = {}, int sender = 0, int wait = 0) {
    all.push_back({name, envelope_with(fill), payload, sender, wait});
  };
  add("heartbeat", [](auto& e) { e.mutable_heartbeat()->set_state_hash(content_hash("state")); });
  add("drawn", [](auto& e) { e.mutable_drawn()->set_frame(0); });
  add("ready", [](auto& e) {
    e.mutable_ready()->set_frame(0);
    e.mutable_ready()->mutable_report()->set_node("left");
    e.mutable_ready()->mutable_report()->add_pass()->set_pass("ao");
  });
  add(
      "ready_failed", [](auto& e) { e.mutable_ready()->mutable_report()->set_error("no memory"); }, {}, 1);
  add(
      "shown", [](auto& e) { e.mutable_shown()->set_modules(2); }, {}, 2);
  add(
      "image",
      [](auto& e) {
        proto::Image& image = *e.mutable_image();
        image.set_width_px(2);
        image.set_height_px(1);
        image.set_of_images(1);
      },
      "12345678");
  add(
      "image_empty",
      [](auto& e) {
        e.mutable_image()->set_module(1);
        e.mutable_image()->set_empty(true);
        e.mutable_image()->set_of_images(1);
        e.mutable_image()->mutable_background()->set_r(0.5);
      },
      {}, 1);
  add("swap", [](auto& e) { e.mutable_swap()->add_stale_modules(1); });
  add("hello", [](auto& e) { e.mutable_hello()->set_node("left"); });
  add("update", [](auto& e) {
    e.mutable_update()->set_sequence(2);
    e.mutable_update()->set_buffers(3);
  });
  add("update_instances", [](auto& e) {
    e.mutable_update()->set_sequence(3);
    *e.mutable_update()->add_instance() = testing_support::made_data("plane").scene.instance(0);
  });
  add("snapshot", [](auto& e) {
    proto::State& state = *e.mutable_snapshot()->mutable_state();
    state.set_sequence(7);
    *state.mutable_scene() = testing_support::made_data("plane").scene;
  });
  add("pulse", [](auto& e) { e.mutable_pulse()->set_sequence(9); });
  add("begin", [](auto& e) { e.mutable_begin()->set_sequence(9); });
  for (std::size_t at = 0; at < fuzz::Peers::kAsset.size(); at += fuzz::Peers::kPiece_bytes) {
    add(
        "chunk_" + std::to_string(at),
        [at](auto& e) {
          e.mutable_chunk()->set_hash(content_hash(fuzz::Peers::kAsset));
          e.mutable_chunk()->set_offset(at);
          e.mutable_chunk()->set_total(fuzz::Peers::kAsset.size());
        },
        std::string(fuzz::Peers::kAsset.substr(at, fuzz::Peers::kPiece_bytes)));
  }
  add("not_found", [](auto& e) { e.mutable_not_found()->set_hash(content_hash(fuzz::Peers::kAsset)); });
  add(
      "roi",
      [](auto& e) {
        proto::RegionOfInterest& roi = *e.mutable_request()->mutable_roi();
        roi.mutable_world_size()->set_x(1);
        roi.mutable_world_size()->set_y(1);
        roi.mutable_world_size()->set_z(1);
        roi.mutable_world_centre()->set_x(1);
        roi.mutable_world_orientation()->set_w(1);
      },
      {}, 3);
  add(
      "ao",
      [](auto& e) {
        proto::AmbientOcclusion& ao = *e.mutable_request()->mutable_ao();
        ao.set_method("hbao");
        ao.set_radius_m(0.1);
        ao.set_samples(8);
        (*ao.mutable_parameter())["directions"] = 8;
        ao.mutable_blur()->set_sigma_px(2);
        ao.mutable_shared()->set_neighbours(2);
        ao.mutable_curve()->set_b(1);
      },
      {}, 3);
  add(
      "render",
      [](auto& e) {
        proto::RenderSettings& render = *e.mutable_request()->mutable_render();
        render.mutable_background()->set_g(0.25);
        render.set_near_z_m(1);
        render.set_warp_level(5);
        render.set_subdivision_px(0.1);
      },
      {}, 3);
  add(
      "pattern",
      [](auto& e) {
        proto::TestPattern& pattern = *e.mutable_request()->mutable_pattern();
        pattern.set_kind(proto::TestPattern::GRID);
        pattern.set_space(proto::TestPattern::SCREEN);
        pattern.set_spacing_m(0.1);
        pattern.add_modules("0-1");
        pattern.mutable_color()->set_r(1);
      },
      {}, 3);
  add(
      "leave", [](auto& e) { e.mutable_leave()->set_reason("enough"); }, {}, 1, 2);
  add(
      "join",
      [](auto& e) {
        e.mutable_join()->set_name("right");
        e.mutable_join()->set_version(kVersion);
        e.mutable_join()->set_calibration_hash("c0");
        e.mutable_join()->set_process(9);
      },
      {}, 1, 1);
  add(
      "join_display",
      [](auto& e) {
        e.mutable_join()->set_role(proto::DISPLAY);
        e.mutable_join()->set_name("other");
        e.mutable_join()->set_version(kVersion);
        e.mutable_join()->set_images_endpoint("tcp://127.0.0.1:5000");
      },
      {}, 3, 3);
  return all;
}

// As fuzz_messages.cc reads it.
std::string step_bytes(const Step& step) {
  const std::string envelope = step.envelope.SerializeAsString();
  std::string bytes =
      little(static_cast<std::size_t>(step.sender | step.wait << 2 | (step.payload.empty() ? 0 : 16)), 1);
  bytes += little(envelope.size(), 2) + envelope;
  if (!step.payload.empty()) bytes += little(step.payload.size(), 1) + step.payload;
  return bytes;
}

std::vector<std::pair<std::string, std::string>> scenes() {
  std::vector<std::pair<std::string, std::string>> all;
  GltfMaker maker = GltfMaker::triangle();
  all.emplace_back("triangle.gltf", maker.gltf());
  all.emplace_back("triangle.glb", maker.glb());
  maker.animate("translation", "LINEAR", {0, 1, 2}, {0, 0, 0, 2, 0, 0, 1, 0, 0});
  maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
  maker.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  all.emplace_back("moving.gltf", maker.gltf());
  GltfMaker scaled = GltfMaker::triangle();
  scaled.animate("scale", "CUBICSPLINE", {0, 1}, {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, -1, 1, 1, 0, 0, 0});
  all.emplace_back("scaled.glb", scaled.glb());
  GltfMaker textured = GltfMaker::triangle();
  textured.primitive()["attributes"]["TEXCOORD_0"] = textured.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
  textured.primitive()["indices"] = textured.add_accessor<std::uint16_t>({0, 1, 2}, test::kUnsignedShort, "SCALAR", 3);
  textured.root["images"] = {{{"bufferView", textured.add_view(test::tiny_png())}, {"mimeType", "image/png"}}};
  textured.root["textures"] = {{{"source", 0}}};
  textured.material()["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}, {"rotation", 1}}}}}};
  textured.root["materials"][0]["alphaMode"] = "MASK";
  all.emplace_back("textured.glb", textured.glb());
  return all;
}

std::string show_of(bool with_assets, bool ends) {
  const DisplayCalibration display = *make_display("desk");
  DisplayCalibration small;
  small.name = "small";
  small.screen = display.screen;
  RecordedShow show(small);
  const SceneData plane = testing_support::made_data("plane");
  show.snapshot(testing_support::whole_state(plane, write_roi(testing_support::whole_scene(plane.scene, display))));
  if (with_assets) show.assets(plane.assets);
  show.frame(3);
  proto::Update update;
  update.mutable_render()->mutable_ao()->set_samples(4);
  *update.add_instance() = plane.scene.instance(0);
  update.mutable_instance(0)->set_world_from_mesh(3, 0.5);
  show.update(update);
  show.frame(4);
  show.asset("two pieces", 5);
  if (ends) show.end();
  return show.bytes;
}

bool write_all(const fs::path& corpus) {
  std::vector<std::pair<fs::path, std::string>> files;
  std::string whole;
  for (const Step& step : steps()) {
    const std::string envelope = step.envelope.SerializeAsString();
    files.emplace_back("envelope/" + step.name, little(envelope.size(), 2) + envelope + step.payload);
    files.emplace_back("messages/" + step.name, step_bytes(step));
    whole += step_bytes(step);
  }
  files.emplace_back("messages/all", whole);
  for (const auto& [name, content] : scenes()) files.emplace_back("gltf/" + name, content);
  files.emplace_back("recording/whole", show_of(true, true));
  files.emplace_back("recording/cut", show_of(true, false));
  files.emplace_back("recording/without_assets", show_of(false, true));
  for (const auto& [name, content] : files) {
    const Status made = make_folder((corpus / name).parent_path());
    const Status written = made ? write_file(corpus / name, content) : made;
    if (written) continue;
    std::cerr << "error: " << written.error().message() << "\n";
    return false;
  }
  return true;
}

}  // namespace
}  // namespace lfd

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: lfd-fuzz-seeds FOLDER\n";
    return 2;
  }
  return lfd::write_all(argv[1]) ? 0 : 1;
}
