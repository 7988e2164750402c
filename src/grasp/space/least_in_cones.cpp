#include "grasp/space/least_in_cones.hpp"

#include <cmath>
#include <limits>

#include "grasp/space/lorentz.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

constexpr double violation_rounding = 1e-9;  // of a violation
constexpr int most_mends = 30;

}  // namespace

ConeProgram LeastInCones::program() const {
  const Eigen::Index u = m.rows();
  const Eigen::Index n = m.cols();
  ConeProgram p{.c = Eigen::VectorXd::Unit(1 + u + n, 0),
                .a = Eigen::MatrixXd::Zero(u + c.rows(), 1 + u + n),
                .b = Eigen::VectorXd::Zero(u + c.rows()),
                .cones = {1 + u}};
  p.a.block(0, 1, u, u).setIdentity();
  p.a.block(0, 1 + u, u, n) = -m;
  p.a.block(u, 1 + u, c.rows(), n) = c;
  p.b.tail(c.rows()) = d;
  p.cones.insert(p.cones.end(), cones.begin(), cones.end());
  return p;
}

void LeastPoint::each(const auto& of) const {
  Eigen::Index at = 0;
  Eigen::Index multiplier = problem_.m.rows() + columns() + problem_.c.rows();
  for (std::size_t i = 0; i < met_.size(); ++i) {
    const Eigen::Index size = problem_.cones[i];
    of(at, size, met_[i], multiplier);
    at += size;
    multiplier += met_[i] == Met::inside ? 0 : met_[i] == Met::edge ? 1 : size;
  }
}

LeastPoint::LeastPoint(const LeastInCones& problem, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& s)
    : problem_(problem) {
  const double of_x = x.size() > 0 ? x.cwiseAbs().maxCoeff() : 1.0;
  const double of_s = problem_.m.cwiseAbs().maxCoeff();  // s may vanish in all cones
  for (Eigen::Index at = 0; x.size() > 0 && at < x.size();) {
    const Eigen::Index size = problem_.cones[met_.size()];
    const auto one = x.segment(at, size);
    const auto other = s.segment(at, size);
    // One of the two is inside of its cone, or both are on their edges.
    met_.push_back(one(0) * of_s < lorentz::slack(other) * of_x   ? Met::tip
                   : lorentz::slack(one) * of_s > other(0) * of_x ? Met::inside
                                                                  : Met::edge);
    at += size;
  }
  begin(x);
  converge();
  for (int i = 0; i < most_mends; ++i) {
    const Violation wrong = worst();
    if (wrong.size <= violation_rounding) break;
    met_[wrong.cone] = wrong.rather;
    begin(x);
    converge();
  }
}

void LeastPoint::converge() {
  // Quadratic where the cones are the right ones; without cones the first step is exact.
  double best = std::numeric_limits<double>::infinity();
  Eigen::VectorXd at = z_;
  for (int i = 0; i < 20; ++i) {
    const double size = conditions().norm();
    if (!(size < best)) break;
    best = size;
    at = z_;
    z_ -= CompleteLu(derivative()).solve(conditions());
  }
  if (!(conditions().norm() < best)) z_ = at;
}

LeastPoint::Violation LeastPoint::worst() const {
  const Eigen::VectorXd pull = problem_.m.transpose() * minus_mx();
  const double of_s = pull.size() > 0 && pull.norm() > 0.0 ? pull.norm() : 1.0;
  const double of_x = x().norm() > 0.0 ? x().norm() : 1.0;
  Violation worst;
  std::size_t cone = 0;
  const auto violated = [&](double by, Met rather) {
    if (by > worst.size) worst = {by, cone, rather};
  };
  each([&](Eigen::Index at, Eigen::Index size, Met met, Eigen::Index multiplier) {
    const auto one = z_.segment(problem_.m.rows() + at, size);
    if (met == Met::inside) {
      violated(-lorentz::slack(one) / of_x, one(0) > 0.0 ? Met::edge : Met::tip);
    } else if (met == Met::edge) {
      violated(-one(0) / of_x, Met::tip);
      violated(z_(multiplier) * std::abs(one(0)) / of_s, Met::inside);
    } else {
      violated(-lorentz::slack(z_.segment(multiplier, size)) / of_s, Met::edge);
    }
    ++cone;
  });
  return worst;
}

void LeastPoint::begin(const Eigen::VectorXd& start) {
  const Eigen::Index u = problem_.m.rows();
  const Eigen::Index n = columns();
  Eigen::Index multipliers = 0;
  for (std::size_t i = 0; i < met_.size(); ++i)
    multipliers += met_[i] == Met::inside ? 0 : met_[i] == Met::edge ? 1 : problem_.cones[i];
  z_ = Eigen::VectorXd::Zero(u + n + problem_.c.rows() + multipliers);
  if (start.size() == 0) return;
  each([&](Eigen::Index at, Eigen::Index size, Met met, Eigen::Index) {
    if (met != Met::tip) z_.segment(u + at, size) = start.segment(at, size);
  });
  z_.head(u) = -problem_.m * x();
  // Multipliers that suit x best: the last condition is linear in them.
  const Eigen::MatrixXd rows = derivative().block(u + problem_.c.rows() + multipliers, u + n, n,
                                                  problem_.c.rows() + multipliers);
  z_.tail(rows.cols()) = pivoted_least_squares(rows, -problem_.m.transpose() * minus_mx());
}

Eigen::VectorXd LeastPoint::conditions() const {
  const Eigen::Index u = problem_.m.rows();
  const Eigen::Index n = columns();
  const Eigen::Index held = z_.size() - u - n - problem_.c.rows();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(z_.size());
  f.head(u) = minus_mx() + problem_.m * x();
  f.segment(u, problem_.c.rows()) = problem_.c * x() - problem_.d;
  auto last = f.tail(n);
  last = problem_.m.transpose() * minus_mx() + problem_.c.transpose() * multipliers();
  const Eigen::Index first = u + problem_.c.rows();
  const Eigen::Index l = z_.size() - held;
  each([&](Eigen::Index at, Eigen::Index size, Met met, Eigen::Index multiplier) {
    const auto x = z_.segment(u + at, size);
    if (met == Met::edge) {
      f(first + multiplier - l) = -0.5 * lorentz::determinant(x);
      last(at) -= z_(multiplier) * x(0);
      last.segment(at + 1, size - 1) += z_(multiplier) * x.tail(size - 1);
    } else if (met == Met::tip) {
      f.segment(first + multiplier - l, size) = x;
      last.segment(at, size) += z_.segment(multiplier, size);
    }
  });
  return f;
}

Eigen::MatrixXd LeastPoint::derivative() const {
  const Eigen::Index u = problem_.m.rows();
  const Eigen::Index n = columns();
  const Eigen::Index c = problem_.c.rows();
  const Eigen::Index all = z_.size();
  const Eigen::Index l = u + n + c;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(all, all);
  k.topLeftCorner(u, u).setIdentity();
  k.block(0, u, u, n) = problem_.m;
  k.block(u, u, c, n) = problem_.c;
  auto last = k.bottomRows(n);
  last.leftCols(u) = problem_.m.transpose();
  last.middleCols(u + n, c) = problem_.c.transpose();
  each([&](Eigen::Index at, Eigen::Index size, Met met, Eigen::Index multiplier) {
    const Eigen::Index row = u + c + multiplier - l;
    if (met == Met::edge) {
      Eigen::VectorXd normal = z_.segment(u + at, size);
      normal(0) = -normal(0);
      k.row(row).segment(u + at, size) = normal;
      last.col(multiplier).segment(at, size) = normal;
      for (Eigen::Index i = 0; i < size; ++i)
        last(at + i, u + at + i) += i == 0 ? -z_(multiplier) : z_(multiplier);
    } else if (met == Met::tip) {
      k.block(row, u + at, size, size).setIdentity();
      last.block(at, multiplier, size, size).setIdentity();
    }
  });
  return k;
}

double LeastPoint::residual() const {
  const double size = problem_.d.norm();
  const double off = (problem_.c * x() - problem_.d).norm();
  return size > 0.0 ? off / size : off;
}

double LeastPoint::optimality() const {
  const Eigen::VectorXd torques = problem_.m.transpose() * minus_mx();
  const double size = torques.norm() + (problem_.c.transpose() * multipliers()).norm();
  const double off = conditions().tail(columns()).norm();
  return size > 0.0 ? off / size : off;
}

Eigen::VectorXd LeastPoint::change(const Eigen::VectorXd& by_m, const Eigen::VectorXd& by_c,
                                   const Eigen::VectorXd& by_x) const {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(z_.size());
  right.head(by_m.size()) = -by_m;
  right.segment(by_m.size(), by_c.size()) = -by_c;
  right.tail(columns()) = -by_x;
  return CompleteLu(derivative()).solve(right).segment(problem_.m.rows(), columns());
}

}  // namespace tactile_net
