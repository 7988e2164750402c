#include "scene/refine_section.hpp"

#include <vector>

namespace tactile_net {
namespace {

constexpr Rule below_half{"must be >= 0 and < 0.5",
                          [](double x) noexcept { return x >= 0.0 && x < 0.5; }};

/// What no theorem on refinement speaks of.
void check_circuit(const Value& refine, const NetworkOptions& network) {
  if (!traits(network.realization).drives_nodes)
    refine.problem("is of circuits whose nodes op-amps drive, and " +
                       std::string(name(network.realization)) + " has none",
                   "realization = \"lattice\", \"least_squares\" or \"crossbar\"");
  else if (network.parts.inverters || has_ladder(network.realization, network.parts))
    refine.problem("is of circuits with complementary outputs and without a ladder",
                   "under [network], neither inverters nor ladder");
  if (!network.tolerance) return;
  const ToleranceOptions& tolerance = *network.tolerance;
  if (tolerance.common.any() || tolerance.balance || tolerance.cell_noise ||
      tolerance.wire_resistance)
    refine.problem(
        "is of parts whose errors are bounded and each its own, and the tolerance has reel, "
        "measured, temperature, balance, cell_noise or wire_resistance",
        "tolerance = { relative = 0.01 }, with stabiliser, series or bits");
}

}  // namespace

RefinementOptions read_refine(const Value& refine, const NetworkOptions& network) {
  RefinementOptions options;
  const auto given = refine.table();
  if (!given) return options;
  Table table = *given;
  Converters converters;
  if (const auto bits = table.value("bits"))
    converters.bits = static_cast<int>(bits->integer(4, 24).value_or(converters.bits));
  if (const auto cycles = table.value("cycles"))
    options.cycles = static_cast<std::size_t>(
        cycles->integer(1, static_cast<std::int64_t>(most_refinement_cycles)).value_or(4));
  converters.gain = number_or(table.value("gain"), below_half, converters.gain);
  converters.noise = number_or(table.value("noise"), not_negative, converters.noise);
  converters.conversion =
      number_or(table.value("conversion"), not_negative, converters.conversion, in_seconds);
  if (const auto step = table.value("step")) {
    std::vector<std::string_view> names;
    for (const auto& one : Enumerators<RefinementStep>::all) names.push_back(one.name);
    if (const auto index = step->one_of("step", names))
      options.step = Enumerators<RefinementStep>::all[*index].value;
  }
  table.finish();
  options.converters = converters;
  check_circuit(refine, network);
  return options;
}

}  // namespace tactile_net
