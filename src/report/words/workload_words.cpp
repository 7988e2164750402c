#include "tactile_net/report/words/workload_words.hpp"

#include <array>
#include <ostream>

#include "numeric/named.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

using lab::Workload;

/// "81 x 81".
std::string size_of(const Workload::Cost& cost) {
  return std::to_string(cost.rows) + " x " + std::to_string(cost.columns);
}

std::string about(double operations) { return "about " + brief(operations) + " operations"; }

constexpr auto reason_sentences = [] {
  using enum Workload::Reason;
  return std::to_array<Named<Workload::Reason>>({
      {exact_model, "forward model exact: the continuous integral"},
      {sampled_model, "forward model sampled: the sum over the taxels"},
      {effects_remember, "effects remember what came before frame "},
      {only_draws_matter, "no effect remembers: of earlier frames only their random draws"},
      {no_time, "no [time]: one frame"},
      {first_frame, "the first frame is reconstructed"},
      {two_tractions, "both tractions are to be found"},
      {one_channel, "one quantity at one depth tells the normal traction alone"},
      {tangential_excluded, "tangential = false"},
      {no_friction, "no friction: the normal traction alone"},
      {layer, "[material] has a layer"},
      {half_plane, "no layer: half plane, closed formulas"},
      {method_named, "reconstruct.methods names it"},
      {method_not_named, "reconstruct.methods does not name it"},
      {rule_chooses, "alpha is chosen by "},
      {comparison_requested, "a comparison of the rules is asked for"},
      {alpha_given, "alpha is given"},
      {no_method_takes_alpha, "no method takes alpha from it"},
      {forces_have_deviations, "the forces that are printed have deviations"},
      {hidden_must_be_said, "combinations that no reading shows must be named"},
      {no_matrix_method, "neither tikhonov nor closed_form is asked for"},
      {array_too_large, "no matrix is formed for an array as large as this"},
      {parts_not_ideal, "parts are not ideal, or settling or tolerances are asked for"},
      {parts_ideal, "ideal parts"},
      {settling_requested, "network.settling asks for it"},
      {settling_not_requested, "settling is not asked for"},
      {tolerance_requested, "network.tolerance asks for it"},
      {tolerance_unsupported, "tolerances are studied for networks of resistors and op-amps"},
      {nominal_parts, "every component has its value"},
      {no_circuit, "no circuit"},
      {resultant_drawn, "the report draws the resultant over the scene's time"},
      {one_frame, "one frame"},
      {report_requested, "a report is asked for"},
      {no_report, "no report is asked for"},
  });
}();

}  // namespace

std::string rule_in_words(std::optional<AlphaRule> rule) {
  return rule ? "the rule " + std::string(name(*rule)) : "the default rule";
}

std::string why_in_words(const Workload::Task& task) {
  const Workload::Why& why = task.why;
  std::string text(name_in<reason_sentences>(why.reason));
  if (why.reason == Workload::Reason::effects_remember) text += std::to_string(why.frame);
  if (why.reason == Workload::Reason::rule_chooses)
    text += rule_in_words(why.rule) + "; it is flagged if the other rules disagree";
  return text;
}

std::string cost_in_words(const Workload::Task& task) {
  if (!task.cost) return "";
  const Workload::Cost& cost = *task.cost;
  const std::string count = std::to_string(cost.count);
  using enum Workload::Cost::Kind;
  switch (cost.kind) {
    case kernel_values:
      return "some hundred kernel values for each of " + counted(cost.count, "reading") +
             " and contact";
    case direct_sum:
      return size_of(cost) + " sum for " + counted(cost.count, "kernel") + ", " +
             about(cost.operations);
    case fft:
      return "FFT for " + counted(cost.count, "kernel") + ", " + about(cost.operations);
    case moments:
      return "the readings at " + counted(cost.count, "moment");
    case random_draws:
      return "no reading is computed";
    case unknowns:
      return counted(cost.count, "unknown") + " instead of " + std::to_string(cost.rows);
    case kernel_integrals:
      return "integrals at " + count + " distances for each kernel";
    case frame_fft:
      return "FFT, " + about(cost.operations) + " a frame";
    case decompositions:
      return "QR and SVD of " + size_of(cost) + ", once; " + about(cost.operations) + " a frame";
    case product:
      return "QR and SVD, once; " + about(cost.operations) + " a frame";
    case conjugate_gradients:
      return "conjugate gradients by FFT";
    case alpha_rules:
      return "SVD; 200 values of alpha by " + count + " rules";
    case inverse:
      return "one rule for alpha, and the inverse of " + size_of(cost);
    case singular_values:
      return "SVD of " + size_of(cost);
    case circuit:
      return "P, " + counted(cost.rows, "node") + ", " + std::string(name(*cost.realization)) +
             ", up to " + count + " branches; one operating point in ngspice";
    case certificate:
      return "theorem, margin, poles";
    case transient:
      return "a transient in ngspice";
    case draws:
      return counted(cost.count, "draw");
    case every_frame:
      return "every frame simulated and solved, at most 400 solved";
    case drawing:
      return "plots and tables";
  }
  return "";
}

std::string effect_in_words(const Workload::Effect& effect, const Scene& scene) {
  if (!effect.simulated) return std::string(effect.row->absence);
  return effect.row->words(scene) + (effect.idle ? "; strength 0: no stage" : "");
}

void print_workload(std::ostream& out, const Scene& scene, const Workload& work) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
  if (scene.time)
    out << "  " << time_in_words(scene) << " (" << option(Option::frame) << " takes another)\n";
  out << "\nEffects, in the order of the signal path:\n";
  std::vector<std::vector<std::string>> rows = {
      {"effect", "simulated", "operations a frame", "what it does"}};
  for (const Workload::Effect& effect : work.effects)
    rows.push_back({std::string(effect.row->name), effect.simulated ? "yes" : "no",
                    effect.operations > 0.0 ? brief(effect.operations) : "-",
                    effect_in_words(effect, scene)});
  print_cells(out, rows);
  out << "\nComputations:\n";
  rows = {{"computation", "done", "why", "what it takes"}};
  for (const Workload::Task& task : work.tasks)
    rows.push_back({std::string(name(task.what)), task.done ? "yes" : "no", why_in_words(task),
                    task.cost ? cost_in_words(task) : "-"});
  print_cells(out, rows);
}

}  // namespace tactile_net::report
