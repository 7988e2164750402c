#include "tactile_net/lab/tradeoff/input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "lab/tradeoff/points.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::lab {
namespace {

/// The root mean square of what white noise of that size does to f: rms |M|_F.
double noise_of_solution(const StudyInput& input, const InverseProblem& problem, double alpha) {
  const Reconstruction inverse = tikhonov(problem, alpha);
  double squares = 0.0;
  for (std::size_t i = 0; i < inverse.readings(); ++i) {
    if (problem.weights[i] == 0.0) continue;
    const double weight = input.noise_stated ? problem.weights[i] : 1.0;
    const double size = l2_norm(inverse.transposed().row(i)) / weight;
    squares += size * size;
  }
  return input.noise_rms * std::sqrt(squares);
}

}  // namespace

StudyInput study_input(const Scene& scene) {
  StudyInput input{.scene = scene};
  Simulation simulation = simulate(scene);
  input.truth = std::move(simulation.truth);
  input.readings = std::move(simulation.readings);
  double largest = 0.0;
  for (const double reading : input.readings) largest = std::max(largest, std::abs(reading));
  if (!(largest > 0.0))
    throw std::invalid_argument(
        "every reading is zero: without a contact there is no error to measure");
  if (!scene.reconstruct.alpha)
    input.scene.reconstruct.alpha =
        sweep_of(scene, input.readings).choice(scene.reconstruct.alpha_rule).alpha;
  const double alpha = *input.scene.reconstruct.alpha;

  const InverseProblem problem = problem_of(input.scene);
  input.solution = tikhonov_solve(problem, alpha, input.readings);
  const TikhonovFamily family(problem);
  input.agreement =
      relative_l2_error(family.solve(family.analyse(input.readings), alpha), input.solution);
  input.solution_error =
      error_to_truth(input, input.solution).value_or(std::numeric_limits<double>::quiet_NaN());
  input.constrained = constraints_of(input.scene).has_value();

  const std::optional<double> stated = stated_noise(scene);
  input.noise_stated = stated.has_value();
  input.noise_rms = stated.value_or(0.01 * largest);
  input.noise_floor = noise_of_solution(input, problem, alpha) / l2_norm(input.solution);
  return input;
}

}  // namespace tactile_net::lab
