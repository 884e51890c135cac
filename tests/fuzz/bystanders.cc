// Messages to those who take them, as their daemons hand them on.
#include "tests/fuzz/bystanders.h"

#include <algorithm>
#include <memory>

#include "base/check.h"
#include "base/hash.h"
#include "cli/status_table.h"
#include "cli/watch_table.h"
#include "controller/cluster_page.h"
#include "controller/daemon/asset_server.h"
#include "controller/rights.h"
#include "proto/calibration_file.h"
#include "proto/deployment_checks.h"
#include "tests/fuzz/peers.h"

namespace lfd::fuzz {
namespace {

void check_refusal(const Status& status) {
  LFD_CHECK(status || !status.error().message().empty(), "every refusal has a reason");
}

// What a terminal gets.
void check_text(const std::string& text) {
  const auto is_control = [](unsigned char c) { return (c < 0x20 && c != '\n') || c == 0x7f; };
  LFD_CHECK(std::ranges::none_of(text, is_control), "no text of a peer reaches a terminal as it is");
}

void read_welcome(const proto::Welcome& welcome) {
  if (const auto display = read_calibration(welcome.display()); !display) check_refusal(display.error());
  (void)deployment::read_stream(welcome.stream());
}

}  // namespace

Bystanders::Bystanders()
    : allowed_{{{"L", "", {proto::Allowed::NODE}}, {"D", "", {proto::Allowed::DISPLAY}}, {"R", "", {}}}} {
  const auto asset = std::make_shared<const std::string>(Peers::kAsset);
  assets_[content_hash(Peers::kAsset)] = asset;
  stats_.joined("L");
  change_.start({"L", "R"});
}

void Bystanders::take(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now) {
  to_rights(sender, envelope, now);
  to_stats(sender, envelope, now);
  to_scene_change(sender, envelope);
  to_images(sender, envelope, now);
  if (envelope.has_welcome()) read_welcome(envelope.welcome());
  if (envelope.has_want()) {
    const controller::AssetAnswer answer = controller::answer_want(envelope.want(), assets_);
    if (!answer.envelope.has_chunk()) return;
    const std::size_t offset = answer.envelope.chunk().offset();
    LFD_CHECK(answer.piece.text() == Peers::kAsset.substr(offset, answer.piece.size()), "a piece is of the asset");
  }
}

void Bystanders::to_rights(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now) {
  if (envelope.has_join()) {
    const Status may = controller::may_join(&allowed_, sender, envelope.join());
    check_refusal(may);
    LFD_CHECK(!may || envelope.join().role() != proto::NODE || envelope.join().name() == sender,
              "a node joins under the name of its key");
    if (!limiter_.admits(envelope.join().name(), now)) limiter_.tells(sender, now);
    LFD_CHECK(limiter_.remembered() < 1000, "who joined long ago is forgotten");
  }
  if (!envelope.has_request()) return;
  const Status may = controller::may_ask(&allowed_, sender, envelope.request());
  check_refusal(may);
  LFD_CHECK(!may, "none of them has a right to ask");
}

void Bystanders::to_stats(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now) {
  if (envelope.has_ready()) stats_.ready(sender, envelope.ready(), now);
  if (envelope.has_shown()) stats_.shown(sender, envelope.shown().frame(), now);
  if (envelope.has_leave()) stats_.fault(sender, envelope.leave().reason());
  if (envelope.has_join()) stats_.join_refused(envelope.join().name(), envelope.join().version());
  if (envelope.has_drawn()) stats_.begun(++frame_, now);
  if (envelope.has_reply() && envelope.reply().has_status()) {
    check_text(status_table(envelope.reply().status()));
    check_text(WatchTable().answered(envelope.reply().status(), now));
    if (const auto display = read_calibration(envelope.reply().follow().display()); !display)
      check_refusal(display.error());
  }
  proto::Status status;
  for (const char* const name : {"L", "R"}) status.add_peer()->set_name(name);
  stats_.fill(status, {}, now);
  LFD_CHECK(status.ByteSizeLong() < (std::size_t{1} << 20), "a status stays short");
  check_text(status_table(status));
  (void)controller::cluster_page(status, stats_);
}

void Bystanders::to_scene_change(const std::string& sender, const proto::Envelope& envelope) {
  using Verdict = controller::SceneChange::Verdict;
  if (envelope.has_prepare()) {
    const proto::Scene& scene = envelope.prepare().update().scene();
    gatherer_.want(scene);
    (void)gatherer_.has_all_of(scene);
    change_.joins(sender);
  }
  if (envelope.has_prepared()) {
    change_.prepared(sender, envelope.prepared().number(), envelope.prepared().error());
    const Verdict verdict = change_.verdict();
    LFD_CHECK(verdict != Verdict::kRefuse || !change_.error().empty(), "every refusal has a reason");
    if (verdict == Verdict::kWait) return;
    change_.finish();
    change_.start({"L", "R"});
  }
}

void Bystanders::to_images(const std::string& sender, const proto::Envelope& envelope, Clock::time_point now) {
  if (envelope.has_hello()) {
    const auto greeting = senders_.hello(sender, "", envelope.hello().node(), now);
    if (!greeting) check_refusal(greeting.error());
    LFD_CHECK(senders_.peers().size() <= display::Senders::kMost, "so many speak at most");
  }
  if (!envelope.has_credit()) return;
  outbox_.credit_came(envelope.credit());
  if (outbox_.idle()) {
    node::OutgoingImage image{.header = {}, .payload = std::make_shared<const std::string>("pixels")};
    image.header.set_frame(++frame_);
    outbox_.push({image, image});
  }
  int gone = 0;
  for (; outbox_.next(); ++gone) outbox_.sent();
  LFD_CHECK(gone <= 2, "a frame goes once");
}

}  // namespace lfd::fuzz
