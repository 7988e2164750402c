#include "solver.hpp"

#include <stdexcept>

#include "tactile_net/scene/diagnostic.hpp"
#include "text.hpp"

namespace tactile_net::tool {
namespace {

Solver with_dft(const Scene& scene) {
  DftInverse inverse(scene.sensor, scene.material, scene.reconstruct.noise_gain_limit);
  const NoiseGain gain = inverse.noise_gain();
  const DftVerdict verdict = inverse.verdict();
  Solver solver{.inverse = std::move(inverse),
                .alpha = {},
                .verdict = std::string(name(verdict)),
                .condition = gain.largest};
  if (verdict != DftVerdict::ok)
    solver.warnings.push_back("errors of the readings reach the traction multiplied by up to " +
                              brief(gain.largest));
  if (gain.sign_changes > 0)
    solver.warnings.push_back("the kernel's DFT changes sign at " +
                              std::to_string(gain.sign_changes) +
                              " frequencies: what lies between is not measured");
  if (!scene.dead_taxels.empty())
    solver.warnings.emplace_back("dft takes a dead taxel's zero for a reading");
  return solver;
}

Solver with_matrix(const Scene& scene, Method method) {
  const double alpha = alpha_of(scene);
  const InverseProblem problem = problem_of(scene);
  Reconstruction inverse =
      method == Method::closed_form ? closed_form(problem, alpha) : tikhonov(problem, alpha);
  const double condition = inverse.condition();
  return {.inverse = std::move(inverse), .alpha = alpha, .verdict = "ok", .condition = condition};
}

}  // namespace

InverseProblem problem_of(const Scene& scene) {
  ProblemOptions options{.smoothing_length = scene.reconstruct.smoothing_length,
                         .channel_rms = {},
                         .dead_taxels = scene.dead_taxels};
  if (scene.noise && scene.noise->weights_rows)
    for (const Channel& channel : channels(scene.sensor))
      options.channel_rms.push_back(scene.noise->rms.at(channel.quantity));
  return make_problem(scene.sensor, scene.material, options);
}

double alpha_of(const Scene& scene) {
  if (scene.reconstruct.alpha) return *scene.reconstruct.alpha;
  throw InputError({{.file = scene.file,
                     .message = "reconstruct.alpha is missing, and tikhonov, closed_form and the "
                                "network need it",
                     .hint = "add `alpha = 1e-4` under [reconstruct]; it has the unit of the "
                             "squared kernel, so strain readings want it scaled by 1/E^2"}});
}

Status Solver::solve(std::span<const double> readings, std::span<double> tractions) noexcept {
  return std::visit([&](auto& ready) { return ready.solve(readings, tractions); }, inverse);
}

Solver make_solver(const Scene& scene, Method method) {
  switch (method) {
    case Method::dft:
      return with_dft(scene);
    case Method::tikhonov:
    case Method::closed_form:
      return with_matrix(scene, method);
    case Method::network:
      break;
  }
  throw std::invalid_argument("the network is relaxed by ngspice, not solved frame by frame");
}

}  // namespace tactile_net::tool
