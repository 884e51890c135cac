// lfd-scene: makes scenes and says what a scene file contains.
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "base/command_line.h"
#include "base/file.h"
#include "base/log.h"
#include "controller/scene/loaded_scene.h"
#include "controller/scene/made/made_scenes.h"
#include "controller/scene/scene_file.h"
#include "proto/mesh_arrays.h"

namespace lfd {
namespace {

constexpr double kLeastExtent_m = 1e-6, kMostExtent_m = 1e6;

int list() {
  for (const scene::MadeScene& made : scene::made_scenes()) fmt::print("{:<14} {}\n", made.name, made.description);
  return end_of_output();
}

int make(const std::string& name, std::uint64_t seed, scene::Extent extent, const std::string& out) {
  if (const Status writable = check_writable(out); !writable) return fail(writable.error());
  const Result<LoadedScene> made = scene::make_scene(name, seed, extent);
  if (!made) return fail(made.error());
  const Status written = scene::write_glb(out, made->data);
  return written ? kExitDone : fail(written.error());
}

void print_lights(const proto::Scene& scene) {
  for (const proto::Light& light : scene.light()) {
    fmt::print("light {:<12} {:.3g} {:.3g} {:.3g}\n", proto::Light::Kind_Name(light.kind()), light.color(0),
               light.color(1), light.color(2));
  }
}

void print_materials(const LoadedScene& loaded) {
  for (const proto::Material& material : loaded.data.scene.material()) {
    std::string kind = material.unlit() ? " unlit" : "";
    if (material.double_sided()) kind += " double-sided";
    if (material.has_alpha_cutoff()) kind += fmt::format(" mask {:.2f}", material.alpha_cutoff());
    if (material.has_texture()) {
      kind += fmt::format(" texture of {} bytes", loaded.data.assets.at(material.texture().picture())->size());
    }
    fmt::print("material \"{}\"{}\n", material.name(), kind);
  }
}

int info(const std::string& file) {
  const Result<LoadedScene> loaded = load_scene(file);
  if (!loaded) return fail(loaded.error());
  const Result<scene::Census> census = scene::census_of(loaded->data);
  if (!census) return fail(census.error());
  const proto::Scene& scene = loaded->data.scene;
  fmt::print("scene \"{}\": {} faces in {} instances of {} meshes, {} materials, {} pictures\n", scene.name(),
             census->faces, scene.instance_size(), census->meshes, scene.material_size(), census->pictures);
  const proto::Vector& low = scene.bounds_low();
  const proto::Vector& high = scene.bounds_high();
  fmt::print("bounds ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m\n", low.x(), low.y(), low.z(), high.x(), high.y(),
             high.z());
  print_materials(*loaded);
  print_lights(scene);
  if (loaded->animations.empty()) {
    fmt::print("nothing moves\n");
  } else {
    fmt::print("{} animation channels, {:g} s\n", loaded->animations.channel_count(), loaded->animations.duration_s());
  }
  for (const std::string& warning : loaded->warnings) fmt::print("warning: {}\n", warning);
  return end_of_output();
}

int run(int argc, char** argv) {
  CLI::App app("Makes the scenes of this project and says what a scene file contains.", "lfd-scene");
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 it failed, 2 wrong use.");

  CLI::App* list_command = app.add_subcommand("list", "The scenes that can be made.");
  std::string name;
  std::string out;
  std::uint64_t seed = 1;
  scene::Extent extent;
  CLI::App* make_command = app.add_subcommand(
      "make",
      "Makes a scene and writes it as glTF 2.0 (.glb). The same seed gives the same scene. Ambient and head "
      "lights are not written: glTF has none.");
  std::vector<std::string> names;
  for (const scene::MadeScene& made : scene::made_scenes()) names.push_back(made.name);
  make_command->add_option("name", name, "One of `lfd-scene list`")->required()->check(CLI::IsMember(names));
  make_command->add_option("--out", out, "File to write: *.glb")->required()->check(file_ending(".glb"));
  make_command->add_option("--seed", seed, "Seed of textures and shapes")
      ->check(whole_number_within(0, std::numeric_limits<std::uint32_t>::max()))  // as deployments have it
      ->capture_default_str();
  make_command->add_option("--width", extent.width_m, "Metres along x (not of ribbed-shell)")
      ->check(number_within(kLeastExtent_m, kMostExtent_m))
      ->capture_default_str();
  make_command->add_option("--height", extent.height_m, "Metres along y (not of ribbed-shell)")
      ->check(number_within(kLeastExtent_m, kMostExtent_m))
      ->capture_default_str();
  std::string file;
  CLI::App* info_command =
      app.add_subcommand("info",
                         "Reads a .gltf or .glb file as the controller does: counts, bounds, materials, lights, "
                         "animations, and what is not supported.");
  info_command->add_option("file", file, "The .gltf or .glb file")->required();

  if (const auto code = parse_command_line(app, argc, argv)) return *code;
  if (*list_command) return list();
  if (*make_command) return make(name, seed, extent, out);
  LFD_CHECK(*info_command, "one of three subcommands was parsed");
  return info(file);
}

}  // namespace
}  // namespace lfd

// NOLINTNEXTLINE(bugprone-exception-escape): it ends where there is no memory
int main(int argc, char** argv) { return lfd::run(argc, argv); }
