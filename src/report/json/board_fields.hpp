/// @file
/// What the copper of a board does to its circuit, as fields. Private.
#pragma once

#include "tactile_net/lab/board_certificate.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/report/words/board_words.hpp"

namespace tactile_net {

template <>
struct Fields<NodeCapacitance> {
  static constexpr auto all =
      std::tuple{field("node", &NodeCapacitance::node, "The node's name."),
                 field("farad", &NodeCapacitance::farad, Measure::capacitance,
                       "Its copper's capacitance to ground.")};
};

template <>
struct Fields<lab::BoardCertificate::Judged> {
  using One = lab::BoardCertificate::Judged;
  static constexpr auto all = std::tuple{
      field("siemens", &One::siemens, Measure::conductance, "The conductance for a unit of P."),
      field(
          "stability", [](const One& one) { return one.stability.stability; },
          "Whether the circuit settles with its board's capacitance."),
      field("slowest_pole", &One::slowest, Measure::rate,
            "The largest real part of a pole; null: not computed."),
      field(
          "phase_margin",
          [](const One& one) {
            return one.margin ? std::optional(one.margin->degrees) : std::nullopt;
          },
          "How many degrees more lag of every op-amp alike it bears; null: it is not stable, or no "
          "lag makes it oscillate."),
      field(
          "margin_hertz",
          [](const One& one) {
            return one.margin ? std::optional(one.margin->hertz) : std::nullopt;
          },
          Measure::frequency, "Where that lag would make it oscillate; null: as above."),
      field("damping", &One::damping, "The least -Re/|s| of the poles; null: not computed."),
      field("settling_seconds", &One::settling_seconds, Measure::time,
            "The settling time; null: it does not settle, or it is not computed."),
      field("least_ohm", &One::least_ohm, Measure::resistance, "The smallest resistor.")};
};

template <>
struct Fields<lab::BoardCertificate> {
  using Board = lab::BoardCertificate;
  static constexpr auto all = std::tuple{
      field("file", &Board::file, "The board's file; empty: the board that is written."),
      field("realization", &Board::realization, "The circuit on it."),
      field(
          "text", [](const Board& one) { return report::in_words(one); },
          "What the copper does and what was changed, in sentences."),
      field("wanted", &Board::wanted, "The phase margin that is asked for, in degrees."),
      field("has_planes", &Board::has_planes,
            "Whether a zone of GND, VCC or VEE covers half of the board."),
      field(
          "vee_ohm",
          [](const Board& one) {
            return one.supply ? std::optional(one.supply->ohm) : std::nullopt;
          },
          Measure::resistance,
          "By how much VEE falls on its tracks to the farthest op-amp, over what each op-amp "
          "takes; "
          "null: tracks do not join it, or it has no header \"supply\"."),
      field("stated", &Board::stated, "With the scene's siemens."),
      field("used", &Board::used,
            "With the siemens of the parts and the board; of a board from a file with those that "
            "would bring the margin. Equal to `stated`: nothing was changed."),
      field("nodes", &Board::nodes, "What the copper loads each of the circuit's nodes with.")};
};

}  // namespace tactile_net
