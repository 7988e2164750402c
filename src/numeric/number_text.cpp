#include "tactile_net/numeric/number_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#if __has_include(<fast_float/fast_float.h>)
#include "numeric/by_fast_float.hpp"
#endif

namespace tactile_net {
namespace {

template <class Number>
concept ReadByStandard = requires(const char* text, Number& number) {
  std::from_chars(text, text, number);
};

/// A template, so that the branch that is not taken need not compile. Where
/// `from_chars_by_fast_float` is not declared, and is needed: install fast_float (Debian:
/// libfast-float-dev).
template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& number) noexcept {
  if constexpr (ReadByStandard<Number>)
    return std::from_chars(first, last, number);
  else
    return from_chars_by_fast_float(first, last, number);
}

}  // namespace

void append_number(std::string& out, double number) {
  char buffer[32];
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr);
}

std::string shortest(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

std::string brief(double number, int digits) {
  if (std::isnan(number)) return "-";
  char buffer[32];
  return {buffer,
          std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::general, digits)
              .ptr};
}

std::string fixed(double number, int digits) {
  if (std::isnan(number)) return "-";
  char buffer[340];  // the largest double has 309 digits before its point
  return {
      buffer,
      std::to_chars(buffer, buffer + sizeof buffer, number, std::chars_format::fixed, digits).ptr};
}

std::string percent(double share) { return brief(100.0 * share) + " %"; }

std::string duration(double seconds) {
  if (std::isnan(seconds)) return "-";
  if (seconds < 1e-6) return brief(seconds * 1e9) + " ns";
  if (seconds < 1e-3) return brief(seconds * 1e6) + " us";
  if (seconds < 1.0) return brief(seconds * 1e3) + " ms";
  return brief(seconds) + " s";
}

std::string plus_minus(double value, double deviation) {
  if (!std::isfinite(value)) return "-";
  if (!std::isfinite(deviation) || !(deviation > 0.0)) return brief(value);
  double power = std::floor(std::log10(deviation));
  if (std::round(deviation / std::pow(10.0, power - 1.0)) < 20.0) power -= 1.0;
  const double largest = std::max(std::abs(value), deviation);
  if (power > 4.0 || largest < 1e-3) {  // powers of ten, one for both
    const double common = std::floor(std::log10(largest));
    const double unit = std::pow(10.0, common);
    const int digits = static_cast<int>(std::clamp(common - power, 0.0, 15.0));
    return "(" + fixed(value / unit, digits) + " ± " + fixed(deviation / unit, digits) + ")e" +
           fixed(common, 0);
  }
  const int digits = static_cast<int>(std::clamp(-power, 0.0, 15.0));
  const double step = std::pow(10.0, power);
  const auto rounded = [&](double number) {
    const double result = digits > 0 ? number : std::round(number / step) * step;
    return fixed(result, digits);
  };
  std::string text = rounded(value);
  // "-0.00" is nothing but 0.
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text + " ± " + rounded(deviation);
}

std::from_chars_result number_from_chars(const char* first, const char* last,
                                         double& number) noexcept {
  return read(first, last, number);
}

bool read_number(std::string_view text, double& number) noexcept {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = number_from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end;
}

std::optional<std::size_t> whole_number(std::string_view text) noexcept {
  std::size_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace tactile_net
