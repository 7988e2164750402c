#include "tactile_net/lab/skin_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactile_net::lab {

std::vector<bool> unseen_cells(const SkinSceneProblem& problem) {
  const SkinArray& skin = problem.scene().sensor;
  const SkinGrid& grid = problem.grid();
  // A row of taxels has no pitch across it.
  const double pitch = std::max(!is_even(skin) || skin.rows > 1 ? skin.pitch_y : 0.0,
                                !is_even(skin) || skin.columns > 1 ? skin.pitch_z : 0.0);
  const double reach = std::max(0.75 * pitch, 0.5 * least_depth(skin));
  std::vector<bool> unseen(grid.count());
  const std::vector<SkinSite> all = sites(skin);
  for (std::size_t cell = 0; cell < unseen.size(); ++cell) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (problem.problem().weights[i] != 0.0)
        nearest = std::min(nearest, std::hypot(all[i].y - grid.y(cell / grid.columns),
                                               all[i].z - grid.z(cell % grid.columns)));
    unseen[cell] = nearest > reach;
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
