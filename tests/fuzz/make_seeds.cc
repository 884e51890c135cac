// Writes the first inputs of the fuzzers of messages, glTF files and recordings, which are made of real messages:
// lfd-fuzz-seeds tests/fuzz/corpus.
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "calibration/make.h"
#include "controller/scene/made/made_scenes.h"
#include "proto/settings.h"
#include "tests/fuzz/seed_messages.h"
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

// As fuzz_messages.cc reads it.
std::string step_bytes(const fuzz::Step& step) {
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
  proto::MovedInstance& moved = *update.add_moved_instance();
  moved.set_mesh(plane.scene.instance(0).mesh());
  *moved.mutable_world_from_mesh() = plane.scene.instance(0).world_from_mesh();
  moved.set_world_from_mesh(3, 0.5);
  *update.add_moved_light()->mutable_light() = plane.scene.light(0);
  show.update(update);
  show.frame(4);
  show.asset("two pieces", 5);
  if (ends) show.end();
  return show.bytes;
}

bool write_all(const fs::path& corpus) {
  std::vector<std::pair<fs::path, std::string>> files;
  std::string whole;
  for (const fuzz::Step& step : fuzz::steps()) {
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
