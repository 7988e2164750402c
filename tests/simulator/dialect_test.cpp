// Decks for other simulators say the same circuit: ngspice reads those of LTspice.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tactile_net/network/dialect_deck.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/simulator/child_process.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"
#include "tests/simulator/own_folder.hpp"

using namespace tactile_net;

TEST_CASE("a deck for LTspice has the same answer, a lossless one too", "[spice][dialect]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one : realizations) {
    CAPTURE(name(one));
    const Circuit circuit = realize(one, network.problem);
    const Analysis analysis =
        one == Realization::lc ? Analysis(SingleFrequency{1e4}) : Analysis(DirectCurrent{});
    std::ostringstream deck;
    write_deck(deck, circuit, {.title = "t"}, Answer::raw_file, analysis,
               {.dialect = Dialect::ltspice});
    Ngspice ngspice;
    const OperatingPoint point = operating_point(ngspice, deck.str(), output_names(circuit));
    CHECK(l2_difference(point.voltages, network.direct) < (one == Realization::ndr ? 1e-3 : 1e-8));
  }
}

TEST_CASE("plain ngspice prints the answer, whatever simulator it is set to follow",
          "[spice][dialect]") {
  const ArrayNetwork network = array_network(5, 1e-3);
  const OwnFolder own;
  for (const Realization one : {Realization::ideal, Realization::crossbar, Realization::lc}) {
    const Circuit circuit = realize(one, network.problem);
    const Analysis analysis =
        one == Realization::lc ? Analysis(SingleFrequency{1e4}) : Analysis(DirectCurrent{});
    std::ofstream file(own / "x.cir");
    write_deck(file, circuit, {.title = "t"}, Answer::printed, analysis);
    file.close();
    for (const std::string behaviour : {"none", "ps", "psa", "ltpsa", "hsa", "all"}) {
      CAPTURE(name(one), behaviour);
      const ProcessResult seen =
          run_process({"ngspice", "-n", "-D", "ngbehavior=" + behaviour, "-b", "x.cir"},
                      {.folder = own / "", .defaults = {"HOME=/"}});
      CHECK(seen.code == 0);
      std::vector<double> voltages;
      for (const std::string& node : output_names(circuit)) {
        const std::size_t at = seen.output.find("v(" + node + ")");
        const std::size_t sign = seen.output.find(" = ", at);
        REQUIRE(sign != std::string::npos);
        voltages.push_back(std::stod(seen.output.substr(sign + 3)));
      }
      CHECK(l2_difference(voltages, network.direct) < 1e-8);
    }
  }
}

TEST_CASE("a sub-circuit that readings' currents flow into has the circuit's answer",
          "[spice][dialect]") {
  const ArrayNetwork network = array_network(9, 1e-3);
  for (const Realization one : {Realization::ideal, Realization::nic, Realization::crossbar,
                                Realization::least_squares, Realization::lattice}) {
    CAPTURE(name(one));
    RealizationOptions options;
    options.opamp.gain = 1e9;
    const Circuit circuit = realize(one, network.problem, options);
    std::ostringstream deck;
    deck << "* a user's deck\n";
    write_subcircuit(deck, circuit, {.title = "t"}, "pad");
    // The user's nodes have names of their own.
    deck << "X1";
    for (const Node pin : ports(circuit)) deck << " my" << pin;
    deck << " pad\n";
    for (const CurrentSource& i : circuit.sources)
      deck << i.name << " 0 my" << i.into << ' ' << shortest(i.ampere) << '\n';
    deck << ".op\n.end\n";
    std::vector<std::string> names;
    for (const Node node : circuit.outputs) names.push_back("my" + std::to_string(node));
    Ngspice ngspice;
    CHECK(l2_difference(operating_point(ngspice, deck.str(), names).voltages, network.direct) <
          1e-6);
  }
}
