/// @file
/// Doubles read by fast_float, for standard libraries whose std::from_chars reads integers alone
/// (libc++ before 20). Private: who reads numbers calls `number_from_chars` (number_text.hpp).
#pragma once

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace tactile_net {

/// As std::from_chars of a double: a number that is too large or too small is an error, which
/// versions of fast_float before 3.10 read as infinity or 0.
[[nodiscard]] inline std::from_chars_result from_chars_by_fast_float(const char* first,
                                                                     const char* last,
                                                                     double& number) noexcept {
  double value = 0.0;
  const auto [stop, error] = fast_float::from_chars(first, last, value);
  if (error != std::errc{}) return {stop, error};
  const auto is_letter = [](char c) { return c == 'i' || c == 'I'; };
  const auto is_not_zero = [](char c) { return c >= '1' && c <= '9'; };
  const char* const exponent =
      std::find_if(first, stop, [](char c) { return c == 'e' || c == 'E'; });
  if ((std::isinf(value) && std::none_of(first, stop, is_letter)) ||
      (value == 0.0 && std::any_of(first, exponent, is_not_zero)))
    return {stop, std::errc::result_out_of_range};
  number = value;
  return {stop, {}};
}

}  // namespace tactile_net
