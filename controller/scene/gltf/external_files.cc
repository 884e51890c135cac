// Files from a scene's own folder.
#include "controller/scene/gltf/external_files.h"

#include <algorithm>
#include <system_error>

#include "base/file.h"
#include "base/log.h"

namespace lfd::scene::gltf {
namespace fs = std::filesystem;

namespace {

bool is_inside(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// tinygltf looks for `name` and then for `./name`.
std::string plain_name(const std::string& name) { return name.starts_with("./") ? name.substr(2) : name; }

}  // namespace

Result<fs::path> ExternalFiles::resolve(const std::string& name) const {
  const fs::path relative = fs::path(name).lexically_normal();
  if (name.find('\0') != std::string::npos) return Error("the name is no file's");
  if (relative.is_absolute() || (!relative.empty() && *relative.begin() == "..")) {
    return Error("leaves the scene's folder");
  }
  std::error_code failure;
  const fs::path folder = fs::canonical(folder_, failure);
  if (failure) return Error(failure.message());
  const fs::path path = fs::canonical(folder / relative, failure);
  if (failure) return Error(failure.message());
  if (!is_inside(folder, path)) return Error("leaves the scene's folder");
  if (!fs::is_regular_file(path, failure)) return Error("is not a regular file");
  return path;
}

bool ExternalFiles::exists(const std::string& name) {
  const Result<fs::path> path = resolve(plain_name(name));
  if (!path) refused_[plain_name(name)] = path.error().message();
  return static_cast<bool>(path);
}

bool ExternalFiles::read(const std::string& name, std::vector<unsigned char>& content, std::string& reason) {
  const Result<fs::path> path = resolve(plain_name(name));
  const Result<std::string> bytes = path ? read_file(*path) : Result<std::string>(path.error());
  if (bytes) {
    content.assign(bytes->begin(), bytes->end());
    return true;
  }
  reason = bytes.error().message();
  refused_[plain_name(name)] = reason;
  return false;
}

tinygltf::FsCallbacks ExternalFiles::callbacks() {
  tinygltf::FsCallbacks result{};
  result.FileExists = [](const std::string& name, void* self) {
    return static_cast<ExternalFiles*>(self)->exists(name);
  };
  result.ExpandFilePath = [](const std::string& name, void*) { return name; };
  result.ReadWholeFile = [](std::vector<unsigned char>* content, std::string* reason, const std::string& name,
                            void* self) { return static_cast<ExternalFiles*>(self)->read(name, *content, *reason); };
  result.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  result.user_data = this;
  return result;
}

}  // namespace lfd::scene::gltf
