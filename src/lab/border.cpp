#include "lab/border.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "realtime/border_pressure.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/skin/resultant.hpp"

namespace tactile_net::lab {
namespace {

/// The index in 0 ... count - 1 of the place nearest to `at`, where place i is `first + i spacing`.
std::size_t nearest_place(double at, double first, double spacing, std::size_t count) {
  const double index = std::round((at - first) / spacing);
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(count - 1)));
}

/// The cells above dead taxels that no live one sees, and those that touch them.
std::vector<std::size_t> holes(const SkinSceneProblem& problem, const std::vector<bool>& unseen,
                               double sight) {
  const SurfaceGrid& grid = problem.grid();
  const LinearProblem& solved = problem.layout();
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < solved.sites.size(); ++i) {
    if (solved.weights[i] != 0.0) continue;
    const Site& site = solved.sites[i];
    const auto nearest = [sight](double at, double first, double spacing, std::size_t count) {
      return std::pair(nearest_place(at - sight, first, spacing, count),
                       nearest_place(at + sight, first, spacing, count));
    };
    const auto [top, bottom] = nearest(site.y, grid.y(0), grid.spacing_y, grid.rows);
    const auto [left, right] = nearest(site.z, grid.z(0), grid.spacing_z, grid.columns);
    for (std::size_t m = top; m <= bottom; ++m)
      for (std::size_t n = left; n <= right; ++n)
        if (unseen[m * grid.columns + n] &&
            std::hypot(grid.y(m) - site.y, grid.z(n) - site.z) <= sight)
          cells.push_back(m * grid.columns + n);
  }
  return cells.empty() ? cells : with_neighbours(grid, cells);
}

}  // namespace

std::vector<std::size_t> border_values(const SceneProblem& problem) {
  // Where live taxels are so far apart, with dead ones between, a narrow contact looks like a weak
  // one. What a single dead taxel hides the bands hold.
  constexpr double depths = 1.01;
  constexpr double pitches = 2.01;
  const Surface& surface = problem.surface();
  const std::vector<std::size_t>& dead = problem.scene().dead_taxels;
  const SensorArray& array = problem.scene().sensor;
  const double far = std::max(depths * least_depth(array), pitches * array.pitch);
  std::vector<std::size_t> border;
  std::optional<std::size_t> before;  // the live taxel: taxels are numbered by their place
  std::size_t at = 0;                 // the value above it
  for (std::size_t taxel = 0; taxel < array.count; ++taxel) {
    if (std::find(dead.begin(), dead.end(), taxel) != dead.end()) continue;
    const double place = position(array, taxel);
    const std::size_t next =
        nearest_place(place, surface.position(0), surface.spacing, surface.count);
    if (!before) border.push_back(next);
    if (before && taxel - *before > 1 && place - position(array, *before) > far)
      while (++at < next) border.push_back(at);
    before = taxel;
    at = next;
  }
  if (before && border.back() != at) border.push_back(at);
  return border;
}

std::vector<std::size_t> border_cells(const SkinSceneProblem& problem,
                                      const std::vector<bool>& unseen) {
  const SkinArray& skin = problem.scene().sensor;
  const SurfaceGrid& grid = problem.grid();
  const LinearProblem& solved = problem.layout();
  const double sight = sight_of(skin);
  const double reach = sight + 1.01 * std::max(grid.spacing_y, grid.spacing_z);
  // Across a single row of taxels every contact reaches beyond them.
  const bool one_row = is_even(skin) && skin.rows == 1;
  const bool one_column = is_even(skin) && skin.columns == 1;
  std::vector<std::size_t> cells = holes(problem, unseen, sight);
  for (std::size_t i = 0; i < solved.sites.size(); ++i) {
    if (solved.weights[i] == 0.0) continue;
    const Site& site = solved.sites[i];
    const std::size_t row = nearest_place(site.y, grid.y(0), grid.spacing_y, grid.rows);
    const std::size_t column = nearest_place(site.z, grid.z(0), grid.spacing_z, grid.columns);
    const auto down = one_row ? 0 : static_cast<std::ptrdiff_t>(reach / grid.spacing_y);
    const auto across = one_column ? 0 : static_cast<std::ptrdiff_t>(reach / grid.spacing_z);
    const auto is_blind = [&](std::ptrdiff_t m, std::ptrdiff_t n) {
      if (m < 0 || n < 0 || m >= static_cast<std::ptrdiff_t>(grid.rows) ||
          n >= static_cast<std::ptrdiff_t>(grid.columns))
        return true;
      return unseen[static_cast<std::size_t>(m) * grid.columns + static_cast<std::size_t>(n)] &&
             std::hypot(grid.y(static_cast<std::size_t>(m)) - site.y,
                        grid.z(static_cast<std::size_t>(n)) - site.z) <= reach;
    };
    bool beside = false;
    for (std::ptrdiff_t m = -down; m <= down && !beside; ++m)
      for (std::ptrdiff_t n = -across; n <= across && !beside; ++n)
        beside =
            is_blind(static_cast<std::ptrdiff_t>(row) + m, static_cast<std::ptrdiff_t>(column) + n);
    if (beside) cells.push_back(row * grid.columns + column);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

bool presses_at_border(std::span<const double> pressure, std::span<const std::size_t> border) {
  return tactile_net::presses_at_border(pressure, border);
}

}  // namespace tactile_net::lab
