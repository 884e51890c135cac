// Keys made as a person makes them, and copies with something wrong.
#include "tests/system/cluster_keys.h"

#include "base/check.h"
#include "cli/make_keys.h"
#include "proto/key_files.h"
#include "proto/wire/curve.h"
#include "tests/support/unwrapped.h"

namespace lfd::harness {
namespace fs = std::filesystem;
namespace {

using testing_support::unwrapped;

// A folder beside the keys with one key and a list.
std::string other_folder(const fs::path& folder, const std::string& name, const proto::KeyFile& key,
                         const AllowList& list) {
  const fs::path other = folder.parent_path() / name;
  fs::create_directories(other);
  const fs::path key_path = other / (key.name() + ".key");
  const Status written = create_key_file(key_path, key);
  LFD_CHECK(written, written.error().message());
  const Status listed = write_allow_list(other / kAllowFile, list);
  LFD_CHECK(listed, listed.error().message());
  return key_path.string();
}

}  // namespace

KeyedDeployment::KeyedDeployment(const Workbench& bench, const std::string& more)
    : file(bench.deployment("security { keys: \"keys\" } " + more)), folder(bench.folder() / "keys") {
  unwrapped(make_keys(unwrapped(load_deployment(file)), {.operators = {"ann"}, .viewers = {"guest"}}));
}

std::string KeyedDeployment::add(const std::string& name, Right right) const {
  const proto::KeyFile made = unwrapped(wire::make_key(name));
  AllowList list = unwrapped(read_allow_list(folder / kAllowFile));
  list.members.push_back({name, made.public_key(), {right}});
  const Status written = create_key_file(key(name), made), listed = write_allow_list(folder / kAllowFile, list);
  LFD_CHECK(written && listed, "the folder is the test's own");
  return key(name);
}

std::string KeyedDeployment::stranger() const {
  return other_folder(folder, "stranger", unwrapped(wire::make_key("left")),
                      unwrapped(read_allow_list(folder / kAllowFile)));
}

std::string KeyedDeployment::misled_guest() const {
  AllowList list = unwrapped(read_allow_list(folder / kAllowFile));
  for (Allowed& member : list.members) {
    if (member.has(proto::Allowed::CONTROLLER)) member.public_key = unwrapped(wire::make_key("x")).public_key();
  }
  return other_folder(folder, "misled", unwrapped(read_key_file(folder / "guest.key")), list);
}

}  // namespace lfd::harness
