/// @file
/// What can run a deck.
///
///     Ngspice ngspice;                                       // ngspice.hpp
///     const OperatingPoint rest = operating_point(ngspice, circuit, "pad");
///     rest.voltages[0];                                      // [V], of the first output
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tactile_net/network/deck.hpp"
#include "tactile_net/simulator/raw_file.hpp"

namespace tactile_net {

/// The simulator failed. The text says how, and where the deck and the log were kept.
class SimulatorError : public std::runtime_error {
 public:
  enum class Cause {
    not_installed,
    timed_out,
    cancelled,
    too_much_output,
    crashed,
    diverged,  ///< a transient in which no time step is small enough: how ngspice says "unstable"
    failed,
    bad_result,
  };
  SimulatorError(Cause cause, const std::string& text, std::filesystem::path folder)
      : std::runtime_error(text), cause_(cause), folder_(std::move(folder)) {}
  [[nodiscard]] Cause cause() const noexcept { return cause_; }
  /// Holds deck.cir and ngspice.log, nothing else; empty if nothing was kept.
  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  /// Removes that folder: for who takes the failure for an answer and shows nobody the text.
  void discard() const noexcept {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }

 private:
  Cause cause_;
  std::filesystem::path folder_;
};

/// What one deck gave: the plot of its one analysis, every value finite.
struct Simulation {
  RawFile plot;
  double seconds = 0.0;  ///< wall time
};

class Simulator {
 public:
  virtual ~Simulator() = default;

  /// Runs a deck with one analysis card (`.op`, `.ac` or `.tran`).
  ///
  /// @throw SimulatorError      as its causes
  /// @throw std::runtime_error  no temporary folder can be made or written
  [[nodiscard]] virtual Simulation run(const std::string& deck) = 0;
};

struct OperatingPoint {
  std::vector<double> voltages{};  ///< [V], one per node asked for
  double seconds = 0.0;            ///< wall time of the simulator
};

/// Runs a deck with an `.op` card, or an `.ac` card of one frequency, and reads the voltages of
/// `nodes`, of complex ones the real parts.
///
/// @throw SimulatorError  as `Simulator::run`; bad_result if the plot is another one or a node is
///                        missing
[[nodiscard]] OperatingPoint operating_point(Simulator& simulator, const std::string& deck,
                                             std::span<const std::string> nodes);
/// Of a circuit's outputs. @param title  of its deck
/// @throw SimulatorError         as above
/// @throw std::invalid_argument  as `write_deck`
[[nodiscard]] OperatingPoint operating_point(Simulator& simulator, const Circuit& circuit,
                                             const std::string& title,
                                             const Analysis& analysis = DirectCurrent{});

}  // namespace tactile_net
