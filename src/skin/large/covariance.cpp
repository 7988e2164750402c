#include "tactile_net/skin/large/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/large/band_probes.hpp"
#include "skin/large/piece.hpp"
#include "skin/large/solved_sums.hpp"
#include "skin/scaled_deviation.hpp"

namespace tactile_net {

struct LargeSkinBands::Parts {
  /// [W K; sqrt(alpha) L] P^-1 weights, over the largest of them, and that one. Of another alpha
  /// what was solved is of no use.
  std::pair<Eigen::VectorXd, double> image(std::span<const double> weights, double of_alpha) {
    if (alpha != of_alpha) solved.clear();
    alpha = of_alpha;
    solver.use_alpha(alpha);
    check_weights(weights, solver.problem().components * solver.problem().grid.count());
    const auto rows = static_cast<Eigen::Index>(solver.stacked_rows());
    return solved.image(solver.problem().grid, weights, rows, [&](const Eigen::VectorXd& one) {
      const auto read = solver.stacked_product(solver.solve_normal(as_span(one), residual));
      return Eigen::VectorXd(as_eigen(std::span(read)));
    });
  }

  /// How far the piece's deviations are off what probes have. An error varies slowly with both
  /// alphas: measured is that of alphas a power of two from the piece's size, the nearest ones.
  BandError error(double of_alpha, double prior_alpha) {
    const double size = std::max(piece->largest_square(), std::numeric_limits<double>::min());
    const auto steps = [](double ratio) { return static_cast<int>(std::lround(std::log2(ratio))); };
    const std::pair at{steps(of_alpha / size), steps(prior_alpha / of_alpha)};
    if (const auto known = known_errors.find(at); known != known_errors.end()) return known->second;
    const double near_alpha = std::ldexp(size, at.first);
    const double near_prior = std::ldexp(near_alpha, at.second);
    const std::vector<double> deviations =
        piece->deviations(solver.problem(), near_alpha, near_prior);
    solver.use_alpha(near_alpha);
    BandError found;
    for (const BandProbe& probe : band_probes(solver.problem())) {
      const std::vector<double> exact = probed_deviations(solver, near_prior, probe);
      for (std::size_t i = 0; i < exact.size(); ++i) {
        if (!(exact[i] > 0.0)) continue;
        const double off = deviations[probe.tractions[i]] / exact[i] - 1.0;
        found.least = found.tractions == 0 ? off : std::min(found.least, off);
        found.most = found.tractions == 0 ? off : std::max(found.most, off);
        ++found.tractions;
      }
    }
    solver.use_alpha(of_alpha);
    return known_errors[at] = found;
  }

  LargeSkinTikhonov& solver;
  std::shared_ptr<SkinPiece> piece;
  double alpha = 0.0;
  SolvedSums solved{};
  std::map<std::pair<int, int>, BandError> known_errors{};  // by powers of two, as `error` has them

  static constexpr double residual = 1e-6;
};

LargeSkinBands::LargeSkinBands(LargeSkinTikhonov& solver, const SkinArray& skin,
                               const Material& material, const SkinProblemOptions& options)
    : parts_(std::make_unique<Parts>(
          Parts{solver, std::make_shared<SkinPiece>(skin, material, options, solver.problem())})) {}
LargeSkinBands::LargeSkinBands(LargeSkinTikhonov& solver, const LargeSkinBands& like)
    : parts_(std::make_unique<Parts>(Parts{solver, like.parts_->piece})) {}
LargeSkinBands::~LargeSkinBands() = default;

LargeSkinCovariance::LargeSkinCovariance(LargeSkinBands& bands, double prior_alpha,
                                         double degrees_of_freedom)
    : bands_(bands),
      alpha_(bands.parts_->solver.alpha()),
      prior_alpha_(prior_alpha),
      degrees_(degrees_of_freedom) {
  check_alpha(prior_alpha);
}

const std::vector<double>& LargeSkinCovariance::estimates() const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  if (estimates_.empty())
    estimates_ = parts.piece->deviations(parts.solver.problem(), alpha_, prior_alpha_);
  return estimates_;
}

std::vector<double> LargeSkinCovariance::deviations() const { return estimates(); }

std::vector<double> LargeSkinCovariance::window_deviations(const SurfaceGrid&,
                                                           const CellWindow& window) const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  return parts.piece->window_deviations(parts.solver.problem(), alpha_, prior_alpha_, window);
}

BandError LargeSkinCovariance::error() const { return bands_.parts_->error(alpha_, prior_alpha_); }

double LargeSkinCovariance::deviation(std::span<const double> weights) const {
  const LargeSkinBands::Parts& parts = *bands_.parts_;
  const LinearProblem& problem = parts.solver.problem();
  const std::size_t cells = problem.grid.count();
  const auto first =
      std::find_if(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
  if (first == weights.end()) return 0.0;
  const std::size_t cell = static_cast<std::size_t>(first - weights.begin()) % cells;
  if (!is_of_one_cell(weights, cells)) return scaled_deviation(*this, weights);
  // Of a single cell: as the piece has it, times the most that dead taxels make of its tractions.
  std::vector<double> of_cell(problem.components);
  std::vector<double> one(problem.components);
  double more = 0.0;
  for (std::size_t u = 0; u < one.size(); ++u) {
    of_cell[u] = weights[u * cells + cell];
    std::fill(one.begin(), one.end(), 0.0);
    one[u] = 1.0;
    more = std::max(more, estimates()[u * cells + cell] /
                              parts.piece->deviation(problem, alpha_, prior_alpha_, cell, one));
  }
  return more * parts.piece->deviation(problem, alpha_, prior_alpha_, cell, of_cell);
}

double LargeSkinCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  LargeSkinBands::Parts& parts = *bands_.parts_;
  const auto read = static_cast<Eigen::Index>(parts.solver.problem().weights.size());
  const auto of_a = parts.image(a, alpha_);
  return image_product(of_a, parts.image(b, alpha_), read, alpha_ / prior_alpha_);
}

}  // namespace tactile_net
