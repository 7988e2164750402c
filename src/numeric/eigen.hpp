/// @file
/// The library's plain matrices seen as Eigen's. Private: Eigen stays out of public headers.
#pragma once

#include <Eigen/Core>
#include <span>

#include "numeric/products.hpp"
#include "tactile_net/numeric/matrix.hpp"

namespace tactile_net {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

[[nodiscard]] inline Eigen::Map<const RowMajor> as_eigen(const Matrix& matrix) noexcept {
  return {matrix.values.data(), static_cast<Eigen::Index>(matrix.rows),
          static_cast<Eigen::Index>(matrix.columns)};
}

[[nodiscard]] inline Eigen::Map<const Eigen::VectorXd> as_eigen(
    std::span<const double> values) noexcept {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

[[nodiscard]] inline std::span<double> as_span(Eigen::VectorXd& values) noexcept {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

[[nodiscard]] inline std::span<const double> as_span(const Eigen::VectorXd& values) noexcept {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

[[nodiscard]] constexpr Eigen::Index eigen_index(std::size_t index) noexcept {
  return static_cast<Eigen::Index>(index);
}

[[nodiscard]] inline Matrix from_eigen(const RowMajor& matrix) {
  return {static_cast<std::size_t>(matrix.rows()),
          static_cast<std::size_t>(matrix.cols()),
          {matrix.data(), matrix.data() + matrix.size()}};
}

}  // namespace tactile_net
