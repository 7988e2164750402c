#include "tactile_net/network/part_values.hpp"

#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "tactile_net/network/arrays.hpp"

namespace tactile_net {
namespace {

double off_by(const PartValue& value, double ohm) { return std::abs(std::log(value.ohm() / ohm)); }

}  // namespace

double PartValue::ohm() const noexcept {
  switch (joint) {
    case Joint::single:
      return first;
    case Joint::series:
      return first + second;
    case Joint::parallel:
      return 1.0 / (1.0 / first + 1.0 / second);
  }
  return first;
}

PartValue nearest_part(Series series, double ohm) { return {.first = nearest_in(series, ohm)}; }

PartValue nearest_pair(Series series, double ohm) {
  PartValue best = nearest_part(series, ohm);
  const auto consider = [&](const PartValue& one) {
    if (is_common(ohm) && !(is_common(one.first) && is_common(one.second))) return;
    if (off_by(one, ohm) < off_by(best, ohm)) best = one;
  };
  // The first is the larger share, at least half: the second makes up for what is left of it. Half
  // steps, since values stray from their places, and the nearest in ratio need not be the best.
  const int count = 2 * static_cast<int>(series);
  const auto beside = [&](PartValue::Joint joint, double first, double rest) {
    for (const int step : {-1, 0, 1})
      consider({joint, first, nearest_in(series, rest * std::pow(10.0, 1.0 * step / count))});
  };
  for (int step = 0; step <= count / 3 + 2; ++step) {
    const double share = std::pow(10.0, -1.0 * step / count);
    const double longer = nearest_in(series, ohm * share);
    if (longer < ohm) beside(PartValue::Joint::series, longer, ohm - longer);
    const double wider = nearest_in(series, ohm / share);
    // A value that is the series' own but for rounding leaves nothing.
    const double rest = 1.0 / (1.0 / ohm - 1.0 / wider);
    if (wider > ohm && std::isfinite(rest)) beside(PartValue::Joint::parallel, wider, rest);
  }
  return best;
}

PartChoice::PartChoice(const Reduction& reduction, Series series) : series_(series) {
  const auto names = reduction.resistors();
  std::unordered_map<std::string_view, std::size_t> group_of;
  for (std::size_t r = 0; r < names.size(); ++r) {
    const double siemens = reduction.siemens()[r];
    if (!(siemens > 0.0))
      throw std::invalid_argument("resistor " + names[r] + " is negative: it is not sold");
    ohm_.push_back(1.0 / siemens);
    const std::string entry = same_entry(names[r]);
    const auto same = group_of.find(entry);
    if (!entry.empty() && same != group_of.end()) {
      groups_[same->second].push_back(r);
      continue;
    }
    group_of.emplace(names[r], groups_.size());
    groups_.push_back({r});
  }
}

std::vector<PartValue> PartChoice::values(const std::vector<bool>& pairs) const {
  std::vector<PartValue> result(ohm_.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const auto nearest = pairs[g] ? nearest_pair : nearest_part;
    const std::size_t first = groups_[g].front();
    result[first] = nearest(series_, ohm_[first]);
    for (std::size_t k = 1; k < groups_[g].size(); ++k) {
      const std::size_t other = groups_[g][k];
      const double ratio = ohm_[other] / ohm_[first];
      // Equal but for rounding: not one of its own beside a tie.
      result[other] = std::abs(ratio - 1.0) < 1e-12 ? result[first]
                                                    : nearest(series_, ratio * result[first].ohm());
    }
  }
  return result;
}

std::vector<double> siemens_of(std::span<const PartValue> values) {
  std::vector<double> siemens;
  siemens.reserve(values.size());
  for (const PartValue& one : values) siemens.push_back(1.0 / one.ohm());
  return siemens;
}

SolderedCircuit soldered(const FlatCircuit& circuit, std::span<const PartValue> values,
                         std::span<const double> tolerances) {
  SolderedCircuit result{.circuit = circuit.circuit()};
  const std::vector<Resistor> wanted = std::move(result.circuit.resistors);
  if (values.size() != wanted.size() || tolerances.size() != wanted.size())
    throw std::invalid_argument("a soldered circuit needs a value and a tolerance a resistor");
  std::vector<Resistor>& resistors = result.circuit.resistors;
  resistors.clear();
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    const auto& [name, from, to, siemens] = wanted[r];
    const PartValue& value = values[r];
    const std::size_t here = resistors.size();
    const auto solder = [&](const std::string& part, Node begin, Node end, double ohm,
                            std::size_t partner) {
      resistors.push_back({part, begin, end, 1.0 / ohm});
      result.parts.push_back({ohm, tolerances[r]});
      result.partner.push_back(partner);
    };
    if (value.joint == PartValue::Joint::single) {
      solder(name, from, to, value.first, here);
      continue;
    }
    const bool in_series = value.joint == PartValue::Joint::series;
    const Node middle = in_series ? add_node(result.circuit, 'm' + name) : 0;
    solder(name + 'a', from, in_series ? middle : to, value.first, here + 1);
    solder(name + 'b', in_series ? middle : from, to, value.second, here);
  }
  return result;
}

}  // namespace tactile_net
