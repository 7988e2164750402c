// [units] and [calibration] through the command: raw numbers in, SI out.
#include <nlohmann/json.hpp>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

ProcessResult succeeded(const std::vector<std::string>& arguments, const std::string& input = {}) {
  ProcessResult result = run_tool(arguments, input);
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  return result;
}

const std::string counts_scene = scene("recorded/thin-pad-counts.toml");
const std::string counts = scene("recorded/thin-pad-counts.csv");

/// A pad with a contact, in mm, MPa and kPa; a calibration may follow.
const std::string fingertip =
    "[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"kPa\"\nforce = \"N/mm\"\n"
    "[sensor]\ncount = 31\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
    "[material]\nyoungs_modulus = 0.2\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 0.5\n"
    "[noise]\nrms = 0.02\n";

}  // namespace

TEST_CASE("the shipped recording in counts gives the tractions of the one in Pa", "[cli][units]") {
  const Folder folder;
  succeeded({"solve", counts_scene, "--readings", counts, "-o", folder / "f.csv", "--json",
             folder / "f.json"});
  succeeded({"solve", scene("recorded/thin-pad.toml"), "--readings", scene("recorded/thin-pad.csv"),
             "-o", folder / "g.csv", "--json", folder / "g.json"});
  const auto found = csv_rows(read_text(folder / "f.csv"));
  const auto expected = csv_rows(read_text(folder / "g.csv"));
  REQUIRE(found.size() == 7);
  REQUIRE(found.front().size() == expected.front().size());
  // But for counts of 10 Pa, beside noise of 53 Pa.
  for (std::size_t i = 0; i < found.size(); ++i)
    CHECK(relative_l2_error(found[i], expected[i]) < 0.03);
  const auto json = Json::parse(read_text(folder / "f.json"));
  CHECK(json.at("units") ==
        Json{{"length", "m"},
             {"stress", "Pa"},
             {"force", "N/m"},
             {"stated",
              {{"length", "mm"}, {"modulus", "MPa"}, {"stress", "kPa"}, {"force", "N/mm"}}}});
  CHECK(Json::parse(read_text(folder / "g.json")).at("units").at("stated").at("length") == "m");
}

TEST_CASE("what simulate writes is what solve reads, in counts too", "[cli][units]") {
  const Folder folder;
  const std::string plain = folder.write("plain.toml", fingertip);
  const std::string raw = folder.write(
      "raw.toml", fingertip + "[calibration]\ngain = 0.01\nbaseline = 2048\noffset = 0.5\n");
  succeeded({"simulate", plain, "-o", folder / "plain.csv"});
  succeeded({"simulate", raw, "-o", folder / "raw.csv"});
  const auto kilopascals = csv_rows(read_text(folder / "plain.csv")).front();
  const auto numbers = csv_rows(read_text(folder / "raw.csv")).front();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    CHECK_THAT(0.01 * (numbers[i] - 2048) + 0.5, WithinAbs(kilopascals[i], 1e-10));
  const auto f =
      csv_rows(succeeded({"solve", plain, "--readings", folder / "plain.csv"}).output).front();
  const auto g =
      csv_rows(succeeded({"solve", raw, "--readings", folder / "raw.csv"}).output).front();
  CHECK(relative_l2_error(g, f) < 1e-8);
  double force = 0.0;  // in SI: 500 N/m
  for (const double traction : f) force += 0.5e-3 * traction;
  CHECK_THAT(force, WithinRel(500.0, 0.05));
  // run writes its readings for solve as well.
  succeeded({"run", raw, "--out", folder / "out"});
  CHECK(relative_l2_error(csv_rows(read_text(folder / "out/readings.csv")).front(), numbers) <
        1e-12);
}

TEST_CASE("identify and grasp read counts as solve does", "[cli][units]") {
  const Folder folder;
  const auto traction = [&](const std::string& pad, const std::string& readings) {
    const std::string json = folder / "i.json";
    succeeded({"identify", pad, "--readings", readings, "--json", json});
    return Json::parse(read_text(json)).at("traction").get<double>();
  };
  CHECK_THAT(
      traction(counts_scene, counts),
      WithinRel(traction(scene("recorded/thin-pad.toml"), scene("recorded/thin-pad.csv")), 1e-3));
  for (const char* file :
       {"thin-pad-counts.toml", "thin-pad-counts.csv", "thin-pad-calibration.csv"})
    folder.write(file, read_text(scene(std::string("recorded/") + file)));
  std::string hand = read_text(scene("recorded/hand.toml"));
  for (std::size_t at = 0; (at = hand.find("\"thin-pad.", at)) != std::string::npos; at += 5)
    hand.replace(at, 9, "\"thin-pad-counts");
  folder.write("hand.toml", hand);
  const auto torque = [&](const std::string& file) {
    succeeded({"grasp", file, "--json", folder / "g.json"});
    return Json::parse(read_text(folder / "g.json"))
        .at("measured")
        .at("fingers")
        .at(0)
        .at("torques")
        .at(0)
        .at("value")
        .get<double>();
  };
  CHECK_THAT(torque(folder / "hand.toml"), WithinRel(torque(scene("recorded/hand.toml")), 0.01));
}

TEST_CASE("a plan takes the baseline of the recording's first frames with it", "[cli][units]") {
  const Folder folder;
  const std::string pad =
      fingertip +
      "[calibration]\ngain = 0.01\nbaseline_frames = [0, 1]\n[reconstruct]\nalpha = 1e-3\n";
  const std::string path = folder.write("pad.toml", pad);
  std::string header;
  std::vector<std::string> lines(3);
  for (int i = 0; i < 31; ++i) {
    const std::string comma = i == 0 ? "" : ",";
    header += comma + "stress_x_" + std::to_string(i);
    lines[0] += comma + std::to_string(500 + i);
    lines[1] += comma + std::to_string(502 + i);
    lines[2] += comma + std::to_string(600 + i + (i > 10 && i < 20 ? 1000 : 0));
  }
  const std::string frames = folder.write(
      "frames.csv", header + '\n' + lines[0] + '\n' + lines[1] + '\n' + lines[2] + '\n');
  const ProcessResult planned = succeeded(
      {"plan", path, "--readings", frames, "--accuracy", "1e-9", "-o", folder / "p.plan"});
  CHECK_THAT(planned.output,
             ContainsSubstring("the plan contains the scene's units and calibration\n"));
  const EstimatorPlan plan = load_plan(folder / "p.plan");
  REQUIRE(plan.baseline.size() == 31);
  CHECK(plan.baseline[3] == 504.0);

  const auto expected = csv_rows(succeeded({"solve", path, "--readings", frames}).output);
  ContactEstimator estimator(plan);
  std::vector<double> f(31);
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(csv_rows(read_text(frames)).at(2), estimate) == FrameStatus::ok);
  CHECK(relative_l2_error(f, expected.at(2)) < 1e-6);

  const ProcessResult without = succeeded({"plan", path, "-o", folder / "q.plan"});
  CHECK_THAT(without.output, ContainsSubstring("call set_baseline with an unloaded frame"));
}

TEST_CASE("the time of a frame that is kept for the baseline is its own", "[cli][units]") {
  const Folder folder;
  const std::string path =
      folder.write("pad.toml",
                   "[sensor]\ncount = 2\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\"]\n"
                   "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.3\n"
                   "[calibration]\nbaseline_frames = [0, 1]\n[reconstruct]\nalpha = 1e-3\n");
  const auto answers = csv_rows(succeeded({"solve", path, "--readings", "-"},
                                          "t,stress_x_0,stress_x_1\n5,1,1\n6,3,3\n7,2,2\n")
                                    .output);
  REQUIRE(answers.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(answers[i][0] == 5.0 + static_cast<double>(i));
  CHECK(answers[2][1] == 0.0);
}
