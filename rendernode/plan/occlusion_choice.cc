// The decision.
#include "rendernode/plan/occlusion_choice.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/log.h"
#include "proto/occlusion/front.h"

namespace lfd {
namespace {

constexpr std::size_t kTooSlowInARow = 3;
constexpr double kFarTooSlow = 4;  // times the budget

Result<AoSettings> ao_from(const proto::AmbientOcclusion& message) {
  proto::RenderSettings render;
  *render.mutable_ao() = message;
  LFD_TRY(const RenderSettings settings, read_settings(render));
  return settings.ao;
}

}  // namespace

OcclusionChoice::OcclusionChoice(const proto::OcclusionFront& front, const proto::AmbientOcclusion& asked, int modules)
    : budget_ms_(asked.budget_ms()) {
  const auto own = ao_from(asked);
  LFD_CHECK(own, "settings are checked before they are chosen from");
  asked_ = *own;
  for (const auto& entry : front.entry()) {
    auto ao = ao_from(occlusion::with_entry(asked, entry));
    // What the asked-for options do not go with is no candidate, nor sharing of the entry's own that has nobody to
    // share with.
    if (!ao || (!asked.has_shared() && ao->shared_neighbours >= modules)) continue;
    candidates_.push_back({*std::move(ao), entry.name(), entry.mae(), std::nullopt});
  }
}

bool OcclusionChoice::is_done() const {
  if (timed_ == candidates_.size()) return true;
  if (timed_ == 0) return false;
  if (*candidates_[timed_ - 1].ms > kFarTooSlow * budget_ms_) return true;
  if (timed_ < kTooSlowInARow) return false;
  return std::none_of(candidates_.begin() + static_cast<std::ptrdiff_t>(timed_ - kTooSlowInARow),
                      candidates_.begin() + static_cast<std::ptrdiff_t>(timed_),
                      [&](const Candidate& one) { return fits(one); });
}

std::optional<AoSettings> OcclusionChoice::next() const {
  if (is_done()) return std::nullopt;
  return candidates_[timed_].ao;
}

void OcclusionChoice::took(double ms) {
  LFD_CHECK(timed_ < candidates_.size(), "one was to be timed");
  candidates_[timed_++].ms = ms;
}

OcclusionChoice::Chosen OcclusionChoice::chosen() const {
  if (timed_ == 0)
    return {asked_, fmt::format("{}: no settings of the front go with what is asked for", asked_.method->name)};
  const Candidate *best = nullptr, *fastest = nullptr, *missed = nullptr;
  for (const Candidate& one : candidates_) {
    if (!one.ms) continue;
    if (fastest == nullptr || *one.ms < *fastest->ms) fastest = &one;
    if (fits(one) && (best == nullptr || one.mae < best->mae)) best = &one;
  }
  if (best == nullptr)
    return {fastest->ao, fmt::format("{}: nothing fits in {:g} ms; it is the fastest, with {:.3g} ms", fastest->name,
                                     budget_ms_, *fastest->ms)};
  for (const Candidate& one : candidates_) {
    if (one.ms && one.mae < best->mae && (missed == nullptr || one.mae > missed->mae)) missed = &one;
  }
  std::string why = fmt::format("{}: {:.3g} ms of {:g} ms, error {:.4f}", best->name, *best->ms, budget_ms_, best->mae);
  if (missed != nullptr) why += fmt::format("; {} with {:.4f} took {:.3g} ms", missed->name, missed->mae, *missed->ms);
  return {best->ao, why};
}

}  // namespace lfd
