#include "network/board_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace tactile_net {
namespace {

constexpr double board_margin = 8.0;       // [mm], with room for a screw
constexpr double designator_beside = 0.9;  // beside a part, for its designator along y
constexpr double slot_width = 0.94 + 0.9;  // an 0402 and its designator
constexpr double pin_label_room = 4.6;     // beyond headers
constexpr double between_headers = 0.3;
constexpr double title_room = 2.4;              // above the first row
constexpr double column_label_room = 2.6;       // above columns
constexpr std::size_t slots_of_test_point = 2;  // or left of the slots
constexpr double test_point_name = 1.0;         // left of it

/// Resistors that stand side by side, between two nets.
struct BoardUnit {
  std::vector<std::size_t> parts{};
  std::size_t first = 0, last = 0;  // nets
  std::size_t slots = 0;
  std::size_t above = 0;  // the net that its row is of

  [[nodiscard]] std::size_t below() const { return above == first ? last : first; }
};

/// Units with one net above them.
struct UnitGroup {
  std::size_t net = 0;
  std::vector<std::size_t> units{};
  std::optional<std::size_t> test_point{};
  std::size_t slots = 0;
};

/// What stands in a row, in slots or in millimetres: from where on, at first as it would like to.
template <class Length>
struct Standing {
  Length left{};
  Length width{};
  std::size_t index = 0;
};

/// Between these, in their order, as near to where each would stand as the others allow.
template <class Length>
void stand(std::vector<Standing<Length>>& all, Length first, Length last) {
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.left < b.left; });
  for (Standing<Length>& one : all) {
    one.left = std::max(one.left, first);
    first = one.left + one.width;
  }
  for (std::size_t k = all.size(); k-- > 0;) {
    all[k].left = std::min(all[k].left, last - all[k].width);
    last = all[k].left;
  }
}
using StandingInSlots = Standing<std::size_t>;

class Placement {
 public:
  Placement(Board& board, const BoardFootprints& parts) : board_(board), parts_(parts) {}

  std::vector<BoardRow> rows() {
    make_units();
    make_groups();
    add_test_points();
    find_columns();
    board_.width = std::max({x_of(slots_) + board_margin,
                             2.0 * board_margin + designator_beside + widest_amplifier(),
                             2.0 * board_margin + widest_header()});
    add_headers(parts_.inputs, true);
    const std::size_t first = rows_.size();
    add_resistors();
    if (rows_.size() > first) rows_[first].begins_section = true;
    if (rows_.size() > first && slots_ >= columns_.size()) {
      rows_[first].room_above += column_label_room;
      for (const auto& [net, column] : columns_)
        rows_[first].columns.emplace_back(x_of(home(column)) + 0.47, board_.nets[net]);
    }
    add_loose_test_points();
    add_amplifiers();
    add_headers(parts_.outputs, false);
    rows_.front().room_above += title_room;
    return std::move(rows_);
  }

 private:
  [[nodiscard]] double x_of(std::size_t at) const {
    return left_ + slot_width * static_cast<double>(at);
  }
  [[nodiscard]] Footprint& part(std::size_t index) { return board_.footprints[index]; }
  [[nodiscard]] static std::size_t slots_of(const Footprint& one) {
    return static_cast<std::size_t>(
        std::ceil((one.height + designator_beside) / slot_width - 1e-9));
  }

  void make_units() {
    for (const std::vector<std::size_t>& own : parts_.resistors) {
      BoardUnit unit{.parts = own};
      unit.first = part(own.front()).pads[0].net;
      unit.last = part(own.back()).pads[1].net;
      for (const std::size_t one : own) unit.slots += slots_of(part(one));
      units_.push_back(std::move(unit));
    }
  }

  /// The net that most of the units have that are left takes these, and so on.
  void make_groups() {
    std::vector<std::vector<std::size_t>> of_net(board_.nets.size());
    for (std::size_t u = 0; u < units_.size(); ++u)
      for (const std::size_t net : {units_[u].first, units_[u].last})
        if (net != parts_.ground) of_net[net].push_back(u);
    std::vector<std::size_t> left(of_net.size());
    for (std::size_t net = 0; net < left.size(); ++net) left[net] = of_net[net].size();
    std::vector<bool> placed(units_.size());
    for (;;) {
      const auto most = std::max_element(left.begin(), left.end());
      if (most == left.end() || *most == 0) break;
      UnitGroup group{.net = static_cast<std::size_t>(most - left.begin())};
      bool to_ground = true;
      for (const std::size_t u : of_net[group.net]) {
        if (placed[u]) continue;
        placed[u] = true;
        --left[units_[u].first];
        if (units_[u].last != units_[u].first) --left[units_[u].last];
        left[parts_.ground] = 0;
        units_[u].above = group.net;
        to_ground = to_ground && units_[u].below() == parts_.ground;
        group.units.push_back(u);
        group.slots += units_[u].slots;
      }
      left[group.net] = 0;
      if (to_ground) {  // their net is that of a column elsewhere
        group.net = parts_.ground;
        for (const std::size_t u : group.units) units_[u].above = parts_.ground;
      }
      groups_.push_back(std::move(group));
    }
    std::stable_sort(groups_.begin(), groups_.end(),
                     [](const UnitGroup& a, const UnitGroup& b) { return a.net < b.net; });
  }

  /// Beside the resistors of their net, if that has a row.
  void add_test_points() {
    std::map<std::size_t, std::size_t> group_of;
    std::size_t most = 0;
    for (const UnitGroup& one : groups_) most = std::max(most, one.slots);
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (4 * groups_[g].slots > most) group_of[groups_[g].net] = g;
    for (const std::size_t point : parts_.test_points) {
      const auto own = group_of.find(part(point).pads[0].net);
      if (own == group_of.end()) {
        loose_.push_back(point);
        continue;
      }
      groups_[own->second].test_point = point;
      left_ = board_margin + slot_width * slots_of_test_point;
    }
  }

  void find_columns() {
    std::set<std::size_t> nets;
    for (const BoardUnit& one : units_) nets.insert(one.below());
    nets.erase(parts_.ground);
    for (const std::size_t net : nets) columns_.try_emplace(net, columns_.size());
    std::size_t most = slots_of_test_point;
    for (const UnitGroup& one : groups_) most = std::max(most, one.slots);
    slots_ = std::max(most, std::min(columns_.size(), 4 * most));
  }
  [[nodiscard]] std::size_t home(std::size_t column) const {
    return column * slots_ / std::max(columns_.size(), std::size_t{1});
  }
  [[nodiscard]] std::size_t wanted(const BoardUnit& one) const {
    const auto column = columns_.find(one.below());
    return column == columns_.end() ? 0 : home(column->second);
  }

  void add_resistors() {
    struct Shelf {
      std::vector<std::size_t> groups{};
      std::vector<std::pair<std::size_t, std::size_t>> taken{};  // slots
      std::size_t slots = 0;
    };
    std::vector<Shelf> shelves;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const UnitGroup& group = groups_[g];
      std::size_t low = slots_;
      std::size_t high = 0;
      for (const std::size_t u : group.units) {
        low = std::min(low, wanted(units_[u]));
        high = std::max(high, wanted(units_[u]) + units_[u].slots);
      }
      high = std::max(high, low + group.slots);
      // A net that has many takes a row.
      if (4 * group.slots > slots_ || group.test_point)
        std::tie(low, high) = std::pair(std::size_t{0}, slots_);
      auto shelf = std::find_if(shelves.begin(), shelves.end(), [&](const Shelf& one) {
        return one.slots + group.slots <= slots_ &&
               std::none_of(one.taken.begin(), one.taken.end(), [&](const auto& other) {
                 return low < other.second && other.first < high;
               });
      });
      if (shelf == shelves.end()) shelf = shelves.insert(shelf, Shelf{});
      shelf->groups.push_back(g);
      shelf->taken.emplace_back(low, high);
      shelf->slots += group.slots;
    }
    for (const Shelf& shelf : shelves) {
      std::vector<StandingInSlots> all;
      BoardRow row;
      for (const std::size_t g : shelf.groups) {
        for (const std::size_t u : groups_[g].units)
          all.push_back({wanted(units_[u]), units_[u].slots, u});
        if (groups_[g].test_point)
          add_at(row, *groups_[g].test_point, board_margin + test_point_name, 0.0);
      }
      if (shelf.groups.size() == 1) row.name = board_.nets[groups_[shelf.groups[0]].net];
      stand(all, std::size_t{0}, slots_);
      for (const StandingInSlots& one : all) add_unit(row, units_[one.index], one.left);
      rows_.push_back(std::move(row));
    }
  }

  void add_unit(BoardRow& row, const BoardUnit& unit, std::size_t at) {
    // The first pad above if the first node is that of the row.
    const bool as_it_is = unit.above == unit.first;
    std::vector<std::size_t> order = unit.parts;
    if (!as_it_is) std::reverse(order.begin(), order.end());
    for (const std::size_t index : order) {
      add_at(row, index, x_of(at), as_it_is ? 270.0 : 90.0);
      at += slots_of(part(index));
    }
  }

  /// With its courtyard's left edge at x.
  void add_at(BoardRow& row, std::size_t index, double x, double angle) {
    part(index).angle = angle;
    part(index).x = x + half_size(part(index)).first;
    row.parts.push_back(index);
  }

  void add_loose_test_points() {
    for (std::size_t k = 0; k < loose_.size();) {
      BoardRow row;
      std::vector<StandingInSlots> all;
      for (; k < loose_.size() && (all.size() + 1) * slots_of_test_point <= slots_; ++k) {
        const auto column = columns_.find(part(loose_[k]).pads[0].net);
        all.push_back(
            {column == columns_.end() ? 0 : home(column->second), slots_of_test_point, loose_[k]});
      }
      stand(all, std::size_t{0}, slots_);
      for (const StandingInSlots& one : all)
        add_at(row, one.index, x_of(one.left) + test_point_name, 0.0);
      rows_.push_back(std::move(row));
    }
  }

  /// So that the negative supply leaves below it.
  [[nodiscard]] double angle_of(const Footprint& one) const {
    for (const BoardPad& pad : one.pads)
      if (pad.net == parts_.negative && turned(pad, 270.0).y < -turned(pad, 270.0).height)
        return 90.0;
    return 270.0;
  }

  double width_of(const std::vector<std::size_t>& amplifier) {
    double capacitors = 0.0;
    for (auto one = amplifier.begin() + 1; one != amplifier.end(); ++one)
      capacitors += part(*one).height + designator_beside;
    return std::max(capacitors, part(amplifier.front()).height + designator_beside);
  }
  double widest_amplifier() {
    double widest = 0.0;
    for (const auto& one : parts_.amplifiers) widest = std::max(widest, width_of(one));
    return widest;
  }

  /// Each below the columns of its nets, in as many rows as it takes.
  void add_amplifiers() {
    if (parts_.amplifiers.empty()) return;
    const double room = board_.width - 2.0 * board_margin;
    const auto in_row = static_cast<std::size_t>(std::floor(room / widest_amplifier()));
    const std::size_t count = (parts_.amplifiers.size() + in_row - 1) / in_row;
    for (std::size_t k = 0; k < count; ++k) {
      std::vector<Standing<double>> all;
      for (std::size_t a = k; a < parts_.amplifiers.size(); a += count) {
        double sum = 0.0;
        double nets = 0.0;
        for (const BoardPad& pad : part(parts_.amplifiers[a].front()).pads)
          if (const auto column = columns_.find(pad.net); column != columns_.end()) {
            sum += x_of(home(column->second));
            nets += 1.0;
          }
        const double width = width_of(parts_.amplifiers[a]);
        all.push_back({(nets > 0.0 ? sum / nets : board_margin) - 0.5 * width, width, a});
      }
      stand(all, board_margin, board_.width - board_margin);
      BoardRow row{.begins_section = true};
      BoardRow capacitors;
      for (const Standing<double>& one : all) {
        const std::vector<std::size_t>& own = parts_.amplifiers[one.index];
        add_at(row, own.front(), one.left, angle_of(part(own.front())));
        double x = one.left;
        for (auto index = own.begin() + 1; index != own.end(); ++index) {
          add_at(capacitors, *index, x, 270.0);
          x += part(*index).height + designator_beside;
        }
      }
      rows_.push_back(std::move(row));
      rows_.push_back(std::move(capacitors));
    }
  }

  /// Along x, with its designator.
  [[nodiscard]] double width_in_row(std::size_t index) {
    return part(index).height + designator_beside + between_headers;
  }
  [[nodiscard]] double widest_header() {
    double widest = 0.0;
    for (const auto* const all : {&parts_.inputs, &parts_.outputs})
      for (const std::size_t one : *all) widest = std::max(widest, width_in_row(one));
    return widest;
  }

  /// Pin 1 left and below, so that of two rows the odd pins are below; capacitors with the supply
  /// above, as the headers beside them have it.
  void add_headers(const std::vector<std::size_t>& all, bool down) {
    for (std::size_t k = 0; k < all.size();) {
      BoardRow row{.begins_section = true,
                   .down = down,
                   .room_above = down ? pin_label_room : 0.0,
                   .room_below = down ? 0.0 : pin_label_room};
      double x = board_margin;
      for (; k < all.size() && x + width_in_row(all[k]) <= board_.width - board_margin + 1e-9;
           ++k) {
        // A header's designator stands left of it, a capacitor's right.
        const bool is_header = part(all[k]).kind == Footprint::Kind::header;
        add_at(row, all[k], is_header ? x + designator_beside : x, is_header ? 90.0 : 270.0);
        x += width_in_row(all[k]);
      }
      rows_.push_back(std::move(row));
    }
  }

  Board& board_;
  const BoardFootprints& parts_;
  std::vector<BoardUnit> units_;
  std::vector<UnitGroup> groups_;
  std::vector<std::size_t> loose_;              // test points of nets without a row
  std::map<std::size_t, std::size_t> columns_;  // by nets
  std::size_t slots_ = 0;                       // in a row
  double left_ = board_margin;                  // where they begin
  std::vector<BoardRow> rows_;
};

}  // namespace

std::vector<BoardRow> place_in_rows(Board& board, const BoardFootprints& parts) {
  return Placement(board, parts).rows();
}

void add_labels(Board& board, const std::vector<BoardRow>& rows, const std::string& title) {
  board.texts.push_back({title, 0.5 * board.width, 0.6 * title_room});
  for (const BoardRow& row : rows) {
    if (row.parts.empty()) continue;
    const double y = board.footprints[row.parts.front()].y;
    if (!row.name.empty()) board.texts.push_back({row.name, 0.7 * board_margin, y});
    for (const auto& [x, name] : row.columns)
      board.texts.push_back({name, x, row.top + 0.5 * column_label_room, 90.0});
  }
}

}  // namespace tactile_net
