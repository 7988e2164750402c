/// @file
/// Private. What is suspicious about a recording, as JSON.
#pragma once

#include "report/json/described.hpp"
#include "tactile_net/lab/readings_check.hpp"

namespace tactile_net {

template <>
struct Fields<lab::FrameRuns> {
  static constexpr auto all = std::tuple{
      field("count", &lab::FrameRuns::count, "How many frames there are."),
      field(
          "runs",
          [](const lab::FrameRuns& frames) {
            std::vector<std::array<std::size_t, 2>> runs;
            for (const lab::FrameRun& run : frames.runs()) runs.push_back({run.first, run.last});
            return runs;
          },
          "Frames that follow each other: the first and the last of each run, counted from 0."),
      field("not_listed", &lab::FrameRuns::not_listed, "Frames that are in none of these runs.")};
};

namespace report {

/// A suspicion, its sentence, and what to do.
struct FindingTold {
  lab::Finding finding{};
  std::string text{};
  std::string advice{};
};

/// Its kind, its sentence, the advice, and its numbers.
template <>
struct JsonForm<FindingTold> {
  static Json json(const FindingTold& told);
  static Json schema();
};

[[nodiscard]] std::vector<FindingTold> findings_told(const lab::Findings& findings,
                                                     const AnyScene& scene);

}  // namespace report
}  // namespace tactile_net
