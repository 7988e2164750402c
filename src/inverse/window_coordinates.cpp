// Coordinates of the tractions in a window.
#include <cmath>
#include <numbers>

#include "inverse/axis_waves.hpp"
#include "inverse/load_tables.hpp"

namespace tactile_net {

using Eigen::Index;

WindowCoordinates::WindowCoordinates(const LinearProblem& problem, const WindowPlace& place,
                                     double depth) {
  const auto waves = [](Index count) {
    const auto n = static_cast<std::size_t>(count);
    return axis_waves(n, n, Boundary::zero_beyond);
  };
  y_ = waves(place.rows.count);
  z_ = waves(place.columns.count);
  const auto share = [depth](double spacing) { return std::pow(0.5 * depth / spacing, 2); };
  const auto rough = [](Index m, Index count) {
    return roughness(static_cast<std::size_t>(m), static_cast<std::size_t>(count),
                     Boundary::zero_beyond);
  };
  sizes_.resize(y_.cols() * z_.cols());
  for (Index m = 0; m < y_.cols(); ++m)
    for (Index n = 0; n < z_.cols(); ++n) {
      double stretch = 1.0 + share(problem.grid.spacing_y) * rough(m, y_.cols());
      if (!problem.is_line) stretch += share(problem.grid.spacing_z) * rough(n, z_.cols());
      sizes_(m * z_.cols() + n) = 1.0 / (std::sqrt(problem.measure) * stretch);
    }
}

Eigen::MatrixXd WindowCoordinates::tractions(const Eigen::Ref<const Eigen::MatrixXd>& c) const {
  Eigen::MatrixXd f = sizes_.asDiagonal() * c;
  for (Index i = 0; i < f.cols(); ++i) {
    Eigen::Map<RowMajor> cells(f.col(i).data(), y_.cols(), z_.cols());
    cells = (y_ * cells * z_.transpose()).eval();
  }
  return f;
}

Eigen::MatrixXd WindowCoordinates::sums(const Eigen::Ref<const Eigen::MatrixXd>& f) const {
  Eigen::MatrixXd c = f;
  for (Index i = 0; i < c.cols(); ++i) {
    Eigen::Map<RowMajor> cells(c.col(i).data(), y_.cols(), z_.cols());
    cells = (y_.transpose() * cells * z_).eval();
  }
  return sizes_.asDiagonal() * c;
}

void WindowCoordinates::part_exchanged(Eigen::Ref<Eigen::MatrixXd> c) const {
  const Index n = count();
  const auto pair = [&](Index a, Index b) {
    const Eigen::RowVectorXd one = c.row(a);
    c.row(a) = (one + c.row(b)) * std::numbers::sqrt2 / 2.0;
    c.row(b) = (one - c.row(b)) * std::numbers::sqrt2 / 2.0;
  };
  for (Index i = 0; i < y_.cols(); ++i)
    for (Index j = 0; j < z_.cols(); ++j) {
      const Index here = i * z_.cols() + j;
      const Index there = j * z_.cols() + i;
      if (i < j) pair(here, there);
      if (c.rows() > n) pair(n + here, 2 * n + there);
    }
}

Eigen::VectorXd WindowCoordinates::squares() const {
  Eigen::VectorXd all = sizes_.cwiseAbs2();
  Eigen::Map<RowMajor> cells(all.data(), y_.cols(), z_.cols());
  cells = (y_.cwiseAbs2() * cells * z_.cwiseAbs2().transpose()).eval();
  return all;
}

}  // namespace tactile_net
