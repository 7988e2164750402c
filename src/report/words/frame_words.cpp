#include "tactile_net/report/words/frame_words.hpp"

#include "tactile_net/drawing/html.hpp"
#include "tactile_net/report/words/recording_words.hpp"

namespace tactile_net::report {

FrameWords frame_words(const lab::RecordingOverview& overview, const lab::FrameGroup& group) {
  return {.place = group_place(overview, group),
          .answer = drawing::typeset(group_answer(overview, group)),
          .trust = distrust_in_words(group.answer, overview.scene)};
}

FrameWords frame_words(const lab::Experiment& experiment) {
  const lab::FrameAnswer& answer = experiment.results.front().answer;
  return {.answer = drawing::typeset(wrench_in_words(answer, experiment.skin())),
          .trust = distrust_in_words(answer, experiment.skin())};
}

}  // namespace tactile_net::report
