#include "tactile_net/skin/large/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/coordinates.hpp"
#include "skin/family_factors.hpp"
#include "skin/scaled_deviation.hpp"
#include "skin/window_sums.hpp"
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
  /// Weights, and [W K; sqrt(alpha) L] P^-1 times them.
  struct Solved {
    Eigen::VectorXd weights;
    Eigen::VectorXd image;
  };

  /// [W K; sqrt(alpha) L] P^-1 weights, over the largest of them, and that one. Solved for is only
  /// what the weights have beside all that was solved before: of forces, moments and what follows
  /// from them few are new. Where the solver's alpha is another one, what was solved is of no use.
  std::pair<Eigen::VectorXd, double> image(std::span<const double> weights) {
    if (alpha != solver.alpha() || solved.size() >= most_solved) {
      solved.clear();
      alpha = solver.alpha();
    }
    Eigen::VectorXd left = as_eigen(weights);
    const double most = left.cwiseAbs().maxCoeff();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(solver.stacked_rows()));
    if (!(most > 0.0)) return {sum, 0.0};
    left /= most;
    const double size = left.norm();
    for (int again = 0; again < 2; ++again)  // once leaves what rounding has of the others
      for (const Solved& one : solved) {
        const double share = one.weights.dot(left);
        left -= share * one.weights;
        sum += share * one.image;
      }
    const double rest = left.norm();
    if (rest > known * size) {
      left /= rest;
      const std::span<const double> right(left.data(), static_cast<std::size_t>(left.size()));
      const auto read = solver.stacked_product(solver.solve_normal(right, residual));
      solved.push_back({left, as_eigen(std::span(read))});
      sum += rest * solved.back().image;
    }
    return {sum, most};
  }

  /// Where a cell's like is among the piece's, and whether its nearest taxel is dead.
  [[nodiscard]] std::size_t like_cell(std::size_t cell) const;
  [[nodiscard]] bool is_dead(std::size_t cell) const;

  LargeSkinTikhonov& solver;
  SkinArray skin;
  SkinProblem piece;
  SkinFamily family;
  std::vector<bool> dead;         // taxels
  Eigen::VectorXd piece_squares;  // of the piece's prior
  double alpha = 0.0;
  std::list<Solved> solved{};  // orthonormal weights

  static constexpr std::size_t most_solved = 24;
  static constexpr double known = 1e-10;  // of weights: no more than rounding
  static constexpr double residual = 1e-6;
};

/// Of a cell of the whole the cell of the piece that is as far from the nearer ends.
std::size_t LargeSkinBands::Parts::like_cell(std::size_t cell) const {
  const SkinGrid& grid = solver.problem().grid;
  const SkinGrid& small = piece.grid;
  return like(cell / grid.columns, grid.rows, small.rows, grid.stride_rows) * small.columns +
         like(cell % grid.columns, grid.columns, small.columns, grid.stride_columns);
}

bool LargeSkinBands::Parts::is_dead(std::size_t cell) const {
  const SkinGrid& grid = solver.problem().grid;
  const auto nearest = [](std::size_t at, std::size_t margin, std::size_t stride,
                          std::size_t taxels) {
    const std::size_t from = at < margin ? 0 : (at - margin + stride / 2) / stride;
    return std::min(from, taxels - 1);
  };
  return dead[nearest(cell / grid.columns, grid.margin_rows, grid.stride_rows, skin.rows) *
                  skin.columns +
              nearest(cell % grid.columns, grid.margin_columns, grid.stride_columns, skin.columns)];
}

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
  const SkinProblem& whole = solver.problem();
  std::vector<bool> dead(whole.taxels);
  for (std::size_t i = 0; i < whole.sites.size(); ++i)
    if (whole.weights[i] == 0.0) dead[whole.sites[i].taxel] = true;
  Eigen::VectorXd squares =
      CosineCoordinates(piece, stabiliser_spectrum(piece).cwiseSqrt()).squares();
  parts_ = std::make_unique<Parts>(Parts{solver, skin, std::move(piece), std::move(family),
                                         std::move(dead), std::move(squares)});
}
LargeSkinBands::~LargeSkinBands() = default;

LargeSkinCovariance::LargeSkinCovariance(LargeSkinBands& bands, double prior_alpha,
                                         double degrees_of_freedom)
    : bands_(bands), prior_alpha_(prior_alpha), degrees_(degrees_of_freedom) {
  check_alpha(prior_alpha);
}

std::vector<double> LargeSkinCovariance::deviations() const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  const std::size_t cells = parts.solver.problem().grid.count();
  const std::size_t small = parts.piece.grid.count();
  const std::vector<double> own =
      SkinCovariance(parts.family, parts.solver.alpha(), prior_alpha_).deviations();
  std::vector<double> all(parts.solver.problem().components * cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::size_t like = parts.like_cell(cell);
    const bool dead = parts.is_dead(cell);
    for (std::size_t from = like, to = cell; to < all.size(); from += small, to += cells)
      all[to] = dead ? std::max(own[from], prior_deviation(from)) : own[from];
  }
  return all;
}

std::vector<double> LargeSkinCovariance::window_deviations(const SkinGrid& grid,
                                                           const CellWindow& window) const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  const SkinGrid& small = parts.piece.grid;
  const std::vector<double> own = SkinCovariance(parts.family, parts.solver.alpha(), prior_alpha_)
                                      .window_deviations(small, window);
  const Eigen::VectorXd prior =
      parts.family.factors()->coordinates->squares(small, window).cwiseSqrt() /
      std::sqrt(prior_alpha_);
  std::vector<double> dead(grid.count());
  for (std::size_t cell = 0; cell < dead.size(); ++cell)
    dead[cell] = parts.is_dead(cell) ? 1.0 : 0.0;
  window_sums(grid, window, dead);
  std::vector<double> all(grid.count());
  for (std::size_t cell = 0; cell < all.size(); ++cell) {
    const std::size_t like = parts.like_cell(cell);
    all[cell] =
        dead[cell] > 0.0 ? std::max(own[like], prior(static_cast<Eigen::Index>(like))) : own[like];
  }
  return all;
}

double LargeSkinCovariance::prior_deviation(std::size_t of_piece) const {
  return std::sqrt(bands_.parts_->piece_squares(static_cast<Eigen::Index>(of_piece)) /
                   prior_alpha_);
}

double LargeSkinCovariance::deviation(std::span<const double> weights) const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  const std::size_t cells = parts.solver.problem().grid.count();
  const auto first =
      std::find_if(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
  if (first == weights.end()) return 0.0;
  const std::size_t cell = static_cast<std::size_t>(first - weights.begin()) % cells;
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] != 0.0 && i % cells != cell) return scaled_deviation(*this, weights);
  // Of a single cell.
  const std::size_t small = parts.piece.grid.count();
  const std::size_t like = parts.like_cell(cell);
  std::vector<double> of_piece(parts.piece.components * small);
  double prior = 0.0;
  for (std::size_t from = cell, to = like; from < weights.size(); from += cells, to += small) {
    of_piece[to] = weights[from];
    prior = std::hypot(prior, weights[from] * prior_deviation(to));
  }
  const double own =
      SkinCovariance(parts.family, parts.solver.alpha(), prior_alpha_).deviation(of_piece);
  return parts.is_dead(cell) ? std::max(own, prior) : own;
}

double LargeSkinCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  const auto [of_a, largest_a] = bands_.parts_->image(a);
  const auto [of_b, largest_b] = bands_.parts_->image(b);
  const LargeSkinTikhonov& solver = bands_.parts_->solver;
  const auto read = static_cast<Eigen::Index>(solver.problem().weights.size());
  const double known = of_a.head(read).dot(of_b.head(read));
  const Eigen::Index rest = of_a.size() - read;
  const double smoothed = of_a.tail(rest).dot(of_b.tail(rest));
  return largest_a * (largest_b * (known + solver.alpha() / prior_alpha_ * smoothed));
}

}  // namespace tactile_net
