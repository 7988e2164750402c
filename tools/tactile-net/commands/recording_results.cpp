#include "commands/recording_results.hpp"

#include <filesystem>

#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::tool {

RecordingResults::RecordingResults(const ResultOptions& options, const lab::SceneProblem& problem,
                                   Method method, const Streams& streams)
    : streams_(streams), results_(options, streams), recording_(problem, method) {}

void RecordingResults::add(std::optional<double> seconds, const lab::SceneProblem& problem,
                           std::span<const double> readings, std::span<const double> tractions,
                           const lab::FrameResult& result) {
  recording_.add(seconds, problem, readings, tractions, result);
}

void RecordingResults::write(const lab::SolvedFrames& solved, const report::SolveReport& report,
                             const lab::Remarks& remarks, const lab::Findings& findings) {
  Progress progress(streams_);
  progress.say("drawing the page ...");
  lab::RecordingOverview overview = recording_.overview(progress);
  overview.findings = findings;
  const auto page = [&] {
    pages::Made made{.by = streams_.command, .files = {"result.json", "shown.csv"}};
    if (std::filesystem::exists(tractions())) made.files.emplace_back("tractions.csv");
    drawing::Page drawn =
        pages::recording_page(overview, report.readings, report::in_words(remarks), made);
    drawn.files.emplace_back("shown.csv", report::recording_csv(overview));
    return drawn;
  };
  results_.write(
      {.json = [&] { return report::solve_json(overview, solved, report); }, .page = page},
      progress);
}

}  // namespace tactile_net::tool
