// The table of shader sources that the build embeds.
#pragma once

#include <string_view>
#include <vector>

namespace lfd {

struct EmbeddedShader {
  std::string_view name;  // path below shaders/, e.g. "lib/optics.glsl"
  std::string_view source;
};

const std::vector<EmbeddedShader>& embedded_shaders();

}  // namespace lfd
