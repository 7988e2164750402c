/// @file
/// A skin's recording that was solved, with all that is known of each of its frames.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "page_folder.hpp"
#include "shared_scene.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/recording_row.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "watcher.hpp"

namespace tactile_net::python {

/// One frame. @param frame  its number, for messages
/// @throw BadFrame  a reading is not finite, or the tractions overflow
[[nodiscard]] lab::FrameAnswer answer_of(const lab::SkinSceneProblem& problem,
                                         std::span<const double> readings, std::size_t frame);

class SolvedSkin {
 public:
  /// Solves every frame. @pre the GIL is not held
  /// @param times     of the frames [s], NaN where one has none; empty: they have none
  /// @param readings  frames x readings
  /// @throw BadFrame
  SolvedSkin(SkinPointer shared, const lab::RecordingSolverOptions& options,
             std::vector<double> times, const Rows& readings, Watcher& watcher);

  /// One a frame: absent without an answer.
  [[nodiscard]] const std::vector<std::optional<lab::FrameAnswer>>& answers() const noexcept {
    return answers_;
  }
  [[nodiscard]] const SkinScene& scene() const noexcept;
  [[nodiscard]] const SurfaceGrid& grid() const noexcept { return grid_; }
  /// Of one frame: components x cells.
  [[nodiscard]] std::size_t width() const noexcept { return width_; }
  /// A sentence each: of the frames together, and of the one that presses hardest.
  [[nodiscard]] std::vector<std::string> notes() const;

  /// As `solve --json` writes it. @param name  of the recording
  [[nodiscard]] std::string json(const std::string& name) const;
  /// What it amounts to beside others. @param name  of the recording
  [[nodiscard]] lab::RecordingRow row(const std::string& name) const;
  /// The page that `solve --out` writes.
  [[nodiscard]] std::string html(const std::string& name) const;
  /// The folder that `solve --out` writes.
  void report(const PageFolder& folder, const std::string& name) const;

 private:
  [[nodiscard]] lab::RecordingOverview recording() const;
  /// With what is suspicious about the readings; solves some frames for it.
  [[nodiscard]] lab::RecordingOverview checked_recording() const;
  [[nodiscard]] std::string json_of(const lab::RecordingOverview& recording,
                                    const std::string& name) const;
  [[nodiscard]] std::string tractions_csv() const;
  [[nodiscard]] std::optional<double> time(std::size_t frame) const;

  SkinPointer shared_;
  std::vector<double> times_;
  std::vector<double> readings_;  // as they were solved: missing values of a frame are 0
  std::size_t size_;              // of a frame of them
  lab::Missing missing_;
  SurfaceGrid grid_{};
  std::size_t width_ = 0;
  lab::Findings first_found_{};    // before any frame is solved
  lab::SkinSceneProblem problem_;  // without taxels that the recording shows to be broken
  lab::RecordingSolver solver_;
  std::vector<std::optional<lab::FrameAnswer>> answers_{};
  std::vector<bool> incomplete_{};  // per frame: readings were missing
  lab::Findings doubts_{};
};

}  // namespace tactile_net::python
