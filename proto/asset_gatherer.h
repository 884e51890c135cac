// Decides which pieces of which assets to ask for next, and puts what comes together. Told answers and the time.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/result.h"
#include "proto/scene_data.h"
#include "proto/wire.pb.h"

namespace lfd {

// Every mesh and picture that the scene names.
std::set<std::string> asset_hashes(const proto::Scene& scene);

class AssetGatherer {
 public:
  // At most so many pieces are asked for and not yet here, where the deployment says nothing else (Stream.assets_mib).
  static constexpr int kPiecesUnderWay = 8;
  static constexpr std::uint64_t kMaxAsset_bytes = std::uint64_t{1} << 31;
  // What has had no answer for so long, while nothing else has come either, is asked for again: the link may have
  // broken in between. Twice as long each time, up to the most, until all is here: a link may just be slow.
  static constexpr Clock::duration kPatience = std::chrono::seconds(5), kMostPatience = std::chrono::seconds(80);

  explicit AssetGatherer(std::uint32_t piece_bytes) : piece_bytes_(piece_bytes) {}

  // From the next requests on; 0: kPiecesUnderWay.
  void keep_under_way(int pieces) { most_under_way_ = pieces > 0 ? pieces : kPiecesUnderWay; }

  // From now on exactly the assets of these scenes are wanted, `next` being one that is to come; others are forgotten.
  void want(const proto::Scene& scene, const proto::Scene* next = nullptr);

  // Every asset of this scene is here.
  bool has_all_of(const proto::Scene& scene) const;

  // Everything wanted is here.
  bool complete() const { return missing_.empty(); }
  std::size_t missing() const { return missing_.size(); }
  const Assets& assets() const { return assets_; }

  // Pieces to ask for now. An answer counts from the call after it; to be called now and then, even if none comes.
  std::vector<proto::Want> next_requests(Clock::time_point now);

  // A piece came; one that is here already changes nothing. An error says why it is of no use (nothing is lost: the
  // asset is asked for again).
  Status piece_came(const proto::Chunk& chunk, std::string_view bytes);

  // A piece that was asked for is not there: the controller shows another scene by now. The asset is asked for again,
  // from its beginning, if it is still wanted then.
  void not_found(const std::string& hash);

  // The link was lost: what was under way is asked for again. What has come of an asset is kept.
  void ask_again();

 private:
  struct Partial {
    std::string bytes;
    std::uint64_t total = 0;   // 0: not known yet
    std::uint64_t next = 0;    // to ask for
    std::uint64_t asked = 0;   // up to here, at some time
    std::uint64_t here = 0;    // bytes
    std::vector<bool> pieces;  // that are here

    bool has(std::uint64_t piece) const { return piece < pieces.size() && pieces[piece]; }
  };

  void answer_came();

  std::uint32_t piece_bytes_;
  Assets assets_;
  std::map<std::string, Partial> missing_;
  int under_way_ = 0, most_under_way_ = kPiecesUnderWay;
  bool answered_ = false;          // since the last requests
  Clock::time_point last_news_{};  // the last time that something was asked for or answered
  Clock::duration patience_ = kPatience;
};

}  // namespace lfd
