// A build is refined through ngspice, a deck a cycle, as it is in numbers.
#include "tactile_net/network/refinement.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>

#include "tactile_net/network/network_circuit.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

/// The error after each cycle: answers by ngspice, which knows every resistor and nothing of P^,
/// rounded to 12 bits of the largest on the way in and out.
std::vector<double> refined_in_ngspice(const NetworkCircuit& network, const ArrayNetwork& array,
                                       const Circuit& build, std::size_t cycles) {
  const auto p = view(array.problem.matrix);
  const Eigen::VectorXd b = view(array.problem.right_side);
  const Eigen::VectorXd exact = view(array.direct);
  const double volts = network.options().scale.volts;
  const auto rounded = [](const Eigen::VectorXd& values) {
    const double step = std::ldexp(values.cwiseAbs().maxCoeff(), -11);
    return Eigen::VectorXd((values / step).array().round() * step);
  };
  const auto answer = [&](const Circuit& circuit) {
    const std::vector<double> v = at_rest(circuit);
    return Eigen::VectorXd(view(v) / volts);
  };
  // Amperes at the inputs for a unit of b: the exact circuit's, by its answer to the first.
  const auto driven = [&](Circuit circuit, const Eigen::VectorXd& r) {
    for (CurrentSource& one : circuit.sources) one.ampere = 0.0;
    const FlatCircuit flat(circuit);
    for (std::size_t j = 0; j < flat.amplifiers().size(); ++j) {
      const FlatCircuit::Amplifier& x = flat.amplifiers()[j];
      const double ampere = r(static_cast<Eigen::Index>(j));
      const std::string name = "Ir" + std::to_string(j);
      // Out of one input and into the other; the lattice's differential mode.
      circuit.sources.push_back({name + 'p', x.plus, ampere});
      circuit.sources.push_back({name + 'n', x.minus, -ampere});
    }
    return circuit;
  };
  const Eigen::VectorXd direct = answer(driven(network.circuit(), b));
  const double ampere = exact.squaredNorm() / direct.dot(exact);

  Eigen::VectorXd f = rounded(answer(build));
  std::vector<double> errors = {(f - exact).norm() / exact.norm()};
  while (errors.size() < cycles) {
    const Eigen::VectorXd r = b - p * f;
    // As large as makes the largest voltage 1 V, so that a simulator's tolerances do not count.
    const double range = (f - exact).cwiseAbs().maxCoeff() * volts;
    const Eigen::VectorXd sent = rounded(r) * (ampere / range);
    const Eigen::VectorXd d = range * rounded(answer(driven(build, sent)));
    f += r.dot(d) / d.dot(p * d) * d;
    errors.push_back((f - exact).norm() / exact.norm());
  }
  return errors;
}

}  // namespace

TEST_CASE("a lattice's build is refined in ngspice as it is in numbers", "[refinement][spice]") {
  for (const double alpha : {1e-3, 1e-5}) {
    const ArrayNetwork array = array_network(21, alpha);
    double largest = 0.0;
    for (const double f : array.direct) largest = std::max(largest, std::abs(f));
    const NetworkCircuit network(Realization::lattice,
                                 std::make_shared<const NetworkProblem>(array.problem),
                                 {.scale = {.volts = 1.0 / largest}, .opamp = {.gain = 1e6}});
    const ToleranceOptions tolerances{.relative = 0.01, .seed = 5};
    // Without the half step that a code may be off its place, so half as large as converters.
    const Refinement refinement(
        network, tolerances,
        {.converters = Converters{.bits = 12, .gain = 0.0, .noise = 0.0}, .cycles = 4});
    for (const bool conspire : {false, true}) {
      CAPTURE(alpha, conspire);
      const std::vector<double> siemens =
          conspire ? refinement.adverse_siemens() : drawn(network.reduction(), tolerances, 0);
      const Refined numbers = refinement.build(siemens);
      const std::vector<double> errors =
          refined_in_ngspice(network, array, perturbed(network.flat(), siemens), 4);
      for (std::size_t k = 0; k < errors.size(); ++k) {
        CAPTURE(k, errors[k], numbers.errors[k]);
        CHECK(errors[k] < 3.0 * numbers.errors[k]);
        CHECK(errors[k] > numbers.errors[k] / 3.0);
      }
    }
  }
}
