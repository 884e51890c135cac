// Methods of ambient occlusion as settings know them: names, numbers, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "proto/settings.h"
#include "rendernode/passes/blur_weights.h"

namespace lfd {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string error_of(const proto::AmbientOcclusion& ao) {
  proto::RenderSettings message;
  *message.mutable_ao() = ao;
  const auto settings = read_settings(message);
  return settings ? "" : settings.error().message();
}

AoSettings read(const proto::AmbientOcclusion& ao) {
  proto::RenderSettings message;
  *message.mutable_ao() = ao;
  return read_settings(message)->ao;
}

TEST(OcclusionMethods, AreThoseOfTheLiteratureByTheirNames) {
  std::set<std::string> names;
  for (const occlusion::Method* method : occlusion::methods()) names.insert(std::string(method->name));
  EXPECT_EQ(names.size(), occlusion::methods().size());
  for (const char* name : {"alchemy", "crytek", "gtao", "hbao", "march", "pyramid_hbao", "scalable", "schmitt",
                           "sphere", "starcraft", "unreal", "volumetric"}) {
    EXPECT_TRUE(names.contains(name)) << name;
    EXPECT_EQ(occlusion::find_method(name)->name, name);
  }
  EXPECT_EQ(occlusion::find_method("none"), nullptr);
  EXPECT_EQ(read({}).method->name, "sphere");
}

TEST(OcclusionMethods, HaveFallbacksWithinTheirRangesAndAreReadWithThem) {
  for (const occlusion::Method* method : occlusion::methods()) {
    proto::AmbientOcclusion ao;
    ao.set_method(std::string(method->name));
    const AoSettings settings = read(ao);
    EXPECT_EQ(settings.method, method);
    EXPECT_EQ(settings.parameters, occlusion::fallbacks(*method));
    EXPECT_EQ(settings.curve, method->curve);
    EXPECT_EQ(settings.samples, method->samples);
    const int expected = method->sample_set != nullptr ? method->samples : 0;
    EXPECT_EQ(settings.sample_set().size(), static_cast<std::size_t>(expected)) << method->name;
    EXPECT_TRUE(method->samples > 0 || method->sample_set == nullptr) << method->name;
    for (const auto& one : method->parameters) {
      EXPECT_TRUE(one.fallback >= one.least && one.fallback <= one.most) << method->name << " " << one.name;
      for (const double value : {one.least, one.most}) {
        (*ao.mutable_parameter())[std::string(one.name)] = value;
        EXPECT_EQ(read(ao).parameter(one.name), value);
      }
      ao.clear_parameter();
    }
  }
}

TEST(OcclusionMethods, RefuseWhatTheyCannotBeTold) {
  for (const occlusion::Method* method : occlusion::methods()) {
    for (const auto& one : method->parameters) {
      for (const double value :
           {std::nan(""), one.least - 1e-3, one.most + 1, std::numeric_limits<double>::infinity()}) {
        proto::AmbientOcclusion ao;
        ao.set_method(std::string(method->name));
        (*ao.mutable_parameter())[std::string(one.name)] = value;
        EXPECT_THAT(error_of(ao), StartsWith("ao.parameter \"" + std::string(one.name) + "\": ")) << value;
      }
    }
  }
  proto::AmbientOcclusion ao;
  ao.set_method("hbo");
  EXPECT_EQ(error_of(ao), "ao.method: \"hbo\" is none; did you mean hbao?");
  ao.set_method("hbao");
  (*ao.mutable_parameter())["shell"] = 0.5;
  EXPECT_EQ(error_of(ao), "ao.parameter \"shell\": hbao has directions, steps, bias");
  ao.clear_parameter();
  (*ao.mutable_parameter())["steps"] = 2.5;
  EXPECT_THAT(error_of(ao), HasSubstr("whole numbers"));
  ao.Clear();
  ao.set_method("volumetric");
  ao.set_samples(7);
  EXPECT_THAT(error_of(ao), HasSubstr("in pairs"));
}

TEST(OcclusionMethods, WithACountTakeFewerSamplesFarAway) {
  for (const occlusion::Method* method : occlusion::methods()) {
    proto::AmbientOcclusion ao;
    ao.set_method(std::string(method->name));
    ao.set_least_samples(3);
    if (method->name == "schmitt") {
      EXPECT_EQ(error_of(ao), "ao.least_samples: schmitt looks at as many neighbours everywhere");
    } else {
      EXPECT_EQ(read(ao).least_samples, 3) << method->name;
    }
  }
}

TEST(OcclusionMethods, OrderTheirSetsOnlyWhereFewerOfThemAreTaken) {
  proto::AmbientOcclusion ao;
  ao.set_method("alchemy");
  ao.set_generator(proto::AmbientOcclusion::JITTERED);
  const AoSettings before = read(ao);
  EXPECT_EQ(before.sample_set(),
            before.method->sample_set({before.generator, before.samples, before.seed}, before.parameters));
  ao.set_least_samples(2);
  EXPECT_NE(read(ao).sample_set(), before.sample_set());
}

TEST(BlurWeights, ReachTwoAndAHalfSigma) {
  const auto weights = gaussian_weights(1.5);
  ASSERT_EQ(weights.size(), 5U);  // 0 .. ceil(3.75)
  for (std::size_t i = 0; i < weights.size(); ++i) {
    EXPECT_FLOAT_EQ(weights[i], static_cast<float>(std::exp(-static_cast<double>(i * i) / (2 * 1.5 * 1.5))));
  }
  EXPECT_EQ(gaussian_weights(100).size(), 25U) << "what the shader has room for";
  EXPECT_EQ(gaussian_weights(0.1).size(), 2U);
}

}  // namespace
}  // namespace lfd
