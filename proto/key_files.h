// Keys of a deployment as files (schema: proto/keys.proto): each member's own, and the list of those who are let in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "proto/keys.pb.h"

namespace lfd {

inline constexpr std::string_view kAllowFile = "allow.textproto";
inline constexpr std::string_view kKeySuffix = ".key";
inline constexpr const char *kControllerKey = "controller", *kDisplayKey = "display", *kOperatorKey = "operator";

using Right = proto::Allowed::Right;

// One member that is let in.
struct Allowed {
  std::string name;
  std::string public_key;  // Z85
  std::vector<Right> rights;

  bool has(Right right) const;
};

// Who is let in; names and keys are unique, and one member at most is the controller, one the display.
struct AllowList {
  std::vector<Allowed> members;

  // Null where there is none.
  const Allowed* with_key(std::string_view public_key) const;
  const Allowed* named(std::string_view name) const;
  const Allowed* with_right(Right right) const;  // the first
};

// What a process that takes part has to know.
struct KeyRing {
  proto::KeyFile own;
  AllowList allowed;
};

// Key files whose mode lets anybody but their owner in are refused.
Result<proto::KeyFile> read_key_file(const std::filesystem::path& path);
// Mode 0600. What exists is not overwritten.
Status create_key_file(const std::filesystem::path& path, const proto::KeyFile& key);

// Errors name file, line and field.
Result<AllowList> read_allow_list(const std::filesystem::path& path);
Status write_allow_list(const std::filesystem::path& path, const AllowList& list);

// A key file, and the allow-list that lies beside it.
Result<KeyRing> read_key_ring(const std::filesystem::path& key_file);

// The key file of the first member that may change the show and whose key lies in the folder.
Result<std::filesystem::path> find_operator_key(const std::filesystem::path& folder);

// "NODE, STATUS".
std::string rights_text(const Allowed& member);

}  // namespace lfd
