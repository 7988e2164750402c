#include "tactile_net/numeric/number_text.hpp"

#include <charconv>
#include <cmath>

#include "numeric/strtod.hpp"

namespace tactile_net {
namespace {

template <class Number>
concept ReadByStandard = requires(const char* text, Number& number) {
  std::from_chars(text, text, number);
};

/// A template, so that the branch that is not taken need not compile.
template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& number) noexcept {
  if constexpr (ReadByStandard<Number>)
    return std::from_chars(first, last, number);
  else
    return from_chars_by_strtod(first, last, number);
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

std::from_chars_result number_from_chars(const char* first, const char* last,
                                         double& number) noexcept {
  return read(first, last, number);
}

bool read_number(std::string_view text, double& number) noexcept {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = number_from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end;
}

}  // namespace tactile_net
