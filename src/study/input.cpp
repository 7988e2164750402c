#include "tactile_net/study/input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "study/points.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::study {
namespace {

/// The root mean square of what white noise of that size does to f: rms |M|_F.
double noise_of_solution(const StudyInput& input) {
  const InverseProblem& problem = input.problem.problem();
  const Reconstruction inverse = tikhonov(problem, input.alpha);
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
  StudyInput input{.problem = lab::SceneProblem(scene)};
  lab::SimulatedFrame simulated = lab::simulate(scene);
  input.truth = std::move(simulated.truth);
  input.readings = std::move(simulated.readings);
  double largest = 0.0;
  for (const double reading : input.readings) largest = std::max(largest, std::abs(reading));
  if (!(largest > 0.0))
    throw std::invalid_argument(
        "every reading is zero: without a contact there is no error to measure");
  const lab::SceneFrame frame(input.problem, input.readings);
  input.problem = frame.problem();
  input.alpha = frame.alpha().value;

  input.solution = tikhonov_solve(input.problem.problem(), input.alpha, input.readings);
  input.agreement = relative_l2_error(input.problem.family().solve(frame.analysed(), input.alpha),
                                      input.solution);
  input.solution_error =
      error_to_truth(input, input.solution).value_or(std::numeric_limits<double>::quiet_NaN());

  const std::optional<double> stated = input.problem.stated_noise();
  input.noise_stated = stated.has_value();
  input.noise_rms = stated.value_or(0.01 * largest);
  input.noise_floor = noise_of_solution(input) / l2_norm(input.solution);
  return input;
}

}  // namespace tactile_net::study
