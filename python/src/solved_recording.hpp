/// @file
/// A recording that was solved, with all that is known of each of its frames.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_row.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "watcher.hpp"

namespace tactile_net::python {

/// How far the tractions of all frames may be from the truth; NaN where a frame has no answer.
struct Bands {
  std::vector<double> deviation{};  ///< frames x tractions
  /// Of every frame its value and its deviation: frames x 2; NaN where there is none.
  std::vector<double> normal_force{};
  std::vector<double> tangential_force{};
  std::vector<double> centre{};
  /// Of every frame; absent: it has no answer.
  std::vector<std::optional<std::vector<ContactPatch>>> patches{};
};

class SolvedRecording {
 public:
  /// Solves every frame. @pre the GIL is not held
  /// @param times     of the frames [s]; empty: they have none
  /// @param readings  frames x readings
  /// @throw BadFrame
  SolvedRecording(ScenePointer shared, Method method, const lab::RecordingSolverOptions& options,
                  std::vector<double> times, const Rows& readings, Watcher& watcher);

  [[nodiscard]] std::size_t frames() const noexcept { return results_.size(); }
  /// Of one frame.
  [[nodiscard]] std::size_t width() const noexcept { return width_; }
  /// Frames x width; NaN where a frame has no answer.
  [[nodiscard]] const std::vector<double>& tractions() const noexcept { return tractions_; }
  /// One a frame: absent without an answer.
  [[nodiscard]] const std::vector<std::optional<lab::FrameResult>>& results() const noexcept {
    return results_;
  }
  /// A sentence each: what holds for the method, and what is odd about the readings.
  [[nodiscard]] std::vector<std::string> notes() const;
  [[nodiscard]] bool has_bands() const;

  /// The more costly part, made when it is asked for. @pre the GIL is not held, has_bands()
  [[nodiscard]] Bands bands(Watcher& watcher);

  [[nodiscard]] std::string json(const std::string& name, Watcher& watcher);
  /// What it amounts to beside others.
  [[nodiscard]] lab::RecordingRow row(const std::string& name, Watcher& watcher) const;
  /// As `solve --out` writes it.
  void report(const PageFolder& folder, const std::string& name, Watcher& watcher);

 private:
  [[nodiscard]] lab::RecordingOverview overview(Watcher& watcher) const;
  [[nodiscard]] std::string json(const lab::RecordingOverview& overview,
                                 const std::string& name) const;
  [[nodiscard]] std::optional<double> time(std::size_t frame) const;
  [[nodiscard]] std::string tractions_csv() const;

  ScenePointer shared_;
  lab::Findings first_found_{};  // before any frame is solved
  /// With the noise that the recording shows, where it wants it; without taxels that it shows to be
  /// broken.
  lab::SceneProblem problem_;
  Method method_;
  lab::Missing missing_;
  std::vector<double> times_;
  std::vector<double> readings_;  // as they were solved: missing values of a frame are 0
  std::size_t width_ = 0;
  std::vector<double> tractions_{};
  std::vector<std::optional<lab::FrameResult>> results_{};
  std::vector<lab::SceneProblem> problems_{};  // that each frame was solved with
  lab::Remarks remarks_{};
  lab::Findings doubts_{};
  lab::RecordingSolver solver_;
  lab::Recording recording_;
};

}  // namespace tactile_net::python
