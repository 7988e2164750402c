// The way of a supply over a board's tracks, against resistors in a row.
#include "tactile_net/network/supply_drop.hpp"

#include <numbers>
#include <sstream>
#include <string>

#include "tactile_net/network/board.hpp"
#include "tests/catch.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

constexpr double copper = 1.72e-8;

/// A pad of VEE at so many millimetres along x.
std::string part(const std::string& element, double x, const std::string& layer = "F.Cu") {
  std::ostringstream text;
  text << "(footprint \"a\" (layer \"F.Cu\") (at " << x << " 0) (property \"Element\" \"" << element
       << "\") (pad \"4\" smd rect (at 0 0) (size 0.1 0.1) (layers \"" << layer
       << "\") (net 1 \"VEE\")))\n";
  return text.str();
}

std::string track(double from, double to, double width, const std::string& layer = "F.Cu") {
  std::ostringstream text;
  text << "(segment (start " << from << " 0) (end " << to << " 0) (width " << width << ") (layer \""
       << layer << "\") (net 1))\n";
  return text.str();
}

std::optional<SupplyDrop> drop_of(const std::string& items, const std::string& net = "VEE") {
  return supply_drop(read_kicad_board("(kicad_pcb (version 20211014) (general (thickness 1.6))\n"
                                      "(layers (0 \"F.Cu\" signal) (31 \"B.Cu\" signal))\n"
                                      "(net 0 \"\") (net 1 \"VEE\")\n" +
                                          items + ")\n",
                                      "hand"),
                     net);
}

/// Of a track of 35 um, by its length over its width.
double squares(double count) { return copper * count / 35e-6; }

LaidBoard laid(Realization realization, std::size_t count) {
  const FlatCircuit circuit(realize(realization, array_network(count, 1e-3).problem, {}));
  std::vector<PartValue> values;
  for (const Resistor& one : circuit.circuit().resistors)
    values.push_back(nearest_part(Series::e96, 1.0 / one.siemens));
  std::ostringstream text;
  write_kicad_board(text,
                    board_of(soldered(circuit, values, std::vector<double>(values.size(), 0.01))));
  return read_kicad_board(text.str(), "board.kicad_pcb");
}

}  // namespace

TEST_CASE("a supply falls by what its tracks take of all that is taken behind them", "[supply]") {
  // Both take through the first 10 mm, one through the next 20 mm.
  const std::string parts = part("supply", 0.0) + part("X0", 10.0) + part("X1", 30.0);
  const auto drop = drop_of(parts + track(0.0, 30.0, 0.5));
  REQUIRE(drop);
  CHECK(drop->amplifiers == 2);
  CHECK(drop->amplifier == "X1");
  CHECK_THAT(drop->ohm, WithinRel(squares(2.0 * 10.0 / 0.5 + 20.0 / 0.5), 1e-9));
  // The same of two tracks that meet, the second one wider, and of one beside it.
  CHECK_THAT(drop_of(parts + track(0.0, 10.0, 0.5) + track(10.0, 30.0, 1.0))->ohm,
             WithinRel(squares(2.0 * 10.0 / 0.5 + 20.0 / 1.0), 1e-9));
  CHECK_THAT(drop_of(parts + track(0.0, 30.0, 0.5) + track(30.0, 0.0, 0.5))->ohm,
             WithinRel(0.5 * drop->ohm, 1e-9));
  // A branch to nowhere takes nothing.
  CHECK_THAT(drop_of(parts + track(0.0, 30.0, 0.5) + track(30.0, 50.0, 0.5))->ohm,
             WithinRel(drop->ohm, 1e-9));
}

TEST_CASE("a via is the copper of its wall", "[supply]") {
  const std::string via =
      "(via (at 10 0) (size 0.6) (drill 0.3) (layers \"F.Cu\" \"B.Cu\") (net 1))\n";
  const auto drop = drop_of(part("supply", 0.0) + part("X0", 20.0, "B.Cu") + track(0.0, 10.0, 0.5) +
                            via + track(10.0, 20.0, 0.25, "B.Cu"));
  REQUIRE(drop);
  const double wall = std::numbers::pi * 0.32e-3 * 0.02e-3;
  CHECK_THAT(drop->ohm,
             WithinRel(squares(10.0 / 0.5 + 10.0 / 0.25) + copper * 1.6e-3 / wall, 1e-9));
}

TEST_CASE("nothing is said of a supply that tracks do not join", "[supply]") {
  const std::string way = track(0.0, 10.0, 0.5);
  CHECK(drop_of(part("supply", 0.0) + part("X0", 10.0) + way));
  CHECK_FALSE(drop_of(part("supply", 0.0) + part("X0", 10.0) + way, "VCC"));
  CHECK_FALSE(drop_of(part("supply", 0.0) + way));
  CHECK_FALSE(drop_of(part("J1", 0.0) + part("X0", 10.0) + way));
  CHECK_FALSE(drop_of(part("supply", 0.0) + part("X0", 11.0) + way));
  CHECK_FALSE(drop_of(part("supply", 0.0) + part("X0", 10.0, "B.Cu") + way));
}

TEST_CASE("op-amps of 10 mA take less than 10 mV off the negative supply", "[supply]") {
  for (const auto& [realization, count] : {std::pair(Realization::lattice, 11UL),
                                           {Realization::crossbar, 11UL},
                                           {Realization::least_squares, 11UL},
                                           {Realization::rail, 11UL},
                                           {Realization::lattice, 41UL}}) {
    CAPTURE(name(realization), count);
    const auto drop = supply_drop(laid(realization, count), "VEE");
    REQUIRE(drop);
    CAPTURE(drop->ohm, drop->amplifier);
    CHECK(drop->amplifiers >= count);
    CHECK(10e-3 * drop->ohm < 10e-3);
    CHECK(drop->ohm > 0.0);
  }
  // Three rows of 54: of 2 mA.
  CHECK(2e-3 * supply_drop(laid(Realization::nic, 11), "VEE")->ohm < 10e-3);
}
