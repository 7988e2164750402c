/// @file
/// Whether readings can be true: could any contact have caused them?
///
/// A contact presses: its tractions lie in a convex cone C (f_v >= 0, and friction has some limit).
/// For readings W g = W K f + e, f in C, e white noise of rms sigma, the distance of W g from W K C
/// is at most |e|, whatever f is. So
///
///     min over f in C of |W (K f - g)|^2  >  sigma^2 chi^2_0.999(rows)
///
/// happens to one honest frame in a thousand at most, without an alpha, a prior or degrees of
/// freedom to be estimated. Where no contact explains a frame, the single causes that a
/// least-squares problem can hold are tried, worst first: the sign, one taxel, one constant a
/// channel. They are tried with contacts of any friction that rubber has, whatever limit is stated:
/// what a limit that is too low leaves of honest readings lies at the taxels that feel the drag
/// most, and none of them is to blame. Where those contacts explain the frame, it is the limit that
/// is doubted.
///
/// A narrow contact takes up most of what a single taxel says too much, and the sum leaves room for
/// the rest. So a contact that explains a frame but leaves a reading odd, as noise does in one
/// frame of 20, is compared with contacts without one taxel: it lies where that gains more than
/// noise or 5 % of the largest reading would, and nothing odd is left. A lie just like a needle
/// that presses is not told from one, and of two neighbours either may be named.
///
/// Lines and skins are judged alike, by contacts that are found in two ways. On a line a
/// non-negative least squares finds the nearest contact of all. On a skin friction's cones are
/// searched with less and less smoothing (inverse/cone_tikhonov.hpp), which bounds that distance
/// from above: first among the tractions found, then near them on their own grid, and no further
/// than the verdict needs: a contact that is met on the way is one as good as that at the end, so
/// the first that explains the frame and leaves no reading odd is enough. Constants added to a
/// channel are not looked for there, and nothing is kept from frame to frame.
///
///     const DataJudge judge(problem, {.noise_rms = 1.0, .largest_traction = pad.youngs_modulus});
///     const DataVerdict data = judge.judge(readings, tractions);
///     data.consistent();                     // or data.doubts: name(data.doubts.front())
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "tactile_net/inverse/linear_problem.hpp"

namespace tactile_net {

/// Share of honest frames that each test doubts.
inline constexpr double false_alarms = 1e-3;
/// Limit of friction where nobody states one: rubber on what it touches has no more.
inline constexpr double usual_friction = 1.0;

/// Why readings cannot be those of a contact, the worst first.
enum class DataDoubt {
  implausible,     ///< a strain beyond 1, of the readings or of the pad's whole surface
  pulls,           ///< explained by tractions that pull alone, or best with the sign turned round
  bad_taxel,       ///< explained without one taxel alone, or better by far
  offset,          ///< explained with a constant added to a channel alone, or better by far
  misfit,          ///< no tractions explain it: pad, depth, noise or calibration are not as stated
  friction_limit,  ///< explained with more friction than is stated alone: the limit may be too low
};

/// The spelling in JSON and tables: "bad_taxel".
[[nodiscard]] std::string_view name(DataDoubt doubt) noexcept;

struct DataVerdict {
  std::vector<DataDoubt> doubts{};  ///< worst first
  bool noise_known = false;  ///< false: `misfit`, and tractions that pull here and there, are
                             ///< never found
  /// True if noise alone explains the readings: nothing presses, or no more than noise hides.
  bool noise_alone = false;
  double strain = 0.0;  ///< the largest reading, or the mean normal traction, over its limit
  /// Rms of a weighted reading that the best contact found leaves unexplained.
  double residual_rms = 0.0;
  /// Limit that `residual_rms` exceeds in one honest frame of a thousand; 0: the noise is not
  /// known.
  double residual_limit = 0.0;
  std::optional<std::size_t> taxel{};  ///< the one that `bad_taxel` doubts
  std::vector<double> offset{};        ///< `offset`'s constant of each channel [its unit]

  [[nodiscard]] bool consistent() const noexcept { return doubts.empty(); }
  [[nodiscard]] bool has(DataDoubt doubt) const noexcept;
};

struct DataLimits {
  std::optional<double> noise_rms{};       ///< of a weighted reading, > 0; absent: not known
  std::optional<double> friction_limit{};  ///< |f_t| / f_v, > 0; absent: `usual_friction`
  /// Traction that strains the pad by 1 [Pa]: Young's modulus. Absent: tractions are not judged.
  std::optional<double> largest_traction{};
  /// Readings at a strain of 1, one per row of K: Young's modulus for stresses, 1 for strains.
  /// Empty: readings are not judged.
  std::vector<double> largest_readings{};
  /// Interior of the array, [first, last] in m. Only a contact larger than the array needs loads
  /// outside it: that tells an offset from a load. Absent: offsets are not tested. Of a line.
  std::optional<std::pair<double, double>> inner{};
};

class KeptContacts;

/// What explained the last frames, to be handed to `DataJudge::judge`. Frames that follow one
/// another are mostly explained by the same places, pressed a little more or less: that saves the
/// search. Use one for each judge and thread. Of a line: a skin's judge leaves it as it is.
class DataMemory {
 public:
  DataMemory();
  ~DataMemory();
  DataMemory(DataMemory&&) noexcept;
  DataMemory& operator=(DataMemory&&) noexcept;

 private:
  friend class DataJudge;
  std::unique_ptr<KeptContacts> kept_;
};

/// Judges frames of one problem. Const: threads may share one.
class DataJudge {
 public:
  /// Of a line O(rows x columns). Of a skin O(1): factors are made when a frame first needs them.
  ///
  /// @param problem   the one whose tractions are judged; kept, and copied unless it is shared
  /// @param contacts  the same rows on the surface on which contacts are sought: fine enough for
  ///                  narrow ones, and of a line beyond the array's ends; absent, or an empty
  ///                  function: the problem itself. A function is called at most once: of a line at
  ///                  once, of a skin when a frame first needs it
  /// @throw std::invalid_argument  a limit is not > 0, or a size does not fit
  DataJudge(const LinearProblem& problem, DataLimits limits);
  DataJudge(const LinearProblem& problem, const LinearProblem& contacts, DataLimits limits);
  DataJudge(std::shared_ptr<const LinearProblem> problem, std::function<LinearProblem()> contacts,
            DataLimits limits);
  ~DataJudge();
  DataJudge(DataJudge&&) noexcept;
  DataJudge& operator=(DataJudge&&) noexcept;

  /// One frame: a product by K where the tractions found are nearly a contact's own, or the memory
  /// knows one. Else of a line a few non-negative least squares of a handful of free columns each;
  /// of a skin up to three searches, and where no contact explains the frame as many for a few
  /// taxels left out and for the sign turned round. Allocates.
  ///
  /// @param readings   g, one per row of K, finite
  /// @param tractions  that a method found for them [Pa]
  /// @param memory     of this judge; the doubts are the same without one, but for a single taxel
  ///                   at the edge of what is odd
  /// @throw std::invalid_argument  a size does not fit, also of the problem that `contacts` makes
  [[nodiscard]] DataVerdict judge(std::span<const double> readings,
                                  std::span<const double> tractions,
                                  DataMemory* memory = nullptr) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace tactile_net
