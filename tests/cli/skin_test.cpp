// Skins on the command line: run, simulate, solve; and who does not know them says so.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tactile_net/realtime/load_plan.hpp"
#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;
using Json = nlohmann::json;

namespace {

const std::string skin =
    "title = \"A skin\"\n[units]\nlength = \"mm\"\nmodulus = \"MPa\"\nstress = \"kPa\"\n"
    "[sensor]\nrows = 5\ncolumns = 4\npitch = 1.0\ndepth = 1.0\n"
    "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"sphere\"\nradius = 1.5\nforce = 0.2\nfriction = 0.4\n"
    "[noise]\nrms = 0.02\n[reconstruct]\nalpha = 1e-4\n";

/// A .npy of doubles in C order.
std::string npy_of_doubles(const std::string& shape, const std::vector<double>& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(117, ' ');
  header += '\n';
  std::string text = "\x93NUMPY";
  text += '\x01';
  text += '\0';
  text += static_cast<char>(header.size());
  text += '\0';
  text += header;
  text.append(reinterpret_cast<const char*>(values.data()), 8 * values.size());
  return text;
}

std::vector<double> numbers(const std::string& row) {
  std::vector<double> all;
  for (std::size_t at = 0; at < row.size();) {
    all.push_back(std::stod(row.substr(at)));
    const std::size_t comma = row.find(',', at);
    if (comma == row.npos) break;
    at = comma + 1;
  }
  return all;
}

}  // namespace

TEST_CASE("run of a skin says force, drag and place, and draws maps", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  const ProcessResult result = run_tool({"run", path, "--out", folder / "out"});
  CAPTURE(result.errors, result.output);
  REQUIRE(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("normal force"));
  CHECK_THAT(result.output, ContainsSubstring("5 x 4 taxels"));
  const std::string html = read_text(folder / "out/report.html");
  for (const char* part :
       {"What was found", "id=\"frames\"", "data-view=\"tractions\"", "data-view=\"pad\"",
        "prefers-color-scheme", "readings.csv", "tractions.csv"})
    CHECK_THAT(html, ContainsSubstring(part));
  const Json json = Json::parse(read_text(folder / "out/result.json"));
  CHECK(json["kind"] == "run");
  const std::size_t cells = json["grid"]["y"].size() * json["grid"]["z"].size();
  const Json& answer = json["reconstructions"][0];
  CHECK(answer["tractions"]["tangential_z"].size() == cells);
  CHECK_THAT(answer["resultant"]["normal"]["value"].get<double>(), WithinAbs(0.2, 0.02));
  CHECK_THAT(read_text(folder / "out/tractions.csv"),
             ContainsSubstring("y,z,normal,tangential_y,tangential_z,normal_deviation"));
}

TEST_CASE("run says which frame of a scene over time it solves, of a skin as of a line",
          "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin + "[time]\nrate = 100.0\nframes = 3\n");
  const ProcessResult result =
      run_tool({"run", path, "--frame", "1", "--json", folder / "run.json"});
  CHECK_THAT(result.output, ContainsSubstring("one of 3 frames: frame 1 at t = 0.01"));
  CHECK(Json::parse(read_text(folder / "run.json"))["frame"]["index"] == 1);
}

TEST_CASE("what simulate records of a skin, solve finds as run does", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "g.csv", "--truth", folder / "f.csv"})
              .code == 0);
  const std::string csv = read_text(folder / "g.csv");
  CHECK(csv.starts_with("stress_x_0_0,stress_x_0_1"));
  CHECK(read_text(folder / "f.csv").starts_with("normal_0_0,normal_0_1"));
  const ProcessResult solved = run_tool({"solve", path, "--readings", folder / "g.csv", "-q", "-o",
                                         folder / "t.csv", "--uncertainty", folder / "u.csv",
                                         "--out", folder / "page", "--json", folder / "s"});
  CAPTURE(solved.errors);
  REQUIRE(solved.code == 0);
  const Json run = Json::parse(run_tool({"run", path, "--json", "-"}).output);
  const Json json = Json::parse(read_text(folder / "s"));
  CHECK(json["kind"] == "solve");
  const double force = run["reconstructions"][0]["resultant"]["normal"]["value"];
  CHECK_THAT(json["rows"][0]["resultant"]["normal"]["value"].get<double>(), WithinRel(force, 1e-9));
  CHECK(read_text(folder / "u.csv").starts_with("normal,normal_deviation"));
  CHECK_THAT(read_text(folder / "page/report.html"), ContainsSubstring("hardest press"));

  SECTION("and of an array (frames, rows, columns, channels)") {
    const std::vector<double> channels_first = numbers(csv.substr(csv.find('\n') + 1));
    REQUIRE(channels_first.size() == 60);
    std::vector<double> channels_last;
    for (std::size_t taxel = 0; taxel < 20; ++taxel)
      for (std::size_t c = 0; c < 3; ++c) channels_last.push_back(channels_first[20 * c + taxel]);
    folder.write("g.npy", npy_of_doubles("(1, 5, 4, 3)", channels_last));
    const ProcessResult same = run_tool({"solve", path, "--readings", folder / "g.npy", "-q", "-o",
                                         folder / "n.csv", "--json", folder / "n"});
    CAPTURE(same.errors);
    REQUIRE(same.code == 0);
    CHECK(Json::parse(read_text(folder / "n"))["rows"][0]["resultant"] ==
          json["rows"][0]["resultant"]);
  }
  SECTION("but not where rows and columns are exchanged: both shapes are named") {
    folder.write("g.npy", npy_of_doubles("(1, 4, 5, 3)", std::vector<double>(60)));
    const ProcessResult bad = run_tool({"solve", path, "--readings", folder / "g.npy", "-q"});
    CHECK(bad.code != 0);
    CHECK_THAT(bad.errors, ContainsSubstring("(1, 4, 5, 3)") &&
                               ContainsSubstring("(frames, 5, 4, 3)") &&
                               ContainsSubstring("swapaxes"));
  }
}

/// What a page's script draws.
Json frames_of_page(const std::string& page) {
  const std::string begin = "<script type=\"application/json\">";
  const std::size_t at = page.find(begin) + begin.size();
  return Json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST_CASE("the data of a skin's page name its dead taxels", "[cli][skin]") {
  const Folder folder;
  const auto dead = [&](const std::string& more) {
    const ProcessResult result =
        run_tool({"run", folder.write("skin.toml", skin + more), "--out", folder / "out"});
    CAPTURE(result.errors);
    REQUIRE(result.code == 0);
    const Json data = frames_of_page(read_text(folder / "out/report.html"));
    CHECK(data["taxels"]["y"].size() == 20);
    return data["taxels"]["dead"].get<std::vector<std::size_t>>();
  };
  CHECK(dead("").empty());
  CHECK(dead("[dead_taxels]\nindices = [3, 7]\n") == std::vector<std::size_t>{3, 7});
}

TEST_CASE("solve of a skin: what --missing says becomes of frames", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "g.csv"}).code == 0);
  const std::string csv = read_text(folder / "g.csv");
  const std::string head = csv.substr(0, csv.find('\n') + 1);
  const std::string row = csv.substr(head.size());
  const std::string gap = row.substr(row.find(','));  // the first is missing
  folder.write("gap.csv", head + row + gap + row);
  const auto solve = [&](const std::string& missing) {
    return run_tool({"solve", path, "--readings", folder / "gap.csv", "--missing", missing, "-o",
                     folder / "t.csv", "--uncertainty", folder / "u.csv", "--json", folder / "s",
                     "--out", folder / missing});
  };
  const ProcessResult failed = solve("fail");
  CHECK(failed.code == 2);
  CHECK_THAT(failed.errors, ContainsSubstring("gap.csv:3:") && ContainsSubstring("--missing") &&
                                ContainsSubstring("1 frame before it was written to"));
  CHECK_FALSE(std::filesystem::exists(folder / "t.csv"));

  const ProcessResult skipped = solve("skip");
  CAPTURE(skipped.errors);
  REQUIRE(skipped.code == 0);
  CHECK_THAT(skipped.errors, ContainsSubstring("1 of 3 frames misses readings, and its row is "
                                               "empty: frame 1"));
  Json json = Json::parse(read_text(folder / "s"));
  CHECK(json["rows"][1]["verdict"] == "failed");
  CHECK(json["rows"][1]["resultant"].is_null());
  CHECK(json["rows"][0]["missing"].is_null());
  CHECK(json["rows"][1]["missing"] == "skipped");
  CHECK_THAT(read_text(folder / "skip/report.html"),
             ContainsSubstring("frames miss readings and have no answer: frame 1"));
  // The frames at both sides of the gap are drawn.
  const Json page = frames_of_page(read_text(folder / "skip/report.html"));
  CHECK(page["frames"]["number"] == Json{0, 2});
  CHECK(page["courses"][0]["lines"][0]["y"].size() == 2);
  const std::string forces = read_text(folder / "u.csv");
  CHECK_THAT(forces,
             ContainsSubstring(",verdict\n") && ContainsSubstring(",missing\n") &&
                 ContainsSubstring("angle_deviation,slip_margin,slip_margin_deviation,data,alpha"));
  CHECK(json["rows"][2]["resultant"] == json["rows"][0]["resultant"]);
  CHECK_THAT(read_text(folder / "skip/report.html"), !ContainsSubstring(" -L"));
  const std::string rows = read_text(folder / "t.csv");
  CHECK(std::count(rows.begin(), rows.end(), '\n') == 4);

  const ProcessResult estimated = solve("estimate");
  CAPTURE(estimated.errors);
  REQUIRE(estimated.code == 0);
  CHECK_THAT(estimated.errors, ContainsSubstring("solved from the other taxels: frame 1"));
  json = Json::parse(read_text(folder / "s"));
  CHECK(json["rows"][1]["missing"] == "estimated");
  CHECK_THAT(read_text(folder / "estimate/report.html"),
             ContainsSubstring("are solved without the taxels that miss: frame 1"));
  const double whole = json["rows"][0]["resultant"]["normal"]["value"];
  CHECK_THAT(json["rows"][1]["resultant"]["normal"]["value"].get<double>(), WithinRel(whole, 0.1));
  CHECK(json["rows"][1]["resultant"] != json["rows"][0]["resultant"]);

  folder.write("none.csv", head);
  const ProcessResult empty = run_tool({"solve", path, "--readings", folder / "none.csv", "-o",
                                        folder / "e.csv", "--out", folder / "empty"});
  CAPTURE(empty.errors);
  CHECK(empty.code == 0);  // as of a line
  CHECK_THAT(empty.errors, ContainsSubstring("0 frames: the recording holds none"));
  CHECK_THAT(read_text(folder / "empty/report.html"), ContainsSubstring("holds no frame"));
}

TEST_CASE("solve of a skin: neighbours share an alpha, and offsets are found", "[cli][skin]") {
  const Folder folder;
  std::string text = skin;
  const std::string ruled = text.replace(text.find("alpha = 1e-4"), 12, "alpha = \"aicc\"");
  const std::string path = folder.write("skin.toml", ruled + "offset = true\n");
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "g.csv"}).code == 0);
  const ProcessResult solved = run_tool({"solve", path, "--readings", folder / "g.csv", "-q", "-o",
                                         folder / "t.csv", "--share-alpha", "3"});
  CAPTURE(solved.errors);
  CHECK(solved.code == 0);
  const ProcessResult ran = run_tool({"run", path, "--json", folder / "run.json"});
  const Json json = Json::parse(read_text(folder / "run.json"))["reconstructions"][0];
  REQUIRE(json["notes"].size() == 1);
  const auto note = json["notes"][0].get<std::string>();
  CHECK_THAT(note, ContainsSubstring("an offset that is not known"));
  CHECK(json["warnings"].dump().find(note) == std::string::npos);
  CHECK_THAT(ran.output,
             ContainsSubstring("\nnote: " + note + '\n') && !ContainsSubstring("warning: " + note));
  CHECK_THAT(run_tool({"solve", path, "--readings", folder / "g.csv", "--share-alpha", "0"}).errors,
             ContainsSubstring("at least 1 frame"));
  const std::string given = folder.write("given.toml", skin);
  CHECK_THAT(
      run_tool({"solve", given, "--readings", folder / "g.csv", "--share-alpha", "3"}).errors,
      ContainsSubstring("needs an alpha that a rule chooses"));
}

TEST_CASE("readings and alphas that no double can take are refused", "[cli][skin]") {
  const Folder folder;
  std::string rough = skin;
  rough.replace(rough.find("alpha = 1e-4"), 12, "alpha = 1e-10");
  const std::string path = folder.write("skin.toml", rough);
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "g.csv"}).code == 0);
  const std::string csv = read_text(folder / "g.csv");
  const std::string head = csv.substr(0, csv.find('\n') + 1);
  std::string huge = "9e304";
  for (int i = 1; i < 60; ++i) huge += i % 2 == 0 ? ",9e304" : ",-9e304";
  folder.write("huge.csv", head + huge + "\n");
  const ProcessResult refused = run_tool({"solve", path, "--readings", folder / "huge.csv", "-q"});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.errors, ContainsSubstring("huge.csv") && ContainsSubstring("overflow"));
  std::string small = skin;
  small.replace(small.find("alpha = 1e-4"), 12, "alpha = 1e-300");
  const ProcessResult deficient = run_tool({"run", folder.write("small.toml", small)});
  CHECK(deficient.code == 1);
  CHECK_THAT(deficient.output + deficient.errors, ContainsSubstring("raise alpha"));
}

TEST_CASE("a skin's sketch, its spacing and a single taxel are said as they are", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin + "spacing = 0.45\n");
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "g.csv"}).code == 0);
  CHECK_THAT(run_tool({"init", "--from-csv", folder / "g.csv"}).errors,
             ContainsSubstring("is a recording of a skin") && ContainsSubstring("scenes/skins"));
  CHECK_THAT(run_tool({"run", path}).output, ContainsSubstring("spacing = 450 µm was asked"));
  std::string one = skin;
  one.replace(one.find("rows = 5\ncolumns = 4"), 20, "rows = 1\ncolumns = 1");
  CHECK_THAT(run_tool({"run", folder.write("one.toml", one)}).output,
             ContainsSubstring(" 1 taxel, "));
}

TEST_CASE("a skin's plan is made, said and loaded", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  const ProcessResult planned =
      run_tool({"plan", path, "-o", folder / "skin.plan", "--json", folder / "plan.json"});
  CAPTURE(planned.errors);
  REQUIRE(planned.code == 0);
  CHECK_THAT(planned.output, ContainsSubstring("reflections"));
  const EstimatorPlan plan = load_plan(folder / "skin.plan");
  REQUIRE(plan.cells);
  CHECK(plan.values == plan.cells->rows * plan.cells->columns);
  const auto json = nlohmann::json::parse(read_text(folder / "plan.json"));
  CHECK(json.at("tractions") == plan.tractions());
  CHECK(json.at("filled_readings") == 0);
  CHECK(json.at("units").at("force") == "N");  // a point's load
  CHECK_THAT(run_tool({"plan", path, "--allow-fft"}).errors, ContainsSubstring("is of a skin"));
  CHECK_THAT(run_tool({"plan", path, "--structure", "fft"}).errors, ContainsSubstring("of a skin"));
}

namespace {
void check_circuit(const std::string& path, std::size_t side) {
  const Folder folder;
  const std::string count = std::to_string(side);
  const std::string nodes = std::to_string(3 * side * side) + " nodes";
  const ProcessResult certified = run_tool({"certify", path, "--out", folder / "out"});
  CAPTURE(certified.errors, certified.output);
  REQUIRE(certified.code == 0);
  CHECK_THAT(certified.output, ContainsSubstring("least_squares: stable"));
  const std::string html = read_text(folder / "out/report.html");
  CHECK_THAT(html,
             ContainsSubstring("A skin of " + count + " x " + count + " x 3 as two crossbars"));
  CHECK_THAT(html, ContainsSubstring("hardest at y = "));

  const ProcessResult relaxed = run_tool({"relax", path, "--json", "-"});
  CAPTURE(relaxed.errors);
  REQUIRE(relaxed.code == 0);
  const Json network = Json::parse(relaxed.output).at("network");
  CHECK(network.at("nodes") == 3 * side * side);
  CHECK(network.at("names").at(side * side + 1) == "qy_0_1");
  CHECK(network.at("difference_to_direct").get<double>() <
        network.at("difference_limit").get<double>() +
            1.2 * network.at("difference_predicted").get<double>());

  // The deck stands for itself: ngspice finds in it what its header expects.
  REQUIRE(run_tool({"gen", path, "-o", folder / "skin.cir"}).code == 0);
  CHECK_THAT(read_text(folder / "skin.cir"), ContainsSubstring("Node p_r_c, qy_r_c and qz_r_c"));
  const ProcessResult deck = run_tool({"relax", folder / "skin.cir"});
  CAPTURE(deck.errors, deck.output);
  CHECK(deck.code == 0);
  CHECK_THAT(deck.output, ContainsSubstring(nodes));
}
}  // namespace

TEST_CASE("a skin's circuit is certified, relaxed and written as a deck", "[cli][skin]") {
  const Folder folder;
  check_circuit(small_skin_circuit(folder), 3);
}

TEST_CASE("the circuit of the skin that is shipped is, too", "[cli][skin][long]") {
  check_circuit(scene("skins/circuit.toml"), 4);
}

TEST_CASE("what no circuit of a skin holds is refused by name", "[cli][skin]") {
  const Folder folder;
  const auto refused = [&](const std::string& more, const char* realization) {
    const ProcessResult result =
        run_tool({"gen", folder.write("skin.toml", skin + more), "--realization", realization});
    CHECK(result.code != 0);
    return result.errors;
  };
  CHECK_THAT(refused("friction_limit = 0.5\n", "least_squares"),
             ContainsSubstring("is linear, and holds no constraints") &&
                 ContainsSubstring("friction_limit"));
  CHECK_THAT(
      refused("spacing = 0.5\n", "ideal"),
      ContainsSubstring("branches of P, more than 20000") && ContainsSubstring("least_squares"));
  CHECK_THAT(refused("spacing = 0.25\n", "least_squares"),
             ContainsSubstring("amplifiers, more than 1024"));
}

TEST_CASE("solve warns of a kernel that takes a curved skin for flat, and of no other",
          "[cli][skin]") {
  const Folder folder;
  for (const char* file : {"cap-taxels.csv", "cap.csv"})
    std::filesystem::copy_file(scene(std::string("recorded/curved-pad/") + file), folder / file);
  const std::string cap = read_text(scene("recorded/curved-pad/cap.toml"));
  const auto warned = [&](const std::string& text) {
    const ProcessResult result =
        run_tool({"solve", folder.write("cap.toml", text), "--readings", folder / "cap.csv"});
    CHECK(result.code == 0);
    return result.errors;
  };
  CHECK_THAT(warned(cap), !ContainsSubstring("flat"));
  // Of the hardest of its loads the flat layer misses 13.2 %, by the truth.
  const std::string said = warned(cap + "[reconstruct]\nkernel = \"flat\"\n");
  const std::string before =
      "tikhonov: warning: the skin is curved and kernel = \"flat\" takes it "
      "for flat: the force is about ";
  REQUIRE(said.find(before) != said.npos);
  CHECK_THAT(std::stod(said.substr(said.find(before) + before.size())), WithinAbs(13.2, 5.0));
}

TEST_CASE("check says what is wrong with a skin's recording", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin + "[time]\nrate = 100.0\nframes = 60\n");
  REQUIRE(run_tool({"simulate", path, "-q", "-o", folder / "clean.csv"}).code == 0);
  const ProcessResult clean =
      run_tool({"check", path, "--readings", folder / "clean.csv", "--strict"});
  CAPTURE(clean.errors, clean.output);
  CHECK(clean.code == 0);
  CHECK_THAT(clean.output,
             ContainsSubstring("5 x 4 taxels") && ContainsSubstring("nothing suspicious"));
  // Row 2, column 1 is silent.
  REQUIRE(run_tool({"simulate",
                    folder.write("dead.toml", skin + "[time]\nrate = 100.0\nframes = 60\n"
                                                     "[dead_taxels]\nindices = [[2, 1]]\n"),
                    "-q", "-o", folder / "dead.csv"})
              .code == 0);
  const ProcessResult dead = run_tool(
      {"check", path, "--readings", folder / "dead.csv", "--strict", "--json", folder / "json"});
  CAPTURE(dead.errors, dead.output);
  CHECK(dead.code != 0);
  CHECK_THAT(dead.output, ContainsSubstring("indices = [\"2_1\"]"));
  const Json json = Json::parse(read_text(folder / "json"));
  CHECK(json.at("findings").at(0).at("kind") == "dead_taxels");
  CHECK(json.at("findings").at(0).at("taxels") == Json{9});
  CHECK(json.at("units").at("force") == "N");
}

TEST_CASE("an option that is of lines says so of a skin", "[cli][skin]") {
  const Folder folder;
  const std::string path = folder.write("skin.toml", skin);
  CHECK_THAT(run_tool({"solve", path, "--method", "dft", "--readings", "x.csv"}).errors,
             ContainsSubstring("--method"));
}
