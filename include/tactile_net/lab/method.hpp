/// @file
/// A scene's reconstruction methods, made ready: from a scene's words to the library's calls.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/problem.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/realtime/frame_status.hpp"

namespace tactile_net::lab {

/// The options of the inverse problem a scene describes.
[[nodiscard]] ProblemOptions problem_options(const Scene& scene);

/// The inverse problem a scene describes: its K, weights and smoothing length.
[[nodiscard]] InverseProblem problem_of(const Scene& scene);

/// The noise of one weighted reading, if the scene states it.
[[nodiscard]] std::optional<double> stated_noise(const Scene& scene);

/// What the scene demands of tikhonov's tractions, if anything.
[[nodiscard]] std::optional<Constraints> constraints_of(const Scene& scene);

/// Every rule on one frame of a scene: by the singular values of the matrix, or for large arrays in
/// the Fourier basis.
[[nodiscard]] AlphaSweep sweep_of(const Scene& scene, std::span<const double> readings);

/// What a solver knows after a frame.
struct FrameFacts {
  std::optional<double> alpha{};  ///< empty: the method has none
  std::string verdict = "ok";
  std::optional<double> condition{};  ///< of the system; for dft the noise gain
  std::vector<std::string> warnings{};
  std::optional<ConstrainedSolution> constrained{};
};

/// A method of one frame, after the part that may take long.
class Solver {
 public:
  virtual ~Solver() = default;

  /// @return not `ok`: the tractions are untouched
  /// @throw std::domain_error  the answer would be noise
  virtual FrameStatus solve(std::span<const double> readings, std::span<double> tractions) = 0;

  /// How many tractions a frame has: count, or twice that.
  [[nodiscard]] virtual std::size_t tractions() const = 0;

  /// How far rounding may have moved the last frame's tractions, over their 2-norm, where the
  /// solver knows it without the problem's matrix.
  [[nodiscard]] virtual std::optional<double> error_bound(std::span<const double> /*readings*/,
                                                          std::span<const double> /*tractions*/) {
    return std::nullopt;
  }

  /// Of the last frame; before the first, what holds for all of them.
  [[nodiscard]] const FrameFacts& facts() const noexcept { return facts_; }

 protected:
  FrameFacts facts_;
};

/// @param method  dft, tikhonov or closed_form; where the scene has a rule for alpha, each frame
///                gets its own
/// @throw std::invalid_argument  the method cannot take this scene
/// @throw std::domain_error      its answer would be noise
[[nodiscard]] std::unique_ptr<Solver> make_solver(const Scene& scene, Method method);

}  // namespace tactile_net::lab
