#include "tactile_net/report/words/work_point_words.hpp"

#include <set>
#include <string>

#include "tests/catch.hpp"
#include "tests/report/measured_study.hpp"

using namespace tactile_net;
using namespace tactile_net::study;
using namespace tactile_net::study::by_hand;
using report::in_words;

TEST_CASE("no two curves, knobs or jobs have the same words", "[tradeoff]") {
  std::set<std::string> seen;
  for (const WorkCurve& curve : every_curve()) {
    CAPTURE(in_words(curve));
    CHECK(seen.insert(in_words(curve)).second);
  }
  seen.clear();
  for (const Knob& knob : every_knob()) {
    CAPTURE(in_words(knob));
    CHECK(seen.insert(in_words(knob)).second);
  }
  seen.clear();
  for (const Job& job : every_job()) {
    CAPTURE(in_words(job));
    CHECK(seen.insert(in_words(job)).second);
  }
}

TEST_CASE("how far a study is, in words", "[tradeoff]") {
  const Job job{Kind::settling, Realization::nic};
  CHECK(in_words(StudyProgress{.job = job}) == "0 %, settling, nic");
  CHECK(in_words(StudyProgress{.job = job, .share = 0.25, .seconds_left = 33.2}) ==
        "25 %, settling, nic, about 34 s left");
  CHECK(in_words(StudyProgress{.job = job, .stopping = true}) ==
        "stopping, after what has begun ...");
}
