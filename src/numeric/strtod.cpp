#include "numeric/strtod.hpp"

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#if __has_include(<xlocale.h>)
#include <xlocale.h>  // where macOS and the BSDs keep strtod_l
#endif

namespace tactile_net {
namespace {

/// What strtod could take for a part of a number.
bool in_number(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         std::string_view("+-.()_").find(c) != std::string_view::npos;
}

}  // namespace

std::from_chars_result from_chars_by_strtod(const char* first, const char* last,
                                            double& number) noexcept {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  std::string text(first, std::find_if_not(first, last, in_number));  // strtod wants a zero behind
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  const std::string_view digits = std::string_view(text).substr(sign);
  if (digits.empty() || digits.front() == '+' || digits.front() == '-')
    return {first, std::errc::invalid_argument};
  // "0x1" is a zero with something behind it.
  if (digits.starts_with("0x") || digits.starts_with("0X")) text.resize(sign + 1);

  const int errno_before = errno;
  errno = 0;
  char* end = nullptr;
  const double value = strtod_l(text.c_str(), &end, c_locale);
  const bool out_of_range = errno == ERANGE && (std::isinf(value) || value == 0.0);
  errno = errno_before;
  const char* const stop = first + (end - text.c_str());
  if (stop == first) return {first, std::errc::invalid_argument};
  if (out_of_range) return {stop, std::errc::result_out_of_range};
  number = value;
  return {stop, std::errc{}};
}

}  // namespace tactile_net
