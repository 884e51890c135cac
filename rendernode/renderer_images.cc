// What a frame hands out: its images, and what there is to say of it.
#include <algorithm>
#include <iterator>

#include "base/log.h"
#include "base/version.h"
#include "rendernode/pack_images.h"
#include "rendernode/renderer.h"

namespace lfd {

std::vector<ReadbackItem> Renderer::wanted(const Slot& slot) const {
  std::vector<ReadbackItem> items;
  for (const auto layer : slot.plan.active_layers) {
    items.push_back({layer, proto::COLOR, targets_.color(slot.plan), GL_RGBA, GL_UNSIGNED_BYTE, 4});
    if (slot.plan.pattern) continue;
    const BufferSet& asked = slot.options.buffers;
    if (asked.has(proto::POSITION))
      items.push_back({layer, proto::POSITION, targets_.position(), GL_RGBA, GL_FLOAT, 16});
    if (asked.has(proto::NORMAL)) items.push_back({layer, proto::NORMAL, targets_.normal(), GL_RGBA, GL_FLOAT, 16});
    if (asked.has(proto::DEPTH)) items.push_back({layer, proto::DEPTH, targets_.position(), GL_RGBA, GL_FLOAT, 16});
    // Without bent normals every direction is open.
    if (asked.has(proto::BENT_NORMAL))
      items.push_back(
          {layer, proto::BENT_NORMAL, slot.plan.bent ? targets_.ao(0) : targets_.normal(), GL_RGBA, GL_FLOAT, 16});
    if (!asked.has(proto::AO)) continue;
    // Without an ambient-occlusion pass every surface is open; the positions tell where one is.
    if (slot.plan.ao) {
      items.push_back({layer, proto::AO, targets_.ao(0), GL_RED, GL_FLOAT, 4});
    } else {
      items.push_back({layer, proto::AO, targets_.position(), GL_RGBA, GL_FLOAT, 16});
    }
  }
  return items;
}

std::vector<ModuleImage> Renderer::images_of(const Slot& slot) const {
  std::vector<ModuleImage> images;
  const PackInputs pack{slot.roi, slot.ao, slot.plan.ao, slot.plan.bent};
  for (std::size_t i = 0; i < slot.readback.items().size(); ++i) {
    const auto& item = slot.readback.items()[i];
    images.push_back(
        {modules_[item.layer], item.kind, display_.image, false, pack_image(item.kind, slot.readback.bytes(i), pack)});
  }
  append_unchanged(slot, images);
  append_empty(slot, images);
  return images;
}

void Renderer::append_unchanged(const Slot& slot, std::vector<ModuleImage>& images) const {
  for (const auto layer : slot.plan.unchanged_layers) {
    std::ranges::copy_if(last_images_, std::back_inserter(images),
                         [&](const ModuleImage& image) { return image.module == modules_[layer]; });
  }
}

void Renderer::append_empty(const Slot& slot, std::vector<ModuleImage>& images) const {
  for (std::uint32_t layer = 0; layer < modules_.size(); ++layer) {
    if (std::ranges::binary_search(slot.plan.unchanged_layers, layer)) continue;
    const bool is_drawn = std::ranges::binary_search(slot.plan.active_layers, layer);
    if (is_drawn && !slot.plan.pattern) continue;  // of a test pattern there is colour alone
    for (const auto kind :
         {proto::COLOR, proto::POSITION, proto::NORMAL, proto::AO, proto::DEPTH, proto::BENT_NORMAL}) {
      if (kind == proto::COLOR ? is_drawn : !slot.options.buffers.has(kind)) continue;
      images.push_back({modules_[layer], kind, display_.image, true, nullptr});
    }
  }
}

void Renderer::fill_report(Slot& slot, proto::NodeReport& report) {
  report.set_renderer(description_);
  report.set_version(kVersion);
  report.set_triangles(geometry_.planes.size());
  report.set_occlusion_choice(slot.occlusion_choice);
  auto* geometry = report.add_pass();
  geometry->set_pass("geometry");
  geometry->set_cpu_ms(slot.geometry_ms);
  if (slot.reused) {
    auto* left = report.add_left_out();
    left->set_what("module");
    left->set_which("all");
    left->set_why("inputs unchanged since the last frame");
    left->set_count(modules_.size());
    return;
  }
  for (const auto& timed : slot.timers.collect()) {
    auto* pass = report.add_pass();
    pass->set_pass(timed.pass);
    pass->set_gpu_ms(timed.gpu_ms);
    for (const auto layer : timed.layers) {
      if (slot.options.time_modules) pass->add_module(modules_[layer]);
    }
  }
  if (const std::string why = why_nothing_is_seen(); !why.empty() && !slot.plan.pattern)
    report.add_warning("nothing of the scene is seen: " + why);
  for (const DrawnModules* drawn : {own_.get(), banded_.get()}) {
    if (drawn == nullptr) continue;
    for (const std::string& warning : drawn->warnings) report.add_warning(warning);
  }
  for (const auto& left : slot.plan.left_out) *report.add_left_out() = left;
  if (geometry_.degenerate_triangles > 0) {
    report.add_warning(
        fmt::format("{} triangles without an area, or not finite, are not drawn", geometry_.degenerate_triangles));
  }
}

}  // namespace lfd
