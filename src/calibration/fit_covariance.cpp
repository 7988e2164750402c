#include "calibration/fit_covariance.hpp"

#include <cmath>

#include "calibration/reading_system.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr double singular_limit = 1e-10;
constexpr double unknown_share = 1e-4;  // of a direction that is not known, for an unknown to be so

/// R^-1 but for its null space, as a root of (R'R)^-1.
struct Root {
  Eigen::MatrixXd root;   ///< columns without number are zero
  Eigen::MatrixXd nulls;  ///< a column each, of columns scaled to unit length
  double rank = 0.0;
};

Root root_of(const Eigen::MatrixXd& triangle, const Eigen::VectorXd& norm) {
  const Svd svd =
      singular_value_decomposition(Eigen::MatrixXd(triangle * norm.cwiseInverse().asDiagonal()));
  Root result{svd.v, Eigen::MatrixXd(svd.v.rows(), 0)};
  for (Eigen::Index k = 0; k < svd.values.size(); ++k) {
    if (svd.values(k) > singular_limit * svd.values(0)) {
      result.root.col(k) /= svd.values(k);
      result.rank += 1.0;
      continue;
    }
    result.nulls.conservativeResize(Eigen::NoChange, result.nulls.cols() + 1);
    result.nulls.rightCols(1) = svd.v.col(k);
    result.root.col(k).setZero();
  }
  result.root = norm.cwiseInverse().asDiagonal() * result.root;
  return result;
}

FitCovariance presses_first(const FitSystem& system, const FitProblem& problem,
                            const Eigen::VectorXd& norm) {
  const Eigen::Index t = system.triangle.cols();
  const Root root = root_of(system.triangle, norm);
  FitCovariance result{root.root * root.root.transpose(),
                       std::vector<bool>(static_cast<std::size_t>(t)), root.rank};
  for (Eigen::Index k = 0; k < root.nulls.cols(); ++k)
    for (Eigen::Index i = 0; i < t; ++i)
      if (std::abs(root.nulls(i, k)) > unknown_share)
        result.unknown[static_cast<std::size_t>(i)] = true;
  for (std::size_t p = 0; p < system.presses.size(); ++p) {
    const auto m = eigen_index(problem.press_rows[p].columns);
    const auto& [own, share, rhs] = system.presses[p];
    FitCovariance::Press& press = result.presses.emplace_back();
    press.regular = m == 0 || own.diagonal().cwiseAbs().minCoeff() > 0.0;
    if (m == 0 || !press.regular) continue;
    const Eigen::MatrixXd inverse = solve_upper(own, Eigen::MatrixXd::Identity(m, m));
    const Eigen::MatrixXd through = inverse * share;
    press.cross = -through * result.matrix;
    press.own = inverse * inverse.transpose() - press.cross * through.transpose();
  }
  return result;
}

FitCovariance readings_first(const ReadingSystem& system, const FitProblem& problem,
                             const Eigen::VectorXd& norm) {
  const Eigen::Index t = eigen_index(problem.columns());
  Eigen::VectorXd length = system.triangle.colwise().norm().transpose();
  for (double& one : length)
    if (one == 0.0) one = 1.0;
  const Root kept = root_of(system.triangle, length);
  FitCovariance result{.matrix = {}, .unknown = std::vector<bool>(static_cast<std::size_t>(t))};
  std::size_t means = 0;
  // How kept unknowns move the common ones.
  Eigen::MatrixXd through = Eigen::MatrixXd::Zero(t, system.triangle.cols());
  for (std::size_t i = 0; i < system.common.size(); ++i)
    if (system.common[i] != no_column)
      through(eigen_index(system.common[i]), eigen_index(system.first_common + i)) = 1.0;
    else
      ++means;
  for (const ReadingSystem::Group& group : system.groups) {
    const Eigen::Index l = group.own.cols();
    if (!(group.own.diagonal().cwiseAbs().minCoeff() > 0.0)) {  // a gain that nothing tells
      for (const std::size_t column : group.columns) result.unknown[column] = true;
      continue;
    }
    const Eigen::MatrixXd inverse = solve_upper(group.own, Eigen::MatrixXd::Identity(l, l));
    const Eigen::MatrixXd moves = -inverse * group.share;
    for (Eigen::Index i = 0; i < l; ++i)
      through.row(eigen_index(group.columns[static_cast<std::size_t>(i)])) = moves.row(i);
    result.blocks.push_back({group.columns, inverse});
    result.rank += static_cast<double>(l);
  }
  result.rank += kept.rank - static_cast<double>(system.first_common + means);
  for (Eigen::Index k = 0; k < kept.nulls.cols(); ++k) {
    const Eigen::VectorXd moved =
        through * (length.cwiseInverse().asDiagonal() * kept.nulls.col(k));
    for (Eigen::Index i = 0; i < t; ++i)
      if (std::abs(moved(i)) * norm(i) > unknown_share)
        result.unknown[static_cast<std::size_t>(i)] = true;
  }
  result.root = through * kept.root;
  result.matrix = result.root * result.root.transpose();
  for (const FitCovariance::Block& block : result.blocks) {
    const Eigen::MatrixXd own = block.root * block.root.transpose();
    for (std::size_t a = 0; a < block.columns.size(); ++a)
      for (std::size_t b = 0; b < block.columns.size(); ++b)
        result.matrix(eigen_index(block.columns[a]), eigen_index(block.columns[b])) +=
            own(eigen_index(a), eigen_index(b));
  }
  for (std::size_t p = 0; p < problem.press_rows.size(); ++p) {
    const auto m = eigen_index(problem.press_rows[p].columns);
    const Eigen::MatrixXd own = kept.root.middleRows(eigen_index(system.first_of_press[p]), m);
    result.presses.push_back({own * own.transpose(), own * result.root.transpose()});
  }
  return result;
}

}  // namespace

double FitCovariance::leverage(const Eigen::MatrixXd& rows) const {
  if (root.size() == 0) return (rows * matrix).cwiseProduct(rows).sum();
  double sum = (rows * root).squaredNorm();
  for (const Block& block : blocks) {
    Eigen::MatrixXd own(rows.rows(), eigen_index(block.columns.size()));
    for (std::size_t i = 0; i < block.columns.size(); ++i)
      own.col(eigen_index(i)) = rows.col(eigen_index(block.columns[i]));
    sum += (own * block.root).squaredNorm();
  }
  return sum;
}

FitCovariance fit_covariance(const FitProblem& problem, const FitState& state,
                             const PressReadings& readings, const SystemColumns& columns,
                             const SystemParts& parts) {
  if (problem.readings_first())
    return readings_first(reading_system(problem, state, readings, columns, parts), problem,
                          columns.norm);
  return presses_first(fit_system(problem, state, readings, columns, parts), problem, columns.norm);
}

}  // namespace tactile_net
