/// @file
/// A line's or a skin's recording that was solved, with all that is known of each of its
/// frames.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_row.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/numeric/distribution.hpp"
#include "watcher.hpp"

namespace tactile_net::python {

/// How far a line's tractions of all frames may be from the truth; NaN where a frame has no
/// answer.
struct Bands {
  std::vector<double> deviation{};  ///< frames x tractions
  /// Of every frame its value and its deviation: frames x 2; NaN where there is none.
  std::vector<double> normal_force{};
  std::vector<double> tangential_force{};
  std::vector<double> centre{};
  /// Of every frame; absent: it has no answer.
  std::vector<std::optional<std::vector<ContactPatch>>> patches{};
  /// Of every frame the name of its verdict, which knows how sure the force is.
  std::vector<std::string> verdicts{};
};

class SolvedRecording {
 public:
  /// Solves every frame. @pre the GIL is not held
  /// @param method    of a skin tikhonov
  /// @param times     of the frames [s], NaN where one has none; empty: they have none
  /// @param readings  frames x readings
  /// @throw BadFrame
  SolvedRecording(AnyPointer shared, Method method, const lab::RecordingSolverOptions& options,
                  std::vector<double> times, const Rows& readings, Watcher& watcher);

  [[nodiscard]] std::size_t frames() const noexcept { return answers_.size(); }
  /// Of one frame: components x places.
  [[nodiscard]] std::size_t width() const noexcept { return width_; }
  /// One a frame: absent without an answer. Of a line they have no bands: `bands`.
  [[nodiscard]] const std::vector<std::optional<lab::FrameAnswer>>& answers() const noexcept {
    return answers_;
  }
  [[nodiscard]] bool is_line() const noexcept {
    return std::holds_alternative<lab::SceneProblem>(problem_);
  }
  /// Of a skin.
  [[nodiscard]] const SkinScene& skin() const;
  [[nodiscard]] const SurfaceGrid& grid() const noexcept { return grid_; }

  // None of what follows may be called with the GIL held.

  /// A sentence each: what holds for the method, what is odd about the readings, and of a skin what
  /// is to be said of the frame that presses hardest.
  [[nodiscard]] std::vector<std::string> notes() const;
  [[nodiscard]] bool has_bands() const;
  /// Of a line: the more costly part, made when it is asked for. @pre has_bands()
  [[nodiscard]] Bands bands(Watcher& watcher) const;

  /// Into which "normal_force", "tangential_force" or "centre" is split: of a skin the latter two
  /// along y and z. @throw std::invalid_argument  `what` is none of these
  [[nodiscard]] std::size_t directions(const std::string& what) const;
  /// Of every frame as many quantiles of each direction [N/m, of a skin N; m],
  /// frames x directions x count; NaN where a frame has no answer, or nothing presses.
  /// @throw std::invalid_argument  as of `directions`, a probability is not between 0 and 1, the
  ///                               answer is one alpha's
  [[nodiscard]] std::vector<double> quantiles(const std::string& what,
                                              const std::vector<double>& probabilities,
                                              Watcher& watcher) const;

  /// As `solve --json` writes it. @param name  of the recording
  [[nodiscard]] std::string json(const std::string& name, Watcher& watcher) const;
  /// What it amounts to beside others. @param name  of the recording
  [[nodiscard]] lab::RecordingRow row(const std::string& name, Watcher& watcher) const;
  /// The page that `solve --out` writes.
  [[nodiscard]] std::string html(const std::string& name, Watcher& watcher) const;
  /// The folder that `solve --out` writes.
  void report(const PageFolder& folder, const std::string& name, Watcher& watcher) const;

 private:
  /// With what is suspicious about the readings; solves some frames for it.
  [[nodiscard]] lab::RecordingOverview overview(Watcher& watcher) const;
  [[nodiscard]] std::string json(const lab::RecordingOverview& overview,
                                 const std::string& name) const;
  [[nodiscard]] std::string tractions_csv() const;
  /// Of each direction. @pre  the frame has an answer
  [[nodiscard]] std::vector<std::optional<Distribution>> distributions(const std::string& what,
                                                                       std::size_t frame) const;
  [[nodiscard]] std::optional<double> time(std::size_t frame) const;
  [[nodiscard]] std::span<const double> readings(std::size_t frame) const;

  AnyPointer shared_;
  Method method_;
  lab::Missing missing_;
  std::vector<double> times_;
  std::vector<double> readings_;  // as they were solved: missing values of a frame are 0
  std::size_t size_;              // of a frame of them
  lab::Findings first_found_{};   // before any frame is solved
  /// With the noise that the recording shows, where it wants it; without taxels that it shows to be
  /// broken.
  lab::AnyProblem problem_;
  lab::RecordingSolver solver_;
  lab::Recording recording_;
  SurfaceGrid grid_{};  // of a skin
  std::size_t width_ = 0;
  std::vector<std::optional<lab::FrameAnswer>> answers_{};
  std::vector<lab::AnyProblem> problems_{};  // of a line: that each frame was solved with
  lab::Findings doubts_{};
};

}  // namespace tactile_net::python
