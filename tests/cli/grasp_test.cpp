#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

std::string finger_table(const std::string& name, double side, const std::string& contact,
                         const std::string& more = {}) {
  const std::string sign = side < 0.0 ? "-" : "";
  const std::string back = side < 0.0 ? "" : "-";
  return "[[finger]]\nname = \"" + name + "\"\nbase = [" + sign +
         "0.03, 0.0]\ndirection = 90\nlinks = [0.05, 0.04]\nangles = [" + back + "30, " + sign +
         "30]\npad = { center = 0.02, half_width = 0.012, side = \"" +
         (side < 0.0 ? "right" : "left") + "\" }\ncontact = " + contact + "\n" + more;
}

const std::string degrees = "angles_in = \"degrees\"\n";
const std::string load = "[load]\nforce = [0.0, -4.0]\npoint = [0.0, 0.06]\n";
const std::string squeezed = "[grasp]\ngrasping_force = 10.0\nfriction = 0.6\n";

std::string resultant(double normal, double tangential, const std::string& more = {}) {
  return "{ normal = " + std::to_string(normal) + ", tangential = " + std::to_string(tangential) +
         ", center = 0.0" + more + " }";
}

ProcessResult grasp(const Folder& folder, const std::string& toml,
                    std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"grasp", folder.write("hand.toml", toml)});
  return run_tool(more);
}

Json grasp_json(const Folder& folder, const std::string& toml, int code = 0) {
  const ProcessResult result = grasp(folder, toml, {"--json", "-"});
  CAPTURE(result.errors);
  REQUIRE(result.code == code);
  return Json::parse(result.output);
}

}  // namespace

TEST_CASE("grasp says what forces mean and what would hold the load", "[cli]") {
  const Folder folder;
  const std::string deviations =
      ", normal_deviation = 0.1, tangential_deviation = 0.1, center_deviation = 1e-4";
  const std::string hand = degrees + load + squeezed +
                           finger_table("left", -1.0, resultant(5.0, -2.0, deviations)) +
                           finger_table("right", 1.0, resultant(5.0, -2.0, deviations));
  const ProcessResult result = grasp(folder, hand, {"--out", folder / "out"});
  CAPTURE(result.errors);
  CHECK(result.code == 0);
  for (const char* words : {"what the measured forces mean", "what would hold the load",
                            "the deviations explain it", "condition number", "report: "})
    CHECK_THAT(result.output, ContainsSubstring(words));
  const std::string page = read_text(folder / "out/report.html");
  for (const char* words : {"<svg class=\"hand\"", "class=\"cone\"", "measured head", "held head",
                            "load head", "figcaption", "prefers-color-scheme: dark"})
    CHECK_THAT(page, ContainsSubstring(words));
  const Json json = grasp_json(folder, hand);
  CHECK(Json::parse(read_text(folder / "out/result.json")) == json);

  // The pads stand upright at X = -+0.035; by symmetry each carries half the load.
  const double height = 0.05 * std::cos(M_PI / 6.0) + 0.02;
  for (const char* kind : {"measured", "held"}) {
    const Json& left = json.at(kind).at("fingers").at(0);
    CHECK_THAT(left.at("force").at(0).get<double>(), WithinRel(5.0, 1e-12));
    CHECK_THAT(left.at("force").at(1).get<double>(), WithinRel(2.0, 1e-12));
    const Json& torques = left.at("torques");
    CHECK_THAT(torques.at(0).at("value").get<double>(),
               WithinRel(-0.025 * 2.0 - height * 5.0, 1e-12));
    CHECK_THAT(torques.at(1).at("value").get<double>(), WithinRel(-0.02 * 5.0, 1e-12));
    CHECK(torques.at(0).at("left").is_null());
    CHECK_THAT(left.at("friction").at("distance").at("value").get<double>(),
               WithinRel((0.6 * 5.0 - 2.0) / std::sqrt(1.36), 1e-12));
  }
  CHECK(json.at("measured").at("unbalanced").at("balanced") == true);
  CHECK_THAT(json.at("measured").at("grasping_force").at("value").get<double>(),
             WithinRel(10.0, 1e-12));
  CHECK_THAT(json.at("held").at("fingers").at(0).at("torques").at(1).at("deviation").get<double>(),
             WithinRel(1e-4 * 5.0, 0.5));
  CHECK(json.at("held").at("thesis").at("difference").get<double>() < 1e-12);
  CHECK(json.at("fingers").at(0).at("source") == "resultant");
  CHECK(json.at("failures").empty());
  CHECK(grasp(folder, hand, {"--json", "-"}).output == grasp(folder, hand, {"--json", "-"}).output);
}

TEST_CASE("a grasp that cannot be is a failure, told as such", "[cli]") {
  const Folder folder;
  const ProcessResult result =
      grasp(folder, degrees + load + "[grasp]\ngrasping_force = 2.0\nfriction = 0.6\n" +
                        finger_table("left", -1.0, "{ center = 0.0 }") +
                        finger_table("right", 1.0, "{ center = 0.0 }"));
  CHECK(result.code == 1);
  CHECK_THAT(result.output, ContainsSubstring("FAILS: to hold: finger 'left' slips"));
  CHECK_THAT(result.errors, ContainsSubstring("error: to hold: finger 'left' slips"));
}

TEST_CASE("a fingertip's readings become torques with deviations", "[cli]") {
  const Folder folder;
  const ProcessResult result = run_tool({"grasp", scene("recorded/hand.toml"), "--json", "-"});
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const Json json = Json::parse(result.output);
  // The recording's true forces, from finite elements, times the pads' breadth.
  const double truth[2][3] = {{0.02 * 111.2945479999271, 0.02 * 55.671157254468426, 1.0628e-3},
                              {0.02 * 111.40612286429973, 0.02 * 33.43010548025151, 1.0368e-3}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& tip = json.at("fingers").at(i);
    CHECK(tip.at("source") == "readings");
    const char* keys[] = {"normal", "tangential", "centre"};
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = tip.at(keys[k]).at("value").get<double>();
      const double deviation = tip.at(keys[k]).at("deviation").get<double>();
      CHECK(deviation > 0.0);
      CHECK_THAT(value, WithinAbs(truth[i][k], 3.0 * deviation));
    }
    for (const Json& torque : json.at("measured").at("fingers").at(i).at("torques"))
      CHECK(torque.at("deviation").get<double>() > 0.0);
  }
  CHECK(json.at("measured").at("torque_covariance").at(0).at(1).get<double>() != 0.0);
  CHECK(json.at("measured").at("unbalanced").at("balanced") == true);
}

TEST_CASE("tractions of a file are a resultant too", "[cli]") {
  const Folder folder;
  folder.write("t.csv",
               "t,normal_0,normal_1,normal_2,tangential_0,tangential_1,tangential_2\n"
               "0,1,2,3,0,0,0\n1,100,300,100,10,20,30\n");
  const std::string tractions = "{ tractions = \"t.csv\", pitch = 0.01, frame = 1 }";
  const Json json = grasp_json(folder, degrees + finger_table("a", -1.0, tractions));
  CHECK_THAT(json.at("fingers").at(0).at("normal").at("value").get<double>(),
             WithinRel(5.0, 1e-14));
  CHECK_THAT(json.at("fingers").at(0).at("tangential").at("value").get<double>(),
             WithinRel(0.6, 1e-14));
  CHECK(json.at("fingers").at(0).at("centre").at("value") == 0.0);
}

TEST_CASE("what grasp cannot use is refused", "[cli]") {
  const Folder folder;
  folder.write("pull.csv", "normal_0,normal_1\n-1,-2\n1,-0.9999\n");
  folder.write("idle.toml",
               "[sensor]\ncount = 5\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n"
               "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n");
  const auto refused = [&](const std::string& toml, int code, const std::string& words) {
    const ProcessResult result = grasp(folder, toml);
    CAPTURE(words);
    CHECK(result.end == ProcessResult::End::exited);
    CHECK(result.code == code);
    CHECK_THAT(result.errors, ContainsSubstring(words));
    CHECK(result.output.empty());
  };
  const auto one = [&](const std::string& contact) {
    return degrees + finger_table("index", -1.0, contact);
  };
  CHECK(run_tool({"grasp"}).code == 2);
  CHECK_THAT(run_tool({"grasp", folder / "no.toml"}).errors, ContainsSubstring("no such file"));
  CHECK_THAT(run_tool({"grasp", folder.path().string()}).errors, ContainsSubstring("is a folder"));
  CHECK_THAT(run_tool({"grasp", scene("nic.toml")}).errors,
             ContainsSubstring("[finger] is missing"));
  refused(one("{ normal = -1.0, tangential = 0.0, center = 0.0 }"), 2,
          "hand.toml:9:22: error: finger.contact.normal must be > 0 (got -1.0)");
  refused(one("{ center = 0.0 }"), 2, "nothing to compute");
  refused(one("{ tractions = \"no.csv\", pitch = 1e-3 }"), 2, "no.csv: error: cannot be opened");
  refused(one("{ tractions = \"pull.csv\", pitch = 1e-3, frame = 2 }"), 2, "it has 2 frames");
  refused(one("{ tractions = \"pull.csv\", pitch = 1e-3 }"), 1,
          "finger 'index', pull.csv, frame 0: the normal force is -0.003");
  refused(one("{ tractions = \"pull.csv\", pitch = 1e-3, frame = 1 }"), 1, "outside the fingertip");
  refused(one("{ scene = \"no.toml\" }"), 2, "no.toml: error: no such file");
  refused(one("{ scene = \"idle.toml\" }"), 2, "nothing presses on this fingertip");
  refused(one("{ scene = \"idle.toml\", readings = \"pull.csv\" }"), 2,
          "pull.csv:1:1: error: the file that the hand refers to is not in order here");
  // The same contact twice.
  refused(load + squeezed + finger_table("a", -1.0, "{ center = 0.0 }") +
              finger_table("b", -1.0, "{ center = 0.0 }"),
          2, "the contacts coincide");
}
