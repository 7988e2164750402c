// What is proven of a circuit before it is built: that it settles, how fast, what errors it bears.
// Prints stability, theorem, settling time and margin of three realisations of one problem.
#include <cstdio>
#include <string>
#include <tactile_net/circuit.hpp>
#include <tactile_net/line.hpp>
#include <vector>

using namespace tactile_net;

int main() {
  const SensorArray array{
      .count = 11, .pitch = 1e-3, .depths = {1.5e-3}, .reads = {Quantity::stress_x}};
  const Material silicone{.youngs_modulus = 0.2e6, .poisson_ratio = 0.45};
  const LinearProblem problem = make_problem(array, silicone, {.smoothing_length = 1.5e-3});
  const std::vector<double> readings = {0, 0, 0, 20, 120, 300, 120, 20, 0, 0, 0};  // [Pa]
  const NetworkProblem network = network_problem(problem, 1e-2, readings);

  const RealizationOptions options{.scale = {.siemens = 1e-3, .volts = 1e-3},
                                   .opamp = {.bandwidth = 10e6}};
  bool sound = true;
  for (const Realization one :
       {Realization::nic, Realization::crossbar, Realization::least_squares}) {
    const Certificate certificate = certify(one, network, options, /*accuracy*/ 1e-3);
    const double settling =
        certificate.dynamics ? certificate.dynamics->settling_seconds.value_or(-1.0) : -1.0;
    std::printf("%-13s %s by theorem %s; within 0.1 %% after %.1f us; bears parts within %.2g %%\n",
                std::string(name(one)).c_str(), std::string(name(certificate.stability)).c_str(),
                std::string(certificate.theorem.name).c_str(), 1e6 * settling,
                100.0 * certificate.tolerance_margin.value_or(0.0));
    sound = sound && certificate.stability == Stability::stable && settling > 0.0;
  }
  return sound ? 0 : 1;
}
