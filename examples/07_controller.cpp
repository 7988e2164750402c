// In a control loop: a plan is made once, slowly; an estimator takes each frame in microseconds.
// Prints what was planned and why, and what one frame says of the contact and its friction. Given
// the name of a file, it writes the plan there, for a controller that has no planner
// (11_c_controller.c).
#include <cstdio>
#include <fstream>
#include <tactile_net/controller.hpp>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main(int count, char** arguments) {
  const SensorArray array{.count = 41,
                          .pitch = 0.5e-3,
                          .depths = {1.5e-3},
                          .reads = {Quantity::stress_x, Quantity::shear_xy}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const LinearProblem problem =
      make_problem(array, silicone, {.unknowns = 2, .smoothing_length = 1.5e-3});

  // Before the loop, everything that allocates, throws or takes long.
  const PlannedEstimator planned =
      plan_estimator(problem, /*alpha*/ 1e-3, {.accuracy = 1e-7, .friction_coefficient = 0.5});
  std::printf("%s", planned.why().c_str());
  if (count > 1) {
    const std::vector<std::byte> bytes = encode_plan(planned.plan);
    std::ofstream file(arguments[1], std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    if (!file.flush()) return 2;
  }
  ContactEstimator estimator(planned.plan);
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate contact{.tractions = tractions};

  // In the loop: no allocation, no lock, no system call, no exception.
  const std::vector<Contact> dragged = {
      RigidContact{.half_width = 2e-3, .force = 2.0, .friction = 0.3}};
  const std::vector<double> readings = exact_readings(array, silicone, dragged);
  const FrameStatus status = estimator.update(readings, contact, /*time*/ 0.001);

  if (status != FrameStatus::ok || !contact.contact) return 1;
  std::printf("normal force %.2f N/m, tangential %.2f N/m, %.2f N/m left before it slips\n",
              contact.normal_force, contact.tangential_force, contact.friction_margin);
  return contact.friction_margin > 0.0 && contact.outlier == -1 ? 0 : 1;
}
