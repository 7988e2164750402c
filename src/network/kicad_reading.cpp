#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "network/s_expression.hpp"
#include "tactile_net/network/laid_board.hpp"

namespace tactile_net {
namespace {

using Item = SExpression::Item;

constexpr double usual_permittivity = 4.5;  // of FR-4, where the file states none
constexpr std::size_t most_nets = 1'000'000;
constexpr double farthest = 1e5;   // [mm] of a place or size: nothing larger is a board
constexpr double thinnest = 1e-3;  // [mm] of a track or a sheet: nothing thinner is made

double length_of(const Item& item) {
  const double value = item.number();
  if (!(std::abs(value) <= farthest)) item.refuse("a length of more than 100 m");
  return value;
}

double size_of(const Item& item) {
  const double value = length_of(item);
  if (!(value >= 0.0)) item.refuse("a size below 0");
  return value;
}

bool is_copper(std::string_view layer) {
  return layer.size() > 3 && layer.substr(layer.size() - 3) == ".Cu";
}

/// Of a polygon: twice its area with a sign, and the length of its edge.
struct Outline {
  double area = 0.0, edge = 0.0;
};
Outline outline_of(const Item& points) {
  std::vector<std::pair<double, double>> all;
  points.each("xy", [&](const Item& one) {
    all.emplace_back(length_of(one.part(0)), length_of(one.part(1)));
  });
  Outline result;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& [x, y] = all[k];
    const auto& [next_x, next_y] = all[(k + 1) % all.size()];
    result.area += 0.5 * (x * next_y - next_x * y);
    result.edge += std::hypot(next_x - x, next_y - y);
  }
  result.area = std::abs(result.area);
  return result;
}

class BoardReading {
 public:
  BoardReading(std::string_view text, const std::string& file) : tree_(text, file) {
    board_.file = file;
  }

  LaidBoard board() && {
    const Item root = tree_.root();
    if (root.head() != "kicad_pcb")
      root.refuse("no board of KiCad: its list is (" + std::string(root.head()).substr(0, 40) +
                  " ...), not (kicad_pcb ...)");
    read_layers(root);
    read_nets(root);
    root.each("footprint", [&](const Item& one) { add_part(one); });
    root.each("module", [&](const Item& one) {
      one.refuse("a footprint of KiCad 5: save the board with KiCad 6 or newer");
    });
    root.each("segment",
              [&](const Item& one) { add_track(one, one.get("start"), one.get("end")); });
    root.each("arc", [&](const Item& one) {  // two chords: short of the arc by a tenth at most
      add_track(one, one.get("start"), one.get("mid"));
      add_track(one, one.get("mid"), one.get("end"));
    });
    root.each("via", [&](const Item& one) {
      board_.vias.push_back({net_of(one), length_of(one.get("at").part(0)),
                             length_of(one.get("at").part(1)), size_of(one.get("size").part(0)),
                             one.find("drill") ? size_of(one.get("drill").part(0)) : 0.0});
    });
    root.each("zone", [&](const Item& one) { add_zone(one); });
    place_planes();
    return std::move(board_);
  }

 private:
  void read_layers(const Item& root) {
    std::vector<std::string> copper_names;
    root.get("layers").each({}, [&](const Item& one) {
      if (const auto name = one.find_part(0); name && is_copper(name->text()))
        copper_names.push_back(name->text());
    });
    // KiCad 9 numbers B.Cu before the inner ones; it is the last from the top in any case.
    if (const auto back = std::find(copper_names.begin(), copper_names.end(), "B.Cu");
        back != copper_names.end())
      std::rotate(back, back + 1, copper_names.end());
    if (copper_names.size() < 2 || copper_names.front() != "F.Cu" || copper_names.back() != "B.Cu")
      root.get("layers").refuse("a board has the copper layers F.Cu and B.Cu");
    if (copper_names.size() > 64) root.get("layers").refuse("more than 64 layers of copper");
    for (std::size_t k = 0; k < copper_names.size(); ++k) {
      layer_[copper_names[k]] = k;
      board_.layers.push_back(
          {.name = copper_names[k], .inside = k > 0 && k + 1 < copper_names.size()});
    }
    if (const auto general = root.find("general"))
      if (const auto thickness = general->find("thickness"))
        board_.thickness = size_of(thickness->part(0));
    if (!(board_.thickness >= thinnest)) root.refuse("a board without a thickness of 1 um or more");
    gaps_.assign(
        copper_names.size() - 1,
        {board_.thickness / static_cast<double>(copper_names.size() - 1), usual_permittivity});
    const auto setup = root.find("setup");
    if (const auto sheets = setup ? setup->find("stackup") : std::nullopt) read_stackup(*sheets);
  }

  struct SheetGap {
    double height, permittivity;
  };

  /// Sheets between two layers of copper are one, in series.
  void read_stackup(const Item& sheets) {
    std::size_t above = 0;  // layers of copper so far
    double height = 0.0;
    double height_over_permittivity = 0.0;
    std::vector<SheetGap> gaps;
    sheets.each("layer", [&](const Item& one) {
      const std::string name = one.part(0).text();
      const auto thickness = one.find("thickness");
      if (is_copper(name)) {
        if (!layer_.contains(name) || layer_[name] != above)
          one.refuse("the stackup's layers of copper are not the board's");
        if (above > 0) {
          if (!(height >= thinnest))
            one.refuse(
                "no thickness of 1 um or more between this layer of copper and the one above");
          gaps.push_back({height, height / height_over_permittivity});
        }
        if (thickness && above == 0) board_.copper = size_of(thickness->part(0));
        ++above;
        height = height_over_permittivity = 0.0;
        return;
      }
      if (above == 0 || above == board_.layers.size()) return;  // mask and silk
      const auto permittivity = one.find("epsilon_r");
      const double value = permittivity ? permittivity->part(0).number() : usual_permittivity;
      if (!(value >= 1.0 && value <= 1000.0)) one.refuse("epsilon_r must be from 1 to 1000");
      const double sheet = thickness ? size_of(thickness->part(0)) : 0.0;
      height += sheet;
      height_over_permittivity += sheet / value;
    });
    if (above != board_.layers.size())
      sheets.refuse("the stackup's layers of copper are not the board's");
    gaps_ = std::move(gaps);
  }

  void read_nets(const Item& root) {
    board_.nets = {""};
    root.each("net", [&](const Item& one) {
      const std::size_t number = one.part(0).index(most_nets);
      const std::string name = one.part(1).text();
      if (!net_.try_emplace(number, 0).second)
        one.refuse("net " + std::to_string(number) + " twice");
      if (name.empty()) return;
      if (!by_name_.try_emplace(name, board_.nets.size()).second)
        one.refuse("two nets are named '" + name + "'");
      net_[number] = board_.nets.size();
      board_.nets.push_back(name);
    });
  }

  /// By number, or by name as KiCad 10 has it; 0 where there is none.
  std::size_t net_of(const Item& item) {
    const auto net = item.find("net");
    if (!net) return 0;
    const std::string word = net->part(0).text();
    const auto number = net_.find(net_.empty()                       ? 0
                                  : net->find_part(0) && whole(word) ? *whole(word)
                                                                     : most_nets);
    if (number != net_.end()) return number->second;
    if (const auto named = by_name_.find(word); named != by_name_.end()) return named->second;
    if (word.empty()) return 0;
    if (!net_.empty())
      net->refuse("net " + word.substr(0, 40) + " is not in the board's list of nets");
    const std::size_t at = board_.nets.size();
    by_name_[word] = at;
    board_.nets.push_back(word);
    return at;
  }
  static std::optional<std::size_t> whole(const std::string& word) {
    std::size_t value = 0;
    if (word.empty() || word.size() > 7) return std::nullopt;
    for (const char one : word) {
      if (one < '0' || one > '9') return std::nullopt;
      value = 10 * value + static_cast<std::size_t>(one - '0');
    }
    return value;
  }

  void add_part(const Item& footprint) {
    LaidBoard::Part part{.line = footprint.line()};
    footprint.each("property", [&](const Item& one) {
      const auto value = one.find_part(1);
      if (!value || value->is_list()) return;
      take(part, one.part(0).text(), value->text());
    });
    footprint.each("fp_text", [&](const Item& one) {
      const std::string kind = one.part(0).text();
      if (kind == "reference") take(part, "Reference", one.part(1).text());
      if (kind == "value") take(part, "Value", one.part(1).text());
    });
    const Item at = footprint.get("at");
    const double angle = at.find_part(2) ? at.part(2).number() : 0.0;
    const double turn = angle * std::numbers::pi / 180.0;
    footprint.each("pad", [&](const Item& one) {
      if (const auto kind = one.part(1).text(); kind == "np_thru_hole") return;
      const Item place = one.get("at");
      const double x = length_of(place.part(0));
      const double y = length_of(place.part(1));
      LaidBoard::Pad pad{.name = one.part(0).text(),
                         .net = net_of(one),
                         .x = length_of(at.part(0)) + x * std::cos(turn) + y * std::sin(turn),
                         .y = length_of(at.part(1)) - x * std::sin(turn) + y * std::cos(turn),
                         .angle = place.find_part(2) ? place.part(2).number() : 0.0,
                         .width = size_of(one.get("size").part(0)),
                         .height = size_of(one.get("size").part(1)),
                         .on = std::vector<bool>(board_.layers.size())};
      const std::string shape = one.part(2).text();
      pad.round = shape == "circle" || shape == "oval";
      one.get("layers").each_part([&](const Item& layer) {
        const std::string name = layer.text();
        if (name == "*.Cu") pad.on.assign(pad.on.size(), true);
        if (name == "F&B.Cu") pad.on.front() = pad.on.back() = true;
        if (const auto known = layer_.find(name); known != layer_.end())
          pad.on[known->second] = true;
      });
      if (const auto drill = one.find("drill"))
        drill->each_part([&](const Item& size) {
          if (!size.is_list() && size.text() != "oval")
            pad.hole = std::max(pad.hole, size_of(size));
        });
      part.pads.push_back(std::move(pad));
    });
    board_.parts.push_back(std::move(part));
  }

  static void take(LaidBoard::Part& part, const std::string& key, std::string value) {
    if (key == "Reference")
      part.reference = std::move(value);
    else if (key == "Value")
      part.value = std::move(value);
    else if (key == "Element")
      part.element = std::move(value);
  }

  [[nodiscard]] std::size_t layer_of(const Item& item) const {
    const Item layer = item.get("layer").part(0);
    const auto known = layer_.find(layer.text());
    if (known == layer_.end())
      layer.refuse("'" + layer.text().substr(0, 40) + "' is no layer of copper of this board");
    return known->second;
  }

  void add_track(const Item& one, const Item& from, const Item& to) {
    const LaidBoard::Track track{.net = net_of(one),
                                 .layer = layer_of(one),
                                 .from_x = length_of(from.part(0)),
                                 .from_y = length_of(from.part(1)),
                                 .to_x = length_of(to.part(0)),
                                 .to_y = length_of(to.part(1)),
                                 .width = size_of(one.get("width").part(0))};
    if (!(track.width >= thinnest)) one.refuse("a track without a width of 1 um or more");
    board_.tracks.push_back(track);
  }

  void add_zone(const Item& zone) {
    if (zone.find("keepout")) return;
    const std::size_t net = net_of(zone);
    if (net == 0) return;
    if (const auto connect = zone.find("connect_pads"))
      if (const auto clearance = connect->find("clearance"))
        clearance_ = std::min(clearance_.value_or(farthest), size_of(clearance->part(0)));
    if (!is_supply(board_.nets[net])) {
      zone.each("filled_polygon", [&](const Item& filled) {
        const auto layer = filled.find("layer") ? layer_of(filled) : layer_of(zone);
        const Outline outline = outline_of(filled.get("pts"));
        board_.areas.push_back({net, layer, outline.area, outline.edge});
      });
      return;
    }
    double area = 0.0;
    zone.each("polygon", [&](const Item& one) { area += outline_of(one.get("pts")).area; });
    const auto cover = [&](const std::string& name) {
      if (const auto known = layer_.find(name); known != layer_.end())
        covered_[known->second] += area;
    };
    if (const auto layer = zone.find("layer")) cover(layer->part(0).text());
    if (const auto on_layers = zone.find("layers"))
      on_layers->each_part([&](const Item& layer) { cover(layer.text()); });
  }

  void place_planes() {
    double left = farthest;
    double right = -farthest;
    double top = farthest;
    double bottom = -farthest;
    for (const LaidBoard::Part& part : board_.parts)
      for (const LaidBoard::Pad& pad : part.pads) {
        left = std::min(left, pad.x);
        right = std::max(right, pad.x);
        top = std::min(top, pad.y);
        bottom = std::max(bottom, pad.y);
      }
    const double all = std::max(right - left, 0.0) * std::max(bottom - top, 0.0);
    for (const auto& [layer, area] : covered_)
      if (area >= 0.5 * all && area > 0.0) board_.layers[layer].plane = board_.has_planes = true;
    board_.clearance = clearance_.value_or(board_.clearance);
    for (std::size_t k = 0; k < board_.layers.size(); ++k) {
      LaidBoard::Layer& layer = board_.layers[k];
      layer.to_plane = board_.thickness;
      layer.permittivity = gaps_.front().permittivity;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t other = 0; other < board_.layers.size(); ++other) {
        if (other == k || !board_.layers[other].plane) continue;
        double height = 0.0;
        double reduced = 0.0;
        for (std::size_t g = std::min(k, other); g < std::max(k, other); ++g) {
          height += gaps_[g].height;
          reduced += gaps_[g].height / gaps_[g].permittivity;
        }
        if (height >= nearest) continue;
        nearest = height;
        layer.to_plane = height;
        layer.permittivity = height / reduced;
      }
    }
  }

  SExpression tree_;
  LaidBoard board_;
  std::map<std::string, std::size_t> layer_;    // by their copper_names
  std::map<std::size_t, std::size_t> net_;      // by the file's numbers
  std::map<std::string, std::size_t> by_name_;  // nets
  std::vector<SheetGap> gaps_;                  // between layers of copper
  std::map<std::size_t, double> covered_;       // of layers by supply, [mm^2]
  std::optional<double> clearance_;
};

}  // namespace

bool is_supply(std::string_view net) noexcept {
  return net == "GND" || net == "VCC" || net == "VEE";
}

LaidBoard read_kicad_board(std::string_view text, const std::string& file) {
  return BoardReading(text, file).board();
}

}  // namespace tactile_net
