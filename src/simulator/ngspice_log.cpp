#include "simulator/ngspice_log.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <sstream>
#include <string>

#include "tactile_net/simulator/raw_file.hpp"

namespace tactile_net {
namespace {

using Cause = SimulatorError::Cause;
using End = ProcessResult::End;

/// The first few complaints, indented; empty if there is none.
std::string complaints(const std::string& log, bool macromodel) {
  constexpr int most = 4;
  std::istringstream lines(log);
  std::string text;
  int found = 0;
  for (std::string line; std::getline(lines, line) && found < most;)
    if (is_complaint(line, macromodel)) {
      text += "\n  ngspice: " + line.substr(0, 200);
      ++found;
    }
  return text;
}

/// Keeps deck and log, nothing else, and throws.
[[noreturn]] void fail(const PrivateFolder& folder, Cause cause, const std::string& what,
                       const std::string& log, bool macromodel) {
  write_file(folder.path() / "ngspice.log", log);
  const std::filesystem::path kept = folder.keep({"deck.cir", "ngspice.log"});
  throw SimulatorError(cause,
                       what + complaints(log, macromodel) + "\n  deck and log: " +
                           (kept / "deck.cir").string() + ", ngspice.log beside it",
                       kept);
}

/// How a failure that ngspice reported itself is called. Its operating point may end for want of a
/// small enough step too, by trying a transient at last: that is no instability.
Cause cause_of(const std::string& log) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (line.find("TRAN:") != std::string::npos &&
        line.find("imestep too small") != std::string::npos)
      return Cause::diverged;
  return Cause::failed;
}

/// Of the table in which a transient begins: a node's name, and its voltage.
bool is_row_of_start(std::string_view line) {
  std::istringstream words{std::string(line)};
  std::string node;
  double volts = 0.0;
  std::string more;
  return static_cast<bool>(words >> node >> volts) && !(words >> more);
}

void check_finite(const RawFile& plot) {
  for (const auto* parts : {&plot.values, &plot.imaginary})
    for (std::size_t i = 0; i < parts->size(); ++i)
      for (const double value : (*parts)[i])
        if (!std::isfinite(value))
          throw std::runtime_error(plot.names[i] + " is not a finite number");
}

}  // namespace

bool is_complaint(std::string_view line, bool macromodel) {
  if (line.substr(0, 8) == "Circuit:") return false;  // the deck's own title
  std::string lower(line);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  // A step back of a search that says in the end whether it failed.
  if (lower.find("further gmin increment") != std::string::npos) return false;
  if (macromodel) {
    // What a search for an operating point says on its way: if it fails in the end, ngspice says
    // so by other lines.
    constexpr std::array steps = {"gmin stepping failed", "source stepping failed",
                                  "singular matrix:  check node"};
    if (std::any_of(steps.begin(), steps.end(),
                    [&](const char* step) { return lower.find(step) != std::string::npos; }))
      return false;
    if (is_row_of_start(line)) return false;
  }
  for (const char* word :
       {"error", "warning", "singular", "aborted", "fatal", "timestep too small"})
    if (lower.find(word) != std::string::npos) return true;
  return false;
}

Simulation accept_log(const PrivateFolder& folder, const ProcessResult& process,
                      const RunLimits& limits) {
  const auto& [time_limit, output_limit, macromodel] = limits;
  const std::string log = process.errors + process.output;
  if (process.end == End::timed_out)
    fail(folder, Cause::timed_out,
         "ngspice did not end within " +
             std::to_string(static_cast<double>(time_limit.count()) / 1e3) +
             " s and was stopped; raise the time limit",
         log, macromodel);
  if (process.end == End::too_much_output)
    fail(folder, Cause::too_much_output,
         "ngspice printed more than " + std::to_string(output_limit) + " bytes and was stopped",
         log, macromodel);
  if (process.end == End::signalled)
    fail(folder, Cause::crashed,
         "ngspice crashed: " + std::string(process.code == 0
                                               ? "by which signal is not known, since this process "
                                                 "ignores SIGCHLD or collects all its children"
                                               : ::strsignal(process.code)),
         log, macromodel);
  if (process.code != 0)
    fail(folder, cause_of(log), "ngspice failed with exit status " + std::to_string(process.code),
         log, macromodel);
  if (!complaints(log, macromodel).empty())
    fail(folder, cause_of(log), "ngspice found the circuit at fault, though it reported success",
         log, macromodel);
  try {
    Simulation simulation{.plot = read_raw_file(folder.path() / "result.raw"),
                          .seconds = process.seconds};
    check_finite(simulation.plot);
    return simulation;
  } catch (const std::exception& error) {
    fail(folder, Cause::bad_result,
         std::string("ngspice reported success without a usable answer: ") + error.what(), log,
         macromodel);
  }
}

}  // namespace tactile_net
