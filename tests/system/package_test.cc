// The Debian package: built from the programs that are here, installed into a root of its own, run from there, removed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "base/file.h"
#include "base/log.h"
#include "base/temporary_folder.h"
#include "proto/deployment_file.h"
#include "tests/system/running_cluster.h"

namespace lfd::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

const std::vector<std::string> kPrograms{"lfd",         "lfd-calibrate",  "lfd-controller",
                                         "lfd-display", "lfd-rendernode", "lfd-scene"};

// What a program prints; a failure of the test where it fails.
std::vector<std::string> lines_of(std::vector<std::string> command) {
  command.insert(command.begin(), "/usr/bin/env");  // it looks programs up in PATH
  auto process =
      Process::start({.name = command[1], .command = command, .on_line = {}, .environment = {{"LC_ALL", "C"}}});
  LFD_CHECK(process, process.error().message());
  const auto exit = (*process)->wait(kClusterPatience);
  const std::vector<std::string> lines = (*process)->lines();
  EXPECT_TRUE(exit && exit->succeeded()) << testing::PrintToString(command) << testing::PrintToString(lines);
  return lines;
}

bool is_there(const std::string& program) {
  auto process = Process::start({.name = program,
                                 .command = {"/usr/bin/env", "sh", "-c", "command -v " + program},
                                 .on_line = {},
                                 .environment = {}});
  const auto exit = process ? (*process)->wait(kClusterPatience) : std::nullopt;
  return exit && exit->succeeded();
}

std::vector<std::string> words_of(const std::string& text, const std::string& separators) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (separators.find(c) == separators.npos)
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  return words;
}

// Packages of a field of dependencies; of alternatives all.
std::set<std::string> packages_in(const std::string& field) {
  std::set<std::string> packages;
  for (const std::string& one : words_of(field, ",|")) packages.insert(words_of(one, " (")[0]);
  return packages;
}

// The libraries that a program names itself, as ldd finds them; those of libraries are their packages' matter.
std::set<std::string> libraries_of(const fs::path& program) {
  std::set<std::string> named, found;
  for (const std::string& line : lines_of({"objdump", "-p", program})) {
    const auto words = words_of(line, " ");
    if (words.size() >= 2 && words[0] == "NEEDED") named.insert(words[1]);
  }
  for (const std::string& line : lines_of({"ldd", program})) {
    EXPECT_THAT(line, Not(HasSubstr("not found"))) << program;
    const auto words = words_of(line, " \t");
    if (words.size() >= 3 && named.contains(words[0])) found.insert(words[2]);
  }
  return found;
}

// Packages that the libraries are of, and what those provide; for a library of none its path. dpkg knows a library by
// its path on a system where /lib was a folder, or by today's.
std::set<std::string> packages_of(const std::set<std::string>& libraries, std::set<std::string>& provided) {
  std::vector<std::string> command{"sh", "-c", "dpkg -S \"$@\" 2>/dev/null || true", "dpkg"};
  for (const fs::path library : libraries)
    for (const fs::path& path : {library, fs::canonical(library), fs::path("/usr" + library.string())})
      command.push_back(path);
  std::map<std::string, std::string> package_of;  // by file name
  for (const std::string& line : lines_of(command)) {
    const auto words = words_of(line, ": ");
    package_of[fs::path(words.back()).filename()] = words[0];
  }
  std::set<std::string> packages;
  for (const fs::path library : libraries) {
    const auto name = fs::canonical(library).filename(), link = library.filename();
    packages.insert(package_of.contains(link)   ? package_of[link]
                    : package_of.contains(name) ? package_of[name]
                                                : library.string());
  }
  command = {"dpkg-query", "-W", "-f", "${Provides}, "};
  command.insert(command.end(), packages.begin(), packages.end());
  provided = packages_in(lines_of(command).at(0));
  return packages;
}

class Package : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {"dpkg", "dpkg-deb", "dpkg-shlibdeps", "objdump", "ldd"})
      if (!is_there(tool)) GTEST_SKIP() << tool << " is missing";
    lines_of({LFD_CPACK, "--config", LFD_BUILD_DIR "/CPackConfig.cmake", "-G", "DEB", "-B", folder.path() / "built"});
    for (const auto& entry : fs::directory_iterator(folder.path() / "built"))
      if (entry.path().extension() == ".deb") package = entry.path();
    ASSERT_THAT(package.filename().string(), StartsWith("lfd_"));
  }

  // Folders end in a slash.
  std::set<std::string> entries() const {
    std::set<std::string> entries;
    for (const std::string& line : lines_of({"dpkg-deb", "-c", package})) {
      const auto words = words_of(line, " ");
      EXPECT_EQ(words.at(1), "root/root") << line;
      if (words.at(5) != "./") entries.insert(words.at(5).substr(1));
    }
    return entries;
  }

  std::string field(const std::string& name) const { return lines_of({"dpkg-deb", "-f", package, name}).at(0); }

  std::vector<std::string> dpkg(std::vector<std::string> more) const {
    std::vector<std::string> command{"dpkg", "--root=" + root.string(), "--force-not-root,depends,bad-path",
                                     "--force-script-chrootless"};
    command.insert(command.end(), more.begin(), more.end());
    return lines_of(command);
  }

  void install() const {
    fs::create_directories(root / "var/lib/dpkg/info");
    fs::create_directories(root / "var/lib/dpkg/updates");
    fs::create_directories(root / "etc");
    for (const char* list : {"status", "available"}) ASSERT_TRUE(write_file(root / "var/lib/dpkg" / list, ""));
    dpkg({"-i", package});
  }

  void expect_files() const;
  void expect_dependencies() const;  // it is installed
  void expect_to_run() const;
  void expect_to_go() const;

  const TemporaryFolder folder = *TemporaryFolder::make("lfd-package");
  const fs::path root = folder.path() / "root";
  fs::path package;
};

void Package::expect_files() const {
  std::set<std::string> files = entries();
  for (auto entry = files.begin(); entry != files.end(); ++entry) {
    if (!entry->ends_with("/")) continue;
    const auto next = std::next(entry);  // in the order of paths: the folder's first file
    EXPECT_TRUE(next != files.end() && next->starts_with(*entry)) << *entry << " is empty";
  }
  std::erase_if(files, [](const std::string& entry) { return entry.ends_with("/"); });
  std::vector<std::string> expected{"/etc/lfd/deployment.textproto",
                                    "/lib/systemd/system/lfd-controller.service",
                                    "/lib/systemd/system/lfd-display.service",
                                    "/lib/systemd/system/lfd-rendernode@.service",
                                    "/usr/lib/sysusers.d/lfd.conf",
                                    "/usr/share/doc/lfd/README.md",
                                    "/usr/share/doc/lfd/copyright",
                                    "/usr/share/doc/lfd/bench/results/ao-llvmpipe-Sponza.svg",
                                    "/usr/share/doc/lfd/docs/metrics.md",
                                    "/usr/share/doc/lfd/proto/README.md",
                                    "/usr/share/lfd/configs/displays/c80.textproto",
                                    "/usr/share/lfd/configs/grafana/lfd.json",
                                    "/usr/share/lfd/proto/deployment.proto",
                                    "/usr/share/lfd/shaders/ao/sphere.frag",
                                    "/usr/share/lfd/shaders/shared/ao_params.glsl"};
  for (const std::string& program : kPrograms) expected.push_back("/usr/bin/" + program);
  const auto measured = std::regex("`?(bench/results/[a-z0-9-]+[.]md)`?");
  const std::string readme = *read_file(LFD_SOURCE_DIR "/README.md");
  for (std::sregex_iterator named(readme.begin(), readme.end(), measured), end; named != end; ++named)
    expected.push_back("/usr/share/doc/lfd/" + named->str(1));
  EXPECT_THAT(files, IsSupersetOf(expected));
  for (const std::string& file : files) {
    EXPECT_THAT(file, AllOf(Not(HasSubstr("test")), Not(HasSubstr("fuzz"))));
    if (file.starts_with("/usr/bin/")) {
      EXPECT_THAT(expected, Contains(file));
    }
  }
}

void Package::expect_dependencies() const {
  std::set<std::string> libraries;
  for (const std::string& program : kPrograms) libraries.merge(libraries_of(root / "usr/bin" / program));
  std::set<std::string> provided;
  const std::set<std::string> needed = packages_of(libraries, provided), depends = packages_in(field("Depends"));
  EXPECT_GT(needed.size(), 10u);
  for (const std::string& package_needed : needed) {
    const bool is_there_under_another_name = std::ranges::any_of(depends, [&](const std::string& one) {
      return provided.contains(one) && one.starts_with(package_needed);  // libspdlog1.10-fmt9 is of libspdlog1.10
    });
    EXPECT_TRUE(depends.contains(package_needed) || is_there_under_another_name) << package_needed;
  }
  EXPECT_THAT(depends, IsSupersetOf({"libegl1", "libopengl0"})) << "opened while programs run";
  EXPECT_THAT(packages_in(field("Recommends")), IsSupersetOf({"libegl-mesa0", "libgl1-mesa-dri"}));
  EXPECT_EQ(field("Package"), "lfd");
}

void Package::expect_to_run() const {
  const Result<Deployment> deployment = load_deployment(root / "etc/lfd/deployment.textproto");
  ASSERT_TRUE(deployment) << deployment.error().message();
  EXPECT_EQ(deployment->nodes.size(), 2u);
  if (is_there("systemd-sysusers")) {
    const auto users = read_file(root / "etc/passwd");
    EXPECT_TRUE(users && users->find("lfd:") != users->npos) << "the daemons have a user";
  }
  const fs::path out = folder.path() / "out";
  lines_of({root / "usr/bin/lfd", "render", root / "usr/share/lfd/configs/desk.textproto", "--module", "3", "--no-ao",
            "--frames", "1", "--out", out});
  EXPECT_TRUE(fs::exists(out / "frame-0000/module-003.color.png"));
  const auto report = read_file(out / "report.json");
  EXPECT_TRUE(report && report->find("\"frames\"") != report->npos);
}

void Package::expect_to_go() const {
  ASSERT_TRUE(write_file(root / "etc/lfd/deployment.textproto", "# somebody's own\n"));
  dpkg({"-r", "lfd"});
  EXPECT_FALSE(fs::exists(root / "usr/bin/lfd"));
  EXPECT_EQ(*read_file(root / "etc/lfd/deployment.textproto"), "# somebody's own\n") << "it is a configuration file";
  dpkg({"-P", "lfd"});
  EXPECT_FALSE(fs::exists(root / "etc/lfd/deployment.textproto"));
}

TEST_F(Package, HoldsWhatItShouldAndRunsWhereItIsInstalledAndGoesAwayAgain) {
  expect_files();
  install();
  expect_dependencies();
  expect_to_run();
  expect_to_go();
}

}  // namespace
}  // namespace lfd::harness
