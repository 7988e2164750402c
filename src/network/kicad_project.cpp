#include <ostream>
#include <string>
#include <utility>

#include "network/board_rules.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr const char* project = R"json({
  "board": {
    "design_settings": {
      "defaults": {
        "silk_line_width": 0.12,
        "silk_text_size_h": @silk_height@,
        "silk_text_size_v": @silk_height@,
        "silk_text_thickness": @silk_line@
      },
      "rule_severities": {
        "lib_footprint_issues": "ignore",
        "lib_footprint_mismatch": "ignore"
      },
      "rules": {
        "min_clearance": @clearance@,
        "min_copper_edge_clearance": @copper_to_edge@,
        "min_hole_clearance": @hole_to_copper@,
        "min_hole_to_hole": @hole_to_hole@,
        "min_through_hole_diameter": @via_drill@,
        "min_track_width": @least_track@,
        "min_via_annular_width": @least_ring@,
        "min_via_diameter": @least_via@
      },
      "track_widths": [0.0, @track@, @wide_track@, @supply_track@],
      "via_dimensions": [{"diameter": 0.0, "drill": 0.0}, {"diameter": @via@, "drill": @via_drill@}]
    }
  },
  "erc": {
    "rule_severities": {
      "lib_symbol_issues": "ignore"
    }
  },
  "meta": {"filename": "board.kicad_pro", "version": 1},
  "net_settings": {
    "classes": [
      {
        "bus_width": 12.0,
        "clearance": @clearance@,
        "diff_pair_gap": 0.25,
        "diff_pair_via_gap": 0.25,
        "diff_pair_width": 0.2,
        "line_style": 0,
        "microvia_diameter": 0.3,
        "microvia_drill": 0.1,
        "name": "Default",
        "pcb_color": "rgba(0, 0, 0, 0.000)",
        "schematic_color": "rgba(0, 0, 0, 0.000)",
        "track_width": @track@,
        "via_diameter": @via@,
        "via_drill": @via_drill@,
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

}  // namespace

void write_kicad_project(std::ostream& out) {
  using namespace board_rules;
  std::string text = project;
  for (const auto& [name, value] : {std::pair("clearance", clearance),
                                    {"track", track},
                                    {"wide_track", wide_track},
                                    {"supply_track", supply_track},
                                    {"via", via},
                                    {"via_drill", via_drill},
                                    {"least_track", least_track},
                                    {"least_via", least_via},
                                    {"least_ring", least_ring},
                                    {"hole_to_hole", hole_to_hole},
                                    {"hole_to_copper", hole_to_copper},
                                    {"copper_to_edge", copper_to_edge},
                                    {"silk_height", silk_height},
                                    {"silk_line", silk_line}}) {
    const std::string mark = std::string("@") + name + '@';
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;)
      text.replace(at, mark.size(), shortest(value));
  }
  out << text;
}

}  // namespace tactile_net
