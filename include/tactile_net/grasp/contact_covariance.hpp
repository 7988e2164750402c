/// @file
/// Covariances of what a fingertip feels, by name instead of by index.
///
///     force.covariance(ContactValue::normal, ContactValue::centre)
///     force.covariance.deviation(ContactValue::tangential)
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace tactile_net {

/// The measured numbers of a contact, in the order of their covariance.
enum class ContactValue { normal, tangential, centre };

/// Covariance of a contact's first `size` values, in the unit of the hand's forces and m for the
/// centre; zeros: the values are exact.
template <std::size_t size>
struct ContactCovariance {
  std::array<double, size * size> values{};  ///< row-major

  [[nodiscard]] constexpr double operator()(ContactValue a, ContactValue b) const noexcept {
    return values[index(a, b)];
  }
  [[nodiscard]] constexpr double& operator()(ContactValue a, ContactValue b) noexcept {
    return values[index(a, b)];
  }

  /// Standard deviation of one value.
  [[nodiscard]] double deviation(ContactValue value) const noexcept {
    return std::sqrt((std::max)((*this)(value, value), 0.0));
  }

 private:
  [[nodiscard]] static constexpr std::size_t index(ContactValue a, ContactValue b) noexcept {
    assert(static_cast<std::size_t>(a) < size && static_cast<std::size_t>(b) < size);
    return size * static_cast<std::size_t>(a) + static_cast<std::size_t>(b);
  }
};

}  // namespace tactile_net
