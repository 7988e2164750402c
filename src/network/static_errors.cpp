#include "tactile_net/network/static_errors.hpp"

#include <algorithm>
#include <stdexcept>

#include "network/rest_equations.hpp"

namespace tactile_net {
namespace {

/// The same circuit, its op-amps changed.
FlatCircuit changed(const FlatCircuit& circuit, const auto& change) {
  Circuit copy = circuit.circuit();
  for (AmplifierModel& model : copy.amplifiers) change(model.opamp);
  return {copy};
}

/// Whether any of the op-amps has it.
bool any(const FlatCircuit& circuit, std::optional<double> OpAmp::*key) {
  const auto& models = circuit.circuit().amplifiers;
  return std::any_of(models.begin(), models.end(), [&](const AmplifierModel& model) {
    return (model.opamp.*key).value_or(0.0) != 0.0;
  });
}

/// @param by  the outputs by an error of each input, `each` amplifiers' after one another
InputErrors errors_of(const FlatCircuit& circuit, const Eigen::MatrixXd& by,
                      std::optional<double> OpAmp::*key, double size) {
  const auto amplifiers = static_cast<Eigen::Index>(circuit.amplifiers().size());
  const Eigen::Index inputs = by.cols() / amplifiers;
  Eigen::VectorXd value(by.cols());
  for (Eigen::Index k = 0; k < amplifiers; ++k) {
    const OpAmp& opamp = circuit.opamp(circuit.amplifiers()[static_cast<std::size_t>(k)]);
    value.segment(k * inputs, inputs).setConstant((opamp.*key).value_or(0.0));
  }
  const Eigen::VectorXd together = by * value;
  const Eigen::MatrixXd apart = by * value.asDiagonal();
  return {together.norm() / size, apart.norm() / size};
}

}  // namespace

StaticErrors static_errors(const FlatCircuit& circuit) {
  const FlatCircuit silent = changed(circuit, [](OpAmp& opamp) {
    opamp.offset.reset();
    opamp.bias_current.reset();
  });
  const RestEquations equations(silent);
  const Eigen::VectorXd answer = equations.outputs();
  const double size = answer.norm();
  if (!(size > 0.0)) throw std::domain_error("without an answer there is no relative error");
  StaticErrors errors;
  if (any(circuit, &OpAmp::offset))
    errors.offset = errors_of(circuit, equations.by_offset(), &OpAmp::offset, size);
  if (any(circuit, &OpAmp::bias_current))
    errors.bias_current =
        errors_of(circuit, equations.by_bias_current(), &OpAmp::bias_current, size);
  const auto without = [&](std::optional<double> OpAmp::*key) {
    if (!any(circuit, key)) return 0.0;
    const FlatCircuit other = changed(silent, [=](OpAmp& opamp) { (opamp.*key).reset(); });
    const Eigen::VectorXd exact = RestEquations(other).outputs();
    return (answer - exact).norm() / exact.norm();
  };
  errors.common_mode = without(&OpAmp::common_mode_rejection);
  errors.output_resistance = without(&OpAmp::output_resistance);
  return errors;
}

}  // namespace tactile_net
