#include "tactile_net/report/words/step_words.hpp"

#include <cmath>

#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {

std::string in_words(const lab::Step& step) {
  using Kind = lab::Step::Kind;
  switch (step.kind) {
    case Kind::readings:
      return "simulating the readings ...";
    case Kind::rules:
      return "comparing rules for alpha ...";
    case Kind::method:
      return std::string(name(step.method)) + " ...";
    case Kind::operating_point:
      return "ngspice: operating point ...";
    case Kind::certificate:
      return "certifying ...";
    case Kind::transient:
      return "ngspice: transient of " + std::to_string(step.count) + " states ...";
    case Kind::draws:
      return "drawing components ...";
    case Kind::realizations:
      return "comparing realisations ...";
    case Kind::frame:
      return "frame " + std::to_string(step.count) + " ...";
    case Kind::sensors:
      return "the scene's sensors ...";
    case Kind::alternative:
      return "alternative " + std::to_string(step.count) + " ...";
    case Kind::finger:
      return "finger " + std::to_string(step.count) + " ...";
    case Kind::board:
      return "certifying with the board's capacitance ...";
  }
  return {};
}

std::string frames_in_words(std::size_t done, std::optional<double> share, double seconds) {
  std::string text = counted(done, "frame");
  if (!share) return text + " ...";
  text += ", " + fixed(100.0 * *share, 0) + " %";
  // The first moments tell little of the rest.
  if (!(*share > 0.0) || seconds < 0.5) return text + " ...";
  const double left = seconds / *share - seconds;
  return text + ", about " +
         (left < 90.0 ? fixed(std::ceil(left), 0) + " s"
                      : fixed(std::ceil(left / 60.0), 0) + " min") +
         " left";
}

}  // namespace tactile_net::report
