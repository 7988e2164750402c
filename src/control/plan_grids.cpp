#include "control/plan_grids.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace tactile_net {
namespace {

std::int8_t sign_of(bool is_negative) { return is_negative ? -1 : 1; }

/// Taxels along an axis of the grid; 0: they lie anywhere.
std::size_t places_along(std::size_t values, std::size_t margin, std::size_t stride) {
  return stride > 0 ? (values - 1 - 2 * margin) / stride + 1 : 0;
}

/// A line's column as a row: what y's reflection does to the column z's does to the row.
GridBlocks as_row(GridBlocks column) {
  std::swap(column.rows, column.columns);
  std::swap(column.signs_y, column.signs_z);
  return column;
}

/// The first site of each channel.
std::vector<Site> channels_of(const LinearProblem& problem) {
  std::vector<Site> first;
  for (const Site& site : problem.sites)
    if (site.channel == first.size()) first.push_back(site);
  return first;
}

/// Which channel each one becomes when y and z are exchanged; empty: one has no partner.
std::vector<std::uint32_t> partners_of(const std::vector<Site>& channels) {
  std::vector<std::uint32_t> partners;
  for (const Site& site : channels) {
    const auto partner = std::find_if(channels.begin(), channels.end(), [&](const Site& other) {
      return other.depth == site.depth && other.quantity == exchanged(site.quantity);
    });
    if (partner == channels.end()) return {};
    partners.push_back(static_cast<std::uint32_t>(partner - channels.begin()));
  }
  return partners;
}

}  // namespace

GridBlocks reading_grid(const LinearProblem& problem) {
  const SurfaceGrid& grid = problem.grid;
  GridBlocks blocks{
      .rows = places_along(grid.rows, grid.margin_rows, grid.stride_rows),
      .columns = places_along(grid.columns, grid.margin_columns, grid.stride_columns)};
  // Of an irregular line only the order counts: its ends are each other's images.
  if (blocks.rows == 0 && problem.is_line) blocks.rows = channel_length(problem);
  const std::vector<Site> channels = channels_of(problem);
  for (const Site& site : channels) {
    blocks.signs_y.push_back(sign_of(is_odd(site.quantity, Traction::normal, Axis::y)));
    blocks.signs_z.push_back(sign_of(is_odd(site.quantity, Traction::normal, Axis::z)));
  }
  if (blocks.size() != problem.sites.size()) return {};
  if (blocks.rows == blocks.columns) blocks.partners = partners_of(channels);
  return problem.is_line ? as_row(std::move(blocks)) : blocks;
}

GridBlocks traction_grid(const LinearProblem& problem) {
  GridBlocks blocks{.rows = problem.grid.rows, .columns = problem.grid.columns};
  for (std::size_t u = 0; u < problem.components; ++u) {
    blocks.signs_y.push_back(sign_of(skin_tractions[u] == Traction::tangential_y));
    blocks.signs_z.push_back(sign_of(skin_tractions[u] == Traction::tangential_z));
  }
  if (blocks.rows == blocks.columns && problem.components == 1) blocks.partners = {0};
  if (blocks.rows == blocks.columns && problem.components == 3) blocks.partners = {0, 2, 1};
  return problem.is_line ? as_row(std::move(blocks)) : blocks;
}

bool mirrors_itself(const GridBlocks& readings, std::span<const double> weights) {
  const std::size_t rows = readings.rows;
  const std::size_t columns = readings.columns;
  const auto is_dead = [&](std::size_t block, std::size_t i, std::size_t j) {
    return weights[(block * rows + i) * columns + j] == 0.0;
  };
  for (std::size_t block = 0; block < readings.signs_y.size(); ++block)
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) {
        const bool dead = is_dead(block, i, j);
        if (dead != is_dead(block, rows - 1 - i, j) || dead != is_dead(block, i, columns - 1 - j) ||
            (!readings.partners.empty() && dead != is_dead(readings.partners[block], j, i)))
          return false;
      }
  return true;
}

}  // namespace tactile_net
