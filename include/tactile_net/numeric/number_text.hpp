/// @file
/// Numbers as text, the same in every locale: a German one writes no "0,05" into a deck.
///
///     shortest(0.1)     "0.1"      every digit: reads back as the same double
///     brief(1234.5)     "1.23e+03" three significant digits, for tables
///     fixed(1234.56, 1) "1234.6"   so many digits behind the point
///     percent(0.0123)   "1.23 %"
///     duration(2.5e-6)  "2.5 us"
///     plus_minus(0.98172, 0.00165)  "0.9817 ± 0.0017": rounded by the deviation
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tactile_net {

/// Appends the shortest decimal text that reads back as the same number; "inf" and "nan" too.
void append_number(std::string& out, double number);

/// Shortest decimal text that reads back as the same number. Without SPICE suffix: there `M` is
/// milli and `MEG` is mega.
[[nodiscard]] std::string shortest(double number);
[[nodiscard]] std::string shortest(std::integral auto number) { return std::to_string(number); }

/// The number with `digits` significant digits, at most 17, without trailing zeros; "-" for NaN.
[[nodiscard]] std::string brief(double number, int digits = 3);

/// The number with `digits` digits behind the point, at most 20; "-" for NaN.
[[nodiscard]] std::string fixed(double number, int digits);

/// A share of 1 as "1.23 %".
[[nodiscard]] std::string percent(double share);

/// Seconds with the unit that leaves one to three digits before the point: "12 us"; "-" for NaN.
[[nodiscard]] std::string duration(double seconds);

/// A value and its standard deviation, both rounded to the deviation's first two digits if these
/// are below 20, else to its first; UTF-8. "-" where the value is not finite; without the deviation
/// where that is not finite or 0.
[[nodiscard]] std::string plus_minus(double value, double deviation);

/// `std::from_chars` of a double, replaced where the standard library lacks it (libc++ before 20).
/// The library reads doubles by this function alone.
[[nodiscard]] std::from_chars_result number_from_chars(const char* first, const char* last,
                                                       double& number) noexcept;

/// Reads a text that is a number as a whole: no sign `+`, no blank, no locale. False: it is none.
[[nodiscard]] bool read_number(std::string_view text, double& number) noexcept;

/// Reads a text that is a whole number >= 0; absent: it is none.
[[nodiscard]] std::optional<std::size_t> whole_number(std::string_view text) noexcept;

}  // namespace tactile_net
