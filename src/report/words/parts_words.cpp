#include "tactile_net/report/words/parts_words.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

constexpr const char* opamp = "op-amp with two outputs";

std::vector<std::string> opamps_of(const lab::PartsList::Choice& choice) {
  std::vector<std::string> references;
  for (const Instance& one : choice.soldered.circuit.instances) references.push_back(one.name);
  return references;
}

/// How many of each class are bought, of a pair both.
std::string bought(const lab::PartsList& list) {
  std::vector<std::string> each;
  for (const PartClass& one : list.wanted.classes) {
    std::size_t count = 0;
    for (const lab::OrderedPart& part : list.choice->order)
      if (part.tolerance == one.tolerance) count += part.references.size();
    if (count > 0) each.push_back(std::to_string(count) + " of " + percent(one.tolerance));
  }
  return join(each, ", ");
}

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
  for (const std::string head : {"in pairs", "price", "95 of 100 builds"}) rows[0].push_back(head);
  for (const auto& one : list.candidates) {
    std::vector<std::string>& row = rows.emplace_back();
    row = {circuit_in_words(one.realization, one.ladder), std::to_string(one.opamps)};
    for (const std::size_t count : one.list.counts) row.push_back(std::to_string(count));
    row.push_back(std::to_string(one.pairs));
    row.push_back(brief(one.price));
    row.push_back(drawn(one));
  }
  return rows;
}

std::string in_words(const lab::PartsList& list) {
  const std::string target = percent(list.wanted.target);
  if (!list.choice)
    return "No list of parts of these classes keeps 95 of 100 builds within " + target +
           ": a larger alpha, or better parts.";
  const lab::PartsList::Candidate& chosen = list.chosen();
  std::string text =
      "For " + target +
      " in 95 of 100 builds: " + circuit_in_words(chosen.realization, chosen.ladder) + ", " +
      std::to_string(chosen.opamps) + " op-amps and resistors for " +
      brief(chosen.resistors_price) + " (no list is below " + brief(chosen.resistors_bound) + ").";
  std::vector<std::string> better;
  for (const lab::PartsOfArray& array : list.choice->arrays)
    for (std::size_t c = 1; c < array.counts.size(); ++c)
      if (array.counts[c] > 0)
        better.push_back(std::to_string(array.counts[c]) + " of " +
                         percent(list.wanted.classes[c].tolerance) + " in " + array.array);
  const std::string coarsest = percent(list.wanted.classes.front().tolerance);
  text += " All are of " + coarsest;
  if (!better.empty()) text += " but " + join(better, ", ");
  text += ". Values are of the series E" + std::to_string(static_cast<int>(list.series));
  if (chosen.pairs > 0)
    text += ", " + std::to_string(chosen.pairs) +
            " of them two parts in series or in parallel: to buy are " + bought(list);
  text += ". Rounding to them moves the answer by " + percent(chosen.rounding);
  const auto& sold = list.choice->soldered.parts;
  const auto rare = std::count_if(sold.begin(), sold.end(),
                                  [](const SoldPart& one) { return !is_common(one.ohm); });
  if (rare > 0)
    text += ". " + std::to_string(rare) +
            " are below 1 ohm or above 10 megohm, which few shops have: siemens under [network] "
            "moves them all";
  if (list.loads > 1)
    text += ". Root mean squares over the contacts at " + std::to_string(list.loads) + " places";
  return text + ".";
}

std::string order_csv(const lab::PartsList& list) {
  std::string text = "ohm,tolerance,quantity,references,part\n";
  for (const lab::OrderedPart& part : list.choice->order)
    text += shortest(part.ohm) + ',' + shortest(part.tolerance) + ',' +
            std::to_string(part.references.size()) + ',' + join(part.references, " ") +
            ",resistor\n";
  const std::vector<std::string> opamps = opamps_of(*list.choice);
  return text + ",," + std::to_string(opamps.size()) + ',' + join(opamps, " ") + ',' + opamp + '\n';
}

std::string bill_csv(const lab::PartsList& list) {
  const SolderedCircuit& soldered = list.choice->soldered;
  const std::vector<Resistor>& resistors = soldered.circuit.resistors;
  std::map<std::pair<double, double>, std::size_t> quantities;
  for (const lab::OrderedPart& part : list.choice->order)
    quantities[{part.tolerance, part.ohm}] = part.references.size();
  std::string text = "reference,ohm,tolerance,pair_partner,quantity_of_value,part\n";
  for (std::size_t r = 0; r < resistors.size(); ++r) {
    const auto& [ohm, tolerance] = soldered.parts[r];
    const std::size_t partner = soldered.partner[r];
    text += resistors[r].name + ',' + shortest(ohm) + ',' + shortest(tolerance) + ',' +
            (partner == r ? "" : resistors[partner].name) + ',' +
            std::to_string(quantities.at({tolerance, ohm})) + ",resistor\n";
  }
  const std::vector<std::string> opamps = opamps_of(*list.choice);
  for (const std::string& one : opamps)
    text += one + ",,,," + std::to_string(opamps.size()) + ',' + opamp + '\n';
  return text;
}

std::string board_text(const lab::PartsList& list) {
  std::ostringstream text;
  write_kicad_board(text, board_of(list.choice->soldered));
  return std::move(text).str();
}

}  // namespace tactile_net::report
