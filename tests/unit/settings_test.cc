// Settings as messages say them, with what they leave out filled in.
#include "proto/settings.h"

#include <gtest/gtest.h>

#include "base/check.h"
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

}  // namespace
}  // namespace lfd
