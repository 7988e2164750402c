#include "inverse/coordinates.hpp"

#include <utility>

#include "inverse/axis_waves.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "inverse/window_sums.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// left X right', component by component, of every column, in its place: columns may be as many
/// numbers as memory holds once.
/// @pre  left and right are square
Eigen::MatrixXd along_both(Eigen::MatrixXd columns, const Eigen::MatrixXd& left,
                           const Eigen::MatrixXd& right) {
  const Index cells = left.cols() * right.cols();
  if (right.size() == 1) {  // a line's: all of its columns by one product
    for (Index start = 0; start < columns.rows(); start += cells)
      columns.middleRows(start, cells) =
          (left * columns.middleRows(start, cells)).eval() * right(0, 0);
    return columns;
  }
  for (Index j = 0; j < columns.cols(); ++j)
    for (Index start = 0; start < columns.rows(); start += cells) {
      Eigen::Map<RowMajor> x(columns.col(j).data() + start, left.rows(), right.rows());
      x = left * x * right.transpose();
    }
  return columns;
}

/// Waves of one component: every one of these along y with every one of those along z.
struct ComponentWaves {
  std::vector<Index> y{}, z{};
  Index component = 0;
};

/// Parts coordinates into components.
/// @param columns  waves along z; `cells` waves in all
std::vector<ComponentWaves> by_component(std::span<const Index> coordinates, Index cells,
                                         Index columns) {
  std::vector<ComponentWaves> all;
  for (const Index at : coordinates) {
    const Index component = at / cells;
    const Index y = at % cells / columns;
    if (all.empty() || all.back().component != component) all.push_back({.component = component});
    ComponentWaves& waves = all.back();
    if (waves.y.empty() || waves.y.back() != y) waves.y.push_back(y);
    if (waves.y.size() == 1) waves.z.push_back(at % columns);
  }
  return all;
}

}  // namespace

Eigen::VectorXd stabiliser_spectrum(const LinearProblem& problem) {
  return stabiliser_spectrum(problem, problem.tangential_weight);
}

Eigen::VectorXd stabiliser_spectrum(const LinearProblem& problem, double tangential_weight) {
  const SurfaceGrid& grid = problem.grid;
  const double y = problem.smoothing_length / grid.spacing_y;
  const double z = problem.smoothing_length / grid.spacing_z;
  Eigen::VectorXd spectrum(static_cast<Index>(problem.components * grid.count()));
  Index at = 0;
  for (std::size_t u = 0; u < problem.components; ++u) {
    const double weight = stabiliser_weight(u, tangential_weight);
    for (std::size_t m = 0; m < grid.rows; ++m)
      for (std::size_t n = 0; n < grid.columns; ++n)
        spectrum(at++) = problem.measure * weight * weight *
                         (1.0 + y * y * roughness(m, grid.rows, grid.boundary_y) +
                          z * z * roughness(n, grid.columns, grid.boundary_z));
  }
  return spectrum;
}

WaveCoordinates::WaveCoordinates(const LinearProblem& problem, Eigen::VectorXd stretch)
    : y_(axis_waves(problem.grid.rows, problem.grid.rows, problem.grid.boundary_y)),
      z_(axis_waves(problem.grid.columns, problem.grid.columns, problem.grid.boundary_z)),
      stretch_(std::move(stretch)) {}

Eigen::MatrixXd WaveCoordinates::tractions(const Eigen::MatrixXd& coordinates) const {
  return along_both(stretch_.cwiseInverse().asDiagonal() * coordinates, y_, z_);
}

Eigen::MatrixXd WaveCoordinates::sums(Eigen::MatrixXd tractions) const {
  Eigen::MatrixXd all = along_both(std::move(tractions), y_.transpose(), z_.transpose());
  const Eigen::ArrayXd shrunk = stretch_.cwiseInverse();
  all.array().colwise() *= shrunk;
  return all;
}

Eigen::MatrixXd WaveCoordinates::sums_of(std::span<const Index> rows,
                                         Eigen::MatrixXd tractions) const {
  const Index cells = component_size();
  Eigen::MatrixXd result(std::ssize(rows), tractions.cols());
  Index first = 0;
  for (const ComponentWaves& waves : by_component(rows, cells, z_.cols())) {
    const Eigen::MatrixXd left = y_(Eigen::indexing::all, waves.y);
    const Eigen::MatrixXd right = z_(Eigen::indexing::all, waves.z);
    const Index count = left.cols() * right.cols();
    const Index start = waves.component * cells;
    if (right.size() == 1) {
      result.middleRows(first, count) =
          left.transpose() * tractions.middleRows(start, cells) * right(0, 0);
    } else {
      for (Index j = 0; j < result.cols(); ++j) {
        const Eigen::Map<const RowMajor> x(tractions.col(j).data() + start, left.rows(),
                                           right.rows());
        Eigen::Map<RowMajor>(result.col(j).data() + first, left.cols(), right.cols()) =
            left.transpose() * x * right;
      }
    }
    first += count;
  }
  const Eigen::ArrayXd shrunk =
      stretch_(std::vector<Index>(rows.begin(), rows.end())).cwiseInverse();
  result.array().colwise() *= shrunk;
  return result;
}

Eigen::MatrixXd WaveCoordinates::coordinates(const Eigen::MatrixXd& tractions) const {
  return stretch_.asDiagonal() * along_both(tractions, y_.transpose(), z_.transpose());
}

Eigen::MatrixXd WaveCoordinates::spread(const Eigen::MatrixXd& coordinates) const {
  return along_both(stretch_.asDiagonal() * coordinates, y_, z_);
}

Eigen::VectorXd WaveCoordinates::squares() const {
  return along_both(stretch_.cwiseAbs2().cwiseInverse(), y_.cwiseAbs2(), z_.cwiseAbs2());
}

Eigen::VectorXd WaveCoordinates::squares(const SurfaceGrid&, const CellWindow& window) const {
  const auto sums = [](const Eigen::MatrixXd& waves, std::size_t reach) {
    Eigen::MatrixXd all = waves;
    for (Index wave = 0; wave < all.cols(); ++wave)
      window_sums(all.col(wave).data(), static_cast<std::size_t>(all.rows()), 1, reach);
    return Eigen::MatrixXd(all.cwiseAbs2());
  };
  const Index cells = y_.rows() * z_.rows();
  return along_both(stretch_.head(cells).cwiseAbs2().cwiseInverse(), sums(y_, window.rows),
                    sums(z_, window.columns));
}

}  // namespace tactile_net
