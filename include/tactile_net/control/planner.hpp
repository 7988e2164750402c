/// @file
/// From the inverse problem of a line or a skin to a controller's plan: which structure of the
/// reconstruction matrix M = P^-1 K' W to use for a stated accuracy, and why.
///
/// A regular array is its own mirror image, so M falls into classes (product_plan.hpp): two halves
/// of a line, four quarters of a skin, and once more where a skin is square and y and z can be
/// exchanged. That is exact: 16 x 16 taxels that read three stresses stream 0.9 MB where M has
/// 7.4 MB. The pad is a low-pass filter, so M is numerically of low rank too, which pays for lines,
/// deep skins and coarse accuracies. Both together stream 3 to 40 times fewer bytes than M itself,
/// and bytes are what a frame's time is made of. The rank comes from the singular values, never
/// from a fixed number: a few too few leave an answer that is far off.
///
/// Dead taxels break the symmetry: M without them is that of the whole array, on readings whose
/// missing ones are filled in with what the live ones predict, exactly. Where so many are dead that
/// this is dearer, and for irregular arrays, M itself is taken, or two factors of low rank.
///
/// Where a line's pitch is fixed and the line long, the rank grows with it. There M = T + E is
/// cheapest, T a convolution (by FFT) and E of a small rank that does not grow: only the array's
/// two ends differ from an endless array. T alone is percents off at the ends.
///
///     const PlannedEstimator planned =
///         plan_estimator(problem, 1e-3, {.accuracy = 1e-7, .friction_coefficient = 0.5});
///     std::puts(planned.why().c_str());            // what was chosen, and against what
///     ContactEstimator estimator(planned.plan);    // examples 07_controller, 10_skin_controller
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/linear_problem.hpp"
#include "tactile_net/realtime/estimator_plan.hpp"
#include "tactile_net/sensing/calibration.hpp"

namespace tactile_net {

class TikhonovFamily;

/// Share of the linear frame that counts as a standard deviation where no noise is known.
inline constexpr double deviation_without_noise = 1e-2;

/// Frames that obey what contact allows (realtime/cone_plan.hpp), after a fixed number of steps.
struct ConeOptions {
  Constraints constraints{};  ///< one at least
  /// Of a frame, at most `ConePlan::most_steps`; 0: as few as leave 99.9 % of drawn frames `enough`
  /// or less unfinished.
  std::size_t steps = 0;
  /// In standard deviations; where the noise is not known in hundredths of the linear frame.
  double enough = 0.1;
  /// The largest weighted reading of drawn frames, over the noise.
  double signal = 100.0;
};

struct PlannerOptions {
  /// Accuracy of the plan, > 0. For every frame, with f = M g in double and r = W (g - K f) what it
  /// leaves unexplained,
  ///
  ///     |f_planned - f|_2 <= accuracy (|f|_2 + |M W^-1|_2 |r|_2):
  ///
  /// relative to the tractions, and to what an error of the readings as large as r can do to them.
  double accuracy = 1e-7;
  std::optional<Structure> structure{};  ///< absent: the cheapest that is accurate enough
  std::optional<Precision> precision{};  ///< absent: the cheapest that is accurate enough
  bool diagnostics = true;  ///< residual, outliers, dead taxels at run time; costs a second product
  /// Offer fft too, for lines and float64 only: the controller then links tactile_net::spectral
  /// (GPL where that was built with FFTW) or brings a `Convolution` of its own. Asking for
  /// `structure` fft allows it. Its price in the choice is FFTW's.
  bool allow_fft = false;
  bool all_candidates = false;  ///< also try structures that cannot be the cheapest
  /// rms noise of a weighted reading; 0: not known. A skin's forces are then summed over the cells
  /// that touch.
  double noise_rms = 0.0;
  double traction_limit = 0.0;  ///< Young's modulus [Pa], to doubt frames by; 0: not known
  /// Indices, rising, of the values above the outermost taxels that count: with diagnostics, frames
  /// that press there as hard as anywhere are doubted. Empty: not known.
  std::vector<std::size_t> border{};
  /// With diagnostics and a noise: frames with a channel that reads nearly a constant alone are
  /// doubted. Takes a tenth to a fifth of a small patch's time.
  bool judge_baseline = false;
  std::optional<double> friction_coefficient{};  ///< mu; absent: no friction margins
  std::vector<ReadingRange> ranges{};  ///< one per channel, or none; in what the controller reads
  /// Calibration from raw numbers to readings; present: the plan is for raw numbers. Gains go
  /// into its matrices, baseline and offset into its baseline. Gains that differ within a channel
  /// leave an array that is not mirror symmetric: `reflections` and `fft` cannot be used.
  std::optional<Calibration> calibration{};
  std::string label{};
  /// Of a curved skin: the point that moments are about, in the sensor's axes [m], finite.
  std::array<double, 3> moment_about{};
  std::optional<ConeOptions> cone{};  ///< absent: tractions are linear in the readings
};

/// One way to compute the product.
struct Candidate {
  Structure structure = Structure::dense;
  Precision precision = Precision::float64;
  std::vector<std::size_t> ranks{};  ///< rank of each class with places; empty if not of low rank
  std::size_t transform_size = 0;    ///< points of the FFT; 0 for other structures
  bool exchanged = false;            ///< a skin's reflections: the exchange of y and z is used too
  std::size_t bytes = 0;             ///< streamed per frame
  /// Predicted time of a frame in units of one streamed byte: bytes, `cost_of_a_factor` for each
  /// factor, and the transforms (constants in product_planner.cpp).
  double cost = 0.0;
  double error_bound = 0.0;  ///< proven, in the unit of `PlannerOptions::accuracy`
  bool accurate = false;     ///< error_bound <= accuracy; the double dense product always is
  bool chosen = false;
};

struct PlannedEstimator {
  EstimatorPlan plan{};
  std::vector<Candidate> candidates{};
  double asymmetry = 0.0;     ///< how far M is from mirror symmetry, in the unit of the accuracy
  std::string without_fft{};  ///< why fft is no candidate of a line; empty: it is one
  /// With a cone, how far drawn frames are from their minimum after 0, 1 ... `ConePlan::most_steps`
  /// steps.
  std::vector<ExpectedUnfinished> unfinished{};

  /// The choice and what spoke against the others, a line each.
  [[nodiscard]] std::string why() const;
};

/// Plans a controller for one alpha, of a line or a skin. O(readings x tractions x their lesser)
/// for M, O(readings x tractions) for each class of the reflections, and a singular value
/// decomposition of it; with diagnostics O(readings^2 x tractions).
///
/// The bound holds for rounding too: sums of n terms in float err by at most n 2^-24 of the sum of
/// their magnitudes (Higham 2002, 3.1). That is pessimistic by about sqrt(n), so float is chosen
/// for coarse accuracies only, unless it is asked for.
///
/// An FFT of m points errs by at most 2 log2(2 m) eta in the 2-norm, eta = 6.7 2^-53: Higham (2002,
/// theorem 24.2) for radix 2, a factor 2 for radices 3 and 5 and for real data.
///
/// @param whole  where taxels are dead: the same problem with none; absent: not known, and its
///               symmetry is not used
/// @throw std::invalid_argument  alpha or accuracy is not > 0 and finite; the whole is of another
///                               problem or has dead taxels; a structure is asked for that the
///                               array does not have (reflections and fft where it is not
///                               symmetric, fft of a skin or in float32); the calibration is not
///                               one of these readings; `check(plan)` does
/// With a cone, frames of one to three contacts are drawn, with noise, to see how far steps bring
/// them: some hundred to a thousand, always the same.
///
/// @throw std::invalid_argument  also: a limit of friction is not in (0, 1000], or there is no
///                               tangential traction; the steps would leave more than one standard
///                               deviation in half of the drawn frames: the text says which alpha
///                               would do
/// @throw std::domain_error      alpha is smaller than double precision resolves
[[nodiscard]] PlannedEstimator plan_estimator(const LinearProblem& problem, double alpha,
                                              const PlannerOptions& options = {},
                                              const LinearProblem* whole = nullptr);

/// The same by a family that has been made of the problem, which takes long of a skin.
///
/// @param family  the problem's
/// @throw std::invalid_argument  also: the family is of another problem
[[nodiscard]] PlannedEstimator plan_estimator(const LinearProblem& problem,
                                              const TikhonovFamily& family, double alpha,
                                              const PlannerOptions& options = {},
                                              const LinearProblem* whole = nullptr);

/// Largest memory that planning takes, the problem and its family included [bytes]. Compare it with
/// what the machine has before making either.
[[nodiscard]] double planning_bytes(std::size_t readings, std::size_t tractions) noexcept;

}  // namespace tactile_net
