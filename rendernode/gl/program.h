// Shader programs from the embedded sources: includes resolved, flags as #define lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "rendernode/gl/handle.h"

namespace lfd::gl {

// Names of #defines that a variant of a shader is compiled with.
using Flags = std::vector<std::string>;

// The text of an embedded shader with `#include "..."` lines replaced (each file once) and flags defined after
// #version.
Result<std::string> shader_text(std::string_view name, const Flags& flags);

// Compiles and links. stages: embedded names ending in .vert, .tesc, .tese, .frag or .comp. Errors carry the driver's
// log.
Result<Program> make_program(const std::vector<std::string>& stages, const Flags& flags = {});

// Compiles one compute shader given as text that may include embedded files (tests).
Result<Program> make_compute_program(std::string_view text);

}  // namespace lfd::gl
