/// @file
/// The linear equations of a circuit at rest, amplifiers of finite gain in them. Private.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "numeric/eigen.hpp"
#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {

/// One unknown a node but ground, and one behind every output resistance; as many equations:
/// Kirchhoff's law at a node, an amplifier's law at its output, over its gain.
class RestEquations {
 public:
  /// Of other op-amps than the circuit's own; empty: its own.
  using Changed = std::function<OpAmp(OpAmp)>;

  /// The circuit must outlive the object.
  /// @throw std::invalid_argument  the circuit has an inductor
  /// @throw std::domain_error      it has no unique operating point
  explicit RestEquations(const FlatCircuit& circuit, const Changed& changed = {});
  RestEquations(RestEquations&&) noexcept;
  ~RestEquations();

  /// The outputs' voltages, with what drives the circuit and its amplifiers' own errors.
  [[nodiscard]] Eigen::VectorXd outputs() const;
  /// The same with other sources in place of the circuit's own.
  [[nodiscard]] Eigen::VectorXd outputs(std::span<const CurrentSource> sources) const;

  /// The same of every node, ground's 0 V first.
  [[nodiscard]] Eigen::VectorXd voltages() const;

  /// d(outputs) / d(each amplifier's input voltage), a column an amplifier.
  [[nodiscard]] Eigen::MatrixXd by_offset() const;
  /// The same by a current that every amplifier's inputs take in, one each.
  [[nodiscard]] Eigen::MatrixXd by_bias_current() const;

 private:
  [[nodiscard]] Eigen::VectorXd voltages(std::span<const CurrentSource> sources) const;

  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
