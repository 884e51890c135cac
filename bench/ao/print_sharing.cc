// The section on sharing.
#include <algorithm>

#include "base/log.h"
#include "bench/ao/print_text.h"

namespace lfd::bench {
namespace {

bool is_shared(const AoRow& row) { return row.rung.settings.shared().neighbours() > 0; }
bool is_blurred(const AoRow& row) { return row.blur != "none"; }

bool is_same_place(const AoRow& a, const AoRow& b) {
  return a.scene == b.scene && a.module == b.module && a.radius_share == b.radius_share;
}

// The most accurate rung of one module that takes no more time and is blurred too, or neither is; null where none does.
const AoRow* best_alone(const AoTable& table, const AoRow& shared) {
  const AoRow* best = nullptr;
  for (const AoRow& row : table.rows) {
    if (is_shared(row) || !is_same_place(row, shared) || is_blurred(row) != is_blurred(shared) ||
        row.total_ms() > shared.total_ms())
      continue;
    if (best == nullptr || fitted_or_not(row).mae < fitted_or_not(*best).mae) best = &row;
  }
  return best;
}

std::string row_text(const AoTable& table, const AoRow& row) {
  const AoJudgement& e = fitted_or_not(row);
  std::string text = fmt::format("| {} | {} | {:g} | {} | {:.2f} | {:.2f} | {:.4f} | {:.4f} | {:.4f} | {:.1f} % |",
                                 row.scene, name_of(row.place), 100 * row.radius_share,
                                 row.rung.method() + ", " + row.rung.name, row.occlusion_ms.median, row.ratio.median,
                                 row.judged.mae, e.mae, e.mae_silhouette, 100 * e.inconsistent);
  const AoRow* alone = is_shared(row) ? best_alone(table, row) : nullptr;
  if (alone == nullptr) return text + " |\n";
  const AoJudgement& other = fitted_or_not(*alone);
  return text + fmt::format(" {}, {}: {:.4f}, {:.4f}, {:.1f} % |\n", alone->rung.method(), alone->rung.name, other.mae,
                            other.mae_silhouette, 100 * other.inconsistent);
}

const AoRow* find(const AoTable& table, const AoRow& like, const std::string& name) {
  const auto found = std::ranges::find_if(table.rows, [&](const AoRow& row) {
    return is_same_place(row, like) && row.rung.method() == "march" && row.rung.name == name;
  });
  return found == table.rows.end() ? nullptr : &*found;
}

// 4 directions shared against 32 alone, blur off; and what the blur that sharing comes with leaves inconsistent.
std::string goal_text(const AoTable& table) {
  std::string text;
  for (const AoRow& few : table.rows) {
    if (few.rung.name != "4 directions, 4 steps, shared over +-4, no blur") continue;
    const AoRow* many = find(table, few, "32 directions, 4 steps, no blur");
    const AoRow* blurred = find(table, few, "4 directions, 4 steps, shared over +-4");
    if (many == nullptr || blurred == nullptr) continue;
    text += fmt::format("| {} | {:.4f} | {:.4f} | {:.2f} | {:.1f} % |\n", few.scene, few.judged.mae, many->judged.mae,
                        few.ratio.median / many->ratio.median, 100 * blurred->judged.inconsistent);
  }
  if (text.empty()) return "";
  return "\n`march`, 4 directions x 4 steps over +-4 modules, against 32 x 4 of one module: MAE without blur, "
         "unfitted; time over time (both over `sphere` in\n"
         "the same round); inconsistent points with the blur that sharing comes with (by geometry), unfitted.\n\n"
         "| scene | MAE, shared | MAE, alone | time, shared over alone | inconsistent, blurred "
         "|\n|---|---|---|---|---|\n" +
         text;
}

}  // namespace

std::string sharing_text(const AoTable& table) {
  std::string rows;
  for (const AoRow& row : table.rows) {
    if (is_shared(row) && row.radius_share == table.middle_radius()) rows += row_text(table, row);
  }
  if (rows.empty()) return "";
  std::string text = "\n## Shared by neighbouring modules\n" + goal_text(table) +
                     "\nLast column: the most accurate setting of a single module that takes no more time (occlusion "
                     "and blur): its fitted MAE, near silhouettes,\n"
                     "inconsistent.\n\n| scene | module | R, % | settings | ms | x | MAE | fitted MAE | near "
                     "silhouettes | inconsistent | best alone at equal time |\n"
                     "|---|---|---|---|---|---|---|---|---|---|---|\n" +
                     rows;
  if (table.sharing.empty()) return text;
  text +=
      "\nTime of one module as a node has more of them (`march`, 4 x 4, over +-4):\n\n| modules | alone, ms | shared, "
      "ms | shared over alone |\n|---|---|---|---|\n";
  for (const SharingRow& row : table.sharing)
    text += fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} |\n", row.modules, row.alone_ms, row.shared_ms,
                        row.shared_ms / row.alone_ms);
  return text;
}

}  // namespace lfd::bench
