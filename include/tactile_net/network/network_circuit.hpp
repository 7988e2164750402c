/// @file
/// The circuit of a network problem, and what is derived from it.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "tactile_net/network/copper_capacitance.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/network/reduction.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/once.hpp"

namespace tactile_net {

/// Everything is made on first use and once, so that a certificate, a tolerance study and a
/// simulation of the same circuit share it. Used from one thread at a time.
class NetworkCircuit {
 public:
  /// @throw std::invalid_argument  as `realize`
  NetworkCircuit(Realization realization, std::shared_ptr<const NetworkProblem> problem,
                 const RealizationOptions& options);

  /// With capacitances of its nodes, each one's own: a board's. Its sub-circuits are opened, since
  /// nodes inside of them are a board's nets too.
  ///
  /// @throw std::invalid_argument  as `realize` and `with_capacitances`
  NetworkCircuit(Realization realization, std::shared_ptr<const NetworkProblem> problem,
                 const RealizationOptions& options, std::vector<NodeCapacitance> capacitances);

  [[nodiscard]] Realization realization() const noexcept { return realization_; }
  /// Beside those of the options; empty: none.
  [[nodiscard]] const std::vector<NodeCapacitance>& capacitances() const noexcept {
    return capacitances_;
  }
  [[nodiscard]] const RealizationOptions& options() const noexcept { return options_; }
  [[nodiscard]] const NetworkProblem& problem() const noexcept { return *problem_; }
  [[nodiscard]] const std::shared_ptr<const NetworkProblem>& shared_problem() const noexcept {
    return problem_;
  }
  [[nodiscard]] const Circuit& circuit() const noexcept { return circuit_; }

  [[nodiscard]] const FlatCircuit& flat() const;
  /// @throw std::invalid_argument  the realisation is not linear, as `Reduction`
  [[nodiscard]] const Reduction& reduction() const;
  /// @throw std::invalid_argument, std::domain_error  as `tactile_net::state_space`
  [[nodiscard]] const StateSpace& state_space() const;
  /// Of the state space, the one of largest real part first.
  /// @throw std::invalid_argument, std::domain_error  as `tactile_net::state_space`
  [[nodiscard]] const std::vector<std::complex<double>>& poles() const;
  /// Of P.
  [[nodiscard]] const EigenvalueRange& eigenvalues() const;

 private:
  Realization realization_;
  RealizationOptions options_;
  std::shared_ptr<const NetworkProblem> problem_;
  std::vector<NodeCapacitance> capacitances_;
  Circuit circuit_;
  Once<FlatCircuit> flat_;
  Once<Reduction> reduction_;
  Once<StateSpace> state_space_;
  Once<std::vector<std::complex<double>>> poles_;
  Once<EigenvalueRange> eigenvalues_;
};

}  // namespace tactile_net
