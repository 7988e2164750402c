#include "calibration/fit_covariance.hpp"

#include <cmath>

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

}  // namespace

double FitCovariance::leverage(const Eigen::MatrixXd& rows) const {
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
  const FitSystem system = fit_system(problem, state, readings, columns, parts);
  const std::size_t t = problem.columns();
  const Eigen::Index kept_count = eigen_index(system.kept.size());
  // All unknowns by the kept ones, but for what the eliminated have of their own.
  Eigen::MatrixXd through = Eigen::MatrixXd::Zero(eigen_index(problem.unknowns()), kept_count);
  Eigen::VectorXd length(kept_count);
  FitCovariance result;
  result.unknown.resize(t);
  result.presses.resize(problem.press_rows.size());
  for (Eigen::Index k = 0; k < kept_count; ++k) {
    const std::size_t unknown = system.kept[static_cast<std::size_t>(k)];
    if (unknown == no_column) {
      length(k) = system.triangle.col(k).norm();
      if (length(k) == 0.0) length(k) = 1.0;
    } else {
      length(k) = columns.norm(eigen_index(unknown));
      through(eigen_index(unknown), k) = 1.0;
    }
    if (unknown >= t) result.rank -= 1.0;  // of a press, or a mean
  }
  for (const FitSystem::Group& group : system.groups) {
    if (group.unknowns.empty()) continue;
    const Eigen::Index l = group.own.cols();
    const bool of_press = group.press != no_column;
    if (!(group.own.diagonal().cwiseAbs().minCoeff() > 0.0)) {  // nothing tells it
      if (of_press) result.presses[group.press].regular = false;
      for (std::size_t i = 0; !of_press && i < group.unknowns.size(); ++i)
        result.unknown[group.unknowns[i]] = true;
      continue;
    }
    const Eigen::MatrixXd inverse = solve_upper(group.own, Eigen::MatrixXd::Identity(l, l));
    const Eigen::MatrixXd moves = -inverse * group.share;
    for (Eigen::Index i = 0; i < l; ++i)
      through.row(eigen_index(group.unknowns[static_cast<std::size_t>(i)])) = moves.row(i);
    if (of_press) {
      result.presses[group.press].own = inverse * inverse.transpose();
    } else {
      result.blocks.push_back({group.unknowns, inverse});
      result.rank += static_cast<double>(l);
    }
  }
  const Root kept = root_of(system.triangle, length);
  result.rank += kept.rank;
  for (Eigen::Index k = 0; k < kept.nulls.cols(); ++k) {
    const Eigen::VectorXd moved =
        through * (length.cwiseInverse().asDiagonal() * kept.nulls.col(k));
    for (std::size_t i = 0; i < t; ++i)
      if (std::abs(moved(eigen_index(i))) * columns.norm(eigen_index(i)) > unknown_share)
        result.unknown[i] = true;
  }
  const Eigen::MatrixXd all = through * kept.root;
  result.root = all.topRows(eigen_index(t));
  result.matrix = result.root * result.root.transpose();
  for (const FitCovariance::Block& block : result.blocks) {
    const Eigen::MatrixXd own = block.root * block.root.transpose();
    for (std::size_t a = 0; a < block.columns.size(); ++a)
      for (std::size_t b = 0; b < block.columns.size(); ++b)
        result.matrix(eigen_index(block.columns[a]), eigen_index(block.columns[b])) +=
            own(eigen_index(a), eigen_index(b));
  }
  for (std::size_t p = 0; p < result.presses.size(); ++p) {
    const PressRows& rows = problem.press_rows[p];
    FitCovariance::Press& press = result.presses[p];
    if (rows.columns == 0 || !press.regular) continue;
    const auto own = all.middleRows(eigen_index(rows.first), eigen_index(rows.columns));
    if (press.own.size() == 0) press.own.setZero(own.rows(), own.rows());
    press.own += own * own.transpose();
    press.cross = own * result.root.transpose();
  }
  return result;
}

}  // namespace tactile_net
