#include "grasp/space/cone_program.hpp"

#include <algorithm>
#include <cmath>

#include "grasp/space/lorentz.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

constexpr int most_steps = 100;
constexpr double exact = 1e-12;        // residuals and gap at which the search ends
constexpr double believed_end = 1e-7;  // at which it is believed_end where rounding has ended it

/// A point of the homogeneous model, or a direction.
struct Point {
  Eigen::VectorXd x, y, s;
  double tau = 1.0;
  double kappa = 1.0;
};

class Search {
 public:
  explicit Search(const ConeProgram& program) : p_(program) {
    Eigen::VectorXd e = Eigen::VectorXd::Zero(p_.c.size());
    for (Eigen::Index at = 0; const Eigen::Index size : p_.cones) {
      e(at) = 1.0;
      at += size;
    }
    at_ = {e, Eigen::VectorXd::Zero(p_.b.size()), e};
    unit_ = std::move(e);
  }

  ConeAnswer run() {
    int steps = 0;
    for (; steps < most_steps; ++steps) {
      if (ends(exact)) break;
      const Point before = at_;
      if (!step()) {
        at_ = before;
        break;
      }
    }
    ConeAnswer answer{.kind = kind(), .iterations = steps};
    const double over = answer.kind == ConeAnswer::Kind::infeasible  ? p_.b.dot(at_.y)
                        : answer.kind == ConeAnswer::Kind::unbounded ? -p_.c.dot(at_.x)
                                                                     : at_.tau;
    answer.x = at_.x / over;
    answer.y = at_.y / over;
    answer.s = at_.s / over;
    return answer;
  }

 private:
  /// How far the point is from an optimum, relative.
  [[nodiscard]] double off_optimum() const {
    const double t = at_.tau;
    const double gap = std::abs(p_.c.dot(at_.x) - p_.b.dot(at_.y)) /
                       (t + std::max(std::abs(p_.c.dot(at_.x)), std::abs(p_.b.dot(at_.y))));
    return std::max(
        {(p_.a * at_.x - t * p_.b).norm() / (t * (1.0 + p_.b.norm())),
         (p_.a.transpose() * at_.y + at_.s - t * p_.c).norm() / (t * (1.0 + p_.c.norm())), gap});
  }
  /// How far y is from a proof that there is no x.
  [[nodiscard]] double off_infeasible() const {
    const double way = p_.b.dot(at_.y);
    return way > 0.0 ? (p_.a.transpose() * at_.y + at_.s).norm() / way : INFINITY;
  }
  [[nodiscard]] double off_unbounded() const {
    const double way = -p_.c.dot(at_.x);
    return way > 0.0 ? (p_.a * at_.x).norm() / way : INFINITY;
  }
  [[nodiscard]] bool ends(double within) const {
    return off_optimum() <= within || off_infeasible() <= within || off_unbounded() <= within;
  }
  [[nodiscard]] ConeAnswer::Kind kind() const {
    using Kind = ConeAnswer::Kind;
    const double optimum = off_optimum();
    const double infeasible = off_infeasible();
    const double unbounded = off_unbounded();
    if (!(std::min({optimum, infeasible, unbounded}) <= believed_end)) return Kind::not_found;
    if (optimum <= infeasible && optimum <= unbounded) return Kind::solved;
    return infeasible <= unbounded ? Kind::infeasible : Kind::unbounded;
  }

  /// For each cone, what `of(first, size)` says.
  void each(const auto& of) const {
    for (Eigen::Index at = 0; const Eigen::Index size : p_.cones) {
      of(at, size);
      at += size;
    }
  }

  /// Of the directions that lower the residuals by `share` and send x o s where `rest` and
  /// `rest_tau` say, in the scaled cones.
  [[nodiscard]] Point direction(const CompleteLu& lu, double share, const Eigen::VectorXd& rest,
                                double rest_tau) const {
    const Eigen::Index n = p_.c.size();
    const Eigen::Index m = p_.b.size();
    Eigen::VectorXd scaled(n);
    each([&](Eigen::Index at, Eigen::Index size) {
      scaled.segment(at, size) =
          lorentz::quotient(rest.segment(at, size), lambda_.segment(at, size));
    });
    const Eigen::VectorXd dual = -share * (p_.a.transpose() * at_.y + at_.s - at_.tau * p_.c);
    const double across = -share * (p_.b.dot(at_.y) - p_.c.dot(at_.x) - at_.kappa);
    Eigen::VectorXd right(n + m);
    right << w_ * dual - scaled, -share * (p_.a * at_.x - at_.tau * p_.b);
    Eigen::VectorXd by_tau(n + m);
    by_tau << w_ * p_.c, p_.b;
    const Eigen::VectorXd one = lu.solve(right);
    const Eigen::VectorXd two = lu.solve(by_tau);
    const auto cost = [&](const Eigen::VectorXd& z) {
      return p_.b.dot(z.tail(m)) - p_.c.dot(w_ * z.head(n));
    };
    Point d;
    d.tau = (across + rest_tau / at_.tau - cost(one)) / (at_.kappa / at_.tau + cost(two));
    d.kappa = (rest_tau - at_.kappa * d.tau) / at_.tau;
    const Eigen::VectorXd z = one + d.tau * two;
    d.x = w_ * z.head(n);
    d.y = z.tail(m);
    scaled_x_ = z.head(n);
    scaled_s_ = scaled - scaled_x_;
    d.s = dual + d.tau * p_.c - p_.a.transpose() * d.y;
    return d;
  }

  [[nodiscard]] double longest(const Point& d) const {
    double step = 1e10;
    each([&](Eigen::Index at, Eigen::Index size) {
      for (const Eigen::VectorXd& way : {scaled_x_, scaled_s_})
        step =
            std::min(step, lorentz::longest_step(lambda_.segment(at, size), way.segment(at, size)));
    });
    if (d.tau < 0.0) step = std::min(step, -at_.tau / d.tau);
    if (d.kappa < 0.0) step = std::min(step, -at_.kappa / d.kappa);
    return step;
  }

  /// False where rounding leaves no way on.
  bool step() {
    const Eigen::Index n = p_.c.size();
    const Eigen::Index m = p_.b.size();
    w_ = Eigen::MatrixXd::Zero(n, n);
    lambda_.resize(n);
    each([&](Eigen::Index at, Eigen::Index size) {
      const Eigen::MatrixXd w = lorentz::scaling(at_.x.segment(at, size), at_.s.segment(at, size));
      w_.block(at, at, size, size) = w;
      lambda_.segment(at, size) = w * at_.s.segment(at, size);
    });
    if (!lambda_.allFinite()) return false;
    // Scaled: x = W dx~, s = W^-1 ds~. The systems of the three directions have one matrix.
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + m, n + m);
    k.topLeftCorner(n, n).diagonal().setConstant(-1.0);
    k.bottomLeftCorner(m, n) = p_.a * w_;
    k.topRightCorner(n, m) = k.bottomLeftCorner(m, n).transpose();
    const CompleteLu lu(k);

    const double mu =
        (at_.x.dot(at_.s) + at_.tau * at_.kappa) / static_cast<double>(p_.cones.size() + 1);
    Eigen::VectorXd rest(n);
    each([&](Eigen::Index at, Eigen::Index size) {
      const auto l = lambda_.segment(at, size);
      rest.segment(at, size) = -lorentz::product(l, l);
    });
    const Point affine = direction(lu, 1.0, rest, -at_.tau * at_.kappa);
    const double reach = std::min(1.0, longest(affine));
    const double centring = (1.0 - reach) * (1.0 - reach) * std::min(0.5, 1.0 - reach);
    each([&](Eigen::Index at, Eigen::Index size) {
      rest.segment(at, size) -=
          lorentz::product(scaled_x_.segment(at, size), scaled_s_.segment(at, size));
    });
    rest += centring * mu * unit_;
    const Point d = direction(lu, 1.0 - centring, rest,
                              -at_.tau * at_.kappa + centring * mu - affine.tau * affine.kappa);
    const double step = std::min(1.0, 0.99 * longest(d));
    if (!(step > 1e-8)) return false;
    at_.x += step * d.x;
    at_.y += step * d.y;
    at_.s += step * d.s;
    at_.tau += step * d.tau;
    at_.kappa += step * d.kappa;
    bool inside = at_.tau > 0.0 && at_.kappa > 0.0 && at_.x.allFinite() && at_.y.allFinite();
    each([&](Eigen::Index at, Eigen::Index size) {
      inside = inside && lorentz::slack(at_.x.segment(at, size)) > 0.0 &&
               lorentz::slack(at_.s.segment(at, size)) > 0.0;
    });
    return inside;
  }

  const ConeProgram& p_;
  Point at_;
  Eigen::VectorXd unit_;
  Eigen::MatrixXd w_;
  Eigen::VectorXd lambda_;
  mutable Eigen::VectorXd scaled_x_, scaled_s_;  // of the last direction
};

}  // namespace

ConeAnswer solve(const ConeProgram& program) { return Search(program).run(); }

}  // namespace tactile_net
