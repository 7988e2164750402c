// Vendors' macromodels: what of their files is taken, and what they make of a circuit.
#include "tactile_net/decks/macromodel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tactile_net/lab/macromodel_comparison.hpp"
#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/network/realization.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"
#include "tests/damaged.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

struct ModelFile {
  explicit ModelFile(const std::string& text) {
    std::string name = (fs::temp_directory_path() / "tactile-net-model-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    folder = name;
    path = (folder / "m.lib").string();
    std::ofstream(path, std::ios::binary) << text;
  }
  ~ModelFile() { fs::remove_all(folder); }
  ModelFile(const ModelFile&) = delete;
  ModelFile& operator=(const ModelFile&) = delete;
  fs::path folder;
  std::string path;
};

decks::Macromodel read(const std::string& text, Outputs outputs = Outputs::single,
                       const MacromodelOptions& options = {}, const std::string& part = "") {
  const ModelFile file(text);
  return decks::read_macromodel(file.path, options, part, outputs, 5.0);
}

std::string refused_model(const std::string& text, Outputs outputs = Outputs::single,
                          const MacromodelOptions& options = {}) {
  try {
    (void)read(text, outputs, options);
  } catch (const InputError& error) {
    return error.what();
  }
  FAIL("it was taken:\n" << text);
  return {};
}

const std::string body = "R1 1 2 1MEG\nE1 5 0 1 2 1e5\n.ENDS\n";

/// A fully differential amplifier in PSpice's language: limited transconductance into a capacitor,
/// a second pole, outputs about the voltage at its last pin. 100 dB, 10 MHz, so many V/s.
std::string vendor(const std::string& second_pole, const std::string& slew,
                   const std::string& pins = "1 2 3 4 5 6 7") {
  return "* A vendor's model; not for resale\n.SUBCKT FDA1 " + pins +
         " PARAMS: GM=1e-3 GBW=10e6\n"
         "RIN 1 2 10MEG\n"
         "GIN 0 10 VALUE = { LIMIT( V(1,2)*GM, {-GM*" +
         slew + "/(6.2831853*GBW)}, {GM*" + slew +
         "/(6.2831853*GBW)} ) }\n"
         "R10 10 0 {1e5/GM}\n"
         "C10 10 0 {GM/(6.2831853*GBW)}\n"
         "E20 20 0 VALUE { V(10) }\n"
         "R20 20 21 1K\n"
         "C20 21 0 {1/(6.2831853*1000*" +
         second_pole +
         ")}\n"
         "EPOS 5 0 POLY(2) 21 0 7 0 0 1 1\n"
         "ENEG 6 0 TABLE { V(7)-V(21) } = (-20,-20) (20,20)\n"
         "IQ 3 4 1M ; at any supply\n"
         "DP 5 3 DX\n"
         "DN 4 5 DX\n"
         ".MODEL DX D(IS=1E-18)\n"
         ".ENDS FDA1\n";
}

lab::SceneCircuit scene_circuit(const std::string& more) {
  return lab::simulated_circuit(AnyScene(
      parse_scene("[sensor]\ncount = 11\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
                  "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                  "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
                  "[reconstruct]\nalpha = 1e-3\nsmoothing_length = 1.0\n"
                  "[network]\nrealization = \"lattice\"\nvolts = 1.0\n"
                  "opamp = { gain = 1e5, bandwidth = 10e6, second_pole = 30e6 }\n"
                  "settling = { accuracy = 1e-3 }\n" +
                      more,
                  "scene.toml")));
}

lab::MacromodelComparison compare(const std::string& text, const std::string& more = "",
                                  const MacromodelOptions& options = {}) {
  const ModelFile file(text);
  const lab::SceneCircuit certified = scene_circuit(more);
  Ngspice ngspice({.pspice = true});
  decks::MacromodelSimulator simulator(
      ngspice, decks::read_macromodel(file.path, options, "", Outputs::complementary, 5.0),
      certified.network().circuit());
  return lab::compare_macromodel(certified, simulator, "fda1");
}

}  // namespace

TEST_CASE("a macromodel is taken as vendors write them", "[macromodel]") {
  const decks::Macromodel one =
      read("* A first line that is no title\n.subckt OPX 1 2 3 4 5\n" + body);
  CHECK(one.name == "opx");
  CHECK(one.elements == 2.0);
  CHECK(one.supply == 5.0);
  CHECK(one.pins == std::vector{MacromodelPin::in_plus, MacromodelPin::in_minus,
                                MacromodelPin::supply_plus, MacromodelPin::supply_minus,
                                MacromodelPin::out});
  CHECK_THAT(one.text, StartsWith(".subckt opx 1 2 3 4 5\n") && !ContainsSubstring("first line"));
  // On the first line, too; with parameters; with a pin for power-down.
  CHECK(read(".subckt OPX 1 2 3 4 5 6 PARAMS: g = 3\n" + body).pins.back() ==
        MacromodelPin::power_down);
  // Transistors, switches and functions stand in a macromodel, not in a deck.
  CHECK(read(".subckt OPX 1 2 3 4 5\nQ1 1 2 3 QN\nS1 1 2 3 4 SW1\n.model QN NPN(BF=100)\n"
             ".model SW1 VSWITCH(RON=1 ROFF=1MEG VON=1 VOFF=0)\n.func F(x) {x*x}\n" +
             body)
            .elements == 4.0);
  // Which one of several: as named, else as the part, else what no other calls.
  const std::string two =
      ".subckt inner 1 2 3 4 5\n" + body + ".subckt THS9999 1 2 3 4 5\nXI 1 2 3 4 5 inner\n" + body;
  CHECK(read(two).name == "ths9999");
  CHECK(read(two, Outputs::single, {.name = "INNER"}).name == "inner");
  const std::string both = ".subckt A741 1 2 3 4 5\n" + body + ".subckt OPA192 1 2 3 4 5\n" + body;
  CHECK(read(both, Outputs::single, {}, "OPA192").name == "opa192");
}

TEST_CASE("what is no macromodel, or more than one, is refused with what to do", "[macromodel]") {
  const std::string head = ".subckt OPX 1 2 3 4 5\n";
  CHECK_THAT(refused_model("R1 1 2 3\n"), ContainsSubstring("no .subckt"));
  CHECK_THAT(refused_model(head + "!ls\n" + body), ContainsSubstring("m.lib:2:1"));
  for (const char* line : {"shell ls", "shell touch /tmp/x", "write x", "source x y"})
    CHECK_THAT(refused_model(head + line + "\n" + body), ContainsSubstring("m.lib:2:1"));
  CHECK_THAT(refused_model(head + ".control\nshell ls\n.endc\n" + body),
             ContainsSubstring("commands to ngspice"));
  CHECK_THAT(refused_model(head + ".include /etc/passwd\n" + body),
             ContainsSubstring("reads another file"));
  CHECK_THAT(refused_model(".lib /tmp/x.lib\n" + head + body),
             ContainsSubstring("reads another file"));
  CHECK_THAT(refused_model(head + "A1 1 2 code\n" + body), ContainsSubstring("code model"));
  CHECK_THAT(refused_model(head + "V1 1 2 PWL file=x\n" + body), ContainsSubstring("names a file"));
  CHECK_THAT(refused_model(head + ".model x d_process(a=1)\n" + body),
             ContainsSubstring("kind of model that is not allowed"));
  for (const char* card : {".tran 1n 1u", ".options reltol=1", ".op", ".global vcc"})
    CHECK_THAT(refused_model(head + card + "\n" + body), ContainsSubstring("only .subckt .ends"));
  CHECK_THAT(refused_model("$CDNENCSTART\n0123\n"), ContainsSubstring("encrypted"));
  // A million lines, and a million elements in few lines.
  std::string lines = head;
  for (int k = 0; k < 20'001; ++k) lines += "r" + std::to_string(k) + " 1 2 1\n";
  CHECK_THAT(refused_model(lines + body), ContainsSubstring("more than 20000 cards"));
  std::string nested = ".subckt n0 1 2\nr1 1 2 1\n.ends\n";
  for (int level = 1; level <= 6; ++level) {
    nested += ".subckt n" + std::to_string(level) + " 1 2\n";
    for (int k = 0; k < 11; ++k)
      nested += "x" + std::to_string(k) + " 1 2 n" + std::to_string(level - 1) + "\n";
    nested += ".ends\n";
  }
  CHECK_THAT(refused_model(nested + head + "x1 1 2 n6\n" + body),
             ContainsSubstring("more than a million elements"));
  // Pins: how many, and which order is expected.
  CHECK_THAT(refused_model(".subckt OPX 1 2 3\n" + body),
             ContainsSubstring("has 3 pins, and 5 are expected: in_plus in_minus supply_plus "
                               "supply_minus out") &&
                 ContainsSubstring("model = { pins = [\"in_plus\""));
  CHECK_THAT(refused_model(head + body, Outputs::complementary), ContainsSubstring("common_mode"));
  CHECK_THAT(refused_model(head + body, Outputs::single, {.pins = {MacromodelPin::in_plus}}),
             ContainsSubstring("1 are mapped"));
  CHECK_THAT(
      refused_model(head + body, Outputs::single,
                    {.pins = {MacromodelPin::in_plus, MacromodelPin::in_plus, MacromodelPin::open,
                              MacromodelPin::open, MacromodelPin::out}}),
      ContainsSubstring("not one in_plus"));
  CHECK_THAT(refused_model(".subckt a 1 2 3 4 5\n" + body + ".subckt b 1 2 3 4 5\n" + body),
             ContainsSubstring("several sub-circuits") && ContainsSubstring("a, b"));
  CHECK_THAT(refused_model(".subckt a 1 2 3 4 5\nXa 1 2 3 4 5 a\n" + body),
             ContainsSubstring("they call one another"));
  CHECK_THAT(refused_model(head + body, Outputs::single, {.name = "other"}),
             ContainsSubstring("no sub-circuit 'other'"));
}

TEST_CASE("any bytes are a macromodel or are refused in words", "[macromodel][fuzz]") {
  const std::vector<std::string> seeds = {vendor("30e6", "1e12"),
                                          ".subckt amp 1 2 3 4 5\n+ gain = 3\n" + body};
  std::mt19937 random(9);
  int taken = 0;
  constexpr int rounds = 1500;
  for (int round = 0; round < rounds; ++round) {
    const std::size_t which = random() % 2;
    const std::string bytes =
        test::damaged(seeds[which], "0123456789.*+={}(),\n\r\t xX;$\"'", random);
    CAPTURE(round, bytes);
    try {
      const decks::Macromodel model =
          read(bytes, which == 0 ? Outputs::complementary : Outputs::single);
      ++taken;
      CHECK(model.elements >= 0.0);
      CHECK(model.text.find('\0') == std::string::npos);
    } catch (const InputError& error) {
      CHECK_FALSE(error.diagnostics().empty());
    }
  }
  CHECK(taken > rounds / 50);
  CHECK(taken < rounds);
}

TEST_CASE("a macromodel that is as the scene's op-amp does as certified", "[macromodel][ngspice]") {
  const lab::MacromodelComparison found = compare(vendor("30e6", "1e12"));
  CHECK(found.verdict() == lab::MacromodelVerdict::as_certified);
  CHECK(found.difference < 0.01);
  REQUIRE(found.transient.settling_seconds);
  CHECK_THAT(*found.transient.settling_seconds,
             WithinRel(*found.certificate.dynamics->settling_seconds, 0.05));

  // Its pins in another order, mapped.
  using Pin = MacromodelPin;
  const lab::MacromodelComparison mapped =
      compare(vendor("30e6", "1e12", "6 5 7 4 3 1 2"), "",
              {.pins = {Pin::out_minus, Pin::out_plus, Pin::common_mode, Pin::supply_minus,
                        Pin::supply_plus, Pin::in_plus, Pin::in_minus}});
  CHECK_THAT(*mapped.transient.settling_seconds,
             WithinRel(*found.transient.settling_seconds, 1e-3));
}

TEST_CASE("a macromodel that does otherwise is told", "[macromodel][ngspice]") {
  // It slews, the scene's op-amp does not.
  CHECK(compare(vendor("30e6", "1.5e6")).verdict() == lab::MacromodelVerdict::settles_otherwise);
  CHECK(compare(vendor("30e6", "1e5")).verdict() == lab::MacromodelVerdict::does_not_settle);
  // What the board adds is there beside the macromodel.
  const std::string loaded = "parasitic = { input = 40e-12, output = 10e-12 }\n";
  const MacromodelOptions board{.board_input = 40e-12, .board_output = 10e-12};
  const lab::MacromodelComparison with_board = compare(vendor("30e6", "1e12"), loaded, board);
  CHECK(with_board.verdict() == lab::MacromodelVerdict::as_certified);
  CHECK_THAT(*with_board.transient.settling_seconds,
             WithinRel(*with_board.certificate.dynamics->settling_seconds, 0.06));
  CHECK(compare(vendor("30e6", "1e12"), loaded).verdict() ==
        lab::MacromodelVerdict::settles_otherwise);
  // A second pole at a third of the bandwidth rings for longer.
  CHECK(compare(vendor("3e6", "1e12"), loaded, board).verdict() !=
        lab::MacromodelVerdict::as_certified);
}
