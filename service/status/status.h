// Status and Result: how fallible functions of every layer answer. The message names what is wrong and what to do.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>

namespace bleedsim {

enum class StatusCode {
  ok,
  invalid_argument,  ///< a value is out of range, not finite or malformed
  not_found,         ///< an unknown id, name, file or session
  capacity,          ///< a bound is reached
  wrong_state,       ///< not possible in this state
  unsupported,       ///< known, but not by this build or version
  timed_out,
  unavailable,  ///< a peer, an interface or a resource is missing or taken
  io,           ///< the file system or the middleware failed
  data_loss,    ///< a file is damaged or truncated
  internal,
};

/// Success, or a code with a message for a person.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string message) : code_{code}, message_{std::move(message)} {}

  bool ok() const { return code_ == StatusCode::ok; }
  explicit operator bool() const { return ok(); }
  StatusCode code() const { return code_; }
  const std::string& message() const { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

/// A value, or the Status that says why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_{std::move(value)} {}                                  // NOLINT: implicit by design
  Result(Status status) : status_{std::move(status)} { assert(!status_.ok()); }  // NOLINT: implicit by design

  bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Status& status() const { return status_; }
  T& value() { return *value_; }
  const T& value() const { return *value_; }
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace bleedsim
