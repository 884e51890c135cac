// Pieces of assets.
#include "controller/daemon/asset_server.h"

#include <algorithm>

namespace lfd::controller {

Status serve_asset(wire::Socket& bulk, const wire::Message& message, const Assets& assets) {
  if (!message.envelope.has_want()) return {};
  const proto::Want& want = message.envelope.want();
  proto::Envelope answer;
  wire::Payload piece;
  const auto found = assets.find(want.hash());
  if (found == assets.end() || want.offset() > found->second->size()) {
    answer.mutable_not_found()->set_hash(want.hash());
  } else {
    const std::shared_ptr<const std::string>& asset = found->second;
    const std::size_t left = asset->size() - want.offset();
    const std::size_t length = std::min<std::size_t>({want.length(), wire::kChunk_bytes, left});
    proto::Chunk& chunk = *answer.mutable_chunk();
    chunk.set_hash(want.hash());
    chunk.set_offset(want.offset());
    chunk.set_total(asset->size());
    piece = wire::Payload(asset, std::as_bytes(std::span(*asset)).subspan(want.offset(), length));
  }
  return bulk.send_to(message.peer, answer, piece);
}

}  // namespace lfd::controller
