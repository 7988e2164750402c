/// @file
/// What a laid board must keep to, by its geometry alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tactile_net/network/laid_board.hpp"

namespace tactile_net::board_laws {

/// A rectangle along x and y, its corners rounded by `round`: a pad has none, a track is a line
/// with half its width, a via a point.
struct Copper {
  std::size_t net = 0;
  std::vector<bool> on{};  // layers
  double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;
  double round = 0.0;
  bool is_pad = false;
  bool to_planes = false;  // goes through all layers
  double hole = 0.0;
  std::string name{};

  [[nodiscard]] double left() const { return std::min(from_x, to_x) - round; }
  [[nodiscard]] double right() const { return std::max(from_x, to_x) + round; }
  [[nodiscard]] double top() const { return std::min(from_y, to_y) - round; }
  [[nodiscard]] double bottom() const { return std::max(from_y, to_y) + round; }
};

inline std::vector<Copper> copper_of(const LaidBoard& board) {
  std::vector<Copper> all;
  const std::vector<bool> everywhere(board.layers.size(), true);
  for (const LaidBoard::Part& part : board.parts)
    for (const LaidBoard::Pad& pad : part.pads) {
      const bool upright = std::abs(std::sin(pad.angle * std::numbers::pi / 180.0)) > 0.5;
      const double w = 0.5 * (upright ? pad.height : pad.width);
      const double h = 0.5 * (upright ? pad.width : pad.height);
      all.push_back({.net = pad.net,
                     .on = pad.on,
                     .from_x = pad.x - w,
                     .from_y = pad.y - h,
                     .to_x = pad.x + w,
                     .to_y = pad.y + h,
                     .is_pad = true,
                     .to_planes = pad.hole > 0.0,
                     .hole = pad.hole,
                     .name = part.reference + '.' + pad.name});
    }
  for (const LaidBoard::Track& track : board.tracks) {
    Copper one{
        .net = track.net,
        .on = std::vector<bool>(board.layers.size()),
        .from_x = track.from_x,
        .from_y = track.from_y,
        .to_x = track.to_x,
        .to_y = track.to_y,
        .round = 0.5 * track.width,
        .name = "track at " + std::to_string(track.from_x) + ' ' + std::to_string(track.from_y)};
    one.on[track.layer] = true;
    all.push_back(std::move(one));
  }
  for (const LaidBoard::Via& via : board.vias)
    all.push_back({.net = via.net,
                   .on = everywhere,
                   .from_x = via.x,
                   .from_y = via.y,
                   .to_x = via.x,
                   .to_y = via.y,
                   .round = 0.5 * via.size,
                   .to_planes = true,
                   .hole = 0.2,
                   .name = "via at " + std::to_string(via.x) + ' ' + std::to_string(via.y)});
  std::sort(all.begin(), all.end(),
            [](const Copper& a, const Copper& b) { return a.left() < b.left(); });
  return all;
}

/// Of a line, or of a pad an edge or its diagonal, in so many points.
inline double point_to(const Copper& one, double x, double y) {
  if (one.is_pad)
    return std::hypot(std::max({one.from_x - x, x - one.to_x, 0.0}),
                      std::max({one.from_y - y, y - one.to_y, 0.0}));
  const double dx = one.to_x - one.from_x;
  const double dy = one.to_y - one.from_y;
  const double square = dx * dx + dy * dy;
  const double t =
      square > 0.0 ? std::clamp(((x - one.from_x) * dx + (y - one.from_y) * dy) / square, 0.0, 1.0)
                   : 0.0;
  return std::hypot(x - one.from_x - t * dx, y - one.from_y - t * dy);
}

/// Between two convex shapes, by ternary search along the second's line: both distances are convex.
inline double distance(const Copper& a, const Copper& b) {
  if (a.is_pad && b.is_pad)
    return std::hypot(std::max({a.left() - b.right(), b.left() - a.right(), 0.0}),
                      std::max({a.top() - b.bottom(), b.top() - a.bottom(), 0.0}));
  const Copper& shape = b.is_pad ? b : a;
  const Copper& line = b.is_pad ? a : b;
  double low = 0.0;
  double high = 1.0;
  const auto at = [&](double t) {
    return point_to(shape, line.from_x + t * (line.to_x - line.from_x),
                    line.from_y + t * (line.to_y - line.from_y));
  };
  for (int k = 0; k < 80; ++k) {
    const double first = low + (high - low) / 3.0;
    const double second = high - (high - low) / 3.0;
    (at(first) <= at(second) ? high : low) = at(first) <= at(second) ? second : first;
  }
  return std::max(at(0.5 * (low + high)) - a.round - b.round, 0.0);
}

/// Nets whose pads are not all joined by copper that touches, or by the plane of their net.
inline std::set<std::string> nets_apart(const LaidBoard& board) {
  const std::vector<Copper> all = copper_of(board);
  std::vector<std::size_t> parent(all.size());
  for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = k;
  const auto root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::map<std::size_t, std::size_t> plane;  // of GND and VCC, by their nets
  for (std::size_t a = 0; a < all.size(); ++a) {
    const std::string& name = board.nets[all[a].net];
    if (all[a].to_planes && (name == "GND" || name == "VCC"))
      parent[root(a)] = root(plane.try_emplace(all[a].net, a).first->second);
    for (std::size_t b = a + 1; b < all.size() && all[b].left() <= all[a].right(); ++b) {
      if (all[a].net != all[b].net || root(a) == root(b)) continue;
      bool share = false;
      for (std::size_t layer = 0; layer < all[a].on.size(); ++layer)
        share = share || (all[a].on[layer] && all[b].on[layer]);
      if (share && distance(all[a], all[b]) < 1e-6) parent[root(a)] = root(b);
    }
  }
  std::map<std::size_t, std::size_t> first;
  std::set<std::string> apart;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].is_pad && all[k].net != 0 &&
        root(k) != root(first.try_emplace(all[k].net, k).first->second))
      apart.insert(board.nets[all[k].net]);
  return apart;
}

/// Copper of two nets that is nearer than 0.127 mm, and holes nearer than 0.25 mm.
inline std::vector<std::string> too_near(const LaidBoard& board) {
  constexpr double clearance = 0.127;
  constexpr double between_holes = 0.25;
  const std::vector<Copper> all = copper_of(board);
  std::vector<std::string> found;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size() && all[b].left() < all[a].right() + 0.3; ++b) {
      if (all[a].top() > all[b].bottom() + 0.3 || all[b].top() > all[a].bottom() + 0.3) continue;
      const auto middle = [](double low, double high) { return 0.5 * (low + high); };
      if (all[a].hole > 0.0 && all[b].hole > 0.0 &&
          std::hypot(
              middle(all[a].left(), all[a].right()) - middle(all[b].left(), all[b].right()),
              middle(all[a].top(), all[a].bottom()) - middle(all[b].top(), all[b].bottom())) -
                  0.5 * (all[a].hole + all[b].hole) <
              between_holes - 1e-6)
        found.push_back(all[a].name + " and " + all[b].name + ": holes");
      if (all[a].net == all[b].net && all[a].net != 0) continue;
      bool share = false;
      for (std::size_t layer = 0; layer < all[a].on.size(); ++layer)
        share = share || (all[a].on[layer] && all[b].on[layer]);
      // Pads of one part are as its maker has them.
      if (!share || (all[a].is_pad && all[b].is_pad)) continue;
      if (distance(all[a], all[b]) < clearance - 1e-6)
        found.push_back(all[a].name + " (" + board.nets[all[a].net] + ") and " + all[b].name +
                        " (" + board.nets[all[b].net] + ')');
    }
  return found;
}

}  // namespace tactile_net::board_laws
