// lfd-calibrate simulate and fit as processes: files, exit codes, reports and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file.h"
#include "tests/harness/workbench.h"

namespace lfd {
namespace {

using harness::Workbench;
using testing::HasSubstr;

struct Answer {
  Exit exit;
  std::string text;  // standard output and standard error
};

Answer calibrate(const std::vector<std::string>& arguments) {
  const auto process = harness::start_program("lfd-calibrate", arguments);
  const auto exit = process->wait(std::chrono::seconds(60));
  EXPECT_TRUE(exit) << "still runs";
  process->wait_for_line("a line that no program prints", std::chrono::seconds(10));  // until the output has ended
  Answer answer{exit.value_or(Exit{-1, 0}), {}};
  for (const std::string& line : process->lines()) answer.text += line + "\n";
  return answer;
}

// A start, a truth and observations of it, as files.
class LfdCalibrateFit : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(calibrate({"make", "desk", "--modules", "2", "--out", start_}).exit.succeeded());
    ASSERT_TRUE(calibrate({"make", "desk", "--modules", "2", "--perturb", "3", "--out", truth_}).exit.succeeded());
    const Answer made = calibrate({"simulate", truth_, "--out", seen_, "--points", "18x14", "--seed", "2"});
    ASSERT_TRUE(made.exit.succeeded()) << made.text;
    EXPECT_THAT(made.text, HasSubstr(" observations, "));
  }

  std::string path(const char* name) const { return (bench_.folder() / name).string(); }

  Workbench bench_;
  const std::string start_ = path("start.textproto"), truth_ = path("truth.textproto"), seen_ = path("seen.csv");
};

TEST_F(LfdCalibrateFit, MakesACalibrationThatIsAccepted) {
  const std::string fitted = path("fitted.textproto");
  const Answer table = calibrate({"fit", seen_, "--start", start_, "--out", fitted});
  EXPECT_TRUE(table.exit.succeeded()) << table.text;
  EXPECT_THAT(table.text, HasSubstr("residuals before, px"));
  EXPECT_THAT(table.text, HasSubstr("outlier: " + seen_ + ":"));
  EXPECT_TRUE(calibrate({"check", fitted}).exit.succeeded());

  const std::string again = path("again.textproto");
  const Answer report = calibrate({"fit", seen_, "--start", start_, "--out", again, "--json"});
  ASSERT_TRUE(report.exit.succeeded()) << report.text;
  EXPECT_EQ(*read_file(fitted), *read_file(again));
  const auto json = nlohmann::json::parse(report.text);
  ASSERT_EQ(json["modules"].size(), 2u);
  for (const auto& module : json["modules"]) {
    EXPECT_EQ(module["map"], "pinhole");
    EXPECT_NEAR(module["noise_px"].get<double>(), 0.1, 0.03);  // simulate's default
    EXPECT_LT(module["after"]["median_px"].get<double>(), module["before"]["median_px"].get<double>());
    EXPECT_GE(module["after"]["quantile_99_px"].get<double>(), module["after"]["median_px"].get<double>());
    EXPECT_LE(module["after"]["quantile_99_px"].get<double>(), module["after"]["max_px"].get<double>());
  }
  for (const auto& outlier : json["outliers"]) EXPECT_GT(outlier["residual_px"].get<double>(), 5);
}

TEST_F(LfdCalibrateFit, WritesPicturesOfTheResiduals) {
  const std::string folder = path("plots");
  const Answer answer =
      calibrate({"fit", seen_, "--start", start_, "--out", path("fitted.textproto"), "--plot", folder});
  EXPECT_TRUE(answer.exit.succeeded()) << answer.text;
  for (const char* const name : {"residuals-module-000.svg", "residuals-module-001.svg"}) {
    const auto picture = read_file(folder + "/" + name);
    ASSERT_TRUE(picture) << name;
    EXPECT_THAT(*picture, HasSubstr("residuals of the fit"));
  }
}

TEST_F(LfdCalibrateFit, RefusesWithFileAndLine) {
  const auto refusal = [&](const std::string& observations, const std::string& start) {
    const Answer answer = calibrate({"fit", observations, "--start", start, "--out", path("none.textproto")});
    EXPECT_EQ(answer.exit.code, 1) << answer.text;
    EXPECT_FALSE(std::filesystem::exists(path("none.textproto")));
    return answer.text;
  };
  const std::string header = "module,u,v,s,y\n";
  const std::string malformed = bench_.file("malformed.csv", header + "0,1,2,3\n").string();
  EXPECT_THAT(refusal(malformed, start_), HasSubstr("malformed.csv:2: y: is missing"));
  const std::string few = bench_.file("few.csv", header + "0,1,2,0.1,0.1\n").string();
  EXPECT_THAT(refusal(few, start_), HasSubstr("few.csv: module 0: 1 observations are 2 numbers"));
  EXPECT_THAT(refusal(path("absent.csv"), start_), HasSubstr("absent.csv"));
  EXPECT_THAT(refusal(seen_, path("absent.textproto")), HasSubstr("absent.textproto"));
}

TEST_F(LfdCalibrateFit, WrongUseIsExplained) {
  const auto wrong = [&](std::vector<std::string> arguments) {
    const Answer answer = calibrate(arguments);
    EXPECT_EQ(answer.exit.code, 2) << answer.text;
    return answer.text;
  };
  EXPECT_THAT(wrong({"simulate", truth_, "--out", seen_, "--points", "24"}), HasSubstr("as in 24x18"));
  EXPECT_THAT(wrong({"simulate", truth_, "--out", seen_, "--missing", "2"}), HasSubstr("missing: 2"));
  const std::string none = path("none.csv");
  EXPECT_THAT(wrong({"simulate", truth_, "--out", none, "--missing", "1"}),
              HasSubstr("no observation is left to write: --missing 1"));
  EXPECT_FALSE(std::filesystem::exists(none));
  EXPECT_THAT(wrong({"fit", seen_, "--out", path("none.textproto")}), HasSubstr("--start"));
  wrong({"fit", seen_, "--start", start_, "--out", path("none.textproto"), "--emitter-sd", "-1"});
}

}  // namespace
}  // namespace lfd
