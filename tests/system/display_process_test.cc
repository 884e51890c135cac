// lfd-display as a real process between a controller and nodes that the test plays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"
#include "display/frame_folder.h"
#include "proto/calibration_file.h"
#include "proto/frame_files.h"
#include "proto/pictures/exr.h"
#include "proto/pictures/png.h"
#include "proto/wire/poll.h"
#include "proto/wire/socket.h"
#include "tests/harness/workbench.h"

namespace lfd::display {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr auto kPatience = 60s;  // of the test with a machine that is busy; nothing is measured by it
constexpr ImageSize kSize{4, 3};

DisplayCalibration two_modules() {
  DisplayCalibration display{"two", {0.4, 0.3}, kSize, {Diffuser::kLinear, 0, 0.8}, 0.1, {}};
  for (const double x : {-0.1, 0.1}) display.modules.push_back({{x, 0, -0.6}, IdealMap{}});
  return display;
}

std::unique_ptr<Process> start_display(std::vector<std::string> arguments) {
  return harness::start_program("lfd-display", std::move(arguments));
}

// Waits for the end of a process; 1000 and more: a signal ended it.
int exit_code(Process& process, Clock::duration at_most = kPatience) {
  const auto exit = process.wait(at_most);
  if (!exit) ADD_FAILURE() << "it does not end: " << testing::PrintToString(process.lines());
  if (!exit) return -1;
  return exit->signal == 0 ? exit->code : 1000 + exit->signal;
}

class DisplayProcess : public testing::Test {
 protected:
  DisplayProcess() : folder_(fs::temp_directory_path() / fmt::format("lfd-display-test-{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~DisplayProcess() override { fs::remove_all(folder_); }

  // Receives until `wanted` is true of a message.
  template <class Wanted>
  wire::Message expect(wire::Socket& socket, Wanted wanted) {
    const auto until = Clock::now() + kPatience;
    while (Clock::now() < until) {
      while (auto message = socket.receive()) {
        if (wanted(message->envelope)) return std::move(*message);
      }
      wire::wait({&socket}, {}, 50ms);
    }
    ADD_FAILURE() << "the message did not come";
    return {};
  }

  // Plays the controller until the display has joined; answers where it takes images.
  std::string welcome() {
    const auto join = expect(control_, [](const auto& e) { return e.has_join(); });
    EXPECT_EQ(join.envelope.join().role(), proto::DISPLAY);
    display_ = join.peer;
    proto::Envelope envelope;
    auto* message = envelope.mutable_welcome();
    message->set_state_endpoint(state_.endpoint());
    *message->mutable_display() = write_calibration(two_modules());
    message->set_heartbeat_ms(100);
    EXPECT_TRUE(control_.send_to(display_, envelope));
    expect(control_, [](const auto& e) { return e.has_heartbeat(); });
    return join.envelope.join().images_endpoint();
  }

  void swap(std::uint64_t frame) {
    proto::Envelope envelope;
    envelope.mutable_swap()->set_frame(frame);
    EXPECT_TRUE(state_.send(envelope));
  }

  wire::Context context_;
  wire::Socket control_ = *wire::bind_router(context_, "tcp://127.0.0.1:*");
  wire::Socket state_ = *wire::bind_publisher(context_, "tcp://127.0.0.1:*");
  std::string display_;
  fs::path folder_;
};

// A node as the display sees it: says hello, sends as far as its credit goes.
class Node {
 public:
  Node(wire::Context& context, const std::string& endpoint)
      : socket_(*wire::connect_dealer(context, endpoint, wire::kImages)) {
    proto::Envelope hello;
    hello.mutable_hello()->set_node("a");
    send(hello, {});
  }

  void send_image(const proto::Image& image, const wire::Payload& pixels) {
    const auto until = Clock::now() + kPatience;
    while (credit_ == 0 && Clock::now() < until) {
      wire::wait({&socket_}, {}, 50ms);
      while (const auto message = socket_.receive()) credit_ += message->envelope.credit().images();
    }
    ASSERT_GT(credit_, 0u) << "no credit came";
    --credit_;
    proto::Envelope envelope;
    *envelope.mutable_image() = image;
    send(envelope, pixels);
  }

  // Colour (all bytes `value`) and depth of module 0; module 1 empty, on a white background.
  void send_frame(std::uint64_t frame, std::uint8_t value) {
    proto::Image image;
    image.set_frame(frame);
    image.set_width_px(kSize.width);
    image.set_height_px(kSize.height);
    image.set_of_images(3);
    send_image(image, std::make_shared<const std::string>(4 * kSize.width * kSize.height, static_cast<char>(value)));
    proto::Image depth = image;
    depth.set_buffer(proto::DEPTH);
    depth.set_format(proto::RGBA32F);
    const auto floats = std::make_shared<const std::vector<float>>(4 * kSize.width * kSize.height, -0.25f);
    send_image(depth, wire::Payload(floats, std::as_bytes(std::span(*floats))));
    image.set_module(1);
    image.set_empty(true);
    for (auto set : {&proto::Color::set_r, &proto::Color::set_g, &proto::Color::set_b})
      (image.mutable_background()->*set)(1);
    send_image(image, {});
  }

 private:
  void send(const proto::Envelope& envelope, const wire::Payload& payload) {
    const auto until = Clock::now() + kPatience;
    while (!socket_.send(envelope, payload)) {
      ASSERT_LT(Clock::now(), until) << "never connected";
      wire::wait({&socket_}, {}, 10ms);
    }
  }

  wire::Socket socket_;
  std::uint32_t credit_ = 0;
};

TEST_F(DisplayProcess, WritesWholeFramesSaysSoAndQuits) {
  const fs::path out = folder_ / "out";
  const auto display =
      start_display({"--controller", control_.endpoint(), "--out", out.string(), "--log-level", "warn"});
  Node node(context_, welcome());
  for (const std::uint64_t frame : {0, 1, 2}) {
    node.send_frame(frame, static_cast<std::uint8_t>(10 + frame));
    swap(frame);
    const auto shown = expect(control_, [](const auto& e) { return e.has_shown(); });
    EXPECT_EQ(shown.envelope.shown().frame(), frame);
    EXPECT_EQ(shown.envelope.shown().modules(), 2u);
    const auto color = read_png(image_path(out, frame, 0, proto::COLOR));
    ASSERT_TRUE(color) << color.error().message();
    EXPECT_EQ(color->rgba[0], 10 + frame);
    const auto depth = read_exr(image_path(out, frame, 0, proto::DEPTH));
    ASSERT_TRUE(depth) << depth.error().message();
    EXPECT_THAT(depth->rgba, testing::Each(-0.25f));
    EXPECT_THAT(read_png(image_path(out, frame, 1, proto::COLOR))->rgba, testing::Each(255));
  }
  proto::Envelope quit;
  quit.mutable_quit()->set_reason("done");
  EXPECT_TRUE(state_.send(quit));
  expect(control_, [](const auto& e) { return e.has_leave(); });
  EXPECT_EQ(exit_code(*display), 0);
}

TEST_F(DisplayProcess, WrittenFramesBecomeViewsAndSheets) {
  ASSERT_TRUE(make_folder(frame_path(folder_, 0)));
  for (const int module : {0, 1}) {
    Picture8 picture = black_picture(kSize.width, kSize.height);
    std::fill(picture.rgba.begin(), picture.rgba.end(), std::uint8_t(200));
    ASSERT_TRUE(write_png(image_path(folder_, 0, module, proto::COLOR), picture));
  }
  const fs::path file = folder_ / "two.textproto", frames = folder_ / "frame-0000";
  ASSERT_TRUE(save_calibration(file, two_modules()));
  const auto view = start_display({"view", "--frames-dir", frames.string(), "--display", file.string(), "--eye",
                                   "-0.1,0,0.8", "--out", (folder_ / "view.png").string(), "--width", "40"});
  EXPECT_EQ(exit_code(*view), 0);
  const auto picture = read_png(folder_ / "view.png");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 40);
  EXPECT_EQ(picture->height, 30);
  EXPECT_EQ(picture->rgba[0], 200);
  const auto sheet =
      start_display({"sheet", "--frames-dir", frames.string(), "--out", (folder_ / "sheet.png").string()});
  EXPECT_EQ(exit_code(*sheet), 0);
  EXPECT_TRUE(read_png(folder_ / "sheet.png"));
}

TEST_F(DisplayProcess, FramesGoOnWhereTheFolderCannotBeWritten) {
  ASSERT_TRUE(write_file(folder_ / "file", "in the way"));
  const auto display =
      start_display({"--controller", control_.endpoint(), "--out", (folder_ / "file").string(), "--log-level", "off"});
  Node node(context_, welcome());
  for (const std::uint64_t frame : {7, 8}) {
    node.send_frame(frame, 1);
    swap(frame);
    EXPECT_EQ(expect(control_, [](const auto& e) { return e.has_shown(); }).envelope.shown().frame(), frame);
  }
  display->signal(SIGTERM);
  EXPECT_EQ(exit_code(*display, std::chrono::seconds(2)), 0);
}

TEST_F(DisplayProcess, EndsOnSignalsWhileTheControllerIsAwayOrHalfwayThroughAFrame) {
  for (const int number : {SIGTERM, SIGINT}) {
    const auto lonely = start_display({"--controller", "tcp://127.0.0.1:1", "--log-level", "info"});
    ASSERT_TRUE(lonely->wait_for_line("controller at", std::chrono::seconds(20)));  // it hears signals from now on
    const auto joined = start_display({"--controller", control_.endpoint(), "--log-level", "off"});
    Node node(context_, welcome());
    proto::Image image;
    image.set_width_px(kSize.width);
    image.set_height_px(kSize.height);
    image.set_of_images(2);
    node.send_image(image, std::make_shared<const std::string>(48, 'x'));
    lonely->signal(number);
    joined->signal(number);
    EXPECT_EQ(exit_code(*joined, std::chrono::seconds(2)), 0);
    EXPECT_EQ(exit_code(*lonely, std::chrono::seconds(2)), 0);
  }
}

TEST_F(DisplayProcess, JoinsAgainWhereTheControllerFellSilent) {
  const auto display = start_display({"--controller", control_.endpoint(), "--log-level", "off"});
  welcome();
  expect(control_, [](const auto& e) { return e.has_join(); });  // six silent heartbeats later
  welcome();
}

TEST_F(DisplayProcess, JoinsAgainWhereANewControllerDoesNotKnowIt) {
  const auto display = start_display({"--controller", control_.endpoint(), "--log-level", "off"});
  welcome();
  proto::Envelope stranger;
  stranger.mutable_refused()->set_reason("not a member of this cluster");
  stranger.mutable_refused()->set_not_a_member(true);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(control_.send_to(display_, stranger));  // an answer to every heartbeat
  welcome();
  expect(control_, [](const auto& e) { return e.has_heartbeat(); });
  EXPECT_FALSE(display->poll());
}

TEST_F(DisplayProcess, JoinsLaterWhereItIsToldToTryAgain) {
  const auto display = start_display({"--controller", control_.endpoint()});
  proto::Envelope later;
  later.mutable_refused()->set_reason("too many want to join");
  later.mutable_refused()->set_try_again_ms(700);
  for (int i = 0; i < 2; ++i) {
    const auto join = expect(control_, [](const auto& e) { return e.has_join(); });
    ASSERT_TRUE(control_.send_to(join.peer, later));
  }
  welcome();
  ASSERT_TRUE(control_.send_to(display_, later));  // of a join before the one that let it in
  for (int i = 0; i < 3; ++i) expect(control_, [](const auto& e) { return e.has_heartbeat(); });
  EXPECT_FALSE(display->poll());
  int said = 0;
  for (const std::string& line : display->lines()) {
    if (line.find("not let in yet: too many want to join; joining again every 700 ms") != std::string::npos) ++said;
  }
  EXPECT_EQ(said, 1);
}

TEST_F(DisplayProcess, FailsWithTheReasonWhereItIsRefusedOrItsEndpointIsTaken) {
  const auto refused = start_display({"--controller", control_.endpoint(), "--log-level", "off"});
  const auto join = expect(control_, [](const auto& e) { return e.has_join(); });
  proto::Envelope envelope;
  envelope.mutable_refused()->set_reason("another calibration");
  ASSERT_TRUE(control_.send_to(join.peer, envelope));
  EXPECT_EQ(exit_code(*refused), 1);
  const auto clash =
      start_display({"--controller", control_.endpoint(), "--images", control_.endpoint(), "--log-level", "off"});
  EXPECT_EQ(exit_code(*clash), 1);
  const auto wrong = start_display({"--no-such-option"});
  EXPECT_EQ(exit_code(*wrong), 2);
}

}  // namespace
}  // namespace lfd::display
