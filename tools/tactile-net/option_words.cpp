#include "option_words.hpp"

#include <algorithm>

namespace tactile_net::tool {

std::string spelled(Option option, std::string_view value) {
  std::string text = "--" + std::string(name(option));
  std::replace(text.begin(), text.end(), '_', '-');
  if (!value.empty()) text.append(" ").append(value);
  return text;
}

}  // namespace tactile_net::tool
