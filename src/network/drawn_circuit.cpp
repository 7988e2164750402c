#include "tactile_net/network/drawn_circuit.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "network/opamp_draws.hpp"

namespace tactile_net {
namespace {

constexpr std::uint64_t of_bandwidth = std::uint64_t{1} << 42U;

bool any_of_models(const Circuit& circuit, std::optional<double> OpAmp::*key) {
  return std::any_of(
      circuit.amplifiers.begin(), circuit.amplifiers.end(),
      [&](const AmplifierModel& model) { return (model.opamp.*key).value_or(0.0) != 0.0; });
}

}  // namespace

Circuit drawn_circuit(const FlatCircuit& circuit, const BuildParts& parts, std::uint64_t seed,
                      std::uint64_t build) {
  Circuit drawn = circuit.circuit();
  if (parts.printed.size() != drawn.resistors.size() ||
      parts.resistors.size() != drawn.resistors.size())
    throw std::invalid_argument("a build needs a conductance and an error a resistor");
  std::vector<double> siemens(parts.printed.begin(), parts.printed.end());
  parts.resistors.draw(seed, build, siemens);
  for (std::size_t r = 0; r < siemens.size(); ++r) drawn.resistors[r].siemens = siemens[r];

  std::size_t balances = 0;
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers())
    if (!x.inside && x.inverse != 0) ++balances;
  const InputPlaces places{drawn.resistors.size() + balances, any_of_models(drawn, &OpAmp::offset)
                                                                  ? circuit.amplifiers().size()
                                                                  : std::size_t{0}};
  const double kelvin = parts.resistors.kelvin(seed, build);
  const bool has_bias = any_of_models(drawn, &OpAmp::bias_current);
  std::vector<AmplifierModel> models;
  for (std::size_t k = 0; k < drawn.instances.size(); ++k) {
    const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
    AmplifierModel model = drawn.amplifiers[x.model];
    model.name = "opamp" + std::to_string(k);
    drawn.instances[k].subcircuit = model.name;
    OpAmp& opamp = model.opamp;
    const auto drawn_input = [&](double typical, const std::optional<double>& limit,
                                 std::uint64_t place) {
      const InputSpread spread = input_spread(typical, limit);
      return spread.deviation * input_error(spread, seed, build, place);
    };
    if (opamp.offset)
      opamp.offset = drawn_input(*opamp.offset, opamp.offset_limit, places.offset(k));
    if (opamp.offset_drift && kelvin != 0.0)
      opamp.offset =
          opamp.offset.value_or(0.0) + kelvin * *opamp.offset_drift * drift_error(seed, build, k);
    opamp.offset_limit.reset();  // of parts that are bought: this is one of them
    if (opamp.bandwidth && parts.bandwidth > 0.0) {
      const double factor = 1.0 + parts.bandwidth * uniform(seed, build, of_bandwidth + k);
      *opamp.bandwidth *= factor;
      if (opamp.second_pole) *opamp.second_pole *= factor;
    }
    if (has_bias && opamp.bias_current) {
      const double typical = *opamp.bias_current;
      const double plus = drawn_input(typical, opamp.bias_limit, places.bias(k));
      const double minus = drawn_input(typical, opamp.bias_limit, places.bias(k) + 1);
      opamp.bias_limit.reset();
      opamp.bias_current = 0.5 * (plus + minus);
      const std::string name = "Ib" + std::to_string(k);
      if (x.plus != 0) drawn.sources.push_back({name + 'p', x.plus, 0.5 * (minus - plus)});
      if (x.minus != 0) drawn.sources.push_back({name + 'n', x.minus, 0.5 * (plus - minus)});
    }
    models.push_back(std::move(model));
  }
  drawn.amplifiers = std::move(models);
  return drawn;
}

}  // namespace tactile_net
