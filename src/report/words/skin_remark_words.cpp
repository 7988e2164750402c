#include "report/words/skin_remark_words.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"

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

/// What an answer without dense matrices has not. @pre  it has been solved by products
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

}  // namespace

Sentences remarks_in_words(const lab::FrameAnswer& answer) {
  Sentences said = warnings_and_notes(answer.remarks);
  if (answer.iteration) said.warnings.push_back(without_matrix(answer));
  if (answer.unseen > lab::most_unseen)
    said.warnings.push_back(
        percent(answer.unseen) +
        " of the force found lies beyond the taxels, or where they are dead: the force there is a "
        "guess from the taxels beside it; the deviations include this");
  return said;
}

}  // namespace tactile_net::report
