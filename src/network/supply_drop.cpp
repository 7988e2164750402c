#include "tactile_net/network/supply_drop.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "network/copper_shapes.hpp"
#include "numeric/sparse_elimination.hpp"

namespace tactile_net {
namespace {

constexpr double copper_resistivity = 1.72e-8;  // [ohm m]
constexpr double hole_plating = 0.02;           // copper on a hole's wall [mm]

/// A net's copper as resistors between points, where its tracks meet something.
class SupplyNet {
 public:
  SupplyNet(const LaidBoard& board, std::size_t net) : board_(board) {
    for (const LaidBoard::Track& one : board.tracks)
      if (one.net == net) tracks_.push_back({&one, {}});
    for (const LaidBoard::Part& part : board.parts)
      for (const LaidBoard::Pad& pad : part.pads)
        if (pad.net == net) add(part, pad);
    for (const LaidBoard::Via& via : board.vias)
      if (via.net == net) add(via);
    join_tracks();
    for (MetTrack& one : tracks_) link(one);
  }

  [[nodiscard]] std::optional<SupplyDrop> drop() {
    if (supply_.empty() || taking_.empty()) return std::nullopt;
    for (const std::size_t one : supply_) join(one, supply_.front());
    const std::size_t held = root(supply_.front());
    if (!reaches_all(held)) return std::nullopt;
    // The header's pins hold their voltage: all other points that hang on them are unknown.
    std::map<std::size_t, Eigen::Index> unknown;
    for (const Link& one : links_)
      for (const std::size_t end : {root(one.from), root(one.to)})
        if (end != held && islands_[end] == islands_[held])
          unknown.try_emplace(end, static_cast<Eigen::Index>(unknown.size()));
    const auto count = static_cast<Eigen::Index>(unknown.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (const Link& one : links_) {
      const auto a = unknown.find(root(one.from));
      const auto b = unknown.find(root(one.to));
      for (const auto end : {a, b})
        if (end != unknown.end()) entries.emplace_back(end->second, end->second, one.siemens);
      if (a == unknown.end() || b == unknown.end()) continue;
      entries.emplace_back(a->second, b->second, -one.siemens);
      entries.emplace_back(b->second, a->second, -one.siemens);
    }
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(count);
    for (const auto& [name, points] : taking_)
      for (const std::size_t one : points)
        if (const auto at = unknown.find(root(one)); at != unknown.end())
          taken(at->second) += 1.0 / static_cast<double>(points.size());
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const SparseLdl solver(matrix);
    if (!solver.regular()) return std::nullopt;
    const Eigen::VectorXd fall = solver.solve(taken);
    SupplyDrop result{.amplifiers = taking_.size()};
    for (const auto& [name, points] : taking_)
      for (const std::size_t one : points) {
        const auto at = unknown.find(root(one));
        if (at == unknown.end() || fall(at->second) <= result.ohm) continue;
        result.ohm = fall(at->second);
        result.amplifier = name;
      }
    return result;
  }

 private:
  struct MetTrack {
    const LaidBoard::Track* own = nullptr;
    std::vector<std::pair<double, std::size_t>> met;  // how far along it, which point
  };
  struct Link {
    std::size_t from = 0, to = 0;
    double siemens = 0.0;
  };

  std::size_t point() {
    parent_.push_back(parent_.size());
    return parent_.size() - 1;
  }
  std::size_t root(std::size_t one) {
    while (parent_[one] != one) one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

  void add(const LaidBoard::Part& part, const LaidBoard::Pad& pad) {
    const std::size_t own = point();
    if (part.element == "supply") supply_.push_back(own);
    if (part.element.starts_with('X')) taking_[part.element].push_back(own);
    for (MetTrack& track : tracks_) {
      const LaidBoard::Track& t = *track.own;
      if (!pad.on[t.layer]) continue;
      if (is_in(pad, t.from_x, t.from_y)) track.met.emplace_back(0.0, own);
      if (is_in(pad, t.to_x, t.to_y)) track.met.emplace_back(length_of(t), own);
      if (is_on(t, pad.x, pad.y)) track.met.emplace_back(along(t, pad.x, pad.y), own);
    }
  }

  /// A point on each layer, with its barrel between them.
  void add(const LaidBoard::Via& via) {
    const std::size_t layers = board_.layers.size();
    const std::size_t first = point();
    for (std::size_t k = 1; k < layers; ++k) {
      const std::size_t next = point();
      const double barrel = std::numbers::pi * (via.hole + hole_plating) * hole_plating;
      const double length = board_.thickness / static_cast<double>(layers - 1);
      links_.push_back({next - 1, next, siemens(barrel, length)});
    }
    for (MetTrack& track : tracks_)
      if (is_on(*track.own, via.x, via.y))
        track.met.emplace_back(along(*track.own, via.x, via.y), first + track.own->layer);
  }

  /// Where one of two ends.
  void join_tracks() {
    for (MetTrack& one : tracks_) {
      const LaidBoard::Track& t = *one.own;
      for (MetTrack& other : tracks_) {
        if (&one == &other || other.own->layer != t.layer) continue;
        for (const bool last : {false, true}) {
          const double x = last ? t.to_x : t.from_x;
          const double y = last ? t.to_y : t.from_y;
          if (!is_on(*other.own, x, y)) continue;
          const std::size_t own = point();
          one.met.emplace_back(last ? length_of(t) : 0.0, own);
          other.met.emplace_back(along(*other.own, x, y), own);
        }
      }
    }
  }

  void link(MetTrack& track) {
    std::sort(track.met.begin(), track.met.end());
    const double section = track.own->width * board_.copper;
    for (std::size_t k = 1; k < track.met.size(); ++k) {
      const auto& [from, first] = track.met[k - 1];
      const auto& [to, second] = track.met[k];
      if (to - from > 1e-6)
        links_.push_back({first, second, siemens(section, to - from)});
      else
        join(first, second);
    }
  }

  /// @param section  in square millimetres, length in millimetres
  static double siemens(double section, double length) {
    return 1e-3 * section / (copper_resistivity * length);
  }

  /// Whether every op-amp hangs on the supply; sets the points' islands.
  bool reaches_all(std::size_t held) {
    islands_.resize(parent_.size());
    std::iota(islands_.begin(), islands_.end(), std::size_t{0});
    const auto island = [&](std::size_t one) {
      while (islands_[one] != one) one = islands_[one] = islands_[islands_[one]];
      return one;
    };
    for (const Link& one : links_) islands_[island(root(one.from))] = island(root(one.to));
    for (std::size_t one = 0; one < islands_.size(); ++one) islands_[one] = island(one);
    return std::all_of(taking_.begin(), taking_.end(), [&](const auto& one) {
      return std::all_of(one.second.begin(), one.second.end(),
                         [&](std::size_t pin) { return islands_[root(pin)] == islands_[held]; });
    });
  }

  const LaidBoard& board_;
  std::vector<MetTrack> tracks_;
  std::vector<std::size_t> parent_;   // of points, those that are one
  std::vector<std::size_t> islands_;  // of points, those that links join
  std::vector<Link> links_;
  std::vector<std::size_t> supply_;                           // its pins
  std::map<std::string, std::vector<std::size_t>> taking_{};  // op-amps' pins
};

}  // namespace

std::optional<SupplyDrop> supply_drop(const LaidBoard& board, const std::string& net) {
  const auto at = std::find(board.nets.begin(), board.nets.end(), net);
  if (at == board.nets.end() || !(board.copper > 0.0)) return std::nullopt;
  return SupplyNet(board, static_cast<std::size_t>(at - board.nets.begin())).drop();
}

}  // namespace tactile_net
