// A newcomer's first fifteen minutes with their own recording: init, check, solve, identify, plan.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Arguments = std::vector<std::string>;

std::string output_of(const Arguments& arguments) {
  const ProcessResult result = run_tool(arguments);
  CAPTURE(arguments, result.errors);
  CHECK(result.code == 0);
  return result.output;
}

nlohmann::json json_of(const std::string& path) { return nlohmann::json::parse(read_text(path)); }

/// What follows init, and `more` for every command that reads the recording.
void go_on(const Folder& folder, const std::string& scene_file, const std::string& readings) {
  output_of({"check", scene_file, "--readings", readings, "--json", folder / "check.json"});
  output_of({"solve", scene_file, "--readings", readings, "--missing", "estimate", "--out",
             folder / "out"});
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("</html>"));
  CHECK_THAT(output_of({"identify", scene_file, "--readings", readings}),
             ContainsSubstring("stress_x"));
  CHECK_THAT(output_of({"plan", scene_file, "--readings", readings, "-o", folder / "pad.plan"}),
             ContainsSubstring("pad.plan"));
}

/// Two presses of 20 and 40 N/m with noise of 20 Pa, as a German spreadsheet saves them: a byte
/// order mark, semicolons, decimal commas, kPa, a value that is missing, and a column of remarks.
std::string spreadsheet(const Folder& folder) {
  const std::string toml = folder.write(
      "truth.toml",
      "[sensor]\ncount = 21\npitch = 0.5e-3\ndepth = 1.5e-3\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 0.2e6\npoisson_ratio = 0.48\n[forward]\nmodel = \"exact\"\n"
      "[noise]\nrms = 20.0\n[time]\nrate = 100.0\nframes = 120\n"
      "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.5e-3\ncenter = 0.6e-3\n"
      "trajectory = [{ t = 0.2, force = 0.0 }, { t = 0.3, force = 20.0 }, { t = 0.4, force = 0.0 },"
      "{ t = 0.7, force = 0.0 }, { t = 0.8, force = 40.0 }, { t = 0.9, force = 40.0 },"
      "{ t = 1.0, force = 0.0 }]\n");
  output_of({"simulate", toml, "-o", folder / "truth.csv"});
  std::istringstream lines(read_text(folder / "truth.csv"));
  std::string line;
  std::getline(lines, line);
  std::string text = "\xef\xbb\xbfZeit [s]";
  for (int taxel = 1; taxel <= 21; ++taxel) text += ";Druck " + std::to_string(taxel) + " [kPa]";
  text += ";Bemerkung\r\n";
  for (int frame = 0; std::getline(lines, line); ++frame) {
    std::istringstream fields(line);
    std::string field;
    std::string row;
    for (int column = 0; std::getline(fields, field, ','); ++column) {
      if (column > 0) field = std::to_string(std::stod(field) / 1000.0);
      std::replace(field.begin(), field.end(), '.', ',');
      row += frame == 60 && column == 9 ? "NaN;" : field + ';';
    }
    text += row + (frame == 0 ? "Beginn" : "") + "\r\n";
  }
  return folder.write("Messung vom Montag.csv", text);
}

}  // namespace

TEST_CASE("the first fifteen minutes with a recorded pad", "[cli][first-hour]") {
  const Folder folder;
  const std::string pad = GENERATE("thin-pad", "thick-pad");
  const Scene known = read_scene(scene("recorded/" + pad + ".toml"));
  const std::string csv = scene("recorded/" + pad + ".csv");
  const std::string made = folder / "pad.toml";
  const std::string told = output_of({"init", "--from-csv", csv, "-o", made, "--pitch",
                                      std::to_string(known.sensor.pitch), "--depth",
                                      std::to_string(known.sensor.depths[0]), "--modulus", "2e5",
                                      "--layer", std::to_string(known.material.layer->thickness)});
  CHECK_THAT(told,
             ContainsSubstring("readings of " + std::to_string(known.sensor.count) + " taxels") &&
                 ContainsSubstring("times in 't'") && ContainsSubstring("next: tactile-net check"));
  const Scene found = read_scene(made);
  CHECK(found.sensor.count == known.sensor.count);
  CHECK(found.sensor.pitch == known.sensor.pitch);
  CHECK(found.sensor.depths == known.sensor.depths);
  CHECK(found.sensor.reads == known.sensor.reads);
  CHECK(found.material.youngs_modulus == known.material.youngs_modulus);
  CHECK(found.material.poisson_ratio == known.material.poisson_ratio);
  REQUIRE(found.material.layer);
  CHECK(found.material.layer->thickness == known.material.layer->thickness);
  CHECK(found.forward == ForwardModel::exact);
  go_on(folder, made, csv);
  CHECK(json_of(folder / "check.json")["findings"].empty());
}

TEST_CASE("the first fifteen minutes with a German spreadsheet", "[cli][first-hour]") {
  const Folder folder;
  const std::string csv = spreadsheet(folder);
  const std::string made = folder / "pad.toml";
  const std::string told =
      output_of({"init", "--from-csv", csv, "-o", made, "--quantity", "stress_x", "--pitch", "0.5",
                 "--depth", "1.5", "--length-unit", "mm", "--modulus", "0.2", "--modulus-unit",
                 "MPa", "--poisson", "0.48"});
  CHECK_THAT(told, ContainsSubstring("23 columns, 21 of them readings of 21 taxels, "
                                     "'Druck 1 [kPa]' to 'Druck 21 [kPa]'; times in 'Zeit [s]'"));
  CHECK_THAT(told, ContainsSubstring("--readings '" + csv + "'"));  // as a shell takes it
  const Scene found = read_scene(made);
  REQUIRE(found.units);
  CHECK(found.units->stress.name == "kPa");
  CHECK(found.sensor.pitch == 0.5e-3);
  CHECK(found.material.youngs_modulus == 0.2e6);
  go_on(folder, made, csv);

  const nlohmann::json check = json_of(folder / "check.json");
  CHECK(check["frames"] == 120);
  CHECK_THAT(check["time"]["rate"].get<double>(), WithinRel(100.0, 1e-6));
  CHECK_THAT(check["channels"][0]["noise"].get<double>(), WithinRel(20.0, 0.2));  // SI
  CHECK_THAT(check["peak"]["force"].get<double>(), WithinRel(40.0, 0.03));
  REQUIRE(check["findings"].size() == 1);
  CHECK(check["findings"][0]["kind"] == "values_missing");
  CHECK(check["findings"][0]["frames"]["runs"] == nlohmann::json{{60, 60}});
  const nlohmann::json solved = json_of(folder / "out/result.json");
  CHECK(solved["frames"] == 120);
  CHECK(solved["missing"]["estimated"]["count"] == 1);
  CHECK(solved["findings"] == check["findings"]);
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("1 suspicion<"));
  REQUIRE(solved["shown"].size() == 120);
  for (const nlohmann::json& frame : solved["shown"]) {
    CHECK(frame["alpha"] >= solved["alpha_least"]);
    CHECK(frame["alpha"] <= solved["alpha_largest"]);
    CHECK(solved["verdicts"].contains(frame["verdict"].get<std::string>()));
  }
  CHECK_THAT(solved["shown"][85]["normal_force"].get<double>(), WithinRel(40.0, 0.03));

  // What check advises is taken back by the scene reader, and ends the suspicion.
  const std::string report = output_of({"check", made, "--readings", csv});
  CHECK_THAT(report, ContainsSubstring("under [noise], rms = 0.0"));  // kPa, as the file
}

TEST_CASE("a scene is written from what is answered on a terminal", "[cli][first-hour]") {
  const Folder folder;
  const std::string csv = folder.write("r.csv", "a_1,a_2,a_3\n1,2,3\n");
  const ProcessResult result =
      test::run_in_process({"init", "--from-csv", csv, "-o", folder / "pad.toml"},
                           "pressure\nstress_x\nmm\n\nkPa\n-2\n0.5\n1.5\n\n0.3e6\n0.47\n", true);
  CAPTURE(result.errors);
  REQUIRE(result.code == 0);
  const Scene found = read_scene(folder / "pad.toml");
  CHECK(found.sensor.count == 3);
  CHECK(found.sensor.reads == std::vector{Quantity::stress_x});
  CHECK(found.sensor.pitch == 0.5e-3);
  CHECK(found.sensor.depths == std::vector{1.5e-3});
  CHECK(found.material.youngs_modulus == 0.3e6);
  CHECK(found.material.poisson_ratio == 0.47);
  CHECK_FALSE(found.material.layer);
  CHECK(found.units->stress.name == "kPa");
  // Whoever leaves in the middle leaves nothing behind.
  CHECK(
      test::run_in_process({"init", "--from-csv", csv, "-o", folder / "b.toml"}, "stress_x\n", true)
          .code == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "b.toml"));
}

TEST_CASE("init names all that is missing at once, and replaces nothing unasked", "[cli]") {
  const Folder folder;
  const std::string csv = folder.write("r.csv", "a_1,a_2,a_3\n1,2,3\n");
  const ProcessResult bare = run_tool({"init", "--from-csv", csv});
  CHECK(bare.code == 2);
  CHECK_THAT(bare.errors, ContainsSubstring("--quantity, --pitch, --depth, --modulus") &&
                              ContainsSubstring("3 of them readings of 3 taxels"));
  Arguments whole{
      "init",    "--from-csv", csv,         "--quantity", "strain_x", "--pitch",          "1",
      "--depth", "1",          "--modulus", "1",          "-o",       folder / "pad.toml"};
  output_of(whole);
  const std::string first = read_text(folder / "pad.toml");
  whole[6] = "2";
  const ProcessResult again = run_tool(whole);
  CHECK(again.code == 2);
  CHECK_THAT(again.errors, ContainsSubstring("--force replaces it"));
  CHECK(read_text(folder / "pad.toml") == first);
  whole.push_back("--force");
  output_of(whole);
  CHECK(read_scene(folder / "pad.toml").sensor.pitch == 2.0);
  whole[6] = "-2";
  const ProcessResult wrong = run_tool(whole);
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.errors, ContainsSubstring("sensor.pitch must be > 0"));
  CHECK(read_scene(folder / "pad.toml").sensor.pitch == 2.0);
}

TEST_CASE("init understands columns however they are named", "[cli]") {
  const Folder folder;
  struct Case {
    std::string csv;
    Arguments more;
    std::size_t count;
    std::size_t channels;
    std::string columns;  // that the other commands need
  };
  const Case cases[] = {
      {"t,stress_x_0,stress_x_1,shear_xy_0,shear_xy_1\n0,1,2,3,4\n", {}, 2, 2, ""},
      {"stress_x_1,stress_x_2\n1,2\n", {}, 2, 1, ""},
      {"1,2,3\n4,5,6\n", {"--quantity", "stress_x"}, 3, 1, ""},
      {"stress_x@0_0,stress_x@0_1,stress_x@1_0,stress_x@1_1\n1,2,3,4\n",
       {"--depth", "2,3"},
       2,
       2,
       ""},
      {"zeit;p1;p2;q1;q2\n0;1,5;2;3;4\n", {"--quantity", "stress_x,shear_xy"}, 2, 2, "2-3,4-5"},
      {"when,x,a,b,c\n0,1,2,3,4\n",
       {"--quantity", "stress_x", "--columns", "t=1,3-5"},
       3,
       1,
       "t=1,3-5"},
      {"stress_x_0,stress_x_1,strain_x_0,strain_x_1\n1,2,3,4\n", {}, 2, 1, ""},
      {"stress_x_0,stress_x_1,strain_x_0,strain_x_1\n1,2,3,4\n", {"--noise", "1,1e-4"}, 2, 2, ""}};
  for (const Case& one : cases) {
    CAPTURE(one.csv);
    const std::string csv = folder.write("r.csv", one.csv);
    Arguments arguments{"init",      "--from-csv", csv,       "--pitch", "1",
                        "--modulus", "1",          "--force", "-o",      folder / "pad.toml"};
    if (std::find(one.more.begin(), one.more.end(), "--depth") == one.more.end())
      arguments.insert(arguments.end(), {"--depth", "1"});
    arguments.insert(arguments.end(), one.more.begin(), one.more.end());
    const std::string told = output_of(arguments);
    const Scene found = read_scene(folder / "pad.toml");
    CHECK(found.sensor.count == one.count);
    CHECK(channel_count(found.sensor) == one.channels);
    Arguments solve{"solve", folder / "pad.toml", "--readings", csv};
    if (!one.columns.empty()) {
      CHECK_THAT(told, ContainsSubstring("--columns " + one.columns));
      solve.insert(solve.end(), {"--columns", one.columns});
    }
    output_of(solve);
  }
}

TEST_CASE("a name that columns share is understood only where it is the only one", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const auto solve = [&](const std::string& csv) {
    return run_tool({"solve", path, "--readings", "-"}, csv);
  };
  const ProcessResult plain = solve("t,stress_x_0,stress_x_1,stress_x_2\n0,1,2,3\n");
  for (const char* header :
       {"t,p3,p1,p2\n0,3,1,2\n", "t,stress_x_3,stress_x_2,stress_x_1\n0,3,2,1\n",
        "Zeit;Druck 0;Druck 1;Druck 2;T1;T2\n0;1;2;3;9;9\n"}) {
    const ProcessResult other = solve(header);
    CHECK(other.output == plain.output);
    CHECK_THAT(other.errors, ContainsSubstring("note: "));
  }
  for (const char* header : {"p1,p2,p3,q1,q2,q3\n1,2,3,4,5,6\n", "p1,p2,p4\n1,2,3\n",
                             "strain_x_0,strain_x_1,strain_x_2\n1,2,3\n"})
    CHECK(solve(header).code == 2);
}

TEST_CASE("what check advises ends the suspicion", "[cli]") {
  const Folder folder;
  const std::string plain =
      "[sensor]\ncount = 15\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[units]\nlength = \"mm\"\nstress = \"kPa\"\nmodulus = \"MPa\"\n"
      "[material]\nyoungs_modulus = 0.2\npoisson_ratio = 0.45\n[noise]\nrms = 0.02\n";
  const std::string counts = plain + "[calibration]\ngain = 0.25\n";
  const std::string sensor = folder.write(
      "sensor.toml",
      counts +
          "baseline = [2040, 2055, 1999, 2031, 2044, 2071, 2003, 2012, 2090, 2021, 2037, 2066, "
          "2048, 2019, 2052]\n[time]\nrate = 100.0\nframes = 200\n"
          "[forward]\nmodel = \"exact\"\n[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.5\n"
          "trajectory = [{ t = 0.6, force = 0.0 }, { t = 1.0, force = 30.0 }, "
          "{ t = 1.4, force = 0.0 }]\n");
  const std::string csv = folder / "counts.csv";
  output_of({"simulate", sensor, "-o", csv});
  const std::string path = folder.write("pad.toml", counts);
  output_of({"check", path, "--readings", csv, "--json", folder / "check.json"});
  const nlohmann::json before = json_of(folder / "check.json")["findings"];
  REQUIRE(before.size() == 1);
  CHECK(before[0]["kind"] == "baseline");
  const std::string advice = before[0]["advice"];
  const std::string start = "under [calibration], ";
  REQUIRE(advice.starts_with(start + "baseline = ["));
  folder.write("pad.toml", counts + advice.substr(start.size()) + '\n');
  output_of({"check", path, "--readings", csv, "--json", folder / "check.json"});
  const nlohmann::json after = json_of(folder / "check.json");
  CHECK(after["findings"].empty());
  CHECK_THAT(after["peak"]["force"].get<double>(), WithinRel(30.0, 0.05));
}

TEST_CASE("check fails on suspicions only where that is asked for", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const std::string csv = folder.write("r.csv", "stress_x_0,stress_x_1,stress_x_2\n-1,-2,-1\n");
  const ProcessResult lenient = run_tool({"check", path, "--readings", csv});
  CHECK(lenient.code == 0);
  CHECK_THAT(lenient.output, ContainsSubstring("1. the whole pad is pulled in 1 of 1") &&
                                 ContainsSubstring("gain = -1"));
  const ProcessResult strict = run_tool({"check", path, "--readings", csv, "--strict"});
  CHECK(strict.code == 1);
  CHECK(strict.output == lenient.output);
  CHECK(run_tool({"check", path, "--readings", folder / "none.csv"}).code == 2);
  const ProcessResult json = run_tool({"check", path, "--readings", "-", "--json", "-"},
                                      "stress_x_0,stress_x_1,stress_x_2\n1,2,1\n");
  CHECK(nlohmann::json::parse(json.output)["findings"].empty());
}
