// Bytes of a message that somebody keeps alive: they travel through a process without being copied.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace lfd::wire {

// Immutable and shared: copying a Payload copies a pointer. The bytes live as long as any copy of it, the transport's
// included. Nothing is promised about alignment: copy numbers out with memcpy.
class Payload {
 public:
  Payload() = default;
  Payload(std::shared_ptr<const std::string> text)  // NOLINT: implicit by design
      : bytes_(text ? std::as_bytes(std::span(*text)) : std::span<const std::byte>()), owner_(std::move(text)) {}
  // `bytes` must live as long as `owner` does.
  Payload(std::shared_ptr<const void> owner, std::span<const std::byte> bytes)
      : bytes_(bytes), owner_(std::move(owner)) {}

  std::span<const std::byte> bytes() const { return bytes_; }
  std::string_view text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }
  std::size_t size() const { return bytes_.size(); }
  bool empty() const { return bytes_.empty(); }
  const std::shared_ptr<const void>& owner() const { return owner_; }

 private:
  std::span<const std::byte> bytes_;
  std::shared_ptr<const void> owner_;
};

}  // namespace lfd::wire
