// Errors of validate(DisplayCalibration), said in the words of the file that the display was imported from.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace lfd {

// Where a field of a DisplayCalibration came from.
struct ForeignField {
  std::string road;   // beginning of validate()'s errors: "screen: width_m"
  int line = 0;       // of the file, from 1
  std::string field;  // its name there: "halfphyssize[0]"
};

// "12: halfphyssize[0]: -0.4 must be positive and finite (screen: width_m)" for the error "screen: width_m: -0.4 must
// ...": the number stays as the display has it, in metres. Where no field fits: "1: " before the error as it is.
Error in_foreign_words(const Error& error, const std::vector<ForeignField>& fields);

}  // namespace lfd
