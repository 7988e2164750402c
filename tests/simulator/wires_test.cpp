// Arrays of wires in ngspice, every crossing two nodes.

#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tactile_net/simulator/step_response.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/network/wired.hpp"
#include "tests/simulator/at_rest.hpp"

using namespace tactile_net;

TEST_CASE("wires err in ngspice as in the study of tolerances", "[spice][programmed]") {
  const NetworkProblem problem = array_network(9, 1e-3).problem;
  struct Form {
    Realization realization;
    bool ladder = false;
  };
  for (const Form& one : {Form{Realization::least_squares}, Form{Realization::crossbar},
                          Form{Realization::least_squares, true}, Form{Realization::lattice}}) {
    CAPTURE(name(one.realization), one.ladder);
    const Circuit circuit = realize(one.realization, problem, {.ladder = one.ladder});
    const double seen = relative_l2_error(at_rest(with_wires(circuit, 5.0)), at_rest(circuit));
    CHECK_THAT(tolerate(Reduction(circuit), {.wire_resistance = 5.0}).median,
               WithinRel(seen, 0.02));
    CHECK(seen > 1e-3);
  }
}
