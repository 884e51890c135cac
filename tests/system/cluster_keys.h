// A deployment with keys in a test's folder, and keys of those who are not to be trusted.
#pragma once

#include <filesystem>
#include <string>

#include "proto/key_files.h"
#include "tests/harness/workbench.h"

namespace lfd::harness {

// "security { keys: \"keys\" }" is part of the deployment; its members, the operator "ann" and the viewer "guest" have
// keys.
struct KeyedDeployment {
  KeyedDeployment(const Workbench& bench, const std::string& more);

  std::string key(const std::string& name) const { return (folder / (name + ".key")).string(); }

  // The key of one more member, whom the deployment does not name.
  std::string add(const std::string& name, Right right) const;

  // A key that nobody lists, beside the same list.
  std::string stranger() const;
  // guest's key, beside a list that takes another key for the controller's.
  std::string misled_guest() const;

  std::filesystem::path file, folder;
};

}  // namespace lfd::harness
