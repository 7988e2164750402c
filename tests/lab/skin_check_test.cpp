// Recordings of a skin, clean and with one defect planted: what the check finds, and what not.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/lab/readings_check.hpp"
#include "tactile_net/lab/recording.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/json/solve_json.hpp"
#include "tactile_net/report/words/check_words.hpp"
#include "tests/catch.hpp"
#include "tests/lab/checked_skin.hpp"
#include "tests/lab/recording_defects.hpp"
#include "tests/lab/scene_parts.hpp"

using namespace tactile_net;
namespace finding = lab::finding;

namespace {

constexpr std::size_t middle_taxel = 3 * taxel_columns + 2;  // row 3, column 2

}  // namespace

TEST_CASE("nothing is suspicious about clean recordings of a skin", "[lab][check][skin]") {
  const std::string reads = GENERATE(std::string("\"stress_x\""), three_stresses);
  const bool held = GENERATE(false, true);
  CAPTURE(reads, held);
  const lab::ReadingsCheck result = check(recorded_skin(skin_pad(reads, held)));
  CHECK(kinds(result) == Names{});
  CHECK(result.frames == 300);
  REQUIRE(result.channels[0].noise);
  CHECK_THAT(*result.channels[0].noise / pad_noise, WithinAbs(1.0, 0.15));
  // Of p alone the tractions may use up every reading.
  REQUIRE((result.residual || reads != three_stresses));
  if (result.residual) {
    CHECK(*result.residual > 0.2);
    CHECK(*result.residual < 5.0);
  }
  REQUIRE(result.peak);
  if (!held) CHECK_THAT(result.peak->force, WithinRel(0.4, 0.2));
}

TEST_CASE("each defect planted in a skin's recording is found", "[lab][check][skin]") {
  const std::string reads = GENERATE(std::string("\"stress_x\""), three_stresses);
  const RecordedSkin clean = recorded_skin(skin_pad(reads, false));
  for (const auto& defect : recording_defects<RecordedSkin>(middle_taxel)) {
    RecordedSkin recording = clean;
    std::mt19937 random(7);
    defect.plant(recording, random);
    const Names names = kinds(check(recording));
    CAPTURE(reads, defect.name, names);
    CHECK(names.contains(defect.expected));
    CHECK(names.size() <= 3);
  }
}

TEST_CASE("a skin's suspicions name rows and columns, and what its file needs",
          "[lab][check][skin]") {
  RecordedSkin recording = recorded_skin(skin_pad(three_stresses, false));
  for (auto& frame : recording.frames) frame[middle_taxel] = 0.0;
  const lab::ReadingsCheck result = check(recording);
  REQUIRE(result.findings.size() == 1);
  const AnyScene scene = recording.scene;
  CHECK_THAT(report::in_words(result.findings[0], scene), ContainsSubstring("taxel 3_2 feels"));
  const std::string advice = report::advice(result.findings[0], scene);
  REQUIRE_THAT(advice, ContainsSubstring("under [dead_taxels], indices = [\"3_2\"]"));
  // Which is what the scene takes, and then nothing is suspicious.
  const AnyScene said = parse_any_scene(
      skin_pad(three_stresses, false) + "[dead_taxels]\nindices = [\"3_2\"]\n", "skin.toml");
  recording.scene.dead_taxels = std::get<SkinScene>(said).dead_taxels;
  CHECK(kinds(check(recording)) == Names{});
  CHECK_THAT(report::advice(finding::WholePadPulled{}, scene),
             ContainsSubstring("turn the sign of the file's numbers"));
}

TEST_CASE("taxels in another order than the scene's are found by what shears say",
          "[lab][check][skin]") {
  // Square, so that rows can be taken for columns; a contact that is nowhere symmetric.
  std::string square = skin_pad(three_stresses, false);
  square.replace(square.find("rows = 7"), 8, "rows = 6");
  const RecordedSkin clean = recorded_skin(square);
  CHECK(kinds(check(clean)) == Names{});
  const bool along_y = GENERATE(false, true);
  const bool along_z = GENERATE(false, true);
  const bool exchanged = GENERATE(false, true);
  if (!along_y && !along_z && !exchanged) return;
  CAPTURE(along_y, along_z, exchanged);
  RecordedSkin recording = clean;
  constexpr std::size_t n = taxel_columns;
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (std::size_t channel = 0; channel < 3; ++channel)
      for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column) {
          const std::size_t y = exchanged ? column : row;
          const std::size_t z = exchanged ? row : column;
          recording.frames[k][(channel * n + row) * n + column] =
              clean.frames[k][(channel * n + (along_y ? n - 1 - y : y)) * n +
                              (along_z ? n - 1 - z : z)];
        }
  const lab::ReadingsCheck result = check(recording);
  CAPTURE(kinds(result));
  REQUIRE(kinds(result).count("order_mirrored") == 1);
  const auto order = finding_of<finding::OrderMirrored>(result);
  CHECK(order.exchanged == exchanged);
  // Of a quarter turn the two mirrors change places with the order in which they are told.
  CHECK((order.along_y != order.along_z) == (along_y != along_z));
  CHECK_FALSE(report::advice(order, recording.scene).empty());
}

TEST_CASE("readings that know no direction say nothing of the taxels' order",
          "[lab][check][skin]") {
  RecordedSkin recording = recorded_skin(skin_pad("\"stress_x\"", false));
  for (auto& frame : recording.frames) std::reverse(frame.begin(), frame.end());
  CHECK(kinds(check(recording)) == Names{});
}

TEST_CASE(
    "a skin's taxels that are equal in every frame are named, and so is a quantity of its "
    "own rate",
    "[lab][check][skin]") {
  const RecordedSkin clean = recorded_skin(skin_pad(three_stresses, false));
  RecordedSkin twins = clean;
  constexpr std::size_t n = 7 * taxel_columns;
  for (auto& frame : twins.frames)
    for (std::size_t channel = 0; channel < 3; ++channel)
      frame[channel * n + middle_taxel] = frame[channel * n + middle_taxel + taxel_columns];
  const lab::ReadingsCheck result = check(twins);
  REQUIRE(kinds(result).contains("equal_readings"));
  const auto equal = finding_of<finding::EqualReadings>(result);
  CHECK(equal.taxels == std::vector<std::size_t>{middle_taxel, middle_taxel + taxel_columns});
  CHECK(equal.groups.size() == 3);
  RecordedSkin slow = clean;
  for (std::size_t k = 0; k < slow.frames.size(); ++k)
    if (k % 4 != 0)
      std::copy(slow.frames[k - 1].begin() + n, slow.frames[k - 1].end(),
                slow.frames[k].begin() + n);
  const lab::ReadingsCheck of_slow = check(slow);
  CHECK(kinds(of_slow) == Names{"slow_channels"});
  CHECK(finding_of<finding::SlowChannels>(of_slow).channels == std::vector<std::size_t>{1, 2});
}

TEST_CASE("rows that are read there and back are found by what a contact presses",
          "[lab][check][skin]") {
  const std::string reads = GENERATE(std::string("\"stress_x\""), three_stresses);
  const bool columns = GENERATE(false, true);
  const std::size_t first = GENERATE(0u, 1u);
  CAPTURE(reads, columns, first);
  const RecordedSkin clean = recorded_skin(skin_pad(reads, false));
  RecordedSkin recording = clean;
  constexpr std::size_t rows = 7;
  const std::size_t channels = clean.frames.front().size() / (rows * taxel_columns);
  for (std::size_t k = 0; k < recording.frames.size(); ++k)
    for (std::size_t channel = 0; channel < channels; ++channel)
      for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < taxel_columns; ++column) {
          const bool turned = (columns ? column : row) % 2 == first;
          const std::size_t y = turned && columns ? rows - 1 - row : row;
          const std::size_t z = turned && !columns ? taxel_columns - 1 - column : column;
          recording.frames[k][(channel * rows + row) * taxel_columns + column] =
              clean.frames[k][(channel * rows + y) * taxel_columns + z];
        }
  const lab::ReadingsCheck result = check(recording);
  REQUIRE(kinds(result).contains("order_serpentine"));
  CHECK_FALSE(kinds(result).contains("order_mirrored"));
  const auto order = finding_of<finding::OrderSerpentine>(result);
  CHECK(order.columns == columns);
  // Pressures know no direction, and a mirror image is as good a pad.
  if (channels > 1) CHECK(order.first == first);
}

TEST_CASE("displacements in another unit are strains that no pad bears", "[lab][check][skin]") {
  std::string text = skin_pad("\"displacement_y\", \"displacement_z\"", false);
  text.replace(text.find("rms = 30.0"), 10, "rms = 1e-7");
  RecordedSkin recording = recorded_skin(text);
  double strain = 0.0;  // of neighbours in a row, which are 1 mm apart
  for (const auto& frame : recording.frames)
    for (std::size_t i = 0; i + 1 < frame.size(); ++i)
      if ((i + 1) % taxel_columns != 0)
        strain = std::max(strain, std::abs(frame[i + 1] - frame[i]) / 1e-3);
  REQUIRE(strain < 0.9);
  CHECK_FALSE(kinds(check(recording)).contains("strain_too_large"));
  for (auto& frame : recording.frames)
    for (double& reading : frame) reading *= 1.5 / strain;
  const lab::ReadingsCheck found = check(recording);
  CHECK(finding_of<finding::StrainTooLarge>(found).strain >= 1.4);
}

TEST_CASE("a skin of too many cells for a matrix is checked on cells of its pitch",
          "[lab][check][skin]") {
  RecordedSkin coarse = recorded_skin(skin_pad("\"stress_x\"", false));
  RecordedSkin fine = coarse;
  coarse.scene.reconstruct.grid.spacing = 1e-3;
  fine.scene.reconstruct.grid.spacing = 0.02e-3;
  REQUIRE(lab::SkinSceneProblem(fine.scene).is_large());
  const lab::ReadingsCheck found = check(fine);
  const lab::ReadingsCheck expected = check(coarse);
  CHECK(kinds(found) == kinds(expected));
  REQUIRE(found.peak);
  REQUIRE(expected.peak);
  CHECK(found.peak->force == expected.peak->force);
}

TEST_CASE("a skin's page and its JSON have every finding", "[lab][check][skin]") {
  RecordedSkin recording = recorded_skin(skin_pad("\"stress_x\"", false));
  for (auto& frame : recording.frames) frame[middle_taxel] = frame[middle_taxel + 1];
  const lab::SkinSceneProblem problem(recording.scene);
  lab::Recording solved(problem);
  solved.add({}, problem, recording.frames[100], lab::solve(problem, recording.frames[100]));
  lab::RecordingOverview all = solved.overview();
  all.findings = check(recording).findings;
  REQUIRE_FALSE(all.findings.empty());
  const std::string page = pages::recording_page(all, "skin.csv", {}, {}).html;
  const std::string json = report::solve_json(all, {}, {.readings = "skin.csv"});
  for (const lab::Finding& one : all.findings) {
    CHECK_THAT(page, ContainsSubstring(report::in_words(one, recording.scene)));
    CHECK_THAT(page, ContainsSubstring("indices = ["));
    CHECK_THAT(json, ContainsSubstring("\"" + std::string(lab::name(one)) + "\""));
  }
}
