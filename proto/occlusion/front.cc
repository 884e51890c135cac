// The file that the build put into the program.
#include "proto/occlusion/front.h"

#include <string_view>

#include "base/check.h"
#include "proto/text_file.h"

namespace lfd::occlusion {

extern const std::string_view kFrontText;  // written by the build

const proto::OcclusionFront& committed_front() {
  static const proto::OcclusionFront kFront = [] {
    proto::OcclusionFront front;
    const auto parsed = parse_text(kFrontText, "the committed front", front);
    LFD_CHECK(parsed, parsed.error().message());
    LFD_CHECK(front.entry_size() > 0, "the committed front has entries");
    return front;
  }();
  return kFront;
}

proto::AmbientOcclusion with_entry(const proto::AmbientOcclusion& asked, const proto::OcclusionFront::Entry& entry) {
  proto::AmbientOcclusion ao = asked;
  ao.set_method(entry.ao().method());
  ao.set_samples(entry.ao().samples());
  *ao.mutable_parameter() = entry.ao().parameter();
  if (!asked.has_curve() && entry.ao().has_curve()) *ao.mutable_curve() = entry.ao().curve();
  if (asked.radii() == 0) ao.set_radii(entry.ao().radii());
  if (!asked.has_blur() && entry.ao().has_blur()) *ao.mutable_blur() = entry.ao().blur();
  if (!asked.has_shared() && entry.ao().has_shared()) *ao.mutable_shared() = entry.ao().shared();
  return ao;
}

}  // namespace lfd::occlusion
