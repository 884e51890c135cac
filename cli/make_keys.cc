// Who is missing, and a key for each of them.
#include "cli/make_keys.h"

#include <map>

#include "base/file.h"
#include "base/log.h"
#include "base/printable.h"
#include "proto/deployment_keys.h"
#include "proto/key_files.h"
#include "proto/member_name.h"
#include "proto/wire/curve.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

using Members = std::map<std::string, Right>;

Status add(Members& members, const std::string& name, Right right) {
  if (const Status fits = check_member_name(name); !fits)
    return fits.error().within(fmt::format("\"{}\"", printable(name)));
  const auto [known, is_new] = members.emplace(name, right);
  if (is_new || known->second == right) return {};
  return Error(fmt::format("\"{}\" is the name of two members: {} and {}", name,
                           proto::Allowed::Right_Name(known->second), proto::Allowed::Right_Name(right)));
}

Result<Members> members_of(const Deployment& deployment, const KeyHolders& people) {
  Members members;
  LFD_TRY_STATUS(add(members, kControllerKey, proto::Allowed::CONTROLLER));
  LFD_TRY_STATUS(add(members, kDisplayKey, proto::Allowed::DISPLAY));
  for (const NodeShare& node : deployment.nodes) LFD_TRY_STATUS(add(members, node.name, proto::Allowed::NODE));
  for (const std::string& name : people.operators) LFD_TRY_STATUS(add(members, name, proto::Allowed::CONTROL));
  for (const std::string& name : people.viewers) LFD_TRY_STATUS(add(members, name, proto::Allowed::STATUS));
  return members;
}

fs::path key_path(const fs::path& folder, const std::string& name) {
  return folder / fmt::format("{}{}", name, kKeySuffix);
}

}  // namespace

Result<std::vector<std::string>> make_keys(const Deployment& deployment, const KeyHolders& people) {
  const auto folder = keys_folder(deployment);
  if (!folder) return Error("the deployment does not say where its keys are: security { keys: \"keys\" }");
  LFD_TRY(Members members, members_of(deployment, people));
  LFD_TRY_STATUS(make_folder(*folder));
  // From the list's reading to its writing: another process's additions would be lost.
  LFD_TRY(const FolderLock lock, FolderLock::wait(*folder));
  const fs::path list_path = *folder / kAllowFile;
  std::error_code failure;
  AllowList list;
  if (fs::exists(list_path, failure)) {
    LFD_TRY(list, read_allow_list(list_path));
  }
  if (people.operators.empty() && list.with_right(proto::Allowed::CONTROL) == nullptr)
    LFD_TRY_STATUS(add(members, kOperatorKey, proto::Allowed::CONTROL));
  std::vector<std::string> made;
  for (const auto& [name, right] : members) {
    if (const Allowed* known = list.named(name)) {
      if (!known->has(right))
        return Error(fmt::format("{}: \"{}\" is there already, without right {}", list_path.string(), name,
                                 proto::Allowed::Right_Name(right)));
      continue;
    }
    const fs::path path = key_path(*folder, name);
    // Not taken up again: its line may have been removed so that it opens nothing any more.
    if (fs::exists(path, failure)) {
      return Error(fmt::format("{}: is there, and {} does not list it; remove it, and a new key is made", path.string(),
                               list_path.string()));
    }
    LFD_TRY(const proto::KeyFile key, wire::make_key(name));
    LFD_TRY_STATUS(create_key_file(path, key));
    list.members.push_back({name, key.public_key(), {right}});
    if (const Status written = write_allow_list(list_path, list); !written) {
      fs::remove(path, failure);  // nobody would be let in with it
      return written.error();
    }
    made.push_back(name);
  }
  return made;
}

Result<std::vector<std::string>> keys_elsewhere(const fs::path& folder) {
  LFD_TRY(const AllowList list, read_allow_list(folder / kAllowFile));
  std::vector<std::string> names;
  std::error_code failure;
  for (const Allowed& member : list.members) {
    if (!fs::exists(key_path(folder, member.name), failure)) names.push_back(member.name);
  }
  return names;
}

}  // namespace lfd
