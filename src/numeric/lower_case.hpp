/// @file
/// Text without upper case: the letters of ASCII, in no locale. Private.
#pragma once

#include <string>
#include <string_view>

namespace tactile_net {

[[nodiscard]] constexpr char lower_case(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

[[nodiscard]] inline std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower_case(c);
  return result;
}

}  // namespace tactile_net
