// Bytes to tinygltf's model: the containers are checked here, since tinygltf trusts them.
#include "controller/scene/gltf/document.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <sstream>

#include "base/log.h"
#include "controller/scene/gltf/external_files.h"
#include "controller/scene/gltf/support.h"
#include "controller/scene/limits.h"

namespace lfd::scene::gltf {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof(word));
  return word;
}

bool is_glb(std::string_view bytes) { return bytes.size() >= 4 && word_at(bytes, 0) == kGlbMagic; }

// What is neither container is told so in our words, not in those of a JSON parser.
Status check_kind(std::string_view bytes) {
  if (bytes.empty()) return Error("the file is empty");
  const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (is_glb(bytes) || (first != bytes.npos && bytes[first] == '{')) return {};
  return Error("neither glTF (JSON) nor glb: it begins with neither \"{\" nor \"glTF\"");
}

// The JSON text of a glb file whose chunks all lie inside the file.
Result<std::string_view> json_of_glb(std::string_view bytes) {
  if (bytes.size() < kGlbHeaderBytes + kChunkHeaderBytes) return Error("glb: the file is truncated");
  if (word_at(bytes, 4) != 2) return Error(fmt::format("glb: version {}; only 2 is read", word_at(bytes, 4)));
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    return Error(fmt::format("glb: the file is truncated: {} bytes of {}", bytes.size(), length));
  }
  std::string_view json;
  std::size_t offset = kGlbHeaderBytes;
  for (int chunk = 0; offset < length; ++chunk) {
    if (length - offset < kChunkHeaderBytes) return Error(fmt::format("glb: chunk {}: header is truncated", chunk));
    const std::size_t size = word_at(bytes, offset);
    const std::uint32_t type = word_at(bytes, offset + 4);
    offset += kChunkHeaderBytes;
    if (size > length - offset)
      return Error(fmt::format("glb: chunk {}: {} bytes, {} left", chunk, size, length - offset));
    if (chunk == 0 && type != kJsonChunk) return Error("glb: the first chunk is not JSON");
    if (chunk == 0) json = bytes.substr(offset, size);
    offset += size;
  }
  return json;
}

// tinygltf reads nested values by recursion: refuse what would exhaust the stack.
Status check_nesting(std::string_view json) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxNesting) return Error(fmt::format("JSON: nested more than {} deep", kMaxNesting));
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return {};
}

// Keeps encoded bytes. Those of buffer views are fetched later, when the view has been checked: here it has not.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

std::string printable(std::string text, std::size_t limit) {
  if (text.size() > limit) text = text.substr(0, limit) + "...";
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 32 || c == 127; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

// tinygltf asks for two things that glTF 2.0 does not ask for; both belong to what is left out anyway.
bool is_complaint_about_nothing(std::string_view line) {
  return line.find("inverseBindMatrices") != line.npos || line.find("'node' property is missing") != line.npos ||
         line.find("`node` field is missing in animation.channels.target") != line.npos;
}

std::string without_complaints_about_nothing(const std::string& said) {
  std::istringstream lines(said);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (!is_complaint_about_nothing(line)) kept += line + "\n";
  }
  return kept;
}

// What tinygltf said, or better: why the external file that it misses was refused.
Error parse_error(const std::string& said, const Document& document) {
  for (const auto& [name, reason] : document.refused) {
    if (said.find(name) != std::string::npos) return Error(reason).within(fmt::format("\"{}\"", printable(name, 100)));
  }
  return Error(said.empty() ? "not a glTF file" : printable(said, 300));
}

bool parse(std::string_view bytes, tinygltf::TinyGLTF& parser, tinygltf::Model& model, std::string& said) {
  std::string warnings;  // only about images that are missing: an error where one is used
  const auto size = static_cast<unsigned int>(bytes.size());
  try {
    if (is_glb(bytes)) {
      const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
      return parser.LoadBinaryFromMemory(&model, &said, &warnings, data, size, "", tinygltf::REQUIRE_VERSION);
    }
    return parser.LoadASCIIFromString(&model, &said, &warnings, bytes.data(), size, "", tinygltf::REQUIRE_VERSION);
  } catch (const std::exception& failure) {
    said += failure.what();
    return false;
  }
}

}  // namespace

std::string label(std::string_view kind, std::size_t index, const std::string& name) {
  if (name.empty()) return fmt::format("{} {}", kind, index);
  return fmt::format("{} {} \"{}\"", kind, index, printable(name, 60));
}

Result<Document> read_document(std::string_view content, const std::filesystem::path& folder) {
  std::string_view json = content;
  LFD_TRY_STATUS(check_kind(content));
  if (is_glb(content)) {
    LFD_TRY(json, json_of_glb(content));
  }
  LFD_TRY_STATUS(check_nesting(json));

  ExternalFiles files(folder);
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader(keep_encoded, nullptr);
  parser.SetFsCallbacks(files.callbacks());
  Document document;
  std::string said;
  const bool parsed = parse(content, parser, document.model, said);
  document.refused = files.refused();
  if (parsed) said = without_complaints_about_nothing(said);
  LFD_TRY_STATUS(check_required_extensions(document.model));
  if (!parsed || !said.empty()) return parse_error(said, document);
  if (!document.model.asset.version.starts_with("2.")) {
    return Error(fmt::format("asset: version: \"{}\"; only 2.x is read", printable(document.model.asset.version, 20)));
  }
  return document;
}

}  // namespace lfd::scene::gltf
