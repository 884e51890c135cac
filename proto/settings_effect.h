// Settings that are said and change nothing: somebody may have meant something else.
#pragma once

#include <string>
#include <vector>

#include "proto/settings.pb.h"

namespace lfd {

// A line each: "ao.samples: has no effect: gtao takes none". `message` is one that read_settings() reads.
std::vector<std::string> without_effect(const proto::RenderSettings& message);

}  // namespace lfd
