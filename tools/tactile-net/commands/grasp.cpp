#include "commands/grasp.hpp"

#include "commands/input.hpp"
#include "failure.hpp"
#include "tactile_net/frames/frame_of.hpp"
#include "tactile_net/pages/grasp_page.hpp"
#include "tactile_net/report/json/grasp_json.hpp"
#include "tactile_net/report/words/grasp_words.hpp"

namespace tactile_net::tool {

void run(const GraspOptions& options, const Streams& streams) {
  const Hand hand = read_hand(options.hand, streams.in, {.allow_outside = options.allow_outside});
  Results results(options.results, streams);
  Progress progress(streams);
  const auto readings = [&](const std::filesystem::path& file, const Scene& scene,
                            std::size_t number) {
    return frames::readings_of_frame(file, scene, number, {.columns = options.columns});
  };
  const lab::GraspResult grasp =
      lab::hold(hand, {.readings = readings, .tractions = frames::tractions_of_frame}, progress);
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

}  // namespace tactile_net::tool
