#include "tactile_net/skin/space_wrench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "skin/cell_wrench.hpp"
#include "skin/curved_kernel.hpp"

namespace tactile_net {
namespace {

using Weights = std::vector<double>;

/// Weights of the sums over cells that make a wrench.
class SpaceSums {
 public:
  SpaceSums(const LinearProblem& problem, std::span<const std::size_t> cells)
      : problem_(problem), cells_(cells) {
    if (!problem.cells || problem.cells->size() != problem.grid.count())
      throw std::invalid_argument("a wrench in space is of the cells of a curved skin");
  }

  /// @param of  a vector of cell `at` by the component u: per Pa of the problem's tractions
  [[nodiscard]] std::array<Weights, 3> operator()(const auto& of) const {
    const std::size_t count = problem_.grid.count();
    std::array<Weights, 3> all;
    all.fill(Weights(problem_.components * count));
    for (const std::size_t at : cells_)
      for (std::size_t u = 0; u < problem_.components; ++u) {
        const SpaceVector vector = of(at, u);
        for (std::size_t k = 0; k < all.size(); ++k) all[k][u * count + at] = vector[k];
      }
    return all;
  }

 private:
  const LinearProblem& problem_;
  std::span<const std::size_t> cells_;
};

double total(const Weights& weights, std::span<const double> tractions) {
  double all = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) all += weights[i] * tractions[i];
  return all;
}

/// The place of the surface above a point: on the tangent plane of the nearest cell.
SurfacePlace place_above(const LinearProblem& problem, const SpaceVector& point) {
  SurfacePlace place = (*problem.cells)[nearest_cell(*problem.cells, point)].middle;
  const SpaceVector from = combined(1.0, point, -1.0, place.point);
  place.point = combined(1.0, point, -dot(from, place.frame[0]), place.frame[0]);
  return place;
}

}  // namespace

SpaceWrench space_wrench(const LinearProblem& problem, std::span<const double> tractions,
                         std::span<const std::size_t> cells, const Covariance& covariance,
                         double noise_rms, const UncertainWrench& chart, const SpaceVector& about) {
  const std::size_t count = problem.grid.count();
  if (tractions.size() != problem.components * count)
    throw std::invalid_argument("tractions need one value for each cell and component");
  const SpaceSums sums(problem, cells);
  std::vector<Weights> all;
  const auto put = [&](std::array<Weights, 3> three) {
    for (Weights& one : three) all.push_back(std::move(one));
  };
  put(sums(
      [&](std::size_t at, std::size_t u) { return cell_wrench(problem, at, u, about).force; }));
  put(sums(
      [&](std::size_t at, std::size_t u) { return cell_wrench(problem, at, u, about).moment; }));
  // The mean of the places that press, and the sums on the chart.
  const bool presses = chart.centre_y && chart.centre_z && chart.normal.value > 0.0;
  const std::size_t of_places = all.size();
  SpaceVector middle = about;
  if (presses) {
    std::array<Weights, 3> places = sums([&](std::size_t at, std::size_t u) {
      const SurfaceCell& cell = problem.cells->at(at);
      return u == 0 ? multiple(problem.grid.area() / cell.area, cell.first_moment) : SpaceVector{};
    });
    double force = 0.0;
    for (const std::size_t cell : cells) force += problem.grid.area() * tractions[cell];
    if (force > 0.0) {
      for (std::size_t k = 0; k < places.size(); ++k) {
        middle[k] = total(places[k], tractions) / force;
        for (const std::size_t cell : cells)
          places[k][cell] = (places[k][cell] - middle[k] * problem.grid.area()) / force;
      }
      put(std::move(places));
    }
  }
  const bool has_centre = all.size() > of_places;
  const std::size_t of_chart = all.size();
  for (std::size_t u = 0; u < problem.components; ++u) {
    Weights weights(tractions.size());
    for (const std::size_t cell : cells) weights[u * count + cell] = problem.grid.area();
    all.push_back(std::move(weights));
  }
  std::vector<double> deviations = covariance.deviations_of(all);
  for (double& deviation : deviations) deviation *= noise_rms;

  // What the chart's sums are doubted by beside the covariance acts along the frame's axes there.
  // Where nothing presses these are the axes at the chart's middle.
  const SurfacePlace place =
      has_centre ? place_above(problem, middle) : (*problem.cells)[count / 2].middle;
  const SpaceVector arm = combined(1.0, place.point, -1.0, about);
  const std::array<double, 3> told = {chart.normal.deviation,
                                      chart.tangential_y ? chart.tangential_y->deviation : 0.0,
                                      chart.tangential_z ? chart.tangential_z->deviation : 0.0};
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double own = deviations[of_chart + u];
    if (!(told[u] > own)) continue;
    const double more = std::sqrt(told[u] - own) * std::sqrt(told[u] + own);
    const SpaceVector turned = cross(arm, place.frame[u]);
    for (std::size_t k = 0; k < 3; ++k) {
      deviations[k] = std::hypot(deviations[k], more * place.frame[u][k]);
      deviations[3 + k] = std::hypot(deviations[3 + k], more * turned[k]);
    }
  }
  SpaceWrench wrench;
  for (std::size_t k = 0; k < 3; ++k) {
    wrench.force[k] = {total(all[k], tractions), deviations[k]};
    wrench.moment[k] = {total(all[3 + k], tractions), deviations[3 + k]};
  }
  if (has_centre) {
    wrench.centre.emplace();
    const auto more_along = [](const std::optional<Uncertain>& told_of, double own) {
      return told_of && told_of->deviation > own
                 ? std::sqrt(told_of->deviation - own) * std::sqrt(told_of->deviation + own)
                 : 0.0;
    };
    const auto along = [&](std::size_t axis) {  // by the covariance, along the surface
      double square = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        square = std::hypot(square, deviations[of_places + k] * place.frame[axis][k]);
      return square;
    };
    const double more_y = more_along(chart.centre_y, along(1));
    const double more_z = more_along(chart.centre_z, along(2));
    for (std::size_t k = 0; k < 3; ++k)
      (*wrench.centre)[k] = {middle[k],
                             std::hypot(deviations[of_places + k], more_y * place.frame[1][k],
                                        more_z * place.frame[2][k])};
    wrench.above = place.point;
  }
  return wrench;
}

void put_on_surface(const LinearProblem& problem, std::span<double> tractions) {
  if (!problem.cells) return;
  const std::size_t count = problem.grid.count();
  for (std::size_t i = 0; i < tractions.size(); ++i)
    tractions[i] *= problem.grid.area() / (*problem.cells)[i % count].area;
}

}  // namespace tactile_net
