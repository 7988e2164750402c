/// @file
/// What a refinement knows of its circuit. Private.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "network/seen_matrix.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/refinement.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net {

/// One build as numbers see it, in units of P f = b.
struct SeenBuild {
  bool stable = false;
  Eigen::MatrixXd matrix;   // P^
  Eigen::MatrixXd inverse;  // of it
  Eigen::VectorXd answer;   // to the readings, without offsets

  /// `Refinement::answer`
  [[nodiscard]] std::vector<double> operator()(std::span<const double> sent) const {
    const Eigen::VectorXd d = sent.empty() ? answer : inverse * as_eigen(sent);
    return {d.begin(), d.end()};
  }
};

struct Refinement::Parts {
  Parts(const NetworkCircuit& of, ToleranceOptions among, const RefinementOptions& wanted);

  [[nodiscard]] SeenMatrix seen(std::span<const double> siemens) const;
  [[nodiscard]] SeenBuild built(std::span<const double> siemens) const;
  /// X of P^.
  [[nodiscard]] Eigen::MatrixXd deviation(const Eigen::MatrixXd& matrix) const {
    return inverse_root * (matrix - exact) * inverse_root;
  }
  [[nodiscard]] double energy(const Eigen::VectorXd& error) const { return (root * error).norm(); }

  const NetworkCircuit& circuit;
  const Reduction& reduction;
  ToleranceOptions tolerances;
  RefinementOptions options;
  std::vector<Reduction::Branch> branches;
  std::vector<double> printed;  // what is drawn about [S]
  std::vector<double> within;   // resistors' own errors; 0: none
  SeenSizes sizes;
  double lossy = 0.0;                         // 1 over the op-amps' gain
  Eigen::MatrixXd kernel, stabiliser, exact;  // K, R, P
  Eigen::VectorXd readings, direct;           // g, f*
  /// P^1/2 and its inverse, symmetric: of the singular values of K above a root of R.
  Eigen::MatrixXd root, inverse_root;
  double least = 0.0, largest = 0.0;  // eigenvalues of P
  double unit = 0.0;                  // siemens of P
  double volts = 0.0;                 // of f
  double range = 0.0;                 // of the converters [V]: the largest voltage of the answer
  OpAmpErrors opamps;
};

/// The largest singular value of a matrix, and the vectors: A right = value left.
struct LargestSingular {
  double value = 0.0;
  Eigen::VectorXd left, right;
};
[[nodiscard]] LargestSingular largest_singular(const Eigen::MatrixXd& a);

/// How a build goes, by its seed and number.
/// @param answers  as `Refinement::Answers`
[[nodiscard]] Refined refined(const Refinement::Parts& parts, const SeenBuild& build,
                              std::uint64_t trial, const Refinement::Answers& answers);

/// Where the error ends with residuals in single or double precision and exact converters.
[[nodiscard]] double single_floor(const Refinement::Parts& parts, const SeenBuild& build);
[[nodiscard]] double double_floor(const Refinement::Parts& parts, const SeenBuild& build);

}  // namespace tactile_net
