// Holds the rules for sources against the sources: who includes whom, which library enters where, how files begin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "base/log.h"

namespace lfd {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

// Which folder may include which, beside itself. A prefix without a slash is a whole folder.
const std::map<std::string, std::vector<std::string>>& allowed_includes() {
  static const std::vector<std::string> kAll{"base",    "bench",      "calibration", "cli",   "controller",
                                             "display", "rendernode", "shaders",     "proto", "tests"};
  static const std::map<std::string, std::vector<std::string>> kAllowed{
      {"base", {}},
      {"calibration", {"base"}},
      {"proto", {"base", "calibration"}},
      {"controller", {"base", "proto", "calibration"}},
      {"rendernode", {"base", "proto", "calibration", "shaders/shared/", "shaders/embedded.h"}},
      {"display", {"base", "proto", "calibration"}},
      {"cli", {"base", "proto", "calibration", "bench"}},
      {"shaders", {}},
      {"bench", kAll},
      {"tests", kAll},
  };
  return kAllowed;
}

// A library's headers, and the only places where they enter. Tests may go round: they look behind every door.
struct Door {
  std::vector<std::string> headers;  // prefixes
  std::vector<std::string> places;   // prefixes of paths; {}: anywhere
};

const std::vector<Door>& doors() {
  static const std::vector<Door> kDoors{
      {{"CLI/"}, {"base/command_line.h"}},
      {{"spdlog/"}, {"base/log.cc"}},
      {{"fmt/"}, {"base/log.h"}},
      {{"xxhash.h"}, {"base/hash.cc"}},
      {{"prometheus/"}, {"base/metric_server.cc"}},
      {{"systemd/"}, {"base/service.cc"}},
      {{"malloc.h"}, {"base/large_blocks.cc"}},
      {{"zmq"}, {"proto/wire/", "bench/stream/plain_pair.cc"}},
      {{"google/protobuf/text_format.h", "google/protobuf/io/tokenizer.h", "google/protobuf/descriptor.h"},
       {"proto/text_file.", "bench/stability/message_fields.cc"}},
      {{"google/protobuf/"}, {"proto/", "bench/stability/message_fields.h"}},
      {{"png.h"}, {"proto/pictures/png.cc"}},
      {{"jpeglib.h", "jerror.h"}, {"proto/pictures/jpeg.cc"}},
      {{"turbojpeg.h"}, {"proto/images/turbo_jpeg.cc"}},
      {{"zstd.h"}, {"proto/images/zstd.cc"}},
      {{"Imf", "Imath"}, {"proto/pictures/exr.cc"}},
      {{"yaml-cpp/"}, {"calibration/import/lfdisplay_yaml.cc"}},
      {{"zip.h"}, {"calibration/import/zip_archive.cc"}},
      {{"pugixml.hpp"}, {"calibration/import/mpcdi_xml"}},
      {{"nlohmann/"},
       {"calibration/import/holovizio_json.cc", "cli/fit_report.cc", "cli/lfd_calibrate_check_json.cc", "cli/report.cc",
        "bench/ao/print_json.cc", "bench/frame/print_json.cc", "bench/map/map_print.cc",
        "bench/stability/print_json.cc"}},
      {{"ceres/", "Eigen/"}, {"calibration/fit/"}},
      {{"tiny_gltf.h"}, {"controller/scene/gltf/"}},
      {{"embree3/"}, {"bench/reference/intersector.cc"}},
      {{"epoxy/"}, {"rendernode/gl/"}},
      {{"gtest/", "gmock/"}, {"tests/"}},
      {{"glm/"}, {}},
      // The operating system.
      {{"unistd.h", "fcntl.h", "poll.h", "signal.h", "stdlib.h", "sys/", "netinet/", "arpa/", "linux/"}, {}},
  };
  return kDoors;
}

constexpr std::size_t kMostLines = 300;

// Files that may name a place of the machine, and why.
const std::map<std::string, std::string>& placed_files() {
  static const std::map<std::string, std::string> kPlaced{
      {"cli/runtime_file.cc", "where there is no XDG_RUNTIME_DIR, every process must find the same folder"},
  };
  return kPlaced;
}

struct Source {
  std::string path;  // relative to the repository
  std::string folder;
  std::vector<std::string> lines;

  bool is_shader() const { return folder == "shaders" && !path.ends_with(".h"); }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

bool is_source(const fs::path& path) {
  static const std::set<std::string> kSuffixes{".h",    ".cc",   ".proto", ".glsl", ".vert",
                                               ".frag", ".comp", ".tesc",  ".tese"};
  return kSuffixes.contains(path.extension().string());
}

// All sources below the repository's own folders, in the order of their paths.
const std::vector<Source>& sources() {
  static const std::vector<Source> kSources = [] {
    std::vector<Source> found;
    const fs::path root = LFD_SOURCE_DIR;
    for (const auto& folder : fs::directory_iterator(root)) {
      const std::string name = folder.path().filename().string();
      if (!folder.is_directory() || name.starts_with(".") || name == "build" || name == "out") continue;
      for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
        if (!entry.is_regular_file() || !is_source(entry.path())) continue;
        const auto text = read_file(entry.path());
        LFD_CHECK(text, text.error().message());
        found.push_back({fs::relative(entry.path(), root).generic_string(), name, lines_of(*text)});
      }
    }
    std::ranges::sort(found, {}, &Source::path);
    return found;
  }();
  return kSources;
}

struct Include {
  std::string header;
  bool is_quoted = false;
};

std::vector<Include> includes_of(const Source& source) {
  std::vector<Include> includes;
  constexpr std::string_view kWord = "#include ";
  for (const std::string& line : source.lines) {
    if (!line.starts_with(kWord) || line.size() < kWord.size() + 2) continue;
    const char close = line[kWord.size()] == '<' ? '>' : '"';
    const std::size_t begin = kWord.size() + 1;
    includes.push_back({line.substr(begin, line.find(close, begin) - begin), close == '"'});
  }
  return includes;
}

bool begins_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) { return text.starts_with(prefix); });
}

bool may_include(const std::string& folder, const std::string& header) {
  const auto allowed = allowed_includes().find(folder);
  if (allowed == allowed_includes().end()) return false;
  if (header.starts_with(folder + "/")) return true;
  return std::ranges::any_of(allowed->second, [&](const std::string& place) {
    return header.starts_with(place.find('/') == std::string::npos ? place + "/" : place);
  });
}

// The first door whose headers these are; null for the standard library (a name without dot or slash).
const Door* door_of(const std::string& header) {
  const auto door = std::ranges::find_if(doors(), [&](const Door& d) { return begins_with_any(header, d.headers); });
  return door == doors().end() ? nullptr : &*door;
}

TEST(Architecture, FindsTheSources) {
  EXPECT_GT(sources().size(), 200U);
  const auto has = [](const char* path) { return std::ranges::count(sources(), path, &Source::path) == 1; };
  EXPECT_TRUE(has("base/result.h"));
  EXPECT_TRUE(has("rendernode/renderer.cc"));
  EXPECT_TRUE(has("shaders/ao/sphere.frag"));
  EXPECT_TRUE(has("tests/unit/architecture_test.cc"));
}

TEST(Architecture, EveryFolderIsInTheTable) {
  for (const Source& source : sources()) EXPECT_TRUE(allowed_includes().contains(source.folder)) << source.path;
}

TEST(Architecture, IncludesFlowDownhill) {
  std::vector<std::string> broken;
  for (const Source& source : sources()) {
    if (source.is_shader()) continue;  // they have an include path of their own
    for (const Include& include : includes_of(source)) {
      if (include.is_quoted && !may_include(source.folder, include.header)) {
        broken.push_back(source.path + " includes " + include.header);
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Architecture, TheTableIsClosed) {
  EXPECT_FALSE(may_include("controller", "rendernode/renderer.h"));
  EXPECT_FALSE(may_include("rendernode", "display/viewer.h"));
  EXPECT_FALSE(may_include("rendernode", "shaders/lib/optics.glsl"));
  EXPECT_FALSE(may_include("display", "controller/stage.h"));
  EXPECT_FALSE(may_include("cli", "rendernode/renderer.h"));
  EXPECT_FALSE(may_include("base", "proto/settings.h"));
  EXPECT_FALSE(may_include("calibration", "proto/calibration.pb.h"));
  EXPECT_FALSE(may_include("proto", "settings.h"));  // every header by its whole path
}

TEST(Architecture, EveryLibraryEntersByItsDoor) {
  std::vector<std::string> broken;
  for (const Source& source : sources()) {
    if (source.folder == "tests") continue;
    for (const Include& include : includes_of(source)) {
      if (include.is_quoted || include.header.find_first_of("./") == std::string::npos) continue;
      const Door* door = door_of(include.header);
      if (door == nullptr) {
        broken.push_back(source.path + " includes <" + include.header + ">, which has no door yet");
      } else if (!door->places.empty() && !begins_with_any(source.path, door->places)) {
        broken.push_back(source.path + " includes <" + include.header + ">, whose door is " + door->places[0]);
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Architecture, EveryDoorIsUsed) {
  for (const Door& door : doors()) {
    for (const std::string& place : door.places) {
      const bool used = std::ranges::any_of(sources(), [&](const Source& source) {
        return source.path.starts_with(place) && std::ranges::any_of(includes_of(source), [&](const Include& include) {
                 return !include.is_quoted && door_of(include.header) == &door;
               });
      });
      EXPECT_TRUE(used) << place << " no longer includes " << door.headers[0];
    }
  }
}

TEST(Architecture, EveryFileBeginsWithItsSentence) {
  for (const Source& source : sources()) {
    ASSERT_FALSE(source.lines.empty()) << source.path;
    EXPECT_TRUE(source.lines[0].starts_with("// ")) << source.path << ": " << source.lines[0];
  }
}

TEST(Architecture, FilesAreShort) {
  for (const Source& source : sources()) {
    EXPECT_LE(source.lines.size(), kMostLines) << source.path;
  }
}

TEST(Architecture, NothingIsLeftToDo) {
  for (const Source& source : sources()) {
    for (const std::string& line : source.lines) {
      for (const std::string& word : {std::string("TO") + "DO", std::string("FIX") + "ME"}) {
        EXPECT_EQ(line.find(word), std::string::npos) << source.path << ": " << line;
      }
    }
  }
}

TEST(Architecture, NoFileNamesAPlaceOfTheMachine) {
  for (const Source& source : sources()) {
    if (source.folder == "tests" || placed_files().contains(source.path)) continue;
    for (const std::string& line : source.lines) {
      for (const char* const place : {"\"/work", "\"/home", "\"/root", "\"/tmp", "\"/usr", "\"/opt"}) {
        EXPECT_EQ(line.find(place), std::string::npos) << source.path << ": " << line;
      }
    }
  }
}

// Whether a line of code starts a program in a way that goes through a shell or looks for it on the PATH.
bool calls_a_shell(const std::string& line) {
  static const std::regex kCall(
      R"((^|[^A-Za-z0-9_.>])(system|popen|wordexp|execlp?|execle|execv|execvpe?|posix_spawnp?)\s*\(|"(/bin/)?(ba)?sh")");
  return std::regex_search(line, kCall);
}

// Programs are started by base/process.cc, with their arguments as they are.
TEST(Architecture, NoShellIsEverCalled) {
  for (const char* const line : {"std::system(command)", "  FILE* pipe = popen(text, \"r\");", "::execvp(a, b);",
                                 "start({\"/bin/sh\", \"-c\", text})", "wordexp (word, &out, 0)"})
    EXPECT_TRUE(calls_a_shell(line)) << line;
  for (const char* const line :
       {"::execve(arguments[0], arguments, environment);", "file_system(path)", "the.system(3)"})
    EXPECT_FALSE(calls_a_shell(line)) << line;
  for (const Source& source : sources()) {
    if (source.folder == "tests") continue;
    for (const std::string& line : source.lines) EXPECT_FALSE(calls_a_shell(line)) << source.path << ": " << line;
  }
}

}  // namespace
}  // namespace lfd
