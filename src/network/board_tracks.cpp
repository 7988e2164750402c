#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "network/board_rows.hpp"
#include "network/board_rules.hpp"

namespace tactile_net {
namespace {

// In millimetres.
using board_rules::supply_track;
constexpr double track_width = board_rules::track;
constexpr double via_size = board_rules::via;

constexpr double track_raster = 0.45;      // a via beside a track
constexpr double via_beside_track = 0.45;  // holes of one net are hole_to_hole apart
static_assert(0.5 * (via_size + track_width) + board_rules::clearance <= track_raster);
static_assert(board_rules::via_drill + board_rules::hole_to_hole <= via_beside_track + 1e-9);
constexpr double via_beside_via = via_size + board_rules::clearance + 0.003;
constexpr double hole_beside_track = 1.06;  // of a pin's pad of 1.7
constexpr double first_track = 0.21;        // beyond the parts
constexpr double after_tracks = 0.3;
constexpr double wider = 0.5 * (supply_track - track_width);
constexpr double via_of_supply = 0.3;  // of four, from the middle of where two wide tracks meet
constexpr double from_edge = 6.0;

/// Where a pad meets its channel.
struct Outlet {
  std::size_t net = 0;
  double x = 0.0;
  double y = 0.0;          // of the pad, from the row's middle
  double half_more = 0.0;  // of a wide track
};

/// A net in a channel.
struct ChannelRun {
  std::size_t net = 0;
  std::vector<Outlet> outlets{};
  std::vector<std::size_t> hops{};  // of each outlet the row of its via, from 1; 0: it needs none
  std::vector<double> trunks{};     // x of its tracks along y
  double low = 0.0, high = 0.0;     // along x
  std::size_t depth = 0;            // 0: the nearest to the parts
  double half_more = 0.0;
  double y = 0.0;

  /// A wide way to a pad is straight: its run is the nearest to the parts, where no other is
  /// crossed.
  [[nodiscard]] bool comes_first() const {
    return std::any_of(outlets.begin(), outlets.end(),
                       [](const Outlet& one) { return one.half_more > 0.0; });
  }
};

struct TrackChannel {
  std::vector<ChannelRun> runs{};
  std::size_t hop_rows = 0;
  std::size_t depths = 0;
  bool wide = false;
  bool wide_first = false;  // the others are beyond it

  /// From the parts' edge to the track of that row.
  [[nodiscard]] static double reach(std::size_t row) {
    return first_track + track_raster * static_cast<double>(row);
  }
  [[nodiscard]] double reach(const ChannelRun& run) const {
    const bool beyond = wide_first && run.depth > 0;
    return reach(hop_rows + run.depth) + run.half_more + (beyond ? 2.0 * wider : 0.0);
  }
  [[nodiscard]] double height() const {
    if (runs.empty()) return 0.5 * after_tracks;
    return reach(hop_rows + depths - 1) + after_tracks + (wide ? 2.0 * wider : 0.0);
  }
};

/// What a row's pads keep tracks of the bottom layer from.
struct BlockedX {
  double x = 0.0;
  double margin = 0.0;
};

/// A net's track along y, from channel to channel.
struct Trunk {
  std::size_t net = 0;
  std::size_t first = 0, last = 0;
  double x = 0.0;
  double half_more = 0.0;
  double from_y = 0.0, to_y = 0.0;
};

/// Runs that cross nothing, or as little as may be, the nearest to the parts first.
class ChannelOrder {
 public:
  explicit ChannelOrder(TrackChannel& channel) : runs_(channel.runs), left_(runs_.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    std::vector<std::size_t> covers(runs_.size(), 0);
    for (std::size_t a = 0; a < runs_.size(); ++a)
      for (const ChannelRun& run : runs_) covers[a] += stubs_covered(runs_[a], run);
    while (!left_.empty()) {
      const auto next = std::min_element(left_.begin(), left_.end(), [&](auto a, auto b) {
        const auto key = [&](std::size_t k) {
          const ChannelRun& run = runs_[k];
          return std::tuple(run.comes_first() ? -1.0 : run.half_more, covers[k],
                            run.high - run.low);
        };
        return key(a) < key(b);
      });
      const std::size_t chosen = *next;
      left_.erase(next);
      for (const std::size_t other : left_)
        covers[other] -= stubs_covered(runs_[other], runs_[chosen]);
      place(runs_[chosen]);
      channel.depths = std::max(channel.depths, runs_[chosen].depth + 1);
      channel.wide = channel.wide || runs_[chosen].half_more > 0.0;
      channel.wide_first = channel.wide_first || runs_[chosen].comes_first();
    }
    channel.hop_rows = hop_rows_;
  }

 private:
  static bool covers(const ChannelRun& run, const Outlet& one) {
    const double margin = via_beside_track + run.half_more + one.half_more;
    return one.x > run.low - margin && one.x < run.high + margin;
  }
  [[nodiscard]] static std::size_t stubs_covered(const ChannelRun& run, const ChannelRun& other) {
    if (&run == &other) return 0;
    return static_cast<std::size_t>(
        std::count_if(other.outlets.begin(), other.outlets.end(),
                      [&](const Outlet& one) { return covers(run, one); }));
  }
  static bool overlap(const ChannelRun& a, const ChannelRun& b) {
    return a.low - via_beside_via < b.high && b.low - via_beside_via < a.high;
  }

  void place(ChannelRun& run) {
    std::size_t least = 0;
    for (const ChannelRun* const one : placed_)
      if (run.half_more > 0.0 || one->half_more > 0.0 || stubs_covered(run, *one) > 0)
        least = std::max(least, one->depth + 1);
    for (run.depth = least;; ++run.depth)
      if (std::none_of(placed_.begin(), placed_.end(), [&](const ChannelRun* one) {
            return one->depth == run.depth && overlap(*one, run);
          }))
        break;
    run.hops.assign(run.outlets.size(), 0);
    for (std::size_t k = 0; k < run.outlets.size(); ++k)
      for (const ChannelRun* const one : placed_)
        if (one->depth < run.depth && covers(*one, run.outlets[k])) {
          run.hops[k] = hop_at(run.outlets[k].x);
          break;
        }
    placed_.push_back(&run);
  }

  /// A row in which a via is clear of the others.
  std::size_t hop_at(double x) {
    for (std::size_t row = 1;; ++row)
      if (std::none_of(hops_.begin(), hops_.end(), [&](const auto& one) {
            return one.first == row && std::abs(one.second - x) < via_beside_via;
          })) {
        hops_.emplace_back(row, x);
        hop_rows_ = std::max(hop_rows_, row);
        return row;
      }
  }

  std::vector<ChannelRun>& runs_;
  std::vector<std::size_t> left_;
  std::vector<const ChannelRun*> placed_;
  std::vector<std::pair<std::size_t, double>> hops_;
  std::size_t hop_rows_ = 0;
};

class Tracks {
 public:
  Tracks(Board& board, std::vector<BoardRow>& rows, const BoardFootprints& parts)
      : board_(board), rows_(rows), parts_(parts) {}

  void lay() {
    holes_.resize(rows_.size());
    blocked_.resize(2 * rows_.size());
    pads_.resize(rows_.size());
    above_.resize(rows_.size());
    below_.resize(rows_.size());
    channels_.resize(2 * rows_.size());
    outlets_.resize(channels_.size());
    for (std::size_t row = 0; row < rows_.size(); ++row) collect(row);
    join_neighbours();
    place_trunks();
    for (TrackChannel& channel : channels_) ChannelOrder{channel};
    double y = 0.0;
    std::vector<double> middles(rows_.size());
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      rows_[row].top = y;
      y += rows_[row].room_above + channels_[2 * row].height() + above_[row];
      middles[row] = y;
      y += below_[row] + channels_[2 * row + 1].height() + rows_[row].room_below;
      rows_[row].bottom = y;
    }
    board_.height = y;
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const std::size_t part : rows_[row].parts) board_.footprints[part].y = middles[row];
    for (const LocalTrack& one : local_) {
      const double at = middles[one.row];
      track(one.net, false, one.from_x, at + one.from_y, one.to_x, at + one.to_y, one.width);
      if (one.via) board_.vias.push_back({one.net, one.to_x, at + one.to_y});
    }
    for (std::size_t c = 0; c < channels_.size(); ++c) draw(c, middles[c / 2]);
    for (const Trunk& one : trunks_)
      track(one.net, true, one.x, one.from_y, one.x, one.to_y, track_width + 2.0 * one.half_more);
  }

 private:
  [[nodiscard]] double half_more(std::size_t net) const {
    return net == parts_.negative ? wider : 0.0;
  }
  [[nodiscard]] bool is_plane(std::size_t net) const {
    return net == parts_.ground || net == parts_.positive;
  }

  void track(std::size_t net, bool back, double from_x, double from_y, double to_x, double to_y,
             double width) {
    if (from_x == to_x && from_y == to_y) return;
    board_.tracks.push_back({net, back, from_x, from_y, to_x, to_y, width});
  }

  void collect(std::size_t row) {
    for (const std::size_t index : rows_[row].parts) {
      const Footprint& part = board_.footprints[index];
      const double half = half_size(part).second;
      above_[row] = std::max(above_[row], half);
      below_[row] = std::max(below_[row], half);
      std::vector<BoardPad> left;
      std::vector<BoardPad> right;
      double lowest = 0.0;
      for (const BoardPad& own : part.pads) {
        const BoardPad pad = turned(own, part.angle);
        lowest = std::max(lowest, pad.y);
        const double x = part.x + pad.x;
        pads_[row].push_back(x);
        if (pad.drilled) {
          holes_[row].push_back({x, hole_beside_track});
          if (pad.net != 0 && !is_plane(pad.net))
            add_outlet(row, pad.net, rows_[row].down, x, pad.y, half_more(pad.net));
          continue;
        }
        if (pad.net == 0) continue;
        if (std::abs(pad.x) > std::abs(pad.y) && pad.width > pad.height) {
          (pad.x < 0.0 ? left : right).push_back(pad);
          continue;
        }
        if (std::abs(pad.y) < 1e-9 && is_plane(pad.net)) {  // below the part
          holes_[row].push_back({x, via_beside_track});
          local_.push_back({row, pad.net, x, pad.y, x, pad.y, track_width, true});
          continue;
        }
        const bool down = std::abs(pad.y) < 1e-9 ? rows_[row].down : pad.y > 0.0;
        reach_out(row, pad.net, down, x, pad.y, std::abs(pad.y) + 0.5 * pad.height, pad.width);
      }
      for (const std::vector<BoardPad>& side : {left, right}) join_side(row, part.x, side, lowest);
    }
  }

  void add_outlet(std::size_t row, std::size_t net, bool down, double x, double y,
                  double wide = 0.0) {
    outlets_[2 * row + (down ? 1 : 0)][net].push_back({net, x, y, wide});
  }

  /// To a plane by a via outside of the pad, to others by the channel.
  void reach_out(std::size_t row, std::size_t net, bool down, double x, double y, double edge,
                 double width) {
    if (!is_plane(net)) {
      add_outlet(row, net, down, x, y);
      return;
    }
    holes_[row].push_back({x, via_beside_track});
    blocked_[2 * row + (down ? 1 : 0)].push_back(x);
    const double via = edge + 0.1 + 0.5 * via_size;
    local_.push_back(
        {row, net, x, y, x, down ? via : -via, std::min(board_rules::wide_track, width), true});
    double& reach = down ? below_[row] : above_[row];
    reach = std::max(reach, via + 0.5 * via_size);
  }

  /// Pads at a part's side are of one net: a track joins them, and leaves below the part.
  void join_side(std::size_t row, double at, const std::vector<BoardPad>& side, double lowest) {
    if (side.empty()) return;
    const auto [first, last] = std::minmax_element(
        side.begin(), side.end(), [](const BoardPad& a, const BoardPad& b) { return a.y < b.y; });
    for (const BoardPad& pad : side)
      if (pad.net != first->net)
        throw std::invalid_argument(
            "two nets at one side of a package: its board is not laid; take a part in SO-8");
    const double x = at + first->x;
    if (last->y > first->y)
      local_.push_back({row, first->net, x, first->y, x, last->y, track_width, false});
    reach_out(row, first->net, true, x, last->y, lowest, track_width);
  }

  /// Two pads that face each other between two parts are joined there.
  void join_neighbours() {
    std::map<std::size_t, std::size_t> count;
    for (const auto& nets : outlets_)
      for (const auto& [net, outlets] : nets) count[net] += outlets.size();
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      auto& up = outlets_[2 * row];
      auto& down = outlets_[2 * row + 1];
      for (auto from = down.begin(); from != down.end();) {
        const auto to = up.find(from->first);
        const Outlet* const a = &from->second.front();
        if (count[from->first] != 2 || to == up.end() || !is_between(row, *a, to->second.front())) {
          ++from;
          continue;
        }
        const Outlet& b = to->second.front();
        local_.push_back({row, a->net, a->x, a->y, b.x, b.y, track_width, false});
        up.erase(to);
        from = down.erase(from);
      }
    }
  }
  [[nodiscard]] bool is_between(std::size_t row, const Outlet& a, const Outlet& b) const {
    return b.x > a.x && std::none_of(pads_[row].begin(), pads_[row].end(),
                                     [&](double x) { return x > a.x + 1e-9 && x < b.x - 1e-9; });
  }

  /// Of every net a track along y in each section that it has several channels in, where its pads
  /// are nearest and nothing else is. Sections share a channel, in which tracks meet.
  void place_trunks() {
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> ends;  // channels, by nets
    for (std::size_t c = 0; c < outlets_.size(); ++c)
      for (const auto& [net, outlets] : outlets_[c])
        ends.try_emplace(net, c, c).first->second.second = c;
    std::vector<std::size_t> borders = {0};
    for (std::size_t row = 1; row < rows_.size(); ++row)
      if (rows_[row].begins_section) borders.push_back(2 * row);
    borders.push_back(outlets_.size() - 1);
    std::vector<Trunk> wanted;
    for (const auto& [net, range] : ends)
      for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
        Trunk one{.net = net, .half_more = half_more(net)};
        one.first = std::max(range.first, borders[k]);
        one.last = std::min(range.second, borders[k + 1]);
        if (one.first < one.last) wanted.push_back(one);
      }
    // The wide ones first, which need the most room to be near to what they feed.
    std::stable_sort(wanted.begin(), wanted.end(), [](const Trunk& a, const Trunk& b) {
      return std::pair(a.half_more, a.last - a.first) > std::pair(b.half_more, b.last - b.first);
    });
    for (std::size_t c = 0; c < outlets_.size(); ++c) {
      for (const auto& [net, outlets] : outlets_[c])
        for (const Outlet& one : outlets)
          for (const double side : {-one.half_more, 0.0, one.half_more})
            blocked_[c].push_back(one.x + side);
      std::sort(blocked_[c].begin(), blocked_[c].end());
    }
    for (std::vector<BlockedX>& row : holes_)
      std::sort(row.begin(), row.end(),
                [](const BlockedX& a, const BlockedX& b) { return a.x < b.x; });
    for (Trunk& one : wanted) {
      std::vector<double> near = ends_of(one.net, one.first, one.last);
      if (near.size() <= 2) near = ends_of(one.net, 0, outlets_.size() - 1);
      // On from where the next section has it, or where it is nearest to its pads.
      const auto next = std::find_if(trunks_.begin(), trunks_.end(), [&](const Trunk& other) {
        return other.net == one.net && other.first <= one.last && one.first <= other.last;
      });
      if (next != trunks_.end()) one.x = next->x;
      if (next != trunks_.end() && is_free(one)) {
        next->first = std::min(next->first, one.first);
        next->last = std::max(next->last, one.last);
        continue;
      }
      place(one, near[near.size() / 2]);
      trunks_.push_back(one);
    }
    std::map<std::pair<std::size_t, std::size_t>, ChannelRun> runs;  // by channels and nets
    for (std::size_t c = 0; c < outlets_.size(); ++c)
      for (auto& [net, outlets] : outlets_[c]) runs[{c, net}].outlets = std::move(outlets);
    for (const Trunk& one : trunks_)
      for (const std::size_t border : {one.first, one.last}) (void)runs[{border, one.net}];
    for (auto& [key, run] : runs) {
      const auto& [c, net] = key;
      run.net = net;
      run.half_more = half_more(net);
      std::vector<double> all;
      for (const Outlet& one : run.outlets) all.push_back(one.x);
      for (const Trunk& one : trunks_)
        if (one.net == net && one.first <= c && c <= one.last) run.trunks.push_back(one.x);
      all.insert(all.end(), run.trunks.begin(), run.trunks.end());
      if (all.size() < 2) continue;
      std::sort(all.begin(), all.end());
      run.low = all.front();
      run.high = all.back();
      channels_[c].runs.push_back(std::move(run));
    }
  }

  void place(Trunk& trunk, double wanted) {
    constexpr double step = 0.05;
    for (int k = 0;; ++k) {
      // To the right and to the left in turn; to the right there is always room.
      const int steps = k % 2 == 0 ? k / 2 : -(k + 1) / 2;
      trunk.x = std::round(wanted / step) * step + step * steps;
      if (trunk.x >= from_edge && is_free(trunk)) break;
    }
    board_.width = std::max(board_.width, trunk.x + from_edge);
  }

  /// Where its pads begin and end in each of these channels, in order: within the middle two a
  /// track is nearest to all.
  [[nodiscard]] std::vector<double> ends_of(std::size_t net, std::size_t first,
                                            std::size_t last) const {
    std::vector<double> all;
    for (std::size_t c = first; c <= last; ++c)
      if (const auto own = outlets_[c].find(net); own != outlets_[c].end()) {
        const auto [low, high] = range_of(own->second);
        all.insert(all.end(), {low, high});
      }
    std::sort(all.begin(), all.end());
    return all;
  }
  static std::pair<double, double> range_of(const std::vector<Outlet>& outlets) {
    const auto [low, high] = std::minmax_element(
        outlets.begin(), outlets.end(), [](const Outlet& a, const Outlet& b) { return a.x < b.x; });
    return {low->x, high->x};
  }

  [[nodiscard]] bool is_free(const Trunk& trunk) const {
    for (const Trunk& other : trunks_)
      if (other.first <= trunk.last && trunk.first <= other.last &&
          !(other.net == trunk.net && other.x == trunk.x) &&
          std::abs(other.x - trunk.x) < track_raster + other.half_more + trunk.half_more - 1e-9)
        return false;
    const double pads = via_beside_track + trunk.half_more - 1e-9;
    for (std::size_t c = trunk.first; c <= trunk.last; ++c) {
      const auto one = std::upper_bound(blocked_[c].begin(), blocked_[c].end(), trunk.x - pads);
      if (one != blocked_[c].end() && *one < trunk.x + pads) return false;
      if (c % 2 == 1 || c == trunk.last) continue;  // the row below this channel is passed
      const std::vector<BlockedX>& all = holes_[c / 2];
      constexpr double farthest = hole_beside_track + wider;
      auto hole = std::lower_bound(all.begin(), all.end(), trunk.x - farthest,
                                   [](const BlockedX& a, double x) { return a.x < x; });
      for (; hole != all.end() && hole->x < trunk.x + farthest; ++hole)
        if (std::abs(hole->x - trunk.x) < hole->margin + trunk.half_more - 1e-9) return false;
    }
    return true;
  }

  void draw(std::size_t c, double middle) {
    TrackChannel& channel = channels_[c];
    const double away = c % 2 == 0 ? -1.0 : 1.0;
    const double edge = middle + away * (c % 2 == 0 ? above_ : below_)[c / 2];
    for (ChannelRun& run : channel.runs) {
      const double y = run.y = edge + away * channel.reach(run);
      draw_along(run, c);
      for (const double x : run.trunks) add_vias(run, x, y);
      for (Trunk& one : trunks_) {
        if (one.net != run.net) continue;
        if (one.first == c) one.from_y = y;
        if (one.last == c) one.to_y = y;
      }
      for (std::size_t k = 0; k < run.outlets.size(); ++k) {
        const Outlet& one = run.outlets[k];
        const std::size_t hop = run.hops[k];
        const double to = hop == 0 ? y : edge + away * TrackChannel::reach(hop - 1);
        const double width = track_width + 2.0 * one.half_more;
        track(run.net, false, one.x, middle + one.y, one.x, to, width);
        if (hop == 0) continue;
        board_.vias.push_back({run.net, one.x, to});
        board_.vias.push_back({run.net, one.x, y});
        track(run.net, true, one.x, to, one.x, y, width);
      }
    }
  }

  void add_vias(const ChannelRun& run, double x, double y) {
    if (run.half_more == 0.0) {
      board_.vias.push_back({run.net, x, y});
      return;
    }
    for (const double right : {-via_of_supply, via_of_supply})
      for (const double down : {-via_of_supply, via_of_supply})
        board_.vias.push_back({run.net, x + right, y + down});
  }

  /// Between two rows both channels have the supply's run furthest from their parts, side by side:
  /// one piece of copper, so that a capacitor is as near to its amplifier as may be.
  /// @return  the run that this channel's shares it with; null: none
  [[nodiscard]] const ChannelRun* run_beside(std::size_t c) const {
    const std::size_t other = c % 2 == 1 ? c + 1 : c - 1;
    if (c == 0 || other >= channels_.size()) return nullptr;
    for (const ChannelRun& one : channels_[other].runs)
      if (one.net == parts_.negative) return &one;
    return nullptr;
  }

  /// Along its channel, or as a bus between two rows once both have their places.
  void draw_along(const ChannelRun& run, std::size_t c) {
    const ChannelRun* const beside = run.net == parts_.negative ? run_beside(c) : nullptr;
    if (beside == nullptr) {
      track(run.net, false, run.low, run.y, run.high, run.y, track_width + 2.0 * run.half_more);
    } else if (c % 2 == 0) {
      const double middle = 0.5 * (beside->y + run.y);
      track(run.net, false, std::min(beside->low, run.low), middle,
            std::max(beside->high, run.high), middle, run.y - beside->y + supply_track);
    }
  }

  /// Within a row, from its middle.
  struct LocalTrack {
    std::size_t row = 0, net = 0;
    double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0, width = 0.0;
    bool via = false;  // at its end
  };

  Board& board_;
  std::vector<BoardRow>& rows_;
  const BoardFootprints& parts_;
  std::vector<std::vector<double>> pads_;     // of rows, their x
  std::vector<std::vector<BlockedX>> holes_;  // of rows: vias and pins
  std::vector<std::vector<double>> blocked_;  // of channels, x of pads and vias beside them
  std::vector<double> above_, below_;         // of rows, how far they reach
  std::vector<std::map<std::size_t, std::vector<Outlet>>> outlets_;  // of channels, by nets
  std::vector<TrackChannel> channels_;                               // above and below each row
  std::vector<LocalTrack> local_;
  std::vector<Trunk> trunks_;
};

}  // namespace

BoardPad turned(const BoardPad& pad, double angle) noexcept {
  const auto quarters = static_cast<int>(std::lround(angle / 90.0)) % 4;
  BoardPad result = pad;
  for (int k = 0; k < quarters; ++k) {
    result.x = std::exchange(result.y, -result.x);
    std::swap(result.width, result.height);
  }
  return result;
}

std::pair<double, double> half_size(const Footprint& part) noexcept {
  const bool upright = std::lround(part.angle / 90.0) % 2 != 0;
  return {0.5 * (upright ? part.height : part.width), 0.5 * (upright ? part.width : part.height)};
}

void lay_tracks(Board& board, std::vector<BoardRow>& rows, const BoardFootprints& parts) {
  Tracks(board, rows, parts).lay();
}

}  // namespace tactile_net
