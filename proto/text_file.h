// Protobuf text files (*.textproto) read into messages, with the line on which every field stands.
#pragma once

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace lfd {

// Text files are written by people or by our tools; nothing of theirs is larger.
inline constexpr std::size_t kTextFileLimit_bytes = std::size_t{64} << 20;

// Knows where the fields of a message stood in the text it was parsed from, so that later checks can name a line.
class TextPlaces {
 public:
  using Tree = google::protobuf::TextFormat::ParseInfoTree;

  TextPlaces(std::string file, const google::protobuf::Descriptor* type, std::unique_ptr<const Tree> tree)
      : file_(std::move(file)), type_(type), tree_(std::move(tree)) {}

  // "file:line" of the field that `road` leads to. A road is the beginning of an error message: steps "field" or "field
  // index", parted by ": " or ".", as in "module 3: pinhole: focal_u_px: 0 must be positive". It is followed as far as
  // its steps name fields that the text has; where not even the first does, the answer is "file".
  std::string of(std::string_view road) const;

  // `error`, whose message begins with its road, with the place put before it: "wall.textproto:14: module 3: ...".
  Error locate(const Error& error) const { return error.within(of(error.message())); }

 private:
  std::string file_;
  const google::protobuf::Descriptor* type_;
  std::unique_ptr<const Tree> tree_;
};

// Parses `text` into `message`, which is cleared first. Syntax errors, unknown fields, and fields and keys given twice, are errors
// that begin with "file:line: ".
Result<TextPlaces> parse_text(std::string_view text, std::string file, google::protobuf::Message& message);

// The same from a file of at most kTextFileLimit_bytes.
Result<TextPlaces> read_text_file(const std::filesystem::path& path, google::protobuf::Message& message);

// Text that parses to an equal message: doubles have as many digits (at most 17) as that needs. Its first lines name
// the schema.
std::string print_text(const google::protobuf::Message& message);

}  // namespace lfd
