#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>

#include "network/board_rows.hpp"
#include "network/board_rules.hpp"
#include "network/s_expression.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

/// KiCad counts nanometres.
std::string millimetres(double value) { return shortest(std::round(value * 1e6) / 1e6 + 0.0); }

std::string at(double x, double y, double angle = 0.0) {
  return "(at " + millimetres(x) + ' ' + millimetres(y) +
         (angle == 0.0 ? "" : ' ' + millimetres(angle)) + ')';
}

constexpr double sheet_corner = 20.0;  // the board's corner on its sheet
std::string point(const char* name, double x, double y) {
  return std::string(" (") + name + ' ' + millimetres(x + sheet_corner) + ' ' +
         millimetres(y + sheet_corner) + ')';
}

constexpr const char* layers = R"(  (layers
    (0 "F.Cu" signal)
    (1 "In1.Cu" power)
    (2 "In2.Cu" power)
    (31 "B.Cu" signal)
    (34 "B.Paste" user)
    (35 "F.Paste" user)
    (36 "B.SilkS" user "B.Silkscreen")
    (37 "F.SilkS" user "F.Silkscreen")
    (38 "B.Mask" user)
    (39 "F.Mask" user)
    (44 "Edge.Cuts" user)
    (46 "B.CrtYd" user "B.Courtyard")
    (47 "F.CrtYd" user "F.Courtyard")
    (48 "B.Fab" user)
    (49 "F.Fab" user)
  )
)";

/// A usual one of four layers: parts and tracks along the rows on F.Cu, GND on In1.Cu, VCC on
/// In2.Cu, tracks along the columns on B.Cu.
constexpr const char* stackup = R"(    (stackup
      (layer "F.Mask" (type "Top Solder Mask") (thickness 0.01))
      (layer "F.Cu" (type "copper") (thickness 0.035))
      (layer "dielectric 1" (type "prepreg") (thickness 0.2104) (material "FR4") (epsilon_r 4.4) (loss_tangent 0.02))
      (layer "In1.Cu" (type "copper") (thickness 0.0152))
      (layer "dielectric 2" (type "core") (thickness 1.065) (material "FR4") (epsilon_r 4.6) (loss_tangent 0.02))
      (layer "In2.Cu" (type "copper") (thickness 0.0152))
      (layer "dielectric 3" (type "prepreg") (thickness 0.2104) (material "FR4") (epsilon_r 4.4) (loss_tangent 0.02))
      (layer "B.Cu" (type "copper") (thickness 0.035))
      (layer "B.Mask" (type "Bottom Solder Mask") (thickness 0.01))
      (copper_finish "None")
      (dielectric_constraints no)
    )
)";

/// Copper all over a layer.
std::string plane_of(const Board& board, const std::string& net, const char* layer) {
  const auto at = std::find(board.nets.begin(), board.nets.end(), net);
  constexpr double inset = board_rules::plane_from_edge;
  const std::string first = millimetres(sheet_corner + inset);
  const std::string right = millimetres(board.width + sheet_corner - inset);
  const std::string bottom = millimetres(board.height + sheet_corner - inset);
  const std::string clearance = millimetres(board_rules::plane_clearance);
  return "  (zone (net " + std::to_string(at - board.nets.begin()) + ") (net_name " +
         quoted_text(net) + ") (layer \"" + layer +
         "\") (hatch edge 0.508)\n    (connect_pads (clearance " + clearance +
         "))\n    (min_thickness 0.2)\n    (fill yes (thermal_gap " + clearance +
         ") (thermal_bridge_width 0.3))\n    (polygon (pts (xy " + first + ' ' + first + ") (xy " +
         right + ' ' + first + ") (xy " + right + ' ' + bottom + ") (xy " + first + ' ' + bottom +
         ")))\n  )\n";
}

/// A place that turns with the part.
std::pair<double, double> turned_place(double x, double y, double angle) {
  const BoardPad point = turned(BoardPad{.x = x, .y = y}, angle);
  return {point.x, point.y};
}

/// Where KiCad has the part.
std::pair<double, double> origin_of(const Footprint& one) {
  const auto [x, y] = turned_place(one.origin_x, one.origin_y, one.angle);
  return {one.x + x + sheet_corner, one.y + y + sheet_corner};
}

/// @param x, y  from the part's middle, as it lies on the board
std::string text_of(const Footprint& one, const char* kind, const std::string& text, double x,
                    double y, const char* style) {
  // KiCad turns the place with the part, and keeps the angle.
  const auto [own_x, own_y] = turned_place(x, y, 360.0 - one.angle);
  return std::string("    (fp_text ") + kind + ' ' + quoted_text(text) + ' ' +
         at(own_x - one.origin_x, own_y - one.origin_y, 90.0) + style + '\n';
}

constexpr const char* on_silk =
    " (layer \"F.SilkS\") (effects (font (size 0.8 0.4) (thickness 0.1))))";

constexpr const char* on_paper =
    " (layer \"F.Fab\") (effects (font (size 0.3 0.3) (thickness 0.05))))";

/// Beyond a header, to the board's edge, the net of each pin that is not of ground beside a signal.
std::string names_of_pins(const Footprint& one, const Board& board) {
  const auto [half_x, half_y] = half_size(one);
  const double away = 2.0 * one.y < board.height ? -1.0 : 1.0;
  const bool all = one.element == "supply";
  std::string text;
  for (const BoardPad& own : one.pads) {
    const std::string& net = board.nets[own.net];
    if (!all && net == "GND") continue;
    text += text_of(one, "user", net, turned(own, one.angle).x, away * (half_y + 2.0), on_silk);
  }
  if (!all) text += text_of(one, "user", "GND", half_x + 0.45, away * 1.27, on_silk);
  return text;
}

/// The designator along y on the board's silk, right of the part, of headers left of it; of headers
/// and test points nets' names too. The value and the courtyard are on KiCad's layers for them.
std::string drawing_of(const Footprint& one, const Board& board) {
  const double right = half_size(one).first + 0.45;
  std::string text;
  if (one.kind == Footprint::Kind::header) {
    text = text_of(one, "reference", one.reference(), -right, 0.0, on_silk) +
           names_of_pins(one, board);
  } else {
    text = text_of(one, "reference", one.reference(), right, 0.0,
                   one.kind == Footprint::Kind::screw ? on_paper : on_silk);
    if (one.kind == Footprint::Kind::test_point)
      text += text_of(one, "user", one.value, -right, 0.0, on_silk);
  }
  text += text_of(one, "value", one.value, 0.0, 0.0, on_paper);
  return text + "    (fp_rect (start " + millimetres(-0.5 * one.width - one.origin_x) + ' ' +
         millimetres(-0.5 * one.height - one.origin_y) + ") (end " +
         millimetres(0.5 * one.width - one.origin_x) + ' ' +
         millimetres(0.5 * one.height - one.origin_y) +
         ") (layer \"F.CrtYd\") (width 0.05) (fill none))\n";
}

std::string text_of(const BoardPad& pad, const Footprint& one, const Board& board) {
  if (one.kind == Footprint::Kind::screw)
    return "    (pad \"\" np_thru_hole circle (at 0 0) (size 3.2 3.2) (drill 3.2) (layers \"*.Cu\" "
           "\"*.Mask\"))\n";
  std::string text = "    (pad " + quoted_text(pad.name);
  // Pin 1 of a header is square.
  text +=
      pad.drilled ? (pad.name == "1" ? " thru_hole rect " : " thru_hole oval ") : " smd roundrect ";
  text += at(pad.x - one.origin_x, pad.y - one.origin_y, one.angle) + " (size " +
          millimetres(pad.width) + ' ' + millimetres(pad.height);
  text += pad.drilled
              ? ") (drill " + millimetres(board_rules::pin_drill) + ") (layers \"*.Cu\" \"*.Mask\")"
              : ") (layers \"F.Cu\" \"F.Paste\" \"F.Mask\") (roundrect_rratio 0.25)";
  if (pad.net != 0)
    text += " (net " + std::to_string(pad.net) + ' ' + quoted_text(board.nets[pad.net]) + ')';
  return text + ")\n";
}

}  // namespace

void write_kicad_board(std::ostream& out, const Board& board) {
  std::string text = "(kicad_pcb (version 20211014) (generator tactile-net)\n";
  // A user's sheet_corner: larger than any that has a name.
  text += "  (general (thickness 1.6))\n  (paper \"User\" " + millimetres(board.width + 40.0) +
          ' ' + millimetres(board.height + 40.0) + ")\n";
  text += layers;
  text += std::string("  (setup\n") + stackup + "    (pad_to_mask_clearance 0)\n  )\n";
  for (std::size_t net = 0; net < board.nets.size(); ++net)
    text += "  (net " + std::to_string(net) + ' ' + quoted_text(board.nets[net]) + ")\n";
  for (const Footprint& one : board.footprints) {
    const auto [x, y] = origin_of(one);
    text += "  (footprint " + quoted_text(one.library) + " (layer \"F.Cu\") " +
            at(x, y, one.angle) + '\n';
    text += "    (property \"Element\" " + quoted_text(one.element) + ")\n";
    if (!one.tolerance.empty())
      text += "    (property \"Tolerance\" " + quoted_text(one.tolerance) + ")\n";
    text += one.pads.front().drilled ? "    (attr through_hole" : "    (attr smd";
    if (!one.is_placed()) text += " exclude_from_pos_files";
    text += one.is_bought() ? ")\n" : " exclude_from_bom)\n";
    text += drawing_of(one, board);
    for (const BoardPad& pad : one.pads) text += text_of(pad, one, board);
    text += "  )\n";
  }
  for (const BoardTrack& one : board.tracks)
    text += "  (segment" + point("start", one.from_x, one.from_y) +
            point("end", one.to_x, one.to_y) + " (width " + millimetres(one.width) +
            (one.back ? ") (layer \"B.Cu\") (net " : ") (layer \"F.Cu\") (net ") +
            std::to_string(one.net) + "))\n";
  for (const BoardVia& one : board.vias)
    text += "  (via" + point("at", one.x, one.y) + " (size " + millimetres(board_rules::via) +
            ") (drill " + millimetres(board_rules::via_drill) +
            ") (layers \"F.Cu\" \"B.Cu\") (net " + std::to_string(one.net) + "))\n";
  for (const BoardText& one : board.texts)
    text += "  (gr_text " + quoted_text(one.text) + ' ' +
            at(one.x + sheet_corner, one.y + sheet_corner, one.angle) + on_silk + '\n';
  text += "  (gr_rect (start 20 20) (end " + millimetres(board.width + sheet_corner) + ' ' +
          millimetres(board.height + sheet_corner) +
          ") (layer \"Edge.Cuts\") (width 0.1) (fill none))\n" + plane_of(board, "GND", "In1.Cu") +
          plane_of(board, "VCC", "In2.Cu") + ")\n";
  out << text;
}

void write_positions(std::ostream& out, const Board& board) {
  std::string text = "Designator,Val,Package,Mid X,Mid Y,Rotation,Layer\n";
  for (const Footprint& one : board.footprints) {
    if (!one.is_placed()) continue;
    const auto [x, y] = origin_of(one);
    text += one.reference() + ',' + one.value + ',' + one.package() + ',' + millimetres(x) + ',' +
            millimetres(-y) + ',' + millimetres(one.angle) + ",top\n";
  }
  out << text;
}

}  // namespace tactile_net
