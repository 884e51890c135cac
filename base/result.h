// Results of operations that the world can make fail: a value, or an error that carries its road.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "base/check.h"

namespace lfd {

// What went wrong, in one line for a person, outermost place first: `wall.textproto:14: module 3: focal: must be > 0`.
class [[nodiscard]] Error {
 public:
  explicit Error(std::string message) : message_(std::move(message)) {}

  const std::string& message() const { return message_; }

  // The same error seen from one level further out: "`where`: message".
  Error within(std::string_view where) const { return Error(std::string(where) + ": " + message_); }

 private:
  std::string message_;
};

// Either a T or an Error. Reading the side that is not there aborts (it is a defect of the caller).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}      // NOLINT: implicit by design
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}  // NOLINT: implicit by design

  explicit operator bool() const { return content_.index() == 0; }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(value()); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  T& value() {
    LFD_CHECK(content_.index() == 0, error().message());
    return *std::get_if<0>(&content_);
  }
  const T& value() const {
    LFD_CHECK(content_.index() == 0, error().message());
    return *std::get_if<0>(&content_);
  }
  const Error& error() const {
    LFD_CHECK(content_.index() == 1, "no error here");
    return *std::get_if<1>(&content_);
  }

 private:
  std::variant<T, Error> content_;
};

// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}  // NOLINT: implicit by design

  explicit operator bool() const { return !error_; }
  const Error& error() const {
    LFD_CHECK(error_.has_value(), "no error here");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

using Status = Result<void>;

}  // namespace lfd

#define LFD_CONCAT_INNER(a, b) a##b
#define LFD_CONCAT(a, b) LFD_CONCAT_INNER(a, b)

// LFD_TRY(auto x, f()): x is the value of f(), or the enclosing function returns f()'s error.
#define LFD_TRY(declaration, expression) LFD_TRY_NAMED(LFD_CONCAT(lfd_try_, __COUNTER__), declaration, expression)
#define LFD_TRY_NAMED(result, declaration, expression) \
  auto result = (expression);                          \
  if (!result) return result.error();                  \
  declaration = *std::move(result)

// LFD_TRY_STATUS(f()): the enclosing function returns f()'s error, if it has one.
#define LFD_TRY_STATUS(expression) \
  if (auto lfd_status = (expression); !lfd_status) return lfd_status.error()
