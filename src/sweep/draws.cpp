#include "sweep/draws.hpp"

#include <boost/random/sobol.hpp>

#include "tactile_net/numeric/sha256.hpp"

namespace tactile_net::sweep {
namespace {

constexpr double two_to_53 = 9007199254740992.0;

std::vector<double> random_column(std::uint64_t seed, const std::string& key, std::size_t count) {
  const std::string before = "draw\n" + std::to_string(seed) + '\n' + key + '\n';
  std::vector<double> column;
  column.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    column.push_back(static_cast<double>(number_of(before + std::to_string(i))) / two_to_53);
  return column;
}

}  // namespace

std::uint64_t number_of(const std::string& text) {
  const auto digest = sha256(text);
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof number; ++i) number = number << 8U | digest[i];
  return number >> 11U;
}

std::vector<std::vector<double>> draws(DrawKind kind, std::uint64_t seed,
                                       const std::vector<std::string>& keys, std::size_t count) {
  std::vector<std::vector<double>> columns(keys.size());
  if (keys.empty()) return columns;
  if (kind == DrawKind::random) {
    for (std::size_t k = 0; k < keys.size(); ++k) columns[k] = random_column(seed, keys[k], count);
    return columns;
  }
  boost::random::sobol sequence(keys.size());
  for (std::size_t i = 0; i < count; ++i)
    for (auto& column : columns)
      column.push_back(static_cast<double>(sequence() >> 11U) / two_to_53);
  return columns;
}

}  // namespace tactile_net::sweep
