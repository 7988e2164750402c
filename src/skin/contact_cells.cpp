#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "realtime/touching_cells.hpp"
#include "tactile_net/skin/resultant.hpp"

namespace tactile_net {
namespace {

/// Calls `visit` with the neighbours of a cell, and itself.
void around(const SurfaceGrid& grid, std::size_t cell, const auto& visit) {
  const std::size_t row = cell / grid.columns;
  const std::size_t column = cell % grid.columns;
  for (std::size_t m = row - std::min(row, std::size_t{1}); m <= std::min(row + 1, grid.rows - 1);
       ++m)
    for (std::size_t n = column - std::min(column, std::size_t{1});
         n <= std::min(column + 1, grid.columns - 1); ++n)
      visit(m * grid.columns + n);
}

/// Patches of neighbours among the cells of a mask.
std::vector<std::vector<std::size_t>> patches(const SurfaceGrid& grid, std::vector<bool> left) {
  std::vector<std::vector<std::size_t>> all;
  for (std::size_t start = 0; start < left.size(); ++start) {
    if (!left[start]) continue;
    left[start] = false;
    std::vector<std::size_t> patch{start};
    for (std::size_t at = 0; at < patch.size(); ++at)
      around(grid, patch[at], [&](std::size_t next) {
        if (left[next]) patch.push_back(next);
        left[next] = false;
      });
    std::sort(patch.begin(), patch.end());
    all.push_back(std::move(patch));
  }
  return all;
}

std::size_t cells_within(double reach, double spacing) {
  return static_cast<std::size_t>(std::lround(std::min(reach / spacing, 1e6)));
}

FoundContacts contacts_of(const SurfaceGrid& grid, std::span<const double> tractions,
                          std::span<const double> deviations, double rim,
                          const WindowBands* windows) {
  const std::size_t count = grid.count();
  if (tractions.size() < count || deviations.size() < count ||
      (windows != nullptr && windows->deviations.size() < count))
    throw std::invalid_argument("tractions and deviations need one value per cell at least");
  if (!(rim >= 0.0) || !std::isfinite(rim))
    throw std::invalid_argument("rim must be >= 0 and finite");
  std::vector<std::uint8_t> taken(count);
  std::vector<std::uint32_t> queue(count);
  std::vector<double> scratch(windows != nullptr ? 2 * count : 0);
  TouchedWindows sums{};
  if (windows != nullptr)
    sums = {windows->window.rows, windows->window.columns, windows->deviations.data(),
            scratch.data(), scratch.data() + count};
  FoundContacts found;
  mark_touching(touching_loops(widest_instruction_set()),
                {grid.rows, grid.columns, cells_within(rim, grid.spacing_y),
                 cells_within(rim, grid.spacing_z)},
                tractions.data(), deviations.data(), windows != nullptr ? &sums : nullptr,
                taken.data(), queue.data(),
                [&](std::size_t cell) { found.doubted.push_back(cell); });
  for (std::size_t i = 0; i < count; ++i)
    if (taken[i] != 0) found.cells.push_back(i);
  std::sort(found.doubted.begin(), found.doubted.end());
  return found;
}

}  // namespace

CellWindow window_of(const SurfaceGrid& grid, double reach) {
  if (!(reach >= 0.0) || !std::isfinite(reach))
    throw std::invalid_argument("reach must be >= 0 and finite");
  return {std::min(cells_within(reach, grid.spacing_y), grid.rows - 1),
          std::min(cells_within(reach, grid.spacing_z), grid.columns - 1)};
}

std::vector<std::size_t> contact_cells(const SurfaceGrid& grid, std::span<const double> tractions,
                                       std::span<const double> deviations, double rim) {
  return contacts_of(grid, tractions, deviations, rim, nullptr).cells;
}

FoundContacts find_contacts(const SurfaceGrid& grid, std::span<const double> tractions,
                            std::span<const double> deviations, const WindowBands& windows,
                            double rim) {
  return contacts_of(grid, tractions, deviations, rim, &windows);
}

bool is_one_line(const SurfaceGrid& grid, std::span<const std::size_t> cells, bool along_y) {
  const auto line = [&](std::size_t cell) {
    return along_y ? cell % grid.columns : cell / grid.columns;
  };
  return std::all_of(cells.begin(), cells.end(),
                     [&](std::size_t cell) { return line(cell) == line(cells.front()); });
}

std::vector<std::size_t> with_neighbours(const SurfaceGrid& grid,
                                         std::span<const std::size_t> cells) {
  std::vector<bool> taken(grid.count());
  for (const std::size_t cell : cells)
    around(grid, cell, [&](std::size_t next) { taken[next] = true; });
  std::vector<std::size_t> all;
  for (std::size_t cell = 0; cell < taken.size(); ++cell)
    if (taken[cell]) all.push_back(cell);
  return all;
}

std::vector<std::vector<std::size_t>> separate_contacts(const SurfaceGrid& grid,
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
