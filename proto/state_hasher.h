// The hash of a state, kept while updates change it: an update costs what it touches, whatever else is in the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.h"
#include "proto/wire.pb.h"

namespace lfd {

// The hash is taken of the hashes of the state's parts: the scene without its instances and lights, the instances, the
// lights, the region of interest, the render settings, the buffers. Of a list it is the number of its items and the sum
// of the hashes of each with its index, so that one item can change without a look at the others.
class StateHasher {
 public:
  explicit StateHasher(const proto::State& state);

  // `state` is what `update` has made of the state that this knew.
  void updated(const proto::State& state, const proto::Update& update);

  // state_hash() of the state.
  std::string hash() const;

  // How many bytes have gone through a hash function so far, those of parts' hashes left out.
  std::uint64_t hashed_bytes() const { return hashed_bytes_; }

 private:
  class ItemHashes {
   public:
    void resize(std::size_t count);
    void set(std::size_t index, const Hash128& hash);
    std::size_t count() const { return hashes_.size(); }
    const Hash128& sum() const { return sum_; }  // of each half, modulo 2^64

   private:
    std::vector<Hash128> hashes_;
    Hash128 sum_;
  };

  void take_scene(const proto::State& state);
  Hash128 hash_of(const google::protobuf::Message& part, std::uint64_t index = 0);

  // Of absent parts: zero.
  Hash128 frame_;  // of the scene: what is neither instance nor light
  ItemHashes instances_, lights_;
  Hash128 roi_, render_;
  std::uint32_t buffers_ = 0;
  std::uint64_t hashed_bytes_ = 0;
};

}  // namespace lfd
