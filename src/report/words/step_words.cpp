#include "tactile_net/report/words/step_words.hpp"

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
  }
  return {};
}

}  // namespace tactile_net::report
