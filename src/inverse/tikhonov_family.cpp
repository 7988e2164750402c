#include "tactile_net/inverse/tikhonov_family.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/degrees_of_freedom.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/stacked.hpp"

namespace tactile_net {
namespace {

/// Cosines and sines of the frequencies 1 ... count / 2, for every channel.
Eigen::MatrixXd fourier_rows(Eigen::Index count, Eigen::Index channels) {
  const Eigen::Index bins = count / 2;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * bins * channels, count * channels);
  for (Eigen::Index k = 0; k < bins; ++k)
    for (Eigen::Index i = 0; i < count; ++i) {
      const double turn = static_cast<double>((k + 1) * i % count) / static_cast<double>(count);
      for (Eigen::Index c = 0; c < channels; ++c) {
        rows(2 * bins * c + k, count * c + i) = std::cos(2.0 * std::numbers::pi * turn);
        rows(2 * bins * c + bins + k, count * c + i) = std::sin(2.0 * std::numbers::pi * turn);
      }
    }
  return rows;
}

/// Of L, at most: of one traction's, times the heavier one's weight over the lighter one's.
double stabiliser_condition(const LinearProblem& problem) {
  const double last = stabiliser_weight(problem, as_eigen(problem.kernel).cols() - 1);
  return std::hypot(1.0, 2.0 * problem.smoothing_length / problem.grid.spacing_y) *
         std::max(last, 1.0 / last);
}

/// Of the columns of `edges` that are free.
StandardForm face(const LinearProblem& problem, const Constraints& constraints,
                  std::span<const std::size_t> free) {
  if (free.empty()) throw std::invalid_argument("every traction is held at zero: no family of any");
  const Matrix all = edges(problem, constraints);
  return {problem, as_eigen(all)(Eigen::indexing::all, std::vector(free.begin(), free.end()))};
}

/// Of readings in the space of rows: a matrix-vector product per alpha.
class DensePeriodogram final : public ResidualPeriodogram {
 public:
  /// @param outside  of the readings, what no traction explains
  DensePeriodogram(std::shared_ptr<const TikhonovFamily::Factors> factors, Eigen::VectorXd outside)
      : factors_(std::move(factors)), readings_(std::move(outside)), bins_(factors_->line / 2) {}

  [[nodiscard]] std::size_t size() const noexcept override { return bins_; }

  void power(std::span<const double> left, std::span<const double> change, std::span<double> values,
             std::span<double> slopes) const override {
    const Eigen::MatrixXd& spectra = factors_->spectra().of_u;
    const Eigen::VectorXd residual = spectra * as_eigen(left) + outside();
    const Eigen::VectorXd rate = spectra * as_eigen(change);
    std::fill(values.begin(), values.end(), 0.0);
    std::fill(slopes.begin(), slopes.end(), 0.0);
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      const auto bin = static_cast<std::size_t>(i) % bins_;
      values[bin] += residual(i) * residual(i);
      slopes[bin] += 2.0 * residual(i) * rate(i);
    }
  }

  void powers(std::span<const double> left, std::size_t components,
              std::span<double> values) const override {
    const auto rows = static_cast<Eigen::Index>(components);
    const Eigen::Map<const Eigen::MatrixXd> all(left.data(), rows, std::ssize(left) / rows);
    const Eigen::MatrixXd residuals = factors_->spectra().of_u * all;
    const Eigen::VectorXd& spectrum = outside();
    const auto bins = static_cast<Eigen::Index>(bins_);
    Eigen::Map<Eigen::MatrixXd> sums(values.data(), bins, all.cols());
    sums.setZero();
    for (Eigen::Index k = 0; k < residuals.rows(); k += bins)
      sums.array() +=
          (residuals.middleRows(k, bins).colwise() + spectrum.segment(k, bins)).array().square();
  }

 private:
  /// The spectrum of what no traction explains.
  [[nodiscard]] const Eigen::VectorXd& outside() const {
    std::call_once(outside_made_, [this] { outside_ = factors_->spectra().fourier * readings_; });
    return outside_;
  }

  std::shared_ptr<const TikhonovFamily::Factors> factors_;
  Eigen::VectorXd readings_;
  std::size_t bins_;
  mutable std::once_flag outside_made_{};
  mutable Eigen::VectorXd outside_{};
};

}  // namespace

TikhonovFamily::Factors::Factors(const LinearProblem& problem, StandardForm standard,
                                 double condition)
    : line(channel_length(problem)),
      weighting(problem),
      stabiliser_condition(condition),
      form(std::move(standard)),
      gamma(form.gamma.begin(), form.gamma.end()) {}

const TikhonovFamily::Factors::Spectra& TikhonovFamily::Factors::spectra() const {
  std::call_once(spectra_made_, [this] {
    // Noise is white in any order of the readings.
    const auto length = static_cast<Eigen::Index>(line);
    spectra_.fourier = fourier_rows(length, form.u.rows() / length);
    spectra_.of_u = spectra_.fourier * form.u;
  });
  return spectra_;
}

TikhonovFamily::TikhonovFamily(const LinearProblem& problem)
    : factors_(std::make_shared<const Factors>(problem, StandardForm(problem),
                                               stabiliser_condition(problem))) {}

TikhonovFamily::TikhonovFamily(const LinearProblem& problem, const Constraints& constraints,
                               std::span<const std::size_t> free) {
  StandardForm form = face(problem, constraints, free);
  const Eigen::VectorXd sizes = tactile_net::singular_values(form.triangle);
  factors_ =
      std::make_shared<const Factors>(problem, std::move(form), sizes(0) / sizes(sizes.size() - 1));
}
TikhonovFamily::~TikhonovFamily() = default;
TikhonovFamily::TikhonovFamily(TikhonovFamily&&) noexcept = default;
TikhonovFamily& TikhonovFamily::operator=(TikhonovFamily&&) noexcept = default;

std::span<const double> TikhonovFamily::singular_values() const noexcept { return factors_->gamma; }

double TikhonovFamily::condition(double alpha) const noexcept {
  const double root = std::sqrt(alpha);
  const bool wide = factors_->form.v.rows() > factors_->form.u.rows();  // some show in no reading
  return std::hypot(factors_->gamma.front(), root) /
         std::hypot(wide ? 0.0 : factors_->gamma.back(), root);
}

double TikhonovFamily::stacked_condition(double alpha) const noexcept {
  return factors_->stabiliser_condition * condition(alpha);
}

double TikhonovFamily::degrees_of_freedom(double alpha) const noexcept {
  return degrees_of_freedom_of(factors_->gamma, alpha);
}

FilterFrame TikhonovFamily::analyse(std::span<const double> readings) const {
  const Factors& factors = *factors_;
  check_readings(readings, static_cast<std::size_t>(factors.weighting.size()));

  FilterFrame frame{.gamma = factors.gamma, .beta = std::vector<double>(factors.gamma.size())};
  frame.rows = static_cast<std::size_t>(factors.weighting.rows());
  Eigen::VectorXd g = factors.weighting(readings);
  frame.scale = g.cwiseAbs().maxCoeff();
  if (frame.scale > 0.0) g = g / frame.scale;

  Eigen::Map<Eigen::VectorXd> beta(frame.beta.data(), std::ssize(frame.beta));
  beta = factors.form.u.transpose() * g;
  g -= factors.form.u * beta;
  frame.outside = g.norm();
  frame.periodogram = std::make_shared<DensePeriodogram>(factors_, std::move(g));
  return frame;
}

Reconstruction TikhonovFamily::reconstruction(double alpha) const {
  check_alpha(alpha);
  const Factors& factors = *factors_;
  const double root = std::sqrt(alpha);
  const StandardForm& form = factors.form;
  const Eigen::VectorXd sizes =
      form.gamma.unaryExpr([=](double gamma) { return std::hypot(gamma, root); });
  const Eigen::VectorXd filter = form.gamma.cwiseQuotient(sizes).cwiseQuotient(sizes);
  const Eigen::MatrixXd readings = factors.weighting.applied(form.u.transpose());

  // [W K; sqrt(alpha) L] has the singular values of this: its rotations are left out.
  const Eigen::Index n = form.v.rows();
  Eigen::MatrixXd components = form.v.transpose() * form.triangle;
  const bool wide = n > form.v.cols();  // some show in no reading
  Eigen::MatrixXd rotated(components.rows() + (wide ? n : 0), n);
  rotated.topRows(components.rows()) = sizes.asDiagonal() * components;
  if (wide) rotated.bottomRows(n) = root * (form.triangle - form.v * components);
  return {from_eigen(form.from_components(filter.asDiagonal() * readings)),
          StackedQr(rotated).condition()};
}

std::vector<double> TikhonovFamily::solve(const FilterFrame& frame, double alpha) const {
  check_alpha(alpha);
  check_same_family(frame, factors_->gamma);
  const Factors& factors = *factors_;
  const double root = std::sqrt(alpha);
  Eigen::VectorXd y(std::ssize(frame.beta));
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double size = std::hypot(frame.gamma[at], root);  // gamma^2 + alpha is its square
    y(i) = frame.beta[at] * (frame.gamma[at] / size) / size;
  }
  const Eigen::VectorXd f = factors.form.from_components(y) * frame.scale;
  return {f.begin(), f.end()};
}

}  // namespace tactile_net
