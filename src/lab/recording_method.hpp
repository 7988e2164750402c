/// @file
/// What a recording's solver asks of a line's problem or a skin's. Private.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tactile_net/lab/answer.hpp"

namespace tactile_net::lab {

/// A problem, made ready for its frames.
class RecordingMethod {
 public:
  explicit RecordingMethod(AnyProblem problem) : problem_(std::move(problem)) {}
  RecordingMethod(const RecordingMethod&) = delete;
  RecordingMethod& operator=(const RecordingMethod&) = delete;
  virtual ~RecordingMethod() = default;

  [[nodiscard]] const AnyProblem& problem() const noexcept { return problem_; }
  /// How many a frame has.
  [[nodiscard]] virtual std::size_t tractions() const = 0;
  /// What holds before any frame.
  [[nodiscard]] virtual Remarks remarks() const { return {}; }
  /// What it takes in memory, about.
  [[nodiscard]] virtual std::size_t bytes() const = 0;
  /// Whether several threads may call `answer` at once, of which no frame depends on another.
  [[nodiscard]] virtual bool takes_threads() const = 0;

  /// The same with these taxels dead, in place of the scene's; frames of it share no alpha.
  /// @param taxels  rising; the others measure something
  [[nodiscard]] virtual std::shared_ptr<RecordingMethod> without(
      std::span<const std::size_t> taxels) const = 0;

  /// Every reading is taken for what it says. A line's answer is without its bands, which take many
  /// times as long: `with_bands`.
  ///
  /// @param repeats  a taxel that frames before have shown to repeat itself
  /// @throw std::invalid_argument  the readings have the wrong size or are not finite
  /// @throw FrameOverflow, std::domain_error  as `solve` of a skin's frame
  [[nodiscard]] virtual FrameAnswer answer(std::span<const double> readings,
                                           std::optional<std::size_t> repeats) = 0;

 private:
  AnyProblem problem_;
};

/// @param share_alpha  as `RecordingSolverOptions`
/// @throw std::invalid_argument, std::domain_error  as `make_solver` and `make_sharing_solver`
[[nodiscard]] std::shared_ptr<RecordingMethod> recording_method(
    const SceneProblem& problem, Method method, std::optional<std::size_t> share_alpha);
/// @throw std::invalid_argument  as `FrameSharing`
[[nodiscard]] std::shared_ptr<RecordingMethod> recording_method(
    const SkinSceneProblem& problem, std::optional<std::size_t> share_alpha);

}  // namespace tactile_net::lab
