#include "tactile_net/report/words/deck_words.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/version.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::report {
namespace {

DeckHeader header_of(const lab::SceneCircuit& circuit) {
  const Scene& scene = circuit.scene();
  const Surface& surface = circuit.surface();
  const double first = surface.position(0);
  const Scale& scale = circuit.options().parts.scale;
  const std::string volts = shortest(scale.volts);
  const bool two = unknowns(scene) == 2;
  DeckHeader header{
      .title = "tactile-net " + std::string(version()) + ": " + printable(scene.file) +
               ", realization " + std::string(name(circuit.options().realization)),
      .comments =
          {two ? "Solves P f = b for the tractions f on the surface above a tactile array: the "
                 "normal "
                 "ones, then the tangential ones."
               : "Solves P f = b for the normal traction f on the surface above a tactile array.",
           "P = K'K + alpha h/D (l^2/h^2 Q + I), b = K'g; K: what each value does to the readings "
           "g, "
           "Q: squared differences of neighbours, h: distance of the values, D: pitch.",
           "Sensor: " + sensor_in_words(scene) + ".", "Material: " + material_in_words(scene) + ".",
           "alpha = " + shortest(circuit.alpha().value) +
               ", l = " + shortest(scene.reconstruct.smoothing_length) +
               ", h = " + shortest(surface.spacing) + ", D = " + shortest(scene.sensor.pitch) + ".",
           "Scale: " + shortest(scale.siemens) + " S per unit of P, " + volts +
               " V per unit of f: f_i = v(n_i) / " + volts + ".",
           "Node n_i stands for the traction at y = " + shortest(first) + " + " +
               shortest(surface.spacing) +
               (two ? " (i modulo " + std::to_string(surface.count) + ")." : " i."),
           "Expected below: the direct solve of P f = b, in volts."},
      .expected = circuit.direct()};
  for (double& value : header.expected) value *= scale.volts;
  if (scene.reconstruct.offset)
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

std::string deck_text(const lab::SceneCircuit& circuit, Answer answer) {
  DeckHeader header = header_of(circuit);
  const auto& ordered = circuit.ordered();
  if (answer == Answer::printed) {
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
