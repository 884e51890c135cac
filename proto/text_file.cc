// Protobuf's text format, with errors that name file and line.
#include "proto/text_file.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <vector>

#include "base/file.h"
#include "base/log.h"

namespace lfd {
namespace {

namespace pb = google::protobuf;

// Keeps the first error: those after it are often its consequences.
class FirstError : public pb::io::ErrorCollector {
 public:
  explicit FirstError(std::string file) : file_(std::move(file)) {}

  void AddError(int line, pb::io::ColumnNumber, const std::string& message) override {
    if (!error_)
      error_ = line < 0 ? Error(message).within(file_) : Error(fmt::format("{}:{}: {}", file_, line + 1, message));
  }
  void AddWarning(int, pb::io::ColumnNumber, const std::string&) override {}

  Error error() const { return error_.value_or(Error("cannot be parsed").within(file_)); }

 private:
  std::string file_;
  std::optional<Error> error_;
};

struct Step {
  std::string field;
  int index = 0;
};

// Takes the first step off `road`; absent where it is not a field's name with or without a number.
std::optional<Step> next_step(std::string_view& road) {
  const std::size_t name_end = std::min(road.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), road.size());
  Step step{std::string(road.substr(0, name_end))};
  road.remove_prefix(name_end);
  if (road.size() > 1 && road[0] == ' ') {
    const auto [end, failure] = std::from_chars(road.data() + 1, road.data() + road.size(), step.index);
    if (failure != std::errc() || step.index < 0) return std::nullopt;
    road.remove_prefix(static_cast<std::size_t>(end - road.data()));
  }
  if (road.starts_with(": ")) {
    road.remove_prefix(2);
  } else if (road.starts_with(".")) {
    road.remove_prefix(1);
  } else if (!road.empty()) {
    return std::nullopt;
  }
  return step;
}

// A key of a map that is given twice would silently mean its last value. Right after parsing the entries are still
// those of the text, as many and in their order.
std::optional<Error> key_given_twice(const std::string& file, const pb::Message& message,
                                     const TextPlaces::Tree* tree) {
  const pb::Reflection& reflection = *message.GetReflection();
  std::vector<const pb::FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const pb::FieldDescriptor* field : fields) {
    if (field->cpp_type() != pb::FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
    std::set<std::string> keys;
    for (int i = 0; i < count; ++i) {
      const int index = field->is_repeated() ? i : -1;
      const pb::Message& part = field->is_repeated() ? reflection.GetRepeatedMessage(message, field, i)
                                                     : reflection.GetMessage(message, field);
      if (field->is_map()) {
        std::string key;
        pb::TextFormat::PrintFieldValueToString(part, field->message_type()->map_key(), -1, &key);
        if (keys.insert(key).second) continue;
        const int line = tree == nullptr ? -1 : tree->GetLocation(field, i).line;
        const Error error(fmt::format("{}: key {} is given twice", field->name(), key));
        return line < 0 ? error.within(file) : error.within(fmt::format("{}:{}", file, line + 1));
      }
      const TextPlaces::Tree* below = tree == nullptr ? nullptr : tree->GetTreeForNested(field, index);
      if (auto error = key_given_twice(file, part, below)) return error;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string TextPlaces::of(std::string_view road) const {
  const pb::Descriptor* type = type_;
  const Tree* tree = tree_.get();
  int line = -1;
  while (type != nullptr && tree != nullptr) {
    const auto step = next_step(road);
    const pb::FieldDescriptor* field = step ? type->FindFieldByName(step->field) : nullptr;
    if (field == nullptr) break;
    const int index = field->is_repeated() ? step->index : -1;
    int found = tree->GetLocation(field, index).line;
    // A list in brackets has one place, that of its first element.
    for (int before = index - 1; found < 0 && before >= 0; --before) found = tree->GetLocation(field, before).line;
    if (found < 0) break;
    line = found;
    type = field->message_type();
    tree = type == nullptr ? nullptr : tree->GetTreeForNested(field, index);
  }
  return line < 0 ? file_ : fmt::format("{}:{}", file_, line + 1);
}

Result<TextPlaces> parse_text(std::string_view text, std::string file, pb::Message& message) {
  auto tree = std::make_unique<TextPlaces::Tree>();
  FirstError errors(file);
  pb::TextFormat::Parser parser;
  parser.RecordErrorsTo(&errors);
  parser.WriteLocationsTo(tree.get());
  if (text.size() > kTextFileLimit_bytes)
    return Error(fmt::format("{}: longer than {} bytes", file, kTextFileLimit_bytes));
  pb::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
  if (!parser.Parse(&stream, &message)) return errors.error();
  if (const auto twice = key_given_twice(file, message, tree.get())) return *twice;
  return TextPlaces(std::move(file), message.GetDescriptor(), std::move(tree));
}

Result<TextPlaces> read_text_file(const std::filesystem::path& path, pb::Message& message) {
  LFD_TRY(const std::string text, read_file(path, kTextFileLimit_bytes));
  return parse_text(text, path.string(), message);
}

std::string print_text(const pb::Message& message) {
  std::string text;
  LFD_CHECK(pb::TextFormat::PrintToString(message, &text), "the text format prints every message");
  return fmt::format("# proto-file: {}\n# proto-message: {}\n{}", message.GetDescriptor()->file()->name(),
                     message.GetDescriptor()->full_name(), text);
}

}  // namespace lfd
