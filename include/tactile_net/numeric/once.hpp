/// @file
/// A value that is made on first use and never again.
#pragma once

#include <optional>
#include <utility>

namespace tactile_net {

/// Member of a class that derives one thing from another when it is asked for. Not thread-safe: an
/// object that holds one is used from one thread at a time. If making it throws, the next use
/// tries again.
template <class T>
class Once {
 public:
  /// The value; the first call makes it by `make()`.
  template <class Make>
  [[nodiscard]] const T& get(Make&& make) const {
    if (!value_) value_.emplace(std::forward<Make>(make)());
    return *value_;
  }

 private:
  mutable std::optional<T> value_{};
};

}  // namespace tactile_net
