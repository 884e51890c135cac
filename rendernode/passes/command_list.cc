// Plans to indirect commands.
#include "rendernode/passes/command_list.h"

#include <algorithm>

#include "shaders/shared/glsl_types.h"

namespace lfd {
namespace {

struct IndirectCommand {  // as OpenGL 4.5, 10.4 lays it out
  std::uint32_t count, instance_count, first_index;
  std::int32_t base_vertex;
  std::uint32_t base_instance;
};

std::uint32_t flags_of(const MaterialFacts& material) {
  return (material.double_sided ? DRAW_DOUBLE_SIDED : 0U) | (material.unlit ? DRAW_UNLIT : 0U);
}

}  // namespace

CommandList make_commands(const FramePlan& plan, const std::vector<GeometryItem>& items,
                          const std::vector<MaterialFacts>& materials, bool batch_per_module) {
  CommandList list;
  std::vector<std::vector<std::uint32_t>> layer_sets;
  if (batch_per_module) {
    for (const auto layer : plan.active_layers) layer_sets.push_back({layer});
  } else if (!plan.active_layers.empty()) {
    layer_sets.push_back(plan.active_layers);
  }
  std::vector<IndirectCommand> commands;
  std::vector<shared::DrawRecord> records;
  std::vector<std::uint32_t> layers;
  for (auto& set : layer_sets) {
    Batch batch{static_cast<std::uint32_t>(layers.size()), static_cast<std::uint32_t>(set.size()), set, {}};
    layers.insert(layers.end(), set.begin(), set.end());
    for (const auto& group : plan.groups) {
      Submission submission{group.texture_group, group.alpha_mask, static_cast<std::uint32_t>(commands.size()), 0};
      for (const auto& draw : group.draws) {
        if (batch_per_module && draw.layer != set.front()) continue;
        const GeometryItem& item = items[draw.item];
        commands.push_back({item.index_count, 1, item.first_index, 0, static_cast<std::uint32_t>(records.size())});
        records.push_back({draw.layer, item.primitive_base, item.material, flags_of(materials[item.material])});
        ++submission.count;
      }
      if (submission.count > 0) batch.submissions.push_back(submission);
    }
    list.batches.push_back(std::move(batch));
  }
  list.commands = gl::make_buffer(commands);
  list.records = gl::make_buffer(records);
  list.layers = gl::make_buffer(layers);
  return list;
}

}  // namespace lfd
