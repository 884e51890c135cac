// Settings as messages say them, with what they leave out filled in.
#include "proto/settings.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/check.h"
#include "proto/settings_effect.h"
#include "proto/text_file.h"

namespace lfd {
namespace {

TEST(Settings, BlurByGeometryWhereModulesShareUnlessAGaussianIsAskedFor) {
  const auto blur_of = [](const char* text) {
    proto::RenderSettings message;
    LFD_CHECK(parse_text(text, "ao", *message.mutable_ao()), "it is a message");
    return read_settings(message)->ao.blur;
  };
  EXPECT_EQ(blur_of(""), AoBlur::kGaussian);
  EXPECT_EQ(blur_of("shared { neighbours: 0 }"), AoBlur::kGaussian) << "with nobody";
  EXPECT_EQ(blur_of("shared { neighbours: 1 }"), AoBlur::kGeometry);
  EXPECT_EQ(blur_of("shared { neighbours: 1 } blur { taps: 3 }"), AoBlur::kGeometry);
  EXPECT_EQ(blur_of("shared { neighbours: 1 } blur { sigma_px: 2 }"), AoBlur::kGaussian);
  EXPECT_EQ(blur_of("shared { neighbours: 1 } blur { kind: GAUSSIAN }"), AoBlur::kGaussian);
  EXPECT_EQ(blur_of("shared { neighbours: 1 } blur { kind: GEOMETRY sigma_px: 2 }"), AoBlur::kGeometry);
  EXPECT_EQ(blur_of("blur { kind: GEOMETRY }"), AoBlur::kGeometry);
}

TEST(Settings, BlurSaysWhatItIs) {
  AoSettings ao;
  EXPECT_EQ(blur_text(ao), "Gaussian, sigma 1.5 px");
  ao.blur = AoBlur::kGeometry;
  EXPECT_EQ(blur_text(ao), "by geometry, 2 taps a side");
  ao.blur_enabled = false;
  EXPECT_EQ(blur_text(ao), "off");
}

TEST(Settings, WhatHasNoEffectIsNamed) {
  const auto lines_of = [](const char* text) {
    proto::RenderSettings message;
    LFD_CHECK(parse_text(text, "ao", *message.mutable_ao()), "it is a message");
    return without_effect(message);
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines_of("method: \"gtao\" samples: 8"), Lines{"ao.samples: has no effect: gtao takes none"});
  EXPECT_EQ(lines_of("budget_ms: 2 samples: 8"),
            Lines{"ao.samples: has no effect: with a budget every node chooses them"});
  EXPECT_EQ(lines_of("radius_m: 1 radius_roi: 0.1"), Lines{"ao.radius_roi: has no effect beside ao.radius_m"});
  EXPECT_EQ(lines_of("blur { kind: GEOMETRY sigma_px: 2 }"),
            Lines{"ao.blur.sigma_px: has no effect: the blur weighs by geometry"});
  EXPECT_EQ(lines_of("blur { taps: 2 }"), Lines{"ao.blur.taps: has no effect: the blur is Gaussian"});
  for (const char* const good : {"", "samples: 8", "radius_m: 1", "radius_roi: 0.1", "blur { sigma_px: 2 }",
                                 "blur { kind: GEOMETRY taps: 3 }", "enabled: false radius_m: 1 radius_roi: 0.1"})
    EXPECT_EQ(lines_of(good), Lines{}) << good;
}

}  // namespace
}  // namespace lfd
