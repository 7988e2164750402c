// A skin in a control loop: 16 x 16 taxels that read three stresses, a thousand frames a second,
// whose tractions neither pull nor drag more than any surface holds. Prints what was planned, how a
// finger's grip on it turns to a slip, how far frames are from their minimum, what they take. Given
// two files, it writes the plan and the frames for 12_c_skin_controller.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <tactile_net/controller.hpp>
#include <tactile_net/skin.hpp>
#include <vector>

using namespace tactile_net;

int main(int count_of_arguments, char** arguments) {
  const SkinArray skin{.rows = 16,
                       .columns = 16,
                       .pitch_y = 2e-3,
                       .pitch_z = 2e-3,
                       .depths = {4e-3},
                       .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.48};
  const LinearProblem problem = make_problem(skin, silicone);

  // Before the loop, everything that allocates, throws or takes long.
  // Margins are of a friction of 0.6; constraints allow what may come, 1, else no frame could slip.
  const PlannedEstimator planned =
      plan_estimator(problem, /*alpha*/ 1e-4,
                     {.accuracy = 1e-7,
                      .noise_rms = 10.0,
                      .friction_coefficient = 0.6,
                      .cone = ConeOptions{.constraints = {.friction_limit = 1.0}, .enough = 0.5}});
  std::printf("%s", planned.why().c_str());
  std::printf("%zu steps towards the constraints\n", planned.plan.cone->steps);
  ContactEstimator estimator(planned.plan);
  std::vector<double> tractions(estimator.tractions());
  ContactEstimate contact{.tractions = tractions};

  // A ball pressed on with 2 N is dragged harder and harder, at 30 degrees.
  std::vector<std::vector<double>> frames;
  for (const double friction : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const std::vector<SkinLoad> ball{
        SkinContact{.radius = 6e-3, .force = 2.0, .friction = friction, .direction = 0.5236}};
    frames.push_back(exact_readings(skin, silicone, ball));
  }

  if (count_of_arguments == 3) {
    const std::vector<std::byte> plan = encode_plan(planned.plan);
    std::ofstream(arguments[1], std::ios::binary)
        .write(reinterpret_cast<const char*>(plan.data()),
               static_cast<std::streamsize>(plan.size()));
    std::ofstream file(arguments[2], std::ios::binary);
    for (const std::vector<double>& frame : frames)
      file.write(reinterpret_cast<const char*>(frame.data()),
                 static_cast<std::streamsize>(frame.size() * sizeof(double)));
  }

  // In the loop: no allocation, no lock, no system call, no exception.
  double longest = 0.0;
  double all = 0.0;
  constexpr int count = 1000;
  for (int k = 0; k < count; ++k) {
    const auto start = std::chrono::steady_clock::now();
    const FrameStatus status =
        estimator.update(frames[static_cast<std::size_t>(k) * frames.size() / count], contact,
                         /*time*/ 1e-3 * k);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    longest = seconds > longest ? seconds : longest;
    all += seconds;
    if (status != FrameStatus::ok || !contact.contact) return 1;
    if (k % 200 == 100)
      std::printf(
          "%.1f s: %.2f N down, %.2f N along y, %.2f N along z, slip margin %.2f, unfinished %.2f "
          "deviations\n",
          contact.time, contact.normal_force, contact.tangential_y, contact.tangential_z,
          contact.slip_margin, contact.unfinished);
  }
  std::printf("a frame takes %.0f us of 1000, the longest took %.0f us\n", 1e6 * all / count,
              1e6 * longest);
  return contact.slip_margin < 0.0 ? 0 : 1;  // 0.8 is more than 0.6: it slips
}
