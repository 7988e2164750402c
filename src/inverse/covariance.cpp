#include "tactile_net/inverse/covariance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/window_sums.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {

using Eigen::Index;

std::vector<double> Covariance::deviations_of(std::span<const std::vector<double>> weights) const {
  std::vector<double> all;
  for (const std::vector<double>& one : weights) all.push_back(deviation(one));
  return all;
}

Matrix Covariance::covariances(std::span<const std::vector<double>> weights) const {
  const std::size_t count = weights.size();
  Matrix all{count, count, std::vector<double>(count * count)};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j <= i; ++j) all(i, j) = all(j, i) = covariance(weights[i], weights[j]);
  return all;
}

TractionCovariance::TractionCovariance(const TikhonovFamily& family, double alpha,
                                       double prior_alpha)
    : factors_(family.factors()), degrees_(family.degrees_of_freedom(alpha)) {
  check_alpha(alpha);
  check_alpha(prior_alpha);
  const double smoothing = std::sqrt(alpha);
  for (const double gamma : factors_->gamma) {
    // Noise gamma / (gamma^2 + alpha), and what is smoothed away alpha / (gamma^2 + alpha) of a
    // prior whose deviation is 1 / sqrt(prior_alpha).
    const double whole = std::hypot(gamma, smoothing);
    sizes_.push_back(std::hypot(gamma, smoothing * (smoothing / std::sqrt(prior_alpha))) / whole /
                     whole);
  }
  // What no reading shows is as large as the prior says.
  if (factors_->coordinates->count() > std::ssize(sizes_)) hidden_ = 1.0 / std::sqrt(prior_alpha);
}

namespace {

/// Of a sum's square without readings, what is hidden of it must be more than this share to be told
/// by the difference of squares; else rounding is larger than a billionth of the prior's deviation.
constexpr double least_hidden_share = 1e-10;

}  // namespace

std::vector<double> TractionCovariance::row_deviations(const SurfaceGrid* grid,
                                                       const CellWindow& window) const {
  const TractionCoordinates& coordinates = *factors_->coordinates;
  const std::shared_ptr<const RowMajor> roots =
      grid != nullptr ? factors_->window_roots(*grid, window) : factors_->roots();
  Eigen::VectorXd most;  // what the squares would be without readings and a deviation of 1
  if (hidden_ != 0.0)
    most = grid != nullptr ? coordinates.squares(*grid, window) : coordinates.squares();
  const auto scales = as_eigen(std::span(sizes_)).transpose();
  std::vector<double> result(static_cast<std::size_t>(roots->rows()));
  for (Index i = 0; i < roots->rows(); ++i) {
    double& one = result[static_cast<std::size_t>(i)];
    one = roots->row(i).cwiseProduct(scales).norm();
    if (hidden_ == 0.0) continue;
    const double left = most(i) - roots->row(i).squaredNorm();
    if (left >= least_hidden_share * most(i)) {
      one = std::hypot(one, hidden_ * std::sqrt(left));
      continue;
    }
    std::vector<double> sum(static_cast<std::size_t>(coordinates.traction_count()));
    sum[static_cast<std::size_t>(i)] = 1.0;
    if (grid != nullptr) window_sums(*grid, window, std::span(sum).first(grid->count()));
    one = deviations_by_sums(std::array{std::move(sum)}).front();
  }
  return result;
}

std::vector<double> TractionCovariance::deviations() const { return row_deviations(nullptr, {}); }

std::vector<double> TractionCovariance::window_deviations(const SurfaceGrid& grid,
                                                          const CellWindow& window) const {
  return row_deviations(&grid, window);
}

double TractionCovariance::deviation(std::span<const double> weights) const {
  return deviations_of(std::array{std::vector<double>(weights.begin(), weights.end())}).front();
}

/// Of each of several sums a column: what the readings tell of it, and what none shows.
struct TractionCovariance::Sums {
  Eigen::MatrixXd known;
  Eigen::MatrixXd hidden;  // without rows: nothing is
};

TractionCovariance::Sums TractionCovariance::sums(
    std::span<const std::vector<double>> weights) const {
  Eigen::MatrixXd all(factors_->coordinates->traction_count(), std::ssize(weights));
  for (Index k = 0; k < all.cols(); ++k) {
    const std::vector<double>& one = weights[static_cast<std::size_t>(k)];
    check_weights(one, static_cast<std::size_t>(all.rows()));
    all.col(k) = as_eigen(std::span(one));
  }
  const Eigen::MatrixXd coordinates = factors_->coordinates->sums(all);
  const Eigen::MatrixXd components = factors_->components(coordinates);
  Sums result{as_eigen(std::span(sizes_)).asDiagonal() * components, {}};
  if (hidden_ != 0.0)
    result.hidden = hidden_ * (coordinates - factors_->from_components(components));
  return result;
}

std::vector<double> TractionCovariance::deviations_by_sums(
    std::span<const std::vector<double>> weights) const {
  const Sums all = sums(weights);
  std::vector<double> result(weights.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    const auto column = static_cast<Index>(k);
    result[k] = std::hypot(all.known.col(column).norm(),
                           all.hidden.size() > 0 ? all.hidden.col(column).norm() : 0.0);
  }
  return result;
}

double TractionCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  const std::array<std::vector<double>, 2> both{std::vector<double>(a.begin(), a.end()),
                                                std::vector<double>(b.begin(), b.end())};
  return covariances(both)(0, 1);
}

Matrix TractionCovariance::covariances(std::span<const std::vector<double>> weights) const {
  const Sums all = sums(weights);
  RowMajor result = all.known.transpose() * all.known;
  if (all.hidden.size() > 0) result += all.hidden.transpose() * all.hidden;
  return from_eigen(result);
}

namespace {

/// The few tractions that a sum is over.
struct Few {
  static constexpr std::size_t most = 3;
  std::array<Index, most> tractions{};
  std::array<double, most> weights{};
  std::size_t count = 0;
};

/// Absent: there are more, or two of one component, which T T' joins.
std::optional<Few> few_of(std::span<const double> weights, Index cells) {
  Few few;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    const auto at = static_cast<Index>(i);
    for (std::size_t k = 0; k < few.count; ++k)
      if (few.tractions[k] / cells == at / cells) return std::nullopt;
    if (few.count == Few::most) return std::nullopt;
    few.tractions[few.count] = at;
    few.weights[few.count++] = weights[i];
  }
  return few;
}

}  // namespace

std::vector<double> TractionCovariance::deviations_of(
    std::span<const std::vector<double>> weights) const {
  const TractionCoordinates& coordinates = *factors_->coordinates;
  const Index cells = coordinates.component_size();
  const auto sizes = as_eigen(std::span(sizes_)).transpose();
  std::shared_ptr<const RowMajor> roots;  // with what follows, of sums over few
  Eigen::VectorXd most;
  std::vector<double> result(weights.size());
  std::vector<std::vector<double>> others;  // over their largest weight
  std::vector<std::pair<std::size_t, double>> places;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    check_weights(weights[k], static_cast<std::size_t>(coordinates.traction_count()));
    double largest = 0.0;
    for (const double weight : weights[k]) largest = std::max(largest, std::abs(weight));
    if (!(largest > 0.0)) continue;
    const auto by_sums = [&] {
      others.push_back(weights[k]);
      for (double& weight : others.back()) weight /= largest;
      places.emplace_back(k, largest);
    };
    const std::optional<Few> few = cells > 0 ? few_of(weights[k], cells) : std::nullopt;
    if (!few) {
      by_sums();
      continue;
    }
    if (!roots) {
      roots = factors_->roots();
      most = coordinates.squares();
    }
    Eigen::RowVectorXd shown = Eigen::RowVectorXd::Zero(sizes.size());
    double all = 0.0;
    for (std::size_t i = 0; i < few->count; ++i) {
      const double share = few->weights[i] / largest;
      shown += share * roots->row(few->tractions[i]);
      all += share * share * most(few->tractions[i]);
    }
    const double left = hidden_ == 0.0 ? 0.0 : all - shown.squaredNorm();
    if (hidden_ != 0.0 && left < least_hidden_share * all)
      by_sums();
    else
      result[k] = largest * std::hypot(shown.cwiseProduct(sizes).norm(), hidden_ * std::sqrt(left));
  }
  if (others.empty()) return result;
  const std::vector<double> found = deviations_by_sums(others);
  for (std::size_t k = 0; k < found.size(); ++k)
    result[places[k].first] = places[k].second * found[k];
  return result;
}

RootCovariance::RootCovariance(Matrix root, double degrees_of_freedom)
    : root_(std::move(root)), degrees_(degrees_of_freedom) {}

std::vector<double> RootCovariance::deviations() const {
  const Eigen::VectorXd norms = as_eigen(root_).rowwise().norm();
  return {norms.begin(), norms.end()};
}

double RootCovariance::deviation(std::span<const double> weights) const {
  check_weights(weights, root_.rows);
  return (as_eigen(root_).transpose() * as_eigen(weights)).norm();
}

double RootCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  check_weights(a, root_.rows);
  check_weights(b, root_.rows);
  const auto root = as_eigen(root_).transpose();
  const Eigen::VectorXd of_a = root * as_eigen(a);
  const Eigen::VectorXd of_b = root * as_eigen(b);
  return of_a.dot(of_b);
}

ModelErrorCovariance::ModelErrorCovariance(const Covariance& without,
                                           std::span<const double> tractions,
                                           std::size_t components, double share)
    : without_(without),
      tractions_(tractions.begin(), tractions.end()),
      components_(components),
      share_(share) {}

double ModelErrorCovariance::added(std::span<const double> a, std::span<const double> b) const {
  check_weights(a, tractions_.size());
  check_weights(b, tractions_.size());
  const std::size_t each = tractions_.size() / components_;
  double sum = 0.0;
  for (std::size_t first = 0; first < tractions_.size(); first += each) {
    const auto f = as_eigen(std::span(tractions_).subspan(first, each));
    sum += share_ * f.dot(as_eigen(a.subspan(first, each))) *
           (share_ * f.dot(as_eigen(b.subspan(first, each))));
  }
  return sum;
}

std::vector<double> ModelErrorCovariance::deviations() const {
  std::vector<double> all = without_.deviations();
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::hypot(all[i], share_ * tractions_[i]);
  return all;
}

double ModelErrorCovariance::deviation(std::span<const double> weights) const {
  return std::hypot(without_.deviation(weights), std::sqrt(added(weights, weights)));
}

double ModelErrorCovariance::covariance(std::span<const double> a,
                                        std::span<const double> b) const {
  return without_.covariance(a, b) + added(a, b);
}

std::vector<double> ModelErrorCovariance::deviations_of(
    std::span<const std::vector<double>> weights) const {
  std::vector<double> all = without_.deviations_of(weights);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = std::hypot(all[i], std::sqrt(added(weights[i], weights[i])));
  return all;
}

Matrix ModelErrorCovariance::covariances(std::span<const std::vector<double>> weights) const {
  Matrix all = without_.covariances(weights);
  for (std::size_t i = 0; i < all.rows; ++i)
    for (std::size_t j = 0; j < all.columns; ++j) all(i, j) += added(weights[i], weights[j]);
  return all;
}

MixtureCovariance::MixtureCovariance(std::vector<Term> terms) : terms_(std::move(terms)) {
  if (terms_.empty()) throw std::invalid_argument("a mixture of estimates needs one at least");
  for (const Term& term : terms_)
    if (term.difference.size() != terms_.front().difference.size())
      throw std::invalid_argument(
          "the estimates of a mixture differ in size: take estimates of the same tractions");
}

std::vector<double> MixtureCovariance::deviations() const {
  std::vector<double> all(terms_.front().difference.size());
  for (const auto& [probability, covariance, difference] : terms_) {
    const double share = std::sqrt(probability);
    const std::vector<double> own = covariance->deviations();
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = std::hypot(all[i], share * own[i], share * difference[i]);
  }
  return all;
}

double MixtureCovariance::deviation(std::span<const double> weights) const {
  double size = 0.0;
  for (const auto& [probability, covariance, difference] : terms_) {
    check_weights(weights, difference.size());
    const double share = std::sqrt(probability);
    size = std::hypot(size, share * covariance->deviation(weights),
                      share * as_eigen(std::span(difference)).dot(as_eigen(weights)));
  }
  return size;
}

double MixtureCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  double sum = 0.0;
  for (const auto& [probability, covariance, difference] : terms_) {
    check_weights(a, difference.size());
    check_weights(b, difference.size());
    const auto d = as_eigen(std::span(difference));
    sum += probability * (covariance->covariance(a, b) + d.dot(as_eigen(a)) * d.dot(as_eigen(b)));
  }
  return sum;
}

double MixtureCovariance::degrees_of_freedom() const noexcept {
  double sum = 0.0;
  for (const Term& term : terms_) sum += term.probability * term.covariance->degrees_of_freedom();
  return sum;
}

}  // namespace tactile_net
