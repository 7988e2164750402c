#include "tactile_net/inverse/problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "inverse/checks.hpp"
#include "inverse/stabiliser.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"

namespace tactile_net {
void check(const SensorArray& array, const Material& material, const ProblemOptions& options) {
  check(array);
  check(material);
  if (options.unknowns != 1 && options.unknowns != 2)
    throw std::invalid_argument("unknowns must be 1 (normal) or 2 (normal and tangential)");
  if (options.unknowns > channel_count(array))
    throw std::invalid_argument(
        "two tractions cannot be told apart by one quantity at one depth: read a second one");
  if (!(options.smoothing_length >= 0.0) || !std::isfinite(options.smoothing_length))
    throw std::invalid_argument("smoothing_length must be >= 0 and finite");
  if (options.channel_rms.empty()) {
    const bool strain = std::any_of(array.reads.begin(), array.reads.end(), is_strain);
    const bool stress = !std::all_of(array.reads.begin(), array.reads.end(), is_strain);
    if (strain && stress)
      throw std::invalid_argument(
          "strains and stresses read together need channel_rms: the sum of their squares has no "
          "unit");
  } else if (options.channel_rms.size() != channel_count(array)) {
    throw std::invalid_argument("channel_rms needs one value per channel");
  }
  for (const double rms : options.channel_rms)
    if (!(rms > 0.0) || !std::isfinite(rms))
      throw std::invalid_argument("channel_rms must be > 0 and finite");
  for (const std::size_t taxel : options.dead_taxels)
    if (taxel >= array.count)
      throw std::invalid_argument("dead taxel " + std::to_string(taxel) + " is not < count");
}

InverseProblem make_problem(const SensorArray& array, const Material& material,
                            const ProblemOptions& options) {
  check(array, material, options);

  const Surface surface = surface_of(array, options.surface);
  const std::size_t taxels = array.count;
  const std::size_t n = surface.count;
  const std::vector<Channel> all = channels(array);
  const std::size_t rows = all.size() * taxels;
  const std::size_t columns = options.unknowns * n;
  InverseProblem problem{.kernel = {rows, columns, std::vector<double>(rows * columns)},
                         .weights = std::vector<double>(rows, 1.0),
                         .taxels = taxels,
                         .unknowns = options.unknowns,
                         .surface = surface,
                         .smoothing_length = options.smoothing_length};

  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto row_weights = std::span(problem.weights).subspan(c * taxels, taxels);
    if (!options.channel_rms.empty())
      std::fill(row_weights.begin(), row_weights.end(), 1.0 / options.channel_rms[c]);
    for (const std::size_t taxel : options.dead_taxels) row_weights[taxel] = 0.0;

    for (std::size_t u = 0; u < options.unknowns; ++u) {
      const Traction component = traction_components[u];
      const SurfaceKernel kernel = surface_kernel(all[c], component, material, surface);
      const double weight = options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[c];
      problem.kernel_error = std::hypot(problem.kernel_error, weight * kernel.error);
      for (std::size_t i = 0; i < taxels; ++i) {
        const std::size_t at = surface.margin + i * surface.stride;
        for (std::size_t j = 0; j < n; ++j)
          problem.kernel(c * taxels + i, u * n + j) = row_weights[i] * kernel.lags[at + n - 1 - j];
      }
    }
  }
  const auto is_zero = [](double weight) { return weight == 0.0; };
  if (std::all_of(problem.weights.begin(), problem.weights.end(), is_zero))
    throw std::invalid_argument("every taxel is dead: nothing is measured");
  return problem;
}

Matrix normal_matrix(const InverseProblem& problem, double alpha) {
  check_alpha(alpha);
  const auto kernel = as_eigen(problem.kernel);
  RowMajor p = RowMajor::Zero(kernel.cols(), kernel.cols());
  p.selfadjointView<Eigen::Upper>().rankUpdate(kernel.transpose());

  const double ratio = problem.smoothing_length / problem.surface.spacing;
  const double coupling = alpha * problem.surface.area * ratio * ratio;
  const Eigen::VectorXd sizes = stabiliser_sizes(problem);
  const Eigen::Index n = sizes.size();
  for (Eigen::Index i = 0; i < p.rows(); ++i) {
    p(i, i) += alpha * sizes(i % n) * sizes(i % n);
    if (i % n + 1 == n) continue;  // the last point of a block has no right neighbour
    p(i, i) += coupling;
    p(i + 1, i + 1) += coupling;
    p(i, i + 1) -= coupling;
  }
  p.triangularView<Eigen::StrictlyLower>() = p.transpose();
  return from_eigen(p);
}

std::vector<double> normal_right_side(const InverseProblem& problem,
                                      std::span<const double> readings) {
  check_size(readings, problem.weights.size());
  std::vector<double> right_side(problem.kernel.columns);
  Eigen::Map<Eigen::VectorXd>(right_side.data(), std::ssize(right_side)) =
      as_eigen(problem.kernel).transpose() *
      as_eigen(std::span(problem.weights)).cwiseProduct(as_eigen(readings));
  return right_side;
}

}  // namespace tactile_net
