// LFD_CHECK: a condition that only a defect of ours can break; it says where and why, then aborts.
#pragma once

#include <string_view>

namespace lfd {

[[noreturn]] void check_failed(const char* file, int line, const char* condition, std::string_view why);

}  // namespace lfd

#define LFD_CHECK(condition, why) \
  ((condition) ? static_cast<void>(0) : ::lfd::check_failed(__FILE_NAME__, __LINE__, #condition, (why)))
