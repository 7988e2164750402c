#include <utility>

#include "command_line/all_commands.hpp"

namespace tactile_net::tool {

void add_scene(Arguments& command, std::string& scene, const std::string& description,
               std::vector<std::string> endings) {
  command
      .add_option("SCENE", scene, file("SCENE", std::move(endings)),
                  description + "; - reads the scene from standard input")
      .required = true;
}

void add_simulator(Arguments& command, lab::SimulatorChoice& simulator) {
  command.add_option("--ngspice", simulator.ngspice.program, file("PROGRAM"),
                     "The simulator's program");
  command.add_option("--time-limit", simulator.time_limit, number(),
                     "Longest run of the simulator [s]");
}

void add_network(Arguments& command, NetworkOptions& network) {
  command.add_choice("--realization", network.realization, realizations,
                     "How to build the circuit (default: as the scene says)");
  command.add_option(
      "--bandwidth", network.bandwidth, number(),
      "Gain-bandwidth product of the op-amps [Hz]; the settling time is then computed too");
}

void add_columns(Arguments& command, std::string& columns) {
  command.add_option(
      "--columns", columns, text("LIST"),
      "Columns that hold the readings, in their order: numbers from 1, ranges or names, such as "
      "2-42, or t=1,4-44 with the times in column 1 (default: found by the names in the header)");
}

void add_json(Arguments& command, std::string& json, const std::string& description) {
  command.add_option("--json", json, output_file({"json"}), description + " (- = standard output)");
}

void add_folder(Arguments& command, std::string& folder_name, bool& force,
                const std::string& description) {
  command.add_option("--out", folder_name, folder(), description);
  command.add_flag("--force", force, "Let --out replace files that tactile-net did not write");
}

void add_results(Arguments& command, ResultOptions& results, const std::string& folder_text,
                 const std::string& json_text) {
  add_folder(command, results.folder, results.force, folder_text);
  add_json(command, results.json, json_text);
}

}  // namespace tactile_net::tool
