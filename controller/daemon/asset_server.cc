// Pieces of assets.
#include "controller/daemon/asset_server.h"

#include <algorithm>

#include "proto/wire/socket.h"

namespace lfd::controller {

AssetAnswer answer_want(const proto::Want& want, const Assets& assets) {
  AssetAnswer answer;
  const auto found = assets.find(want.hash());
  if (found == assets.end() || want.offset() > found->second->size()) {
    answer.envelope.mutable_not_found()->set_hash(want.hash());
    return answer;
  }
  const std::shared_ptr<const std::string>& asset = found->second;
  const std::size_t left = asset->size() - want.offset();
  const std::size_t length = std::min<std::size_t>({want.length(), wire::kChunk_bytes, left});
  proto::Chunk& chunk = *answer.envelope.mutable_chunk();
  chunk.set_hash(want.hash());
  chunk.set_offset(want.offset());
  chunk.set_total(asset->size());
  answer.piece = wire::Payload(asset, std::as_bytes(std::span(*asset)).subspan(want.offset(), length));
  return answer;
}

}  // namespace lfd::controller
