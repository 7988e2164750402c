#include "tactile_net/lab/recording.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pages/pad_drawing.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/pages/recording_page.hpp"
#include "tactile_net/report/csv/recording_csv.hpp"
#include "tactile_net/report/json/frames_json.hpp"
#include "tactile_net/report/words/recording_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

/// A press of `frames` frames in the middle, the strongest in the middle of time; the last frame's
/// verdict is `last`. Before the frame `gap`, if it is above 0, three have no answer.
lab::RecordingOverview press(std::size_t frames, lab::Verdict last = lab::Verdict::ok,
                             const std::string& title = "a press", std::size_t gap = 0) {
  const lab::SceneProblem problem(
      parse_scene("title = \"" + title +
                      "\"\n[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.0\nreads = [\"stress_x\", "
                      "\"shear_xy\"]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                      "[noise]\nrms = 1e-3\n[reconstruct]\nalpha = 1e-3\n",
                  "pad.toml"));
  const auto solver = lab::make_solver(problem, Method::tikhonov);
  lab::Recording recording(problem, Method::tikhonov);
  std::vector<double> readings(42);
  std::vector<double> tractions(42);
  for (std::size_t k = 0; k < frames; ++k) {
    for (int i = 0; i < 3 && gap > 0 && k == gap; ++i) recording.skip();
    const double size =
        std::sin(3.1 * static_cast<double>(k + 1) / static_cast<double>(frames + 1));
    for (std::size_t i = 0; i < 21; ++i)
      readings[i] = size * std::exp(-0.2 * std::pow(static_cast<double>(i) - 10.0, 2));
    const lab::FrameResult result = solver->solve(readings, tractions);
    const lab::Verdict verdict = k + 1 == frames ? last : result.verdict;
    recording.add(0.01 * static_cast<double>(k), problem, readings,
                  {.tractions = tractions,
                   .alpha = *result.alpha,
                   .verdict = verdict,
                   .solved = verdict,
                   .condition = result.condition});
  }
  return recording.overview();
}

constexpr std::size_t readings_of_skin = 3 * 16 * 16;

SkinScene skin_of_sixteen() {
  return std::get<SkinScene>(
      parse_any_scene("[sensor]\nrows = 16\ncolumns = 16\npitch = 1.0\ndepth = 1.0\n"
                      "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
                      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
                      "skin.toml"));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("clocks a millisecond apart differ, at any time", "[report][recording]") {
  const double time = GENERATE(0.0, 0.5, 12.0, 999.0, 3600.0, 1712345678.0);
  CHECK(clock_in_words(time, 0) != clock_in_words(time + 1e-3, 0));
  CHECK(clock_in_words(std::nan(""), 7) == "frame 7");
}

TEST_CASE("a recording's page answers first, and needs no network", "[report][recording]") {
  const lab::RecordingOverview overview = press(60, lab::Verdict::unstable);
  const std::string page =
      pages::recording_page(overview, "press.csv", {"a note"}, {.files = {"shown.csv"}}).html;
  CHECK(page.find("largest normal force") < page.find("<svg class"));
  CHECK_THAT(page, ContainsSubstring("1 of 60 frames") && ContainsSubstring("a note"));
  CHECK_THAT(page, ContainsSubstring("<a href=\"shown.csv\">"));
  CHECK_THAT(page, !ContainsSubstring("src=\"http") && !ContainsSubstring("href=\"http") &&
                       !ContainsSubstring("<link"));
  CHECK(count(page, "<script") == 3);  // data, the plotting library with its licence, our own
  CHECK(count(page, "</script>") == 3);
  CHECK_THAT(page, ContainsSubstring("Permission is hereby granted"));
  // Whoever has no script has every frame in words.
  CHECK(count(page, "<td data-label=\"frame\">") == 60);
  CHECK_THAT(page,
             ContainsSubstring(group_answer(overview, overview.groups.front()).substr(0, 13)));
}

TEST_CASE("a pad that is pulled is not one that nothing presses", "[report][recording]") {
  lab::RecordingOverview pulled = press(61);
  const double most = pulled.peak().resultant.normal;
  for (lab::FrameGroup& group : pulled.groups) {
    group.resultant.normal *= -1.0;
    group.answer.bands->resultant.normal.value *= -1.0;
  }
  CHECK(pulled.peak().resultant.normal == -most);
  CHECK(pulled.pulled(pulled.peak()));
  CHECK_FALSE(pulled.loaded(pulled.peak()));
  CHECK_THAT(answers(pulled).front().meaning,
             ContainsSubstring("it pulls") && !ContainsSubstring("Nothing"));
  CHECK(answers(pulled).front().doubtful);
}

TEST_CASE("a suspicion about the readings is said before the first picture",
          "[report][recording]") {
  lab::RecordingOverview overview = press(60);
  const auto page = [&] { return pages::recording_page(overview, "press.csv", {}, {}).html; };
  CHECK_THAT(page(), !ContainsSubstring("suspicion") && ContainsSubstring("passed every check"));
  overview.findings = {lab::finding::WholePadPulled{.pulled = 58, .loaded = 60},
                       lab::finding::DeadTaxels{.taxels = {7}}};
  const std::string html = page();
  CHECK(html.find("2 suspicions") < html.find("<svg class"));
  CHECK(html.find("pulled in 58 of 60") < html.find("taxel 7 feels nothing"));
  CHECK(html.find("indices = [7]") < html.find("<svg class"));  // what to do about it
  CHECK_THAT(html, !ContainsSubstring("passed every check"));
  CHECK(answers(overview).back().doubtful);
}

TEST_CASE("names stand in a page as they are, however they look", "[report][recording]") {
  const std::string title = "run 1e+03: 5 +- 2, 3 us";
  const std::string readings = "run1e+03 5 us.csv";
  const std::string page =
      pages::recording_page(press(3, lab::Verdict::ok, title), readings, {}, {}).html;
  CHECK_THAT(page, ContainsSubstring("<h1>" + title + "</h1>") &&
                       ContainsSubstring("<title>" + readings + " - ") &&
                       ContainsSubstring("Readings: " + readings + "."));
  const std::string empty =
      pages::recording_page(press(0, lab::Verdict::ok, title), readings, {}, {}).html;
  CHECK_THAT(empty, ContainsSubstring(">" + readings + " holds no frame"));
}

TEST_CASE("a picture along the array has the array's own ends below it, wherever it lies",
          "[report][recording]") {
  const auto overview_at = [](double first) {
    std::string positions = std::to_string(first);
    for (int i = 1; i < 9; ++i) positions += ", " + std::to_string(first + i);
    const lab::SceneProblem problem(
        parse_scene("[sensor]\npositions = [" + positions +
                        "]\ndepth = 1.0\nreads = [\"stress_x\"]\n[material]\nyoungs_modulus = "
                        "1.0\npoisson_ratio = 0.45\n[noise]\nrms = 1e-3\n[reconstruct]\n"
                        "alpha = 1e-3\n",
                    "pad.toml"));
    const auto solver = lab::make_solver(problem, Method::tikhonov);
    lab::Recording recording(problem, Method::tikhonov);
    std::vector<double> readings(9);
    std::vector<double> tractions(solver->tractions());
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 9; ++i)
        readings[static_cast<std::size_t>(i)] = 0.1 * (k + 1) * std::exp(-0.3 * std::pow(i - 5, 2));
      const lab::FrameResult result = solver->solve(readings, tractions);
      recording.add(
          0.01 * k, problem, readings,
          {.tractions = tractions, .alpha = *result.alpha, .condition = result.condition});
    }
    return recording.overview();
  };
  /// The centre of pressure of each frame, from the array's first end [m].
  const auto centres = [](const nlohmann::json& json, double first) {
    std::vector<double> from_first;
    for (const auto& y : json["centre"]["y"]) from_first.push_back(y.get<double>() - first);
    return from_first;
  };
  std::vector<double> before;
  std::optional<double> edge;  // of the surface that is solved for, from the array's first end
  for (const double first : {2.0, -4.0, -10.0}) {
    CAPTURE(first);
    const lab::RecordingOverview overview = overview_at(first);
    const std::string page = pages::recording_page(overview, "press.csv", {}, {}).html;
    // The pad in section and the script's pictures have one axis.
    const std::vector<std::string> ends = pages::ends_of_surface(overview.line());
    CHECK(ends[1] == in_unit(overview.line(), Dimension::length, first + 4.0));
    std::string below;
    for (const std::string& end : ends) below += "<span>" + end + "</span>\n";
    CHECK(count(page, below) == 1);
    const auto json = nlohmann::json::parse(frames_json(overview));
    const double from_first = json["grid"]["y"].get<double>() - first;
    CHECK_THAT(edge.value_or(from_first), WithinAbs(from_first, 1e-9));
    edge = from_first;
    const std::vector<double> centre = centres(json, first);
    REQUIRE(centre.size() == 4);
    for (std::size_t i = 0; i < before.size(); ++i)
      CHECK_THAT(centre[i], WithinAbs(before[i], 1e-3));  // rounded to five digits
    before = centre;
  }
}

TEST_CASE("courses over time are between the ends of intervals where frames have them",
          "[report][recording]") {
  const auto recorded = [](const std::string& reconstruct) {
    const lab::AnyProblem problem = lab::any_problem(
        parse_scene("[sensor]\ncount = 13\npitch = 1.0\ndepth = 1.0\nreads = [\"stress_x\", "
                    "\"shear_xy\"]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
                    "[noise]\nrms = 2e-3\n[report]\nlevel = 0.8\n[reconstruct]\n" +
                        reconstruct,
                    "pad.toml"));
    lab::RecordingSolver solver(problem, Method::tikhonov);
    lab::Recording recording(problem, Method::tikhonov);
    for (int k = 1; k <= 3; ++k) {
      std::vector<double> readings(26);
      for (std::size_t i = 0; i < 13; ++i)
        readings[i] = 0.1 * k * std::exp(-0.3 * std::pow(static_cast<double>(i) - 6.0, 2));
      const std::vector<double> read = readings;
      recording.add(0.01 * k, problem, read, *solver.solve(readings, {}));
    }
    return recording.overview();
  };
  const auto close = [](const nlohmann::json& shown, double value) {
    CHECK_THAT(shown.get<double>(), WithinRel(value, 1e-4));  // rounded
  };
  for (const std::string& bound : {std::string(), std::string("nonnegative = true\n")}) {
    CAPTURE(bound);
    const lab::RecordingOverview overview = recorded(bound);
    const auto json = nlohmann::json::parse(frames_json(overview));
    const auto& force = json["courses"][0];
    CHECK(force["bands"] == "80 % intervals");
    CHECK(json["centre"]["bands"] == "80 % intervals");
    for (std::size_t k = 0; k < 3; ++k) {
      const UncertainResultant& found = overview.groups[k].answer.bands->resultant;
      for (std::size_t i = 0; i < 2; ++i) {
        const Uncertain& one = i == 0 ? found.normal : *found.tangential;
        close(force["lines"][i]["y"][k], one.value);
        close(force["lines"][i]["low"][k], one.interval->low);
        close(force["lines"][i]["high"][k], one.interval->high);
      }
      close(json["centre"]["low"][k], found.centre->interval->low);
      close(json["centre"]["high"][k], found.centre->interval->high);
    }
  }
  const lab::RecordingOverview by_alpha = recorded("answer = \"alpha\"\n");
  const auto json = nlohmann::json::parse(frames_json(by_alpha));
  const auto& line = json["courses"][0]["lines"][0];
  CHECK(json["courses"][0]["bands"] == "two standard deviations");
  CHECK(json["centre"]["bands"] == "");
  const Uncertain& normal = by_alpha.groups[1].answer.bands->resultant.normal;
  close(line["low"][1], normal.value - 2.0 * normal.deviation);
  close(line["high"][1], normal.value + 2.0 * normal.deviation);
}

TEST_CASE("a thousand frames of a skin are a page below 2.7 MB, whatever its cells and components",
          "[report][recording]") {
  const std::size_t cells_across = GENERATE(std::size_t{18}, std::size_t{35});
  const std::size_t components = GENERATE(std::size_t{1}, std::size_t{3});
  CAPTURE(cells_across, components);
  const SurfaceGrid grid{
      .rows = cells_across, .columns = cells_across, .spacing_y = 1.0, .spacing_z = 1.0};
  const lab::SkinSceneProblem problem(skin_of_sixteen());
  lab::Recording recording(problem);
  const std::size_t cells = grid.count();
  const std::size_t count = components * cells;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> noise(std::max(count, readings_of_skin) + 1000);
  for (double& value : noise) value = normal(generator);
  lab::FrameAnswer answer;
  for (std::size_t i = 0; i < cells; ++i)
    if (i % cells_across > 3 && i % cells_across < 12) answer.cells.push_back(i);
  for (std::size_t k = 0; k < 1000; ++k) {
    const std::span<const double> from = std::span<const double>(noise).subspan(k);
    const std::span<const double> part = from.first(count);
    answer.tractions.assign(part.begin(), part.end());
    answer.deviations.clear();
    for (const double value : part) answer.deviations.push_back(1.0 + 0.1 * std::abs(value));
    answer.wrench.normal = {1.0 + 0.01 * noise[k], 0.0123};
    answer.wrench.tangential_y = answer.wrench.tangential_z = answer.wrench.centre_y =
        answer.wrench.centre_z = answer.wrench.torsion = Uncertain{noise[k], 0.0123};
    recording.add(0.01 * static_cast<double>(k), problem, from.first(readings_of_skin), answer);
  }
  lab::RecordingOverview overview = recording.overview();
  overview.grid = grid;
  REQUIRE(overview.groups.size() >= 200);
  constexpr std::size_t scripts_and_style = 160'000;
  CHECK(frames_json(overview).size() + scripts_and_style < 2'700'000);
}

TEST_CASE("a page has a row for each contact of each frame, with the number that it keeps",
          "[report][recording]") {
  const lab::AnyProblem problem = lab::SkinSceneProblem(skin_of_sixteen());
  lab::Recording recording(problem);
  const std::vector<double> readings(readings_of_skin, 1.0);
  lab::FrameAnswer answer;
  answer.tractions.assign(std::get<lab::SkinSceneProblem>(problem).tractions(), 1.0);
  const auto contact = [](std::size_t cell, double force) {
    ContactPatch patch{.cells = {cell}};
    patch.wrench.normal = {force, 0.25};
    patch.wrench.centre_y = Uncertain{0.5, 0.125};
    patch.wrench.centre_z = Uncertain{0.75, 0.125};
    return patch;
  };
  const auto json_of = [&] {
    return nlohmann::json::parse(frames_json(recording.overview()))["contacts"];
  };
  recording.add({}, problem, readings, answer);
  CHECK(json_of().is_null());
  answer.patches = {contact(0, 2.0), contact(15, 1.0)};
  recording.add({}, problem, readings, answer);
  answer.patches = {contact(15, 4.0)};
  recording.add({}, problem, readings, answer);
  const auto json = json_of();
  REQUIRE(json["rows"].size() == 3);
  CHECK(json["rows"][0].empty());
  REQUIRE(json["rows"][1].size() == 2);
  REQUIRE(json["rows"][2].size() == 1);
  CHECK(json["rows"][2][0][0] == json["rows"][1][1][0]);  // the same contact
  CHECK(json["rows"][2][0][1] == nlohmann::json{4.0, 0.25});
  REQUIRE(json["columns"].size() == 3);  // nothing is known of drags
  CHECK(json["columns"][1]["label"] == "centre, y");
}

TEST_CASE("pictures over time have a gap where frames have no answer, and there only",
          "[report][recording]") {
  using Gaps = std::vector<std::size_t>;
  const auto gaps_in = [](const lab::RecordingOverview& overview) {
    return nlohmann::json::parse(frames_json(overview))["frames"]["gaps"].get<Gaps>();
  };
  const auto gaps_of = [&](const lab::Recording& recording) {
    return gaps_in(recording.overview());
  };
  const lab::SkinSceneProblem problem(skin_of_sixteen());
  lab::Recording recording(problem);
  const std::vector<double> readings(readings_of_skin, 1.0);
  lab::FrameAnswer answer;
  answer.tractions.assign(problem.tractions(), 1.0);
  const auto add = [&](std::size_t frames) {
    for (std::size_t k = 0; k < frames; ++k) recording.add({}, problem, readings, answer);
  };
  add(3);
  CHECK(gaps_of(recording).empty());
  recording.skip();
  add(2);
  CHECK(gaps_of(recording) == Gaps{3});
  // So many that one that is shown stands for several: a single frame that is missing is no gap.
  add(2 * lab::Recording::most_groups);
  recording.skip();
  add(100);
  const std::size_t per_group = recording.overview().per_group;
  REQUIRE(per_group > 1);
  CHECK(gaps_of(recording).empty());
  for (std::size_t k = 0; k < 3 * per_group; ++k) recording.skip();
  add(100);
  CHECK(gaps_of(recording).size() == 1);

  CHECK(gaps_in(press(6)).empty());
  CHECK(gaps_in(press(6, lab::Verdict::ok, "a press", 4)) == Gaps{4});
}

TEST_CASE("a title cannot leave its place in a recording's page", "[report][recording]") {
  const lab::RecordingOverview overview = press(3, lab::Verdict::ok, "</script><b onclick=1>&");
  const std::string page =
      pages::recording_page(overview, "<x>.csv", {"<note>"}, {.files = {"\"><i>.csv"}}).html;
  CHECK_THAT(page, !ContainsSubstring("<b onclick") && !ContainsSubstring("<x>") &&
                       !ContainsSubstring("<note>"));
  CHECK_THAT(page, !ContainsSubstring("<i>"));
  CHECK(count(page, "<script") == count(page, "</script>"));
}

TEST_CASE("a recording without frames, with one, without a load: each has its page",
          "[report][recording]") {
  const std::string none = pages::recording_page(press(0), "empty.csv", {}, {}).html;
  CHECK_THAT(none, ContainsSubstring("empty.csv holds no frame") && !ContainsSubstring("<script"));
  CHECK_THAT(pages::recording_page(press(1), "one.csv", {}, {}).html,
             ContainsSubstring("frame 0 of 1"));

  lab::RecordingOverview idle = press(5);
  for (lab::FrameGroup& group : idle.groups) {
    group.resultant = {};
    group.answer.bands->resultant.normal.value = 0.0;
  }
  CHECK_THAT(answers(idle).front().meaning, ContainsSubstring("Nothing presses"));
  CHECK_FALSE(answers(idle).front().doubtful);  // an empty frame is no fault
}

TEST_CASE("the answer is that of the frame that presses hardest", "[report][recording]") {
  const lab::RecordingOverview overview = press(61);
  const lab::FrameGroup& peak = overview.peak();
  CHECK(peak.shown == 30);
  CHECK_THAT(answers(overview).front().meaning, ContainsSubstring("t = 0.3 s"));
  CHECK_THAT(answers(overview).back().value, ContainsSubstring("all 61 frames"));
  // The pressing stays where it is.
  CHECK_THAT(answers(overview).at(2).meaning, ContainsSubstring("centre of pressure, at"));
}

TEST_CASE("what is shown stands in a CSV, a frame a row, and a file without bands too",
          "[report][recording]") {
  lab::RecordingOverview overview = press(7);
  const auto columns = [](const std::string& line) { return count(line, ","); };
  for (const bool bands : {true, false}) {
    if (!bands)
      for (lab::FrameGroup& group : overview.groups) {
        group.answer.bands.reset();
        group.answer.deviations.clear();
      }
    const std::string csv = recording_csv(overview);
    CHECK(count(csv, "\n") == 8);
    std::size_t at = 0;
    for (int row = 0; row < 8; ++row) {
      const std::size_t end = csv.find('\n', at);
      CHECK(columns(csv.substr(at, end - at)) == 13 + 42 + 1);
      at = end + 1;
    }
    CHECK_FALSE(pages::recording_page(overview, "x.csv", {}, {}).html.empty());
  }
}

}  // namespace tactile_net::report
