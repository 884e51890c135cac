// Images as they come, frames as they are shown, and credits.
#include "base/log.h"
#include "display/display_loop.h"

namespace lfd::display {
namespace {

constexpr auto kWarningPause = std::chrono::seconds(5);
constexpr std::size_t kLastShown = 4096;  // those of a minute, the longest heartbeat, at 60 a second

proto::Envelope empty_credit() {
  proto::Envelope envelope;
  envelope.mutable_credit();
  return envelope;
}

}  // namespace

void DisplayLoop::hear_images() {
  const Clock::time_point now = Clock::now();
  for (int i = 0; i < kImagesPerPass; ++i) {
    auto message = images_.receive();
    if (!message) break;
    if (senders_.is_borrowed(message->peer, message->user)) {
      warn_of_image(Error(fmt::format("the key of \"{}\" speaks for no other node", message->user)));
      continue;
    }
    senders_.heard(message->peer, now);
    if (message->envelope.has_hello()) hear_hello(*message, now);
    if (message->envelope.has_image()) hear_image(std::move(*message));
  }
}

void DisplayLoop::hear_image(wire::Message&& message) {
  const auto node = peers_.sender(message.peer);
  if (!node) return;  // it is told to say hello
  if (is_of_another_session(message.envelope)) return assembly_.image_passed_over(*node);
  const proto::Image& image = message.envelope.image();
  stats_.image_came(message.payload.bytes().size());
  const bool past = assembly_.is_past(image.frame());
  const Status status = assembly_.image_came(*node, image, std::move(message.payload), Clock::now());
  if (!status && past) log::debug("{}", status.error().message());  // as where a node joins before the display
  if (!status && !past) warn_of_image(status.error());
}

void DisplayLoop::hear_hello(const wire::Message& message, Clock::time_point now) {
  const std::string& node = message.envelope.hello().node();
  if (const auto before = senders_.speaks_for(node); before && *before != message.peer) {
    const Status there = images_.send_to(*before, empty_credit());
    if (!there) forget(*before, there.error().message());
  }
  if (const auto greeting = senders_.hello(message.peer, message.user, node, now); !greeting)
    return warn_of_image(greeting.error());
  const auto is_new = peers_.hello(message.peer, node, now);
  if (!is_new) warn_of_image(is_new.error().within(fmt::format("hello of node \"{}\"", node)));
  if (is_new && *is_new) log::info("node \"{}\" sends images", node);
}

void DisplayLoop::forget(const std::string& peer, const std::string& why) {
  senders_.left(peer);
  if (const auto node = peers_.gone(peer, Clock::now())) log::info("node \"{}\" sends no more images: {}", *node, why);
}

void DisplayLoop::show() {
  while (writer_) {
    const auto written = writer_->take_written();
    if (!written) break;
    say_shown(written->frame, written->fresh_modules);
  }
  while (!writer_ || writer_->accepts()) {
    auto frame = assembly_.next_frame(Clock::now());
    if (!frame) break;
    last_shown_[frame->frame].reset();
    if (last_shown_.size() > kLastShown) last_shown_.erase(last_shown_.begin());
    if (writer_) {
      writer_->write(std::move(*frame));
    } else {
      say_shown(frame->frame, frame->fresh_modules);
    }
  }
}

void DisplayLoop::say_shown(std::uint64_t frame, int fresh_modules) {
  stats_.shown(fresh_modules, Clock::now());
  if (const auto last = last_shown_.find(frame); last != last_shown_.end()) last->second = fresh_modules;
  proto::Envelope shown;
  shown.set_session(session_);
  shown.mutable_shown()->set_frame(frame);
  shown.mutable_shown()->set_modules(static_cast<std::uint32_t>(fresh_modules));
  const Status sent = control_.send(shown);
  if (!sent && told_shown_) log::warn("frame {} is shown, but: {}", frame, sent.error().message());
  told_shown_ = static_cast<bool>(sent);
}

void DisplayLoop::say_fate_again(std::uint64_t frame) {
  const auto last = last_shown_.find(frame);
  if (last != last_shown_.end() && !last->second) return;  // it is being written
  proto::Envelope words;
  words.set_session(session_);
  words.mutable_shown()->set_frame(frame);
  words.mutable_shown()->set_dropped(last == last_shown_.end());
  if (last != last_shown_.end()) words.mutable_shown()->set_modules(static_cast<std::uint32_t>(*last->second));
  if (const Status sent = control_.send(words); !sent) log::trace("{}", sent.error().message());
}

void DisplayLoop::give_credits() {
  const auto now = Clock::now();
  for (const auto& [peer, credit] : peers_.words(now)) {
    proto::Envelope envelope;
    *envelope.mutable_credit() = credit;
    const Status sent = images_.send_to(peer, envelope);
    if (sent) continue;
    forget(peer, sent.error().message());
  }
}

void DisplayLoop::warn_of_image(const Error& error) {
  ++refused_images_;
  if (Clock::now() - last_warning_ < kWarningPause) return;
  last_warning_ = Clock::now();
  log::warn("{} (so far {} images refused)", error.message(), refused_images_);
}

}  // namespace lfd::display
