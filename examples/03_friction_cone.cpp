// What contact allows: nothing pulls, and friction is at most its limit times the pressure.
// Prints how far the tractions are outside that cone, without constraints and with them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

// How far the tractions, normal before tangential, are outside the cone |f_t| <= limit f_v [Pa].
double outside(std::span<const double> tractions, double limit) {
  const std::size_t count = tractions.size() / 2;
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    most = std::max(most, std::abs(tractions[count + i]) - limit * tractions[i]);
  return most;
}

int main() {
  // Two quantities tell a normal traction from a tangential one.
  const SensorArray array{.count = 41,
                          .pitch = 0.5e-3,
                          .depths = {1.5e-3},
                          .reads = {Quantity::stress_x, Quantity::shear_xy}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const std::vector<Contact> dragged = {
      RigidContact{.half_width = 2e-3, .force = 2.0, .friction = 0.3}};
  const std::vector<double> readings = exact_readings(array, silicone, dragged);

  const LinearProblem problem =
      make_problem(array, silicone, {.unknowns = 2, .smoothing_length = 1.5e-3});
  const double alpha = 1e-3, limit = 0.5;
  const std::vector<double> free = tikhonov_solve(problem, alpha, readings);
  const ConstrainedTikhonov method(problem, alpha, {.friction_limit = limit});
  const ConstrainedSolution held = method.solve(readings);

  std::printf("outside the cone of friction %.1f: %.1f Pa without constraints, %.1f Pa with them\n",
              limit, outside(free, limit), outside(held.tractions, limit));
  std::printf("conditions of the optimum hold to %.0e, after %zu factorisations\n",
              held.kkt_residual, held.iterations);
  const bool sound = held.status == FrameStatus::ok && held.verdict == ConstrainedVerdict::ok &&
                     held.kkt_residual < 1e-9 && outside(held.tractions, limit) < 1e-6 &&
                     outside(free, limit) > 1.0;
  return sound ? 0 : 1;
}
