#include "report/words/skin_remark_words.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/summary_words.hpp"

namespace tactile_net::report {

namespace {

/// "within 0.5 %", "1.2 % too narrow to 0.1 % too wide", "2 % to 40 % too narrow".
std::string off_in_words(double least, double most) {
  constexpr double near = 0.005;
  const auto way = [](double off) { return off < 0.0 ? " too narrow" : " too wide"; };
  if (std::max(std::abs(least), std::abs(most)) <= near) return "within " + percent(near);
  if ((least < 0.0) != (most < 0.0))
    return percent(std::abs(least)) + way(least) + " to " + percent(most) + way(most);
  const auto [less, more] = std::minmax({std::abs(least), std::abs(most)});
  return percent(less) + " to " + percent(more) + way(least);
}

}  // namespace

std::string without_matrix(const lab::FrameAnswer& answer) {
  const bool constrained = answer.cone.has_value();
  const std::size_t steps = constrained ? answer.cone->iterations : answer.iteration->steps;
  const auto& bands = answer.iteration->bands;
  return "large skin, solved without a matrix in " + std::to_string(steps) + " steps of " +
         (constrained ? "projected" : "conjugate") +
         " gradients; alpha and the bands of single cells are estimates (checked on " +
         counted(bands.tractions, "traction") + ": " + off_in_words(bands.least, bands.most) + ")" +
         (constrained ? "; bands ignore the constraints, so they are too wide" : "");
}

void add_missing(std::vector<Answer>& all, const lab::SkinRecordingAnswer& recording) {
  const auto add = [&](const lab::FrameRuns& runs, const char* what) {
    if (runs.count() > 0)
      all.push_back(
          {std::to_string(runs.count()) + " of " + std::to_string(recording.frames.size()),
           std::string(what) + in_words(runs), true});
  };
  add(recording.skipped(), "frames miss readings and have no answer: ");
  add(recording.estimated(), "frames miss readings and are solved without the taxels that miss: ");
}

}  // namespace tactile_net::report
