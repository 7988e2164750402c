#include <tactile_net/control/fft_convolution.hpp>
#include <tactile_net/control/planner.hpp>
#include <tactile_net/inverse/line_problem.hpp>
#include <tactile_net/inverse/thesis/dft.hpp>
#include <tactile_net/realtime/contact_estimator.hpp>
#include <tactile_net/scene/reader.hpp>

int main() {
  using namespace tactile_net;
  const Scene scene = parse_scene(
      "[sensor]\ncount = 41\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1\npoisson_ratio = 0.45\n"
      "[reconstruct]\nmethods = [\"dft\"]\n"
      "",
      "scene.toml");
  const LinearProblem problem = make_problem(scene.sensor, scene.material);
  const EstimatorPlan plan = plan_estimator(problem, 1e-4, {.structure = Structure::fft}).plan;
  ContactEstimator estimator(plan, fft_convolutions());
  std::vector<double> readings(41, 1.0), tractions(41);
  ContactEstimate estimate;
  estimate.tractions = tractions;
  if (estimator.update(readings, estimate) != FrameStatus::ok || !estimate.contact) return 2;
  return DftInverse(scene.sensor, scene.material).verdict() == DftVerdict::ok ? 0 : 1;
}
