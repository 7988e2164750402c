#include "tactile_net/report/words/deck_words.hpp"

#include <cmath>
#include <sstream>
#include <utility>
#include <variant>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
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
  const SkinGrid on = grid(scene);
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

DeckHeader header_of(const lab::SceneCircuit& circuit) {
  DeckHeader header{
      .title = "tactile-net " + std::string(version()) + ": " + printable(circuit.file()) +
               ", realization " + std::string(name(circuit.options().realization)),
      .comments = std::visit([&](const auto& scene) { return comments_of(scene, circuit); },
                             circuit.scene()),
      .expected = circuit.direct()};
  header.comments.push_back("Expected below: the direct solve of P f = b, in volts.");
  for (double& value : header.expected) value *= circuit.options().parts.scale.volts;
  if (std::visit([](const auto& scene) { return scene.reconstruct.offset; }, circuit.scene()))
    header.comments.push_back(
        "Offsets are not known: of K and g each channel's constant is left out.");
  if (const auto& ordered = circuit.ordered())
    header.comments.push_back(
        "Resistors: the nearest values of the series E" +
        std::to_string(static_cast<int>(ordered->series)) +
        (ordered->moved ? ", which moves the answer by " + percent(*ordered->moved) + "." : "."));
  return header;
}

}  // namespace

std::string deck_text(const lab::SceneCircuit& circuit, tactile_net::Answer answer) {
  DeckHeader header = header_of(circuit);
  const auto& ordered = circuit.ordered();
  if (answer == tactile_net::Answer::printed) {
    // Without a load the difference is not relative, but in volts.
    const double unit = circuit.loaded() ? 1.0 : circuit.options().parts.scale.volts;
    double within = circuit.explained().total();
    if (ordered) within += lab::ExplainedDifference::allowed(ordered->moved.value_or(0.0));
    within *= unit;
    if (std::isfinite(within)) header.within = within;
  }
  std::ostringstream deck;
  write_deck(deck, ordered ? ordered->circuit : circuit.network().circuit(), header, answer,
             circuit.analysis());
  return std::move(deck).str();
}

}  // namespace tactile_net::report
