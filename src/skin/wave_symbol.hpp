/// @file
/// One wave of tractions and what a skin reads of it. Private.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

inline constexpr double hidden_below = 1e-10;  ///< of the largest singular value of a wave

/// The kernels' transforms, a row for each quantity and depth.
class WaveSymbol {
 public:
  WaveSymbol(const SkinArray& skin, const Material& material, const SkinProblemOptions& options);

  /// Rows x components. @param at_nyquist_y  the lattice's: odd kernels vanish there
  [[nodiscard]] Eigen::MatrixXcd operator()(double k_y, double k_z, bool at_nyquist_y = false,
                                            bool at_nyquist_z = false) const;

  [[nodiscard]] Eigen::Index components() const noexcept { return components_; }

 private:
  struct Row {
    Quantity quantity;
    double depth;
    double weight;
  };
  const Material& material_;
  Eigen::Index components_;
  std::vector<Row> rows_{};
};

/// With as many singular values as columns, the missing ones 0.
[[nodiscard]] ComplexSvd full_decomposition(const Eigen::MatrixXcd& matrix);

/// Values above `hidden_below` of the largest, the first.
[[nodiscard]] Eigen::Index rank_of(const Eigen::VectorXd& values);

/// From (p, q_y, q_z) to (p, q_L, q_T).
[[nodiscard]] Eigen::MatrixXcd along_wave(const Eigen::MatrixXcd& matrix, double angle);

/// Of a lattice without ends of as many taxels: the waves' numbers along one axis.
struct LatticeLine {
  std::size_t count;
  double length;  // [m]

  [[nodiscard]] double wavenumber(std::size_t i) const {
    const auto turns = static_cast<double>(i) - (2 * i > count ? static_cast<double>(count) : 0.0);
    return count > 1 ? 2.0 * std::numbers::pi * turns / length : 0.0;
  }
  [[nodiscard]] bool is_nyquist(std::size_t i) const { return count > 1 && 2 * i == count; }
  [[nodiscard]] std::size_t mirrored(std::size_t i) const { return i == 0 ? 0 : count - i; }
};

/// Of the skin's rows, or of its columns.
[[nodiscard]] LatticeLine lattice_line(const SkinArray& skin, bool along_z);

}  // namespace tactile_net
