#include "commands/solve_skin.hpp"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "commands/frames_file.hpp"
#include "commands/recording.hpp"
#include "failure.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/lab/skin_recording.hpp"
#include "tactile_net/pages/skin_page.hpp"
#include "tactile_net/report/csv/skin_csv.hpp"
#include "tactile_net/report/json/skin_json.hpp"

namespace tactile_net::tool {
namespace {

void refuse_for_skins(const SolveOptions& options) {
  if (options.method != Method::tikhonov)
    throw WrongUsage("--method", "skins are solved by tikhonov alone");
  if (options.missing != lab::Missing::fail)
    throw WrongUsage("--missing",
                     "values that are missing are not filled in for skins: name taxels without "
                     "readings under [dead_taxels]");
  if (options.share_alpha)
    throw WrongUsage("--share-alpha", "is for line arrays, and this scene is of a skin");
}

}  // namespace

void solve_skin(const SkinScene& scene, const SolveOptions& options, const Streams& streams) {
  refuse_for_skins(options);
  const lab::SkinSceneProblem problem(scene);
  frames::ReadingsFile file(options.readings, scene, &streams.in, {.columns = options.columns});
  frames::FrameSource& source = file.source();
  say_opening(streams.err, file.name(), source);

  std::optional<Results> results;
  if (!options.results.folder.empty() || !options.results.json.empty())
    results.emplace(options.results, streams);
  const bool in_folder = options.output.empty() && !options.results.folder.empty();
  FramesFile tractions(in_folder ? results->place("tractions-of-frames.csv") : options.output,
                       report::traction_columns(problem.grid(), problem.problem().components),
                       source.has_time(), streams.out);
  std::optional<FramesFile> wrenches;
  if (!options.uncertainty.empty())
    wrenches.emplace(options.uncertainty, report::wrench_columns(), source.has_time(), streams.out);

  lab::SkinRecordingAnswer recording{.scene = scene, .grid = problem.grid()};
  Progress progress(streams);
  std::vector<double> readings(source.columns().size());
  while (source.next(readings)) {
    const lab::SkinAnswer answer = solve(problem, readings);
    tractions.add(source.time(), answer.tractions);
    if (wrenches) wrenches->add(source.time(), report::wrench_values(answer));
    recording.add(std::string(source.time()), readings, answer);
    if (progress.due()) progress.frames(recording.frames.size(), file.share_read());
  }
  progress.clear();
  tractions.commit();
  if (wrenches) wrenches->commit();
  say_closing(streams.err, file.name(), source);
  if (recording.frames.empty()) throw CheckFailed("the recording holds no frame");
  if (!results) return;
  results->write(
      {.json = [&] { return report::recording_json(recording, options.readings); },
       .page = [&] { return pages::recording_page(recording, options.readings, streams.command); }},
      progress);
}

}  // namespace tactile_net::tool
