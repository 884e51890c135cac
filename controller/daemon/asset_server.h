// Answers nodes that want pieces of assets, out of memory and without copying.
#pragma once

#include "proto/scene_data.h"
#include "proto/wire.pb.h"
#include "proto/wire/payload.h"

namespace lfd::controller {

struct AssetAnswer {
  proto::Envelope envelope;  // Chunk, or NotFound
  wire::Payload piece;       // of a Chunk
};

// The piece, shorter at the asset's end; NotFound for an asset that the scene does not have.
AssetAnswer answer_want(const proto::Want& want, const Assets& assets);

}  // namespace lfd::controller
