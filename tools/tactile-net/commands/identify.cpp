#include "commands/identify.hpp"

#include <cmath>
#include <ostream>
#include <variant>
#include <vector>

#include "commands/input.hpp"
#include "commands/recording.hpp"
#include "failure.hpp"
#include "tactile_net/frames/open.hpp"
#include "tactile_net/pages/identify_page.hpp"
#include "tactile_net/report/json/identify_json.hpp"
#include "tactile_net/report/words/identify_words.hpp"

namespace tactile_net::tool {
namespace {

void check_positive(const char* option, const std::optional<double>& value) {
  if (value && (!(*value > 0.0) || !std::isfinite(*value)))
    throw WrongUsage(option, "must be > 0 and finite");
}

/// How strong a ripple is to be told, by what was recorded; values that are missing do not count.
/// @param scene  of a line or of a skin
double traction_of(const IdentifyOptions& options, const auto& scene, const Streams& streams) {
  frames::ReadingsFile file(options.readings, scene, &streams.in,
                            {.columns = options.columns, .accept_missing = true});
  say_opening(streams.err, file.name(), file.source());
  std::vector<double> readings(file.source().columns().size());
  std::vector<double> largest(channel_count(scene.sensor));
  const auto where = sites(scene.sensor);
  while (file.source().next(readings))
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (double& most = largest[where[i].channel]; std::abs(readings[i]) > most)
        most = std::abs(readings[i]);
  return lab::traction_behind(scene, largest);
}

/// @param scene  of a line or of a skin
void survey(const auto& scene, const IdentifyOptions& options, const Streams& streams) {
  lab::SurveyOptions survey_options = options.survey;
  if (!options.readings.empty()) {
    if (survey_options.traction)
      throw WrongUsage("--readings", "and --traction exclude each other");
    survey_options.traction = traction_of(options, scene, streams);
  }
  if (lab::needs_traction(scene, survey_options))
    throw WrongUsage("--traction",
                     "or --readings is needed: the scene states its noise and has no contact, so "
                     "nothing says how strong the loads are that must be detected");
  Results results(options.results, streams);
  Progress progress(streams);
  const lab::Survey found = lab::identify(scene, survey_options, progress);
  results.write({.print = [&](std::ostream& out) { report::print_survey(out, scene, found); },
                 .json = [&] { return report::survey_json(scene, found); },
                 .page =
                     [&] {
                       return pages::survey_html(scene, found,
                                                 {.by = streams.command, .files = {"result.json"}});
                     }},
                progress);
}

}  // namespace

void run(const IdentifyOptions& options, const Streams& streams) {
  check_positive("--traction", options.survey.traction);
  check_positive("--noise", options.survey.relative_noise);
  check_one_standard_input(options.scene, options.readings);
  std::visit([&](const auto& scene) { survey(scene, options, streams); },
             read_any_scene(options.scene, streams.in));
}

}  // namespace tactile_net::tool
