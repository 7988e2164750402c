#include "tactile_net/inverse/tikhonov_family.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/degrees_of_freedom.hpp"
#include "inverse/face_coordinates.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/stacked.hpp"
#include "inverse/window_sums.hpp"
#include "numeric/decompositions.hpp"
#include "tactile_net/inverse/error_bound.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

/// Cosines and sines of the frequencies 1 ... count / 2, for every channel.
Eigen::MatrixXd fourier_rows(Index count, Index channels) {
  const Index bins = count / 2;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * bins * channels, count * channels);
  for (Index k = 0; k < bins; ++k)
    for (Index i = 0; i < count; ++i) {
      const double turn = static_cast<double>((k + 1) * i % count) / static_cast<double>(count);
      for (Index c = 0; c < channels; ++c) {
        rows(2 * bins * c + k, count * c + i) = std::cos(2.0 * std::numbers::pi * turn);
        rows(2 * bins * c + bins + k, count * c + i) = std::sin(2.0 * std::numbers::pi * turn);
      }
    }
  return rows;
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
    for (Index i = 0; i < residual.size(); ++i) {
      const auto bin = static_cast<std::size_t>(i) % bins_;
      values[bin] += residual(i) * residual(i);
      slopes[bin] += 2.0 * residual(i) * rate(i);
    }
  }

  void powers(std::span<const double> left, std::size_t components,
              std::span<double> values) const override {
    if (bins_ == 0) return;
    const auto bins = static_cast<Index>(bins_);
    const Index count = std::ssize(values) / bins;
    const Eigen::Map<const Eigen::MatrixXd> all(left.data(), static_cast<Index>(components), count);
    const Eigen::MatrixXd residuals = factors_->spectra().of_u * all;
    const Eigen::VectorXd& spectrum = outside();
    Eigen::Map<Eigen::MatrixXd> sums(values.data(), bins, count);
    sums.setZero();
    for (Index k = 0; k < residuals.rows(); k += bins)
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

bool is_kept(const RowMajor& roots) {
  constexpr std::size_t most = std::size_t{256} << 20;  // bytes
  return static_cast<std::size_t>(roots.size()) * sizeof(double) <= most;
}

/// The most by which L stretches one traction more than another.
double condition_of_stabiliser(const LinearProblem& problem) {
  const Eigen::VectorXd spectrum = stabiliser_spectrum(problem);
  return std::sqrt(spectrum.maxCoeff() / spectrum.minCoeff());
}

/// sqrt(gamma^2 + alpha), nothing squared.
Eigen::VectorXd stacked_sizes(const Eigen::VectorXd& gammas, double alpha) {
  const double root = std::sqrt(alpha);
  return gammas.unaryExpr([=](double gamma) { return std::hypot(gamma, root); });
}

/// gamma / (gamma^2 + alpha), nothing squared.
double tikhonov_filter(double gamma, double alpha) {
  const double size = std::hypot(gamma, std::sqrt(alpha));
  return gamma / size / size;
}

}  // namespace

TikhonovFamily::Factors::Factors(const LinearProblem& problem,
                                 std::shared_ptr<const TractionCoordinates> basis,
                                 std::vector<MirrorClass> classes)
    : line(problem.is_line ? channel_length(problem) : 0),
      weighting(problem),
      coordinates(std::move(basis)),
      stabiliser_condition(condition_of_stabiliser(problem)) {
  for (MirrorClass& part : classes) {
    const Eigen::MatrixXd transposed =
        coordinates->sums_of(part.waves, folded_kernel(as_eigen(problem.kernel), part));
    Block block{.part = std::move(part)};
    if (transposed.size() > 0) {
      Svd svd = long_singular_value_decomposition(transposed);
      block.u = std::move(svd.v);
      block.v = std::move(svd.u);
      block.gamma = std::move(svd.values);
    } else {
      block.u.resize(transposed.cols(), 0);
      block.v.resize(transposed.rows(), 0);
    }
    gamma.insert(gamma.end(), block.gamma.begin(), block.gamma.end());
    blocks.push_back(std::move(block));
  }
}

Eigen::MatrixXd TikhonovFamily::Factors::components(const Eigen::MatrixXd& from) const {
  Eigen::MatrixXd result(std::ssize(gamma), from.cols());
  Index first = 0;
  for (const Block& block : blocks) {
    result.middleRows(first, block.gamma.size()) =
        block.v.transpose() * from(block.part.waves, Eigen::indexing::all);
    first += block.gamma.size();
  }
  return result;
}

Eigen::MatrixXd TikhonovFamily::Factors::from_components(const Eigen::MatrixXd& from) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(coordinates->count(), from.cols());
  Index first = 0;
  for (const Block& block : blocks) {
    result(block.part.waves, Eigen::indexing::all) =
        block.v * from.middleRows(first, block.gamma.size());
    first += block.gamma.size();
  }
  return result;
}

Eigen::MatrixXd TikhonovFamily::Factors::left_vectors() const {
  Eigen::MatrixXd result(weighting.size(), std::ssize(gamma));
  Index first = 0;
  for (const Block& block : blocks) {
    result.middleCols(first, block.gamma.size()) = block.part.readings.transpose() * block.u;
    first += block.gamma.size();
  }
  return result;
}

double TikhonovFamily::Factors::stacked_condition(double alpha) const {
  const Eigen::VectorXd stretch = coordinates->stretch();
  double most = 0.0;
  double least = std::numeric_limits<double>::infinity();
  Index rows = 0;
  for (const Block& block : blocks) {
    const Index n = std::ssize(block.part.waves);
    if (n == 0) continue;
    // Rotations are left out: T^-1 and U.
    const Eigen::MatrixXd own = Eigen::VectorXd(stretch(block.part.waves)).asDiagonal();
    const Eigen::MatrixXd shown = block.v.transpose() * own;
    const bool wide = n > shown.rows();  // some show in no reading
    Eigen::MatrixXd stacked(shown.rows() + (wide ? n : 0), n);
    stacked.topRows(shown.rows()) = stacked_sizes(block.gamma, alpha).asDiagonal() * shown;
    if (wide) stacked.bottomRows(n) = std::sqrt(alpha) * (own - block.v * shown);
    const Eigen::VectorXd sizes = tactile_net::singular_values(StackedQr(stacked).triangle());
    most = std::max(most, sizes(0));
    least = std::min(least, sizes(n - 1));
    rows += stacked.rows();
  }
  require_full_rank(most / least, static_cast<std::size_t>(rows));
  return most / least;
}

std::shared_ptr<const RowMajor> TikhonovFamily::Factors::roots() const {
  const std::lock_guard lock(kept_.mutex);
  if (kept_.roots) return kept_.roots;
  auto made = std::make_shared<RowMajor>(coordinates->traction_count(), std::ssize(gamma));
  Index first = 0;
  for (const Block& block : blocks) {
    Eigen::MatrixXd vectors = Eigen::MatrixXd::Zero(coordinates->count(), block.gamma.size());
    vectors(block.part.waves, Eigen::indexing::all) = block.v;
    made->middleCols(first, block.gamma.size()) = coordinates->tractions(vectors);
    first += block.gamma.size();
  }
  if (is_kept(*made)) kept_.roots = made;
  return made;
}

std::shared_ptr<const RowMajor> TikhonovFamily::Factors::window_roots(
    const SurfaceGrid& grid, const CellWindow& window) const {
  const std::shared_ptr<const RowMajor> cells = roots();
  const std::lock_guard lock(kept_.mutex);
  if (kept_.windows && kept_.windows->first.rows == window.rows &&
      kept_.windows->first.columns == window.columns)
    return kept_.windows->second;
  Eigen::MatrixXd sums = cells->topRows(static_cast<Index>(grid.count()));
  for (Index j = 0; j < sums.cols(); ++j)
    window_sums(grid, window, std::span(sums.col(j).data(), grid.count()));
  auto made = std::make_shared<const RowMajor>(sums);
  if (is_kept(*made)) kept_.windows.emplace(window, made);
  return made;
}

const TikhonovFamily::Factors::Spectra& TikhonovFamily::Factors::spectra() const {
  std::call_once(spectra_made_, [this] {
    // Noise is white in any order of the readings.
    const auto length = static_cast<Index>(line);
    spectra_.fourier = fourier_rows(length, weighting.size() / length);
    spectra_.of_u = spectra_.fourier * left_vectors();
  });
  return spectra_;
}

TikhonovFamily::TikhonovFamily(const LinearProblem& problem)
    : factors_(
          std::make_shared<const Factors>(problem,
                                          std::make_shared<const WaveCoordinates>(
                                              problem, stabiliser_spectrum(problem).cwiseSqrt()),
                                          mirror_classes(problem))) {}

TikhonovFamily::TikhonovFamily(const LinearProblem& problem, const ActiveFace& face) {
  auto coordinates = std::make_shared<const FaceCoordinates>(problem, face);
  std::vector<MirrorClass> whole{whole_class(problem, coordinates->count())};
  factors_ = std::make_shared<const Factors>(problem, std::move(coordinates), std::move(whole));
}
TikhonovFamily::~TikhonovFamily() = default;
TikhonovFamily::TikhonovFamily(TikhonovFamily&&) noexcept = default;
TikhonovFamily& TikhonovFamily::operator=(TikhonovFamily&&) noexcept = default;

std::span<const double> TikhonovFamily::singular_values() const noexcept { return factors_->gamma; }

std::size_t TikhonovFamily::classes() const noexcept { return factors_->blocks.size(); }

double TikhonovFamily::condition(double alpha) const noexcept {
  const double root = std::sqrt(alpha);
  const std::vector<double>& gamma = factors_->gamma;
  if (gamma.empty()) return 1.0;  // no reading depends on the tractions
  const auto [least, most] = std::minmax_element(gamma.begin(), gamma.end());
  const bool wide = factors_->coordinates->count() > std::ssize(gamma);
  return std::hypot(*most, root) / std::hypot(wide ? 0.0 : *least, root);
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
  FilterFrame frame{.gamma = factors.gamma,
                    .rows = static_cast<std::size_t>(factors.weighting.rows())};
  Eigen::VectorXd g = factors.weighting(readings);
  frame.scale = g.cwiseAbs().maxCoeff();
  if (frame.scale > 0.0) g = g / frame.scale;
  Eigen::VectorXd outside = Eigen::VectorXd::Zero(g.size());
  for (const Factors::Block& block : factors.blocks) {
    Eigen::VectorXd own = block.part.readings * g;
    const Eigen::VectorXd beta = block.u.transpose() * own;
    own -= block.u * beta;
    frame.beta.insert(frame.beta.end(), beta.begin(), beta.end());
    frame.outside = std::hypot(frame.outside, own.norm());
    if (factors.line > 0) outside += block.part.readings.transpose() * own;
  }
  if (factors.line > 0)
    frame.periodogram = std::make_shared<DensePeriodogram>(factors_, std::move(outside));
  return frame;
}

std::vector<double> TikhonovFamily::solve(const FilterFrame& frame, double alpha) const {
  check_alpha(alpha);
  check_same_family(frame, factors_->gamma);
  Eigen::VectorXd y(std::ssize(frame.beta));
  for (Index i = 0; i < y.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    y(i) = frame.beta[at] * tikhonov_filter(frame.gamma[at], alpha);
  }
  const Eigen::VectorXd f =
      factors_->coordinates->tractions(factors_->from_components(y)) * frame.scale;
  return {f.begin(), f.end()};
}

Matrix TikhonovFamily::matrix(double alpha) const {
  check_alpha(alpha);
  const Factors& factors = *factors_;
  Eigen::MatrixXd coordinates =
      Eigen::MatrixXd::Zero(factors.coordinates->count(), factors.weighting.size());
  for (const Factors::Block& block : factors.blocks) {
    const Eigen::VectorXd filters =
        block.gamma.unaryExpr([=](double gamma) { return tikhonov_filter(gamma, alpha); });
    const Eigen::MatrixXd own = block.v * filters.asDiagonal() * block.u.transpose();
    coordinates(block.part.waves, Eigen::indexing::all) =
        factors.weighting.applied(Eigen::MatrixXd(own * block.part.readings));
  }
  Matrix result = from_eigen(factors.coordinates->tractions(coordinates));
  check_finite(result);
  return result;
}

Reconstruction TikhonovFamily::reconstruction(double alpha) const {
  const Factors& factors = *factors_;
  const bool exactly = factors.line > 0 && factors.coordinates->stretch().size() > 0;
  const Matrix inverse = matrix(alpha);
  return {inverse, exactly ? factors.stacked_condition(alpha) : stacked_condition(alpha)};
}

}  // namespace tactile_net
