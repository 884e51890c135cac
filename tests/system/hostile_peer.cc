// Bytes, frames, words and connections of somebody else.
#include "tests/system/hostile_peer.h"

#include <thread>
#include <zmq.hpp>

#include "base/log.h"
#include "base/version.h"

namespace lfd::harness {
namespace {

using namespace std::chrono_literals;

std::string random_bytes(std::mt19937& random, std::size_t count) {
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

std::string text_of(proto::Envelope envelope) {
  envelope.set_protocol(kProtocolVersion);
  return envelope.SerializeAsString();
}

proto::Envelope join(const Target& target, proto::Role role, const std::string& name, std::uint64_t process) {
  proto::Envelope envelope;
  envelope.mutable_join()->set_role(role);
  envelope.mutable_join()->set_name(name);
  envelope.mutable_join()->set_version(kVersion);
  envelope.mutable_join()->set_calibration_hash(target.calibration_hash);
  envelope.mutable_join()->set_process(process);
  envelope.mutable_join()->set_images_endpoint(role == proto::DISPLAY ? "tcp://127.0.0.1:1" : "");
  return envelope;
}

// Everything that node "left" says, as somebody who listened would say it again.
std::vector<std::string> words_of_left(const Target& target) {
  proto::Envelope heartbeat, drawn, ready, shown, snapshot, leave;
  heartbeat.mutable_heartbeat()->set_state_hash("of another state");
  drawn.mutable_drawn()->set_frame(target.frame + 2);
  ready.mutable_ready()->set_frame(target.frame + 2);
  ready.mutable_ready()->mutable_report()->set_error("it cannot be drawn");
  shown.mutable_shown()->set_frame(target.frame + 2);
  snapshot.mutable_snapshot_request();
  leave.mutable_leave()->set_reason("it never said so");
  std::vector<std::string> words{text_of(join(target, proto::NODE, "left", target.left_process))};
  for (const auto& envelope : {heartbeat, drawn, ready, shown, snapshot, leave}) words.push_back(text_of(envelope));
  return words;
}

proto::Envelope image_of(std::uint64_t frame, std::uint32_t module) {
  proto::Envelope envelope;
  proto::Image& image = *envelope.mutable_image();
  image.set_frame(frame);
  image.set_module(module);
  image.set_width_px(16);
  image.set_height_px(8);
  image.set_of_images(1);
  return envelope;
}

zmq::socket_t connected(zmq::context_t& context, zmq::socket_type type, const std::string& endpoint,
                        const KeyRing* keys, Right listener) {
  namespace option = zmq::sockopt;
  zmq::socket_t socket(context, type);
  socket.set(option::linger, 0);
  if (keys != nullptr) {
    socket.set(option::curve_publickey, keys->own.public_key());
    socket.set(option::curve_secretkey, keys->own.secret_key());
    socket.set(option::curve_serverkey, keys->allowed.with_right(listener)->public_key);
  }
  socket.connect(endpoint);
  return socket;
}

// Nothing that comes back is ever read.
void say(zmq::socket_t& socket, const std::vector<std::string>& envelopes, int times = 1) {
  for (int i = 0; i < times; ++i) {
    for (const std::string& text : envelopes)
      [[maybe_unused]] const auto sent = socket.send(zmq::buffer(text), zmq::send_flags::dontwait);
  }
}

void say_images(zmq::socket_t& socket, const Target& target, const std::string& name) {
  const std::string pixels(16 * 8 * 4, 'x');
  if (!name.empty()) {
    proto::Envelope hello;
    hello.mutable_hello()->set_node(name);
    say(socket, {text_of(hello)}, 3);
  }
  for (const std::uint64_t ahead : {0U, 1U, 2U, 5U, 100U, 1'000'000'000U}) {
    for (std::uint32_t module = 0; module < 5; ++module) {
      const std::string header = text_of(image_of(target.frame + ahead, module));
      if (!socket.send(zmq::buffer(header), zmq::send_flags::dontwait | zmq::send_flags::sndmore)) return;
      [[maybe_unused]] const auto sent = socket.send(zmq::buffer(pixels), zmq::send_flags::dontwait);
    }
  }
}

const std::vector<std::pair<std::string, std::string>> kDealer{{"Socket-Type", "DEALER"}, {"Identity", ""}};
const std::vector<std::pair<std::string, std::string>> kSubscriber{{"Socket-Type", "SUB"}, {"Identity", ""}};

// Envelopes cut off anywhere, and some that hold far more messages than bytes.
std::vector<std::string> bad_envelopes(const Target& target, std::mt19937& random) {
  std::vector<std::string> bad{"", random_bytes(random, 1), random_bytes(random, 4096)};
  for (const std::string& words : words_of_left(target)) {
    for (std::size_t end = 1; end < words.size(); end += 3) bad.push_back(words.substr(0, end));
  }
  proto::Envelope many;
  for (int i = 0; i < 20'000; ++i) many.mutable_ready()->mutable_report()->add_pass();
  bad.push_back(text_of(many));
  for (int i = 0; i < 20'000; ++i) many.mutable_ready()->mutable_report()->add_pass();
  bad.push_back(text_of(many));
  return bad;
}

}  // namespace

int send_garbage(const Target& target, std::mt19937& random) {
  int arrived = 0;
  for (const std::string& endpoint : target.all()) {
    for (int i = 0; i < 10; ++i) RawPeer(endpoint).send_bytes(random_bytes(random, 1 + random() % 20'000));
    for (const char* const mechanism : {"NULL", "PLAIN", "CURVE", "GSSAPI", "", "NOBODY KNOWS THIS MECHANISM"}) {
      const std::string greeting = zmtp_greeting(mechanism);
      for (const std::size_t end : {1U, 9U, 10U, 11U, 12U, 40U, 64U})
        RawPeer(endpoint).send_bytes(greeting.substr(0, end));
      for (const char version : {'\0', '\1', '\2', '\x09', '\xFF'}) {
        std::string other = greeting + random_bytes(random, 200);
        other[10] = version;
        RawPeer(endpoint).send_bytes(other);
      }
      RawPeer(endpoint).send_bytes(greeting + random_bytes(random, 5000));
      RawPeer(endpoint).send_bytes(greeting + std::string("\4\xFF\5READY", 8) + std::string(300, '\xFF'));
      RawPeer large(endpoint);
      large.send_bytes(greeting);
      large.send_frame_header(std::uint64_t{1} << 62);
      large.send_bytes(random_bytes(random, 100'000));
    }
    RawPeer(endpoint).send_bytes("GET / HTTP/1.1\r\nHost: lfd\r\n\r\n");
    RawPeer last(endpoint);  // connections are taken in one by one
    const bool is_greeted = last.receive(10, 10s).size() == 10;
    last.send_bytes(zmtp_greeting("NOBODY KNOWS IT"));
    if (is_greeted && last.is_hung_up_on(10s)) ++arrived;
  }
  return arrived;
}

int send_bad_frames(const Target& target, std::mt19937& random) {
  int greeted = 0;
  for (const std::string& endpoint : target.all()) {
    bool all = true;
    const auto& properties = endpoint == target.state ? kSubscriber : kDealer;
    const auto with_peer = [&](const auto& what) {
      RawPeer peer(endpoint);
      if (peer.is_open() && peer.shake_hands(properties)) {
        what(peer);
      } else {
        all = false;
      }
    };
    with_peer([&](RawPeer& peer) {
      for (const std::string& envelope : bad_envelopes(target, random)) peer.send_frame(envelope);
    });
    with_peer([&](RawPeer& peer) {
      for (int i = 0; i < 1000; ++i) peer.send_frame(random_bytes(random, 30), true);
    });
    for (const std::uint64_t size :
         {std::uint64_t{5} << 20, std::uint64_t{1} << 31, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
      with_peer([&](RawPeer& peer) {
        peer.send_frame_header(size);
        peer.send_bytes(random_bytes(random, 100'000));
      });
    }
    with_peer([&](RawPeer& peer) { peer.send_bytes(random_bytes(random, 50'000)); });
    // Subscriptions to things that do not exist.
    with_peer([&](RawPeer& peer) {
      for (int i = 0; i < 1000; ++i) peer.send_frame("\1" + random_bytes(random, 20));
      peer.send_frame("\1" + random_bytes(random, 100'000));
    });
    if (all) ++greeted;
  }
  return greeted;
}

void send_bad_messages(const Target& target, std::mt19937& random, const StolenKeys& keys) {
  zmq::context_t context;
  std::vector<zmq::socket_t> sockets;
  for (const std::string& endpoint : {target.control, target.bulk, target.images}) {
    const bool shows = endpoint == target.images;
    const auto peer = [&]() -> zmq::socket_t& {
      return sockets.emplace_back(connected(context, zmq::socket_type::dealer, endpoint,
                                            shows ? keys.images : keys.control,
                                            shows ? proto::Allowed::DISPLAY : proto::Allowed::CONTROLLER));
    };
    say(peer(), bad_envelopes(target, random));
    zmq::socket_t& of_many = peer();
    for (int i = 0; i < 10'000; ++i) {
      const auto more = i % 100 == 99 ? zmq::send_flags::none : zmq::send_flags::sndmore;
      of_many.send(zmq::buffer(random_bytes(random, 30)), more | zmq::send_flags::dontwait);
    }
    say(peer(), {std::string(std::size_t{5} << 20, 'x')});
  }
  zmq::socket_t& listener = sockets.emplace_back(
      connected(context, zmq::socket_type::sub, target.state, keys.control, proto::Allowed::CONTROLLER));
  for (int i = 0; i < 1000; ++i) listener.set(zmq::sockopt::subscribe, random_bytes(random, 20));
  zmq::socket_t& loud = sockets.emplace_back(
      connected(context, zmq::socket_type::sub, target.state, keys.control, proto::Allowed::CONTROLLER));
  loud.set(zmq::sockopt::subscribe, random_bytes(random, 100'000));
  std::this_thread::sleep_for(2s);  // the attack lasts; nothing waits for it
}

void send_words_of_others(const Target& target, const StolenKeys& keys) {
  zmq::context_t context;
  std::vector<zmq::socket_t> sockets;
  const auto at = [&](const std::string& endpoint, Right listener) -> zmq::socket_t& {
    return sockets.emplace_back(connected(context, zmq::socket_type::dealer, endpoint,
                                          listener == proto::Allowed::DISPLAY ? keys.images : keys.control, listener));
  };
  say(at(target.control, proto::Allowed::CONTROLLER), words_of_left(target), 20);
  for (int i = 0; i < 20; ++i) {
    std::vector<std::string> flood;
    for (int k = 0; k < 50; ++k) {
      flood.push_back(text_of(join(target, proto::DISPLAY, fmt::format("display {} {}", i, k), 0)));
      flood.push_back(text_of(join(target, proto::NODE, "right", static_cast<std::uint64_t>(1'000'000 + k))));
      flood.push_back(text_of(join(target, proto::NODE, std::string(1000, 'x') + "\n\x1b[31m", 0)));
    }
    say(at(target.control, proto::Allowed::CONTROLLER), flood);
  }
  proto::Envelope status, want;
  status.mutable_request()->mutable_status();
  want.mutable_want()->set_hash("nothing has this hash");
  say(at(target.control, proto::Allowed::CONTROLLER), {text_of(status)}, 3000);
  say(at(target.bulk, proto::Allowed::CONTROLLER), {text_of(want)}, 3000);
  for (const char* const name : {"", "left", "nobody"})
    say_images(at(target.images, proto::Allowed::DISPLAY), target, name);
  std::this_thread::sleep_for(2s);  // the attack lasts; nothing waits for it
}

std::vector<RawPeer> hold_connections(const Target& target, int count) {
  std::vector<RawPeer> peers;
  const std::vector<std::string> endpoints = target.all();
  for (int i = 0; i < count; ++i) {
    RawPeer peer(endpoints[static_cast<std::size_t>(i) % endpoints.size()]);
    if (!peer.is_open()) break;
    if (i / 4 % 2 == 0) peer.send_bytes(zmtp_greeting("NULL"));
    peers.push_back(std::move(peer));
  }
  return peers;
}

}  // namespace lfd::harness
