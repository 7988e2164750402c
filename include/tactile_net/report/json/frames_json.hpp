/// @file
/// What the script of a page (pages/web/frames.js) draws frames from: tractions, their bands, the
/// truth, readings, forces over time, and what is said of each frame; of lines and skins alike.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tactile_net/lab/recording.hpp"
#include "tactile_net/lab/run.hpp"

namespace tactile_net::report {

/// @pre  there is a frame
[[nodiscard]] std::string frames_json(const lab::RecordingOverview& overview);

/// One frame of a skin: its answer beside the truth, or without an answer the truth alone.
/// @pre  there is an answer or a truth
[[nodiscard]] std::string frames_json(const lab::Experiment& experiment);

/// Tractions without readings, on a line, which is a grid of one column, or on a skin.
struct ShownLoad {
  SurfaceGrid grid{};
  std::optional<Units> units{};
  std::span<const double> tractions{};  ///< components x cells [Pa]
  bool is_line = false;
  std::string title{};                  ///< of a map
  std::vector<Site> sites{};            ///< of taxels, in a map
  std::span<const std::size_t> dead{};  ///< of these
  std::span<const double> stress{};     ///< inside the pad, row by row from the surface [Pa]
  std::size_t rows = 0;                 ///< of these

  /// Of a line's surface.
  [[nodiscard]] static SurfaceGrid grid_of(const Surface& surface) {
    return {.rows = surface.count,
            .columns = 1,
            .spacing_y = surface.spacing,
            .spacing_z = 1.0,
            .centre_y = surface.centre};
  }
};

/// @pre  some traction is not 0
[[nodiscard]] std::string frames_json(const ShownLoad& load);

}  // namespace tactile_net::report
