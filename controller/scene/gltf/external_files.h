// The files that a glTF file names: read from its own folder, never from outside.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"

namespace lfd::scene::gltf {

class ExternalFiles {
 public:
  explicit ExternalFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Callbacks for tinygltf; they refer to this object.
  tinygltf::FsCallbacks callbacks();

  // What was asked for and not given: why, by decoded URI.
  const std::map<std::string, std::string>& refused() const { return refused_; }

 private:
  // The real path of a file inside the folder, links followed.
  Result<std::filesystem::path> resolve(const std::string& name) const;
  bool exists(const std::string& name);
  bool read(const std::string& name, std::vector<unsigned char>& content, std::string& reason);

  std::filesystem::path folder_;
  std::map<std::string, std::string> refused_;
};

}  // namespace lfd::scene::gltf
