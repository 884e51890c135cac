// lfd keys: makes and lists the keys of a deployment.
#include <filesystem>
#include <iostream>
#include <memory>

#include "base/log.h"
#include "base/printable.h"
#include "cli/lfd_commands.h"
#include "cli/make_keys.h"
#include "proto/deployment_keys.h"
#include "proto/key_files.h"
#include "proto/member_name.h"

namespace lfd {
namespace {

struct Arguments {
  std::string deployment;
  KeyHolders people;
};

// The options as they are written: what follows from the deployment is found by make_keys().
Status check_names(const KeyHolders& people) {
  for (const auto& [option, names] :
       {std::pair{"--operator", &people.operators}, std::pair{"--viewer", &people.viewers}}) {
    for (const std::string& name : *names) {
      if (const Status fits = check_member_name(name); !fits)
        return fits.error().within(fmt::format("{}: \"{}\"", option, printable(name)));
    }
  }
  return {};
}

// A list may name members whose keys lie on other machines; those of operators are what commands miss.
Status tell_of_keys_elsewhere(const std::string& deployment, const std::filesystem::path& folder) {
  LFD_TRY(const std::vector<std::string> elsewhere, keys_elsewhere(folder));
  if (elsewhere.empty()) return {};
  std::cout << fmt::format(
      "listed, but not in this folder: {} (a key that is lost: remove its member from {}, and a new one is made)\n",
      fmt::join(elsewhere, ", "), kAllowFile);
  if (!find_operator_key(folder))
    std::cout << fmt::format(
        "no key here may change the show, as `lfd run` has to: `lfd keys make {} --operator NAME` makes one\n",
        deployment);
  return {};
}

Status make(const Arguments& arguments) {
  LFD_TRY(const Deployment deployment, load_deployment(arguments.deployment));
  const auto made = make_keys(deployment, arguments.people);
  if (!made) return made.error().within(arguments.deployment);
  const std::filesystem::path folder = *keys_folder(deployment);
  for (const std::string& name : *made) std::cout << fmt::format("{}/{}{}\n", folder.string(), name, kKeySuffix);
  if (made->empty()) std::cout << fmt::format("nothing to make: {} lists all\n", (folder / kAllowFile).string());
  return tell_of_keys_elsewhere(arguments.deployment, folder);
}

Status show(const Arguments& arguments) {
  LFD_TRY(const Deployment deployment, load_deployment(arguments.deployment));
  const auto folder = keys_folder(deployment);
  if (!folder) return Error("the deployment works without keys").within(arguments.deployment);
  LFD_TRY(const AllowList list, read_allow_list(*folder / kAllowFile));
  for (const Allowed& member : list.members)
    std::cout << fmt::format("{:<20} {}  {}\n", member.name, member.public_key, rights_text(member));
  return {};
}

}  // namespace

void add_keys_command(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* keys = app.add_subcommand("keys", "Make and list the keys of a deployment");
  keys->require_subcommand(1);
  const auto add = [&](const char* name, const char* description, Status (*what)(const Arguments&)) {
    CLI::App* command = add_command(*keys, name, description, exit_code, [arguments, what] {
      if (const Status names = check_names(arguments->people); !names) return wrong_use(names.error());
      const Status done = what(*arguments);
      return done ? end_of_output() : fail(done.error());
    });
    command->add_option("DEPLOYMENT", arguments->deployment, "Deployment file (*.textproto) with security { keys }")
        ->required();
    return command;
  };
  CLI::App* command = add("make",
                          "Write the keys that are missing: of controller, display, nodes and operators; those that "
                          "are there stay",
                          make);
  add_list(*command, "--operator", arguments->people.operators,
           "Names of those who may change the show (default: \"operator\", where there is nobody yet)");
  add_list(*command, "--viewer", arguments->people.viewers, "Names of those who may look at it");
  command->footer(
      "Every machine needs allow.textproto and the NAME.key of what runs on it, in a folder that the deployment names, "
      "and no other key. Whoever has a key is who it says: keys are for their owners' eyes alone (mode 0600).");
  add("show", "List names, public keys and rights", show);
}

}  // namespace lfd
