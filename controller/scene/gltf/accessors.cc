// Numbers out of accessors.
#include "controller/scene/gltf/accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>

#include "base/log.h"
#include "controller/scene/gltf/document.h"
#include "controller/scene/limits.h"

namespace lfd::scene::gltf {
namespace {

// Elements that lie inside a buffer: all of them can be read.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;

  const unsigned char* at(std::size_t i) const { return first + i * stride; }
};

struct Format {
  int component_type = 0;
  std::size_t component_bytes = 0;
  std::size_t components = 0;
  bool normalized = false;

  std::size_t bytes() const { return component_bytes * components; }
};

// glTF 2.0 knows these six; tinygltf lets more pass.
std::optional<std::size_t> component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return std::nullopt;
  }
}

template <class T>
T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));  // the file aligns nothing
  return value;
}

template <class T>
float integer(const unsigned char* from, bool normalized) {
  const T value = load<T>(from);
  if (!normalized) return static_cast<float>(value);
  return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

float component(const unsigned char* from, const Format& format) {
  switch (format.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return integer<std::int8_t>(from, format.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return integer<std::uint8_t>(from, format.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return integer<std::int16_t>(from, format.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return integer<std::uint16_t>(from, format.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return integer<std::uint32_t>(from, format.normalized);
    default:
      return load<float>(from);
  }
}

std::uint32_t unsigned_integer(const unsigned char* from, int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(from);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(from);
    default:
      return load<std::uint32_t>(from);
  }
}

bool is_unsigned_integer(int component_type) {
  return component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

// `count` elements of `element_bytes` in a view from `offset` on. stride 0: tightly packed. count > 0.
Result<Elements> elements(const tinygltf::Model& model, int view, std::size_t offset, std::size_t stride,
                          std::size_t element_bytes, std::size_t count) {
  LFD_TRY(const std::span<const unsigned char> bytes, bytes_of_view(model, view));
  const std::size_t step = stride == 0 ? element_bytes : stride;
  if (step < element_bytes) {
    return Error(
        fmt::format("bufferView {}: byteStride {} is less than an element's {} bytes", view, step, element_bytes));
  }
  const bool inside = offset <= bytes.size() && bytes.size() - offset >= element_bytes &&
                      (bytes.size() - offset - element_bytes) / step >= count - 1;
  if (!inside) {
    return Error(fmt::format("{} elements of {} bytes from byte {} on leave bufferView {} of {} bytes", count, step,
                             offset, view, bytes.size()));
  }
  return Elements{bytes.data() + offset, step};
}

Result<Format> format_of(const tinygltf::Accessor& accessor) {
  const std::optional<std::size_t> bytes = component_bytes(accessor.componentType);
  if (!bytes) return Error(fmt::format("componentType {} is not one of glTF", accessor.componentType));
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (accessor.count == 0) return Error("count: must be > 0");
  if (accessor.count > kMaxIndices)
    return Error(fmt::format("count: {}; at most {} are read", accessor.count, kMaxIndices));
  return Format{accessor.componentType, *bytes, static_cast<std::size_t>(components), accessor.normalized};
}

Result<std::vector<std::uint32_t>> sparse_indices(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count) {
    return Error(fmt::format("count: {} of {} elements", sparse.count, accessor.count));
  }
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) return Error("byteOffset: must be >= 0");
  const int type = sparse.indices.componentType;
  if (!is_unsigned_integer(type))
    return Error(fmt::format("indices: componentType {} is not an unsigned integer", type));
  const auto count = static_cast<std::size_t>(sparse.count);
  LFD_TRY(const Elements from,
          elements(model, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), 0,
                   *component_bytes(type), count));
  std::vector<std::uint32_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) {
    indices[i] = unsigned_integer(from.at(i), type);
    if (indices[i] >= accessor.count)
      return Error(fmt::format("indices: {} of {} elements", indices[i], accessor.count));
  }
  return indices;
}

// Calls use(element index, bytes of the element) for all elements that the file gives, sparse ones last.
template <class Use>
Status for_each_element(const tinygltf::Model& model, const tinygltf::Accessor& accessor, const Format& format,
                        Use use) {
  if (accessor.bufferView >= 0) {
    LFD_TRY(const tinygltf::BufferView* view, item_at(model.bufferViews, accessor.bufferView, "bufferView"));
    LFD_TRY(const Elements from, elements(model, accessor.bufferView, accessor.byteOffset, view->byteStride,
                                          format.bytes(), accessor.count));
    for (std::size_t i = 0; i < accessor.count; ++i) use(i, from.at(i));
  } else if (!accessor.sparse.isSparse) {
    return Error("has neither bufferView nor sparse values");
  }
  if (!accessor.sparse.isSparse) return {};
  const Result<std::vector<std::uint32_t>> indices = sparse_indices(model, accessor);
  if (!indices) return indices.error().within("sparse");
  const Result<Elements> values =
      elements(model, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset), 0,
               format.bytes(), indices->size());
  if (!values) return values.error().within("sparse: values");
  for (std::size_t i = 0; i < indices->size(); ++i) use((*indices)[i], values->at(i));
  return {};
}

Result<std::vector<float>> floats_of(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                                     const Format& format, std::size_t pad_to, float fill) {
  if (accessor.count > kMaxVertices)
    return Error(fmt::format("count: {}; at most {} are read", accessor.count, kMaxVertices));
  std::vector<float> result(accessor.count * pad_to, accessor.bufferView >= 0 ? fill : 0.0F);
  LFD_TRY_STATUS(for_each_element(model, accessor, format, [&](std::size_t element, const unsigned char* from) {
    for (std::size_t c = 0; c < format.components; ++c) {
      result[element * pad_to + c] = component(from + c * format.component_bytes, format);
    }
  }));
  return result;
}

}  // namespace

Result<std::span<const unsigned char>> bytes_of_view(const tinygltf::Model& model, int view) {
  LFD_TRY(const tinygltf::BufferView* item, item_at(model.bufferViews, view, "bufferView"));
  const Result<const tinygltf::Buffer*> buffer = item_at(model.buffers, item->buffer, "buffer");
  if (!buffer) return buffer.error().within(label("bufferView", static_cast<std::size_t>(view)));
  const std::size_t size = (*buffer)->data.size();
  if (item->byteOffset > size || item->byteLength > size - item->byteOffset) {
    return Error(fmt::format("bufferView {}: bytes {} + {} leave buffer {} of {} bytes", view, item->byteOffset,
                             item->byteLength, item->buffer, size));
  }
  return std::span<const unsigned char>((*buffer)->data.data() + item->byteOffset, item->byteLength);
}

Result<std::vector<float>> read_floats(const tinygltf::Model& model, int accessor, int components) {
  LFD_TRY(const tinygltf::Accessor* item, item_at(model.accessors, accessor, "accessor"));
  const std::string place = fmt::format("accessor {}", accessor);
  const Result<Format> format = format_of(*item);
  if (!format) return format.error().within(place);
  const auto wanted = static_cast<std::size_t>(components);
  if (format->components != wanted) {
    return Error(fmt::format("{}: {} components where {} are needed", place, format->components, wanted));
  }
  Result<std::vector<float>> floats = floats_of(model, *item, *format, wanted, 0.0F);
  if (!floats) return floats.error().within(place);
  return floats;
}

Result<std::vector<float>> read_colors(const tinygltf::Model& model, int accessor, float fill) {
  LFD_TRY(const tinygltf::Accessor* item, item_at(model.accessors, accessor, "accessor"));
  const std::string place = fmt::format("accessor {}", accessor);
  const Result<Format> format = format_of(*item);
  if (!format) return format.error().within(place);
  if (format->components != 3 && format->components != 4) {
    return Error(fmt::format("{}: {} components where 3 or 4 are needed", place, format->components));
  }
  Result<std::vector<float>> floats = floats_of(model, *item, *format, 4, fill);
  if (!floats) return floats.error().within(place);
  return floats;
}

Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int accessor) {
  LFD_TRY(const tinygltf::Accessor* item, item_at(model.accessors, accessor, "accessor"));
  const std::string place = fmt::format("accessor {}", accessor);
  const Result<Format> format = format_of(*item);
  if (!format) return format.error().within(place);
  if (format->components != 1 || !is_unsigned_integer(item->componentType)) {
    return Error(place + ": indices must be unsigned integers, one component each");
  }
  std::vector<std::uint32_t> result(item->count, 0);
  const Status read = for_each_element(model, *item, *format, [&](std::size_t element, const unsigned char* from) {
    result[element] = unsigned_integer(from, item->componentType);
  });
  if (!read) return read.error().within(place);
  return result;
}

}  // namespace lfd::scene::gltf
