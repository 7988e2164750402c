#include "tactile_net/skin/large/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <numeric>
#include <optional>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/coordinates.hpp"
#include "tactile_net/skin/covariance.hpp"

namespace tactile_net {
namespace {

/// Taxels along the smaller skin's sides, at most.
constexpr std::size_t most_taxels = 14;

/// Of a cell of a long line the one of a short line that is as far from the nearer end, or the
/// middle one, with as many cells between it and the nearest taxel.
std::size_t like(std::size_t cell, std::size_t cells, std::size_t fewer, std::size_t stride) {
  const std::size_t middle = (fewer - stride) / 2;
  const std::size_t left = cells - 1 - cell;
  if (cell < middle) return cell;
  if (left + middle + stride < fewer) return fewer - 1 - left;
  return middle + (cell - middle) % stride;
}

}  // namespace

struct LargeSkinBands::Parts {
  /// Where the solver's alpha is another one, what was solved is of no use.
  const std::vector<double>& image(std::span<const double> weights) {
    if (alpha != solver.alpha()) {
      images.clear();
      alpha = solver.alpha();
    }
    for (const auto& [of, image] : images)
      if (std::equal(of.begin(), of.end(), weights.begin(), weights.end())) return image;
    return images
        .emplace_back(std::vector<double>(weights.begin(), weights.end()),
                      solver.stacked_product(solver.solve_normal(weights)))
        .second;
  }

  LargeSkinTikhonov& solver;
  SkinArray skin;
  SkinProblem piece;
  SkinFamily family;
  double alpha = 0.0;
  std::list<std::pair<std::vector<double>, std::vector<double>>> images{};
};

namespace {

SkinProblem piece_of(SkinArray skin, const Material& material, SkinProblemOptions options,
                     const SkinProblem& whole) {
  skin.rows = std::min(skin.rows, most_taxels);
  skin.columns = std::min(skin.columns, most_taxels);
  options.dead_taxels.clear();
  options.smoothing_length = whole.smoothing_length;
  return make_problem(skin, material, options);
}

}  // namespace

LargeSkinBands::LargeSkinBands(LargeSkinTikhonov& solver, const SkinArray& skin,
                               const Material& material, const SkinProblemOptions& options) {
  SkinProblem piece = piece_of(skin, material, options, solver.problem());
  SkinFamily family(piece);
  parts_ = std::make_unique<Parts>(Parts{solver, skin, std::move(piece), std::move(family)});
}
LargeSkinBands::~LargeSkinBands() = default;

LargeSkinCovariance::LargeSkinCovariance(LargeSkinBands& bands, double prior_alpha,
                                         double degrees_of_freedom)
    : bands_(bands), prior_alpha_(prior_alpha), degrees_(degrees_of_freedom) {
  check_alpha(prior_alpha);
}

std::vector<double> LargeSkinCovariance::deviations() const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  const SkinProblem& whole = parts.solver.problem();
  const SkinGrid& grid = whole.grid;
  const SkinGrid& small = parts.piece.grid;
  const std::vector<double> own =
      SkinCovariance(parts.family, parts.solver.alpha(), prior_alpha_).deviations();
  const Eigen::VectorXd prior =
      CosineCoordinates(parts.piece, stabiliser_spectrum(parts.piece).cwiseSqrt()).squares();
  std::vector<bool> dead(whole.taxels);
  for (std::size_t i = 0; i < whole.sites.size(); ++i)
    if (whole.weights[i] == 0.0) dead[whole.sites[i].taxel] = true;
  const auto nearest = [](std::size_t cell, std::size_t margin, std::size_t stride,
                          std::size_t taxels) {
    const std::size_t from = cell < margin ? 0 : (cell - margin + stride / 2) / stride;
    return std::min(from, taxels - 1);
  };
  std::vector<double> all(whole.components * grid.count());
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t at = like(row, grid.rows, small.rows, grid.stride_rows) * small.columns +
                             like(column, grid.columns, small.columns, grid.stride_columns);
      const std::size_t taxel =
          nearest(row, grid.margin_rows, grid.stride_rows, parts.skin.rows) * parts.skin.columns +
          nearest(column, grid.margin_columns, grid.stride_columns, parts.skin.columns);
      for (std::size_t u = 0; u < whole.components; ++u) {
        const std::size_t from = u * small.count() + at;
        all[u * grid.count() + row * grid.columns + column] =
            dead[taxel] ? std::max(own[from],
                                   std::sqrt(prior(static_cast<Eigen::Index>(from)) / prior_alpha_))
                        : own[from];
      }
    }
  return all;
}

double LargeSkinCovariance::deviation(std::span<const double> weights) const {
  double most = 0.0;  // a weight may be an area, whose square no number holds
  for (const double weight : weights) most = std::max(most, std::abs(weight));
  if (!(most > 0.0)) return 0.0;
  std::vector<double> shares(weights.begin(), weights.end());
  for (double& share : shares) share /= most;
  return most * std::sqrt(covariance(shares, shares));
}

double LargeSkinCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  const std::vector<double>& of_a = bands_.parts_->image(a);
  const std::vector<double>& of_b = bands_.parts_->image(b);
  const LargeSkinTikhonov& solver = bands_.parts_->solver;
  const auto read = static_cast<std::ptrdiff_t>(solver.problem().weights.size());
  const double known = std::inner_product(of_a.begin(), of_a.begin() + read, of_b.begin(), 0.0);
  const double smoothed =
      std::inner_product(of_a.begin() + read, of_a.end(), of_b.begin() + read, 0.0);
  return known + solver.alpha() / prior_alpha_ * smoothed;
}

}  // namespace tactile_net
