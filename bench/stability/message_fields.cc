// Walking messages.
#include "bench/stability/message_fields.h"

#include <google/protobuf/descriptor.h>

#include <array>
#include <cfloat>
#include <limits>
#include <memory>
#include <set>

#include "base/log.h"

namespace lfd::bench {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Not numbers, too large for double or float arithmetic, too small for it, of the wrong sign, or zero.
constexpr std::array kBadNumbers{kNaN,   kInfinity, -kInfinity, DBL_MAX, -DBL_MAX, 1e300, -1e300, 1e200,
                                 -1e200, 1e39,      -1e39,      1e30,    -1e30,    1e12,  -1e12,  1e7,
                                 -1e7,   1e-7,      -1e-7,      1e-12,   -1e-12,   1e-30, -1e-30, 1e-40,
                                 -1e-40, DBL_MIN,   -DBL_MIN,   5e-324,  -5e-324,  0.0,   -0.0,   -1.0};
constexpr std::array kBadIntegers{std::numeric_limits<int>::min(), -1, 0, 1, 1000000, std::numeric_limits<int>::max()};

constexpr int kMostElements = 16;  // of a repeated field: of longer ones three stand for all

struct Step {
  const FieldDescriptor* field;
  int index;  // of a repeated field, else -1
};
using Road = std::vector<Step>;

Message& parent_of(Message& message, const Road& road) {
  Message* at = &message;
  for (std::size_t i = 0; i + 1 < road.size(); ++i) {
    const auto* reflection = at->GetReflection();
    const auto [field, index] = road[i];
    at = index < 0 ? reflection->MutableMessage(at, field) : reflection->MutableRepeatedMessage(at, field, index);
  }
  return *at;
}

void set_number(Message& parent, Step last, double value) {
  const auto* reflection = parent.GetReflection();
  const auto [field, index] = last;
  const bool is_float = field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT;
  if (index < 0) {
    is_float ? reflection->SetFloat(&parent, field, static_cast<float>(value))
             : reflection->SetDouble(&parent, field, value);
  } else {
    is_float ? reflection->SetRepeatedFloat(&parent, field, index, static_cast<float>(value))
             : reflection->SetRepeatedDouble(&parent, field, index, value);
  }
}

void set_integer(Message& parent, Step last, int value) {
  const auto* reflection = parent.GetReflection();
  switch (last.field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection->SetInt32(&parent, last.field, value);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection->SetUInt32(&parent, last.field, static_cast<std::uint32_t>(value));
    default:
      return reflection->SetEnumValue(&parent, last.field, value);
  }
}

bool is_real(const FieldDescriptor* field) {
  return field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE || field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT;
}

bool is_integer(const FieldDescriptor* field) {
  return !field->is_repeated() &&
         (field->cpp_type() == FieldDescriptor::CPPTYPE_INT32 || field->cpp_type() == FieldDescriptor::CPPTYPE_UINT32 ||
          field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM);
}

std::string text_of(const Road& road) {
  std::string text;
  for (const auto& [field, index] : road) {
    if (!text.empty()) text += ": ";
    text += field->name();
    if (index >= 0) text += fmt::format(" {}", index);
  }
  return text;
}

NumberField spoil(const Message& message, const Road& road) {
  NumberField field{text_of(road), {road.back().field->name()}, {}};
  if (road.size() > 1) field.words.push_back(road[road.size() - 2].field->name());
  const auto copy = [&] {
    std::shared_ptr<Message> made(message.New());
    made->CopyFrom(message);
    return made;
  };
  if (is_real(road.back().field)) {
    for (const double value : kBadNumbers) {
      field.spoilt.push_back({fmt::format("{}", value), copy()});
      set_number(parent_of(*field.spoilt.back().message, road), road.back(), value);
    }
  } else {
    for (const int value : kBadIntegers) {
      field.spoilt.push_back({fmt::format("{}", value), copy()});
      set_integer(parent_of(*field.spoilt.back().message, road), road.back(), value);
    }
  }
  return field;
}

// Indices of a field's elements that are looked at; -1 for a field that is not repeated.
std::set<int> indices_of(const Message& parent, const FieldDescriptor* field) {
  if (!field->is_repeated()) return {-1};
  const int count = parent.GetReflection()->FieldSize(parent, field);
  if (count == 0) return {};
  if (count > kMostElements) return {0, count / 2, count - 1};
  std::set<int> indices;
  for (int i = 0; i < count; ++i) indices.insert(i);
  return indices;
}

void walk(const Message& message, const Message& at, Road& road, std::vector<NumberField>& found) {
  const auto* reflection = at.GetReflection();
  for (int i = 0; i < at.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = at.GetDescriptor()->field(i);
    for (const int index : indices_of(at, field)) {
      road.push_back({field, index});
      if (is_real(field) || is_integer(field)) {
        found.push_back(spoil(message, road));
      } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
        if (index >= 0) {
          walk(message, reflection->GetRepeatedMessage(at, field, index), road, found);
        } else if (reflection->HasField(at, field)) {
          walk(message, reflection->GetMessage(at, field), road, found);
        }
      }
      road.pop_back();
    }
  }
}

}  // namespace

std::vector<NumberField> number_fields(const Message& message) {
  std::vector<NumberField> found;
  Road road;
  walk(message, message, road, found);
  return found;
}

}  // namespace lfd::bench
