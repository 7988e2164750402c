// How much to smooth: a rule chooses alpha from the readings alone, with a verdict on its choice.
// Prints what every rule chooses, and the error of the tractions with the alpha of robust GCV.
#include <cstdio>
#include <string>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  const SensorArray array{
      .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2e-3, .force = 2.0}};
  std::vector<double> readings = exact_readings(array, silicone, contacts);
  const double noise = 2.0;  // [Pa], of readings that reach some 400 Pa
  add_noise(readings, noise, /*seed*/ 1, /*channel*/ 0);

  // One decomposition serves every alpha and every frame.
  const LinearProblem problem = make_problem(array, silicone, {.smoothing_length = 1.5e-3});
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(readings);

  for (const AlphaSweep::Curve& curve : sweep_alpha(frame, noise).curves)
    std::printf("%-12s alpha %.1e  %s\n", std::string(name(curve.rule)).c_str(), curve.choice.alpha,
                std::string(name(curve.choice.verdict)).c_str());

  // Robust GCV needs not know the noise. Any verdict but ok: look before you trust the answer.
  const AlphaChoice chosen = choose_alpha(frame, AlphaRule::rgcv);
  const std::vector<double> tractions = family.solve(frame, chosen.alpha);
  const double error = l2_difference(tractions, sample(contacts, array).normal);
  std::printf("with the alpha of rgcv the tractions are off by %.0f %%, verdict %s\n", 100 * error,
              std::string(name(chosen.verdict)).c_str());
  return chosen.verdict == AlphaVerdict::ok && error < 0.2 ? 0 : 1;
}
