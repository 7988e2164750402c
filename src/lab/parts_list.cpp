#include "tactile_net/lab/parts_list.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "lab/circuit_candidates.hpp"

namespace tactile_net::lab {
namespace {

constexpr std::size_t draws = 200;

PartsList::Candidate priced(const NetworkCircuit& circuit, const PartsList& parts) {
  const Reduction& reduction = circuit.reduction();
  PartsList::Candidate result{.realization = circuit.realization(),
                              .opamps = circuit.flat().amplifiers().size(),
                              .stable = is_stable_with_its_opamps(circuit),
                              .list = allocate(relative_sensitivities(reduction), parts.wanted)};
  result.price = result.list.price + static_cast<double>(result.opamps) * parts.opamp_price;
  if (!result.stable || !result.list.met) return result;
  ToleranceOptions drawn{.trials = draws};
  for (const std::size_t one : result.list.class_of)
    drawn.each.push_back(parts.wanted.classes[one].tolerance);
  result.p95 = tolerate(reduction, drawn).p95;
  return result;
}

/// What a resistor belongs to, by the first letters of its name (src/network/realizations).
std::string array_of(const std::string& resistor) {
  if (resistor.find('.') != std::string::npos) return "converters and inverters";
  static const std::map<std::string, std::string> arrays = {{"Rk", "K"},
                                                            {"Rt", "K transposed"},
                                                            {"Rs", "stabiliser"},
                                                            {"Re", "residuals' feedback"},
                                                            {"Rg", "to ground"}};
  const auto letters = std::find_if(resistor.begin(), resistor.end(), [](char one) {
    return std::isdigit(static_cast<unsigned char>(one)) != 0;
  });
  const auto found = arrays.find(std::string(resistor.begin(), letters));
  return found == arrays.end() ? "P" : found->second;
}

NetworkCircuit chosen_circuit(const PartsList& list, const SceneCircuit& circuit) {
  return candidate(list.chosen().realization, circuit);
}

}  // namespace

PartsList parts_list(const SceneCircuit& circuit, double target) {
  if (!circuit.loaded())
    throw std::invalid_argument("there is no load: nothing for errors of components to change");
  PartsList result{.wanted = {.target = target}};
  for (const Realization one : candidates(circuit))
    result.candidates.push_back(priced(candidate(one, circuit), result));
  std::stable_sort(result.candidates.begin(), result.candidates.end(),
                   [](const auto& a, const auto& b) {
                     return a.good() != b.good() ? a.good() : a.price < b.price;
                   });
  const auto& all = result.candidates;
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const auto& one) { return one.good() && *one.p95 <= target; });
  if (found != all.end()) result.choice = static_cast<std::size_t>(found - all.begin());
  return result;
}

std::vector<OrderedPart> order_of(const PartsList& list, const SceneCircuit& circuit) {
  const NetworkCircuit built = chosen_circuit(list, circuit);
  const Reduction& reduction = built.reduction();
  std::map<std::pair<double, double>, OrderedPart> order;
  for (std::size_t r = 0; r < reduction.resistors().size(); ++r) {
    const double tolerance = list.wanted.classes[list.chosen().list.class_of[r]].tolerance;
    const double ohm = 1.0 / reduction.siemens()[r];
    OrderedPart& part =
        order.try_emplace({tolerance, ohm}, OrderedPart{ohm, tolerance}).first->second;
    part.references.push_back(reduction.resistors()[r]);
  }
  std::vector<OrderedPart> parts;
  for (auto& [key, part] : order) parts.push_back(std::move(part));
  return parts;
}

std::vector<PartsOfArray> by_array(const PartsList& list, const SceneCircuit& circuit) {
  const NetworkCircuit built = chosen_circuit(list, circuit);
  std::vector<PartsOfArray> arrays;
  for (std::size_t r = 0; r < built.reduction().resistors().size(); ++r) {
    const std::string array = array_of(built.reduction().resistors()[r]);
    auto at = std::find_if(arrays.begin(), arrays.end(),
                           [&](const PartsOfArray& one) { return one.array == array; });
    if (at == arrays.end())
      at = arrays.insert(at, {array, std::vector<std::size_t>(list.wanted.classes.size())});
    ++at->counts[list.chosen().list.class_of[r]];
  }
  return arrays;
}

}  // namespace tactile_net::lab
