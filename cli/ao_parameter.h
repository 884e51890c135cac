// `lfd ctl ao --set NAME=VALUE`: parameters of methods of ambient occlusion as a person writes them.
#pragma once

#include <string>
#include <utility>

#include "base/result.h"

namespace lfd {

// Errors name what a parameter of that name may be: "directions=abc: a number is needed, 1 to 32 for hbao".
Result<std::pair<std::string, double>> parse_ao_parameter(const std::string& text);

}  // namespace lfd
