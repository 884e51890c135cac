// A glTF file as tinygltf's model: parsed, its external files read from its own folder only. Nothing in it is checked
// yet.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "base/result.h"

namespace lfd::scene::gltf {

struct Document {
  tinygltf::Model model;                       // images hold encoded bytes as they came; of buffer views: none
  std::map<std::string, std::string> refused;  // external files that could not be read: why, by decoded URI
};

// `content` is that of a .gltf or .glb file in `folder`. Errors do not name the file: the caller knows it.
Result<Document> read_document(std::string_view content, const std::filesystem::path& folder);

// `mesh 3 "curtain"`: how errors and warnings name a place. Names from files are cut and made printable.
std::string label(std::string_view kind, std::size_t index, const std::string& name = {});

// An item of one of the model's arrays by an index from the file, or the error that says what was asked for.
template <class Item>
Result<const Item*> item_at(const std::vector<Item>& items, int index, std::string_view kind) {
  if (index >= 0 && static_cast<std::size_t>(index) < items.size()) return &items[static_cast<std::size_t>(index)];
  return Error(std::string(kind) + " " + std::to_string(index) + " does not exist; there are " +
               std::to_string(items.size()));
}

}  // namespace lfd::scene::gltf
