#include <cmath>
#include <filesystem>

#include "tests/catch.hpp"
#include "tests/cli/csv.hpp"
#include "tests/cli/tool.hpp"

using namespace tactile_net;

namespace {

const std::string stress_header = "t,stress_x_0,stress_x_1,stress_x_2\n";

}  // namespace

// Finite-element readings, not made by our formulas, and what truly pressed.
namespace {

struct RecordedPad {
  std::string name;
  std::size_t count;
  double pitch;
};
const RecordedPad thin{"thin-pad", 41, 0.5e-3};
const RecordedPad thick{"thick-pad", 61, 0.4e-3};

struct Recorded {
  std::vector<std::vector<double>> found, truth;
};

Recorded recorded(const RecordedPad& pad, const std::string& scene_name) {
  const ProcessResult result = run_tool({"solve", scene("recorded/" + scene_name + ".toml"),
                                         "--readings", scene("recorded/" + pad.name + ".csv")});
  REQUIRE(result.code == 0);
  CHECK_THAT(result.errors, ContainsSubstring("columns are not read"));
  return {csv_rows(result.output),
          csv_rows(read_text(scene("recorded/" + pad.name + ".truth.csv")))};
}

/// |found - truth| / |truth| over `count` values; the truth has four columns before its tractions.
double relative_error(const std::vector<double>& found, const std::vector<double>& truth,
                      std::size_t first, std::size_t count) {
  double error = 0.0;
  double size = 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    error += std::pow(found[1 + first + j] - truth[4 + first + j], 2);
    size += std::pow(truth[4 + first + j], 2);
  }
  return std::sqrt(error / size);
}

}  // namespace

TEST_CASE("recorded frames of a pad give its forces and their place", "[cli]") {
  const RecordedPad& pad = GENERATE(from_range(std::vector{thin, thick}));
  const auto [found, truth] = recorded(pad, pad.name);
  REQUIRE(found.size() == truth.size());
  for (std::size_t frame = 1; frame < found.size(); ++frame) {  // all but the lightest
    double normal = 0.0;
    double tangential = 0.0;
    double moment = 0.0;
    for (std::size_t j = 0; j < pad.count; ++j) {
      const double y =
          (static_cast<double>(j) - 0.5 * static_cast<double>(pad.count - 1)) * pad.pitch;
      normal += pad.pitch * found[frame][1 + j];
      tangential += pad.pitch * found[frame][1 + pad.count + j];
      moment += pad.pitch * y * found[frame][1 + j];
    }
    CAPTURE(pad.name, frame);
    CHECK(found[frame][0] == truth[frame][0]);
    CHECK_THAT(normal, WithinRel(truth[frame][1], 0.01));
    CHECK_THAT(tangential, WithinAbs(truth[frame][2], 0.03 * truth[frame][1]));
    CHECK_THAT(moment / normal, WithinAbs(truth[frame][3], 0.1e-3));
  }
}

TEST_CASE("what contact allows makes recorded tractions better", "[cli]") {
  const auto [found, truth] = recorded(thin, "thin-pad-contact");
  const auto [plain, same_truth] = recorded(thin, "thin-pad");
  REQUIRE(found.size() == 7);
  for (std::size_t frame = 3; frame < 7; ++frame) {
    CAPTURE(frame);
    for (std::size_t j = 0; j < 41; ++j) {
      CHECK(found[frame][1 + j] >= 0.0);
      CHECK(std::abs(found[frame][42 + j]) <= 0.8 * found[frame][1 + j] * (1.0 + 1e-9));
    }
    CHECK(relative_error(found[frame], truth[frame], 0, 41) <= 0.08);
    CHECK(relative_error(plain[frame], truth[frame], 0, 41) <= 0.18);
    if (frame > 3) CHECK(relative_error(found[frame], truth[frame], 41, 41) <= 0.14);
  }
}

TEST_CASE("a weight for the tangential traction makes recorded ones better", "[cli]") {
  struct Floor {
    double normal;
    double tangential;  // of presses over the normal traction's norm
  };
  struct Case {
    RecordedPad pad;
    std::vector<Floor> floors;
  };
  const std::vector<Case> cases{
      {thin,
       {{0.37, 0.01},
        {0.095, 0.01},
        {0.097, 0.01},
        {0.08, 0.01},
        {0.058, 0.125},
        {0.068, 0.12},
        {0.07, 0.072}}},
      {thick, {{0.075, 0.01}, {0.126, 0.01}, {0.056, 0.01}, {0.092, 0.19}, {0.094, 0.15}}}};
  for (const auto& [pad, floors] : cases) {
    const auto [found, truth] = recorded(pad, pad.name + "-weights");
    REQUIRE(found.size() == floors.size());
    for (std::size_t frame = 0; frame < floors.size(); ++frame) {
      CAPTURE(pad.name, frame);
      CHECK(relative_error(found[frame], truth[frame], 0, pad.count) <= floors[frame].normal);
      const bool drags = truth[frame][2] != 0.0;
      double drag = 0.0;
      double press = 0.0;
      for (std::size_t j = 0; j < pad.count; ++j) {
        drag += std::pow(found[frame][1 + pad.count + j], 2);
        press += std::pow(truth[frame][4 + j], 2);
      }
      CHECK((drags ? relative_error(found[frame], truth[frame], pad.count, pad.count)
                   : std::sqrt(drag / press)) <= floors[frame].tangential);
    }
  }
}

TEST_CASE("bands of recorded frames hold what truly pressed", "[cli]") {
  const RecordedPad& pad = GENERATE(from_range(std::vector{thin, thick}));
  const Folder folder;
  REQUIRE(run_tool({"solve", scene("recorded/" + pad.name + ".toml"), "--readings",
                    scene("recorded/" + pad.name + ".csv"), "-o", folder / "tractions.csv",
                    "--uncertainty", folder / "uncertainty.csv"})
              .code == 0);
  const auto found = named_csv_rows(read_text(folder / "tractions.csv"));
  const auto bands = named_csv_rows(read_text(folder / "uncertainty.csv"));
  const auto truth = named_csv_rows(read_text(scene("recorded/" + pad.name + ".truth.csv")));
  REQUIRE(bands.size() == truth.size());
  std::size_t within = 0;
  std::size_t inside = 0;  // of intervals
  std::size_t all = 0;
  std::size_t forces_beyond = 0;
  std::size_t not_explained = 0;
  for (std::size_t frame = 0; frame < truth.size(); ++frame) {
    CAPTURE(pad.name, frame);
    const CsvRow& band = bands[frame];
    CHECK(band.at("alpha") > 0.0);
    double highest = 0.0;
    for (std::size_t j = 0; j < pad.count; ++j)
      highest = std::max(highest, truth[frame].at("normal_" + std::to_string(j)));
    const double nothing = 1e-6 * highest;  // that the elements leave where nothing presses
    for (std::size_t j = 0; j < pad.count; ++j)
      for (const std::string component : {"normal_", "tangential_"}) {
        const std::string name = component + std::to_string(j);
        const double pressed = truth[frame].at(name);
        const double error = std::abs(found[frame].at(name) - pressed);
        ++all;
        if (error <= 2.0 * band.at(component + "deviation_" + std::to_string(j)) + nothing)
          ++within;
        if (band.at(component + "low_" + std::to_string(j)) <= pressed + nothing &&
            pressed - nothing <= band.at(component + "high_" + std::to_string(j)))
          ++inside;
      }
    for (const std::string component : {"normal", "tangential"}) {
      const double pressed = truth[frame].at("force_" + component);
      const std::string name = component + "_force";
      const double error = std::abs(band.at(name) - pressed);
      if (error > 2.0 * band.at(name + "_deviation")) ++forces_beyond;
      CHECK(error <= 3.5 * band.at(name + "_deviation"));
      CHECK(band.at(name + "_low") < band.at(name));
      CHECK(band.at(name) < band.at(name + "_high"));
    }
    CHECK(band.at("residual_rms") < 1.25);  // in units of the noise stated
    if (band.at("model_rms") > 0.0) ++not_explained;
  }
  CAPTURE(within, inside, all);
  CHECK(static_cast<double>(within) >= 0.95 * static_cast<double>(all));
  CHECK(static_cast<double>(inside) >= 0.95 * static_cast<double>(all));
  CHECK(forces_beyond <= 1);  // of 10 and of 14
  CHECK(not_explained <= 1);  // by the noise: of white noise alone one frame of a hundred
}

TEST_CASE("a recording has a page, with its numbers beside it", "[cli]") {
  const Folder folder;
  const ProcessResult result = run_tool({"solve", scene("recorded/thin-pad.toml"), "--readings",
                                         scene("recorded/thin-pad.csv"), "--out", folder / "out"});
  REQUIRE(result.code == 0);
  CHECK_THAT(result.errors, ContainsSubstring("report: "));
  CHECK(result.output.empty());
  CHECK(csv_rows(read_text(folder / "out/tractions.csv")).size() == 7);
  CHECK_THAT(read_text(folder / "out/report.html"), ContainsSubstring("largest normal force"));
  CHECK_THAT(read_text(folder / "out/result.json"), ContainsSubstring("\"frames\": 7"));
  CHECK_THAT(read_text(folder / "out/shown.csv"), ContainsSubstring("normal_40"));

  // Of a recording that breaks off nothing is kept, and nothing else is said.
  const std::string broken =
      folder.write("broken.csv", read_text(scene("recorded/thin-pad.csv")) + "0.07,x\n");
  const ProcessResult failed = run_tool(
      {"solve", scene("recorded/thin-pad.toml"), "--readings", broken, "--out", folder / "no"});
  CHECK(failed.code == 2);
  CHECK_THAT(failed.errors, !ContainsSubstring("written to"));
  CHECK_FALSE(std::filesystem::exists(folder / "no"));

  // Tractions that are wanted elsewhere are not written twice.
  const ProcessResult elsewhere =
      run_tool({"solve", scene("recorded/thin-pad.toml"), "--readings",
                scene("recorded/thin-pad.csv"), "--out", folder / "other", "-o", folder / "f.npy"});
  REQUIRE(elsewhere.code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "other/tractions.csv"));
  CHECK(std::filesystem::exists(folder / "f.npy"));
}

TEST_CASE("a malformed row stops at its place with everything before it written", "[cli]") {
  const Folder folder;
  const std::string path = folder.write("s.toml", small_scene);
  const auto [row, place, message] = GENERATE(table<std::string, std::string, std::string>({
      {"1,2,abc,4", ":3:5: error: ", "'abc' is not a number (column stress_x_1)"},
      {"1,2,nan,4", ":3:5: error: ", "'nan' is not finite"},
      {"1,2,,4", ":3:5: error: ", "a number is missing"},
      {"1,2,1e999,4", ":3:5: error: ", "beyond the range"},
      {"1,2,3", ":3:", "3 columns, the header 4"},
      {"1,2,3,4,5", ":3:9: error: ", "more than the header's 4 columns"},
      {"1,2,0x10,4", ":3:5: error: ", "'0x10' is not a number"},
  }));
  CAPTURE(row);
  const std::string csv = folder.write("r.csv", stress_header + "0,1,2,3\n" + row + "\n2,1,2,3\n");
  const ProcessResult result = run_tool({"solve", path, "--readings", csv, "-o", folder / "f.csv"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, StartsWith(csv + place) && ContainsSubstring(message) &&
                                ContainsSubstring("1 frame before it was written to " +
                                                  (folder / "f.csv.partial")));
  CHECK_FALSE(std::filesystem::exists(folder / "f.csv"));  // what looks whole is whole
  CHECK(csv_rows(read_text(folder / "f.csv.partial")).size() == 1);
}

TEST_CASE("a frame whose tractions overflow anywhere is refused, and what came before stands",
          "[cli]") {
  const Folder folder;
  const std::string path = folder.write(
      "s.toml",
      "[sensor]\ncount = 41\npitch = 0.5e-3\ndepth = 1.5e-3\nreads = [\"stress_x\", \"shear_xy\"]\n"
      "[material]\nyoungs_modulus = 0.2e6\npoisson_ratio = 0.45\n[reconstruct]\nalpha = 1e-6\n");
  std::string columns;
  for (const char* quantity : {"stress_x_", "shear_xy_"})
    for (int i = 0; i < 41; ++i) columns += "," + std::string(quantity) + std::to_string(i);
  const auto row = [](const std::string& last_but_one, const std::string& last) {
    std::string text;
    for (int i = 0; i < 80; ++i) text += "0,";
    return text + last_but_one + ',' + last + '\n';
  };
  const std::string method = GENERATE("tikhonov", "closed_form", "dft");
  CAPTURE(method);
  const std::string csv = folder.write(
      "r.csv", columns.substr(1) + '\n' + row("1", "2") + row("1e308", "-1e308") + row("1", "1"));
  const ProcessResult result = run_tool({"solve", path, "--readings", csv, "--method", method, "-o",
                                         folder / "f.csv", "--json", folder / "s.json"});
  CHECK(result.code == 2);
  CHECK_THAT(result.errors, StartsWith(csv + ":3:") && ContainsSubstring("overflow"));
  const auto found = csv_rows(read_text(folder / "f.csv.partial"));
  REQUIRE(found.size() == 1);
  for (const double traction : found[0]) CHECK(std::isfinite(traction));
  CHECK_FALSE(std::filesystem::exists(folder / "s.json"));
}
