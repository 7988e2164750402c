/// @file
/// Doubles read by the C library, for standard libraries whose std::from_chars reads integers alone
/// (libc++ before 20). Private: who reads numbers calls `number_from_chars` (number_text.hpp).
#pragma once

#include <charconv>

namespace tactile_net {

/// As std::from_chars of a double: correctly rounded, in no locale, no leading blank, no `+`, no
/// hexadecimal digits.
[[nodiscard]] std::from_chars_result from_chars_by_strtod(const char* first, const char* last,
                                                          double& number) noexcept;

}  // namespace tactile_net
