// From a scene to a board, by four commands, as docs/circuits.md has them.
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

/// So few siemens that copper makes it oscillate.
const std::string weak_circuit =
    "# a comment\n[sensor]\ncount = 8\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
    "[reconstruct]\nalpha = 1e-3\nsmoothing_length = 1.0\n"
    "[network]\nrealization = \"crossbar\"  # another is chosen\nopamp = \"precision\"\n"
    "settling = { accuracy = 1e-3 }\ntolerance = { relative = 0.01, trials = 20 }\n";

Json json_of(const std::vector<std::string>& words) {
  const ProcessResult result = run_tool(words);
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  return Json::parse(result.output);
}

}  // namespace

TEST_CASE("a board of a part with pins of its own is that of its scene", "[cli][board]") {
  const Folder folder;
  std::string text = weak_circuit;
  const std::string usual = "\"precision\"";
  text.replace(text.find(usual), usual.size(),
               "{ part = \"THS4541\", second_pole = 850e6, gain = 1e5 }");
  const std::string scene = folder.write("s.toml", text);
  const std::string out = folder / "out";
  const ProcessResult made = run_tool({"certify", scene, "--realization", "crossbar", "--budget",
                                       "5%", "--phase-margin", "10", "--out", out});
  CAPTURE(made.output, made.errors);
  REQUIRE(made.code == 0);
  const std::string ordered = out + "/s.ordered.toml";
  const std::string board = out + "/board.kicad_pcb";
  REQUIRE_THAT(read_text(board), ContainsSubstring("VQFN-16"));
  CHECK(run_tool({"certify", ordered, "--board", board}).code == 0);
  const ProcessResult deck = run_tool({"gen", ordered, "--budget", "5%", "--board", board});
  CAPTURE(deck.errors);
  CHECK(deck.code == 0);
  CHECK_THAT(deck.output, ContainsSubstring("\nCbn0 n0 0 "));
  // Of the usual pins it is another board.
  text.replace(text.find("{ part"), text.find('}') + 1 - text.find("{ part"), usual);
  CHECK_THAT(run_tool({"gen", folder.write("usual.toml", text), "--board", board}).errors,
             ContainsSubstring("not the board of this circuit"));
}

TEST_CASE("from a scene to a board by four commands", "[cli][board]") {
  const Folder folder;
  const std::string scene = folder.write("s.toml", weak_circuit);
  const std::string out = folder / "out";
  const ProcessResult made =
      run_tool({"certify", scene, "--budget", "1%", "--datasheet", "--out", out});
  CAPTURE(made.output, made.errors);
  REQUIRE(made.code == 0);
  const Json certificate = Json::parse(read_text(out + "/certificate.json"));
  const Json& used = certificate.at("board").at("used");
  CHECK(used.at("siemens").get<double>() >
        1.5 * certificate.at("board").at("stated").at("siemens").get<double>());
  CHECK(certificate.at("datasheet").at("on_board") == true);
  CHECK(certificate.at("datasheet").at("unstable") == 0);
  const std::string ordered = out + "/s.ordered.toml";
  CHECK_THAT(read_text(ordered),
             ContainsSubstring("# a comment\n") && ContainsSubstring("  # another is chosen\n"));
  const std::string board = out + "/board.kicad_pcb";

  // Its board is certified as it is, and a deck has the same parts.
  const Json again = json_of({"certify", ordered, "--board", board, "--json", "-"});
  CHECK(again.at("board").at("stated").at("siemens") == used.at("siemens"));
  CHECK_THAT(again.at("board").at("stated").at("slowest_pole").get<double>(),
             WithinRel(used.at("slowest_pole").get<double>(), 1e-6));
  const ProcessResult deck = run_tool({"gen", ordered, "--budget", "1%", "--board", board});
  CHECK(deck.code == 0);
  CHECK_THAT(deck.output, ContainsSubstring("\nCbn0 n0 0 "));
  CHECK(run_tool({"gen", ordered, "--budget", "1%"}).output.find("\nCbn0 ") == std::string::npos);

  // ngspice settles as is certified, with the copper.
  const Json seen = json_of({"relax", ordered, "--board", board, "--json", "-"}).at("network");
  CHECK(seen.at("transient").at("judgement") == "settles");
  CHECK_THAT(seen.at("transient").at("settling_seconds").get<double>(),
             WithinRel(used.at("settling_seconds").get<double>(), 0.05));
  CHECK(run_tool({"relax", scene, "--board", board}).code == 2);
  CHECK_THAT(run_tool({"relax", folder.write("a.cir", deck.output), "--board", board}).errors,
             ContainsSubstring("is for scenes"));

  const std::string measured = folder / "measured.csv";
  CHECK(run_tool({"bench", ordered, "--simulate", measured}).code == 0);
  CHECK(run_tool({"bench", ordered, measured, "--out", folder / "bench"}).code == 0);
}
