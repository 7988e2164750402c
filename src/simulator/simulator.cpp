#include "tactile_net/simulator/simulator.hpp"

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

}  // namespace tactile_net
