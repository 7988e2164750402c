#include "tactile_net/report/words/deck_words.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <sstream>
#include <utility>
#include <variant>

#include "tactile_net/network/dialect_deck.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/parts_words.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/skin_words.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::report {
namespace {

std::string alpha_in_words(const lab::SceneCircuit& circuit) {
  return "alpha = " + shortest(circuit.alpha().value);
}

std::string scale_in_words(const lab::SceneCircuit& circuit, const std::string& value,
                           const std::string& voltage) {
  const Scale& scale = circuit.options().parts.scale;
  const std::string volts = shortest(scale.volts);
  return "Scale: " + shortest(scale.siemens) + " S per unit of P, " + volts +
         " V per unit of f: " + value + " = " + voltage + " / " + volts + ".";
}

/// P, sensor, material, scale, and which node is what.
std::vector<std::string> comments_of(const Scene& scene, const lab::SceneCircuit& circuit) {
  const Surface on = surface(scene);
  const bool two = unknowns(scene) == 2;
  return {
      two ? "Solves P f = b for the tractions f on the surface above a tactile array: the normal "
            "ones, then the tangential ones."
          : "Solves P f = b for the normal traction f on the surface above a tactile array.",
      "P = K'K + alpha h/D (l^2/h^2 Q + I), b = K'g; K: what each value does to the readings g, "
      "Q: squared differences of neighbours, h: distance of the values, D: pitch.",
      "Sensor: " + sensor_in_words(scene) + ".",
      "Material: " + material_in_words(scene) + ".",
      alpha_in_words(circuit) + ", l = " + shortest(scene.reconstruct.smoothing_length) +
          ", h = " + shortest(on.spacing) + ", D = " + shortest(scene.sensor.pitch) + ".",
      scale_in_words(circuit, "f_i", "v(n_i)"),
      "Node n_i stands for the traction at y = " + shortest(on.position(0)) + " + " +
          shortest(on.spacing) + (two ? " (i modulo " + std::to_string(on.count) + ")." : " i.")};
}

std::vector<std::string> comments_of(const SkinScene& scene, const lab::SceneCircuit& circuit) {
  const SurfaceGrid on = grid(scene);
  const bool three = components(scene) == 3;
  const auto place = [](double first, double spacing, const char* index) {
    return shortest(first) + " + " + shortest(spacing) + " " + index;
  };
  return {
      three ? "Solves P f = b for the tractions f of the cells of a tactile skin: the normal ones, "
              "then those along y, then those along z."
            : "Solves P f = b for the normal tractions f of the cells of a tactile skin.",
      "P = K'K + alpha a w^2 (l^2 G + I), b = K'g; K: what each cell does to the readings g, G: "
      "squared slopes between neighbouring cells, a: area of a cell over a taxel's.",
      "Sensor: " + sensor_in_words(scene) + ".",
      "Material: " + material_in_words(scene) + ".",
      alpha_in_words(circuit) +
          ", l = " + shortest(scene.reconstruct.smoothing_length.value_or(0.0)) + ", w = 1" +
          (three ? ", of the tangential ones " +
                       shortest(scene.reconstruct.tangential_weight.value_or(1.0))
                 : "") +
          ".",
      scale_in_words(circuit, "f", "a node's voltage"),
      std::string("Node p_r_c") + (three ? ", qy_r_c and qz_r_c stand" : " stands") +
          " for the cell at y = " + place(on.y(0), on.spacing_y, "r") +
          ", z = " + place(on.z(0), on.spacing_z, "c") + "."};
}

DeckHeader header_of(const lab::SceneCircuit& circuit, Realization realization) {
  DeckHeader header{
      .title = "tactile-net " + std::string(version()) + ": " + printable(circuit.file()) +
               ", realization " +
               circuit_in_words(realization, has_ladder(realization, circuit.options().parts)),
      .comments = std::visit([&](const auto& scene) { return comments_of(scene, circuit); },
                             circuit.scene()),
      .expected = circuit.direct()};
  header.comments.push_back("Expected below: the direct solve of P f = b, in volts.");
  for (double& value : header.expected) value *= circuit.options().parts.scale.volts;
  if (std::visit([](const auto& scene) { return scene.reconstruct.offset; }, circuit.scene()))
    header.comments.push_back(
        "Offsets are not known: of K and g each channel's constant is left out.");
  return header;
}

/// A circuit as it is written down: of exact values, of a series', or soldered.
struct Written {
  const Circuit& circuit;
  DeckHeader header;
  std::span<const SoldPart> parts{};
};

Written written(const lab::SceneCircuit& circuit) {
  const auto& ordered = circuit.ordered();
  DeckHeader header = header_of(circuit, circuit.options().realization);
  if (ordered)
    header.comments.push_back(
        "Resistors: the nearest values of the series E" +
        std::to_string(static_cast<int>(ordered->series)) +
        (ordered->moved ? ", which moves the answer by " + percent(*ordered->moved) + "." : "."));
  return {ordered ? ordered->circuit : circuit.network().circuit(), std::move(header), {}};
}

Written written(const lab::SceneCircuit& circuit, const lab::PartsList& list) {
  const SolderedCircuit& soldered = list.choice->soldered;
  DeckHeader header = header_of(circuit, list.chosen().realization);
  header.comments.push_back(in_words(list));
  return {soldered.circuit, std::move(header), soldered.parts};
}

/// How far the voltages may be off what is expected.
/// @param moved  the answer by the parts' values, relative
std::optional<double> bound(const lab::SceneCircuit& circuit, double moved) {
  // Without a load the difference is not relative, but in volts.
  const double unit = circuit.loaded() ? 1.0 : circuit.options().parts.scale.volts;
  const double within =
      (circuit.explained().total() + lab::ExplainedDifference::allowed(moved)) * unit;
  if (!std::isfinite(within)) return std::nullopt;
  return within;
}

/// What an op-amp's rails and slew, bent as a simulator has them, take from an answer within them.
double leaks_of(const OpAmp& opamp) { return opamp.rail || opamp.slew ? 1e-6 : 0.0; }

}  // namespace

std::string deck_text(const lab::SceneCircuit& circuit, tactile_net::Answer answer,
                      Dialect dialect) {
  Written deck = written(circuit);
  const auto& ordered = circuit.ordered();
  if (answer == tactile_net::Answer::printed)
    deck.header.within = bound(circuit, ordered ? ordered->moved.value_or(0.0) : 0.0);
  std::ostringstream text;
  write_deck(text, deck.circuit, deck.header, answer, circuit.analysis(),
             {.dialect = dialect, .parts = deck.parts});
  return std::move(text).str();
}

std::string deck_text(const lab::SceneCircuit& circuit, const lab::PartsList& list,
                      Dialect dialect) {
  Written deck = written(circuit, list);
  // The rounding is of several loads: one of them may be off by its share of all.
  deck.header.within =
      bound(circuit, list.chosen().rounding * std::sqrt(static_cast<double>(list.loads)));
  std::ostringstream text;
  write_deck(text, deck.circuit, deck.header, tactile_net::Answer::printed, DirectCurrent{},
             {.dialect = dialect, .parts = deck.parts});
  return std::move(text).str();
}

std::string deck_text(const lab::SceneCircuit& circuit, const lab::RefinementDeck& cycle,
                      Dialect dialect) {
  DeckHeader header = header_of(circuit, circuit.options().realization);
  header.comments.pop_back();
  header.comments.push_back(
      "A build whose parts are off, in cycle " + std::to_string(cycle.cycle) +
      " of a refinement in numbers: " +
      (cycle.cycle == 1
           ? "its answer to the readings."
           : "its answer to r = b - P f, f " + brief(cycle.error) +
                 " off the exact one; the currents at the summing nodes (Irefine) are " +
                 brief(cycle.size) + " times as large as r, so that voltages are as an answer's."));
  header.comments.push_back("Expected below: what the build's nodes come to, in volts.");
  header.expected = cycle.expected;
  header.within = circuit.explained().limit + leaks_of(circuit.options().parts.opamp);
  std::ostringstream text;
  write_deck(text, cycle.circuit, header, tactile_net::Answer::printed, DirectCurrent{},
             {.dialect = dialect});
  return std::move(text).str();
}

namespace {

Written written(const lab::SceneCircuit& circuit, const lab::PartsList* list) {
  return list != nullptr ? written(circuit, *list) : written(circuit);
}

}  // namespace

std::string subcircuit_text(const lab::SceneCircuit& circuit, const lab::PartsList* list,
                            const std::string& name, Dialect dialect) {
  Written deck = written(circuit, list);
  deck.header.expected.clear();
  std::ostringstream text;
  write_subcircuit(text, deck.circuit, deck.header, name,
                   {.dialect = dialect, .parts = deck.parts});
  return std::move(text).str();
}

std::string symbol_text(const lab::SceneCircuit& circuit, const lab::PartsList* list,
                        const std::string& name, const std::string& file) {
  std::ostringstream text;
  write_symbol(text, written(circuit, list).circuit, name, file);
  return std::move(text).str();
}

}  // namespace tactile_net::report
