#include "tactile_net/network/network_circuit.hpp"

#include <utility>

namespace tactile_net {

NetworkCircuit::NetworkCircuit(Realization realization,
                               std::shared_ptr<const NetworkProblem> problem,
                               const RealizationOptions& options)
    : realization_(realization),
      options_(options),
      problem_(std::move(problem)),
      circuit_(realize(realization, *problem_, options)) {}

NetworkCircuit::NetworkCircuit(Realization realization,
                               std::shared_ptr<const NetworkProblem> problem,
                               const RealizationOptions& options,
                               std::vector<NodeCapacitance> capacitances)
    : realization_(realization),
      options_(options),
      problem_(std::move(problem)),
      capacitances_(std::move(capacitances)),
      circuit_(realize(realization, *problem_, options)) {
  if (!capacitances_.empty())
    circuit_ = with_capacitances(FlatCircuit(circuit_).circuit(), capacitances_);
}

const FlatCircuit& NetworkCircuit::flat() const {
  return flat_.get([&] { return FlatCircuit(circuit_); });
}

const Reduction& NetworkCircuit::reduction() const {
  return reduction_.get([&] { return Reduction(flat()); });
}

const StateSpace& NetworkCircuit::state_space() const {
  return state_space_.get([&] { return tactile_net::state_space(flat()); });
}

const std::vector<std::complex<double>>& NetworkCircuit::poles() const {
  return poles_.get([&] { return tactile_net::poles(state_space()); });
}

const EigenvalueRange& NetworkCircuit::eigenvalues() const {
  return eigenvalues_.get([&] { return eigenvalue_range(problem_->matrix); });
}

}  // namespace tactile_net
