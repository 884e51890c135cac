// Key files and allow-lists, read, checked and written.
#include "proto/key_files.h"

#include <algorithm>

#include "base/file.h"
#include "base/log.h"
#include "base/secret_file.h"
#include "proto/member_name.h"
#include "proto/text_file.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kKeyLetters = 40;  // of Z85: 32 bytes
constexpr std::string_view kZ85 =
    "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-:+=^!/*?&<>()[]{}@%$#";

Status check_name(const std::string& name) {
  const Status fits = check_member_name(name);
  return fits ? Status() : Status(fits.error().within("name"));
}

// The key itself is not repeated: it may be the secret one in the wrong place.
Status check_key(const char* field, const std::string& key) {
  if (key.size() == kKeyLetters && key.find_first_not_of(kZ85) == key.npos) return {};
  return Error(fmt::format("{}: must be 40 letters of Z85", field));
}

Status check_there(const fs::path& path) {
  std::error_code failure;
  if (fs::exists(path, failure)) return {};
  return Error(fmt::format("{}: no such file; `lfd keys make` makes the keys of a deployment", path.string()));
}

Status check_member(const Allowed& member, const AllowList& before) {
  LFD_TRY_STATUS(check_name(member.name));
  LFD_TRY_STATUS(check_key("public_key", member.public_key));
  if (before.named(member.name) != nullptr) return Error(fmt::format("name: \"{}\" is there already", member.name));
  if (const Allowed* twin = before.with_key(member.public_key))
    return Error(fmt::format("public_key: it is the key of \"{}\" already", twin->name));
  if (member.rights.empty()) return Error("right: at least one is needed");
  for (const Right right : member.rights) {
    if (!proto::Allowed::Right_IsValid(right) || right == proto::Allowed::NONE)
      return Error("right: must be NODE, DISPLAY, CONTROL, STATUS or CONTROLLER");
    const bool alone = right == proto::Allowed::DISPLAY || right == proto::Allowed::CONTROLLER;
    if (const Allowed* other = alone ? before.with_right(right) : nullptr)
      return Error(fmt::format("right: {} is \"{}\" already; one alone is possible", proto::Allowed::Right_Name(right),
                               other->name));
  }
  return {};
}

}  // namespace

bool Allowed::has(Right right) const { return std::ranges::find(rights, right) != rights.end(); }

const Allowed* AllowList::with_key(std::string_view public_key) const {
  const auto found = std::ranges::find(members, public_key, &Allowed::public_key);
  return found == members.end() ? nullptr : &*found;
}

const Allowed* AllowList::named(std::string_view name) const {
  const auto found = std::ranges::find(members, name, &Allowed::name);
  return found == members.end() ? nullptr : &*found;
}

const Allowed* AllowList::with_right(Right right) const {
  const auto found = std::ranges::find_if(members, [right](const Allowed& one) { return one.has(right); });
  return found == members.end() ? nullptr : &*found;
}

Result<proto::KeyFile> read_key_file(const fs::path& path) {
  LFD_TRY_STATUS(check_there(path));
  LFD_TRY_STATUS(check_secret_file(path));
  proto::KeyFile key;
  LFD_TRY(const TextPlaces places, read_text_file(path, key));
  for (const Status& status :
       {check_name(key.name()), check_key("public_key", key.public_key()), check_key("secret_key", key.secret_key())}) {
    if (!status) return places.locate(status.error());
  }
  return key;
}

Status create_key_file(const fs::path& path, const proto::KeyFile& key) {
  return create_secret_file(path, print_text(key));
}

Result<AllowList> read_allow_list(const fs::path& path) {
  LFD_TRY_STATUS(check_there(path));
  LFD_TRY_STATUS(check_trusted_file(path));
  proto::AllowList message;
  LFD_TRY(const TextPlaces places, read_text_file(path, message));
  AllowList list;
  for (int i = 0; i < message.allowed_size(); ++i) {
    const proto::Allowed& m = message.allowed(i);
    Allowed member{m.name(), m.public_key(), {}};
    for (const int right : m.right()) member.rights.push_back(static_cast<Right>(right));
    if (const Status fits = check_member(member, list); !fits)
      return places.locate(fits.error().within(fmt::format("allowed {}", i)));
    list.members.push_back(std::move(member));
  }
  return list;
}

Status write_allow_list(const fs::path& path, const AllowList& list) {
  proto::AllowList message;
  for (const Allowed& member : list.members) {
    proto::Allowed& m = *message.add_allowed();
    m.set_name(member.name);
    m.set_public_key(member.public_key);
    for (const Right right : member.rights) m.add_right(right);
  }
  LFD_TRY_STATUS(write_file(path, print_text(message)));
  // Whatever the umask says: a list that others may write to is refused.
  std::error_code failure;
  fs::permissions(path, fs::perms::group_write | fs::perms::others_write, fs::perm_options::remove, failure);
  if (failure) return Error(fmt::format("{}: {}", path.string(), failure.message()));
  return {};
}

Result<KeyRing> read_key_ring(const fs::path& key_file) {
  LFD_TRY(proto::KeyFile own, read_key_file(key_file));
  LFD_TRY(AllowList allowed, read_allow_list(key_file.parent_path() / kAllowFile));
  return KeyRing{std::move(own), std::move(allowed)};
}

Result<fs::path> find_operator_key(const fs::path& folder) {
  LFD_TRY(const AllowList list, read_allow_list(folder / kAllowFile));
  std::error_code failure;
  for (const Allowed& member : list.members) {
    const fs::path path = folder / fmt::format("{}{}", member.name, kKeySuffix);
    if (member.has(proto::Allowed::CONTROL) && fs::exists(path, failure)) return path;
  }
  return Error(
      fmt::format("{}: there is no key of anybody who may change the show (right CONTROL); `lfd keys make "
                  "DEPLOYMENT --operator NAME` makes one",
                  folder.string()));
}

std::string rights_text(const Allowed& member) {
  std::vector<std::string> names;
  for (const Right right : member.rights) names.push_back(proto::Allowed::Right_Name(right));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace lfd
