#include "tactile_net/report/json/controller_json.hpp"

#include "report/json/product_json.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/report/words/controller_words.hpp"

namespace tactile_net {

template <>
struct Fields<Candidate> {
  static constexpr auto all = std::tuple{
      field("structure", &Candidate::structure, "How the matrix is stored."),
      field("precision", &Candidate::precision, "The precision of its numbers."),
      field("ranks", &Candidate::ranks,
            "The rank of each class that has places; empty: not of low rank."),
      field("exchanged", &Candidate::exchanged,
            "Whether the exchange of y and z is used too, of a skin's reflections."),
      field("transform_size", &Candidate::transform_size, "Points of the FFT; 0: there is no FFT."),
      field("bytes", &Candidate::bytes, Measure::memory, "What a frame reads."),
      field("error_bound", &Candidate::error_bound,
            "The largest error, proven, in the unit of `accuracy`."),
      field("accurate", &Candidate::accurate, "Whether that is within `accuracy`."),
      field("chosen", &Candidate::chosen, "Whether the plan is this one.")};
};

template <>
struct Fields<ExpectedUnfinished> {
  static constexpr auto all = std::tuple{
      field("median", &ExpectedUnfinished::median, "Half of the drawn frames are nearer."),
      field("high", &ExpectedUnfinished::high, "999 of 1000 are nearer."),
      field("worst", &ExpectedUnfinished::worst, "All are.")};
};

template <>
struct Fields<lab::PlannedForce> {
  static constexpr auto all =
      std::tuple{field("planned", &lab::PlannedForce::planned, Measure::load, "By the plan."),
                 field("solved", &lab::PlannedForce::solved, Measure::load,
                       "By the solver, as the scene has it.")};
};

namespace report {
namespace {

struct ConeTold {
  std::optional<double> friction_limit{};
  std::size_t steps = 0;
  std::size_t bytes = 0;
  bool in_deviations = false;
  ExpectedUnfinished unfinished{};

  static constexpr auto described = std::tuple{
      field("friction_limit", &ConeTold::friction_limit,
            "What the drag over the pressure of a cell is at most; null: nothing pulls, and that "
            "is all."),
      field("steps", &ConeTold::steps, "Steps of a frame towards them."),
      field("bytes", &ConeTold::bytes, Measure::memory, "What a step reads."),
      field("in_deviations", &ConeTold::in_deviations,
            "Whether `unfinished` counts standard deviations of noise; else it is a share of the "
            "linear frame."),
      field("unfinished", &ConeTold::unfinished, "How far frames are from their minimum.")};
};

struct PlanTold {
  std::string scene{};
  std::size_t readings = 0;
  std::size_t tractions = 0;
  double alpha = 0.0;
  std::string alpha_rule{};
  double accuracy = 0.0;
  double error_bound = 0.0;
  double asymmetry = 0.0;
  double frame_seconds = 0.0;
  std::vector<Candidate> candidates{};
  std::optional<lab::PlannedForce> force{};
  IfAny<ConeTold> constraints{};
  IfAny<std::size_t> filled_readings{};
  IfAny<UnitsTold> units{};
  IfAny<std::vector<double>> baseline{};

  static constexpr auto described = std::tuple{
      field("scene", &PlanTold::scene,
            "The scene's file; <stdin> where it came from standard input."),
      field("readings", &PlanTold::readings, "How many readings a frame has."),
      field("tractions", &PlanTold::tractions, "How many tractions a frame gives."),
      field("alpha", &PlanTold::alpha, "The regularisation of all frames."),
      field("alpha_rule", &PlanTold::alpha_rule, "Where it comes from."),
      field("accuracy", &PlanTold::accuracy, "The accuracy that was asked for."),
      field("error_bound", &PlanTold::error_bound, "The plan's largest error, proven."),
      field("asymmetry", &PlanTold::asymmetry,
            "How far the matrix is from mirror symmetry, in the unit of `accuracy`."),
      field("frame_seconds", &PlanTold::frame_seconds, Measure::time,
            "What a frame takes on this machine."),
      field("candidates", &PlanTold::candidates, "The products that could be planned."),
      field("force", &PlanTold::force,
            "The normal force of the scene's own contacts; null: it has none."),
      field("constraints", &PlanTold::constraints,
            "What frames obey; only of a plan with constraints."),
      field("filled_readings", &PlanTold::filled_readings,
            "Readings of dead taxels that the plan fills in; of a line only where there are any."),
      field("units", &PlanTold::units, "The units of these numbers; only of a scene with [units]."),
      field("baseline", &PlanTold::baseline, Measure::reading,
            "What is subtracted from the numbers; empty: 0; only of a plan for raw numbers.")};
};

}  // namespace

std::string controller_json(const AnyScene& scene, const lab::PlannedController& planned,
                            double frame_seconds) {
  const EstimatorPlan& plan = planned.estimator.plan;
  const SceneTold head = scene_told(scene);
  PlanTold told{.scene = head.scene,
                .readings = plan.readings(),
                .tractions = plan.tractions(),
                .alpha = plan.alpha,
                .alpha_rule = in_words(planned.alpha),
                .accuracy = plan.accuracy,
                .error_bound = plan.error_bound,
                .asymmetry = planned.estimator.asymmetry,
                .frame_seconds = frame_seconds,
                .candidates = planned.estimator.candidates,
                .force = planned.force,
                .units = head.units};
  if (plan.cells || plan.fill) told.filled_readings.value = plan.fill ? plan.fill->rows : 0;
  if (const auto& cone = plan.cone)
    told.constraints.value = ConeTold{.friction_limit = cone->friction_limit,
                                      .steps = cone->steps,
                                      .bytes = streamed_bytes(cone->step),
                                      .in_deviations = plan.noise_rms > 0.0,
                                      .unfinished = cone->expected};
  if (planned.for_raw_numbers) told.baseline.value = plan.baseline;
  return document_text(kind::plan, told);
}

Json plan_schema() {
  return document_schema<PlanTold>(kind::plan, "How a controller's plan was chosen");
}

}  // namespace report
}  // namespace tactile_net
