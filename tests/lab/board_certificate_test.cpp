#include "tactile_net/lab/board_certificate.hpp"

#include <sstream>
#include <string>

#include "tactile_net/lab/certification.hpp"
#include "tactile_net/lab/datasheet.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/board_words.hpp"
#include "tactile_net/report/words/datasheet_words.hpp"
#include "tactile_net/report/words/network_words.hpp"
#include "tactile_net/report/words/opamp_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// Eleven taxels, as many nodes, op-amps with a second pole.
AnyScene small_scene(double siemens, const std::string& more = {}) {
  std::ostringstream text;
  text << "[sensor]\ncount = 11\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
          "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
          "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
          "[reconstruct]\nalpha = 1e-3\nsmoothing_length = 1.0\n"
          "[network]\nrealization = \"lattice\"\nsettling = { accuracy = 1e-3 }\n"
          "tolerance = { relative = 0.01, trials = 20 }\nopamp = \"precision\"\nsiemens = "
       << siemens << '\n'
       << more;
  return parse_any_scene(text.str(), "small.toml");
}

/// As the command writes it of the scene's own circuit.
LaidBoard own_board(const lab::SceneCircuit& circuit) {
  const lab::PartsList list = lab::own_parts_list(circuit, 0.05);
  REQUIRE(list.choice);
  std::ostringstream text;
  write_kicad_board(text, board_of(list.choice->soldered));
  return read_kicad_board(text.str(), "board.kicad_pcb");
}

std::string text(const std::vector<std::string>& lines) { return join(lines, "\n"); }

}  // namespace

TEST_CASE("siemens are raised until the board's circuit has the margin", "[board]") {
  const lab::SceneCircuit circuit = lab::simulated_circuit(small_scene(2e-3));
  lab::PartsList list = lab::parts_list(circuit, 0.05);
  REQUIRE(list.choice);
  const SolderedCircuit before = list.choice->soldered;
  const lab::BoardCertificate board = lab::close_board(circuit, list, 45.0);
  CAPTURE(report::in_words(board));
  CHECK(board.stated.siemens == circuit.options().parts.scale.siemens);
  CHECK_FALSE(board.stated.enough(45.0));
  REQUIRE(board.changed());
  CHECK(board.used.enough(45.0));
  CHECK(board.used.siemens > board.stated.siemens);
  CHECK(board.used.margin->degrees < 60.0);  // no more than it takes
  // What is ordered is for these siemens.
  const double factor = board.used.siemens / board.stated.siemens;
  double ratio = 0.0;
  for (const Resistor& one : list.choice->soldered.circuit.resistors)
    for (const Resistor& other : before.circuit.resistors)
      if (one.name == other.name && one.name.front() == 'R') ratio = one.siemens / other.siemens;
  CHECK_THAT(ratio, WithinRel(factor, 0.05));
  // With these siemens stated nothing is changed.
  const lab::SceneCircuit raised = lab::simulated_circuit(small_scene(board.used.siemens));
  lab::PartsList again = lab::parts_list(raised, 0.05);
  const lab::BoardCertificate kept = lab::close_board(raised, again, 45.0);
  CHECK_FALSE(kept.changed());
  CHECK_THAT(kept.used.margin->degrees, WithinAbs(board.used.margin->degrees, 2.0));
}

TEST_CASE("eleven taxels of the ordered scene meet 0.3 % of parts that are sold, with the margin",
          "[board]") {
  Scene scene = read_scene(SCENES "/circuits/board.toml");
  scene.sensor.count = 11;
  std::get<RigidContact>(scene.contacts.front()).half_width = 0.5;
  scene.network.one_volt = true;  // of a narrower contact
  const lab::SceneCircuit circuit = lab::simulated_circuit(scene);
  REQUIRE(circuit.options().opamp_part != nullptr);
  lab::PartsList list = lab::parts_list(circuit, 3e-3);
  REQUIRE(list.choice);
  const lab::BoardCertificate board = lab::close_board(circuit, list, 45.0);
  CAPTURE(report::in_words(board));
  CHECK(board.used.enough(45.0));
  CHECK(*board.used.settling_seconds < 2.5e-6);
  CHECK(list.opamp_part == "OPA1637");
  CHECK(list.chosen().within >= 93 * list.chosen().builds / 100);
  // Its datasheet says so of others.
  const lab::Datasheet sheet = lab::datasheet(circuit, &list, &board);
  CHECK(sheet.on_board);
  CHECK(sheet.drawn.tare);
  CHECK(sheet.unstable == 0);
  CHECK(sheet.passes());
  CHECK(sheet.figures.at(0).verdict() == lab::DatasheetFigure::Verdict::passes);
  CHECK_THAT(report::conditions_in_words(sheet, sheet.figures.at(0)),
             ContainsSubstring("less the answer without readings"));
  // What is subtracted is told as it is: of this part more than what resistors leave.
  REQUIRE(sheet.figures.at(1).kind == lab::DatasheetFigure::Kind::offset);
  CHECK(sheet.figures.at(1).typical > 5e-4);

  // Without a controller that subtracts it less is left for resistors.
  scene.network.tolerance->tare = false;
  const lab::PartsList ordered = lab::parts_list(lab::simulated_circuit(scene), 3e-3);
  for (const auto& one : ordered.candidates)
    if (one.realization == Realization::lattice) {
      CHECK(one.opamps_alone.offset > 5e-4);
      CHECK(one.price > list.chosen().price);
    }
}

TEST_CASE("what the op-amps cannot give at the siemens that a board asks for is said", "[board]") {
  const lab::SceneCircuit circuit = lab::simulated_circuit(small_scene(2e-3));
  lab::PartsList list = lab::own_parts_list(circuit, 0.05);
  REQUIRE(list.choice);
  const lab::BoardCertificate enough = lab::close_board(circuit, list, 45.0);
  REQUIRE(enough.changed());
  CHECK_FALSE(enough.used.overload);

  // Op-amps that give what the stated siemens draw, and no more.
  Scene scene = std::get<Scene>(small_scene(2e-3));
  scene.network.parts.opamp.output_current = 1.0;
  const double drawn = lab::simulated_circuit(scene).certificate().output_current.value().largest;
  scene.network.parts.opamp.output_current = 1.1 * drawn;
  const lab::SceneCircuit weak = lab::simulated_circuit(scene);
  CHECK_THAT(text(report::in_words(weak.certificate())), !ContainsSubstring("would carry"));
  lab::PartsList again = lab::own_parts_list(weak, 0.05);
  const lab::BoardCertificate board = lab::close_board(weak, again, 45.0);
  REQUIRE(board.changed());
  REQUIRE(board.used.overload);
  const double factor = board.used.siemens / board.stated.siemens;
  CHECK_THAT(board.used.overload->value, WithinRel(factor * drawn, 1e-2));
  CHECK_THAT(board.used.overload->repair,
             WithinRel(weak.options().parts.scale.volts * 1.1 / factor, 1e-2));
  CHECK_THAT(text(report::in_words(board)), ContainsSubstring("would carry"));
  // Whatever is recommended beside it does not take the board's siemens back.
  REQUIRE(board.used.proposal);
  CHECK(board.used.proposal->siemens >= board.used.siemens);
  CHECK_THAT(text(report::in_words(board)), !ContainsSubstring("times the siemens"));
  lab::Certification certification{.circuit = weak};
  CHECK_THAT(text(report::facts_in_words(certification)), ContainsSubstring("recommended scale"));
  certification.board = board;
  CHECK_THAT(text(report::facts_in_words(certification)), !ContainsSubstring("recommended scale"));
}

TEST_CASE("a board from a file is certified as it is, and says which siemens would do", "[board]") {
  const lab::SceneCircuit circuit = lab::simulated_circuit(small_scene(8e-3));
  const LaidBoard board = own_board(circuit);
  const lab::BoardCertificate found = lab::certify_board(circuit, board, 40.0);
  CHECK(found.file == "board.kicad_pcb");
  CHECK(found.soldered().siemens == circuit.options().parts.scale.siemens);
  CHECK(found.changed());
  CHECK(found.used.enough(40.0));
  // What a scene states of a board is not counted beside the board.
  const lab::SceneCircuit stated =
      lab::simulated_circuit(small_scene(8e-3, "parasitic = { node = 20e-12, input = 8e-12 }\n"));
  const lab::BoardCertificate alike = lab::certify_board(stated, board, 40.0);
  CHECK_THAT(*alike.stated.slowest, WithinRel(*found.stated.slowest, 1e-9));
  // Three times the distance to the planes is less capacitance and more margin.
  LaidBoard thick = board;
  for (LaidBoard::Layer& layer : thick.layers) layer.to_plane *= 3.0;
  CHECK(lab::certify_board(circuit, thick).stated.margin->degrees >
        found.stated.margin->degrees + 5.0);
}

TEST_CASE("a planted oscillation is found, and its board is not written", "[board]") {
  const lab::SceneCircuit circuit = lab::simulated_circuit(small_scene(8e-3));
  LaidBoard board = own_board(circuit);
  CHECK(lab::certify_board(circuit, board).stated.stable());
  // A metre of track more at every residual and input.
  for (std::size_t net = 1; net < board.nets.size(); ++net)
    if (const char one = board.nets[net].front();
        one == 'u' || one == 'v' || one == 'p' || one == 's')
      board.tracks.push_back({net, 0, 0.0, 0.0, 1000.0, 0.0, 0.2});
  const lab::BoardCertificate found = lab::certify_board(circuit, board);
  CHECK(found.stated.oscillates());
  CHECK(*found.stated.slowest > 0.0);
  CHECK_FALSE(found.stated.margin);
  lab::Certification certification{.circuit = circuit};
  certification.parts = lab::own_parts_list(circuit, 0.05);
  CHECK(certification.writes_board());
  certification.board = found;
  CHECK_FALSE(certification.writes_board());
  certification.oscillating_board = true;
  CHECK(certification.writes_board());
}

TEST_CASE("a board is of a circuit that has one, with a margin in range", "[board][bad]") {
  const lab::SceneCircuit circuit = lab::simulated_circuit(small_scene(8e-3));
  const LaidBoard board = own_board(circuit);
  for (const double margin : {0.0, -1.0, 90.0, 1e9})
    CHECK_THROWS_AS(lab::certify_board(circuit, board, margin), std::invalid_argument);
  AnyScene other = small_scene(8e-3);
  std::get<Scene>(other).network.realization = Realization::ideal;
  CHECK_THROWS_WITH(lab::certify_board(lab::simulated_circuit(other), board),
                    ContainsSubstring("resistors and op-amps"));
  CHECK_THROWS_WITH(lab::certify_board(lab::simulated_circuit(small_scene(20e-3)), board),
                    ContainsSubstring("not the board of this circuit"));
}
