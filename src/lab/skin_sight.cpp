#include "tactile_net/lab/skin_sight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactile_net::lab {

std::vector<bool> unseen_cells(const SkinSceneProblem& problem) {
  const SkinArray& skin = problem.scene().sensor;
  const SkinGrid& grid = problem.grid();
  // A row of taxels has no pitch across it.
  const double pitch = std::max(!is_even(skin) || skin.rows > 1 ? skin.pitch_y : 0.0,
                                !is_even(skin) || skin.columns > 1 ? skin.pitch_z : 0.0);
  const double reach = std::max(0.75 * pitch, 0.5 * least_depth(skin));
  std::vector<bool> unseen(grid.count(), true);
  const SkinProblem& solved = problem.layout();
  // A taxel sees the cells around it; only those are looked at.
  const auto near = [](double place, double first, double spacing, double far, std::size_t count) {
    const auto clamped = [&](double index) {
      return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(count)));
    };
    return std::pair(clamped(std::floor((place - far - first) / spacing)),
                     clamped(std::ceil((place + far - first) / spacing) + 1.0));
  };
  for (std::size_t i = 0; i < solved.sites.size(); ++i) {
    if (solved.weights[i] == 0.0) continue;
    const SkinSite& site = solved.sites[i];
    const auto [row, last_row] = near(site.y, grid.y(0), grid.spacing_y, reach, grid.rows);
    const auto [column, last_column] = near(site.z, grid.z(0), grid.spacing_z, reach, grid.columns);
    for (std::size_t m = row; m < last_row; ++m)
      for (std::size_t n = column; n < last_column; ++n)
        if (std::hypot(site.y - grid.y(m), site.z - grid.z(n)) <= reach)
          unseen[m * grid.columns + n] = false;
  }
  return unseen;
}

double unseen_share(std::span<const double> tractions, std::span<const std::size_t> cells,
                    const std::vector<bool>& unseen) {
  double all = 0.0;
  double there = 0.0;
  for (const std::size_t cell : cells) {
    const double pressure = std::max(tractions[cell], 0.0);
    all += pressure;
    if (unseen[cell]) there += pressure;
  }
  return all > 0.0 ? there / all : 0.0;
}

double contact_prior(double prior_alpha, std::size_t cells, std::size_t all, bool seen) noexcept {
  const double share = static_cast<double>(cells) / static_cast<double>(all);
  return prior_alpha * (seen ? std::sqrt(share) : share);
}

}  // namespace tactile_net::lab
