#include "tactile_net/study/input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "study/points.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/numeric/comparison.hpp"

namespace tactile_net::study {
namespace {

/// The root mean square of what white noise of that size does to f: rms |M|_F.
double noise_of_solution(const StudyInput& input, const Reconstruction& inverse,
                         std::span<const double> weights) {
  double squares = 0.0;
  for (std::size_t i = 0; i < inverse.readings(); ++i) {
    if (weights[i] == 0.0) continue;
    const double weight = input.noise_stated ? weights[i] : 1.0;
    const double size = l2_norm(inverse.transposed().row(i)) / weight;
    squares += size * size;
  }
  return input.noise_rms * std::sqrt(squares);
}

/// @throw std::invalid_argument  every reading is zero
double largest_of(std::span<const double> readings) {
  double largest = 0.0;
  for (const double reading : readings) largest = std::max(largest, std::abs(reading));
  if (!(largest > 0.0))
    throw std::invalid_argument(
        "every reading is zero: without a contact there is no error to measure");
  return largest;
}

/// What is known of a reading's noise.
void take_noise(StudyInput& input, std::optional<double> stated, double largest) {
  input.noise_stated = stated.has_value();
  input.noise_rms = stated.value_or(0.01 * largest);
}

/// Component by component.
void take_truth(StudyInput& input, std::span<const double> truth, std::size_t places) {
  for (std::size_t first = 0; first < truth.size(); first += places) {
    const auto one = truth.subspan(first, places);
    input.truth.emplace_back(one.begin(), one.end());
  }
}

StudyInput input_of(const Scene& scene) {
  StudyInput input{.problem = lab::SceneProblem(scene)};
  lab::SimulatedFrame simulated = lab::simulate(scene);
  take_truth(input, simulated.truth, input.line().surface().count);
  input.readings = std::move(simulated.readings);
  const double largest = largest_of(input.readings);
  const lab::SceneFrame frame(input.line(), input.readings);
  input.problem = frame.problem();
  const lab::SceneProblem& problem = input.line();
  input.alpha = frame.alpha().value;
  input.solution = tikhonov_solve(problem.problem(), input.alpha, input.readings);
  input.agreement =
      relative_l2_error(problem.family().solve(frame.analysed(), input.alpha), input.solution);
  take_noise(input, problem.stated_noise(), largest);
  input.noise_floor = noise_of_solution(input, tikhonov(problem.problem(), input.alpha),
                                        problem.problem().weights) /
                      l2_norm(input.solution);
  return input;
}

StudyInput input_of(const SkinScene& scene) {
  StudyInput input{.problem = lab::SkinSceneProblem(scene)};
  lab::SimulatedFrame simulated = lab::simulate(scene);
  input.readings = std::move(simulated.readings);
  const double largest = largest_of(input.readings);
  if (input.skin().estimates_weight())
    input.problem = input.skin().weighed(input.skin().likeliest_weight(input.readings));
  const lab::SkinSceneProblem& problem = input.skin();
  take_truth(input, simulated.truth, problem.grid().count());
  input.alpha = problem.alpha(input.readings).value;
  input.solution = tikhonov_solve(problem.problem(), input.alpha, input.readings);
  const TikhonovFamily& family = problem.family();
  input.agreement =
      relative_l2_error(family.solve(family.analyse(input.readings), input.alpha), input.solution);
  take_noise(input, problem.stated_noise(), largest);
  input.noise_floor =
      noise_of_solution(input, family.reconstruction(input.alpha), problem.problem().weights) /
      l2_norm(input.solution);
  return input;
}

}  // namespace

StudyInput study_input(const AnyScene& scene) {
  StudyInput input = std::visit([](const auto& one) { return input_of(one); }, scene);
  input.solution_error =
      error_to_truth(input, input.solution).value_or(std::numeric_limits<double>::quiet_NaN());
  return input;
}

}  // namespace tactile_net::study
