// Names of those who take part: nodes of deployments, and whoever has a key.
#pragma once

#include <string_view>

#include "base/result.h"

namespace lfd {

// Letters, digits, '.', '-' and '_': a name is also that of a file. "." and ".." are refused. The error does not repeat
// the name.
Status check_member_name(std::string_view name);

}  // namespace lfd
