// A fingertip whose surface is a mesh, on the command line.
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

const std::string skins = SCENES "/skins/";

double value(const Json& number) { return number.at("value").get<double>(); }

}  // namespace

TEST_CASE("frames of a mesh scene are simulated, checked and solved", "[cli][skin][mesh]") {
  const Folder folder;
  const std::string scene = skins + "mesh-finger.toml";
  const std::string readings = folder / "readings.csv";
  const ProcessResult simulated = run_tool({"simulate", scene, "-q", "-o", readings});
  CAPTURE(simulated.errors);
  REQUIRE(simulated.code == 0);
  const ProcessResult checked = run_tool({"check", scene, "--readings", readings});
  CAPTURE(checked.output, checked.errors);
  CHECK(checked.code == 0);
  const ProcessResult solved =
      run_tool({"solve", scene, "--readings", readings, "--out", folder / "out", "-q"});
  CAPTURE(solved.errors);
  REQUIRE(solved.code == 0);
  const Json row = Json::parse(read_text(std::filesystem::path(folder / "out") / "result.json"))
                       .at("rows")
                       .at(0);
  const Json& resultant = row.at("resultant");
  // 0.5 N and 0.2 N press.
  CHECK(std::abs(value(resultant.at("normal")) - 0.7) <=
        3.0 * resultant.at("normal").at("deviation").get<double>());
  CHECK(resultant.at("normal").at("deviation").get<double>() <= 0.2);
  CHECK(value(resultant.at("force").at(2)) < -0.4);
  // The centre is below the mesh's top, 9 mm, and above where the taxels are.
  CHECK(value(resultant.at("centre_in_space").at(2)) > 7.4e-3);
  CHECK(value(resultant.at("centre_in_space").at(2)) < 9e-3);
  const std::string page = read_text(std::filesystem::path(folder / "out") / "report.html");
  CHECK_THAT(page, ContainsSubstring("\"surface\":{\"step\""));
  CHECK_THAT(page, ContainsSubstring("below a curved surface"));
}

TEST_CASE("a mesh that is not in order is refused by the scene that names it",
          "[cli][skin][mesh]") {
  const Folder folder;
  std::string text = read_text(skins + "mesh-finger.toml");
  folder.write("mesh-finger-taxels.csv", read_text(skins + "mesh-finger-taxels.csv"));
  std::string mesh = read_text(skins + "mesh-finger.obj");
  const std::string scene = folder.write("scene.toml", text);
  const auto refused = [&](const std::string& rule) {
    const ProcessResult result = run_tool({"run", scene, "--out", folder / "out"});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring(rule));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  };
  refused("no such file");
  folder.write("mesh-finger.obj", mesh + "f 1 2 9999\n");
  refused("triangle 1041 names vertex 9999 of 567");
  folder.write("mesh-finger.obj", mesh.substr(0, mesh.find("\nf ") + 1));
  refused("holds no face");
  folder.write("mesh-finger.obj", mesh);
  text.erase(text.find("unit = \"mm\""), 11);
  folder.write("scene.toml", text);
  refused("state the unit");
}
