// How far an answer may be from the truth: a band for every traction, deviations for the force.
// Prints force and place of the contact with their deviations, and how many bands hold the truth.
#include <cmath>
#include <cstdio>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  const SensorArray array{
      .count = 41, .pitch = 0.5e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const std::vector<Contact> contacts = {
      RigidContact{.center = 1e-3, .half_width = 2e-3, .force = 2.0}};
  std::vector<double> readings = exact_readings(array, silicone, contacts);
  add_noise(readings, 2.0, /*seed*/ 1, /*channel*/ 0);

  const LinearProblem problem = make_problem(array, silicone, {.smoothing_length = 1.5e-3});
  const TikhonovFamily family(problem);
  const FilterFrame frame = family.analyse(readings);
  const double alpha = choose_alpha(frame, AlphaRule::rgcv).alpha;
  const std::vector<double> tractions = family.solve(frame, alpha);

  // What tractions to expect before any reading: the prior, whose size the rule gml estimates.
  const double prior = choose_alone(frame, AlphaRule::gml).alpha;
  const TractionCovariance covariance(family, alpha, prior);
  const NoiseEstimate noise =
      estimate_noise(problem, readings, tractions, covariance.degrees_of_freedom());
  const UncertainResultant contact = resultant_of(problem, tractions, covariance, noise.rms());

  const std::vector<double> truth = sample(contacts, array).normal;
  const std::vector<double> deviations = covariance.deviations();  // per unit of noise
  std::size_t within = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (std::abs(tractions[i] - truth[i]) <= 2.0 * noise.rms() * deviations[i]) ++within;

  std::printf("noise as the residual shows it: %.1f Pa (really 2.0 Pa)\n", noise.rms());
  std::printf("normal force %.3f +- %.3f N/m (really 2.000)\n", contact.normal.value,
              contact.normal.deviation);
  if (!contact.centre) return 1;  // nothing presses
  std::printf("centre %.3f +- %.3f mm (really 1.000)\n", 1e3 * contact.centre->value,
              1e3 * contact.centre->deviation);
  std::printf("%zu of 41 tractions lie within two deviations of the truth\n", within);
  const bool sound = std::abs(contact.normal.value - 2.0) < 4.0 * contact.normal.deviation;
  return sound && within >= 37 ? 0 : 1;
}
