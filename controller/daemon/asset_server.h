// Answers nodes that want pieces of assets, out of memory and without copying.
#pragma once

#include "proto/scene_data.h"
#include "proto/wire/socket.h"

namespace lfd::controller {

// One request and its answer: a Chunk with the piece as payload (shorter at the asset's end), NotFound for an asset
// that the scene does not have, nothing for what is no Want. Errors: whoever asked does not read.
Status serve_asset(wire::Socket& bulk, const wire::Message& message, const Assets& assets);

}  // namespace lfd::controller
