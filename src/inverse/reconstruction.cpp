#include "tactile_net/inverse/reconstruction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"

namespace tactile_net {

Reconstruction::Reconstruction(const Matrix& matrix, double condition) : condition_(condition) {
  if (matrix.values.empty() || matrix.values.size() != matrix.rows * matrix.columns)
    throw std::invalid_argument(
        "a reconstruction matrix needs rows x columns values, at least one");
  check_finite(matrix);
  transposed_ = from_eigen(as_eigen(matrix).transpose());
  const double most = as_eigen(matrix).cwiseAbs().rowwise().sum().maxCoeff();
  constexpr double largest = std::numeric_limits<double>::max();
  safe_ = 0.5 * largest / std::max(most, 1.0);  // the half is for rounding
}

double Reconstruction::traction(std::span<const double> g, std::size_t row) const noexcept {
  double sum = 0.0;
  for (std::size_t j = 0; j < g.size(); ++j) sum += g[j] * transposed_(j, row);
  return sum;
}

FrameStatus Reconstruction::solve(std::span<const double> g, std::span<double> f) const noexcept {
  if (g.size() != readings() || f.size() != tractions()) return FrameStatus::wrong_size;
  if (!all_within(g, safe_)) {
    if (!all_finite(g)) return FrameStatus::not_finite;
    for (std::size_t i = 0; i < f.size(); ++i)
      if (!std::isfinite(traction(g, i))) return FrameStatus::too_large;
  }

  // Column by column of M: every f_i is summed in the order of the readings, and the inner loop
  // runs over neighbours in memory, which compilers vectorise without reordering a sum.
  std::fill(f.begin(), f.end(), 0.0);
  const double* column = transposed_.values.data();
  for (const double reading : g) {
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += reading * column[i];
    column += f.size();
  }
  return FrameStatus::ok;
}

}  // namespace tactile_net
