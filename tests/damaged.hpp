/// @file
/// Texts and files as strangers' hands leave them: cut, with bytes changed, parts twice.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <string_view>

namespace tactile_net::test {

/// A seed with a few places changed; now and then no more than letters at random.
/// @param letters  that stand where they mean something
inline std::string damaged(const std::string& seed, std::string_view letters,
                           std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::string bytes;
  if (below(16) == 0) {
    for (std::size_t left = below(300); left > 0; --left)
      bytes += below(2) == 0 ? static_cast<char>(below(256)) : letters[below(letters.size())];
    return bytes;
  }
  bytes = seed;
  for (std::size_t left = 1 + below(3); left > 0 && !bytes.empty(); --left) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, 1 + below(40));
        break;
      case 2:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(200)));
        break;
      case 3:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 4:
        bytes.insert(at, below(2) == 0 ? "1e308" : "-0");
        break;
      default:
        bytes[at] = letters[below(letters.size())];
    }
  }
  return bytes;
}

}  // namespace tactile_net::test
