/// @file
/// What `solve` tells of a recording as a whole: the page with the numbers beside it, and JSON.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/report/json/solve_json.hpp"

namespace tactile_net::tool {

class RecordingResults {
 public:
  /// Before anything is computed. @throw CannotCreate  also as `report::existing_in`
  RecordingResults(const ResultOptions& options, const lab::SceneProblem& problem, Method method,
                   const Streams& streams);

  /// Where the tractions of every frame go, if they are not wanted elsewhere; empty: no folder.
  [[nodiscard]] std::string tractions() const { return results_.place("tractions.csv"); }

  /// The answer of the next frame.
  void add(std::optional<double> seconds, const lab::SceneProblem& problem,
           std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result);
  /// It has none.
  void skip() { recording_.skip(); }
  /// Of no frame the times were seconds.
  void times_without_unit() { recording_.times_without_unit(); }

  /// Draws the page and moves all files into place. Takes the bands of the frames that are shown.
  void write(const lab::SolvedFrames& solved, const report::SolveReport& report,
             const lab::Remarks& remarks, const lab::Findings& findings);

 private:
  Streams streams_;
  Results results_;
  lab::Recording recording_;
};

}  // namespace tactile_net::tool
