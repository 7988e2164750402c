#include <cstdio>
#include <tactile_net/inverse/line_problem.hpp>
#include <tactile_net/inverse/reconstruction.hpp>
#include <vector>

int main() {
  using namespace tactile_net;
  const SensorArray array{
      .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const Reconstruction inverse =
      tikhonov(make_problem(array, silicone, {.smoothing_length = 1.5e-3}), 1e-3);

  std::vector<double> stress(41, 0.0);  // one frame of the sensor [Pa]
  std::vector<double> pressure(41);
  stress[20] = 1000.0;
  if (inverse.solve(stress, pressure) != FrameStatus::ok) return 1;
  std::printf("pressure above the taxel: %.0f Pa\n", pressure[20]);
  return pressure[20] > 0.0 ? 0 : 1;
}
