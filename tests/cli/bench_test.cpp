// `bench` as a user has it: a board that is simulated with a fault, the fault named; and `relax`
// with a vendor's macromodel.
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

const std::string board_scene = SCENES "/circuits/bench.toml";

ProcessResult diagnosed(const Folder& folder, const std::vector<std::string>& more) {
  const std::string file = folder / "board.csv";
  std::vector<std::string> simulate = {"bench", board_scene, "--simulate", file};
  simulate.insert(simulate.end(), more.begin(), more.end());
  REQUIRE(run_tool(simulate).code == 0);
  return run_tool({"bench", board_scene, file, "--json", "-", "-q"});
}

}  // namespace

TEST_CASE("a healthy board passes, and its report has the correction", "[cli][bench]") {
  const Folder folder;
  const ProcessResult found = diagnosed(folder, {"--seed", "3"});
  CHECK(found.code == 0);
  const Json told = Json::parse(found.output);
  CHECK(told.at("kind") == "bench");
  CHECK(told.at("verdict") == "healthy");
  CHECK(told.at("error").get<double>() > 2e-3);
  CHECK(told.at("remaining").get<double>() < 1e-3);
  CHECK(told.at("self_test").at("limit").get<double>() > 2e-3);
  CHECK(told.at("correction").size() == 8);

  const std::string out = folder / "out";
  const ProcessResult page = run_tool({"bench", board_scene, folder / "board.csv", "--out", out});
  CHECK(page.code == 0);
  CHECK_THAT(page.output, ContainsSubstring("healthy: tolerances and noise explain"));
  CHECK_THAT(read_text(out + "/report.html"), ContainsSubstring("healthy: tolerances"));
  CHECK(lines_of(read_text(out + "/correction.csv")).size() == 9);
  CHECK(Json::parse(read_text(out + "/bench.json")).at("verdict") == "healthy");
}

TEST_CASE("a board with a fault fails, and the fault is named", "[cli][bench]") {
  const Folder folder;
  const ProcessResult open = diagnosed(folder, {"--fault", "open:Rk3_3p", "--seed", "5"});
  CHECK(open.code == 1);
  const Json told = Json::parse(open.output);
  CHECK(told.at("verdict") == "not_told_apart");  // from its twin
  const Json& first = told.at("faults").at(0);
  CHECK(first.at("kind") == "open");
  CHECK_THAT(first.at("part").get<std::string>(), StartsWith("Rk3_3"));
  CHECK_FALSE(told.at("faults").at(2).at("named").get<bool>());
  CHECK_THAT(open.errors, ContainsSubstring("is open"));
  CHECK(told.at("remaining").get<double>() < 2e-3);

  // Two faults at once are none that one explains.
  CHECK(Json::parse(diagnosed(folder, {"--fault", "open:Rk3_3p,tenth:Rt5_5n"}).output)
            .at("verdict") == "not_explained");
  // Offsets are subtracted where the rest is measured.
  const std::vector<std::string> lines = lines_of(read_text(folder / "board.csv"));
  CHECK(lines.front() == "I0,I1,I2,I3,I4,I5,I6,I7,n0,n1,n2,n3,n4,n5,n6,n7");
  std::string shifted = lines.front() + "\n# at rest\n0,0,0,0,0,0,0,0,1,1,1,1,1,1,1,1\n";
  REQUIRE(diagnosed(folder, {"--seed", "3"}).code == 0);
  for (const std::string& line : lines_of(read_text(folder / "board.csv"))) {
    if (line == lines.front()) continue;
    std::istringstream fields(line);
    std::string field;
    for (int k = 0; std::getline(fields, field, ','); ++k) {
      if (k > 0) shifted += ',';
      shifted += k < 8 ? field : std::to_string(std::stod(field) + 1.0);
    }
    shifted += '\n';
  }
  CHECK(run_tool({"bench", board_scene, folder.write("shifted.csv", shifted), "-q"}).code == 0);
}

TEST_CASE("a file of responses that is wrong is refused at its line", "[cli][bench]") {
  const Folder folder;
  const std::string header = "I0,I1,I2,I3,I4,I5,I6,I7,n0,n1,n2,n3,n4,n5,n6,n7\n";
  const std::string row = "1e-3,0,0,0,0,0,0,0,1,2,3,4,5,6,7,8\n";
  const auto refused = [&](const std::string& text) {
    const ProcessResult result = run_tool({"bench", board_scene, folder.write("x.csv", text)});
    CHECK(result.code == 2);
    return result.errors;
  };
  CHECK_THAT(refused(""), ContainsSubstring("is empty"));
  CHECK_THAT(refused(header), ContainsSubstring("no pattern"));
  CHECK_THAT(refused("I0,n0\n1,2\n"), ContainsSubstring("not one column 'I1'"));
  CHECK_THAT(refused(header + "1,2\n"),
             ContainsSubstring("x.csv:2:1") && ContainsSubstring("2 fields, and the header 16"));
  CHECK_THAT(refused(header + row + "1e-3,0,0,0,0,0,0,0,1,2,3,x,5,6,7,8\n"),
             ContainsSubstring("x.csv:3:1") && ContainsSubstring("'x' is not a number"));
  CHECK_THAT(refused(header + "inf,0,0,0,0,0,0,0,1,2,3,4,5,6,7,8\n"),
             ContainsSubstring("'inf' is not"));
  const auto usage = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"bench", board_scene});
    const ProcessResult result = run_tool(arguments);
    CHECK(result.code == 2);
    return result.errors;
  };
  CHECK_THAT(usage({}), ContainsSubstring("MEASURED"));
  CHECK_THAT(usage({"x.csv", "--fault", "open:Rk3_3p"}), ContainsSubstring("--simulate"));
  CHECK_THAT(usage({"--simulate", folder / "y.csv", "--fault", "open:R99"}),
             ContainsSubstring("no resistor 'R99'"));
  CHECK_THAT(usage({"--simulate", folder / "y.csv", "--fault", "bent:Rk3_3p"}),
             ContainsSubstring("is no fault"));
  CHECK_THAT(usage({"--simulate", folder / "y.csv", "--fault", "swapped:Rk3_3p/Rk3_3p"}),
             ContainsSubstring("swaps a part with itself"));
  CHECK_FALSE(std::filesystem::exists(folder / "y.csv"));
}

TEST_CASE("relax runs a vendor's macromodel and refuses what is none", "[cli][spice][macromodel]") {
  const Folder folder;
  // As the scene's OPA1637: 4.6 MHz an output, 20 MHz, 100 dB, 7.5 V/us; 1 pF, 20 ohm.
  const std::string good =
      "* a vendor's\n.SUBCKT FDA 1 2 3 4 5 6 7\nCA 1 0 1p\nCB 2 0 1p\n"
      "GA 0 8 VALUE={LIMIT(1e-3*V(1,2), 0.2595e-3, -0.2595e-3)}\nRA 8 0 1e9\nCA2 8 0 34.6p\n"
      "EB 9 0 8 0 1\nRB 9 10 1k\nCB2 10 0 7.958p\nEP 11 0 POLY(2) 10 0 7 0 0 1 1\n"
      "EN 12 0 VALUE={V(7)-V(10)}\nROP 11 5 20\nRON 12 6 20\nIQ 3 4 1m\n.ENDS\n";
  const ProcessResult result =
      run_tool({"relax", board_scene, "--model", folder.write("good.lib", good)});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("as certified: with fda it settles in"));
  const auto refused = [&](const std::string& text) {
    const ProcessResult bad =
        run_tool({"relax", board_scene, "--model", folder.write("bad.lib", text)});
    CHECK(bad.code == 2);
    return bad.errors;
  };
  CHECK_THAT(refused(".SUBCKT FDA 1 2 3\nR1 1 2 1\n.ENDS\n"),
             ContainsSubstring("bad.lib:1:1") && ContainsSubstring("7 are expected: in_plus"));
  CHECK_THAT(refused("shell touch x\n"), ContainsSubstring("bad.lib"));
  CHECK_THAT(refused(".control\nshell touch x\n.endc\n"), ContainsSubstring("commands to ngspice"));
  const ProcessResult none = run_tool(
      {"relax", SCENES "/nic.toml", "--realization", "ideal", "--model", folder / "good.lib"});
  CHECK(none.code == 2);
  CHECK_THAT(none.errors, ContainsSubstring("has none"));
}
