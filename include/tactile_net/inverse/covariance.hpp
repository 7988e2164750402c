/// @file
/// The covariance of the tractions' errors: how far they may be from the truth.
///
/// Take the noise for white, and L f for white too, with the variance sigma^2 / prior_alpha. Then
/// the error of Tikhonov's minimiser has, in the basis of the generalised singular vectors, the
/// variance
///
///     sigma^2 (gamma^2 + alpha^2 / prior_alpha) / (gamma^2 + alpha)^2
///
/// noise and what alpha smooths away, together; for prior_alpha = alpha it is the posterior
/// covariance sigma^2 P^-1 (Wahba 1983; Kaipio and Somersalo 2005, 3.4). The prior's size is
/// estimated best by the rule gml, which is its maximum likelihood. On average over the array two
/// deviations then hold at least 95 % of the true values, if pad and noise are as stated, though
/// not at every point of it: less at a contact's edge, more where nothing touches. An error of the
/// model (kernels, pad, positions) is not in it; `NoiseEstimate` shows it apart.
///
///     const double prior = choose_alone(frame, AlphaRule::gml).alpha;  // alpha.hpp
///     const TractionCovariance covariance(family, alpha, prior);
///     const std::vector<double> deviations = covariance.deviations();  // times the noise: bands
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/sensing/surface_grid.hpp"

namespace tactile_net {

/// The covariance of the tractions' errors.
class Covariance {
 public:
  Covariance() = default;
  Covariance(const Covariance&) = delete;
  Covariance& operator=(const Covariance&) = delete;
  virtual ~Covariance() = default;

  /// Standard deviation of every traction per unit of `noise_rms` [Pa].
  [[nodiscard]] virtual std::vector<double> deviations() const = 0;

  /// Standard deviation of sum_i weights_i f_i per unit of `noise_rms`.
  [[nodiscard]] virtual double deviation(std::span<const double> weights) const = 0;

  /// Covariance of a sum with weights `a` and one with weights `b`, per unit of `noise_rms`
  /// squared.
  [[nodiscard]] virtual double covariance(std::span<const double> a,
                                          std::span<const double> b) const = 0;

  /// `deviation` of each of several sums. By default one after the other.
  [[nodiscard]] virtual std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const;
  /// Matrix of the `covariance` of each sum with each. By default pair after pair.
  [[nodiscard]] virtual Matrix covariances(std::span<const std::vector<double>> weights) const;

  /// tr H: how many of the readings' degrees of freedom the tractions use up.
  [[nodiscard]] virtual double degrees_of_freedom() const noexcept = 0;

 protected:
  Covariance(Covariance&&) = default;
  Covariance& operator=(Covariance&&) = default;
};

/// A covariance that knows sums over windows of the grid: such a sum is certain where single narrow
/// cells are not.
class CellCovariance : public Covariance {
 public:
  /// Standard deviation of the sum of the normal tractions in the window around each cell, per unit
  /// of `noise_rms` [Pa]. A window of 0 rows and columns gives `deviations` of the normal
  /// tractions.
  [[nodiscard]] virtual std::vector<double> window_deviations(const SurfaceGrid& grid,
                                                              const CellWindow& window) const = 0;
};

/// The covariance of what `TikhonovFamily::solve` finds; with a family on a face, of what a solver
/// under constraints finds there: directions that the face holds are taken to be exact. It is never
/// formed, and is worked out class by class.
class TractionCovariance final : public CellCovariance {
 public:
  /// O(columns). Shares the family's factors.
  ///
  /// @param prior_alpha  > 0; the same as alpha: the posterior covariance
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  TractionCovariance(const TikhonovFamily& family, double alpha, double prior_alpha);

  /// O(columns x readings); the first call for a family also transforms each component.
  [[nodiscard]] std::vector<double> deviations() const override;
  /// Costs as much as `deviations`, and the sums over windows.
  [[nodiscard]] std::vector<double> window_deviations(const SurfaceGrid& grid,
                                                      const CellWindow& window) const override;
  /// O(columns x readings), class by class.
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// One product for all sums. Sums over a single traction of each component, as the margin of a
  /// cell is, take O(readings) each.
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return degrees_; }

 private:
  struct Sums;
  [[nodiscard]] Sums sums(std::span<const std::vector<double>> weights) const;
  /// Of every traction, or with a grid of the sum over the window around each of its cells.
  [[nodiscard]] std::vector<double> row_deviations(const SurfaceGrid* grid,
                                                   const CellWindow& window) const;
  [[nodiscard]] std::vector<double> deviations_by_sums(
      std::span<const std::vector<double>> weights) const;

  std::shared_ptr<const TikhonovFamily::Factors> factors_;

  std::vector<double> sizes_{};  // standard deviation of each component
  double hidden_ = 0.0;          // of what no reading shows
  double degrees_;
};

/// A covariance given by its root S.
class RootCovariance final : public Covariance {
 public:
  /// @param root  C = S S' per unit of the noise's variance: a row for each traction; without a
  ///              column every traction is certain
  /// @param degrees_of_freedom  tr H
  RootCovariance(Matrix root, double degrees_of_freedom);

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override { return degrees_; }

 private:
  Matrix root_;
  double degrees_;
};

/// A covariance with what the pad's formula may be off by beside it: a factor of each component of
/// the tractions, which is 1 but for a standard deviation that is the same for all. Refers to the
/// covariance without.
class ModelErrorCovariance final : public Covariance {
 public:
  /// @param tractions   the estimate [Pa], components x values
  /// @param components  1 to 3
  /// @param share       the factors' standard deviation over the noise's rms, >= 0
  ModelErrorCovariance(const Covariance& without, std::span<const double> tractions,
                       std::size_t components, double share);

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override {
    return without_.degrees_of_freedom();
  }

 private:
  /// Of two sums: what the factors add.
  [[nodiscard]] double added(std::span<const double> a, std::span<const double> b) const;

  const Covariance& without_;
  std::vector<double> tractions_;
  std::size_t components_;
  double share_;
};

/// The covariance of a mixture of estimates, sum p [C + d d'] (law of total variance): of an answer
/// that is none of them, or where nobody knows which one is right.
class MixtureCovariance final : public Covariance {
 public:
  /// One of the estimates.
  struct Term {
    double probability = 1.0;                        ///< p, >= 0
    std::shared_ptr<const Covariance> covariance{};  ///< C, of the estimate
    std::vector<double> difference{};  ///< d, answer less estimate, over the noise's rms
  };
  /// @throw std::invalid_argument  there is no term, or their differences differ in size
  explicit MixtureCovariance(std::vector<Term> terms);

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// The terms' mean.
  [[nodiscard]] double degrees_of_freedom() const noexcept override;

 private:
  std::vector<Term> terms_;
};

}  // namespace tactile_net
