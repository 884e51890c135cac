// Decides which pieces of which assets to ask for next, and puts what comes together. No sockets, no clock.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "proto/scene_data.h"
#include "proto/wire.pb.h"

namespace lfd {

// Every mesh and picture that the scene names.
std::set<std::string> asset_hashes(const proto::Scene& scene);

class AssetGatherer {
 public:
  // At most this much is asked for and not yet here: bulk never fills the queues of a link.
  static constexpr int kPiecesUnderWay = 8;
  static constexpr std::uint64_t kMaxAsset_bytes = std::uint64_t{1} << 31;

  explicit AssetGatherer(std::uint32_t piece_bytes) : piece_bytes_(piece_bytes) {}

  // From now on exactly the assets of these scenes are wanted, `next` being one that is to come; others are forgotten.
  void want(const proto::Scene& scene, const proto::Scene* next = nullptr);

  // Every asset of this scene is here.
  bool has_all_of(const proto::Scene& scene) const;

  // Everything wanted is here.
  bool complete() const { return missing_.empty(); }
  std::size_t missing() const { return missing_.size(); }
  const Assets& assets() const { return assets_; }

  // Pieces to ask for now.
  std::vector<proto::Want> next_requests();

  // A piece came. An error says why it is of no use (nothing is lost: the asset is asked for again).
  Status piece_came(const proto::Chunk& chunk, std::string_view bytes);

  // A piece that was asked for is not there: the controller shows another scene by now. The asset is asked for again,
  // from its beginning, if it is still wanted then.
  void not_found(const std::string& hash);

  // The link was lost: what was under way is asked for again.
  void ask_again();

 private:
  struct Partial {
    std::string bytes;
    std::uint64_t total = 0;   // 0: not known yet
    std::uint64_t asked = 0;   // up to here
    std::uint64_t here = 0;    // bytes
    std::vector<bool> pieces;  // that are here
  };

  std::uint32_t piece_bytes_;
  Assets assets_;
  std::map<std::string, Partial> missing_;
  int under_way_ = 0;
};

}  // namespace lfd
