#include "tactile_net/network/copper_capacitance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "network/copper_shapes.hpp"

namespace tactile_net {
namespace {

constexpr double vacuum_permittivity = 8.8541878128e-12;  // [F/m]
constexpr double millimetre = 1e-3;
constexpr std::size_t most_of_a_net = 20'000;

/// The factor of a strip's impedance in air: Z = 60 ohm times it.
double air_factor(double u) {
  const double f = 6.0 + (2.0 * std::numbers::pi - 6.0) * std::exp(-std::pow(30.666 / u, 0.7528));
  return std::log(f / u + std::sqrt(1.0 + 4.0 / (u * u)));
}

/// What the air above takes off a permittivity.
double effective_permittivity(double u, double permittivity) {
  const double u4 = std::pow(u, 4.0);
  const double a = 1.0 + std::log((u4 + std::pow(u / 52.0, 2.0)) / (u4 + 0.432)) / 49.0 +
                   std::log1p(std::pow(u / 18.1, 3.0)) / 18.7;
  const double b = 0.564 * std::pow((permittivity - 0.9) / (permittivity + 3.0), 0.053);
  return 0.5 * (permittivity + 1.0) + 0.5 * (permittivity - 1.0) * std::pow(1.0 + 10.0 / u, -a * b);
}

/// An island of copper that is joined.
class Islands {
 public:
  explicit Islands(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t one) {
    while (parent_[one] != one) one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> parent_;
};

/// What a net is made of, for who joins it.
struct NetParts {
  std::vector<const LaidBoard::Pad*> pads{};
  std::vector<const LaidBoard::Track*> tracks{};
  std::vector<const LaidBoard::Via*> vias{};
};

/// The pads, then tracks, then vias.
Islands islands_of(const NetParts& net) {
  const std::size_t tracks = net.pads.size();
  const std::size_t vias = tracks + net.tracks.size();
  Islands islands(vias + net.vias.size());
  for (std::size_t t = 0; t < net.tracks.size(); ++t) {
    const LaidBoard::Track& track = *net.tracks[t];
    for (const auto& [x, y] :
         {std::pair(track.from_x, track.from_y), std::pair(track.to_x, track.to_y)}) {
      for (std::size_t p = 0; p < net.pads.size(); ++p)
        if (net.pads[p]->on[track.layer] && is_in(*net.pads[p], x, y)) islands.join(p, tracks + t);
      for (std::size_t other = 0; other < net.tracks.size(); ++other)
        if (other != t && net.tracks[other]->layer == track.layer &&
            is_on(*net.tracks[other], x, y))
          islands.join(tracks + other, tracks + t);
    }
  }
  for (std::size_t v = 0; v < net.vias.size(); ++v) {
    const LaidBoard::Via& via = *net.vias[v];
    for (std::size_t p = 0; p < net.pads.size(); ++p)
      if (is_in(*net.pads[p], via.x, via.y)) islands.join(p, vias + v);
    for (std::size_t t = 0; t < net.tracks.size(); ++t)
      if (is_on(*net.tracks[t], via.x, via.y)) islands.join(tracks + t, vias + v);
  }
  return islands;
}

/// The shortest tree, along x and y, of islands with a pad: Prim's.
double missing_length(const NetParts& net) {
  const std::size_t count = net.pads.size();
  if (count < 2) return 0.0;
  Islands islands = islands_of(net);
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  std::vector<bool> reached(count);
  distance[0] = 0.0;
  double length = 0.0;
  for (std::size_t step = 0; step < count; ++step) {
    std::size_t next = count;
    for (std::size_t p = 0; p < count; ++p)
      if (!reached[p] && (next == count || distance[p] < distance[next])) next = p;
    reached[next] = true;
    length += distance[next];
    for (std::size_t p = 0; p < count; ++p) {
      if (reached[p]) continue;
      const double apart = islands.of(p) == islands.of(next)
                               ? 0.0
                               : std::abs(net.pads[p]->x - net.pads[next]->x) +
                                     std::abs(net.pads[p]->y - net.pads[next]->y);
      distance[p] = std::min(distance[p], apart);
    }
  }
  return length;
}

class CopperOf {
 public:
  explicit CopperOf(const LaidBoard& board) : board_(board) {
    for (const LaidBoard::Layer& layer : board.layers)
      strips_.push_back({layer.to_plane * millimetre, layer.permittivity, board.copper * millimetre,
                         layer.inside});
  }

  [[nodiscard]] double of(const LaidBoard::Pad& pad) const {
    // An ellipse is the rectangle of its area.
    const double share = pad.round ? std::sqrt(0.25 * std::numbers::pi) : 1.0;
    double farad = 0.0;
    for (std::size_t k = 0; k < strips_.size(); ++k)
      if (pad.on[k] && (pad.hole == 0.0 || is_outer(k)))
        farad += strips_[k].plate_capacitance(share * pad.width * millimetre,
                                              share * pad.height * millimetre);
    return farad + (pad.hole > 0.0 ? hole(std::min(pad.width, pad.height)) : 0.0);
  }

  [[nodiscard]] double of(const LaidBoard::Via& via) const { return hole(via.size); }

  [[nodiscard]] double of(const LaidBoard::Track& track) const {
    return length_of(track) * millimetre *
           strips_[track.layer].capacitance(track.width * millimetre);
  }

  [[nodiscard]] double of(const LaidBoard::Area& area) const {
    const Microstrip& strip = strips_[area.layer];
    const double width = 100.0 * strip.height;  // that of a wide one's edge
    return vacuum_permittivity * strip.permittivity * area.square_millimetres * millimetre *
               millimetre / strip.height +
           area.edge * millimetre * strip.edge_capacitance(width);
  }

  /// Of tracks that are missing, on the outer layer that has the more.
  [[nodiscard]] double of_missing(double length) const {
    return length * millimetre *
           std::max(strips_.front().capacitance(usual_width * millimetre),
                    strips_.back().capacitance(usual_width * millimetre));
  }

 private:
  [[nodiscard]] bool is_outer(std::size_t k) const { return k == 0 || k + 1 == strips_.size(); }
  [[nodiscard]] double hole(double pad) const {
    if (!board_.has_planes || !(pad > 0.0)) return 0.0;
    return hole_capacitance(pad * millimetre, board_.clearance * millimetre,
                            board_.thickness * millimetre, board_.layers.front().permittivity);
  }

  const LaidBoard& board_;
  std::vector<Microstrip> strips_;  // of layers
};

}  // namespace

double Microstrip::capacitance(double width) const {
  const double u = width / height;
  double in_air = u;
  double in_both = u;
  if (thickness > 0.0) {
    const double t = thickness / height;
    const double coth = 1.0 / std::tanh(std::sqrt(6.517 * u));
    const double wider =
        t / std::numbers::pi * std::log1p(4.0 * std::numbers::e / (t * coth * coth));
    in_air += wider;
    in_both += 0.5 * wider * (1.0 + 1.0 / std::cosh(std::sqrt(permittivity - 1.0)));
  }
  // sqrt(eps_eff) / (c Z), of Z = 60 air_factor(in_both) / sqrt(eps) and eps_eff = eps
  // (air_factor(in_air) / air_factor(in_both))^2; 60 ohm c = 1 / (2 std::numbers::pi eps_0).
  const double eps = covered ? permittivity : effective_permittivity(in_both, permittivity);
  const double both = air_factor(in_both);
  return 2.0 * std::numbers::pi * vacuum_permittivity * eps * air_factor(in_air) / (both * both);
}

double Microstrip::edge_capacitance(double width) const {
  return 0.5 *
         std::max(capacitance(width) - vacuum_permittivity * permittivity * width / height, 0.0);
}

double Microstrip::plate_capacitance(double width, double length) const {
  if (!(width > 0.0) || !(length > 0.0)) return 0.0;
  return vacuum_permittivity * permittivity * width * length / height +
         2.0 * (length * edge_capacitance(width) + width * edge_capacitance(length));
}

double hole_capacitance(double pad, double clearance, double thickness, double permittivity) {
  if (!(clearance > 0.0)) return 0.0;
  return 55.5e-12 * permittivity * thickness * pad / (2.0 * clearance);
}

std::vector<NetCopper> net_copper(const LaidBoard& board) {
  std::vector<NetParts> nets(board.nets.size());
  for (const LaidBoard::Part& part : board.parts)
    for (const LaidBoard::Pad& pad : part.pads) nets[pad.net].pads.push_back(&pad);
  for (const LaidBoard::Track& track : board.tracks) nets[track.net].tracks.push_back(&track);
  for (const LaidBoard::Via& via : board.vias) nets[via.net].vias.push_back(&via);
  const CopperOf copper(board);
  std::vector<NetCopper> result;
  std::vector<std::size_t> place(board.nets.size(), board.nets.size());
  for (std::size_t n = 1; n < nets.size(); ++n) {
    const NetParts& net = nets[n];
    if (net.pads.empty() || is_supply(board.nets[n])) continue;
    if (std::max(net.pads.size(), net.tracks.size() + net.vias.size()) > most_of_a_net)
      throw std::invalid_argument(board.file + ": net '" + board.nets[n] + "' has more than " +
                                  std::to_string(most_of_a_net) + " pads or tracks");
    NetCopper one{.net = board.nets[n], .pads = net.pads.size()};
    for (const LaidBoard::Pad* pad : net.pads) one.of_pads += copper.of(*pad);
    for (const LaidBoard::Track* track : net.tracks) {
      one.of_tracks += copper.of(*track);
      one.length += length_of(*track);
    }
    for (const LaidBoard::Via* via : net.vias) one.of_tracks += copper.of(*via);
    one.missing = missing_length(net);
    one.of_missing = copper.of_missing(one.missing);
    place[n] = result.size();
    result.push_back(std::move(one));
  }
  for (const LaidBoard::Area& area : board.areas)
    if (place[area.net] < result.size()) result[place[area.net]].of_tracks += copper.of(area);
  return result;
}

std::vector<NodeCapacitance> node_capacitances(const LaidBoard& board,
                                               std::span<const NetCopper> copper,
                                               const Circuit& circuit,
                                               const std::optional<AmplifierPackage>& amplifiers) {
  check_same_circuit(board, circuit, amplifiers);
  std::map<std::string, double> farad;
  for (const NetCopper& one : copper) farad[one.net] = one.farad();
  std::map<std::string, double> ohm;  // of parts
  std::map<std::string, std::string> middle;
  for (const LaidBoard::Part& part : board.parts) ohm[part.element] = resistance_of(part.value);
  for (const LaidBoard::Part& part : board.parts)
    for (const LaidBoard::Pad& pad : part.pads)
      if (pad.name == "2") middle[part.element] = board.nets[pad.net];
  const auto name = [&](Node node) { return node == 0 ? std::string("GND") : circuit.nodes[node]; };
  for (const Resistor& one : circuit.resistors) {
    const auto first = middle.find(one.name + 'a');
    if (first == middle.end() || first->second == name(one.to)) continue;
    const double at_first = ohm[one.name + 'a'];
    const double at_second = ohm[one.name + 'b'];
    const double between = farad[first->second];
    farad[name(one.from)] += between * at_second / (at_first + at_second);
    farad[name(one.to)] += between * at_first / (at_first + at_second);
  }
  std::vector<NodeCapacitance> result;
  for (Node node = 1; node < circuit.nodes.size(); ++node)
    if (const double value = farad[circuit.nodes[node]]; value > 0.0)
      result.push_back({circuit.nodes[node], value});
  return result;
}

Circuit with_capacitances(Circuit circuit, std::span<const NodeCapacitance> capacitances) {
  std::map<std::string, Node> nodes;
  for (Node node = 1; node < circuit.nodes.size(); ++node) nodes[circuit.nodes[node]] = node;
  for (const auto& [name, farad] : capacitances) {
    const auto node = nodes.find(name);
    if (node == nodes.end())
      throw std::invalid_argument("a capacitance is stated at node '" + name +
                                  "', which the circuit does not have");
    if (!(farad > 0.0 && std::isfinite(farad)))
      throw std::invalid_argument("the capacitance at node '" + name + "' must be > 0 and finite");
    circuit.capacitors.push_back({"Cb" + name, node->second, 0, farad});
  }
  return circuit;
}

}  // namespace tactile_net
