// A build is refined through ngspice, a deck a cycle, as it is in numbers.
#include "tactile_net/network/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

namespace {

constexpr ToleranceOptions tolerances{.relative = 0.01, .seed = 5};

/// Its largest voltage is 1 V.
NetworkCircuit circuit_of(Realization realization, double alpha, const OpAmp& opamp) {
  const ArrayNetwork array = array_network(21, alpha);
  double largest = 0.0;
  for (const double f : array.direct) largest = std::max(largest, std::abs(f));
  return {realization,
          std::make_shared<const NetworkProblem>(array.problem),
          {.scale = {.volts = 1.0 / largest}, .opamp = opamp}};
}

/// What ngspice says of the build, which knows every resistor and nothing of P^.
Refinement::Answers asked_of_ngspice(const NetworkCircuit& network, const Refinement& refinement,
                                     std::span<const double> siemens, double& furthest) {
  return [&network, &refinement, siemens, &furthest](std::span<const double> sent) {
    const std::vector<double> said = refinement.answer(siemens, sent);
    double most = 0.0;
    for (const double d : said) most = std::max(most, std::abs(d));
    // As large as makes the largest voltage 1 V, so that a simulator's tolerances do not count.
    const double volts = network.options().scale.volts;
    const double size = sent.empty() ? 1.0 : 1.0 / (most * volts);
    std::vector<double> seen = at_rest(refinement.circuit(siemens, sent, size));
    for (double& one : seen) one /= volts * size;
    furthest = std::max(furthest, l2_difference(seen, said));
    return seen;
  };
}

}  // namespace

TEST_CASE("a build is refined in ngspice as it is in numbers", "[refinement][spice]") {
  const std::pair<Realization, double> all[] = {{Realization::lattice, 1e-3},
                                                {Realization::lattice, 1e-5},
                                                {Realization::least_squares, 1e-3},
                                                {Realization::crossbar, 1e-3}};
  for (const OpAmp& opamp : {OpAmp{}, OpAmp{.gain = 1e5}})
    for (const auto& [realization, alpha] : all) {
      const NetworkCircuit network = circuit_of(realization, alpha, opamp);
      const Refinement refinement(network, tolerances, {.cycles = 4});
      for (const bool conspire : {false, true}) {
        CAPTURE(name(realization), alpha, conspire, opamp.is_nullor());
        const std::vector<double> siemens =
            conspire ? refinement.adverse_siemens() : drawn(network.reduction(), tolerances, 0);
        const Refined numbers = refinement.build(siemens);
        REQUIRE(numbers.stable);
        double furthest = 0.0;
        const Refined seen =
            refinement.build(siemens, 0, asked_of_ngspice(network, refinement, siemens, furthest));
        CHECK(furthest < 1e-9);
        for (std::size_t k = 0; k < seen.errors.size(); ++k) {
          CAPTURE(k, seen.errors[k], numbers.errors[k]);
          CHECK(seen.errors[k] < 3.0 * numbers.errors[k]);
          CHECK(seen.errors[k] > numbers.errors[k] / 3.0);
        }
      }
    }
}

TEST_CASE("another build in ngspice is told from the one in numbers", "[refinement][spice]") {
  const NetworkCircuit network = circuit_of(Realization::lattice, 1e-3, {});
  const Refinement refinement(network, tolerances, {.cycles = 3});
  const std::vector<double> one = drawn(network.reduction(), tolerances, 0);
  const std::vector<double> other = drawn(network.reduction(), tolerances, 1);
  double furthest = 0.0;
  const auto answers = asked_of_ngspice(network, refinement, one, furthest);
  (void)answers({});
  CHECK(furthest < 1e-9);
  CHECK(l2_difference(at_rest(refinement.circuit(other)), at_rest(refinement.circuit(one))) > 1e-3);
  const std::vector<double> few(3, 1.0);
  CHECK_THROWS_AS(refinement.circuit(one, few), std::invalid_argument);
  CHECK_THROWS_AS(refinement.answer(one, few), std::invalid_argument);
}
