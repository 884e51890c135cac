// A controller's status as text for people.
#pragma once

#include <string>

#include "proto/wire.pb.h"

namespace lfd {

std::string status_table(const proto::Status& status);

// Both boxes, a line each.
std::string roi_text(const proto::RegionOfInterest& roi);

// What a node does with these settings, a line each.
std::string ao_text(const proto::AmbientOcclusion& ao);

// What modules show instead of the scene, on one line without its end: "off", "solid, colour 1,0,0, modules 17,20-25".
std::string pattern_text(const proto::TestPattern& pattern);

}  // namespace lfd
