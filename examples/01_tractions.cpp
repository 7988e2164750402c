// From what buried sensors read to what presses on the surface: the problem, a method, one frame.
// Prints the pressure under the indenter and the force in all, beside what really pressed.
#include <cmath>
#include <cstdio>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  // 41 taxels, 0.5 mm apart, read the stress across the surface, 1.5 mm below it.
  const SensorArray array{
      .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};

  // Once: the matrix from tractions to readings, and Tikhonov's method made ready for frames.
  const LinearProblem problem = make_problem(array, silicone, {.smoothing_length = 1.5e-3});
  const double alpha = 1e-3;  // how much smoothness counts beside the readings
  const Reconstruction method = tikhonov(problem, alpha);

  // One frame: a cylinder, pressed on with 2 N for every metre of its length.
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2e-3, .force = 2.0}};
  const std::vector<double> readings = exact_readings(array, silicone, contacts);
  std::vector<double> tractions(method.tractions());
  if (method.solve(readings, tractions) != FrameStatus::ok) return 1;

  const Resultant found = resultant_of(tractions, {}, array.pitch);
  std::printf("pressure under the cylinder: %.0f Pa (really %.0f Pa)\n", tractions[20],
              traction(contacts[0], Traction::normal, 0.0));
  std::printf("normal force: %.2f N/m (really 2.00 N/m)\n", found.normal);
  return std::abs(found.normal - 2.0) < 0.1 ? 0 : 1;
}
