#include "tactile_net/report/words/parts_words.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "tactile_net/network/board.hpp"
#include "tactile_net/network/kicad_schematic.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/network_words.hpp"

namespace tactile_net::report {
namespace {

/// Parts that are bought: what is on the board but test points and holes.
std::vector<Footprint> bought_parts(const lab::PartsList& list) {
  std::vector<Footprint> parts = list.choice->board->footprints;
  std::erase_if(parts, [](const Footprint& one) { return !one.is_bought(); });
  std::sort(parts.begin(), parts.end(), [](const Footprint& a, const Footprint& b) {
    return std::pair(a.kind, a.number) < std::pair(b.kind, b.number);
  });
  return parts;
}

/// Of an amplifier what it is ordered by; of a resistor nothing.
std::string order_number(const lab::PartsList& list, const Footprint& one) {
  return one.kind == Footprint::Kind::amplifier ? list.opamp_part : std::string();
}

std::map<std::string, std::string> designators_of(const std::vector<Footprint>& parts) {
  std::map<std::string, std::string> designators;  // by the deck's names
  for (const Footprint& one : parts) designators[one.element] = one.reference();
  return designators;
}

std::string watts_in_words(const Footprint& one) {
  return brief(one.watt) + " W where a part of this size carries " + brief(one.rated_watt) + " W";
}

/// Of resistors that would burn; empty: none would.
std::string overload_in_words(const std::vector<Footprint>& parts) {
  const auto count = std::count_if(parts.begin(), parts.end(),
                                   [](const Footprint& one) { return one.overloaded(); });
  if (count == 0) return {};
  const auto worst = std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.watt - a.rated_watt < b.watt - b.rated_watt;
  });
  return ". " + std::to_string(count) + (count == 1 ? " resistor takes" : " resistors take") +
         " more power than a part of its size carries, " + worst->reference() + " (" +
         worst->element + ") " + watts_in_words(*worst) +
         ": choose a larger size for them, fewer siemens, or fewer volts";
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

std::string drawn(const lab::PartsList& list, const lab::PartsList::Candidate& one) {
  if (!one.stable()) return stability_with_opamps_in_words(one.stability.stability);
  if (one.opamps_p95 > list.wanted.target)
    return "its op-amps alone: " +
           (std::isfinite(one.opamps_p95) ? percent(one.opamps_p95) : "unstable");
  if (one.common_p95 > list.wanted.target)
    return "its reel and temperature alone: " +
           (std::isfinite(one.common_p95) ? percent(one.common_p95) : "unstable");
  if (!one.list.met) return "not with these classes";
  return std::isfinite(*one.p95) ? percent(*one.p95) : "unstable";
}

/// "offset 0.102 %, bias current 0.01 %": what of op-amps takes how much, root mean squares.
std::string opamp_shares_in_words(const OpAmpShares& shares) {
  std::vector<std::string> parts;
  const auto add = [&](const char* of, double share) {
    if (share > 0.0) parts.push_back(std::string(of) + ' ' + percent(share));
  };
  add("offset", shares.offset);
  add("bias current", shares.bias_current);
  add("balance", shares.balance);
  add("finite gain", shares.gain);
  add("common-mode rejection", shares.common_mode);
  add("output resistance", shares.output_resistance);
  return join(parts, ", ");
}

/// Why there is no list.
std::string none_in_words(const lab::PartsList& list) {
  const std::string target = percent(list.wanted.target);
  const auto& all = list.candidates;
  const auto stable = [](const auto& one) { return one.stable(); };
  if (std::none_of(all.begin(), all.end(), stable))
    return "No list of parts: no realisation is known to be stable with these op-amps and "
           "capacitances. Raise siemens, or take op-amps with less input capacitance; certify says "
           "why for each realisation.";
  if (list.common_too_coarse())
    return "No resistors keep 95 of 100 builds within " + target +
           ": what all of a build have in common, their reel and the temperature, alone takes "
           "more. "
           "With readings that come as voltages, inputs = \"voltage\" under [network], it cancels.";
  if (!list.opamps_too_coarse())
    return "No list of parts of these classes keeps 95 of 100 builds within " + target +
           ": raise alpha, or take better parts.";
  const auto best = std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.stable() != b.stable() ? a.stable() : a.opamps_p95 < b.opamps_p95;
  });
  return "No resistors keep 95 of 100 builds within " + target +
         ": the op-amps alone take more. Of " + circuit_in_words(best->realization, best->ladder) +
         ", which they disturb least, 95 of 100 builds with exact resistors are within " +
         percent(best->opamps_p95) +
         " (root mean squares: " + opamp_shares_in_words(best->opamps_alone) +
         "). Raise volts to lower what offsets and bias currents do" +
         (list.tare ? ""
                    : ", or let the controller subtract the answer without readings, tare = true "
                      "in tolerance, which takes them away") +
         "; better op-amps lower all of it.";
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
    row.push_back(drawn(list, one));
  }
  return rows;
}

std::string in_words(const lab::PartsList& list) {
  const std::string target = percent(list.wanted.target);
  if (!list.choice) return none_in_words(list);
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
            " of them two parts in series or in parallel: buy " + bought(list);
  text += ". Rounding to them moves the answer by " + percent(chosen.rounding);
  if (chosen.opamps_alone.total > 0.0)
    text += ", the op-amps by " + percent(chosen.opamps_alone.total) +
            " (root mean squares: " + opamp_shares_in_words(chosen.opamps_alone) + ")";
  if (list.tare)
    text +=
        ". Answers are read less those without readings, in which offsets and bias currents are";
  const auto [least, most] = chosen.interval();
  text += ". Of " + std::to_string(chosen.builds) +
          " builds drawn anew, with which nothing was chosen, " + std::to_string(chosen.within) +
          " are within " + target + ": of all, " + percent(least) + " to " + percent(most) +
          " are (95 % confidence, Wilson's interval)";
  const auto& sold = list.choice->soldered.parts;
  const auto rare = std::count_if(sold.begin(), sold.end(),
                                  [](const SoldPart& one) { return !is_common(one.ohm); });
  if (rare > 0)
    text += ". " + std::to_string(rare) +
            " are below 1 ohm or above 10 megohm, which few shops have: change siemens under "
            "[network], which scales all of them";
  text += overload_in_words(bought_parts(list));
  if (list.loads > 1)
    text += ". Root mean squares over the contacts at " + std::to_string(list.loads) + " places";
  return text + ".";
}

std::string order_csv(const lab::PartsList& list) {
  const std::vector<Footprint> parts = bought_parts(list);
  const std::map<std::string, std::string> designators = designators_of(parts);
  std::string text = "ohm,tolerance,quantity,references,part\n";
  for (const lab::OrderedPart& part : list.choice->order) {
    std::vector<std::string> references;
    for (const std::string& element : part.references)
      references.push_back(designators.at(element));
    text += shortest(part.ohm) + ',' + shortest(part.tolerance) + ',' +
            std::to_string(references.size()) + ',' + join(references, " ") + ",resistor\n";
  }
  std::map<std::string, std::vector<std::string>> others;  // by what they are
  for (const Footprint& one : parts) {
    if (one.kind == Footprint::Kind::amplifier)
      others[list.opamp_part.empty() ? one.value : one.value + ' ' + list.opamp_part].push_back(
          one.reference());
    if (one.kind == Footprint::Kind::capacitor)
      others["capacitor " + one.value].push_back(one.reference());
    if (one.kind == Footprint::Kind::header) others[one.value].push_back(one.reference());
  }
  for (const auto& [value, references] : others)
    text +=
        ",," + std::to_string(references.size()) + ',' + join(references, " ") + ',' + value + '\n';
  return text;
}

std::string bill_csv(const lab::PartsList& list) {
  const std::vector<Footprint> parts = bought_parts(list);
  const std::map<std::string, std::string> designators = designators_of(parts);
  const SolderedCircuit& soldered = list.choice->soldered;
  std::string text = "Comment,Designator,Footprint,MPN,Tolerance,Element,Pair partner,Note\n";
  std::size_t resistor = 0;
  for (const Footprint& one : parts) {
    std::string partner;
    if (one.kind == Footprint::Kind::resistor) {
      const std::size_t other = soldered.partner[resistor];
      if (other != resistor) partner = designators.at(soldered.circuit.resistors[other].name);
      ++resistor;
    }
    text += one.value + ',' + one.reference() + ',' + one.package() + ',' +
            order_number(list, one) + ',' + one.tolerance + ',' + one.element + ',' + partner +
            ',' + (one.overloaded() ? watts_in_words(one) : "") + '\n';
  }
  return text;
}

std::string board_text(const lab::PartsList& list) {
  std::ostringstream text;
  write_kicad_board(text, *list.choice->board);
  return std::move(text).str();
}

std::string positions_csv(const lab::PartsList& list) {
  std::ostringstream text;
  write_positions(text, *list.choice->board);
  return std::move(text).str();
}

std::vector<std::pair<std::string, std::string>> schematic_texts(const lab::PartsList& list) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (SchematicFile& file : kicad_schematic(*list.choice->board, list.opamp_part))
    texts.emplace_back(std::move(file.name), std::move(file.text));
  return texts;
}

std::string project_text() {
  std::ostringstream text;
  write_kicad_project(text);
  return std::move(text).str();
}

}  // namespace tactile_net::report
