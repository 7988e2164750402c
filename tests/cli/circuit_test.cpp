#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/catch.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

using Json = nlohmann::json;

const std::string small_circuit =
    "[sensor]\ncount = 7\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 1.0\nforce = 1.0\n"
    "[reconstruct]\nmethods = [\"network\"]\nalpha = 1e-3\nsmoothing_length = 1.0\n[network]\n";

constexpr const char* all_realizations[] = {"ideal",         "nic",     "rail", "crossbar",
                                            "least_squares", "lattice", "lc",   "ndr"};

const std::string ringing_converters =
    "realization = \"nic\"\nopamp = { bandwidth = 10e6 }\n"
    "parasitic = { node = 1e-11, input = 1e-11 }\n";

}  // namespace

TEST_CASE("every realisation is generated, runs in plain ngspice and is relaxed from its deck",
          "[cli][spice]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit);
  for (const std::string realization : all_realizations) {
    CAPTURE(realization);
    const std::string deck = folder / (realization + ".cir");
    REQUIRE(run_tool({"gen", path, "--realization", realization, "-o", deck}).code == 0);
    const ProcessResult plain = run_process({"ngspice", "-b", deck});
    CHECK(plain.code == 0);
    CHECK_THAT(plain.output, ContainsSubstring("v(n6)") && !ContainsSubstring("rror"));
    const ProcessResult relaxed = run_tool({"relax", deck});
    CHECK(relaxed.code == 0);
    CHECK_THAT(relaxed.output, ContainsSubstring("7 nodes") && ContainsSubstring("(agrees)"));
  }
}

TEST_CASE("with a bandwidth the transient stands beside the certificate", "[cli][spice]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit);
  for (const std::string realization : {"nic", "rail", "crossbar", "least_squares", "lattice"}) {
    CAPTURE(realization);
    const ProcessResult result =
        run_tool({"run", path, "--realization", realization, "--bandwidth", "1e6"});
    CHECK(result.code == 0);
    CHECK_THAT(result.output, ContainsSubstring("(agrees; the op-amps' gain and offset explain") &&
                                  ContainsSubstring("ngspice's transient settles in") &&
                                  ContainsSubstring("the certificate says"));
  }
}

TEST_CASE("an edited deck is compared with what its header states", "[cli][spice]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit);
  const std::string deck = folder / "x.cir";
  REQUIRE(run_tool({"gen", path, "-o", deck}).code == 0);
  std::string text = read_text(deck);
  const std::size_t at = text.find("\nR0_1 ");
  const std::size_t end = text.find('\n', at + 1);
  text.replace(at, end - at, "\nR0_1 n0 n1 1e4\r");
  const std::string edited = folder.write("edited.CIR", text);
  const ProcessResult result = run_tool({"relax", edited});
  CHECK(result.code == 1);
  CHECK_THAT(result.output, ContainsSubstring("(DIFFERS)") && ContainsSubstring("expected"));
  CHECK(run_tool({"relax", edited, "--tolerance", "10"}).code == 0);
  const std::size_t within = text.find("* within ");
  REQUIRE(within != std::string::npos);
  text.replace(within, text.find('\n', within) - within, "* within 10");
  const ProcessResult lenient = run_tool({"relax", folder.write("lenient.cir", text)});
  CHECK(lenient.code == 1);
  CHECK_THAT(lenient.errors, ContainsSubstring("proves nothing"));
  CHECK_THAT(run_tool({"relax", edited, "--json", "-"}).output, ContainsSubstring("\"expected\""));

  CHECK_THAT(run_tool({"relax", folder.write("empty.cir", "")}).errors,
             ContainsSubstring("states no voltage to compare with"));
  CHECK_THAT(run_tool({"relax", folder.write("bad.cir", "t\n* expect n0 two\n")}).errors,
             ContainsSubstring("bad.cir:2:1") && ContainsSubstring("does not end with a number"));
  CHECK_THAT(run_tool({"relax", folder / "none.cir"}).errors, ContainsSubstring("no such file"));
  CHECK(run_tool({"relax", deck, "--realization", "nic"}).code == 2);
}

TEST_CASE("a deck's header, and what is no deck, are told apart", "[cli][spice]") {
  const Folder folder;
  const std::string resistor = "T\n* EXPECT A 1\nr1 a 0 1k\ni1 0 a 1m\n";
  CHECK(run_tool({"relax", folder.write("s.cir", resistor + ".op\n.end\n")}).code == 0);
  CHECK_THAT(
      run_tool({"relax", folder.write("w.cir", resistor + "* within -1\n.op\n.end\n")}).errors,
      ContainsSubstring("must be >= 0"));
  std::filesystem::create_directory(folder / "d.cir");
  CHECK_THAT(run_tool({"relax", folder / "d.cir"}).errors, ContainsSubstring("is a folder"));
  CHECK_THAT(run_tool({"gen", folder / "s.cir"}).errors, ContainsSubstring("is a deck"));
}

TEST_CASE("devices driven far beyond their curve give no answer", "[cli][spice]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", small_circuit + "realization = \"ndr\"\ndevice_volts = 0.05\n");
  const ProcessResult result = run_tool({"relax", path});
  CHECK(result.code == 1);
  CHECK_THAT(result.errors, ContainsSubstring("too large for the devices"));
}

TEST_CASE("without a load nothing is divided by it", "[cli][spice]") {
  const Folder folder;
  std::string text = small_circuit;
  text.erase(text.find("[[contact]]"), text.find("[reconstruct]") - text.find("[[contact]]"));
  const std::string path = folder.write(
      "s.toml", text +
                    "realization = \"crossbar\"\nopamp = { bandwidth = 1e6, offset = 1e-4 }\n"
                    "settling = { accuracy = 1e-3 }\ntolerance = { relative = 0.01 }\n");
  const ProcessResult result = run_tool({"relax", path});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("there is no load"));
  CHECK_FALSE(std::regex_search(result.output, std::regex("\\b(nan|inf)\\b")));
  CHECK_THAT(run_tool({"certify", path}).output, ContainsSubstring("There is no load"));
  const std::string deck = folder / "s.cir";
  CHECK(run_tool({"gen", path, "-o", deck}).code == 0);
  CHECK(run_tool({"relax", deck}).code == 0);
}

TEST_CASE("certify says what is stable, what is not, and what to choose", "[cli]") {
  const Folder folder;
  const ProcessResult good = run_tool({"certify", scene("circuits/crossbar.toml")});
  CHECK(good.code == 0);
  CHECK_THAT(good.output,
             ContainsSubstring("crossbar: stable") && ContainsSubstring("theorem T5") &&
                 ContainsSubstring("settles within 0.001 in") && ContainsSubstring("realisation") &&
                 ContainsSubstring("With parts of 1 %"));
  const std::string ringing = folder.write("s.toml", small_circuit + ringing_converters);
  const ProcessResult bad = run_tool({"certify", ringing});
  CHECK(bad.code == 1);
  CHECK_THAT(bad.output, ContainsSubstring("UNSTABLE") &&
                             ContainsSubstring("does NOT apply here: capacitance") &&
                             ContainsSubstring("divider = 788 at most"));
  CHECK_THAT(bad.errors, ContainsSubstring("the circuit is not stable"));
  const std::string json =
      run_tool({"certify", scene("circuits/crossbar.toml"), "--json", "-"}).output;
  CHECK_THAT(json, StartsWith("{") && ContainsSubstring("\"tolerance_margin\"") &&
                       ContainsSubstring("\"recommendation\"") && !ContainsSubstring("nan"));
  CHECK(run_tool({"certify", scene("circuits/crossbar.toml"), "--json", "-"}).output == json);
}

TEST_CASE("an unstable circuit is called so by ngspice too", "[cli][spice]") {
  const Folder folder;
  const std::string ringing = folder.write(
      "s.toml", small_circuit +
                    "realization = \"nic\"\nopamp = { bandwidth = 10e6 }\nparasitic = { node = "
                    "1e-11, input = 1e-11 }\nsettling = { accuracy = 1e-3 }\n");
  const ProcessResult result = run_tool({"relax", ringing});
  CHECK(result.code == 1);
  CHECK_THAT(result.output, ContainsSubstring("transient GROWS at"));
  CHECK_THAT(result.errors, ContainsSubstring("the circuit is unstable"));
}

TEST_CASE("settling that nothing models is said, not invented", "[cli][spice]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", small_circuit + "settling = { accuracy = 1e-3 }\n");
  CHECK_THAT(run_tool({"relax", path}).output,
             ContainsSubstring("nothing here takes a time that is modelled"));
  for (const char* bandwidth : {"-1", "0", "inf", "nan"})
    CHECK(run_tool({"relax", path, "--bandwidth", bandwidth}).code == 2);
}

TEST_CASE("certify writes a page and the numbers behind its plots", "[cli]") {
  const Folder folder;
  const ProcessResult result =
      run_tool({"certify", scene("circuits/least-squares.toml"), "--out", folder / "out"});
  CHECK(result.code == 0);
  CHECK(result.errors.empty());
  CHECK_THAT(result.output, ContainsSubstring("report: "));
  const std::string html = read_text(folder / "out/report.html");
  CHECK_THAT(html, ContainsSubstring("least_squares: stable") && ContainsSubstring("yield"));
  const auto lines = [&](const char* name) {
    const std::string text = read_text(folder / ("out/" + std::string(name)));
    CHECK_THAT(html, ContainsSubstring("href=\"" + std::string(name) + "\""));
    return std::count(text.begin(), text.end(), '\n');
  };
  CHECK(lines("poles.csv") == 1 + 42);  // as many as states
  CHECK(lines("settling.csv") == 1 + 401);
  CHECK(lines("builds.csv") > 500);
  CHECK(lines("resistors.csv") > 10);
  CHECK(read_text(folder / "out/certificate.json") ==
        run_tool({"certify", scene("circuits/least-squares.toml"), "--json", "-"}).output);
}

TEST_CASE("certify refines a circuit in numbers, and says whether that pays", "[cli]") {
  const Folder folder;
  const std::string path = folder.write(
      "s.toml", small_circuit +
                    "realization = \"lattice\"\nopamp = { bandwidth = 10e6 }\n"
                    "tolerance = { relative = 0.01, trials = 40 }\nrefine = { cycles = 5 }\n");
  const std::string json = run_tool({"certify", path, "--json", "-"}).output;
  const Json refinement = Json::parse(json).at("refinement");
  CHECK(refinement.at("verdict") == "proven");
  CHECK(refinement.at("bits") == 12);
  const Json& trials = refinement.at("trials");
  CHECK(trials.at("builds") == 40);
  REQUIRE(trials.at("cycles").size() == 5);
  CHECK(trials.at("cycles").back().at("worst_error").get<double>() < 1e-6);
  // The first cycle is the circuit itself: the draws of its tolerance, and converters' noise.
  CHECK_THAT(trials.at("cycles")[0].at("p95_error").get<double>(),
             WithinRel(Json::parse(json).at("tolerance").at("p95_error").get<double>(), 0.25));
  CHECK(refinement.at("ways").back().at("way") == "numbers");
  CHECK(trials.at("cycle_products") > trials.at("frame_products"));

  const ProcessResult other =
      run_tool({"certify", path, "--refine", "bits=6,cycles=9,step=conjugate"});
  CHECK(other.code == 0);
  CHECK_THAT(other.output, ContainsSubstring("converters of 6 bits") &&
                               ContainsSubstring("steps: conjugate") &&
                               ContainsSubstring("no way to beat the digital frame"));
  const std::string out = folder / "out";
  CHECK(run_tool({"certify", path, "--out", out}).code == 0);
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("Does it pay?"));
  CHECK_THAT(read_text(folder / "out/refinement.csv"), ContainsSubstring("median build"));

  for (const std::string bad :
       {"bits=3", "cycles=0", "gain=0.6", "step=long", "noise", "speed=2"}) {
    CAPTURE(bad);
    const ProcessResult result = run_tool({"certify", path, "--refine", bad});
    CHECK(result.code == 2);
    CHECK_THAT(result.errors, ContainsSubstring("--refine"));
  }
  // Not refined unless somebody asks.
  const std::string plain =
      folder.write("plain.toml", small_circuit + "realization = \"lattice\"\n");
  CHECK(Json::parse(run_tool({"certify", plain, "--json", "-"}).output).at("refinement").is_null());
  // The command line asks it of circuits that it does not speak of, too.
  CHECK_THAT(run_tool({"certify", scene("nic.toml"), "--refine", "bits=12"}).errors,
             ContainsSubstring("refinement is of crossbar, least_squares and lattice"));
}

TEST_CASE("relax and gen refine a build in ngspice, a deck a cycle", "[cli][spice]") {
  const Folder folder;
  const std::string path =
      folder.write("s.toml", small_circuit +
                                 "realization = \"lattice\"\n"
                                 "tolerance = { relative = 0.01 }\nrefine = { bits = 14 }\n");
  const ProcessResult result = run_tool({"relax", path, "--refine", "cycles=3", "--json", "-"});
  CHECK(result.code == 0);
  const Json refined = Json::parse(result.output);
  CHECK(refined.at("kind") == "refinement");
  CHECK(refined.at("agrees") == true);
  CHECK(refined.at("bits") == 14);
  REQUIRE(refined.at("cycles").size() == 3);
  for (const Json& cycle : refined.at("cycles")) CHECK(cycle.at("difference").get<double>() < 1e-9);
  CHECK(refined.at("cycles").back().at("simulated_error").get<double>() <
        1e-2 * refined.at("cycles").front().at("simulated_error").get<double>());
  CHECK_THAT(run_tool({"relax", path, "--refine", "cycles=2"}).output,
             ContainsSubstring("as in numbers") && ContainsSubstring("error in ngspice"));

  for (const std::string cycle : {"1", "2", "6"}) {
    const std::string deck = folder / "cycle.cir";
    CHECK(run_tool({"gen", path, "--refine", cycle, "-o", deck}).code == 0);
    CHECK_THAT(read_text(deck), ContainsSubstring("in cycle " + cycle + " of a refinement"));
    const ProcessResult relaxed = run_tool({"relax", deck});
    CHECK(relaxed.code == 0);
    CHECK_THAT(relaxed.output, ContainsSubstring("agrees"));
    std::filesystem::remove(deck);
  }
  const std::pair<std::vector<std::string>, std::string> refused[] = {
      {{"gen", path, "--refine", "0"}, "from 1 to 64"},
      {{"gen", path, "--refine", "2", "--budget", "1%"}, "leave out --budget"},
      {{"gen", scene("nic.toml"), "--refine", "2"}, "refinement is of crossbar"},
      {{"relax", scene("nic.toml"), "--refine", "bits=12"}, "refinement is of crossbar"},
      {{"relax", path, "--refine", "bits=12,bits=13"}, "bits is given twice"},
      {{"relax", path, "--refine", "bits=12", "--tolerance", "1"}, "is for decks"}};
  for (const auto& [command, why] : refused) {
    CAPTURE(why);
    const ProcessResult bad = run_tool(command);
    CHECK(bad.code == 2);
    CHECK_THAT(bad.errors, ContainsSubstring(why));
  }
}

TEST_CASE("certify lists what to order for an accuracy", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit);
  const std::string out = folder / "out";
  const ProcessResult result = run_tool({"certify", path, "--budget", "1%", "--out", out});
  CHECK(result.code == 0);
  CHECK_THAT(result.output, ContainsSubstring("For 1 % in 95 of 100 builds: "));
  CHECK_THAT(read_text(out + "/parts.csv"),
             StartsWith("ohm,tolerance,quantity,references,part\n") &&
                 ContainsSubstring(",fully differential amplifier\n"));
  CHECK_THAT(read_text(out + "/report.html"), ContainsSubstring("What to order"));
  CHECK_THAT(run_tool({"certify", path, "--budget", "0.01", "--json", "-"}).output,
             ContainsSubstring("\"target\": 0.01"));
  CHECK_THAT(run_tool({"certify", path, "--budget", "little"}).errors,
             ContainsSubstring("is not a share, such as 0.3%"));
  CHECK(run_tool({"certify", path, "--budget", "0"}).code == 2);
  CHECK(run_tool({"certify", path, "--budget", "120%"}).code == 2);
}

TEST_CASE("certify reads the board that it has written, and refuses others", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit);
  const std::string out = folder / "out";
  const auto said = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"certify", path};
    words.insert(words.end(), more.begin(), more.end());
    return run_tool(words);
  };
  // A margin that is there already: the siemens stay the scene's.
  const ProcessResult made = said({"--budget", "1%", "--phase-margin", "0.1", "--out", out});
  CAPTURE(made.output, made.errors);
  REQUIRE(made.code == 0);
  CHECK_THAT(made.output, ContainsSubstring("of copper to ground"));
  const Json written = Json::parse(read_text(out + "/certificate.json"));
  CHECK(written["board_written"] == true);
  CHECK(written["board"]["stated"] == written["board"]["used"]);
  CHECK_THAT(read_text(out + "/copper.csv"), StartsWith("net,pads,track_mm,missing_mm,"));
  CHECK_THAT(made.output, ContainsSubstring("VEE falls by "));
  CHECK(written["board"]["vee_ohm"].get<double>() > 0.0);
  // What a maker and an assembler take is made beside it.
  CHECK_THAT(read_text(out + "/fabricate.py"),
             StartsWith("\"\"\"Fills the planes") && EndsWith("main(*sys.argv[1:])\n"));
  CHECK_THAT(read_text(out + "/board.pos.csv"),
             StartsWith("Designator,Val,Package,Mid X,Mid Y,Rotation,Layer\nR1,"));
  CHECK_THAT(read_text(out + "/BOM.csv"), ContainsSubstring("\npin header 1x03,J"));
  const std::string board = out + "/board.kicad_pcb";
  const std::string realization = written["parts"]["choice"];
  const ProcessResult read = said(
      {"--board", board, "--realization", realization, "--phase-margin", "0.1", "--json", "-"});
  CAPTURE(read.errors);
  REQUIRE(read.code == 0);
  const Json again = Json::parse(read.output);
  CHECK(again["board"]["file"] == board);
  CHECK(again["board"]["nodes"] == written["board"]["nodes"]);
  CHECK(again["board"]["used"]["slowest_pole"] == written["board"]["used"]["slowest_pole"]);

  const std::string other = realization == "lattice" ? "crossbar" : "lattice";
  const ProcessResult wrong = said({"--board", board, "--realization", other});
  CHECK(wrong.code == 2);
  CHECK_THAT(wrong.errors, ContainsSubstring("not the board of this circuit"));
  CHECK(said({"--board", board, "--budget", "1%"}).code == 2);
  CHECK(said({"--board", board, "--phase-margin", "90"}).code == 2);
  CHECK(said({"--board", folder / "none.kicad_pcb"}).code == 2);
  const ProcessResult scene_file = said({"--board", path});
  CHECK(scene_file.code == 2);
  CHECK_THAT(scene_file.errors, ContainsSubstring("a file of KiCad begins with '('"));
  const std::string text = read_text(board);
  const ProcessResult cut =
      said({"--board", folder.write("cut.kicad_pcb", text.substr(0, text.size() / 2))});
  CHECK(cut.code == 2);
  CHECK_THAT(cut.errors, ContainsSubstring("cut short"));
}

TEST_CASE("certify draws an unstable circuit too, and fails", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_circuit + ringing_converters);
  CHECK(run_tool({"certify", path, "--out", folder / "out"}).code == 1);
  CHECK_THAT(read_text(folder / "out/report.html"),
             ContainsSubstring("UNSTABLE") && ContainsSubstring("href=\"settling.csv\""));
  CHECK_THAT(read_text(folder / "out/poles.csv"), ContainsSubstring("\ngrows,"));
  CHECK_THAT(run_tool({"certify", scene("circuits/lc.toml"), "--bandwidth", "1e6"}).errors,
             ContainsSubstring("lc has no op-amps"));
  const std::string settling = read_text(folder / "out/settling.csv");
  const std::size_t last = settling.rfind('\n', settling.size() - 2) + 1;
  CHECK(std::stod(settling.substr(settling.find(',', last) + 1)) > 10.0);  // it grows
}

TEST_CASE("run of a skin has its circuit beside the answer, where it is asked for",
          "[cli][spice][skin]") {
  const Folder folder;
  const std::string path = small_skin_circuit(folder);
  const ProcessResult alone = run_tool({"run", path, "--json", "-"});
  CAPTURE(alone.errors);
  CHECK(Json::parse(alone.output)["network"].is_null());
  for (const std::string realization : {"ideal", "least_squares"}) {
    const ProcessResult run =
        run_tool({"run", path, "--realization", realization, "--out", folder / realization});
    CAPTURE(realization, run.output, run.errors);
    REQUIRE(run.code == 0);
    CHECK_THAT(run.output, ContainsSubstring("network: " + realization) &&
                               ContainsSubstring("The circuit is off the true p"));
    const Json json = Json::parse(read_text(folder / (realization + "/result.json")));
    const Json& circuit = json["reconstructions"][1];
    CHECK(circuit["method"] == "network");
    CHECK(circuit["verdict"] == "ok");
    CHECK(json["network"]["realization"] == realization);
    // The same functional, solved by a circuit: as far off the truth as the direct solve.
    for (const auto& [component, error] : json["reconstructions"][0]["error"].items())
      CHECK_THAT(circuit["error"][component]["relative"].get<double>(),
                 WithinRel(error["relative"].get<double>(), 1e-2));
    CHECK_THAT(read_text(folder / (realization + "/report.html")),
               ContainsSubstring("The circuit") && ContainsSubstring("network.cir"));
    const ProcessResult relaxed = run_tool({"relax", folder / (realization + "/network.cir")});
    CHECK_THAT(relaxed.output, ContainsSubstring("27 nodes") && ContainsSubstring("(agrees)"));
  }
}

TEST_CASE("a skin that makes no circuit has its answer, and says why there is none",
          "[cli][spice][skin]") {
  const Folder folder;
  std::string text = read_text(scene("skins/circuit.toml"));
  text.replace(text.find("alpha = 1e-3"), 12, "alpha = 1e-3\nnonnegative = true");
  const std::string path = folder.write("s.toml", text);
  const ProcessResult run = run_tool({"run", path, "--realization", "crossbar"});
  CHECK(run.code == 1);
  CHECK_THAT(run.output, ContainsSubstring("normal force") &&
                             ContainsSubstring("network: FAILED: a circuit of resistors"));
  CHECK_THAT(run.errors, ContainsSubstring("the circuit has no answer that holds"));
}
