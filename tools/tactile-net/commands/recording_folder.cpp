#include "commands/recording_folder.hpp"

#include <optional>

#include "commands/results.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "terminal/progress.hpp"

namespace tactile_net::tool {

RecordingFolder::RecordingFolder(const std::filesystem::path& folder, bool force,
                                 const lab::SceneProblem& problem, Method method)
    : path_(folder), folder_(folder, existing_in(folder, force)), recording_(problem, method) {}

void RecordingFolder::add(std::string_view time, const lab::SceneProblem& problem,
                          std::span<const double> readings, std::span<const double> tractions,
                          const lab::FrameResult& result) {
  double seconds = 0.0;
  const bool timed = read_number(time, seconds);
  recording_.add(timed ? std::optional(seconds) : std::nullopt, problem, readings, tractions,
                 result);
}

void RecordingFolder::commit(const std::string& readings, const std::string& json,
                             const std::vector<std::string>& notes, const Streams& streams) {
  Progress progress(streams);
  progress.say("drawing the page ...");
  const lab::RecordingOverview overview = recording_.overview(progress);
  std::vector<std::string> files = {"result.json", "shown.csv"};
  if (std::filesystem::exists(folder_.place("tractions.csv"))) files.emplace_back("tractions.csv");
  folder_.write("report.html", pages::recording_page(overview, readings, notes,
                                                     {.by = streams.command, .files = files})
                                   .html);
  folder_.write("result.json", json);
  folder_.write("shown.csv", report::recording_csv(overview));
  const std::vector<std::string> others = folder_.commit();
  progress.clear();
  say_others(streams.err, path_, others);
  say_report(streams.err, path_);
}

}  // namespace tactile_net::tool
