#include "tactile_net/network/static_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "network/nodal_equations.hpp"

namespace tactile_net {
namespace {

/// What counts at rest, and no input errors: where two circuits have that alike, their equations
/// are the same to the last bit, and so are their answers.
OpAmp without_input_errors(const OpAmp& opamp) {
  if (opamp.is_nullor()) return {};
  return {.gain = opamp.dc_gain(),
          .common_mode_rejection = opamp.common_mode_rejection,
          .output_resistance = opamp.output_resistance};
}

/// Whether any of the op-amps has it.
bool any(const FlatCircuit& circuit, std::optional<double> OpAmp::*key) {
  const auto& models = circuit.circuit().amplifiers;
  return std::any_of(models.begin(), models.end(), [&](const AmplifierModel& model) {
    return (model.opamp.*key).value_or(0.0) != 0.0;
  });
}

/// What errors of the inputs make of the outputs, a column an error.
/// @param by   the outputs by an error of each input, `each` amplifiers' after one another
/// @param key  what their size is
Eigen::MatrixXd input_errors(const FlatCircuit& circuit, const Eigen::MatrixXd& by,
                             std::optional<double> OpAmp::*key) {
  const auto amplifiers = static_cast<Eigen::Index>(circuit.amplifiers().size());
  const Eigen::Index inputs = by.cols() / amplifiers;
  Eigen::VectorXd value(by.cols());
  for (Eigen::Index k = 0; k < amplifiers; ++k) {
    const OpAmp& opamp = circuit.opamp(circuit.amplifiers()[static_cast<std::size_t>(k)]);
    value.segment(k * inputs, inputs).setConstant((opamp.*key).value_or(0.0));
  }
  return by * value.asDiagonal();
}

/// As `input_errors`, of one standard deviation each.
Matrix drawn_errors(const FlatCircuit& circuit, const Eigen::MatrixXd& by,
                    std::optional<double> OpAmp::*key, std::optional<double> OpAmp::*limit,
                    std::vector<InputSpread>& spreads) {
  const auto columns = static_cast<std::size_t>(by.cols());
  const std::size_t inputs = columns / circuit.amplifiers().size();
  Eigen::VectorXd deviation(by.cols());
  for (std::size_t k = 0; k < columns; ++k) {
    const OpAmp& opamp = circuit.opamp(circuit.amplifiers()[k / inputs]);
    spreads.push_back(input_spread((opamp.*key).value_or(0.0), opamp.*limit));
    deviation(static_cast<Eigen::Index>(k)) = spreads.back().deviation;
  }
  return from_eigen(by * deviation.asDiagonal());
}

InputErrors together_and_apart(const Eigen::MatrixXd& errors, double size) {
  return {errors.rowwise().sum().norm() / size, errors.norm() / size};
}

std::vector<double> difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd off = a - b;
  return {off.begin(), off.end()};
}

double norm_of(std::span<const double> values) {
  return values.empty() ? 0.0 : as_eigen(values).norm();
}

double norm_of(const Matrix& matrix) { return norm_of(std::span<const double>(matrix.values)); }

}  // namespace

StaticErrors static_errors(const FlatCircuit& circuit) {
  const NodalEquations equations(circuit, without_input_errors);
  const Eigen::VectorXd answer = equations.outputs();
  const double size = answer.norm();
  if (!(size > 0.0)) throw std::domain_error("without an answer there is no relative error");
  StaticErrors errors;
  if (any(circuit, &OpAmp::offset))
    errors.offset =
        together_and_apart(input_errors(circuit, equations.by_offset(), &OpAmp::offset), size);
  if (any(circuit, &OpAmp::bias_current))
    errors.bias_current = together_and_apart(
        input_errors(circuit, equations.by_bias_current(), &OpAmp::bias_current), size);
  const auto without = [&](std::optional<double> OpAmp::*key) {
    if (!any(circuit, key)) return 0.0;
    const NodalEquations other(circuit, [key](const OpAmp& opamp) {
      OpAmp changed = without_input_errors(opamp);
      (changed.*key).reset();
      return changed;
    });
    const Eigen::VectorXd exact = other.outputs();
    return (answer - exact).norm() / exact.norm();
  };
  errors.common_mode = without(&OpAmp::common_mode_rejection);
  errors.output_resistance = without(&OpAmp::output_resistance);
  return errors;
}

OpAmpErrors opamp_errors(const FlatCircuit& circuit,
                         std::span<const std::vector<CurrentSource>> loads) {
  OpAmpErrors errors;
  errors.shifts.resize(loads.size());
  const auto& models = circuit.circuit().amplifiers;
  if (circuit.amplifiers().empty() ||
      std::all_of(models.begin(), models.end(),
                  [](const AmplifierModel& model) { return model.opamp.is_nullor(); }))
    return errors;
  const NodalEquations own(circuit, without_input_errors);
  if (any(circuit, &OpAmp::offset))
    errors.offset = drawn_errors(circuit, own.by_offset(), &OpAmp::offset, &OpAmp::offset_limit,
                                 errors.offset_spread);
  if (any(circuit, &OpAmp::bias_current))
    errors.bias_current = drawn_errors(circuit, own.by_bias_current(), &OpAmp::bias_current,
                                       &OpAmp::bias_limit, errors.bias_spread);
  if (any(circuit, &OpAmp::offset_drift))
    errors.offset_drift = from_eigen(input_errors(circuit, own.by_offset(), &OpAmp::offset_drift));
  // From ideal op-amps on, one property after the other: what each adds adds up to all of it.
  const NodalEquations ideal(circuit, [](const OpAmp&) { return OpAmp{}; });
  const NodalEquations of_gain(circuit, [](const OpAmp& opamp) {
    OpAmp changed = without_input_errors(opamp);
    changed.common_mode_rejection.reset();
    changed.output_resistance.reset();
    return changed;
  });
  const NodalEquations of_inputs(circuit, [](const OpAmp& opamp) {
    OpAmp changed = without_input_errors(opamp);
    changed.output_resistance.reset();
    return changed;
  });
  for (std::size_t load = 0; load < loads.size(); ++load) {
    const Eigen::VectorXd by_gain = of_gain.outputs(loads[load]);
    const Eigen::VectorXd by_inputs = of_inputs.outputs(loads[load]);
    OpAmpErrors::Shift& shift = errors.shifts[load];
    shift.gain = difference(by_gain, ideal.outputs(loads[load]));
    shift.common_mode = difference(by_inputs, by_gain);
    shift.output_resistance = difference(own.outputs(loads[load]), by_inputs);
  }
  return errors;
}

InputSpread input_spread(double typical, const std::optional<double>& limit) noexcept {
  const double size = std::abs(typical);
  const double within = limit.value_or(std::numeric_limits<double>::infinity()) / size;
  if (!std::isfinite(within)) return {.deviation = size};
  if (within <= 1.0) return {.deviation = *limit / std::sqrt(3.0), .within = within};
  // Of a normal error of variance 1 that is cut off there.
  const double lost = 2.0 * within * std::exp(-0.5 * within * within) /
                      (std::sqrt(2.0 * std::numbers::pi) * std::erf(within / std::numbers::sqrt2));
  return {.deviation = size * std::sqrt(1.0 - lost), .within = within};
}

OpAmpErrors without_rest(OpAmpErrors errors) {
  errors.offset = {};
  errors.bias_current = {};
  errors.offset_spread.clear();
  errors.bias_spread.clear();
  return errors;
}

std::vector<double> total_shift(const OpAmpErrors& errors, std::size_t load, std::size_t outputs) {
  std::vector<double> total(outputs);
  if (load >= errors.shifts.size()) return total;
  const OpAmpErrors::Shift& shift = errors.shifts[load];
  for (const std::vector<double>* one : {&shift.gain, &shift.common_mode, &shift.output_resistance})
    for (std::size_t i = 0; i < one->size(); ++i) total[i] += (*one)[i];
  return total;
}

OpAmpShares shares(const OpAmpErrors& errors, std::size_t load, double size) {
  OpAmpShares result{.offset = norm_of(errors.offset) / size,
                     .bias_current = norm_of(errors.bias_current) / size};
  double shifted = 0.0;
  if (load < errors.shifts.size()) {
    const OpAmpErrors::Shift& shift = errors.shifts[load];
    result.gain = norm_of(shift.gain) / size;
    result.common_mode = norm_of(shift.common_mode) / size;
    result.output_resistance = norm_of(shift.output_resistance) / size;
    shifted = norm_of(total_shift(errors, load, shift.gain.size())) / size;
  }
  result.total = std::hypot(result.offset, result.bias_current, shifted);
  return result;
}

}  // namespace tactile_net
