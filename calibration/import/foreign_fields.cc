// Roads looked up.
#include "calibration/import/foreign_fields.h"

#include <algorithm>

#include "base/log.h"

namespace lfd {

Error in_foreign_words(const Error& error, const std::vector<ForeignField>& fields) {
  const std::string& message = error.message();
  const auto found =
      std::ranges::find_if(fields, [&](const ForeignField& field) { return message.starts_with(field.road + ": "); });
  if (found == fields.end()) return error.within("1");
  return Error(
      fmt::format("{}: {}: {} ({})", found->line, found->field, message.substr(found->road.size() + 2), found->road));
}

}  // namespace lfd
