/// @file
/// A dense matrix of doubles, row-major: plain data between the rooms of the library.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tactile_net {

struct Matrix {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values{};  ///< rows x columns, row-major

  [[nodiscard]] double operator()(std::size_t row, std::size_t column) const noexcept {
    return values[row * columns + column];
  }
  [[nodiscard]] double& operator()(std::size_t row, std::size_t column) noexcept {
    return values[row * columns + column];
  }
  [[nodiscard]] std::span<const double> row(std::size_t index) const noexcept {
    return {values.data() + index * columns, columns};
  }
};

}  // namespace tactile_net
