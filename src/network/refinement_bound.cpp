// t of theorem T9 from tolerances (docs/circuits.md).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "network/refinement_parts.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

/// Of random errors, at most one build in so many is beyond; of noise, one cycle.
constexpr double one_in = 1e6;

double norm_2(const Eigen::MatrixXd& a) { return a.size() == 0 ? 0.0 : singular_values(a)(0); }

/// How far the entries of S may be off, each by itself.
///
/// @param of_error  (e): how far a conductance may be off of a resistance within e
/// @param of_gain   the same of what finite gain adds, which is made of the same resistors
Eigen::MatrixXd entry_bounds(const Refinement::Parts& parts, auto&& of_error, double of_gain) {
  const Eigen::Index rows = eigen_index(parts.reduction.rows());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t r = 0; r < parts.branches.size(); ++r) {
    const double share = of_error(parts.within[r]);
    for (const auto& [row, of_law] : parts.branches[r].law)
      for (const auto& [at, of_voltage] : parts.branches[r].voltage)
        all(eigen_index(row), eigen_index(at)) +=
            share * std::abs(of_law * of_voltage * parts.printed[r]);
  }
  if (parts.lossy == 0.0) return all;
  Equations equations;
  parts.reduction.assemble(parts.printed, equations);
  if (equations.input.values.empty())
    all.diagonal() += of_gain * parts.lossy * as_eigen(std::span(equations.total));
  else
    all.leftCols(parts.sizes.outputs) +=
        of_gain * parts.lossy * as_eigen(equations.input).cwiseAbs();
  return all;
}

/// What is known of the errors of the blocks of S, in 2-norms and units of P: of all builds, and of
/// all but one in a million.
class BlockErrors {
 public:
  explicit BlockErrors(const Refinement::Parts& parts)
      : parts_(parts),
        o_(parts.sizes.outputs),
        n_(parts.sizes.residuals),
        c_(parts.sizes.common),
        most_(*std::max_element(parts.within.begin(), parts.within.end())),
        steep_(most_ / (1.0 - most_)),
        printed_(parts.seen(parts.printed)),
        size_(parts.inverse_root.cwiseAbs()),
        // A resistance off by e is a conductance off by e / (1 -+ e): e to first order, and
        // e^2 / (1 - e) beyond.
        full_(entry_bounds(
            parts, [](double e) { return e / (1.0 - e); }, steep_)),
        beyond_(entry_bounds(
            parts, [](double e) { return e * e / (1.0 - e); }, steep_)),
        whole_(entry_bounds(
            parts, [](double) { return 1.0; }, 0.0)) {
    if (n_ > 0) weigh_residuals();
    if (c_ > 0) weigh_common();
  }

  void tell(RefinementBound& bound) const {
    bound.fixed = norm_2(parts_.deviation(printed_.matrix() / parts_.unit));
    bound.rho = own(whole_);
    bound.stabiliser = own(full_);
    double rest = own(beyond_);
    if (n_ > 0) {
      bound.z = into(whole_);
      bound.kernel = off(into(full_), from(full_)) + held_ * into_ * from_;
      const double in = most_into();
      const double out = most_from();
      rest += from_ * into(beyond_) + into_ * from(beyond_) + bent_ * into_ * from_ +
              most_product(in) + held_ * (from_ * in + into_ * out + in * out);
    }
    if (c_ > 0) {
      const double left = (1.0 - most_) / std::pow(1.0 + most_, 2);
      bound.common = common_in(into(full_), co(full_)) * common_out(from(full_), oc(full_)) / left;
      rest += most_common_in() * most_common_out() / left;
    }
    bound.parts = bound.fixed + bound.kernel + bound.stabiliser + bound.common;
    const double first = hoeffding(parts_.inverse_root * printed_.rows() / parts_.unit,
                                   printed_.unknowns() * parts_.inverse_root);
    bound.rest_of_most = rest;
    bound.parts_of_most = std::min(bound.parts, bound.fixed + first + rest);
  }

 private:
  void weigh_residuals() {
    // Rows of the arrays so that K's and its transpose's weigh alike: their product is P's.
    const Eigen::VectorXd in = printed_.no.rowwise().norm();
    const Eigen::VectorXd out = printed_.on.colwise().norm();
    const Eigen::VectorXd total = (parts_.unit * printed_.held).cwiseSqrt();
    left_ = out.cwiseQuotient(in).cwiseSqrt().cwiseQuotient(total);
    right_ = in.cwiseQuotient(out).cwiseSqrt().cwiseQuotient(total);
    into_ = norm_2(left_.asDiagonal() * printed_.no * parts_.inverse_root);
    from_ = norm_2(parts_.inverse_root * printed_.on * right_.asDiagonal());
    // What holds a residual is a sum of conductances: between those of least and of most.
    const Eigen::MatrixXd fallen = entry_bounds(
        parts_, [](double e) { return e / (1.0 + e); }, steep_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double up = full_(o_ + i, o_ + i) / printed_.held(i);
      const double down = fallen(o_ + i, o_ + i) / printed_.held(i);
      held_ = std::max({held_, down / (1.0 - down), up / (1.0 + up)});
      // A mean of resistances less their harmonic mean is of second order.
      bent_ = std::max(bent_, beyond_(o_ + i, o_ + i) / printed_.held(i));
    }
  }

  void weigh_common() {
    // Q, what a common voltage meets, is symmetric, and its rows exceed what is beside its
    // diagonal: Q is at least their sums, of which errors leave (1 - e) / (1 + e)^2.
    const Eigen::MatrixXd between = printed_.held.cwiseInverse().asDiagonal() * printed_.nc;
    const Eigen::VectorXd sums = (printed_.cc - printed_.cn * between).rowwise().sum();
    over_ = (parts_.unit * sums).cwiseSqrt().cwiseInverse();
    const Eigen::VectorXd in = printed_.held.cwiseProduct(left_).cwiseInverse();
    const Eigen::VectorXd out = printed_.held.cwiseProduct(right_).cwiseInverse();
    by_in_ = norm_2(over_.asDiagonal() * printed_.cn.cwiseAbs() * in.asDiagonal());
    by_out_ = norm_2(out.asDiagonal() * printed_.nc.cwiseAbs() * over_.asDiagonal());
  }

  /// min(| E |P^-1/2| |, |E| / least^1/2) of bounds E by entries.
  [[nodiscard]] double one_sided(const Eigen::MatrixXd& e) const {
    return std::min(norm_2(e * size_), norm_2(e) / std::sqrt(parts_.least));
  }
  /// The outputs' own block: of R, or of P.
  [[nodiscard]] double own(const Eigen::MatrixXd& e) const {
    const Eigen::MatrixXd block = e.topLeftCorner(o_, o_) / parts_.unit;
    return std::min(norm_2(size_ * block * size_), norm_2(block) / parts_.least);
  }
  /// What leads into the residuals, K, and from them to the outputs, K'.
  [[nodiscard]] double into(const Eigen::MatrixXd& e) const {
    return one_sided(left_.asDiagonal() * e.block(o_, 0, n_, o_));
  }
  [[nodiscard]] double from(const Eigen::MatrixXd& e) const {
    return one_sided(right_.asDiagonal() * e.block(0, o_, o_, n_).transpose());
  }
  /// What both inputs take in of the outputs, and the other way.
  [[nodiscard]] double co(const Eigen::MatrixXd& e) const {
    return one_sided(over_.asDiagonal() * e.block(o_ + n_, 0, c_, o_));
  }
  [[nodiscard]] double oc(const Eigen::MatrixXd& e) const {
    return one_sided(over_.asDiagonal() * e.block(0, o_ + n_, o_, c_).transpose());
  }

  /// (K' + dK') F (K + dK) - K'K but for K'(F - 1) K, of |dK| and |dK'|.
  [[nodiscard]] double off(double in, double out) const {
    return (1.0 + held_) * (from_ * in + into_ * out + in * out);
  }

  /// The same of two arrays in series of which one leads to both inputs, and of nothing where none
  /// is off: the halves cancel.
  [[nodiscard]] double common_in(double in, double direct) const {
    return direct + by_in_ * ((steep_ + held_ + steep_ * held_) * into_ +
                              (1.0 + steep_) * (1.0 + held_) * in);
  }
  [[nodiscard]] double common_out(double out, double direct) const {
    return direct + by_out_ * ((steep_ + held_ + steep_ * held_) * from_ +
                               (1.0 + steep_) * (1.0 + held_) * out);
  }

  /// Of a sum of columns times rows, each times its resistor's own relative error: the deviations
  /// of its columns and of its rows. Uniform errors within +-e have moments of variance e^2 / 3 at
  /// most (strictly sub-Gaussian).
  ///
  /// @param left, right  of d(S): the sum is left dS right
  [[nodiscard]] std::pair<double, double> deviations(const Eigen::MatrixXd& left,
                                                     const Eigen::MatrixXd& right) const {
    const Eigen::Index count = eigen_index(parts_.branches.size());
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(left.rows(), count);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(right.cols(), count);
    for (Eigen::Index r = 0; r < count; ++r) {
      const auto at = static_cast<std::size_t>(r);
      const double size = std::sqrt(parts_.within[at] * std::abs(parts_.printed[at]));
      for (const auto& [row, factor] : parts_.branches[at].law)
        columns.col(r) += size * factor * left.col(eigen_index(row));
      for (const auto& [unknown, factor] : parts_.branches[at].voltage)
        rows.col(r) += size * factor * right.row(eigen_index(unknown)).transpose();
    }
    const auto deviation = [](const Eigen::MatrixXd& of, const Eigen::MatrixXd& by) {
      const Eigen::MatrixXd weighed = of * by.colwise().norm().asDiagonal();
      const Eigen::MatrixXd sum = weighed * weighed.transpose();
      return std::sqrt(std::max(symmetric_eigenvalues(sum).maxCoeff(), 0.0) / 3.0);
    };
    return {deviation(columns, rows), deviation(rows, columns)};
  }

  /// What the 2-norm exceeds in one build of a million: P(|sum| > x) <= d exp(-x^2 / 2 v) (matrix
  /// Hoeffding), d rows and columns together.
  [[nodiscard]] double exceeded(double deviation, Eigen::Index dimensions) const {
    const double events = n_ == 0 ? 1.0 : c_ == 0 ? 4.0 : 6.0;  // each may fail
    return deviation * std::sqrt(2.0 * std::log(static_cast<double>(dimensions) * events * one_in));
  }
  [[nodiscard]] double hoeffding(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) const {
    const auto [of_columns, of_rows] = deviations(left, right);
    return exceeded(std::max(of_columns, of_rows), left.rows() + right.cols());
  }

  /// |dK| of all builds but one in a million; what is beyond first order is added.
  [[nodiscard]] double most_into() const {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n_, o_ + n_ + c_);
    left.middleCols(o_, n_) = left_.asDiagonal();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(o_ + n_ + c_, o_);
    right.topRows(o_) = parts_.inverse_root;
    return std::min(into(full_), hoeffding(left, right) + into(beyond_));
  }
  [[nodiscard]] double most_from() const {
    return std::min(from(full_), hoeffding(to_outputs(), of_residuals(right_)) + from(beyond_));
  }

  /// |dK' dK|: their resistors are different ones, so that dK' is random where dK is given, whose
  /// norm is `in` and whose rows are no longer than their bounds.
  [[nodiscard]] double most_product(double in) const {
    const Eigen::MatrixXd bounds = left_.asDiagonal() * full_.block(o_, 0, n_, o_) * size_;
    const Eigen::VectorXd lengths = bounds.rowwise().norm();
    const double of_columns =
        deviations(to_outputs(), of_residuals(right_.cwiseProduct(lengths))).first;
    const double of_rows = deviations(to_outputs(), of_residuals(right_)).second * in;
    return std::min(in * from(full_),
                    exceeded(std::max(of_columns, of_rows), 2 * o_) + in * from(beyond_));
  }
  [[nodiscard]] Eigen::MatrixXd to_outputs() const {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(o_, o_ + n_ + c_);
    left.leftCols(o_) = parts_.inverse_root;
    return left;
  }
  [[nodiscard]] Eigen::MatrixXd of_residuals(const Eigen::VectorXd& weights) const {
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(o_ + n_ + c_, n_);
    right.middleRows(o_, n_) = weights.asDiagonal();
    return right;
  }

  /// The same of what both inputs take in: products of two errors beside first order.
  [[nodiscard]] double most_common_in() const {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(c_, o_ + n_ + c_);
    left.middleCols(o_, n_) = -printed_.cn * printed_.held.cwiseInverse().asDiagonal();
    left.rightCols(c_).setIdentity();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(o_ + n_ + c_, o_);
    right.topRows(o_) = parts_.inverse_root;
    right.middleRows(o_, n_) =
        -(printed_.held.cwiseInverse().asDiagonal() * printed_.no * parts_.inverse_root);
    const double first = hoeffding(over_.asDiagonal() * left, right);
    return std::min(common_in(into(full_), co(full_)),
                    first + co(beyond_) +
                        by_in_ * (square() * into_ + into(beyond_) + product() * most_into()));
  }
  [[nodiscard]] double most_common_out() const {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(o_, o_ + n_ + c_);
    left.leftCols(o_) = parts_.inverse_root;
    left.middleCols(o_, n_) =
        -parts_.inverse_root * printed_.on * printed_.held.cwiseInverse().asDiagonal();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(o_ + n_ + c_, c_);
    right.middleRows(o_, n_) = -(printed_.held.cwiseInverse().asDiagonal() * printed_.nc);
    right.bottomRows(c_).setIdentity();
    const double first = hoeffding(left, right * over_.asDiagonal());
    return std::min(common_out(from(full_), oc(full_)),
                    first + oc(beyond_) +
                        by_out_ * (square() * from_ + from(beyond_) + product() * most_from()));
  }
  /// Of the conductances into the common voltages and what holds residuals, beyond first order.
  [[nodiscard]] double square() const { return most_ * steep_ + bent_ + steep_ * held_; }
  [[nodiscard]] double product() const { return steep_ + held_ + steep_ * held_; }

  const Refinement::Parts& parts_;
  Eigen::Index o_, n_, c_;
  double most_, steep_;  // of resistances, and of conductances
  SeenMatrix printed_;
  Eigen::MatrixXd size_;                   // |P^-1/2| by entries
  Eigen::MatrixXd full_, beyond_, whole_;  // as `entry_bounds`
  Eigen::VectorXd left_, right_;           // of the residuals
  double into_ = 0.0, from_ = 0.0;         // |K P^-1/2| of both arrays
  double held_ = 0.0, bent_ = 0.0;  // what holds residuals: all of it, and beyond first order
  Eigen::VectorXd over_;            // of the common voltages
  double by_in_ = 0.0, by_out_ = 0.0;
};

/// The converters' shares: how large a part of P^-1/2 r and P^1/2 d they may add.
void tell_converters(const Refinement::Parts& parts, RefinementBound& bound) {
  const Converters& converters = *parts.options.converters;
  const double turn = std::sqrt(bound.condition);
  const double step = std::ldexp(1.0, 1 - converters.bits);  // of the range, which is +-1
  const Eigen::MatrixXd inverse = parts.inverse_root * parts.inverse_root;
  const double gain = converters.gain *
                      std::min(turn, norm_2(parts.inverse_root.cwiseAbs() * parts.root.cwiseAbs()));
  // Rounded by half a step, and the code half a step from its place: a box, each channel within a
  // step of the largest.
  const double code = (1.0 + converters.gain) * step;
  bound.to_circuit = gain + code * std::sqrt(parts.largest * inverse.cwiseAbs().sum());
  double added = code * std::sqrt(parts.exact.cwiseAbs().sum());
  // |A x| of a Gaussian x exceeds |A|_F + far |A|_2 once in exp(far^2 / 2).
  const double far = std::sqrt(2.0 * std::log(one_in));
  const auto gaussian = [&](const Eigen::MatrixXd& a) {
    added += (1.0 + converters.gain) * (a.norm() + far * norm_2(a));
  };
  gaussian(converters.noise * parts.root);
  for (const Matrix* of_inputs : {&parts.opamps.offset, &parts.opamps.bias_current})
    if (!of_inputs->values.empty()) gaussian(parts.root * as_eigen(*of_inputs) / parts.range);
  bound.from_circuit = gain + added / std::sqrt(parts.least);
}

}  // namespace

RefinementBound Refinement::bound() const {
  RefinementBound bound{.condition = parts_->largest / parts_->least, .step = parts_->options.step};
  BlockErrors(*parts_).tell(bound);
  if (parts_->options.converters) tell_converters(*parts_, bound);
  return bound;
}

double RefinementBound::contraction_of(double t) const noexcept {
  if (!(t < 1.0 && to_circuit < 1.0 && from_circuit < 1.0)) return 1.0;
  if (step == RefinementStep::plain)
    return std::min(1.0, (1.0 + to_circuit) * (t + from_circuit) / (1.0 - t) + to_circuit);
  // The angle between what is left and what is gone along is at most the sum of these.
  const double angle = std::asin(t) + std::asin(to_circuit) + std::asin(from_circuit);
  return angle < 0.5 * std::numbers::pi ? std::sin(angle) : 1.0;
}

}  // namespace tactile_net
