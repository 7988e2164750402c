#include "tactile_net/report/words/workload_words.hpp"

#include <ostream>
#include <vector>

#include "numeric/named.hpp"
#include "report/words/scene_head.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/table.hpp"
#include "tactile_net/scene/option_words.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::report {
namespace {

using lab::Workload;

/// The sentence, with `of(name)` in the place of each `{name}`.
std::string filled(std::string_view sentence, const auto& of) {
  std::string text;
  for (std::size_t at = sentence.find('{'); at != sentence.npos; at = sentence.find('{')) {
    const std::size_t end = sentence.find('}', at);
    text += sentence.substr(0, at);
    text += of(sentence.substr(at + 1, end - at - 1));
    sentence.remove_prefix(end + 1);
  }
  text += sentence;
  return text;
}

void print_workload_of(std::ostream& out, const auto& scene, const Workload& work) {
  print_head(out, scene);
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

}  // namespace

std::string why_in_words(const Workload::Task& task) {
  const Workload::Why& why = task.why;
  return filled(row_in<lab::workload_reasons>(why.reason).text, [&](std::string_view what) {
    if (what == "frame") return std::to_string(why.frame);
    return why.rule ? "the rule " + std::string(name(*why.rule)) : std::string("the default rule");
  });
}

std::string cost_in_words(const Workload::Task& task) {
  if (!task.cost) return "";
  const Workload::Cost& cost = *task.cost;
  return filled(row_in<lab::workload_costs>(cost.kind).text, [&](std::string_view what) {
    if (what == "operations") return brief(cost.operations);
    if (what == "realization") return std::string(name(*cost.realization));
    const std::size_t space = what.find(' ');
    const std::string_view key = what.substr(0, space);
    const std::size_t number = key == "count"  ? cost.count
                               : key == "rows" ? cost.rows
                                               : cost.columns;
    return space == what.npos ? std::to_string(number) : counted(number, what.substr(space + 1));
  });
}

std::string effect_in_words(const Workload::Effect& effect, const SensedScene& scene) {
  if (!effect.simulated) return std::string(effect.row->absence);
  return effect.row->words(scene) + (effect.idle ? "; strength 0: no stage" : "");
}

void print_workload(std::ostream& out, const Scene& scene, const Workload& work) {
  print_workload_of(out, scene, work);
}
void print_workload(std::ostream& out, const SkinScene& scene, const Workload& work) {
  print_workload_of(out, scene, work);
}

}  // namespace tactile_net::report
