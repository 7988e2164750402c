#include "tactile_net/lab/skin_sight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace tactile_net::lab {
namespace {

constexpr double least_difference = 1e-9;  // what lies just as far is as near in every unit

/// How far apart taxels lie that are nowhere in rows: the mean distance to the third nearest place,
/// which of a square lattice and of a triangular one is their pitch. The nearest ones lie closer
/// the less even a skin is, though it leaves no gaps.
double mean_spacing(std::span<const Site> sites) {
  std::vector<std::pair<double, double>> places;
  for (const Site& site : sites) places.emplace_back(site.y, site.z);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  constexpr std::size_t third = 3;  // the first is the place itself
  double sum = 0.0;
  std::vector<double> away(places.size());
  for (const auto& place : places) {
    std::transform(places.begin(), places.end(), away.begin(), [&](const auto& other) {
      return std::hypot(other.first - place.first, other.second - place.second);
    });
    const auto at =
        away.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(third, away.size() - 1));
    std::nth_element(away.begin(), at, away.end());
    sum += *at / static_cast<double>(places.size());
  }
  return sum;
}

/// Whether taxels stand all around a place, near enough for each to read what presses there: what
/// is loaded between them cannot be much more, or elsewhere, without their seeing it.
bool is_surrounded(double y, double z, const LinearProblem& problem) {
  constexpr double near = 1.5 + least_difference;  // of a taxel's own depth
  constexpr double widest =
      150.0 / 180.0 * std::numbers::pi + least_difference;  // between neighbours
  std::vector<double> directions;
  for (std::size_t i = 0; i < problem.sites.size(); ++i) {
    const Site& site = problem.sites[i];
    const double reach = near * site.depth;
    if (problem.weights[i] != 0.0 && std::abs(site.y - y) <= reach &&
        std::abs(site.z - z) <= reach && std::hypot(site.y - y, site.z - z) <= reach)
      directions.push_back(std::atan2(site.z - z, site.y - y));
  }
  if (directions.size() < 3) return false;
  std::sort(directions.begin(), directions.end());
  double gap = directions.front() + 2.0 * std::numbers::pi - directions.back();
  for (std::size_t i = 1; i < directions.size(); ++i)
    gap = std::max(gap, directions[i] - directions[i - 1]);
  return gap <= widest;
}

}  // namespace

double sight_of(const SkinArray& skin) {
  // A row of taxels has no pitch across it.
  const double pitch = is_even(skin) ? std::max(skin.rows > 1 ? skin.pitch_y : 0.0,
                                                skin.columns > 1 ? skin.pitch_z : 0.0)
                                     : std::max(skin.pitch_y, mean_spacing(sites(skin)));
  return (1.0 + least_difference) * std::max(0.75 * pitch, 0.5 * least_depth(skin));
}

std::vector<bool> unseen_cells(const SkinSceneProblem& problem) {
  const SurfaceGrid& grid = problem.grid();
  const double reach = sight_of(problem.scene().sensor);
  std::vector<bool> unseen(grid.count(), true);
  const LinearProblem& solved = problem.layout();
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
    const Site& site = solved.sites[i];
    const auto [row, last_row] = near(site.y, grid.y(0), grid.spacing_y, reach, grid.rows);
    const auto [column, last_column] = near(site.z, grid.z(0), grid.spacing_z, reach, grid.columns);
    for (std::size_t m = row; m < last_row; ++m)
      for (std::size_t n = column; n < last_column; ++n)
        if (std::hypot(site.y - grid.y(m), site.z - grid.z(n)) <= reach)
          unseen[m * grid.columns + n] = false;
  }
  for (std::size_t cell = 0; cell < unseen.size(); ++cell)
    if (unseen[cell] &&
        is_surrounded(grid.y(cell / grid.columns), grid.z(cell % grid.columns), solved))
      unseen[cell] = false;
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
