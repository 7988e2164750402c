/// @file
/// The linear equations of a circuit at rest, amplifiers of finite gain in them. Private.
#pragma once

#include <memory>

#include "numeric/eigen.hpp"
#include "tactile_net/network/flat_circuit.hpp"

namespace tactile_net {

/// One unknown a node but ground, and one behind every output resistance; as many equations:
/// Kirchhoff's law at a node, an amplifier's law at its output, over its gain.
class RestEquations {
 public:
  /// The circuit must outlive the object.
  /// @throw std::invalid_argument  the circuit has an inductor
  /// @throw std::domain_error      it has no unique operating point
  explicit RestEquations(const FlatCircuit& circuit);
  RestEquations(RestEquations&&) noexcept;
  ~RestEquations();

  /// The outputs' voltages, with what drives the circuit and its amplifiers' own errors.
  [[nodiscard]] Eigen::VectorXd outputs() const;

  /// The same of every node, ground's 0 V first.
  [[nodiscard]] Eigen::VectorXd voltages() const;

  /// d(outputs) / d(each amplifier's input voltage), a column an amplifier.
  [[nodiscard]] Eigen::MatrixXd by_offset() const;
  /// The same by a current that every amplifier's inputs take in, one each.
  [[nodiscard]] Eigen::MatrixXd by_bias_current() const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
