/// @file
/// What `solve` tells of a recording as a whole: the page with the numbers beside it, and JSON.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "commands/results.hpp"
#include "streams.hpp"
#include "tactile_net/lab/readings_check.hpp"
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

  /// The readings of the next frame as they were recorded, before it is solved or skipped.
  void read(std::optional<double> seconds, std::span<const double> readings);
  /// Its answer.
  void add(std::optional<double> seconds, const lab::SceneProblem& problem,
           std::span<const double> readings, std::span<const double> tractions,
           const lab::FrameResult& result);
  /// It has none.
  void skip() { recording_.skip(); }
  /// Of no frame the times were seconds.
  void times_without_unit();

  /// What is suspicious about the readings. Solves some frames for it.
  [[nodiscard]] lab::Findings findings() const { return checker_.result().findings; }

  /// Draws the page and moves all files into place. Takes the bands of the frames that are shown.
  void write(const lab::SolvedFrames& solved, const report::SolveReport& report,
             const lab::Remarks& remarks, const lab::Findings& findings);

 private:
  Streams streams_;
  Results results_;
  lab::Recording recording_;
  lab::ReadingsChecker checker_;
};

}  // namespace tactile_net::tool
