/// @file
/// What every command takes, in words and with the places where it goes: a function each.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line/arguments.hpp"
#include "options.hpp"

namespace tactile_net::tool {

struct AllCommands {
  CommandLine line{};
  std::optional<Command> command{};
  bool quiet = false;

  AllCommands();
  AllCommands(const AllCommands&) = delete;
  AllCommands& operator=(const AllCommands&) = delete;

  template <class Options>
  std::pair<Arguments, Options&> add(CommandTable table) {
    const auto options = std::make_shared<Options>();
    table.chosen = [this, options] { command = *options; };
    line.commands.push_back(std::move(table));
    return {Arguments(line.commands.back()), *options};
  }
};

// What several commands take alike.
void add_scene(Arguments& command, std::string& scene,
               const std::string& description = "Scene file (TOML)",
               std::vector<std::string> endings = {"toml"});
void add_simulator(Arguments& command, lab::SimulatorChoice& simulator);
void add_network(Arguments& command, NetworkOptions& network);
void add_columns(Arguments& command, std::string& columns);
void add_json(Arguments& command, std::string& json, const std::string& description);
void add_folder(Arguments& command, std::string& folder_name, bool& force,
                const std::string& description);
void add_results(Arguments& command, ResultOptions& results, const std::string& folder_text,
                 const std::string& json_text);

// The commands.
void add_run(AllCommands& all);
void add_gen(AllCommands& all);
void add_relax(AllCommands& all);
void add_certify(AllCommands& all);
void add_bench(AllCommands& all);
void add_simulate(AllCommands& all);
void add_solve(AllCommands& all);
void add_report(AllCommands& all);
void add_identify(AllCommands& all);
void add_plan(AllCommands& all);
void add_tradeoff(AllCommands& all);
void add_grasp(AllCommands& all);
void add_sweep(AllCommands& all);
void add_merge(AllCommands& all);
void add_init(AllCommands& all);
void add_check(AllCommands& all);
void add_calibrate(AllCommands& all);
void add_schema(AllCommands& all);
void add_completion(AllCommands& all);
void add_help(AllCommands& all);

}  // namespace tactile_net::tool
