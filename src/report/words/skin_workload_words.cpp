#include "tactile_net/report/words/skin_workload_words.hpp"

#include <array>
#include <ostream>
#include <vector>

#include "numeric/named.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/report/words/workload_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

constexpr auto skin_reason_sentences = [] {
  using enum lab::SkinWorkload::Reason;
  return std::to_array<Named<lab::SkinWorkload::Reason>>({
      {exact_model, "forward model exact: integrals over the contacts"},
      {sampled_model, "forward model sampled: the sum over the cells"},
      {no_time, "no [time]: one frame"},
      {first_frame, "the first frame is reconstructed"},
      {frames_before, "frames before it, for what effects remember and draw"},
      {three_tractions, "all three tractions are to be found"},
      {one_channel, "one quantity at one depth tells the normal traction alone"},
      {tangential_excluded, "tangential = false"},
      {no_drag, "no contact drags: the normal traction alone"},
      {weight_unknown, "tangential_weight = \"evidence\": each frame says how small its drags are"},
      {weight_given, "tangential_weight is a number, 1 if it is left out"},
      {one_traction, "the normal traction alone"},
      {matrix_held, "at most 8192 tractions: the whole matrix is stored"},
      {matrix_too_large, "more than 8192 tractions: by products, without a matrix"},
      {rule_chooses, "alpha is chosen by "},
      {prior_by_rule, "alpha is given; the prior of the bands is chosen by "},
      {limits_stated, "friction_limit or nonnegative asks for it"},
      {no_limits, "neither friction_limit nor nonnegative"},
      {forces_have_deviations, "tractions and forces have deviations"},
      {noise_stated, "it must be said whether any contact explains the readings"},
      {no_noise, "without a stated noise only the readings' size is judged"},
      {report_requested, "a report is asked for"},
      {no_report, "no report is asked for"},
  });
}();

}  // namespace

std::string why_in_words(const lab::SkinWorkload::Task& task) {
  std::string text(name_in<skin_reason_sentences>(task.why));
  using enum lab::SkinWorkload::Reason;
  if (task.why == rule_chooses || task.why == prior_by_rule) text += rule_in_words(task.rule);
  return text;
}

std::string cost_in_words(const lab::SkinWorkload::Task& task) {
  if (!task.cost) return "";
  const std::string count = std::to_string(task.count);
  using enum lab::SkinWorkload::Cost;
  switch (*task.cost) {
    case kernel_values:
      return "some hundred kernel values for each of " + counted(task.count, "reading") +
             " and contact";
    case sum:
      return "products with " + counted(task.count, "traction");
    case moments:
      return "the readings at " + counted(task.count, "moment");
    case unknowns:
      return counted(task.count, "unknown") + " instead of " + std::to_string(task.count / 3);
    case families:
      return "a decomposition for each of some six weights";
    case classes:
      return "singular values of " + std::to_string(task.rows) + " x " + count +
             ", in up to four classes";
    case tiles:
      return "conjugate gradients by FFT for " + counted(task.count, "traction") +
             ", preconditioned by overlapping tiles: some tens of steps";
    case one_rule:
      return "200 values of alpha by one rule";
    case probes:
      return "four random probes and a run of the frame, each up to 300 products with K and K'";
    case multipliers:
      return "ADMM with one decomposition";
    case projected_gradients:
      return "accelerated gradients by FFT, 2000 steps at most";
    case class_sums:
      return "sums over the singular values";
    case solves:
      return "a solve for each force and moment that is new, and two to six to say how far bands "
             "of cells are off";
    case contact_search:
      return "where tractions that only press leave too much, a search for contacts that do not";
    case drawing:
      return "plots and tables";
  }
  return "";
}

void print_workload(std::ostream& out, const SkinScene& scene, const lab::SkinWorkload& work) {
  out << scene.file << ": " << (scene.title.empty() ? "" : scene.title + "\n  ")
      << sensor_in_words(scene) << "; " << material_in_words(scene) << '\n';
  if (scene.time)
    out << "  " << (scene.frame + 1 == scene.time->frames ? "the last" : "one") << " of "
        << counted(scene.time->frames, "frame") << ": frame " << scene.frame << " ("
        << option(Option::frame) << " takes another)\n";
  std::vector<std::vector<std::string>> rows;
  if (!work.effects.empty()) {
    out << "\nEffects, in the order of the signal path:\n";
    rows.push_back({"effect", "what it does"});
    for (const SceneEffect* effect : work.effects)
      rows.push_back({std::string(effect->name), effect->words(scene)});
    print_cells(out, rows);
  }
  out << "\nComputations:\n";
  rows = {{"computation", "done", "why", "what it takes"}};
  for (const lab::SkinWorkload::Task& task : work.tasks)
    rows.push_back({std::string(name(task.what)), task.done ? "yes" : "no", why_in_words(task),
                    task.cost ? cost_in_words(task) : "-"});
  print_cells(out, rows);
}

}  // namespace tactile_net::report
