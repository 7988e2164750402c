#include "tactile_net/lab/parts_list.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "lab/circuit_loads.hpp"
#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/numeric/share_interval.hpp"
#include "tactile_net/scene/opamp_part.hpp"

namespace tactile_net::lab {
namespace {

/// Fewer of a large network, where each takes its time.
std::size_t draws_per_offer(const Reduction& reduction) {
  return reduction.rows() <= 250 ? 400 : 200;
}

/// How often a list is made anew, for a smaller target, whose draws miss the one that is asked for:
/// where few parts count, 95 of 100 builds lie further out than `p95_over_rms`.
constexpr std::uint64_t most_attempts = 4;

/// Rounded values may take so much of the error's budget: of the squares, so that 3 % are left to
/// gain by exacter ones.
constexpr double rounding_share = 0.25;

/// What of the target draws of a list must keep to: theirs is not quite that of others.
constexpr double tuned_share = 0.98;

// Seeds: of op-amps alone, of lists that are made, one each, and of the list that was made.
constexpr std::uint64_t of_opamps = 0;
constexpr std::uint64_t of_attempts = 1;
constexpr std::uint64_t of_claim = 1000;

/// One realisation, under all loads.
struct Offer {
  std::shared_ptr<const NetworkCircuit> circuit;
  std::vector<Load> loads{};
  PartsList::Candidate candidate{};
  std::vector<PartValue> values{};
};

using NetworkProblems = std::vector<std::shared_ptr<const NetworkProblem>>;

/// Makes pairs of resistors, those that count most first, until values take no more than they may.
class Rounding {
 public:
  Rounding(const LoadedNetwork& network, const Reduction& reduction, Series series)
      : network_(network), choice_(reduction, series), pairs_(choice_.groups().size()) {
    const std::vector<double> printed = siemens_of(choice_.values(pairs_));
    std::vector<std::vector<ResistorChange>> changes;
    for (const std::vector<std::size_t>& group : choice_.groups()) {
      std::vector<ResistorChange>& change = changes.emplace_back();
      for (const std::size_t r : group)
        change.push_back({r, printed[r] / reduction.siemens()[r] - 1.0});
    }
    const std::vector<double> squares = network_.squared_errors(changes);
    order_.resize(squares.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::size_t a, std::size_t b) { return squares[a] > squares[b]; });
  }

  /// A part that is better than the coarsest is not spoilt by its value.
  void pair_better(const Allocation& list) {
    for (std::size_t g = 0; g < pairs_.size(); ++g)
      for (const std::size_t r : choice_.groups()[g])
        if (list.class_of[r] > 0) pairs_[g] = true;
  }

  void pair_until(double allowed) {
    if (error(0) <= allowed) return;
    std::size_t few = 0;
    std::size_t enough = order_.size();
    while (enough - few > 1) {
      const std::size_t middle = few + (enough - few) / 2;
      (error(middle) <= allowed ? enough : few) = middle;
    }
    pairs_ = with_first(enough);
  }

  [[nodiscard]] std::vector<PartValue> values() const { return choice_.values(pairs_); }
  [[nodiscard]] double error() const { return error(0); }

 private:
  [[nodiscard]] std::vector<bool> with_first(std::size_t count) const {
    std::vector<bool> pairs = pairs_;
    for (std::size_t k = 0; k < count; ++k) pairs[order_[k]] = true;
    return pairs;
  }
  [[nodiscard]] double error(std::size_t first) const {
    return network_.error(siemens_of(choice_.values(with_first(first))));
  }

  const LoadedNetwork& network_;
  PartChoice choice_;
  std::vector<bool> pairs_;         // of every group
  std::vector<std::size_t> order_;  // of groups, those whose rounding counts most first
};

double second_parts(const Offer& offer, const AllocationOptions& wanted) {
  double price = 0.0;
  for (std::size_t r = 0; r < offer.values.size(); ++r)
    if (offer.values[r].joint != PartValue::Joint::single)
      price += wanted.classes[offer.candidate.list.class_of[r]].price;
  return price;
}

/// What is left of a target for parts when something else takes its part: squares add up.
double left_of(double target, double taken) {
  return std::sqrt(std::max(target * target - taken * taken, 0.0));
}

/// @param target  of the resistors alone, their rounded values included: what 95 of 100 builds err
void choose_parts(Offer& offer, const LoadedNetwork& network, const PartsList& parts,
                  double target) {
  PartsList::Candidate& result = offer.candidate;
  const std::vector<double> counts = network.sensitivities();
  Rounding rounding(network, offer.circuit->reduction(), parts.series);
  AllocationOptions wanted = parts.wanted;
  if (target > 0.0) wanted.target = target;
  result.list = allocate(counts, wanted);
  result.list.met = result.list.met && target > 0.0;
  if (result.list.met) {
    rounding.pair_better(result.list);
    rounding.pair_until(rounding_share * target / p95_over_rms);
    wanted.target = left_of(target, p95_over_rms * rounding.error());
    const bool room = wanted.target > 0.0;
    if (room) result.list = allocate(counts, wanted);
    rounding.pair_better(result.list);
    result.list.met = result.list.met && room;
  }
  result.rounding = rounding.error();
  offer.values = rounding.values();
  result.pairs = 0;
  for (const PartValue& one : offer.values)
    if (one.joint != PartValue::Joint::single) ++result.pairs;
  const double seconds = second_parts(offer, wanted);
  result.resistors_price = result.list.price + seconds;
  result.resistors_bound = result.list.price_bound + seconds;
  result.price = result.resistors_price + static_cast<double>(result.opamps) * parts.opamp_price;
}

std::vector<double> tolerances(const Offer& offer, const AllocationOptions& wanted) {
  std::vector<double> each;
  for (const std::size_t one : offer.candidate.list.class_of)
    each.push_back(wanted.classes[one].tolerance);
  return each;
}

double p95_of(const std::vector<double>& ascending) {
  return ascending[ascending.size() * 95 / 100];
}

/// Each of its class; those of the coarsest are of the reel that was measured, if one was.
ResistorErrors errors_of(const Offer& offer, const AllocationOptions& wanted,
                         const CommonErrors& common) {
  std::vector<ResistorError> each;
  for (const std::size_t one : offer.candidate.list.class_of)
    each.push_back(wanted.classes[one].spread
                       ? ResistorError{.kind = ResistorError::Kind::measured}
                       : ResistorError{.tolerance = wanted.classes[one].tolerance});
  return ResistorErrors(std::move(each), common);
}

/// Ascending.
std::vector<double> draw(const Offer& offer, const LoadedNetwork& network,
                         const AllocationOptions& wanted, const CommonErrors& common,
                         std::uint64_t seed) {
  return network.builds(siemens_of(offer.values), errors_of(offer, wanted, common),
                        draws_per_offer(offer.circuit->reduction()), seed);
}

/// Of builds that the list was not made with.
void claim(PartsList::Candidate& result, const std::vector<double>& errors, double target) {
  result.p95 = p95_of(errors);
  result.builds = errors.size();
  result.within = static_cast<std::size_t>(std::upper_bound(errors.begin(), errors.end(), target) -
                                           errors.begin());
}

/// With resistors of exactly the values wanted, but for what they have in common.
void draw_opamps(PartsList::Candidate& result, const LoadedNetwork& network,
                 const Reduction& reduction, CommonErrors common) {
  const std::size_t builds = draws_per_offer(reduction);
  const std::size_t resistors = reduction.resistors().size();
  result.opamps_alone = network.opamp_shares();
  if (result.opamps_alone.total > 0.0) {
    const ResistorErrors exact(std::vector<double>(resistors, 0.0));
    result.opamps_p95 = p95_of(network.builds(reduction.siemens(), exact, builds, of_opamps));
  }
  result.common_p95 = result.opamps_p95;
  if (!common.any()) return;
  if (common.measured) common.measured->spread = 0.0;
  const ResistorErrors alike(
      std::vector<ResistorError>(
          resistors,
          {.kind = common.measured ? ResistorError::Kind::measured : ResistorError::Kind::within}),
      common);
  result.common_p95 = p95_of(network.builds(reduction.siemens(), alike, builds, of_opamps));
}

Offer priced(const std::shared_ptr<const NetworkCircuit>& circuit, const NetworkProblems& problems,
             const PartsList& parts, const ToleranceOptions& drawn) {
  Offer offer{.circuit = circuit};
  PartsList::Candidate& result = offer.candidate;
  result.realization = circuit->realization();
  result.ladder = has_ladder(circuit->realization(), circuit->options());
  result.opamps = circuit->flat().amplifiers().size();
  result.stability = stability_of(*circuit);
  const std::vector<Load> loads = loads_of(*circuit, problems);
  const LoadedNetwork network(circuit->reduction(), loads,
                              {.errors = opamp_errors(circuit->flat(), loads),
                               .balance = drawn.balance.value_or(0.0),
                               .tare = drawn.tare});
  draw_opamps(result, network, circuit->reduction(), drawn.common);
  const double target = parts.wanted.target;
  double of_resistors = left_of(target, result.common_p95);
  choose_parts(offer, network, parts, of_resistors);
  if (!result.stable() || !result.list.met) return offer;
  const double bound = result.list.price_bound;
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    const double p95 =
        p95_of(draw(offer, network, parts.wanted, drawn.common, of_attempts + attempt));
    result.tuned = p95 <= tuned_share * target;
    if (result.tuned || !std::isfinite(p95) || attempt + 1 == most_attempts) break;
    const double seen = left_of(p95, result.common_p95);
    const double allowed = left_of(tuned_share * target, result.common_p95);
    if (!(seen > 0.0) || !(allowed > 0.0)) break;
    of_resistors *= std::min(allowed / seen, tuned_share);
    Offer exacter = offer;
    choose_parts(exacter, network, parts, of_resistors);
    if (!exacter.candidate.list.met) break;
    // What is asked for bounds the price, not what it took.
    exacter.candidate.list.price_bound = bound;
    exacter.candidate.resistors_bound = bound + second_parts(exacter, parts.wanted);
    offer = std::move(exacter);
  }
  claim(result, draw(offer, network, parts.wanted, drawn.common, of_claim), target);
  return offer;
}

std::vector<OrderedPart> order_of(const SolderedCircuit& soldered) {
  std::map<std::pair<double, double>, OrderedPart> order;
  for (std::size_t r = 0; r < soldered.parts.size(); ++r) {
    const auto& [ohm, tolerance] = soldered.parts[r];
    OrderedPart& part =
        order.try_emplace({tolerance, ohm}, OrderedPart{ohm, tolerance}).first->second;
    part.references.push_back(soldered.circuit.resistors[r].name);
  }
  std::vector<OrderedPart> parts;
  parts.reserve(order.size());
  for (auto& [key, part] : order) parts.push_back(std::move(part));
  return parts;
}

std::vector<PartsOfArray> by_array(const Offer& offer, std::size_t classes) {
  std::vector<PartsOfArray> arrays;
  const auto names = offer.circuit->reduction().resistors();
  for (std::size_t r = 0; r < names.size(); ++r) {
    const std::string array(name(place_of(names[r]).array));
    auto at = std::find_if(arrays.begin(), arrays.end(),
                           [&](const PartsOfArray& one) { return one.array == array; });
    if (at == arrays.end()) at = arrays.insert(at, {array, std::vector<std::size_t>(classes)});
    ++at->counts[offer.candidate.list.class_of[r]];
  }
  return arrays;
}

PartsList list_of(const SceneCircuit& circuit, double target,
                  const std::vector<std::shared_ptr<const NetworkCircuit>>& circuits) {
  if (!circuit.loaded())
    throw std::invalid_argument("there is no load: nothing for errors of components to change");
  const NetworkProblems problems = circuit_loads(circuit);
  PartsList result{.wanted = {.target = target}, .loads = problems.size()};
  result.series = circuit.tolerance().series.value_or(Series::e96);
  result.tare = circuit.tolerance().tare;
  const NetworkOptions& options = circuit.options();
  if (options.resistor_classes) result.wanted.classes = *options.resistor_classes;
  result.opamp_price = options.opamp_price.value_or(result.opamp_price);
  if (options.opamp_part != nullptr) result.opamp_part = options.opamp_part->name;
  std::vector<Offer> offers;
  offers.reserve(circuits.size());
  const ToleranceOptions drawn = circuit.tolerance();
  if (drawn.common.measured) result.wanted.classes.front().spread = drawn.common.measured->spread;
  for (const auto& one : circuits) offers.push_back(priced(one, problems, result, drawn));
  std::stable_sort(offers.begin(), offers.end(), [](const Offer& a, const Offer& b) {
    return a.candidate.good() != b.candidate.good() ? a.candidate.good()
                                                    : a.candidate.price < b.candidate.price;
  });
  for (const Offer& offer : offers) {
    result.candidates.push_back(offer.candidate);
    if (result.choice || !offer.candidate.good()) continue;
    result.chosen_at = result.candidates.size() - 1;
    PartsList::Choice choice{
        .soldered = soldered(offer.circuit->flat(), offer.values, tolerances(offer, result.wanted)),
        .arrays = by_array(offer, result.wanted.classes.size()),
        .network = offer.circuit,
        .bought = {siemens_of(offer.values), errors_of(offer, result.wanted, drawn.common)}};
    choice.soldered.amplifiers = package_of(options.opamp_part);
    choice.board = std::make_shared<const Board>(board_of(choice.soldered));
    choice.order = order_of(choice.soldered);
    result.choice = std::make_shared<const PartsList::Choice>(std::move(choice));
  }
  return result;
}

}  // namespace

std::pair<double, double> PartsList::Candidate::interval() const noexcept {
  return share_interval(within, builds);
}

bool PartsList::opamps_too_coarse() const noexcept {
  bool any = false;
  for (const Candidate& one : candidates) {
    if (!one.stable()) continue;
    any = true;
    if (one.opamps_p95 <= wanted.target) return false;
  }
  return any;
}

bool PartsList::common_too_coarse() const noexcept {
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& one) {
    return one.stable() && one.opamps_p95 <= wanted.target && one.common_p95 > wanted.target;
  });
}

PartsList parts_list(const SceneCircuit& circuit, double target) {
  return list_of(circuit, target, circuit.candidates());
}

PartsList own_parts_list(const SceneCircuit& circuit, double target) {
  const Realization own = circuit.network().realization();
  if (!traits(own).uses_opamps || !traits(own).linear())
    throw std::invalid_argument(
        "the realization " + std::string(name(own)) +
        " is not built of resistors and op-amps: there is no list to order");
  if (circuit.options().parts.inverters)
    throw std::invalid_argument(
        "a list of parts is of op-amps with complementary outputs: leave out inverters under "
        "[network]");
  return list_of(circuit, target, {circuit.shared_network()});
}

}  // namespace tactile_net::lab
