// From a board's copper to its circuit's poles.
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tactile_net/network/board.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/copper_capacitance.hpp"
#include "tactile_net/network/laid_board.hpp"
#include "tactile_net/network/phase_margin.hpp"
#include "tests/catch.hpp"
#include "tests/damaged.hpp"
#include "tests/network/opamps.hpp"
#include "tests/network/problems.hpp"

using namespace tactile_net;

namespace {

constexpr double vacuum = 8.8541878128e-12;

SolderedCircuit soldered_lattice(const FlatCircuit& circuit, bool pairs) {
  const PartChoice choice(Reduction(circuit), Series::e96);
  const std::vector<PartValue> values =
      choice.values(std::vector<bool>(choice.groups().size(), pairs));
  return soldered(circuit, values, std::vector<double>(values.size(), 0.01));
}

std::string text_of(const SolderedCircuit& soldered) {
  std::ostringstream out;
  write_kicad_board(out, board_of(soldered));
  return out.str();
}

double of_net(const std::vector<NetCopper>& copper, const std::string& net) {
  for (const NetCopper& one : copper)
    if (one.net == net) return one.farad();
  return 0.0;
}

/// Two resistors on a board whose net A joins a pad of each, 10 mm apart.
std::string two_pads(const std::string& more = {}, const std::string& layer = "In1.Cu") {
  return "(kicad_pcb (version 20211014) (generator hand)\n"
         "(general (thickness 1.6))\n"
         "(layers (0 \"F.Cu\" signal) (1 \"In1.Cu\" power) (31 \"B.Cu\" signal))\n"
         "(setup (stackup (layer \"F.Cu\" (type \"copper\") (thickness 0.035))\n"
         "  (layer \"a\" (type \"prepreg\") (thickness 0.2) (epsilon_r 4))\n"
         "  (layer \"In1.Cu\" (type \"copper\") (thickness 0.035))\n"
         "  (layer \"b\" (type \"core\") (thickness 1.3) (epsilon_r 4))\n"
         "  (layer \"B.Cu\" (type \"copper\") (thickness 0.035))))\n"
         "(net 0 \"\") (net 1 \"GND\") (net 2 \"A\") (net 3 \"B\")\n"
         "(zone (net 1) (net_name \"GND\") (layer \"" +
         layer +
         "\") (connect_pads (clearance 0.2))\n"
         "  (polygon (pts (xy -5 -5) (xy 25 -5) (xy 25 15) (xy -5 15))))\n"
         "(footprint \"R\" (layer \"F.Cu\") (at 0 0) (property \"Element\" \"R1\")\n"
         "  (fp_text reference \"R1\" (at 0 0)) (fp_text value \"1k\" (at 0 0))\n"
         "  (pad \"1\" smd rect (at 0 0) (size 1 1) (layers \"F.Cu\") (net 2 \"A\"))\n"
         "  (pad \"2\" smd rect (at 2 0) (size 1 1) (layers \"F.Cu\") (net 3 \"B\")))\n"
         "(footprint \"R\" (layer \"F.Cu\") (at 10 10 90) (property \"Element\" \"R2\")\n"
         "  (fp_text reference \"R2\" (at 0 0)) (fp_text value \"1k\" (at 0 0))\n"
         "  (pad \"1\" smd rect (at 2 0) (size 1 1) (layers \"F.Cu\") (net 2 \"A\"))\n"
         "  (pad \"2\" smd rect (at 0 0) (size 1 1) (layers \"F.Cu\") (net 1 \"GND\")))\n" +
         more + ")\n";
}

NetCopper net_a(const std::string& more = {}, const std::string& layer = "In1.Cu") {
  return net_copper(read_kicad_board(two_pads(more, layer), "hand")).at(0);
}

}  // namespace

TEST_CASE("a large plate has the capacitance of a plate, a wide track that of one", "[copper]") {
  const Microstrip strip{.height = 0.2e-3, .permittivity = 4.4};
  const double side = 0.2;
  CHECK_THAT(strip.plate_capacitance(side, side),
             WithinRel(vacuum * 4.4 * side * side / 0.2e-3, 0.02));
  CHECK(strip.plate_capacitance(side, side) > vacuum * 4.4 * side * side / 0.2e-3);
  CHECK_THAT(strip.capacitance(side), WithinRel(vacuum * 4.4 * side / 0.2e-3, 0.02));
  // A long rectangle is a track, and its ends count less the longer it is.
  for (const double length : {1e-2, 1.0})
    CHECK_THAT(strip.plate_capacitance(0.3e-3, length) / length,
               WithinRel(strip.capacitance(0.3e-3), 1e-3 / length));
  CHECK_THAT(strip.plate_capacitance(1e-3, 3e-3), WithinRel(strip.plate_capacitance(3e-3, 1e-3)));
  // Lengths in another unit, and all of them twice as large.
  const Microstrip twice{.height = 0.4e-3, .permittivity = 4.4};
  CHECK_THAT(twice.capacitance(1.2e-3), WithinRel(strip.capacitance(0.6e-3), 1e-12));
}

TEST_CASE("a microstrip agrees with exact electrostatics", "[copper]") {
  // In air: half of a strip line of two strips 2 h apart; at w/h = 1 its impedance is 126.5 ohm
  // (Wheeler 1965, by conformal mapping), and c Z C = 1.
  constexpr double light = 299792458.0;
  const Microstrip in_air{.height = 1.0, .permittivity = 1.0};
  CHECK_THAT(1.0 / (light * in_air.capacitance(1.0)), WithinRel(126.5, 5e-3));
  // A thin wire-like strip: C = 2 pi eps / ln(8 h / w).
  CHECK_THAT(in_air.capacitance(1e-2),
             WithinRel(2.0 * std::numbers::pi * vacuum / std::log(800.0), 5e-3));
  // Alumina (9.8) at w/h = 1: 49.4 ohm and 6.56 effective (Hammerstad and Jensen's own example).
  const Microstrip alumina{.height = 1.0, .permittivity = 9.8};
  CHECK_THAT(alumina.capacitance(1.0) / in_air.capacitance(1.0), WithinRel(6.56, 1e-2));
  // Thicker copper, more of it; covered by the dielectric, more of it.
  CHECK(Microstrip{1.0, 4.0, 0.1}.capacitance(1.0) > Microstrip{1.0, 4.0}.capacitance(1.0));
  CHECK_THAT((Microstrip{1.0, 4.0, 0.0, true}.capacitance(1.0)),
             WithinRel(4.0 * in_air.capacitance(1.0), 1e-12));
}

TEST_CASE("a net has its pads and its tracks, or an estimate of those that are missing",
          "[copper]") {
  const Microstrip strip{0.2e-3, 4.0, 0.035e-3};
  const NetCopper bare = net_a();
  CHECK(bare.pads == 2);
  CHECK_THAT(bare.of_pads, WithinRel(2.0 * strip.plate_capacitance(1e-3, 1e-3)));
  // R2 stands turned by 90 degrees: its pad 1 lies 2 mm above its place, at (10, 8).
  CHECK_THAT(bare.missing, WithinRel(18.0));
  CHECK_THAT(bare.of_missing, WithinRel(18e-3 * strip.capacitance(0.15e-3)));
  CHECK(bare.of_tracks == 0.0);

  const std::string half =
      "(segment (start 0 0) (end 10 0) (width 0.3) (layer \"F.Cu\") (net 2))\n";
  const std::string rest =
      "(segment (start 10 0) (end 10 8) (width 0.3) (layer \"F.Cu\") (net 2))\n";
  const NetCopper open = net_a(half);
  CHECK_THAT(open.missing, WithinRel(18.0));  // it reaches no other pad yet
  const NetCopper routed = net_a(half + rest);
  CHECK(routed.missing == 0.0);
  CHECK_THAT(routed.length, WithinRel(18.0));
  CHECK_THAT(routed.of_tracks, WithinRel(18e-3 * strip.capacitance(0.3e-3)));
  // The same through the other side, and two holes.
  const NetCopper through = net_a(
      "(via (at 0 0) (size 0.6) (drill 0.3) (layers \"F.Cu\" \"B.Cu\") (net 2))\n"
      "(segment (start 0 0) (end 10 0) (width 0.3) (layer \"B.Cu\") (net 2))\n"
      "(segment (start 10 0) (end 10 8) (width 0.3) (layer \"B.Cu\") (net 2))\n"
      "(via (at 10 8) (size 0.6) (drill 0.3) (layers \"F.Cu\" \"B.Cu\") (net 2))\n");
  CHECK(through.missing == 0.0);
  CHECK_THAT(through.of_tracks,
             WithinRel(18e-3 * Microstrip{1.3e-3, 4.0, 0.035e-3}.capacitance(0.3e-3) +
                       2.0 * hole_capacitance(0.6e-3, 0.2e-3, 1.6e-3, 4.0)));
  // On the wrong side without holes it joins nothing.
  CHECK(net_a("(segment (start 0 0) (end 10 0) (width 0.3) (layer \"B.Cu\") (net 2))\n"
              "(segment (start 10 0) (end 10 8) (width 0.3) (layer \"B.Cu\") (net 2))\n")
            .missing > 0.0);
  // An area of it, and a plane further away.
  const NetCopper area = net_a(
      "(zone (net 2) (net_name \"A\") (layer \"F.Cu\") (filled_polygon "
      "(layer \"F.Cu\") (pts (xy 0 0) (xy 10 0) (xy 10 10) (xy 0 10))))\n");
  CHECK(area.of_tracks > vacuum * 4.0 * 1e-4 / 0.2e-3);
  CHECK(area.of_tracks < 1.1 * vacuum * 4.0 * 1e-4 / 0.2e-3);
  CHECK(net_a({}, "B.Cu").of_pads < bare.of_pads);
}

TEST_CASE("the board's copper is that of its nets", "[copper]") {
  const ArrayNetwork array = array_network(9, 1e-3);
  const FlatCircuit circuit(realize(Realization::lattice, array.problem, {}));
  const SolderedCircuit built = soldered_lattice(circuit, true);
  const LaidBoard board = read_kicad_board(text_of(built), "board.kicad_pcb");
  CHECK(board.has_planes);
  const std::vector<NetCopper> copper = net_copper(board);
  // Every node of the soldered circuit is a net, once.
  CHECK(copper.size() == built.circuit.nodes.size() - 1);
  std::size_t pads = 0;
  for (const NetCopper& one : copper) pads += one.pads;
  std::size_t expected = 2 * built.circuit.resistors.size() + built.circuit.outputs.size();
  for (const Resistor& r : built.circuit.resistors)
    for (const Node end : {r.from, r.to}) expected -= end == 0 ? 1U : 0U;
  for (const Instance& x : built.circuit.instances) expected += x.pins.size();
  for (const CurrentSource& i : built.circuit.sources) expected += i.into == 0 ? 0U : 1U;
  for (const LaidBoard::Part& part : board.parts)
    if (part.reference.starts_with("TP")) ++expected;
  CHECK(pads == expected);
  // What the resistors' pairs have between them is at their ends: nothing is lost.
  double of_nets = 0.0;
  for (const NetCopper& one : copper) of_nets += one.farad();
  double of_nodes = 0.0;
  for (const NodeCapacitance& one : node_capacitances(board, copper, circuit.circuit()))
    of_nodes += one.farad;
  CHECK_THAT(of_nodes, WithinRel(of_nets, 1e-12));
}

TEST_CASE("a node between two resistors counts as the whole circuit has it", "[copper]") {
  const ArrayNetwork array = array_network(5, 1e-3);
  const RealizationOptions options{.scale = {.siemens = 10e-3}, .opamp = one_pole};
  const NetworkCircuit plain(Realization::lattice,
                             std::make_shared<const NetworkProblem>(array.problem), options);
  const SolderedCircuit built = soldered_lattice(plain.flat(), true);
  const LaidBoard board = read_kicad_board(text_of(built), "board.kicad_pcb");
  const std::vector<NetCopper> copper = net_copper(board);
  // As soldered, the nodes inside the pairs included.
  std::vector<NodeCapacitance> all;
  for (const NetCopper& one : copper) all.push_back({one.net, one.farad()});
  const Circuit whole = with_capacitances(built.circuit, all);
  REQUIRE(whole.nodes.size() > plain.circuit().nodes.size());
  const NetworkCircuit reduced(Realization::lattice, plain.shared_problem(), options,
                               node_capacitances(board, copper, plain.flat().circuit()));
  const double exact = poles(state_space(FlatCircuit(whole)))[0].real();
  CHECK_THAT(reduced.poles()[0].real(), WithinRel(exact, 0.01));
  CHECK_THAT(phase_margin(reduced.flat())->degrees,
             WithinAbs(phase_margin(FlatCircuit(whole))->degrees, 0.5));
}

TEST_CASE("capacitances of each node that are all equal are one capacitance", "[copper]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(9, 1e-3).problem);
  const OpAmp opamp{.gain = 1e6, .bandwidth = 10e6, .second_pole = 25e6};
  const Scale scale{.siemens = 10e-3};
  RealizationOptions one{.scale = scale, .opamp = opamp, .node_capacitance = 20e-12};
  one.opamp.input_capacitance = 20e-12;
  const NetworkCircuit alike(Realization::lattice, problem, one);
  std::vector<NodeCapacitance> each;
  for (Node node = 1; node < alike.circuit().nodes.size(); ++node)
    each.push_back({alike.circuit().nodes[node], 20e-12});
  const NetworkCircuit own(Realization::lattice, problem, {.scale = scale, .opamp = opamp}, each);
  const Certificate a = certify(alike);
  const Certificate b = certify(own);
  CHECK(a.stability == b.stability);
  CHECK_THAT(b.dynamics->slowest, WithinRel(a.dynamics->slowest, 1e-8));
  CHECK_THAT(b.dynamics->damping, WithinRel(a.dynamics->damping, 1e-6));
  REQUIRE(a.dynamics->settling_seconds);
  REQUIRE(b.dynamics->settling_seconds);
  CHECK_THAT(*b.dynamics->settling_seconds, WithinRel(*a.dynamics->settling_seconds, 1e-6));
  CHECK(b.dynamics->states == a.dynamics->states);
  // Of nodes that differ no theorem speaks but the crossbar's.
  CHECK(b.theorem.unmet->condition == TheoremCondition::no_own_capacitances);
  CHECK_FALSE(b.tolerance_margin);
}

TEST_CASE("of capacitances that differ the crossbar's theorem alone speaks, and it is right",
          "[copper]") {
  std::mt19937 random(7);
  const auto problem = std::make_shared<const NetworkProblem>(array_network(9, 1e-3).problem);
  const OpAmp opamp{.gain = 1e6, .bandwidth = 10e6, .second_pole = 12e6};
  const Circuit plain = realize(Realization::crossbar, *problem, {});
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<NodeCapacitance> each;
    for (Node node = 1; node < plain.nodes.size(); ++node)
      each.push_back({plain.nodes[node],
                      1e-13 * std::pow(10.0, 4.0 * static_cast<double>(random()) / 4294967295.0)});
    const Certificate c =
        certify(NetworkCircuit(Realization::crossbar, problem, {.opamp = opamp}, each));
    CHECK(c.theorem.holds());
    CHECK(c.stability == Stability::stable);
    const Certificate two = certify(
        NetworkCircuit(Realization::least_squares, problem, {.opamp = one_pole}, {{"t0", 1e-12}}));
    CHECK_FALSE(two.theorem.holds());
  }
}

TEST_CASE("a phase margin is the usual one of one loop", "[copper]") {
  // A follower with a second pole: |L| = 1 where w sqrt(1 + w^2/W2^2) = W.
  for (const double ratio : {0.3, 1.0, 5.0}) {
    Circuit circuit;
    const Node in = add_node(circuit, "in");
    const Node out = add_node(circuit, "out");
    circuit.outputs = {out};
    circuit.sources = {{"I0", in, 1e-3}};
    circuit.resistors = {{"R0", in, 0, 1e-3}, {"R1", out, 0, 1e-3}};
    circuit.amplifiers = {{"opamp", {.gain = 1e6, .bandwidth = 1e6, .second_pole = ratio * 1e6}}};
    circuit.instances = {{"X0", {in, out, out}, "opamp"}};
    const double w = ratio * std::sqrt(0.5 * (std::sqrt(1.0 + 4.0 / (ratio * ratio)) - 1.0));
    const double expected = 90.0 - std::atan(w / ratio) * 180.0 / std::numbers::pi;
    const auto margin = phase_margin(circuit);
    REQUIRE(margin);
    CHECK_THAT(margin->degrees, WithinAbs(expected, 0.02));
    CHECK_THAT(margin->hertz, WithinRel(w * 1e6, 1e-3));
  }
  CHECK_THROWS_AS(phase_margin(resistor_and_capacitor()), std::invalid_argument);
}

TEST_CASE("a margin falls to nothing where the poles cross, and only there", "[copper]") {
  const auto problem = std::make_shared<const NetworkProblem>(array_network(21, 1e-3).problem);
  const OpAmp opamp{
      .gain = 1e6, .bandwidth = 10e6, .second_pole = 25e6, .input_capacitance = 4e-12};
  const auto with = [&](double farad) {
    RealizationOptions options{.opamp = opamp, .node_capacitance = farad};
    options.opamp.input_capacitance = 4e-12 + farad;
    return NetworkCircuit(Realization::lattice, problem, options);
  };
  double stable = 1e-12;
  double growing = 1e-9;
  REQUIRE(with(stable).poles()[0].real() < 0.0);
  REQUIRE(with(growing).poles()[0].real() > 0.0);
  while (growing > 1.001 * stable) {
    const double middle = std::sqrt(stable * growing);
    (with(middle).poles()[0].real() < 0.0 ? stable : growing) = middle;
  }
  CHECK(phase_margin(with(stable).flat())->degrees < 0.1);
  CHECK(phase_margin(with(0.25 * stable).flat())->degrees > 10.0);
  double last = 90.0;
  for (const double share : {0.01, 0.1, 0.3, 0.9}) {
    const double here = phase_margin(with(share * stable).flat())->degrees;
    CHECK(here < last);
    last = here;
  }
}

TEST_CASE("a board of another circuit is refused with the part that differs", "[copper][bad]") {
  const ArrayNetwork array = array_network(5, 1e-3);
  const FlatCircuit circuit(realize(Realization::lattice, array.problem, {}));
  const std::string text = text_of(soldered_lattice(circuit, false));
  const auto against = [&](const std::string& changed, const FlatCircuit& other) {
    check_same_circuit(read_kicad_board(changed, "b.kicad_pcb"), other.circuit());
  };
  CHECK_NOTHROW(against(text, circuit));
  const FlatCircuit crossbar(realize(Realization::crossbar, array.problem, {}));
  CHECK_THROWS_WITH(against(text, crossbar), ContainsSubstring("of the circuit is not on it"));
  const FlatCircuit louder(
      realize(Realization::lattice, array.problem, {.scale = {.siemens = 2e-3}}));
  CHECK_THROWS_WITH(against(text, louder), ContainsSubstring("ohm, the circuit has"));
  // The two inputs of an amplifier exchanged: every net keeps its number of pads.
  std::string swapped = text;
  const auto at = swapped.find("\"Xn0\"");
  REQUIRE(at != std::string::npos);
  const auto plus = swapped.find("\"p0\"", at);
  const auto minus = swapped.find("\"s0\"", at);
  swapped.replace(plus, 4, "\"s0\"");
  swapped.replace(minus, 4, "\"p0\"");
  // The name is only repeated there; the number counts.
  CHECK_NOTHROW(against(swapped, circuit));
  const auto number_before = [&](std::size_t place) {
    const auto from = text.rfind("(net ", place) + 5;
    return std::pair(from, text.substr(from, place - 1 - from));
  };
  swapped = text;
  const auto [plus_at, plus_net] = number_before(text.find("\"p0\"", at));
  const auto [minus_at, minus_net] = number_before(text.find("\"s0\"", at));
  REQUIRE(plus_net.size() == minus_net.size());
  swapped.replace(plus_at, plus_net.size(), minus_net);
  swapped.replace(minus_at, minus_net.size(), plus_net);
  CHECK_THROWS_WITH(against(swapped, circuit), ContainsSubstring("Xn0"));
}

TEST_CASE("no file makes the reader fall", "[copper][bad]") {
  const ArrayNetwork array = array_network(5, 1e-3);
  const FlatCircuit circuit(realize(Realization::lattice, array.problem, {}));
  const std::string text = text_of(soldered_lattice(circuit, false));
  const auto read = [](const std::string& one) { return read_kicad_board(one, "b.kicad_pcb"); };
  CHECK_THROWS_WITH(read(""), ContainsSubstring("empty"));
  CHECK_THROWS_WITH(read("title = 1"), ContainsSubstring("begins with '('"));
  CHECK_THROWS_WITH(read("(kicad_sch (version 1))"), ContainsSubstring("no board of KiCad"));
  CHECK_THROWS_WITH(read(std::string(10'000'000, '(')), ContainsSubstring("nested"));
  CHECK_THROWS_WITH(read("(kicad_pcb " + std::string(10'000'000, 'x')),
                    ContainsSubstring("cut short"));
  CHECK_THROWS_WITH(read(text + ")"), ContainsSubstring("behind the end"));
  CHECK_THROWS_WITH(
      read(two_pads("(segment (start 0 0) (end 1e9 0) (width 0.3) (layer \"F.Cu\") (net 2))")),
      ContainsSubstring("more than 100 m"));
  CHECK_THROWS_WITH(
      read(two_pads("(segment (start 0 0) (end 1 0) (width 0.3) (layer \"F.Cu\") (net 9))")),
      ContainsSubstring("not in the board's list of nets"));
  CHECK_THROWS_WITH(
      read(two_pads("(segment (start 0 0) (end nan 0) (width 0.3) (layer \"F.Cu\") (net 2))")),
      ContainsSubstring("a number is expected"));
  // So thin that its capacitance would overflow, and be left out.
  CHECK_THROWS_WITH(
      read(two_pads("(segment (start 0 0) (end 1 0) (width 1e-30) (layer \"F.Cu\") (net 2))")),
      ContainsSubstring("without a width of 1 um"));
  for (const char* sheet : {"(thickness 0.2)", "(thickness 1.6)"}) {
    std::string thin = two_pads();
    thin.replace(thin.find(sheet), std::string(sheet).size(), "(thickness 1e-30)");
    CHECK_THROWS_WITH(read(thin), ContainsSubstring("thickness of 1 um"));
  }
  // Cut anywhere it is refused, by its line; the whole is read.
  for (std::size_t end = 1; end + 2 < text.size(); end += text.size() / 97)
    CHECK_THROWS_WITH(read(text.substr(0, end)), StartsWith("b.kicad_pcb:"));
  CHECK_NOTHROW(read(text));
  // Damaged it is read or refused.
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const std::string changed = test::damaged(text, "()\"\\x9 ", random);
    try {
      const LaidBoard board = read(changed);
      CHECK(of_net(net_copper(board), "n0") >= 0.0);
    } catch (const std::invalid_argument& error) {
      CHECK_THAT(error.what(), StartsWith("b.kicad_pcb:"));
    }
  }
}

TEST_CASE("a pad that names many layers is read at once", "[copper][bad]") {
  std::string layers;
  for (int k = 0; k < 400'000; ++k) layers += "\"F.Paste\" ";
  const auto with = [&](const std::string& names) {
    return two_pads(
        "(footprint \"R\" (layer \"F.Cu\") (at 5 5) (property \"Element\" \"R3\")\n"
        "  (fp_text reference \"R3\" (at 0 0)) (fp_text value \"1k\" (at 0 0))\n"
        "  (pad \"1\" smd rect (at 0 0) (size 1 1) (layers " +
        names + "\"F.Cu\") (net 2 \"A\")))\n");
  };
  const LaidBoard board = read_kicad_board(with(layers), "b.kicad_pcb");
  CHECK(board.parts.back().pads.front().on ==
        read_kicad_board(with(""), "b.kicad_pcb").parts.back().pads.front().on);
}
