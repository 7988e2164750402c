/// @file
/// The tractions as all that the readings leave possible: where may a load press, how hard, and
/// what do then the forces and the tractions amount to?
///
/// A load lies in a window of the surface, which nobody knows, and nowhere else; in it
///
///     f ~ N(0, (sigma^2 / alpha) C),  C^-1 = m w_u^2 (1 + (d/2)^2 (Q_y + Q_z))^2
///
/// of each component u, Q: differences of neighbouring values over their distance, squared, with 0
/// beyond the window; d the least depth, m and w as linear_problem.hpp has them. That is a second
/// order more than the functional of `TikhonovFamily`: rough loads are less likely, and bands of
/// cells narrower by two fifths where they still hold Hertz' contacts. Nobody knows alpha either.
/// A component c of the mixture is a window, an alpha and a tangential weight; with
/// K C K' = U diag(gamma^2) U' in the window and beta = U'g / sigma
///
///     log p_c = prior + 1/2 sum log(alpha / (gamma^2 + alpha)) - 1/2 q
///     q       = sum alpha / (gamma^2 + alpha) beta^2 + |g / sigma - U beta|^2
///
/// and a sum s'f of it is Gaussian. A noise whose level is known as from nu readings makes that
/// Student's t with rows + nu degrees: -(rows + nu) / 2 log(nu + q) stands for -q / 2, and
/// variances are (nu + q) / (nu + rows) times as large; nu = 0: the level is not known at all. What
/// the pad's formula may be off by changes no weight, only the scale of each component's sums.
///
/// A priori each width of windows is as likely as another, each place of one width, and 1/w is
/// half-Cauchy; alpha is so by its logarithm times alpha^`prior_power`. The sum over alphas, a
/// factor 2 apart, is the integral to a hundredth of a band. How often the bands hold:
/// docs/bands.md, of skins docs/internals/mixture.md.
///
///     const LoadPrior prior(problem, {.depth = 1e-3});  // once
///     const LoadMixture answer = prior.given(readings, {.rms = 0.01});
///     answer.of(force_weights).interval(0.95);
///     answer.mean();  // tractions [Pa], whose sums are the sums' means
///
/// What it costs, on one core; cells half a depth wide, skins from 3.5 depths on; a frame: `given`,
/// force and centre of one contact, the first time that its windows are likely, and again:
///
///                                               set-up   memory   first    again
///     line of 41 taxels, 1 unknown               10 ms    4 MB    0.6 ms   0.2 ms
///     line of 41 taxels, 2 unknowns              0.13 s   16 MB   1.9 ms   0.5 ms
///     skin of 8 x 8, normal traction alone       0.02 s   2 MB    1 ms     0.2 ms
///     skin of 8 x 8 x 3 readings                 0.14 s           10 ms    4 ms
///     skin of 8 x 8 x 3, two depths apart        0.51 s           9 ms     7 ms
///     skin of 16 x 16, normal traction alone     0.13 s           22 ms    12 ms
///
/// Skins from 2.5 depths on, as is usual, take up to twice as long.
///
/// What answers need of likely windows is kept, 256 MB at most. A frame of noise alone makes nearly
/// all windows likely, of which few answer (`most_components`): with 128 readings or more, with
/// all tractions' intervals the first one takes 0.4 s, those after it 0.15 s, of 8 x 8 x 3
/// readings; of 17 x 17 x 3 half a depth apart 2.4 s and 0.6 s.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/numeric/distribution.hpp"

namespace tactile_net {

/// What is known of the noise of a weighted reading.
struct LoadNoise {
  std::optional<double> rms{};  ///< > 0; absent: not known, and integrated over
  /// Of freedom, > 0: as if the rms had been measured from so many readings. Infinity: it is
  /// certain. Of 5, which hold it to a third of itself, bands hold a noise that is stated half as
  /// large as it is.
  double degrees = 5.0;
  /// >= 0: each component of the tractions may be off by a common factor, which no reading shows,
  /// with this standard deviation. A pad is never quite what its formula says.
  double model_share = 0.0;
  /// >= 0: each reading is off by noise of this share of the largest one, for certain, beside a
  /// stated rms: values cannot have a load's shape. Without it windows would be as likely as they
  /// fit what no values can have.
  double reading_share = 0.0;
};

struct LoadPriorOptions {
  double depth = 0.0;      ///< d [m], > 0: the taxels' least one
  double narrowest = 2.5;  ///< window, in depths, > 0
  /// Of alpha, >= 0. 0: each size of loads is as likely as another. 1/4: large ones are less
  /// likely, which is for coarse arrays, between whose taxels they would hide; 1/2 is a
  /// half-Cauchy of the load's size.
  double prior_power = 0.0;
  /// > 0: components that answer a frame of fewer than 128 readings. Where more are likely, so many
  /// of them or an eighth, if that is more, stand for all, with probabilities that are on average
  /// the same: of contacts sums and the ends of their bands are off by up to a thirtieth of a
  /// deviation. Of 128 readings or more 64 windows with a weight answer.
  std::size_t most_components = 96;
  /// Most that decompose windows at the same time; 0: as many as run so here. It changes no bit.
  std::size_t threads = 0;
};

/// How much work a prior is, counted from its sizes before any of it is done.
struct LoadWork {
  double set_up = 0.0;  ///< multiplications and additions
  double frame = 0.0;   ///< of one of noise alone, which makes nearly every window likely
  double kept = 0.0;    ///< numbers that such a frame needs of all windows; 256 MB are kept
};
/// @throw std::invalid_argument  as LoadPrior
[[nodiscard]] LoadWork load_work(const LinearProblem& problem, const LoadPriorOptions& options);

class LoadMixture;

/// What is known of a load before anything is read. Copies share the tables.
class LoadPrior {
 public:
  /// A decomposition for each window, by singular values or of many readings a bidiagonal matrix,
  /// and of a line's two components for each of six tangential weights, of a skin's three for each
  /// of three; one for all windows that are each other's images on an array that mirrors itself or
  /// whose y and z may be exchanged. Of a line windows of up to eighteen widths, each 2^(1/4) times
  /// the one before, an eighth of the width apart, with two unknowns a quarter, with 128 readings
  /// or more up to nine, a quarter and sqrt 2; of a skin squares a third apart, those narrower
  /// than 3.5 depths half a depth; and the whole surface.
  ///
  /// @throw std::invalid_argument  an option is out of range, no reading depends on the tractions
  LoadPrior(const LinearProblem& problem, const LoadPriorOptions& options);

  /// Number of windows.
  [[nodiscard]] std::size_t count() const noexcept;

  /// What the readings leave of it: a product of rows x rows for each window, and for each weight
  /// of those that may be likely. Several threads may ask.
  /// @throw std::invalid_argument  readings have the wrong size or are not finite, or the noise is
  ///                               out of range
  [[nodiscard]] LoadMixture given(std::span<const double> readings, const LoadNoise& noise) const;

  struct Tables;
  /// Of one window and one weight, what a frame makes of it.
  struct Part;

 private:
  std::shared_ptr<const Tables> tables_;
};

/// Several sums of weights times tractions, worked out together.
class LoadSums {
 public:
  [[nodiscard]] std::size_t count() const noexcept;
  /// @pre  sum < count()
  [[nodiscard]] Distribution of(std::size_t sum) const;
  /// Of one sum over another, as a centre is of the moment over the force: exactly (Fieller 1954).
  /// Absent: the denominator is less than five of its deviations away from 0.
  /// @pre  both < count()
  [[nodiscard]] std::optional<Distribution> ratio(std::size_t numerator,
                                                  std::size_t denominator) const;

 private:
  friend class LoadMixture;
  friend class LoadCovariance;
  struct Piece;
  struct Table;
  explicit LoadSums(std::shared_ptr<const Table> table);

  std::shared_ptr<const Table> table_;
};

/// What is known of a load after a frame. Keeps the prior's tables alive.
class LoadMixture {
 public:
  /// The tractions' mean [Pa], components x values. O(values x readings) for each likely window.
  [[nodiscard]] std::vector<double> mean() const;

  /// Of sums of weights times tractions: one pass over the likely windows for all.
  /// @throw std::invalid_argument  there is not one weight per traction
  [[nodiscard]] LoadSums sums(std::span<const std::vector<double>> weights) const;
  /// Of one of them. @throw  as `sums`
  [[nodiscard]] Distribution of(std::span<const double> weights) const;
  [[nodiscard]] std::vector<Distribution> of_each(
      std::span<const std::vector<double>> weights) const;
  /// As `LoadSums::ratio`. @throw  as `sums`
  [[nodiscard]] std::optional<Distribution> ratio(std::span<const double> numerator,
                                                  std::span<const double> denominator) const;
  /// Of every traction: O(values x readings) for each likely component.
  [[nodiscard]] std::vector<Distribution> of_tractions() const;

  /// tr H on average: how many of the readings' degrees of freedom the tractions use up.
  [[nodiscard]] double degrees_of_freedom() const noexcept { return used_; }
  /// How many components are likely: more than a millionth.
  [[nodiscard]] std::size_t components() const noexcept;
  /// Student's degrees of freedom of each; infinity: Gaussian.
  [[nodiscard]] double student_degrees() const noexcept { return degrees_; }

  /// The alpha with this probability below it, of the functional with these windows.
  [[nodiscard]] double alpha_quantile(double p) const;

 private:
  friend class LoadPrior;
  friend class LoadCovariance;

  explicit LoadMixture(std::shared_ptr<const LoadPrior::Tables> tables);

  std::shared_ptr<const LoadPrior::Tables> tables_;
  std::shared_ptr<const std::vector<LoadPrior::Part>> parts_;
  double sigma_ = 1.0;
  double degrees_ = 0.0;
  double used_ = 0.0;
  double model_share_ = 0.0;
};

/// The mean squares of the error of given tractions, per unit of a noise's rms squared: about the
/// mixture's mean the covariance. Worked out for the sums that are asked for.
class LoadCovariance final : public Covariance {
 public:
  /// @param about  one per traction [Pa]
  /// @throw std::invalid_argument  noise_rms is not > 0, there is not one traction per column
  LoadCovariance(LoadMixture mixture, std::span<const double> about, double noise_rms);

  [[nodiscard]] std::vector<double> deviations() const override;
  [[nodiscard]] double deviation(std::span<const double> weights) const override;
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override;
  /// One pass over the likely windows for all sums.
  [[nodiscard]] std::vector<double> deviations_of(
      std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] Matrix covariances(std::span<const std::vector<double>> weights) const override;
  [[nodiscard]] double degrees_of_freedom() const noexcept override {
    return mixture_.degrees_of_freedom();
  }

 private:
  LoadMixture mixture_;
  std::vector<double> about_;
  double noise_rms_;
};

}  // namespace tactile_net
