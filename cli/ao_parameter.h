// `lfd ctl ao --set NAME=VALUE`: parameters of methods of ambient occlusion as a person writes them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace lfd {

// Errors name what a parameter of that name may be: "directions=abc: a number is needed, 1 to 32 for hbao". What one
// method at least takes is let through.
Result<std::pair<std::string, double>> parse_ao_parameter(const std::string& text);

// Refuses what this method does not take; without its name it is the controller's to know.
Status check_ao_parameters(const std::string& method, const std::vector<std::pair<std::string, double>>& parameters);

}  // namespace lfd
