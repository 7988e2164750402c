#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char one : text) {
    if (one == '"' || one == '\\') result += '\\';
    result += one;
  }
  return result + '"';
}

/// KiCad counts nanometres.
std::string millimetres(double value) { return shortest(std::round(value * 1e6) / 1e6 + 0.0); }

std::string at(double x, double y) { return "(at " + millimetres(x) + ' ' + millimetres(y) + ')'; }

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
  const std::string right = millimetres(board.width + 20.0 - 0.5);
  const std::string bottom = millimetres(board.height + 20.0 - 0.5);
  return "  (zone (net " + std::to_string(at - board.nets.begin()) + ") (net_name " + quoted(net) +
         ") (layer \"" + layer +
         "\") (hatch edge 0.508)\n    (connect_pads (clearance 0.2))\n    (min_thickness 0.2)\n"
         "    (fill yes (thermal_gap 0.3) (thermal_bridge_width 0.3))\n    (polygon (pts (xy 20.5 "
         "20.5) (xy " +
         right + " 20.5) (xy " + right + ' ' + bottom + ") (xy 20.5 " + bottom + ")))\n  )\n";
}

std::string text_of(const char* kind, const std::string& text, double y, const char* style) {
  return std::string("    (fp_text ") + kind + ' ' + quoted(text) + ' ' + at(0.0, y) + style + '\n';
}

/// The designator on the board, so narrow that it fits above an 0402; the value and
/// the courtyard on KiCad's layers for them.
std::string drawing_of(const Footprint& one) {
  const double x = 0.5 * one.width;
  const double y = 0.5 * one.height;
  return text_of("reference", one.reference(), -y - 0.5,
                 " (layer \"F.SilkS\") (effects (font (size 0.8 0.4) (thickness 0.1))))") +
         text_of("value", one.value, 0.0,
                 " (layer \"F.Fab\") (effects (font (size 0.3 0.3) (thickness 0.05))))") +
         "    (fp_rect (start " + millimetres(-x) + ' ' + millimetres(-y) + ") (end " +
         millimetres(x) + ' ' + millimetres(y) +
         ") (layer \"F.CrtYd\") (width 0.05) (fill none))\n";
}

std::string text_of(const BoardPad& pad, const Board& board) {
  std::string text = "    (pad " + quoted(pad.name);
  text += pad.drilled ? " thru_hole rect " : " smd roundrect ";
  text += at(pad.x, pad.y) + " (size " + millimetres(pad.width) + ' ' + millimetres(pad.height);
  text += pad.drilled ? ") (drill 1) (layers \"*.Cu\" \"*.Mask\")"
                      : ") (layers \"F.Cu\" \"F.Paste\" \"F.Mask\") (roundrect_rratio 0.25)";
  if (pad.net != 0)
    text += " (net " + std::to_string(pad.net) + ' ' + quoted(board.nets[pad.net]) + ')';
  return text + ")\n";
}

}  // namespace

void write_kicad_board(std::ostream& out, const Board& board) {
  std::string text = "(kicad_pcb (version 20211014) (generator tactile-net)\n";
  // A user's sheet: larger than any that has a name.
  text += "  (general (thickness 1.6))\n  (paper \"User\" " + millimetres(board.width + 40.0) +
          ' ' + millimetres(board.height + 40.0) + ")\n";
  text += layers;
  text += std::string("  (setup\n") + stackup + "    (pad_to_mask_clearance 0)\n  )\n";
  for (std::size_t net = 0; net < board.nets.size(); ++net)
    text += "  (net " + std::to_string(net) + ' ' + quoted(board.nets[net]) + ")\n";
  for (const Footprint& one : board.footprints) {
    text += "  (footprint " + quoted(one.library) + " (layer \"F.Cu\") " +
            at(one.x + 20.0, one.y + 20.0) + '\n';
    text += "    (property \"Element\" " + quoted(one.element) + ")\n";
    if (!one.tolerance.empty())
      text += "    (property \"Tolerance\" " + quoted(one.tolerance) + ")\n";
    text += one.pads.front().drilled ? "    (attr through_hole)\n" : "    (attr smd)\n";
    text += drawing_of(one);
    for (const BoardPad& pad : one.pads) text += text_of(pad, board);
    text += "  )\n";
  }
  text += "  (gr_rect (start 20 20) (end " + millimetres(board.width + 20.0) + ' ' +
          millimetres(board.height + 20.0) + ") (layer \"Edge.Cuts\") (width 0.1) (fill none))\n" +
          plane_of(board, "GND", "In1.Cu") + plane_of(board, "VCC", "In2.Cu") + ")\n";
  out << text;
}

}  // namespace tactile_net
