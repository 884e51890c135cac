// Frames through the node: begin, drawn, ready, and the images on their way.
#include <algorithm>
#include <utility>

#include "base/fault.h"
#include "base/large_blocks.h"
#include "base/log.h"
#include "proto/state.h"
#include "rendernode/node/daemon.h"

namespace lfd::node {
namespace {

constexpr std::size_t kMostBegun = 8;
constexpr auto kStopped = std::chrono::seconds(1);  // the loop's turn took so long: the whole process was stopped
constexpr std::size_t kSaidReady = 2;               // as many frames as a controller has open

}  // namespace

bool Daemon::draws(const proto::BeginFrame& begin) const {
  return std::ranges::find(begin.node(), options_.name) != begin.node().end();
}

// A controller that waits for a frame tells of it again: this node, or what it said of the frame, may not have been
// heard.
void Daemon::take_begin(const proto::BeginFrame& begin) {
  if (!draws(begin)) return;
  if (newest_begun_ && begin.frame() <= *newest_begun_) {
    for (const proto::Ready& ready : said_ready_) {
      if (ready.frame() != begin.frame()) continue;
      proto::Envelope again;
      *again.mutable_ready() = ready;
      say(again);
    }
    return;
  }
  newest_begun_ = begin.frame();
  fault::at(fault::kBegin, begin.frame());
  stats_.begun(begin.frame(), last_heard_);
  begun_.push_back({begin, follower_.sequence() == begin.sequence() ? follower_.hash() : ""});
  begin_frames();  // before the next update: a frame is drawn from the state it names
}

// A frame is drawn as soon as its state is here; a node that is far behind passes the oldest over.
void Daemon::begin_frames() {
  while (begun_.size() > kMostBegun) begun_.pop_front();
  while (!begun_.empty() && drawing_ && ready_state_ && ready_state_->sequence() >= begun_.front().begin.sequence()) {
    const proto::BeginFrame& begin = begun_.front().begin;
    if (!can_show(begun_.front())) {
      proto::NodeReport report;
      report.set_error("a newer state came before all that the frame's own needs");
      say_ready(begin.frame(), std::move(report));
    } else {
      if (shows_prepared(begun_.front())) switch_to_prepared();
      if (!drawing_->draw({begin.frame(), epoch_, ready_state_, ready_assets_, begin.time_modules()})) return;
      states_[begin.frame()] = {ready_state_, ready_hash_};
    }
    begun_.pop_front();
  }
}

// Whether the state at hand is the frame's own, or shows the same: other nodes draw that one, and a frame never mixes
// two. Messages of two channels overtake each other: a snapshot may be newer than the frame that is announced after it.
bool Daemon::can_show(const Begun& begun) const {
  return ready_state_->sequence() == begun.begin.sequence() || begun.hash == ready_hash_;
}

// A process whose driver hangs says heartbeats all the same, and would be waited for in every frame. It ends, so that a
// spare draws for it, and whoever starts it again finds another driver, or an error.
Status Daemon::check_drawing(Clock::time_point now) {
  if (now - std::exchange(last_check_, now) > kStopped) awake_since_ = now;
  std::vector<const RenderThread*> threads{drawing_.get(), finishing_.get()};
  if (preparation_) threads.push_back(preparation_->drawing.get());
  for (const auto& retired : retired_) threads.push_back(retired.get());
  for (const RenderThread* thread : threads) {
    if (thread != nullptr && std::min(thread->stuck_for(now), now - awake_since_) > hang_)
      return Error(fmt::format("the GPU has brought nothing to an end for {:.0f} s: its driver hangs",
                               milliseconds(hang_) / 1000));
  }
  return {};
}

Status Daemon::take_events() {
  LFD_TRY_STATUS(check_drawing(Clock::now()));
  if (std::erase_if(retired_, [](const auto& thread) { return thread->stop_within({}); }) > 0) give_memory_back();
  take_prepared_events();
  switch_at_rest();
  if (finishing_) LFD_TRY_STATUS(take_events_of(*finishing_));
  // Frames of the scene before come first.
  if (finishing_ && finishing_->pending() == 0) {
    if (!finishing_->stop_within({})) retired_.push_back(std::move(finishing_));
    finishing_.reset();
  }
  if (drawing_ && !finishing_) LFD_TRY_STATUS(take_events_of(*drawing_));
  rehearse(Clock::now());
  hand_on_waiting();
  return {};
}

Status Daemon::take_events_of(RenderThread& thread) {
  while (auto event = thread.take()) {
    if (event->kind == FrameEvent::Kind::kReady && event->epoch == kForNobody && &thread == drawing_.get())
      rehearsal_ended(event->result->report.error());
    const bool is_of_a_frame = event->kind == FrameEvent::Kind::kDrawn || event->kind == FrameEvent::Kind::kReady;
    if (is_of_a_frame && event->epoch != epoch_) continue;
    switch (event->kind) {
      case FrameEvent::Kind::kStarted:
        drawing_started_ = true;
        next_words_ = Clock::now();
        break;
      case FrameEvent::Kind::kFailed:
        return Error(event->error);
      case FrameEvent::Kind::kDrawn: {
        proto::Envelope drawn;
        fault::at(fault::kDrawn, event->frame);
        drawn.mutable_drawn()->set_frame(event->frame);
        stats_.drawn(event->frame, Clock::now());
        say(drawn);
        break;
      }
      case FrameEvent::Kind::kReady:
        waiting_.push_back(std::move(*event));
        break;
    }
  }
  return {};
}

// Without a deadline a frame is ready only once the images of the one before have gone: a slow sink slows the show.
// With one, its images are dropped: a slow sink costs frames. Either way no more than a few frames wait here.
void Daemon::hand_on_waiting() {
  while (hand_on_encoded() || hand_on_drawn()) {
  }
}

// Both say whether something went on.
bool Daemon::hand_on_encoded() {
  if (!encoded_) return false;
  if (!encoded_->images) encoded_->images = encoder_.take();
  if (!encoded_->images) return false;
  if (outbox_.idle()) {
    const ImageOutbox::Load load = outbox_.push(*std::move(encoded_->images));
    encoded_->report.set_image_bytes(load.bytes);
    encoded_->report.set_unchanged_images(load.unchanged);
    say_ready(encoded_->frame, std::move(encoded_->report));
  } else if (may_drop_) {
    say_dropped(encoded_->frame, std::move(encoded_->report));
  } else {
    return false;
  }
  encoded_.reset();
  return true;
}

bool Daemon::hand_on_drawn() {
  if (waiting_.empty()) return false;
  FrameEvent& event = waiting_.front();
  const bool has_images = event.result->report.error().empty();
  if (has_images && sink_ == proto::Deployment::DISPLAY) {
    if (!hand_to_encoder(event)) return false;
  } else if (has_images && sink_ == proto::Deployment::FILES && !files_->put(outgoing(event.frame, *event.result))) {
    if (!may_drop_) return false;
    say_dropped(event.frame, std::move(event.result->report));
  } else {
    say_ready(event.frame, std::move(event.result->report));
  }
  waiting_.pop_front();
  return true;
}

// Where images may be dropped, those that could not be sent are not encoded either; of the others the newest counts.
bool Daemon::hand_to_encoder(FrameEvent& event) {
  if (may_drop_ && (!outbox_.idle() || (encoded_ && waiting_.size() > 1))) {
    say_dropped(event.frame, std::move(event.result->report));
    return true;
  }
  if (encoded_) return false;
  encoder_.put(stream_, outgoing(event.frame, *event.result));
  encoded_ = {event.frame, std::move(event.result->report), std::nullopt};
  return true;
}

// Nothing of what was begun before is of use.
void Daemon::restart_images(const proto::Stream& stream) {
  stream_ = stream;
  encoder_.give_up();
  encoded_.reset();
  outbox_.clear();
}

std::vector<OutgoingImage> Daemon::outgoing(std::uint64_t frame, const FrameResult& result) const {
  std::vector<OutgoingImage> images;
  for (const auto& image : result.images) {
    OutgoingImage out;
    out.header.set_frame(frame);
    out.header.set_module(image.module);
    out.header.set_buffer(image.kind);
    out.header.set_format(image.kind == proto::COLOR ? proto::RGBA8 : proto::RGBA32F);
    out.header.set_width_px(static_cast<std::uint32_t>(image.size.width));
    out.header.set_height_px(static_cast<std::uint32_t>(image.size.height));
    out.header.set_empty(image.empty);
    out.header.set_of_images(static_cast<std::uint32_t>(result.images.size()));
    if (image.empty) *out.header.mutable_background() = states_.at(frame).state->render().background();
    if (image.kind == proto::POSITION) {
      out.header.mutable_position_origin()->set_x(result.position_origin.x);
      out.header.mutable_position_origin()->set_y(result.position_origin.y);
      out.header.mutable_position_origin()->set_z(result.position_origin.z);
    }
    if (!image.empty) out.payload = wire::Payload(image.bytes);
    images.push_back(std::move(out));
  }
  return images;
}

void Daemon::say_ready(std::uint64_t frame, proto::NodeReport report) {
  fault::at(fault::kReady, frame);
  report.set_node(options_.name);
  const auto drawn = states_.extract(frame);
  if (drawn && report.error().empty()) report.set_state_hash(drawn.mapped().hash);
  stats_.ready(frame, report, Clock::now());
  proto::Envelope ready;
  ready.mutable_ready()->set_frame(frame);
  *ready.mutable_ready()->mutable_report() = std::move(report);
  if (!may_drop_) said_ready_.push_back(ready.ready());  // with a deadline nobody asks again
  if (said_ready_.size() > kSaidReady) said_ready_.pop_front();
  say(ready);
}

// The display does not wait for modules that are stale: a frame whose images it will not get is none that is ready.
void Daemon::say_dropped(std::uint64_t frame, proto::NodeReport report) {
  ++dropped_frames_;
  if (sink_ == proto::Deployment::DISPLAY) {
    report.set_error("images dropped: the display was not ready for them by the time they were drawn");
  } else {
    report.add_warning("images dropped: the sink is too slow");
  }
  say_ready(frame, std::move(report));
}

void Daemon::use_images_endpoint(const std::string& endpoint) {
  if (endpoint == images_endpoint_) return;
  images_endpoint_ = endpoint;
  outbox_.reconnected();
  images_.reset();
  if (endpoint.empty()) return;
  auto socket = wire::connect_dealer(*context_, endpoint, wire::kImages, wire::Listener::kDisplay);
  if (!socket) {
    log::error("images: {}", socket.error().message());
    return;
  }
  images_ = std::move(*socket);
  log::info("sends images to {}", endpoint);
}

void Daemon::hear_display() {
  if (!images_) return;
  while (const auto message = images_->receive()) {
    if (!message->envelope.has_credit()) continue;
    const bool was_known = outbox_.is_known();
    outbox_.credit_came(message->envelope.credit());
    if (!was_known && outbox_.is_known()) next_words_ = Clock::now();  // the controller may count on this node
  }
  if (!outbox_.greets(Clock::now())) return;
  proto::Envelope hello;
  hello.mutable_hello()->set_node(options_.name);
  if (const Status sent = images_->send(hello); !sent) log::trace("{}", sent.error().message());
}

void Daemon::send_images() {
  if (!images_) return;
  while (auto image = outbox_.next()) {
    proto::Envelope envelope;
    const std::uint64_t frame = image->header.frame();
    *envelope.mutable_image() = std::move(image->header);
    envelope.set_session(session_);
    if (!images_->send(envelope, image->payload)) break;
    stats_.sent_image(image->payload.bytes().size());
    outbox_.sent();
    fault::at(fault::kSending, frame);  // the first of its images has gone
  }
  hand_on_waiting();
}

}  // namespace lfd::node
