#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "scene/common_errors_section.hpp"
#include "scene/refine_section.hpp"
#include "scene/sections.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/opamp_part.hpp"
#include "tactile_net/scene/scale_units.hpp"

namespace tactile_net {

namespace {

constexpr Rule below_one{"must be > 0 and < 1",
                         [](double x) noexcept { return x > 0.0 && x < 1.0; }};
constexpr Rule above_diodes{"must be > 0.6, what the clamp's diodes drop",
                            [](double x) noexcept { return x > 0.6; }};

/// A class of op-amps by its name, where there is one.
OpAmp opamp_of_class(const Value& value) {
  std::vector<std::string_view> names;
  for (const OpAmpClass& one : opamp_classes()) names.push_back(one.name);
  const auto index = value.one_of("class", names);
  return index ? opamp_classes()[*index].opamp : OpAmp{};
}

/// An op-amp that is sold, or null.
const OpAmpPart* part_named(const Value& value) {
  std::vector<std::string_view> names;
  for (const OpAmpPart& one : opamp_parts()) names.push_back(one.name);
  const auto index = value.one_of("part", names);
  return index ? &opamp_parts()[*index] : nullptr;
}

/// A class or a part by its name alone.
void read_named_opamp(const Value& value, NetworkOptions& network) {
  std::vector<std::string_view> names;
  for (const OpAmpClass& one : opamp_classes()) names.push_back(one.name);
  for (const OpAmpPart& one : opamp_parts()) names.push_back(one.name);
  const auto index = value.one_of("class or part", names);
  if (!index) {
    network.parts.opamp.bandwidth = 1e6;  // what else is stated needs one: it is not wrong too
    return;
  }
  const std::size_t classes = opamp_classes().size();
  if (*index < classes) {
    network.parts.opamp = opamp_classes()[*index].opamp;
    return;
  }
  network.opamp_part = &opamp_parts()[*index - classes];
  network.parts.opamp = network.opamp_part->opamp;
}

/// Within what the part takes, and enough for its outputs to move: what they swing to.
void read_supply(const Value& value, NetworkOptions& network) {
  const OpAmpPart* const part = network.opamp_part;
  OpAmp& opamp = network.parts.opamp;
  if (part == nullptr) {
    value.problem("is of a part, whose outputs stay so far from their supply",
                  "beside it, part = \"THS4551\"; of other op-amps, rail");
    return;
  }
  const auto volts = value.number(positive, in_volts);
  if (!volts) return;
  if (*volts < part->least_supply.value_or(0.0) ||
      *volts > part->most_supply.value_or(std::numeric_limits<double>::infinity())) {
    value.misfit("is outside of what " + part->name + " takes, " + shortest(*part->least_supply) +
                 " to " + shortest(*part->most_supply) + " V in all");
    return;
  }
  network.supply = volts;
  const double swing = 0.5 * *volts - part->headroom.value_or(0.0);
  if (above_diodes.holds(swing))
    opamp.rail = swing;
  else
    value.misfit("leaves the outputs of " + part->name + " less than 0.6 V either way");
}

/// Beyond gain, bandwidth and second pole.
struct OpAmpKey {
  std::string_view name;
  std::optional<double> OpAmp::*member;
  Rule rule = positive;
  Unit unit{};
  std::string_view needs_bandwidth{};  ///< why; empty: it does not
};

constexpr std::string_view noise_needs = "is infinite unless a bandwidth limits it";

constexpr std::string_view capacitance_needs =
    "acts only over time, and these op-amps have no bandwidth";

constexpr OpAmpKey opamp_keys[] = {
    {"offset", &OpAmp::offset, any_number, in_volts},
    {"offset_limit", &OpAmp::offset_limit, positive, in_volts},
    {"offset_drift", &OpAmp::offset_drift, positive, {}},
    {"noise_voltage", &OpAmp::noise_voltage, positive, {}, noise_needs},
    {"noise_corner", &OpAmp::noise_corner, positive, in_hertz, noise_needs},
    {"noise_current", &OpAmp::noise_current, positive, {}, noise_needs},
    {"bias_current", &OpAmp::bias_current, any_number, {}},
    {"bias_limit", &OpAmp::bias_limit, positive, {}},
    {"cmrr", &OpAmp::common_mode_rejection},
    {"slew", &OpAmp::slew, positive, {}, "limits the rate that a bandwidth gives"},
    {"output_resistance", &OpAmp::output_resistance},
    {"input_capacitance", &OpAmp::input_capacitance, positive, {}, capacitance_needs},
    {"differential_capacitance", &OpAmp::differential_capacitance, positive, {}, capacitance_needs},
    {"output_current", &OpAmp::output_current},
    {"rail", &OpAmp::rail, above_diodes, in_volts}};

/// An error of inputs: its typical value, and its limit.
struct SpreadKeys {
  std::string_view typical_key;
  std::string_view limit_key;
  std::optional<double> OpAmp::*typical;
  std::optional<double> OpAmp::*limit;
};

constexpr SpreadKeys spread_keys[] = {
    {"offset", "offset_limit", &OpAmp::offset, &OpAmp::offset_limit},
    {"bias_current", "bias_limit", &OpAmp::bias_current, &OpAmp::bias_limit}};

/// A typical value that a scene states takes the place of both of a part's, a limit that of its
/// limit. A limit alone stands for the typical value too.
/// @param before  what the scene's keys override
void settle_limit(Table& table, const SpreadKeys& keys, const OpAmp& before, OpAmp& opamp) {
  std::optional<double>& typical = opamp.*keys.typical;
  std::optional<double>& limit = opamp.*keys.limit;
  const bool states_typical = table.value(keys.typical_key).has_value();
  const auto stated = table.value(keys.limit_key);
  if (!stated) {
    if (states_typical) limit.reset();
    return;
  }
  if (!limit) return;
  if (!states_typical && before.*keys.typical == before.*keys.limit) typical = limit;
  if (typical && std::abs(*typical) > *limit)
    stated->misfit("must not be below " + std::string(keys.typical_key) + ", the typical value, " +
                   shortest(*typical));
}

void read_opamp(Table table, NetworkOptions& network) {
  OpAmp& opamp = network.parts.opamp;
  const auto kind = table.value("class");
  if (kind) opamp = opamp_of_class(*kind);
  const auto part = table.value("part");
  if (part) {
    network.opamp_part = part_named(*part);
    if (network.opamp_part != nullptr)
      opamp = network.opamp_part->opamp;
    else
      opamp.bandwidth = 1e6;  // as above
    if (kind) part->problem("stands beside a class", "one of the two");
  }
  // Of a part that there is not nothing more is said.
  if (const auto supply = table.value("supply"); supply && (network.opamp_part != nullptr || !part))
    read_supply(*supply, network);
  if (const auto gain = table.value("gain")) opamp.gain = gain->number(positive);
  if (const auto bandwidth = table.value("bandwidth"))
    opamp.bandwidth = bandwidth->number(positive, in_hertz);
  if (const auto pole = table.value("second_pole")) {
    opamp.second_pole = pole->number(positive, in_hertz);
    if (!opamp.bandwidth)
      pole->problem("needs the first pole", "beside it, bandwidth = 10e6 (gain-bandwidth product)");
  }
  const OpAmp before = opamp;
  for (const OpAmpKey& key : opamp_keys) {
    const auto value = table.value(key.name);
    if (!value) continue;
    opamp.*key.member = value->number(key.rule, key.unit);
    if (!key.needs_bandwidth.empty() && !opamp.bandwidth)
      value->problem(std::string(key.needs_bandwidth), "beside it, bandwidth = 10e6");
  }
  for (const SpreadKeys& keys : spread_keys) settle_limit(table, keys, before, opamp);
  if (const auto corner = table.value("noise_corner"); corner && !opamp.noise_voltage)
    corner->problem(
        "is the frequency below which 1/f noise exceeds white noise, and no white noise is given",
        "beside it, noise_voltage = 5e-9");
  if (opamp.is_nullor()) opamp.gain = opamp.dc_gain();
  table.finish();
}

/// A part is what the realisation is made of, and its poles are known.
void check_part(const Value& value, const NetworkOptions& network) {
  const OpAmpPart* const part = network.opamp_part;
  if (part == nullptr) return;
  const RealizationTraits& realization = traits(network.realization);
  const bool two = realization.drives_nodes && !network.parts.inverters;
  const std::string circuit(name(network.realization));
  if (realization.uses_opamps && two != (part->outputs == Outputs::complementary))
    value.problem(two ? "names " + part->name + ", an op-amp of one output, and " + circuit +
                            " takes fully differential amplifiers"
                      : "names " + part->name + ", a fully differential amplifier, and " + circuit +
                            (network.parts.inverters ? " with inverters" : "") +
                            " takes op-amps of one output",
                  two ? "realization = \"nic\", or inverters = true, or another part"
                      : "realization = \"lattice\", or another part");
  if (!network.parts.opamp.bandwidth)
    value.problem(
        "names " + part->name + ", whose gain-bandwidth product circuits/parts does not have",
        "opamp = { part = \"" + part->name + "\", bandwidth = 10e6 }, from its data sheet");
}

/// What is paid.
void read_prices(Table table, NetworkOptions& network) {
  if (const auto price = table.value("opamp")) network.opamp_price = price->number(not_negative);
  if (const auto resistors = table.value("resistors")) {
    std::vector<PartClass> classes;
    const auto rows = resistors->tables();
    for (const Table& row : rows.value_or(std::vector<Table>{})) {
      Table one = row;
      PartClass& sold = classes.emplace_back();
      const auto tolerance = one.required("tolerance", "how far one may be off: tolerance = 0.01");
      if (tolerance) sold.tolerance = tolerance->number(below_one).value_or(sold.tolerance);
      if (const auto price = one.required("price", "of one: price = 0.002"))
        sold.price = price->number(not_negative).value_or(0.0);
      if (classes.size() > 1 && tolerance) {
        const PartClass& before = classes[classes.size() - 2];
        if (!(sold.tolerance < before.tolerance && sold.price >= before.price))
          tolerance->misfit("must be finer than that before, and not cheaper",
                            "resistors = [{ tolerance = 0.01, price = 0.002 }, "
                            "{ tolerance = 0.001, price = 0.05 }]");
      }
      one.finish();
    }
    if (rows && classes.empty()) resistors->problem("holds no class", "leave it out");
    if (!classes.empty()) network.resistor_classes = std::move(classes);
  }
  table.finish();
}

/// What programs an array instead of soldering it, and what its lines are.
void read_arrays(Table& table, const NetworkOptions& network, ToleranceOptions& tolerance) {
  const RealizationTraits& realization = traits(network.realization);
  const auto of_arrays = [&](const Value& value) {
    if (!realization.drives_nodes)
      value.problem(
          "is of arrays, which " + std::string(name(network.realization)) + " does not have",
          "under [network], realization = \"least_squares\"");
  };
  const auto bits = table.value("bits");
  const auto noise = table.value("cell_noise");
  if (bits) {
    if (const auto number = bits->integer(1, 32)) tolerance.bits = static_cast<int>(*number);
    of_arrays(*bits);
  }
  if (noise) {
    tolerance.cell_noise = noise->number(below_one);
    of_arrays(*noise);
  }
  if (const auto series = table.value("series"); series && (bits || noise))
    series->problem("applies to resistors that are bought, but these arrays are programmed",
                    "either series, or bits and cell_noise");
  const auto wire = table.value("wire_resistance");
  if (!wire) return;
  tolerance.wire_resistance = wire->number(positive);
  of_arrays(*wire);
  if (realization.drives_nodes && network.parts.inverters)
    wire->problem("applies to arrays with complementary outputs", "under [network], no inverters");
}

ToleranceOptions read_tolerance(Table table, const NetworkOptions& network,
                                const std::filesystem::path& folder) {
  constexpr std::array series = {Series::e12, Series::e24, Series::e48, Series::e96, Series::e192};
  constexpr std::array<std::string_view, 5> names = {"E12", "E24", "E48", "E96", "E192"};
  ToleranceOptions tolerance;
  const auto relative = table.required(
      "relative", "how far a component may be off: relative = 0.01",
      {"series", "bits", "cell_noise", "wire_resistance", "reel", "measured", "temperature"});
  if (relative) tolerance.relative = relative->number(below_one);
  tolerance.common = read_common_errors(table, folder);
  if (const auto measured = table.value("measured"); measured && relative)
    relative->problem("stands beside measured, which says how far the same parts are off",
                      "one of the two");
  const auto beside = [&](std::string_view key, std::optional<double>& target) {
    const auto value = table.value(key);
    if (!value) return;
    target = value->number(below_one);
    if (!relative && !tolerance.common.measured)
      value->problem("needs the other parts' tolerance", "beside it, relative = 0.01");
  };
  beside("stabiliser", tolerance.stabiliser);
  beside("balance", tolerance.balance);
  beside("bandwidth", tolerance.bandwidth);
  if (const auto tare = table.value("tare")) tolerance.tare = tare->boolean().value_or(false);
  if (const auto value = table.value("series"))
    if (const auto index = value->one_of("series", names)) tolerance.series = series[*index];
  read_arrays(table, network, tolerance);
  if (const auto trials = table.value("trials"))
    tolerance.trials = static_cast<std::size_t>(trials->integer(1, 1'000'000).value_or(1000));
  if (const auto accuracy = table.value("accuracy"))
    tolerance.accuracy = accuracy->number(below_one).value_or(tolerance.accuracy);
  if (const auto seed = table.value("seed"))
    tolerance.seed = static_cast<std::uint64_t>(seed->integer(0, INT64_MAX).value_or(1));
  table.finish();
  return tolerance;
}

/// How readings come in, where their resistors do not load the answer.
void read_inputs(const Value& value, NetworkOptions& network) {
  std::vector<std::string_view> names;
  for (const auto& one : Enumerators<Inputs>::all) names.push_back(one.name);
  const auto index = value.one_of("kind of inputs", names);
  if (!index) return;
  network.parts.inputs = Enumerators<Inputs>::all[*index].value;
  if (network.parts.inputs == Inputs::voltage && !traits(network.realization).drives_nodes)
    value.problem("is of circuits whose nodes op-amps drive: in " +
                      std::string(name(network.realization)) +
                      " the resistors of the inputs would load the answer",
                  "realization = \"lattice\", \"least_squares\" or \"crossbar\"");
}

/// What a datasheet is judged by.
DatasheetLimits read_limits(Table table) {
  DatasheetLimits limits;
  const auto read = [&](std::string_view key, std::optional<double>& target, const Unit& unit) {
    if (const auto value = table.value(key)) target = value->number(positive, unit);
  };
  read("error", limits.error, {});
  read("offset", limits.offset, {});
  read("settling", limits.settling, in_seconds);
  read("noise", limits.noise, {});
  read("supply_current", limits.supply_current, {});
  table.finish();
  return limits;
}

/// A vendor's macromodel: which of a file's sub-circuits, and what its pins are for.
void read_macromodel(Table table, MacromodelOptions& macromodel) {
  if (const auto name = table.value("name")) macromodel.name = name->text().value_or("");
  if (const auto pins = table.value("pins")) {
    std::vector<std::string_view> purposes;
    for (const auto& row : Enumerators<MacromodelPin>::all) purposes.push_back(row.name);
    const auto listed = pins->list("purposes of pins");
    for (const Value& pin : listed.value_or(std::vector<Value>{}))
      if (const auto index = pin.one_of("purpose of a pin", purposes))
        macromodel.pins.push_back(Enumerators<MacromodelPin>::all[*index].value);
  }
  if (const auto supply = table.value("supply"))
    macromodel.supply = supply->number(positive, in_volts);
  table.finish();
}

void read_parasitic(Table table, NetworkOptions& network) {
  RealizationOptions& parts = network.parts;
  const auto read = [&](std::string_view key, std::optional<double>& target, bool of_opamps) {
    const auto value = table.value(key);
    if (!value) return;
    if (const auto farad = value->number(positive)) target = target.value_or(0.0) + *farad;
    if (of_opamps && !parts.opamp.bandwidth)
      value->problem(std::string(capacitance_needs),
                     "under [network], opamp = { bandwidth = 10e6 }");
  };
  read("node", parts.node_capacitance, false);
  read("resistor", parts.resistor_capacitance, false);
  const double own = parts.opamp.input_capacitance.value_or(0.0);
  read("input", parts.opamp.input_capacitance, true);  // beside the op-amp's own
  read("output", parts.opamp.load_capacitance, true);
  network.macromodel.board_input = parts.opamp.input_capacitance.value_or(0.0) - own;
  network.macromodel.board_output = parts.opamp.load_capacitance.value_or(0.0);
  table.finish();
}

}  // namespace

NetworkOptions read_network(Table& root, const Units& units, const Unit& alpha,
                            const SpacingCheck& check_spacing,
                            const std::filesystem::path& folder) {
  constexpr std::array curves = {Curve::cubic, Curve::tunnel_diode};
  constexpr std::array<std::string_view, 2> curve_names = {"cubic", "tunnel_diode"};
  NetworkOptions options{.one_volt = true};
  const auto given = table_of(root.value("network"));
  if (!given) return options;
  Table table = *given;
  RealizationOptions& parts = options.parts;
  if (const auto realization = table.value("realization"))
    if (const auto index = realization->one_of("realization", names_of(realizations)))
      options.realization = realizations[*index];
  if (const auto spacing = table.value("spacing")) {
    options.spacing = spacing->number(positive, units.length);
    if (options.spacing) check_spacing(*spacing, *options.spacing);
  }
  const auto number = [&](std::string_view key, double& target, const Unit& unit = {}) {
    if (const auto value = table.value(key))
      target = value->number(positive, unit).value_or(target);
  };
  // Per unit of P and of a traction.
  const ScaleUnits scale = scale_units(units, alpha);
  number("siemens", parts.scale.siemens, scale.siemens);
  options.one_volt = !table.value("volts");
  number("volts", parts.scale.volts, scale.volts);
  number("residual_gain", parts.residual_gain);
  number("divider", parts.divider);
  number("frequency", parts.frequency, in_hertz);
  number("device_volts", parts.device_volts, in_volts);
  if (const auto ratio = table.value("bandwidth_ratio"))
    parts.bandwidth_ratio = ratio->number(positive);
  if (const auto inverters = table.value("inverters"))
    parts.inverters = inverters->boolean().value_or(false);
  if (const auto inputs = table.value("inputs")) read_inputs(*inputs, options);
  if (const auto ladder = table.value("ladder")) parts.ladder = ladder->boolean().value_or(false);
  if (const auto device = table.value("device"))
    if (const auto index = device->one_of("device", curve_names)) parts.curve = curves[*index];
  if (const auto opamp = table.value("opamp")) {
    if (opamp->is_text())
      read_named_opamp(*opamp, options);
    else if (const auto own = opamp->table())
      read_opamp(*own, options);
    check_part(*opamp, options);
  }
  if (const auto prices = table_of(table.value("parts"))) read_prices(*prices, options);
  options.own_input_capacitance = parts.opamp.input_capacitance;
  if (const auto parasitic = table_of(table.value("parasitic")))
    read_parasitic(*parasitic, options);
  if (const auto model = table_of(table.value("model")))
    read_macromodel(*model, options.macromodel);
  if (const auto tolerance = table_of(table.value("tolerance")))
    options.tolerance = read_tolerance(*tolerance, options, folder);
  if (const auto limits = table_of(table.value("limits"))) options.limits = read_limits(*limits);
  if (const auto refine = table.value("refine")) options.refine = read_refine(*refine, options);
  if (auto settling = table_of(table.value("settling"))) {
    if (const auto accuracy = settling->required(
            "accuracy", "how near to its end the answer must stay: accuracy = 1e-3"))
      options.settling_accuracy = accuracy->number(below_one);
    settling->finish();
  }
  table.finish();
  return options;
}

}  // namespace tactile_net
