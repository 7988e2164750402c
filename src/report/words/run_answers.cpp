#include <algorithm>
#include <cmath>

#include "report/words/number_words.hpp"
#include "report/words/skin_remark_words.hpp"
#include "tactile_net/lab/agreement.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/answers.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::report {
namespace {

using lab::Experiment;
using lab::MethodResult;
using lab::Verdict;

Answer force(const Experiment& experiment, const MethodResult& lead) {
  const Scene& scene = experiment.line();
  const double exact = experiment.frame.force;
  Answer answer;
  answer.meaning = "normal force";
  if (lead.resultant()) {
    const Uncertain& found = lead.resultant()->normal;
    answer.value = in_unit(scene.units, Dimension::force, found);
    if (const auto& drag = lead.resultant()->tangential)
      answer.meaning += ", tangential " + in_unit(scene.units, Dimension::force, *drag);
    // Readings summed over the taxels hold what their places have of the contacts.
    const double shown = scene.forward == ForwardModel::sampled ? experiment.sampled_force : exact;
    answer.doubtful = std::abs(found.value - shown) > 4.0 * found.deviation + 0.02 * exact;
  } else {
    answer.value = in_unit(scene, Dimension::force, lead.force);
  }
  answer.meaning += "; the contacts press with " + in_unit(scene, Dimension::force, exact);
  if (lead.answer.verdict != Verdict::ok) {
    answer.meaning += ". " + std::string(name(lead.answer.verdict)) + ": " +
                      std::string(in_words(lead.answer.verdict));
    answer.doubtful = answer.doubtful || !is_faultless(lead.answer.verdict);
  }
  return answer;
}

/// The methods that have found one thing, as a curve's label: "tikhonov = closed_form".
std::string equal_methods(const Experiment& experiment, const lab::Agreement& group) {
  std::vector<std::string> names;
  for (const std::size_t i : group.results) names.emplace_back(name(experiment.results[i].method));
  return join(names, " = ");
}

Answer agreement(const Experiment& experiment) {
  const std::vector<lab::Agreement> groups = lab::agreements(experiment.results);
  const std::size_t all = experiment.results.size();
  const auto found = static_cast<std::size_t>(
      std::count_if(experiment.results.begin(), experiment.results.end(),
                    [](const MethodResult& result) { return result.has_answer(); }));
  Answer answer;
  if (found < all) {
    answer = {std::to_string(all - found) + " of " + std::to_string(all) + " methods fail",
              "the reason is below", true};
  } else if (all == 1) {
    answer = {"1 method", std::string(name(experiment.results.front().method)) +
                              ": nothing to compare it with"};
  } else if (groups.size() == 1) {
    answer = {std::to_string(all) + " methods agree",
              "to " + brief(groups.front().difference, 1) + " of the largest traction"};
  } else {
    const MethodResult& first = experiment.results[groups.front().results.front()];
    answer.value = "methods differ";
    answer.doubtful = true;
    for (std::size_t i = 1; i < groups.size(); ++i)
      answer.meaning +=
          (i > 1 ? "; " : "") + equal_methods(experiment, groups[i]) + " differs from " +
          equal_methods(experiment, groups.front()) + " by up to " +
          percent(lab::difference(first, experiment.results[groups[i].results.front()]));
  }
  if (const auto& circuit = experiment.relaxation) {
    answer.meaning += circuit->disagreement() ? "; the circuit does NOT hold"
                                              : "; the circuit agrees with the direct solve to " +
                                                    brief(circuit->difference, 1);
    answer.doubtful = answer.doubtful || circuit->disagreement();
  }
  return answer;
}

}  // namespace

std::vector<Answer> answers(const Experiment& experiment) {
  if (experiment.of_skin()) return skin_answers(experiment);
  const auto lead = std::find_if(experiment.results.begin(), experiment.results.end(),
                                 [](const MethodResult& result) { return result.has_answer(); });
  if (lead == experiment.results.end())
    return {{"no answer", "no method can solve this scene: the reason is below", true}};
  std::vector<Answer> all;
  const bool pressed = experiment.frame.force != 0.0;
  if (!pressed)
    all.push_back({"nothing presses", "no contact: the readings are noise, and the answers too"});
  else
    all.push_back(force(experiment, *lead));
  if (pressed && lead->resultant() && lead->resultant()->centre)
    all.push_back({in_unit(experiment.line().units, Dimension::length, *lead->resultant()->centre),
                   "centre of pressure, along y from the array's middle"});
  if (const double off = lead->errors.front().relative; std::isfinite(off))
    all.push_back(
        {percent(off) + " off",
         "the true profile, root mean square over the array, by " + std::string(name(lead->method)),
         off > 0.5});
  all.push_back(agreement(experiment));
  return all;
}

}  // namespace tactile_net::report
