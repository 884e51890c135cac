// Chooses settings of ambient occlusion that fit a budget: says which to time next, is told the times, and decides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proto/occlusion_front.pb.h"
#include "proto/settings.h"

namespace lfd {

class OcclusionChoice {
 public:
  // Of the front (the cheapest first where it was measured, the more accurate later) those entries are candidates that
  // the settings asked for allow and that so many modules can draw as they were measured: sharing needs more than its
  // neighbours to one side.
  OcclusionChoice(const proto::OcclusionFront& front, const proto::AmbientOcclusion& asked, int modules);

  // The settings to time next; absent once enough is known: all have been timed, three in a row did not fit, or one
  // took four times the budget (those after it cost more where they were measured).
  std::optional<AoSettings> next() const;

  // GPU time of a frame of all modules with the settings of next().
  void took(double ms);

  struct Chosen {
    AoSettings ao;
    std::string why;  // for the report
  };
  // The most accurate of those that fit, by the front; the fastest where none does. At least one has been timed, or the
  // front has no candidate: then what was asked for.
  Chosen chosen() const;

 private:
  struct Candidate {
    AoSettings ao;
    std::string name;
    double mae = 0;
    std::optional<double> ms;
  };

  bool fits(const Candidate& one) const { return one.ms && *one.ms <= budget_ms_; }
  bool is_done() const;

  double budget_ms_;
  AoSettings asked_;
  std::vector<Candidate> candidates_;
  std::size_t timed_ = 0;
};

}  // namespace lfd
