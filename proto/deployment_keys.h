// What a deployment's security means for the programs that are started with it: their keys, and where they may listen.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "proto/deployment_file.h"
#include "proto/key_files.h"

namespace lfd {

// Where the keys are; absent: the deployment works without.
std::optional<std::filesystem::path> keys_folder(const Deployment& deployment);

// The key file that a process works with: `given` on its command line, else NAME.key of the deployment's; empty where
// the deployment has no keys. Error: one is given all the same.
Result<std::string> choose_key_file(const Deployment& deployment, const std::string& given, std::string_view name);

// Refuses a key that cannot be what it is used for: the list beside it gives it to a member without this right or,
// where a `name` is needed, of another name. Of keys that it does not list only a controller's is refused: others are
// told so by whom they join, and wait until they are listed. Without a key file everything goes.
Status check_key_holder(const std::string& key_file, Right right, std::string_view name = {});

// Whether plain sockets at this endpoint are for this machine alone: ipc, and tcp of the loopback interface.
bool is_local_endpoint(std::string_view endpoint);

// Refuses plain tcp beyond this machine for an endpoint of a command line, unless the deployment accepts it.
Status check_endpoint(const Deployment& deployment, std::string_view endpoint);

// The option of programs that stands for Security.accept_plain_tcp_beyond_loopback where they know no deployment.
inline constexpr const char* kAcceptPlainOption = "--accept-plain-tcp-beyond-loopback";

// What makes an endpoint beyond this machine possible: in a deployment, and where there is none.
inline constexpr const char* kKeysRemedy = "give the deployment keys (security { keys: \"keys\" } and `lfd keys make`)";
inline constexpr const char* kOptionsRemedy = "name a key file with --key, or say --accept-plain-tcp-beyond-loopback";

// The same without a deployment: with a key everything goes, and `accept_plain` stands for the deployment's word.
// `remedy`: said at the end of the error.
Status check_endpoint(std::string_view endpoint, bool has_key, bool accept_plain, const char* remedy = kOptionsRemedy);

}  // namespace lfd
