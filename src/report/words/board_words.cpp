#include "tactile_net/report/words/board_words.hpp"

#include <algorithm>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/opamp_words.hpp"

namespace tactile_net::report {
namespace {

std::string picofarad(double farad) { return brief(1e12 * farad) + " pF"; }

std::string copper_in_words(const lab::BoardCertificate& board) {
  double pads = 0.0;
  double tracks = 0.0;
  double missing = 0.0;
  double laid = 0.0;
  double to_lay = 0.0;
  for (const NetCopper& one : board.copper) {
    pads += one.of_pads;
    tracks += one.of_tracks;
    missing += one.of_missing;
    laid += one.length;
    to_lay += one.missing;
  }
  const double all = pads + tracks + missing;
  std::string text = (board.file.empty() ? std::string("board.kicad_pcb") : board.file) + ": " +
                     std::to_string(board.copper.size()) + " nets, " + picofarad(all) +
                     " of copper to ground";
  if (all > 0.0) {
    text += " (pads " + percent(pads / all);
    if (laid > 0.0) text += ", " + brief(laid) + " mm of tracks " + percent(tracks / all);
    if (to_lay > 0.0)
      text += ", tracks that are missing " + percent(missing / all) + ": " + brief(to_lay) +
              " mm, estimated by the shortest tree along x and y of each net's pads";
    text += ")";
  }
  if (!board.nodes.empty()) {
    const auto [least, most] = std::minmax_element(
        board.nodes.begin(), board.nodes.end(),
        [](const NodeCapacitance& a, const NodeCapacitance& b) { return a.farad < b.farad; });
    text += "; the circuit's nodes have " + picofarad(least->farad) + " (" + least->node + ") to " +
            picofarad(most->farad) + " (" + most->node + ")";
  }
  text += board.has_planes
              ? "; the top layer is " + brief(board.to_plane) + " mm from a plane"
              : "; no zone of GND, VCC or VEE covers half of the board: it is taken as if its "
                "other side were a plane, and copper without one near picks up noise";
  return text;
}

/// How far VEE falls on its tracks.
std::string supply_in_words(const SupplyDrop& drop, std::optional<double> each) {
  const std::string count = std::to_string(drop.amplifiers);
  const std::string falls = "VEE falls by ";
  if (each)
    return falls + brief(1e3 * drop.ohm * *each) + " mV on its tracks to the farthest op-amp, " +
           drop.amplifier + ", where each of the " + count + " takes the " + brief(1e3 * *each) +
           " mA of its data sheet";
  return falls + brief(drop.ohm) + " mV on its tracks to the farthest op-amp, " + drop.amplifier +
         ", for each mA that each of the " + count + " takes";
}

std::string judged_in_words(const lab::BoardCertificate::Judged& one) {
  std::string text;
  switch (one.stability.stability) {
    case Stability::stable:
      text = "stable";
      break;
    case Stability::unstable:
      text = "OSCILLATES";
      break;
    default:
      return "whether it is stable is not known";
  }
  if (one.slowest) text += ", slowest pole at " + brief(*one.slowest) + " 1/s";
  if (one.margin)
    text += ", phase margin " + brief(one.margin->degrees) + " degrees at " +
            brief(1e-6 * one.margin->hertz) + " MHz";
  if (!one.margin && one.stable() && one.slowest)
    text += ", its phase margin is not computed (more than 600 states) or has no end";
  if (one.damping && one.stable()) text += ", least damping " + brief(*one.damping);
  if (one.settling_seconds) text += ", settles in " + duration(*one.settling_seconds);
  return text;
}

std::string siemens_in_words(const lab::BoardCertificate& board, double siemens) {
  return "siemens = " + brief(siemens / board.siemens_unit, 6);
}

}  // namespace

std::vector<std::string> in_words(const lab::BoardCertificate& board) {
  std::vector<std::string> lines = {copper_in_words(board)};
  if (board.supply) lines.push_back(supply_in_words(*board.supply, board.supply_current));
  const std::string circuit = circuit_in_words(board.realization, board.ladder);
  lines.push_back(circuit + " on that board, " + siemens_in_words(board, board.stated.siemens) +
                  ": " + judged_in_words(board.stated));
  const std::string wanted = brief(board.wanted) + " degrees";
  if (board.changed()) {
    const bool enough = board.used.enough(board.wanted);
    lines.push_back(
        (board.file.empty() ? "raised to " : "other resistors on the same copper, ") +
        siemens_in_words(board, board.used.siemens) + ": " + judged_in_words(board.used) +
        "; resistors from " + brief(board.used.least_ohm) + " ohm" +
        (board.file.empty()
             ? ". The parts and the board are for these siemens, and so is the scene that is "
               "written beside them"
             : ""));
    if (board.file.empty() && board.used.overload) {
      const CircuitRemark& overload = *board.used.overload;
      lines.push_back(
          "warning: at those siemens the output of " + overload.part + " would carry " +
          with_unit(overload.value, "A") + ", it gives " + with_unit(overload.limit, "A") +
          " at most: set volts = " + brief(overload.repair / overload.unit) + " or less");
    }
    if (!enough)
      lines.push_back("warning: no siemens bring a phase margin of " + wanted +
                      " before a resistor is below " + brief(lab::least_board_ohm) +
                      " ohm: take op-amps with a second pole further beyond their bandwidth, or "
                      "a board with less copper at its inputs");
  } else if (!board.stated.enough(board.wanted)) {
    lines.push_back(board.stated.stable() || board.stated.oscillates()
                        ? "warning: the phase margin wanted is " + wanted +
                              ", and no siemens bring it before "
                              "a resistor is below " +
                              brief(lab::least_board_ohm) +
                              " ohm: take op-amps with a second pole further beyond their "
                              "bandwidth, or a board "
                              "with less copper at its inputs"
                        : "warning: what the copper does is not known: " +
                              (board.stated.stability.unknown == UnknownStability::too_many_states
                                   ? "the circuit has too many states for its poles"
                                   : std::string("the op-amps have no bandwidth")));
  }
  if (const auto& proposal = board.soldered().proposal) {
    Scale scale = board.circuit->options().scale;
    scale.siemens = board.soldered().siemens;
    lines.push_back(in_words(*proposal, scale) + ", on that board");
  }
  return lines;
}

std::string copper_csv(const lab::BoardCertificate& board) {
  std::string text = "net,pads,track_mm,missing_mm,pads_farad,tracks_farad,missing_farad,farad\n";
  for (const NetCopper& one : board.copper)
    text += one.net + ',' + std::to_string(one.pads) + ',' + shortest(one.length) + ',' +
            shortest(one.missing) + ',' + shortest(one.of_pads) + ',' + shortest(one.of_tracks) +
            ',' + shortest(one.of_missing) + ',' + shortest(one.farad()) + '\n';
  return text;
}

}  // namespace tactile_net::report
