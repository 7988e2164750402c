#include "tactile_net/report/words/controller_words.hpp"

#include <cmath>
#include <ostream>

#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {

std::string in_words(const lab::PlanAlpha& alpha) {
  const std::string rule(alpha.rule ? name(*alpha.rule) : "");
  switch (alpha.source) {
    case lab::PlanAlpha::Source::given:
      return "given";
    case lab::PlanAlpha::Source::contact:
      return rule + ", on the scene's own contact";
    case lab::PlanAlpha::Source::recording:
      return rule + (alpha.frames == 1 ? ", on one frame"
                                       : ", the median of " + counted(alpha.frames, "frame"));
  }
  return {};
}

void print_controller(std::ostream& out, const lab::PlannedController& planned,
                      double frame_seconds, std::optional<double> deadline) {
  const EstimatorPlan& plan = planned.estimator.plan;
  out << plan.label << ": " << plan.readings() << " readings to " << plan.tractions()
      << " tractions, alpha " << brief(plan.alpha) << " (" << in_words(planned.alpha) << ")\n"
      << planned.estimator.why();
  if (plan.fill)
    out << "  " << plan.fill->rows
        << " readings of dead taxels are replaced by what the others predict\n";
  if (plan.prediction)
    out << "  residual, outliers, dead taxels: " << streamed_bytes(*plan.prediction)
        << " bytes a frame more (" << option(Option::no_diagnostics) << " leaves them out)\n";
  if (const auto& cone = plan.cone) {
    const bool knows_noise = plan.noise_rms > 0.0;
    const auto told = [&](double value) { return knows_noise ? brief(value, 2) : percent(value); };
    out << "  frames obey "
        << (cone->friction_limit ? "|q| <= " + brief(*cone->friction_limit, 2) + " p" : "p >= 0")
        << ": " << counted(cone->steps, "step") << ", " << duration(frame_seconds)
        << " here: unfinished " << told(cone->expected.median) << ", 99.9 % "
        << told(cone->expected.high) << ", worst " << told(cone->expected.worst)
        << (knows_noise ? " standard deviations" : " of the tractions") << '\n';
  }
  if (planned.for_raw_numbers)
    out << "  it takes raw numbers, as in files of readings: the plan contains the scene's units "
           "and calibration"
        << (planned.needs_baseline ? ", but not the baseline: call set_baseline with an unloaded "
                                     "frame first, or plan with " +
                                         option(Option::readings)
                                   : std::string())
        << '\n';
  if (const auto& force = planned.force) {
    const double off = force->planned / force->solved - 1.0;
    out << "  on the scene's own contacts its normal force is " << percent(std::abs(off))
        << (off < 0.0 ? " below" : " above")
        << " that of solve, which has the scene's alpha and constraints\n";
  }
  out << "  a frame takes " << duration(frame_seconds) << " here";
  if (deadline) out << ": " << brief(*deadline / frame_seconds) << " times inside the deadline";
  out << '\n';
}

std::string deadline_missed_in_words(const lab::PlannedController& planned, double frame_seconds,
                                     double deadline) {
  const EstimatorPlan& plan = planned.estimator.plan;
  return "the fastest plan of accuracy " + brief(plan.accuracy) + " takes " +
         duration(frame_seconds) + ", the deadline is " + duration(deadline) + ": raise " +
         option(Option::accuracy) +
         (plan.prediction ? ", or leave the residual out: " + option(Option::no_diagnostics) : "") +
         "; tradeoff shows how long each method takes";
}

}  // namespace tactile_net::report
