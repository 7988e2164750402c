#include "commands/grasp.hpp"

#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/lab/space_grasp.hpp"
#include "tactile_net/pages/grasp_page.hpp"
#include "tactile_net/pages/space_grasp_page.hpp"
#include "tactile_net/report/json/grasp_json.hpp"
#include "tactile_net/report/words/grasp_words.hpp"
#include "tactile_net/report/words/space_grasp_words.hpp"

namespace tactile_net::tool {

namespace {

/// Words, JSON and the page of either kind of grasp; a grasp that fails is a check that failed.
void write_grasp(const auto& grasp, Results& results, Progress& progress, const Streams& streams) {
  results.write(
      {.print = [&](std::ostream& out) { report::print_grasp(out, grasp); },
       .json = [&] { return report::grasp_json(grasp); },
       .page =
           [&] {
             return drawing::Page{.html = pages::grasp_report_html(
                                      grasp, {.by = streams.command, .files = {"result.json"}})};
           }},
      progress);
  if (!grasp.failures.empty()) throw CheckFailed(report::failures_in_words(grasp).front());
}

}  // namespace

void run(const GraspOptions& options, const Streams& streams) {
  const AnyHand any =
      read_any_hand(options.hand, streams.in, {.allow_outside = options.allow_outside});
  Results results(options.results, streams);
  Progress progress(streams);
  const auto readings = [&](const std::filesystem::path& file, const auto& scene,
                            std::size_t number) {
    return frames::readings_of_frame(file, scene, number, {.columns = options.columns});
  };
  if (const auto* hand = std::get_if<SpaceHand>(&any))
    write_grasp(lab::hold(*hand, readings, progress), results, progress, streams);
  else
    write_grasp(
        lab::hold(std::get<Hand>(any),
                  {.readings = readings, .tractions = frames::tractions_of_frame}, progress),
        results, progress, streams);
}

}  // namespace tactile_net::tool
