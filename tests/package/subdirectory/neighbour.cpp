#include <cmath>
#include <tactile_net/inverse/problem.hpp>
#include <tactile_net/inverse/reconstruction.hpp>
#include <vector>

// A uniform pressure reads as itself in the middle of the pad, and is found there.
int main() {
  using namespace tactile_net;
  const SensorArray array{
      .count = 41, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x}};
  const InverseProblem problem =
      make_problem(array, Material{.youngs_modulus = 1.0, .poisson_ratio = 0.45});
  const std::vector<double> tractions = tikhonov_solve(problem, 1e-6, std::vector<double>(41, 1.0));
  return std::abs(tractions[20] - 1.0) < 0.05 ? 0 : 1;
}
