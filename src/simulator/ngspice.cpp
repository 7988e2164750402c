#include "tactile_net/simulator/ngspice.hpp"

#include <string>
#include <utility>
#include <vector>

#include "simulator/ngspice_log.hpp"
#include "simulator/private_folder.hpp"
#include "tactile_net/simulator/child_process.hpp"

namespace tactile_net {

Ngspice::Ngspice(NgspiceOptions options) : options_(std::move(options)) {}

Simulation Ngspice::run(const std::string& deck) {
  const PrivateFolder folder;
  write_file(folder.path() / "deck.cir", deck);
  // -n: no .spiceinit of the user's. HOME: ngspice 39 crashes where there is none, as services and
  // containers have it.
  std::vector<std::string> command = {options_.program, "-n", "-b"};
  if (options_.pspice) command.insert(command.end(), {"-D", "ngbehavior=psa"});
  command.insert(command.end(), {"-r", "result.raw", "deck.cir"});
  const ProcessResult process =
      run_process(command, {.folder = folder.path(),
                            .unset = {hidden_from_ngspice.begin(), hidden_from_ngspice.end()},
                            .defaults = {"HOME=" + folder.path().string()},
                            .time_limit = options_.time_limit,
                            .output_limit = options_.output_limit,
                            .confined = true,
                            .cancelled = options_.cancelled});
  if (process.end == ProcessResult::End::not_found)
    throw SimulatorError(SimulatorError::Cause::not_installed,
                         "the simulator '" + options_.program +
                             "' is not installed or not in PATH: apt install ngspice",
                         {});
  if (process.end == ProcessResult::End::cancelled)
    throw SimulatorError(SimulatorError::Cause::cancelled, "ngspice was stopped on request", {});
  return accept_log(folder, process, {options_.time_limit, options_.output_limit, options_.pspice});
}

}  // namespace tactile_net
