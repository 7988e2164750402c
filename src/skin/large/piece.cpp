#include "skin/large/piece.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inverse/coordinates.hpp"
#include "inverse/window_sums.hpp"
#include "skin/large/system.hpp"
#include "tactile_net/inverse/covariance.hpp"

namespace tactile_net {
namespace {

/// Taxels along the piece's sides, at most.
constexpr std::size_t most_taxels = 14;

/// Taxels on either side of a dead one that it makes a difference to.
constexpr std::size_t dead_reach = 3;

LinearProblem piece_of(SkinArray skin, const Material& material, SkinProblemOptions options,
                       const LinearProblem& whole) {
  skin.rows = std::min(skin.rows, most_taxels);
  skin.columns = std::min(skin.columns, most_taxels);
  options.dead_taxels.clear();
  options.smoothing_length = whole.smoothing_length;
  return make_problem(skin, material, options);
}

/// Of a cell of a long line the one of a short line that is as far from the nearer end, or the
/// middle one, with as many cells between it and the nearest taxel.
std::size_t like(std::size_t cell, std::size_t cells, std::size_t fewer, std::size_t stride) {
  const std::size_t middle = (fewer - stride) / 2;
  const std::size_t left = cells - 1 - cell;
  if (cell < middle) return cell;
  if (left + middle + stride < fewer) return fewer - 1 - left;
  return middle + (cell - middle) % stride;
}

/// The cell of a taxel along one axis, and those within a reach of it.
struct Window {
  Window(std::size_t taxel, std::size_t margin, std::size_t stride, std::size_t cells,
         std::size_t reach)
      : at(margin + taxel * stride),
        first(at < reach * stride ? 0 : at - reach * stride),
        last(std::min(at + reach * stride, cells - 1)) {}
  std::size_t at, first, last;
};

std::size_t nearest_taxel(const SurfaceGrid& grid, const SkinArray& skin, std::size_t cell) {
  const auto nearest = [](std::size_t at, std::size_t margin, std::size_t stride,
                          std::size_t taxels) {
    const std::size_t from = at < margin ? 0 : (at - margin + stride / 2) / stride;
    return std::min(from, taxels - 1);
  };
  return nearest(cell / grid.columns, grid.margin_rows, grid.stride_rows, skin.rows) *
             skin.columns +
         nearest(cell % grid.columns, grid.margin_columns, grid.stride_columns, skin.columns);
}

/// Taxels that are dead with all around them: what is above them nothing tells.
std::vector<bool> blind_taxels(const SkinArray& skin, const std::vector<bool>& dead) {
  std::vector<bool> blind = dead;
  for (std::size_t row = 0; row < skin.rows; ++row)
    for (std::size_t column = 0; column < skin.columns; ++column)
      for (std::size_t i = row == 0 ? 0 : row - 1; i <= std::min(row + 1, skin.rows - 1); ++i)
        for (std::size_t j = column == 0 ? 0 : column - 1;
             j <= std::min(column + 1, skin.columns - 1); ++j)
          if (!dead[i * skin.columns + j]) blind[row * skin.columns + column] = false;
  return blind;
}

}  // namespace

SkinPiece::SkinPiece(const SkinArray& skin, const Material& material,
                     const SkinProblemOptions& options, const LinearProblem& whole)
    : skin_(skin),
      problem_(piece_of(skin, material, options, whole)),
      family_(problem_),
      prior_squares_(
          WaveCoordinates(problem_, stabiliser_spectrum(problem_).cwiseSqrt()).squares()) {}

std::size_t SkinPiece::like_cell(const SurfaceGrid& whole, std::size_t cell) const {
  const SurfaceGrid& small = problem_.grid;
  return like(cell / whole.columns, whole.rows, small.rows, whole.stride_rows) * small.columns +
         like(cell % whole.columns, whole.columns, small.columns, whole.stride_columns);
}

double SkinPiece::largest_square() const {
  double largest = 0.0;
  for (const double gamma : family_.singular_values()) largest = std::max(largest, gamma);
  return largest * largest;
}

std::vector<double> SkinPiece::deviations(const LinearProblem& whole, double alpha,
                                          double prior_alpha) {
  const std::vector<double> own = TractionCovariance(family_, alpha, prior_alpha).deviations();
  const std::size_t cells = whole.grid.count();
  const std::size_t small = problem_.grid.count();
  std::vector<double> all(whole.components * cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t from = like_cell(whole.grid, cell), to = cell; to < all.size();
         from += small, to += cells)
      all[to] = own[from];
  add_dead(all, own, whole, alpha, prior_alpha);
  return all;
}

std::vector<double> SkinPiece::window_deviations(const LinearProblem& whole, double alpha,
                                                 double prior_alpha,
                                                 const CellWindow& window) const {
  const SurfaceGrid& grid = whole.grid;
  const std::vector<double> own =
      TractionCovariance(family_, alpha, prior_alpha).window_deviations(problem_.grid, window);
  const Eigen::VectorXd prior = WaveCoordinates(problem_, stabiliser_spectrum(problem_).cwiseSqrt())
                                    .squares(problem_.grid, window)
                                    .cwiseSqrt() /
                                std::sqrt(prior_alpha);
  const std::vector<bool> dead = dead_taxels(whole);
  std::vector<double> near_dead(grid.count());
  for (std::size_t cell = 0; cell < near_dead.size(); ++cell)
    near_dead[cell] = dead[nearest_taxel(grid, skin_, cell)] ? 1.0 : 0.0;
  window_sums(grid, window, near_dead);
  std::vector<double> all(grid.count());
  for (std::size_t cell = 0; cell < all.size(); ++cell) {
    const std::size_t from = like_cell(grid, cell);
    all[cell] = near_dead[cell] > 0.0 ? std::max(own[from], prior(static_cast<Eigen::Index>(from)))
                                      : own[from];
  }
  return all;
}

void SkinPiece::add_dead(std::vector<double>& deviations, const std::vector<double>& alive,
                         const LinearProblem& whole, double alpha, double prior_alpha) {
  const std::vector<bool> dead = dead_taxels(whole);
  if (std::find(dead.begin(), dead.end(), true) == dead.end()) return;

  const SurfaceGrid& small = problem_.grid;
  const std::size_t piece_rows = std::min(skin_.rows, most_taxels);
  const std::size_t piece_columns = std::min(skin_.columns, most_taxels);
  const std::array<std::size_t, 1> middle{(piece_rows / 2) * piece_columns + piece_columns / 2};
  if (!with_dead_) {
    LinearProblem one = problem_;
    leave_out(one, middle);
    with_dead_.emplace(one);
  }
  const std::vector<double> beside =
      TractionCovariance(*with_dead_, alpha, prior_alpha).deviations();

  const SurfaceGrid& grid = whole.grid;
  const Window here(piece_rows / 2, small.margin_rows, small.stride_rows, small.rows, dead_reach);
  const Window there(piece_columns / 2, small.margin_columns, small.stride_columns, small.columns,
                     dead_reach);
  for (std::size_t taxel = 0; taxel < dead.size(); ++taxel) {
    if (!dead[taxel]) continue;
    const Window rows(taxel / skin_.columns, grid.margin_rows, grid.stride_rows, grid.rows,
                      dead_reach);
    const Window columns(taxel % skin_.columns, grid.margin_columns, grid.stride_columns,
                         grid.columns, dead_reach);
    for (std::size_t row = rows.first; row <= rows.last; ++row) {
      const std::size_t of_row = here.at + row - rows.at;
      if (of_row >= small.rows) continue;
      for (std::size_t column = columns.first; column <= columns.last; ++column) {
        const std::size_t of_column = there.at + column - columns.at;
        if (of_column >= small.columns) continue;
        const std::size_t from = of_row * small.columns + of_column;
        for (std::size_t u = 0; u < whole.components; ++u)
          deviations[u * grid.count() + row * grid.columns + column] *=
              beside[u * small.count() + from] / alive[u * small.count() + from];
      }
    }
  }
  const std::vector<bool> blind = blind_taxels(skin_, dead);
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    for (std::size_t u = 0, from = like_cell(grid, cell); u < whole.components;
         ++u, from += small.count()) {
      const double prior = std::sqrt(prior_squares_(static_cast<Eigen::Index>(from)) / prior_alpha);
      double& deviation = deviations[u * grid.count() + cell];
      const bool is_blind = blind[nearest_taxel(grid, skin_, cell)];
      deviation = is_blind ? std::max(prior, alive[from])
                           : std::min(deviation, std::max(prior, alive[from]));
    }
}

double SkinPiece::deviation(const LinearProblem& whole, double alpha, double prior_alpha,
                            std::size_t cell, std::span<const double> weights) const {
  const std::size_t small = problem_.grid.count();
  std::vector<double> of_piece(problem_.components * small);
  for (std::size_t u = 0, at = like_cell(whole.grid, cell); u < weights.size(); ++u, at += small)
    of_piece[at] = weights[u];
  return TractionCovariance(family_, alpha, prior_alpha).deviation(of_piece);
}

}  // namespace tactile_net
