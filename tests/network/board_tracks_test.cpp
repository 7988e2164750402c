// The tracks of a board, by their geometry alone: what is joined, and what is apart.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>

#include "tactile_net/network/arrays.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/network/copper_capacitance.hpp"
#include "tests/catch.hpp"
#include "tests/network/board_laws.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;
using board_laws::nets_apart;
using board_laws::too_near;

namespace {

/// @param every  of so many resistors one is a pair; 0: none, and all are of one class
SolderedCircuit soldered_array(Realization realization, std::size_t count,
                               const RealizationOptions& options = {}, std::size_t every = 3,
                               std::size_t unknowns = 1) {
  const FlatCircuit circuit(
      realize(realization, array_network(count, 1e-3, unknowns).problem, options));
  std::vector<PartValue> values;
  std::vector<double> tolerances;
  for (const Resistor& one : circuit.circuit().resistors) {
    const std::size_t k = values.size();
    values.push_back(every > 0 && k % every == 0 ? nearest_pair(Series::e96, 1.0 / one.siemens)
                                                 : nearest_part(Series::e96, 1.0 / one.siemens));
    // Better ones are larger.
    tolerances.push_back(every > 0 && k % 7 == 0 ? 0.001 : 0.01);
  }
  return soldered(circuit, values, tolerances);
}

LaidBoard laid(const Board& board) {
  std::ostringstream text;
  write_kicad_board(text, board);
  return read_kicad_board(text.str(), "board.kicad_pcb");
}

void check_laws(const Board& board) {
  const LaidBoard on = laid(board);
  CHECK(nets_apart(on) == std::set<std::string>{});
  CHECK(too_near(on) == std::vector<std::string>{});
  for (const NetCopper& one : net_copper(on)) CHECK(one.missing == 0.0);
  constexpr double from_edge = 0.3;
  for (const BoardTrack& one : board.tracks)
    for (const auto& [x, y] : {std::pair(one.from_x, one.from_y), std::pair(one.to_x, one.to_y)}) {
      const double half = 0.5 * one.width;
      CHECK((x - half > from_edge && x + half < board.width - from_edge));
      CHECK((y - half > from_edge && y + half < board.height - from_edge));
    }
}

}  // namespace

TEST_CASE("every net of a board is joined, and no two are too near", "[board][tracks]") {
  for (const Realization one : {Realization::crossbar, Realization::least_squares,
                                Realization::lattice, Realization::nic, Realization::rail})
    for (const std::size_t count : {5UL, 11UL}) {
      CAPTURE(name(one), count);
      const SolderedCircuit built = soldered_array(one, count);
      check_laws(board_of(built));
      CHECK_NOTHROW(check_same_circuit(laid(board_of(built)), built.circuit));
    }
}

TEST_CASE("so are those of ladders, inverters, voltage inputs and two tractions",
          "[board][tracks]") {
  RealizationOptions ladder;
  ladder.ladder = true;
  check_laws(board_of(soldered_array(Realization::least_squares, 9, ladder)));
  RealizationOptions inverters;
  inverters.inverters = true;
  check_laws(board_of(soldered_array(Realization::crossbar, 9, inverters)));
  RealizationOptions voltages;
  voltages.inputs = Inputs::voltage;
  check_laws(board_of(soldered_array(Realization::lattice, 9, voltages)));
  check_laws(board_of(soldered_array(Realization::lattice, 7, {}, 1, 2)));
  check_laws(board_of(soldered_array(Realization::lattice, 7, {}, 0)));
}

TEST_CASE("a board of forty-one taxels is joined too", "[board][tracks]") {
  const Board board = board_of(soldered_array(Realization::lattice, 41));
  const LaidBoard on = laid(board);
  for (const NetCopper& one : net_copper(on)) CHECK(one.missing == 0.0);
  CHECK(too_near(on) == std::vector<std::string>{});
}

TEST_CASE("the laws see a track that is missing, and copper that is moved", "[board][tracks]") {
  const Board whole = board_of(soldered_array(Realization::lattice, 5));
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Board broken = whole;
    const auto at = static_cast<std::ptrdiff_t>(random() % broken.tracks.size());
    const std::string net = broken.nets[broken.tracks[static_cast<std::size_t>(at)].net];
    broken.tracks.erase(broken.tracks.begin() + at);
    CAPTURE(at, net);
    CHECK(nets_apart(laid(broken)) == std::set{net});
  }
  for (int trial = 0; trial < 20; ++trial) {
    // A via onto any pad of another net.
    LaidBoard moved = laid(whole);
    LaidBoard::Via& via = moved.vias[random() % moved.vias.size()];
    const LaidBoard::Part& part = moved.parts[random() % (moved.parts.size() - 4)];
    const LaidBoard::Pad& pad = part.pads[random() % part.pads.size()];
    if (pad.net == via.net) continue;
    via.x = pad.x;
    via.y = pad.y;
    CHECK_FALSE(too_near(moved).empty());
  }
}

TEST_CASE("resistors stand in rows above a net of theirs, and in columns below one",
          "[board][tracks]") {
  const SolderedCircuit built = soldered_array(Realization::lattice, 9, {}, 0);
  const Board board = board_of(built);
  std::map<std::string, std::set<double>> rows;
  std::map<std::string, std::map<double, int>> columns;
  for (const Footprint& one : board.footprints) {
    if (one.kind != Footprint::Kind::resistor || place_of(one.element).array == Array::stabiliser)
      continue;
    const bool turned = one.angle == 90.0;
    const std::string above = board.nets[one.pads[turned ? 1 : 0].net];
    const std::string below = board.nets[one.pads[turned ? 0 : 1].net];
    CAPTURE(one.element, above, below);
    CHECK((above.front() == 'u' || above.front() == 'v'));
    rows[above].insert(one.y);
    if (below != "GND") ++columns[below][one.x];
  }
  CHECK(rows.size() == 18);
  for (const auto& [net, y] : rows) CHECK(y.size() == 1);
  for (const auto& [net, x] : columns) {
    CAPTURE(net);
    int most = 0;
    int all = 0;
    for (const auto& [at, count] : x) {
      most = std::max(most, count);
      all += count;
    }
    CHECK(10 * most >= 8 * all);
  }
}

TEST_CASE("a board has a test point on each residual and each output", "[board][tracks]") {
  for (const Realization one : {Realization::lattice, Realization::least_squares}) {
    CAPTURE(name(one));
    const SolderedCircuit built = soldered_array(one, 5);
    const Board board = board_of(built);
    std::set<std::string> points;
    for (const Footprint& part : board.footprints)
      if (part.kind == Footprint::Kind::test_point) {
        CHECK(points.insert(board.nets[part.pads[0].net]).second);
        CHECK(part.value == board.nets[part.pads[0].net]);
      }
    const Circuit& circuit = built.circuit;
    for (const Instance& x : circuit.instances)
      for (std::size_t k = 2; k < x.pins.size(); ++k)
        CHECK(points.contains(circuit.nodes[x.pins[k]]));
    for (const Node node : circuit.outputs) CHECK(points.contains(circuit.nodes[node]));
    if (one == Realization::lattice)
      for (const CurrentSource& reading : circuit.sources)
        CHECK(points.contains(circuit.nodes[reading.into]));
    // No summing node, where it would only load.
    for (const Instance& x : circuit.instances)
      for (std::size_t k = 0; k < 2; ++k)
        if (x.pins[k] != 0) CHECK_FALSE(points.contains(circuit.nodes[x.pins[k]]));
  }
}
