#include <ostream>
#include <string>

#include "tactile_net/network/board.hpp"

namespace tactile_net {

void write_kicad_project(std::ostream& out) {
  // What most makers of boards of four layers do without a surcharge.
  out << R"json({
  "board": {
    "design_settings": {
      "defaults": {
        "silk_line_width": 0.12,
        "silk_text_size_h": 0.8,
        "silk_text_size_v": 0.8,
        "silk_text_thickness": 0.1
      },
      "rules": {
        "min_clearance": 0.127,
        "min_copper_edge_clearance": 0.3,
        "min_hole_clearance": 0.2,
        "min_hole_to_hole": 0.25,
        "min_through_hole_diameter": 0.2,
        "min_track_width": 0.127,
        "min_via_annular_width": 0.1,
        "min_via_diameter": 0.4
      },
      "track_widths": [0.0, 0.15, 0.3],
      "via_dimensions": [{"diameter": 0.0, "drill": 0.0}, {"diameter": 0.45, "drill": 0.2}]
    }
  },
  "meta": {"filename": "board.kicad_pro", "version": 1},
  "net_settings": {
    "classes": [
      {
        "bus_width": 12.0,
        "clearance": 0.127,
        "diff_pair_gap": 0.25,
        "diff_pair_via_gap": 0.25,
        "diff_pair_width": 0.2,
        "line_style": 0,
        "microvia_diameter": 0.3,
        "microvia_drill": 0.1,
        "name": "Default",
        "pcb_color": "rgba(0, 0, 0, 0.000)",
        "schematic_color": "rgba(0, 0, 0, 0.000)",
        "track_width": 0.15,
        "via_diameter": 0.45,
        "via_drill": 0.2,
        "wire_width": 6.0
      }
    ],
    "meta": {"version": 2},
    "net_colors": null
  },
  "pcbnew": {"page_layout_descr_file": ""},
  "schematic": {"page_layout_descr_file": ""},
  "sheets": [],
  "text_variables": {}
}
)json";
}

}  // namespace tactile_net
