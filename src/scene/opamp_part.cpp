#include "tactile_net/scene/opamp_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/document.hpp"
#include "scene/opamp_part_files.hpp"
#include "scene/problems.hpp"
#include "scene/table.hpp"

namespace tactile_net {
namespace {

constexpr FileKind part_file{"part of circuits/parts",
                             "name, kind, maker, sheet, package, price, [pins] and [figures]"};

/// What a figure of a data sheet is in a deck.
struct PartFigure {
  std::string_view name;
  std::optional<double> OpAmp::*member = nullptr;
  /// Where outputs are complementary the sheet's is of their difference.
  bool of_difference = false;
  bool in_decibels = false;
};

constexpr PartFigure part_figures[] = {
    {"gain_bandwidth", &OpAmp::bandwidth, true},
    {"gain_db", &OpAmp::gain, true, true},
    {"slew", &OpAmp::slew, true},
    {"phase_margin"},
    {"noise_voltage", &OpAmp::noise_voltage},
    {"noise_corner", &OpAmp::noise_corner},
    {"noise_current", &OpAmp::noise_current},
    {"offset", &OpAmp::offset},
    {"offset_limit", &OpAmp::offset_limit},
    {"offset_drift", &OpAmp::offset_drift},
    {"bias_current", &OpAmp::bias_current},
    {"bias_limit", &OpAmp::bias_limit},
    {"cmrr_db", &OpAmp::common_mode_rejection, false, true},
    {"input_capacitance", &OpAmp::input_capacitance},
    {"differential_capacitance", &OpAmp::differential_capacitance},
    {"output_resistance", &OpAmp::output_resistance},
    {"output_current", &OpAmp::output_current},
    {"headroom"},
    {"supply"},
    {"supply_current"}};

/// Keeps a figure, and where it stands.
void take(OpAmpPart& part, const PartFigure& figure, std::vector<double> values, std::string at) {
  const double value = values.front();
  if (figure.member != nullptr) {
    const double plain = figure.in_decibels ? std::pow(10.0, value / 20.0) : value;
    const bool halved = figure.of_difference && part.outputs == Outputs::complementary;
    part.opamp.*figure.member = halved ? 0.5 * plain : plain;
  } else if (figure.name == "phase_margin") {
    if (part.opamp.bandwidth) part.opamp.second_pole = second_pole_of(*part.opamp.bandwidth, value);
  } else if (figure.name == "headroom") {
    part.headroom = value;
  } else if (figure.name == "supply") {
    part.least_supply = value;
    part.most_supply = values.back();
  } else {
    part.supply_current = value;
  }
  part.figures.push_back({std::string(figure.name), std::move(values), std::move(at)});
}

struct PinKey {
  std::string_view name;
  std::vector<int> AmplifierPins::*member;
};

constexpr PinKey pins_of_one_output[] = {{"in_plus", &AmplifierPins::in_plus},
                                         {"in_minus", &AmplifierPins::in_minus},
                                         {"out", &AmplifierPins::out_plus},
                                         {"supply_plus", &AmplifierPins::supply_plus},
                                         {"supply_minus", &AmplifierPins::supply_minus}};

constexpr PinKey pins_of_two_outputs[] = {
    {"in_plus", &AmplifierPins::in_plus},           {"in_minus", &AmplifierPins::in_minus},
    {"out_plus", &AmplifierPins::out_plus},         {"out_minus", &AmplifierPins::out_minus},
    {"common_mode", &AmplifierPins::common_mode},   {"supply_plus", &AmplifierPins::supply_plus},
    {"supply_minus", &AmplifierPins::supply_minus}, {"power_down", &AmplifierPins::power_down}};

void read_pins(Table table, OpAmpPart& part) {
  const std::span<const PinKey> keys = part.outputs == Outputs::complementary
                                           ? std::span<const PinKey>(pins_of_two_outputs)
                                           : std::span<const PinKey>(pins_of_one_output);
  for (const PinKey& key : keys) {
    const auto value = table.required(key.name, "the number of the pin, or [1, 7] of two");
    if (!value) continue;
    std::vector<int>& pins = part.pins.*key.member;
    if (value->is_list()) {
      for (const double pin : value->numbers(positive).value_or(std::vector<double>{}))
        pins.push_back(static_cast<int>(pin));
    } else if (const auto pin = value->integer(1, 400)) {
      pins = {static_cast<int>(*pin)};
    }
  }
  if (const auto pad = table.value("exposed"))
    if (const auto number = pad->integer(1, 400)) part.pins.exposed = {static_cast<int>(*number)};
  if (const auto place = table.required("at", "where the data sheet says it"))
    part.pins_at = place->text().value_or("");
  table.finish();
}

void read_figures(Table table, OpAmpPart& part) {
  for (const PartFigure& figure : part_figures) {
    const auto own = table_of(table.value(figure.name));
    if (!own) continue;
    Table one = *own;
    std::vector<double> values;
    if (const auto value = one.required("value", "what the data sheet says")) {
      if (value->is_list())
        values = value->numbers(positive).value_or(std::vector<double>{});
      else if (const auto number = value->number(positive))
        values = {*number};
    }
    std::string at;
    if (const auto place = one.required("at", "where the data sheet says it"))
      at = place->text().value_or("");
    one.finish();
    if (!values.empty()) take(part, figure, std::move(values), std::move(at));
  }
  table.finish();
  // A limit alone is all that is known.
  OpAmp& opamp = part.opamp;
  if (!opamp.offset) opamp.offset = opamp.offset_limit;
  if (!opamp.bias_current) opamp.bias_current = opamp.bias_limit;
}

OpAmpPart part_of(const OpAmpPartFile& file) {
  constexpr std::array<std::string_view, 2> kinds = {"op-amp", "fully differential amplifier"};
  Problems problems(std::string(file.name), file.text, part_file);
  const toml::table document = parse_document(file.text, std::string(file.name), problems);
  Table table(document, "", problems);
  OpAmpPart part;
  const auto text = [&](std::string_view key, std::string& target) {
    if (const auto value = table.required(key, "text")) target = value->text().value_or("");
  };
  text("name", part.name);
  text("maker", part.maker);
  text("sheet", part.sheet);
  text("package", part.package);
  text("price", part.price);
  if (const auto kind = table.required("kind", "what it is"))
    if (kind->one_of("kind of part", kinds).value_or(0) == 1) part.outputs = Outputs::complementary;
  if (const auto pins = table_of(table.required("pins", "what its pins are for")))
    read_pins(*pins, part);
  if (const auto figures = table_of(table.required("figures", "what its data sheet says")))
    read_figures(*figures, part);
  table.finish();
  problems.throw_if_any();
  return part;
}

}  // namespace

std::optional<AmplifierPackage> package_of(const OpAmpPart* part) {
  if (part == nullptr) return std::nullopt;
  return part->packaged();
}

std::span<const OpAmpPart> opamp_parts() {
  static const std::vector<OpAmpPart> parts = [] {
    std::vector<OpAmpPart> all;
    for (const OpAmpPartFile& file : opamp_part_files()) all.push_back(part_of(file));
    std::sort(all.begin(), all.end(),
              [](const OpAmpPart& a, const OpAmpPart& b) { return a.name < b.name; });
    return all;
  }();
  return parts;
}

std::vector<std::string_view> figures_not_known(const OpAmp& opamp) {
  std::vector<std::string_view> lacking;
  if (!opamp.second_pole) lacking.emplace_back("second_pole");
  if (!opamp.input_capacitance && !opamp.differential_capacitance)
    lacking.emplace_back("input_capacitance");
  if (!opamp.output_resistance) lacking.emplace_back("output_resistance");
  return lacking;
}

double second_pole_of(double gain_bandwidth, double phase_margin) noexcept {
  // At the crossover w the phase is 90 degrees and atan(w / second pole), and the gain's size is 1.
  const double ratio = std::tan((90.0 - phase_margin) * std::numbers::pi / 180.0);
  return gain_bandwidth / (ratio * std::hypot(1.0, ratio));
}

}  // namespace tactile_net
