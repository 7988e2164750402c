#include "tactile_net/simulator/simulator.hpp"

#include <sstream>

namespace tactile_net {

OperatingPoint operating_point(Simulator& simulator, const std::string& deck,
                               std::span<const std::string> nodes) {
  const Simulation simulation = simulator.run(deck);
  const RawFile& plot = simulation.plot;
  const auto refuse = [](const std::string& text) {
    throw SimulatorError(SimulatorError::Cause::bad_result, text, {});
  };
  if ((plot.plot != "Operating Point" && plot.plot != "AC Analysis") || plot.points != 1)
    refuse("the simulator gave " + std::to_string(plot.points) + " points of '" + plot.plot +
           "', not one operating point or frequency");
  OperatingPoint point{.voltages = {}, .seconds = simulation.seconds};
  try {
    for (const std::string& node : nodes)
      point.voltages.push_back(plot.vector("v(" + node + ")").front());
  } catch (const std::out_of_range& error) {
    refuse(std::string("the simulator's answer lacks a node: ") + error.what());
  }
  return point;
}

OperatingPoint operating_point(Simulator& simulator, const Circuit& circuit,
                               const std::string& title, const Analysis& analysis) {
  std::ostringstream deck;
  write_deck(deck, circuit, {.title = title}, Answer::raw_file, analysis);
  return operating_point(simulator, deck.str(), output_names(circuit));
}

}  // namespace tactile_net
