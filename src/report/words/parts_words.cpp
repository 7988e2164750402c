#include "tactile_net/report/words/parts_words.hpp"

#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::report {
namespace {

std::string drawn(const lab::PartsList::Candidate& one) {
  if (!one.stable) return "unstable with its op-amps";
  if (!one.list.met) return "not with these classes";
  return std::isfinite(*one.p95) ? percent(*one.p95) : "unstable";
}

}  // namespace

std::vector<std::vector<std::string>> cells(const lab::PartsList& list) {
  std::vector<std::vector<std::string>> rows = {{"realisation", "op-amps"}};
  for (const PartClass& one : list.wanted.classes)
    rows[0].push_back("R of " + percent(one.tolerance));
  for (const std::string head : {"price", "95 of 100 builds"}) rows[0].push_back(head);
  for (const auto& one : list.candidates) {
    std::vector<std::string>& row = rows.emplace_back();
    row = {std::string(name(one.realization)), std::to_string(one.opamps)};
    for (const std::size_t count : one.list.counts) row.push_back(std::to_string(count));
    row.push_back(brief(one.price));
    row.push_back(drawn(one));
  }
  return rows;
}

std::string in_words(const lab::PartsList& list, const lab::SceneCircuit& circuit) {
  const std::string target = percent(list.wanted.target);
  if (!list.choice)
    return "No list of parts of these classes keeps 95 of 100 builds within " + target +
           ": a larger alpha, or better parts.";
  const lab::PartsList::Candidate& chosen = list.chosen();
  std::string text =
      "For " + target + " in 95 of 100 builds: " + std::string(name(chosen.realization)) + ", " +
      std::to_string(chosen.opamps) + " op-amps and resistors for " + brief(chosen.list.price) +
      " (no list is below " + brief(chosen.list.price_bound) + ").";
  std::vector<std::string> better;
  for (const lab::PartsOfArray& array : by_array(list, circuit))
    for (std::size_t c = 1; c < array.counts.size(); ++c)
      if (array.counts[c] > 0)
        better.push_back(std::to_string(array.counts[c]) + " of " +
                         percent(list.wanted.classes[c].tolerance) + " in " + array.array);
  const std::string coarsest = percent(list.wanted.classes.front().tolerance);
  if (better.empty()) return text + " All are of " + coarsest + ".";
  return text + " All are of " + coarsest + " but " + join(better, ", ") + ".";
}

std::string order_csv(const lab::PartsList& list, const lab::SceneCircuit& circuit) {
  std::string text = "ohm,tolerance,quantity,references\n";
  for (const lab::OrderedPart& part : order_of(list, circuit))
    text += shortest(part.ohm) + ',' + shortest(part.tolerance) + ',' +
            std::to_string(part.references.size()) + ',' + join(part.references, " ") + '\n';
  return text;
}

}  // namespace tactile_net::report
