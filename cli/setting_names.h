// What people call the values of settings.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "proto/settings.pb.h"

namespace lfd {

inline const std::map<std::string, proto::AmbientOcclusion::Generator> kGeneratorNames{
    {"poisson-disk", proto::AmbientOcclusion::POISSON_DISK},
    {"uniform", proto::AmbientOcclusion::UNIFORM},
    {"jittered", proto::AmbientOcclusion::JITTERED},
    {"latin-square", proto::AmbientOcclusion::LATIN_SQUARE}};

inline const std::map<std::string, proto::AmbientOcclusion::Target> kTargetNames{
    {"ambient-light", proto::AmbientOcclusion::AMBIENT_LIGHT}, {"whole-color", proto::AmbientOcclusion::WHOLE_COLOR}};

inline const std::map<std::string, proto::AmbientOcclusion::Blur::Kind> kBlurNames{
    {"gaussian", proto::AmbientOcclusion::Blur::GAUSSIAN}, {"geometry", proto::AmbientOcclusion::Blur::GEOMETRY}};

inline const std::map<std::string, proto::TestPattern::Kind> kPatternNames{{"off", proto::TestPattern::NONE},
                                                                           {"number", proto::TestPattern::NUMBER},
                                                                           {"grid", proto::TestPattern::GRID},
                                                                           {"checker", proto::TestPattern::CHECKER},
                                                                           {"solid", proto::TestPattern::SOLID}};

inline const std::map<std::string, proto::TestPattern::Space> kSpaceNames{{"image", proto::TestPattern::IMAGE},
                                                                          {"screen", proto::TestPattern::SCREEN}};

template <class Enumeration>
std::vector<std::string> names_of(const std::map<std::string, Enumeration>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

// "?" for a value without a name.
template <class Enumeration>
std::string name_of(const std::map<std::string, Enumeration>& values, Enumeration wanted) {
  for (const auto& [name, value] : values) {
    if (value == wanted) return name;
  }
  return "?";
}

}  // namespace lfd
