#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tactile_net/skin/resultant.hpp"

namespace tactile_net {
namespace {

constexpr double touched = 2.0;  // deviations
constexpr double certain = 4.0;  // of a patch's peak

/// Calls `visit` with the cells around one, itself too.
void around(const SkinGrid& grid, std::size_t cell, std::size_t reach_y, std::size_t reach_z,
            const auto& visit) {
  const std::size_t row = cell / grid.columns;
  const std::size_t column = cell % grid.columns;
  for (std::size_t m = row - std::min(row, reach_y); m <= std::min(row + reach_y, grid.rows - 1);
       ++m)
    for (std::size_t n = column - std::min(column, reach_z);
         n <= std::min(column + reach_z, grid.columns - 1); ++n)
      visit(m * grid.columns + n);
}

/// Patches of neighbours among the cells of a mask.
std::vector<std::vector<std::size_t>> patches(const SkinGrid& grid, std::vector<bool> left) {
  std::vector<std::vector<std::size_t>> all;
  for (std::size_t start = 0; start < left.size(); ++start) {
    if (!left[start]) continue;
    left[start] = false;
    std::vector<std::size_t> patch{start};
    for (std::size_t at = 0; at < patch.size(); ++at)
      around(grid, patch[at], 1, 1, [&](std::size_t next) {
        if (left[next]) patch.push_back(next);
        left[next] = false;
      });
    std::sort(patch.begin(), patch.end());
    all.push_back(std::move(patch));
  }
  return all;
}

}  // namespace

std::vector<std::size_t> contact_cells(const SkinGrid& grid, std::span<const double> tractions,
                                       std::span<const double> deviations, double rim) {
  const std::size_t count = grid.count();
  if (tractions.size() < count || deviations.size() < count)
    throw std::invalid_argument("tractions and deviations need one value per cell at least");
  if (!(rim >= 0.0) || !std::isfinite(rim))
    throw std::invalid_argument("rim must be >= 0 and finite");
  std::vector<bool> above(count);
  for (std::size_t i = 0; i < count; ++i)
    above[i] = tractions[i] > 0.0 && tractions[i] > touched * deviations[i];
  const auto reach = [&](double spacing) {
    return static_cast<std::size_t>(std::lround(std::min(rim / spacing, 1e6)));
  };
  std::vector<bool> taken(count);
  for (const auto& patch : patches(grid, above)) {
    if (std::none_of(patch.begin(), patch.end(),
                     [&](std::size_t i) { return tractions[i] > certain * deviations[i]; }))
      continue;
    for (const std::size_t cell : patch)
      around(grid, cell, reach(grid.spacing_y), reach(grid.spacing_z),
             [&](std::size_t i) { taken[i] = true; });
  }
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < count; ++i)
    if (taken[i]) cells.push_back(i);
  return cells;
}

std::vector<std::vector<std::size_t>> separate_contacts(const SkinGrid& grid,
                                                        std::span<const double> tractions,
                                                        std::span<const std::size_t> cells) {
  std::vector<bool> mask(grid.count());
  for (const std::size_t cell : cells) mask.at(cell) = true;
  auto all = patches(grid, mask);
  const auto force = [&](const std::vector<std::size_t>& patch) {
    double sum = 0.0;
    for (const std::size_t cell : patch) sum += tractions[cell];
    return sum;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const auto& a, const auto& b) { return force(a) > force(b); });
  return all;
}

}  // namespace tactile_net
