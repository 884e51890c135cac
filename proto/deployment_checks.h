// What the parts of a deployment file have in common while it is checked; only the sources of deployment files see it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/deployment_file.h"

namespace lfd::deployment {

// The road to what a command line says in place of the file.
inline constexpr const char* kOption = "--";

// An error whose message names things for a person, with the road (proto/text_file.h) to its line beside it.
struct Fault {
  std::string road;
  Error error;
};
using Check = std::optional<Fault>;

Check check_range(const std::string& road, double value, double low, double high);

// deployment_shares.cc: names of nodes, and who draws what. `use_lists`: the file's lists count, else equal shares.
Check check_node_names(const proto::Deployment& m);
Check assign_modules(const proto::Deployment& m, bool use_lists, int module_count, std::vector<NodeShare>& nodes);

// deployment_network.cc: where processes meet, and how images travel.
Check read_addresses(const proto::Deployment& m, Addresses& addresses);
Check read_stream(const proto::Stream& m);

}  // namespace lfd::deployment
