// Who is missing, and a key for each of them.
#include "cli/make_keys.h"

#include <map>

#include "base/file.h"
#include "base/log.h"
#include "proto/deployment_keys.h"
#include "proto/key_files.h"
#include "proto/wire/curve.h"

namespace lfd {
namespace fs = std::filesystem;
namespace {

using Members = std::map<std::string, Right>;

Result<Members> members_of(const Deployment& deployment, const KeyHolders& people, const AllowList& there) {
  Members members;
  const auto add = [&](const std::string& name, Right right) -> Status {
    const auto [known, is_new] = members.emplace(name, right);
    if (!is_new && known->second != right)
      return Error(fmt::format("\"{}\" is the name of two members: {} and {}", name,
                               proto::Allowed::Right_Name(known->second), proto::Allowed::Right_Name(right)));
    return {};
  };
  LFD_TRY_STATUS(add(kControllerKey, proto::Allowed::CONTROLLER));
  LFD_TRY_STATUS(add(kDisplayKey, proto::Allowed::DISPLAY));
  for (const NodeShare& node : deployment.nodes) LFD_TRY_STATUS(add(node.name, proto::Allowed::NODE));
  for (const std::string& name : people.operators) LFD_TRY_STATUS(add(name, proto::Allowed::CONTROL));
  for (const std::string& name : people.viewers) LFD_TRY_STATUS(add(name, proto::Allowed::STATUS));
  if (people.operators.empty() && there.with_right(proto::Allowed::CONTROL) == nullptr)
    LFD_TRY_STATUS(add(kOperatorKey, proto::Allowed::CONTROL));
  return members;
}

}  // namespace

Result<std::vector<std::string>> make_keys(const Deployment& deployment, const KeyHolders& people) {
  const auto folder = keys_folder(deployment);
  if (!folder) return Error("the deployment does not say where its keys are: security { keys: \"keys\" }");
  LFD_TRY_STATUS(make_folder(*folder));
  const fs::path list_path = *folder / kAllowFile;
  std::error_code failure;
  AllowList list;
  if (fs::exists(list_path, failure)) {
    LFD_TRY(list, read_allow_list(list_path));
  }
  LFD_TRY(const Members members, members_of(deployment, people, list));
  std::vector<std::string> made;
  for (const auto& [name, right] : members) {
    if (const Allowed* known = list.named(name)) {
      if (!known->has(right))
        return Error(fmt::format("{}: \"{}\" is there already, without right {}", list_path.string(), name,
                                 proto::Allowed::Right_Name(right)));
      continue;
    }
    const fs::path key_path = *folder / fmt::format("{}{}", name, kKeySuffix);
    // Not taken up again: its line may have been removed so that it opens nothing any more.
    if (fs::exists(key_path, failure)) {
      return Error(fmt::format("{}: is there, and {} does not list it; remove it, and a new key is made",
                               key_path.string(), list_path.string()));
    }
    LFD_TRY(const proto::KeyFile key, wire::make_key(name));
    LFD_TRY_STATUS(create_key_file(key_path, key));
    list.members.push_back({name, key.public_key(), {right}});
    if (const Status written = write_allow_list(list_path, list); !written) {
      fs::remove(key_path, failure);  // nobody would be let in with it
      return written.error();
    }
    made.push_back(name);
  }
  return made;
}

}  // namespace lfd
