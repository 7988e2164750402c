// Contacts that move, in a study's words, JSON and page.
#include "tactile_net/pages/tradeoff_page.hpp"
#include "tactile_net/report/json/tradeoff_json.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tests/catch.hpp"
#include "tests/report/measured_study.hpp"

using namespace tactile_net;
using namespace tactile_net::study;

namespace {

/// 20 % of the answer a millimetre; parts of 1 % leave the crossbar 2.8 % off.
Study with_moving() {
  Study study = by_hand::measured();
  study.sections.push_back({.job = {Job::Kind::moving}});
  study.sections.back().moving =
      MovingContacts{.displacements = {1e-5, 1e-4, 4e-3},
                     .errors = {2e-3, 2e-2, 0.8},
                     .followers = {{.realization = Realization::crossbar, .delay = 1e-6},
                                   {.realization = Realization::least_squares, .delay = 2e-6},
                                   {.sampling_hertz = 1e3, .delay = 5e-4},
                                   {.sampling_hertz = 10e3, .delay = 5e-5}}};
  return study;
}

}  // namespace

TEST_CASE("moving contacts: the circuit that bears its parts best, and from where it is nearer",
          "[tradeoff][moving]") {
  const Study study = with_moving();
  const std::string text = report::moving_in_words(study);
  CHECK_THAT(text, ContainsSubstring("least_squares with op-amps of 10 MHz is 2 us behind"));
  CHECK_THAT(text, ContainsSubstring("a loop of 1 kHz errs as much at"));
  CHECK_THAT(text, ContainsSubstring("more than the circuit of 1 % parts (0.632 %) from"));
  const auto rows = report::moving_cells(study);
  REQUIRE(rows.size() == 5);
  REQUIRE(rows[0].size() == 5);
  CHECK(rows[0][3] == "nearer than a loop of 1 kHz from");
  CHECK(rows[1][0] == "crossbar");
  CHECK(rows[1][1] == "1 us");
  CHECK(rows[3][0] == "a loop of 1 kHz");
  CHECK(rows[3][3] == "-");
  for (const auto& row : rows) CHECK(row.size() == 5);
  CHECK(report::in_words(study).back() == text);
  CHECK(report::moving_in_words(by_hand::measured()).empty());
  CHECK(report::moving_cells(by_hand::measured()).size() == 1);
}

TEST_CASE("what follows contacts is read back as it was written", "[tradeoff][moving]") {
  const Study study = with_moving();
  const std::string json = report::study_json(study, "[sensor]");
  CHECK(report::finished_jobs(json, "[sensor]", "AMD EPYC") == study.sections);
  std::string other = json;
  other.replace(other.find("\"displacements\""), 15, "\"displacement\"");
  CHECK_THROWS_WITH(report::finished_jobs(other, "[sensor]", "AMD EPYC"),
                    ContainsSubstring("it is not a study"));
}

TEST_CASE("the page draws error over speed of every follower", "[tradeoff][moving]") {
  const auto page = pages::study_html(with_moving());
  CHECK_THAT(page.html, ContainsSubstring("Contacts that move"));
  CHECK_THAT(page.html, ContainsSubstring("nearer than a loop of 10 kHz from"));
  bool drawn = false;
  for (const auto& [file, content] : page.files) {
    if (file != "moving.csv") continue;
    drawn = true;
    CHECK_THAT(content, ContainsSubstring("a loop of 1 kHz"));
    CHECK_THAT(content, ContainsSubstring("crossbar, 1 % parts"));
  }
  CHECK(drawn);
  CHECK_THAT(pages::study_html(by_hand::measured()).html, !ContainsSubstring("that move"));
}
