#include "tactile_net/lab/datasheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "lab/circuit_loads.hpp"
#include "tactile_net/network/drawn_circuit.hpp"
#include "tactile_net/network/operating_voltages.hpp"
#include "tactile_net/network/slewing.hpp"
#include "tactile_net/network/soldered_error.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/share_interval.hpp"
#include "tactile_net/scene/opamp_part.hpp"

namespace tactile_net::lab {
namespace {

using FigureKind = DatasheetFigure::Kind;
using MissingReason = MissingFigure::Reason;

constexpr double never_settles = std::numeric_limits<double>::infinity();
constexpr std::uint64_t of_datasheet = 2000;  ///< the seed: lists are made and claimed with others
constexpr double room_kelvin = 300.15;

/// Of draws at rest, which are linear algebra: fewer of a large network.
std::size_t builds_at_rest(std::size_t rows) {
  return rows <= 100 ? 1000 : rows <= 250 ? 400 : 200;
}

/// Of draws of poles: no fewer than bound what 95 of 100 are within.
std::size_t builds_over_time(std::size_t states) { return states <= 120 ? 200 : 75; }

/// What is built, and of which parts.
struct BuiltCircuit {
  std::shared_ptr<const NetworkCircuit> network;
  BoughtParts bought;
};

BuiltCircuit source_of(const SceneCircuit& circuit, const PartsList* parts,
                       const BoardCertificate* board) {
  if (parts != nullptr && parts->choice)
    return {board != nullptr ? board->circuit : parts->choice->network, parts->choice->bought};
  const NetworkCircuit& own = circuit.network();
  if (!traits(own.realization()).linear() || !traits(own.realization()).uses_opamps)
    throw std::invalid_argument("the realization " + std::string(name(own.realization())) +
                                " is not built of resistors and op-amps: it has no datasheet");
  return {board != nullptr ? board->circuit : circuit.shared_network(),
          bought_parts(own.reduction(), circuit.tolerance())};
}

Circuit build_of(const BuiltCircuit& source, const ToleranceOptions& drawn, std::size_t build) {
  return drawn_circuit(source.network->flat(),
                       {source.bought.printed, source.bought.errors, drawn.bandwidth.value_or(0.0)},
                       of_datasheet, build);
}

double kelvin_of(const BuiltCircuit& source, std::size_t build) {
  return room_kelvin + source.bought.errors.kelvin(of_datasheet, build);
}

/// What builds do over time.
struct OverTime {
  std::vector<double> settling{}, noise{};
  std::size_t unstable = 0;
};

double settling_of(const StateSpace& system, double accuracy, double slowest) {
  const bool slews = !system.slewing.empty() && system.states() <= most_slewing_states;
  return (slews ? slewing_settling_time(system, accuracy, slowest)
                : settling_time(system, accuracy, slowest))
      .value_or(never_settles);
}

/// Over the answer; nothing: it has no size.
std::optional<double> relative_noise_of(const FlatCircuit& circuit, const StateSpace& system,
                                        double kelvin) {
  try {
    const OutputNoise noise = output_noise(circuit, kelvin);
    double square = 0.0;
    for (std::size_t i = 0; i < noise.thermal.rows; ++i)
      square += noise.thermal(i, i) + noise.amplifiers(i, i) + noise.flicker(i, i);
    return std::sqrt(square) / l2_norm(steady_state(system));
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

OverTime seen_over_time(const BuiltCircuit& source, const Datasheet& sheet, bool noisy,
                        std::size_t builds) {
  OverTime result;
  for (std::size_t build = 0; build < builds; ++build) {
    const FlatCircuit circuit(build_of(source, sheet.drawn, build));
    const StateSpace system = state_space(circuit);
    const double slowest = poles(system).front().real();
    if (!(slowest < 0.0)) {
      ++result.unstable;
      result.settling.push_back(never_settles);
      if (noisy) result.noise.push_back(never_settles);
      continue;
    }
    result.settling.push_back(settling_of(system, sheet.settling_accuracy, slowest));
    if (!noisy) continue;
    if (const auto noise = relative_noise_of(circuit, system, kelvin_of(source, build)))
      result.noise.push_back(*noise);
  }
  return result;
}

}  // namespace

DatasheetFigure::Verdict DatasheetFigure::verdict() const noexcept {
  if (!limit) return Verdict::no_limit;
  if (p95_most <= *limit) return Verdict::passes;
  return p95_least > *limit ? Verdict::fails : Verdict::open;
}

bool Datasheet::passes() const noexcept {
  return std::none_of(figures.begin(), figures.end(), [](const DatasheetFigure& one) {
    return one.verdict() == DatasheetFigure::Verdict::fails;
  });
}

DatasheetFigure figure_of(FigureKind kind, std::vector<double> values,
                          std::optional<double> limit) {
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  const auto [low, high] = quantile_ranks(count, 0.95);
  const double most = high > count ? never_settles : values[high - 1];
  return {.kind = kind,
          .builds = count,
          .least = values.front(),
          .typical = values[count / 2],
          .p95 = values[std::min(count * 95 / 100, count - 1)],
          .p95_least = low == 0 ? values.front() : values[low - 1],
          .p95_most = most,
          .limit = limit};
}

Circuit datasheet_build(const SceneCircuit& circuit, const PartsList* parts, std::size_t build,
                        const BoardCertificate* board) {
  return build_of(source_of(circuit, parts, board), circuit.tolerance(), build);
}

double datasheet_kelvin(const SceneCircuit& circuit, const PartsList* parts, std::size_t build) {
  return kelvin_of(source_of(circuit, parts, nullptr), build);
}

Datasheet datasheet(const SceneCircuit& circuit, const PartsList* parts,
                    const BoardCertificate* board) {
  if (!circuit.loaded())
    throw std::invalid_argument("there is no load: no answer for a datasheet to compare with");
  const BuiltCircuit source = source_of(circuit, parts, board);
  const NetworkCircuit& network = *source.network;
  const NetworkOptions& options = circuit.options();
  const DatasheetLimits& limits = options.limits;
  Datasheet sheet{.realization = network.realization(),
                  .ladder = has_ladder(network.realization(), network.options()),
                  .opamps = network.flat().amplifiers().size(),
                  .ordered = parts != nullptr && parts->choice,
                  .on_board = board != nullptr,
                  .drawn = circuit.tolerance(),
                  .settling_accuracy = options.settling_accuracy.value_or(1e-3)};
  const OpAmp& opamp = network.options().opamp;
  sheet.drift_unknown = sheet.drawn.common.temperature && opamp.offset && !opamp.offset_drift;
  if (options.opamp_part != nullptr) sheet.opamp_part = options.opamp_part->name;
  const auto miss = [&](FigureKind kind, MissingReason reason) {
    sheet.missing.push_back({kind, reason});
  };

  const auto problems = circuit_loads(circuit);
  sheet.loads = problems.size();
  const std::vector<Load> loads = loads_of(network, problems);
  const LoadedNetwork loaded(network.reduction(), loads,
                             {.errors = opamp_errors(network.flat(), loads),
                              .balance = sheet.drawn.balance.value_or(0.0),
                              .tare = sheet.drawn.tare});
  const std::size_t resting = builds_at_rest(network.reduction().rows());
  std::optional<double> error = limits.error;
  if (!error && sheet.ordered) error = parts->wanted.target;
  sheet.figures.push_back(figure_of(
      FigureKind::error,
      loaded.builds(source.bought.printed, source.bought.errors, resting, of_datasheet), error));
  if (const std::vector<double> offsets =
          loaded.offsets(source.bought.errors, resting, of_datasheet);
      !offsets.empty())
    sheet.figures.push_back(figure_of(FigureKind::offset, offsets, limits.offset));
  else
    miss(FigureKind::offset, MissingReason::no_offset);

  const std::size_t states =
      takes_time(network.realization(), network.options()) ? count_states(network.flat()) : 0;
  const std::size_t builds = builds_over_time(states);
  const bool stated = opamp.noise_voltage || opamp.noise_current;
  if (states > 0 && states <= most_datasheet_states) {
    OverTime seen = seen_over_time(source, sheet, stated, builds);
    sheet.unstable = seen.unstable;
    sheet.figures.push_back(
        figure_of(FigureKind::settling, std::move(seen.settling), limits.settling));
    if (seen.noise.size() == builds)
      sheet.figures.push_back(figure_of(FigureKind::noise, std::move(seen.noise), limits.noise));
    else
      miss(FigureKind::noise, MissingReason::no_noise);
  } else {
    const MissingReason why =
        states == 0 ? MissingReason::no_bandwidth : MissingReason::too_many_states;
    miss(FigureKind::settling, why);
    miss(FigureKind::noise, stated ? why : MissingReason::no_noise);
  }

  if (options.opamp_part == nullptr || !options.opamp_part->supply_current) {
    miss(FigureKind::supply_current, MissingReason::no_part);
    return sheet;
  }
  std::vector<double> currents;
  for (std::size_t build = 0; build < builds; ++build)
    currents.push_back(static_cast<double>(sheet.opamps) * *options.opamp_part->supply_current +
                       sourced_current(FlatCircuit(build_of(source, sheet.drawn, build))));
  sheet.figures.push_back(
      figure_of(FigureKind::supply_current, std::move(currents), limits.supply_current));
  return sheet;
}

}  // namespace tactile_net::lab
