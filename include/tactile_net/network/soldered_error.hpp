/// @file
/// What the parts of one circuit do to its answer under several loads, resistors and op-amps: to
/// first order, exactly, and by draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/resistor_errors.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

/// The sources of a load.
using Load = std::vector<CurrentSource>;

/// Relative changes of resistors' conductances.
struct ResistorChange {
  std::size_t resistor = 0;
  double relative = 0.0;
};

/// The op-amps that a network is built with.
struct BuiltOpAmps {
  OpAmpErrors errors{};  ///< under the network's loads; of none: ideal ones
  double balance = 0.0;  ///< as `ToleranceOptions::balance`; 0: outputs are exact opposites
  bool tare = false;     ///< as `ToleranceOptions::tare`
};

/// A network's nominal answers under several loads, and what leads to them. Errors are relative to
/// each answer's 2-norm; of several loads they are root mean squares.
class LoadedNetwork {
 public:
  /// The reduction must outlive the object.
  ///
  /// @throw std::invalid_argument  there is no load
  /// @throw std::domain_error      the network has no unique answer, or it is 0 under a load
  LoadedNetwork(const Reduction& reduction, std::span<const Load> loads, BuiltOpAmps opamps = {});
  LoadedNetwork(LoadedNetwork&&) noexcept;
  ~LoadedNetwork();

  /// For every resistor the square of the error per relative change of the resistor, to first
  /// order: of one load `relative_sensitivities`, of several their mean.
  [[nodiscard]] std::vector<double> sensitivities() const;

  /// For each set of changes the square of the error that they make together, to first order.
  [[nodiscard]] std::vector<double> squared_errors(
      std::span<const std::vector<ResistorChange>> changes) const;

  /// Of the network with other conductances [S]; infinite where they leave no answer.
  [[nodiscard]] double error(std::span<const double> siemens) const;

  /// What the op-amps do by themselves.
  [[nodiscard]] OpAmpShares opamp_shares() const;

  /// What offsets and bias currents of builds make of the answer without a load, drawn as in
  /// `builds`, subtracted or not; empty: the op-amps have none.
  ///
  /// @param of_resistors  of the same builds, whose temperature counts
  [[nodiscard]] std::vector<double> offsets(const ResistorErrors& of_resistors, std::size_t count,
                                            std::uint64_t seed) const;

  /// Errors of builds, ascending: each resistor off what is printed on it as `tactile_net::drawn`
  /// does it, and the op-amps as `OpAmpErrors` says; infinite: unstable.
  ///
  /// @param printed  [S], as `Reduction::siemens()`
  /// @param of_resistors  as many
  [[nodiscard]] std::vector<double> builds(std::span<const double> printed,
                                           const ResistorErrors& of_resistors, std::size_t count,
                                           std::uint64_t seed) const;

 private:
  struct Solved;
  std::unique_ptr<const Solved> solved_;
};

}  // namespace tactile_net
