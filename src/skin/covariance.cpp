#include "tactile_net/skin/covariance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "skin/family_factors.hpp"

namespace tactile_net {

using Eigen::Index;

SkinCovariance::SkinCovariance(const SkinFamily& family, double alpha, double prior_alpha)
    : factors_(family.factors()), degrees_(family.degrees_of_freedom(alpha)) {
  check_alpha(alpha);
  check_alpha(prior_alpha);
  const double smoothing = std::sqrt(alpha);
  for (const double gamma : factors_->gamma) {
    // As TractionCovariance has it: noise, and what is smoothed away of the prior.
    const double whole = std::hypot(gamma, smoothing);
    sizes_.push_back(std::hypot(gamma, smoothing * (smoothing / std::sqrt(prior_alpha))) / whole /
                     whole);
  }
  if (factors_->coordinates->count() > std::ssize(sizes_)) hidden_ = 1.0 / std::sqrt(prior_alpha);
}

namespace {

/// Of sums of tractions, a row each of T V (`SkinFamily::Factors::roots`) summed alike.
///
/// @param sizes   of components
/// @param hidden  standard deviation of what no reading shows; 0: there is nothing
/// @param most    what the squares would be without readings and a deviation of 1; unread if
///                hidden is 0
std::vector<double> row_deviations(const RowMajor& roots, std::span<const double> sizes,
                                   double hidden, const Eigen::VectorXd& most) {
  const auto scales = as_eigen(sizes).transpose();
  std::vector<double> result(static_cast<std::size_t>(roots.rows()));
  for (Index i = 0; i < roots.rows(); ++i) {
    double& one = result[static_cast<std::size_t>(i)];
    one = roots.row(i).cwiseProduct(scales).norm();
    if (hidden == 0.0) continue;
    const double left = std::max(most(i) - roots.row(i).squaredNorm(), 0.0);
    one = std::hypot(one, hidden * std::sqrt(left));
  }
  return result;
}

}  // namespace

std::vector<double> SkinCovariance::deviations() const {
  return row_deviations(*factors_->roots(), sizes_, hidden_,
                        hidden_ == 0.0 ? Eigen::VectorXd() : factors_->coordinates->squares());
}

std::vector<double> SkinCovariance::window_deviations(const SurfaceGrid& grid,
                                                      const CellWindow& window) const {
  return row_deviations(
      *factors_->window_roots(grid, window), sizes_, hidden_,
      hidden_ == 0.0 ? Eigen::VectorXd() : factors_->coordinates->squares(grid, window));
}

double SkinCovariance::deviation(std::span<const double> weights) const {
  const std::array<std::vector<double>, 1> one{std::vector<double>(weights.begin(), weights.end())};
  return deviations_of(one).front();
}

/// Of each of several sums a column: what the readings tell of it, and what none shows.
struct SkinCovariance::Sums {
  Eigen::MatrixXd known;
  Eigen::MatrixXd hidden;  // without rows: nothing is
};

SkinCovariance::Sums SkinCovariance::sums(std::span<const std::vector<double>> weights) const {
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

double SkinCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  const std::array<std::vector<double>, 2> both{std::vector<double>(a.begin(), a.end()),
                                                std::vector<double>(b.begin(), b.end())};
  return covariances(both)(0, 1);
}

Matrix SkinCovariance::covariances(std::span<const std::vector<double>> weights) const {
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

std::vector<double> SkinCovariance::deviations_of(
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
    const std::optional<Few> few = cells > 0 ? few_of(weights[k], cells) : std::nullopt;
    if (!few) {
      others.push_back(weights[k]);
      for (double& weight : others.back()) weight /= largest;
      places.emplace_back(k, largest);
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
    const double left = hidden_ == 0.0 ? 0.0 : std::max(all - shown.squaredNorm(), 0.0);
    result[k] = largest * std::hypot(shown.cwiseProduct(sizes).norm(), hidden_ * std::sqrt(left));
  }
  if (others.empty()) return result;
  const Sums sums_of_others = sums(others);
  for (std::size_t k = 0; k < others.size(); ++k) {
    const auto column = static_cast<Index>(k);
    const double hidden =
        sums_of_others.hidden.size() > 0 ? sums_of_others.hidden.col(column).norm() : 0.0;
    result[places[k].first] =
        places[k].second * std::hypot(sums_of_others.known.col(column).norm(), hidden);
  }
  return result;
}

}  // namespace tactile_net
