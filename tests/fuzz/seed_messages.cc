// One message of each kind.
#include "tests/fuzz/seed_messages.h"

#include <functional>

#include "base/hash.h"
#include "base/version.h"
#include "calibration/make.h"
#include "proto/calibration_file.h"
#include "tests/fuzz/peers.h"
#include "tests/support/made.h"

namespace lfd::fuzz {
namespace {

proto::Envelope envelope_with(const std::function<void(proto::Envelope&)>& fill) {
  proto::Envelope envelope;
  envelope.set_protocol(kProtocolVersion);
  fill(envelope);
  return envelope;
}

}  // namespace

std::vector<Step> steps() {
  std::vector<Step> all;
  const auto add = [&](const std::string& name, const std::function<void(proto::Envelope&)>& fill,
                       const std::string& payload = {}, int sender = 0, int wait = 0) {
    all.push_back({name, envelope_with(fill), payload, sender, wait});
  };
  add("heartbeat", [](auto& e) { e.mutable_heartbeat()->set_state_hash(content_hash("state")); });
  add("drawn", [](auto& e) { e.mutable_drawn()->set_frame(0); });
  add("ready", [](auto& e) {
    e.mutable_ready()->set_frame(0);
    e.mutable_ready()->mutable_report()->set_node("left");
    e.mutable_ready()->mutable_report()->add_pass()->set_pass("ao");
  });
  add(
      "ready_failed", [](auto& e) { e.mutable_ready()->mutable_report()->set_error("no memory"); }, {}, 1);
  add(
      "shown", [](auto& e) { e.mutable_shown()->set_modules(2); }, {}, 2);
  add(
      "image",
      [](auto& e) {
        proto::Image& image = *e.mutable_image();
        image.set_width_px(2);
        image.set_height_px(1);
        image.set_of_images(1);
      },
      "12345678");
  add(
      "image_empty",
      [](auto& e) {
        e.mutable_image()->set_module(1);
        e.mutable_image()->set_empty(true);
        e.mutable_image()->set_of_images(1);
        e.mutable_image()->mutable_background()->set_r(0.5);
      },
      {}, 1);
  add("swap", [](auto& e) { e.mutable_swap()->add_stale_modules(1); });
  add("hello", [](auto& e) { e.mutable_hello()->set_node("left"); });
  add("credit", [](auto& e) {
    e.mutable_credit()->set_images(2);
    e.mutable_credit()->set_anew(true);
  });
  add("welcome", [](auto& e) {
    *e.mutable_welcome()->mutable_display() = write_calibration(*make_display("desk"));
    e.mutable_welcome()->mutable_stream()->set_codec(proto::ZSTD_IMAGES);
    e.mutable_welcome()->set_state_endpoint("tcp://127.0.0.1:5000");
  });
  add("assign", [](auto& e) { e.mutable_assign()->add_modules(1); });
  add("prepare", [](auto& e) {
    e.mutable_prepare()->set_number(1);
    *e.mutable_prepare()->mutable_update()->mutable_scene() = testing_support::made_data("plane").scene;
  });
  add("prepared", [](auto& e) { e.mutable_prepared()->set_number(1); });
  add(
      "prepared_not", [](auto& e) { e.mutable_prepared()->set_error("no memory"); }, {}, 1);
  add("want", [](auto& e) {
    e.mutable_want()->set_hash(content_hash(Peers::kAsset));
    e.mutable_want()->set_offset(10);
    e.mutable_want()->set_length(100);
  });
  add("refused", [](auto& e) { e.mutable_refused()->set_reason("another version"); });
  add("quit", [](auto& e) { e.mutable_quit()->set_reason("enough"); });
  add("reply", [](auto& e) {
    proto::Status& status = *e.mutable_reply()->mutable_status();
    status.set_deployment("desk");
    status.set_last_fault("out");
    proto::PeerStatus& peer = *status.add_peer();
    peer.set_name("left");
    peer.add_module(1);
    peer.add_pass()->set_pass("ao");
    status.mutable_render()->mutable_ao()->set_method("hbao");
    status.mutable_render()->mutable_pattern()->add_modules("0-1");
  });
  for (const char* const what : {"status", "follow", "quit", "frames", "scene_file"}) {
    add(
        std::string("request_") + what,
        [what = std::string(what)](auto& e) {
          proto::Request& request = *e.mutable_request();
          if (what == "status") request.mutable_status();
          if (what == "follow") request.mutable_follow();
          if (what == "quit") request.mutable_quit();
          if (what == "frames") request.mutable_frames()->set_count(2);
          if (what == "scene_file") request.set_scene_file("some.glb");
        },
        {}, 3);
  }
  add("update", [](auto& e) {
    e.mutable_update()->set_sequence(2);
    e.mutable_update()->set_buffers(3);
  });
  add("update_instances", [](auto& e) {
    const SceneData plane = testing_support::made_data("plane");
    e.mutable_update()->set_sequence(3);
    proto::MovedInstance& moved = *e.mutable_update()->add_moved_instance();
    moved.set_mesh(plane.scene.instance(0).mesh());
    *moved.mutable_world_from_mesh() = plane.scene.instance(0).world_from_mesh();
    *e.mutable_update()->add_moved_light()->mutable_light() = plane.scene.light(0);
  });
  add("snapshot", [](auto& e) {
    proto::State& state = *e.mutable_snapshot()->mutable_state();
    state.set_sequence(7);
    *state.mutable_scene() = testing_support::made_data("plane").scene;
  });
  add("pulse", [](auto& e) { e.mutable_pulse()->set_sequence(9); });
  add("begin", [](auto& e) { e.mutable_begin()->set_sequence(9); });
  for (std::size_t at = 0; at < Peers::kAsset.size(); at += Peers::kPiece_bytes) {
    add(
        "chunk_" + std::to_string(at),
        [at](auto& e) {
          e.mutable_chunk()->set_hash(content_hash(Peers::kAsset));
          e.mutable_chunk()->set_offset(at);
          e.mutable_chunk()->set_total(Peers::kAsset.size());
        },
        std::string(Peers::kAsset.substr(at, Peers::kPiece_bytes)));
  }
  add("not_found", [](auto& e) { e.mutable_not_found()->set_hash(content_hash(Peers::kAsset)); });
  add(
      "roi",
      [](auto& e) {
        proto::RegionOfInterest& roi = *e.mutable_request()->mutable_roi();
        roi.mutable_world_size()->set_x(1);
        roi.mutable_world_size()->set_y(1);
        roi.mutable_world_size()->set_z(1);
        roi.mutable_world_centre()->set_x(1);
        roi.mutable_world_orientation()->set_w(1);
      },
      {}, 3);
  add(
      "ao",
      [](auto& e) {
        proto::AmbientOcclusion& ao = *e.mutable_request()->mutable_ao();
        ao.set_method("hbao");
        ao.set_radius_m(0.1);
        ao.set_samples(8);
        (*ao.mutable_parameter())["directions"] = 8;
        ao.mutable_blur()->set_sigma_px(2);
        ao.mutable_shared()->set_neighbours(2);
        ao.mutable_curve()->set_b(1);
      },
      {}, 3);
  add(
      "render",
      [](auto& e) {
        proto::RenderSettings& render = *e.mutable_request()->mutable_render();
        render.mutable_background()->set_g(0.25);
        render.set_near_z_m(1);
        render.set_warp_level(5);
        render.set_subdivision_px(0.1);
      },
      {}, 3);
  add(
      "pattern",
      [](auto& e) {
        proto::TestPattern& pattern = *e.mutable_request()->mutable_pattern();
        pattern.set_kind(proto::TestPattern::GRID);
        pattern.set_space(proto::TestPattern::SCREEN);
        pattern.set_spacing_m(0.1);
        pattern.add_modules("0-1");
        pattern.mutable_color()->set_r(1);
      },
      {}, 3);
  add(
      "leave", [](auto& e) { e.mutable_leave()->set_reason("enough"); }, {}, 1, 2);
  add(
      "join",
      [](auto& e) {
        e.mutable_join()->set_name("right");
        e.mutable_join()->set_version(kVersion);
        e.mutable_join()->set_calibration_hash("c0");
        e.mutable_join()->set_process(9);
      },
      {}, 1, 1);
  add(
      "join_display",
      [](auto& e) {
        e.mutable_join()->set_role(proto::DISPLAY);
        e.mutable_join()->set_name("other");
        e.mutable_join()->set_version(kVersion);
        e.mutable_join()->set_images_endpoint("tcp://127.0.0.1:5000");
      },
      {}, 3, 3);
  return all;
}

}  // namespace lfd::fuzz
