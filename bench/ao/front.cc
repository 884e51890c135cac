// The Pareto front over all places.
#include <algorithm>
#include <map>

#include "base/log.h"
#include "bench/ao/ao_bench.h"
#include "proto/text_file.h"

namespace lfd::bench {
namespace {

struct Candidate {
  const AoRow* row = nullptr;
  double mae = 0, ratio = 0;
  std::size_t places = 0;
};

// Of rungs that were drawn everywhere: means over scenes, modules and radii.
std::vector<Candidate> candidates_of(const AoTable& table) {
  std::map<std::string, Candidate> found;
  for (const AoRow& row : table.rows) {
    if (row.rung.use != RungUse::kEverywhere || row.place == PlaceKind::kOtherEdge) continue;
    Candidate& one = found[row.rung.method() + ", " + row.rung.name];
    one.row = &row;
    one.mae += row.mae_over_all;
    one.ratio += row.ratio.median;
    ++one.places;
  }
  std::vector<Candidate> all;
  for (auto& [name, one] : found) {
    one.mae /= static_cast<double>(one.places);
    one.ratio /= static_cast<double>(one.places);
    all.push_back(one);
  }
  std::ranges::sort(all, {}, &Candidate::ratio);
  return all;
}

}  // namespace

proto::OcclusionFront front_of(const AoTable& table) {
  proto::OcclusionFront front;
  std::string scenes;
  for (const std::string& scene : table.scenes()) scenes += (scenes.empty() ? "" : ", ") + scene;
  front.set_measured(fmt::format("lfd {}, {}; {}", table.version, table.renderer, scenes));
  double best = 2;
  for (const Candidate& one : candidates_of(table)) {
    if (one.mae >= best) continue;
    best = one.mae;
    auto* entry = front.add_entry();
    *entry->mutable_ao() = one.row->rung.settings;
    const occlusion::Curve& curve = one.row->curve_over_all;
    entry->mutable_ao()->mutable_curve()->set_a(curve.a);
    entry->mutable_ao()->mutable_curve()->set_b(curve.b);
    entry->mutable_ao()->mutable_curve()->set_c(curve.c);
    entry->set_name(one.row->rung.method() + ", " + one.row->rung.name);
    entry->set_mae(one.mae);
    entry->set_ratio(one.ratio);
  }
  return front;
}

std::string front_text_of(const AoTable& table) { return print_text(front_of(table)); }

}  // namespace lfd::bench
