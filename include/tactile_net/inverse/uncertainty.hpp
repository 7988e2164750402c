/// @file
/// How far the tractions may be from the truth: bands, and what they mean for the contact's force.
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
///     const TractionCovariance covariance(problem, alpha, prior);
///     const std::vector<double> deviations = covariance.deviations();  // times the noise: bands
///     const UncertainResultant contact = resultant_of(problem, tractions, covariance, noise_rms);
///     contact.normal.deviation;              // [N/m]; examples/04_uncertainty.cpp
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/sensing/surface.hpp"

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

class TractionCovariance final : public Covariance {
 public:
  /// The covariance of what `tikhonov` finds, by its family. C is never formed. O(columns^3), one
  /// product.
  ///
  /// @param prior_alpha  > 0; the same as alpha: the posterior covariance
  /// @throw std::invalid_argument  alpha or prior_alpha is not > 0 and finite
  TractionCovariance(const TikhonovFamily& family, double alpha, double prior_alpha);

  /// The covariance of what `tikhonov` finds, without a family: O((m + n) n^2).
  TractionCovariance(const LinearProblem& problem, double alpha, double prior_alpha);

  /// The covariance of what `ConstrainedTikhonov` finds, on the face that its free variables span:
  /// variables held at zero are taken to be exact.
  ///
  /// @param free  columns of `edges`, as in `ConstrainedSolution`; none: all are exact
  TractionCovariance(const LinearProblem& problem, double alpha, double prior_alpha,
                     const Constraints& constraints, std::span<const std::size_t> free);

  /// One of several estimates, for the error of an answer beside it: the covariance of the mixture
  /// is sum p [C + d d'] (law of total variance).
  struct MixtureTerm {
    double probability = 1.0;                        ///< p, >= 0
    const TractionCovariance* covariance = nullptr;  ///< C, of the estimate
    std::vector<double> difference{};  ///< d, answer less estimate, over the noise's rms
  };
  /// The covariance of a mixture of estimates: of an answer that is none of them, or where nobody
  /// knows which one is right.
  /// @throw std::invalid_argument  there is no term, or their sizes differ
  explicit TractionCovariance(std::span<const MixtureTerm> terms);

  /// A covariance given by its root S.
  ///
  /// @param root  C = S S' per unit of the noise's variance: a row for each traction
  /// @param degrees_of_freedom  tr H
  TractionCovariance(const Matrix& root, double degrees_of_freedom);
  ~TractionCovariance() override;
  TractionCovariance(TractionCovariance&&) noexcept;
  TractionCovariance& operator=(TractionCovariance&&) noexcept;

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override;

 private:
  struct Factor;
  std::unique_ptr<const Factor> factor_;
};

/// The noise as the residual shows it, beside the noise that was stated.
struct NoiseEstimate {
  double residual_rms = 0.0;  ///< rms of a weighted reading: |W (K f - g)| / sqrt(rows - tr H)
  std::optional<double> stated_rms{};
  /// sqrt(residual^2 - stated^2), where the residual exceeds what 99 % of white noise would leave:
  /// an error of the model as large as this per reading; 0: the noise stated explains the residual.
  double model_rms = 0.0;

  /// What the bands should use: the stated noise, or else the residual's.
  [[nodiscard]] double rms() const noexcept { return stated_rms.value_or(residual_rms); }
};

/// |P W (K f - g)|: what tractions leave of the weighted readings. O(readings x tractions).
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] double residual_norm(const LinearProblem& problem, std::span<const double> readings,
                                   std::span<const double> tractions);

/// Estimates the noise from the residual of tractions, beside the noise that was stated.
///
/// @param degrees_of_freedom  tr H
/// @param stated_rms          of one weighted reading, >= 0; absent: not known
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] NoiseEstimate estimate_noise(const LinearProblem& problem,
                                           std::span<const double> readings,
                                           std::span<const double> tractions,
                                           double degrees_of_freedom,
                                           std::optional<double> stated_rms = {});

/// Estimates the noise from the 2-norm of the weighted residual.
/// @param rows  number of rows with a weight
[[nodiscard]] NoiseEstimate estimate_noise(double residual, std::size_t rows,
                                           double degrees_of_freedom,
                                           std::optional<double> stated_rms = {});

/// A value and its standard deviation.
struct Uncertain {
  double value = 0.0;
  double deviation = 0.0;
};

/// The contact's force, by first-order propagation of the covariance.
struct UncertainResultant {
  Uncertain normal{};                     ///< F_v = D sum f_v [N/m]
  std::optional<Uncertain> tangential{};  ///< F_t [N/m]; absent with one unknown
  std::optional<Uncertain> centre{};      ///< sum y f_v / sum f_v [m]; absent if F_v <= 0
  std::optional<Uncertain> angle{};  ///< atan2(F_t, F_v) [rad]; absent with one unknown or F_v <= 0
  /// Covariance of (F_v, F_t, centre), 3 x 3 row-major; zero where one of the two is absent.
  std::array<double, 9> covariance{};
};

/// Resultant of a problem's tractions.
/// @param noise_rms  of one weighted reading
[[nodiscard]] UncertainResultant resultant_of(const LinearProblem& problem,
                                              std::span<const double> tractions,
                                              const Covariance& covariance, double noise_rms);

/// Resultant of tractions on a surface: all normal values, then all tangential ones.
/// @param noise_rms  of one weighted reading
[[nodiscard]] UncertainResultant resultant_of(const Surface& surface,
                                              std::span<const double> tractions,
                                              const Covariance& covariance, double noise_rms);

/// Resultant of the contact that needs the most friction, where several lie apart. F_v and F_t of
/// the whole are sums: two contacts dragged in opposite directions both slip while F_t is 0.
/// Absent: there is one contact, or no tangential traction.
///
/// @param whole  resultant of all tractions: a force below six of its deviations is no contact
[[nodiscard]] std::optional<UncertainResultant> nearest_to_slipping(
    const Surface& surface, std::span<const double> tractions, const Covariance& covariance,
    double noise_rms, const UncertainResultant& whole);

}  // namespace tactile_net
