/// @file
/// Arrays that are programmed instead of soldered, and arrays whose lines have resistance: what
/// `ToleranceOptions::bits`, `cell_noise` and `wire_resistance` make of conductances. Private.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/tolerance.hpp"

namespace tactile_net {

/// Whether cells are programmed, so that tolerances of parts are not theirs.
[[nodiscard]] inline bool programs_cells(const ToleranceOptions& options) noexcept {
  return options.bits || options.cell_noise;
}

/// Whether anything of this file is asked for.
[[nodiscard]] inline bool is_of_arrays(const ToleranceOptions& options) noexcept {
  return programs_cells(options) || options.wire_resistance;
}

/// @throw std::invalid_argument  an option is out of range
void check_arrays(const ToleranceOptions& options);

/// Each value a resistor of `Reduction::resistors()`.
class ProgrammedArrays {
 public:
  /// @throw std::invalid_argument  something is asked for, and the circuit's resistors are no such
  ///                               arrays
  ProgrammedArrays(const Reduction& reduction, const ToleranceOptions& options);

  /// Whether a resistor is a cell that is programmed.
  [[nodiscard]] bool is_programmed(std::size_t resistor) const { return programmed_[resistor]; }

  /// What can be programmed of them: whole steps.
  void round(std::vector<double>& siemens) const;

  /// One trial's noise of the cells.
  void disturb(std::vector<double>& siemens, std::size_t trial) const;

  /// Adds the variance of the noise, relative to each cell, to the others'.
  void add_variances(std::span<const double> siemens, std::span<double> variances) const;

  /// What the lines leave of each cell, seen from their ends. To first order in the cells' own
  /// errors: it is the rounded cells' share.
  void through_lines(std::vector<double>& siemens) const;

  /// What lines add where an array's ends are not all at outputs and summing nodes: the
  /// conductances between ends that no cell joins, of the rounded cells. Between the circuit's
  /// nodes; empty where there is none.
  [[nodiscard]] const std::vector<Resistor>& paths() const noexcept { return paths_; }

 private:
  struct Cell {
    std::size_t resistor = 0;
    double largest = 0.0;  // of its array [S]
    double share = 1.0;    // that the ends of the lines see
  };
  void find_shares(const Reduction& reduction, std::span<Cell> cells);
  /// The same where ends are at nodes that nothing drives, and what else the lines add.
  void find_paths(const Reduction& reduction, Array array, std::span<Cell> cells);

  ToleranceOptions options_;
  std::vector<Cell> cells_;
  std::vector<bool> programmed_;
  std::vector<Resistor> paths_;
};

}  // namespace tactile_net
