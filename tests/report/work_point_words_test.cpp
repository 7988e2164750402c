#include "tactile_net/report/words/work_point_words.hpp"

#include <set>
#include <string>
#include <vector>

#include "tests/catch.hpp"
#include "tests/report/measured_study.hpp"

using namespace tactile_net;
using namespace tactile_net::study;
using namespace tactile_net::study::by_hand;
using report::curve_named;
using report::in_words;
using report::job_named;
using report::knob_named;

TEST_CASE("every curve, knob and job that there is comes back from its words, and no two are alike",
          "[tradeoff]") {
  std::vector<WorkCurve> curves = {ideal_circuit(10e-12)};
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank})
    for (const Precision precision : {Precision::float64, Precision::float32})
      curves.push_back(product(structure, precision));
  curves.push_back(product(Structure::fft, Precision::float64));
  for (int i = static_cast<int>(Family::closed_form); i < static_cast<int>(Family::circuit); ++i)
    curves.push_back({.family = static_cast<Family>(i)});
  for (const Realization realization : realizations) {
    curves.push_back(circuit(realization));
    curves.push_back(circuit(realization, 10e6));
    curves.back().tractions = 300;
    for (const double bandwidth : bandwidths) curves.push_back(circuit(realization, bandwidth));
  }
  std::set<std::string> seen;
  for (const WorkCurve& curve : curves) {
    CAPTURE(in_words(curve));
    CHECK(curve_named(in_words(curve)) == curve);
    CHECK(seen.insert(in_words(curve)).second);
  }

  std::vector<Knob> knobs = {{},
                             {.kind = Setting::ranks, .ranks = {7}},
                             {.kind = Setting::ranks, .ranks = {24, 23}},
                             {.kind = Setting::exchanges, .count = 5, .optimal = true},
                             {.kind = Setting::steps, .count = 5, .optimal = true},
                             {.kind = Setting::array, .rows = 16, .columns = 8},
                             {.kind = Setting::halved_panels},
                             {.kind = Setting::operating_point}};
  for (const Setting kind : {Setting::steps, Setting::exchanges, Setting::taxels,
                             Setting::surface_values, Setting::panel_points, Setting::terms})
    knobs.push_back({.kind = kind, .count = 12});
  for (std::size_t level = 0; level < settling_levels.size(); ++level)
    for (const bool by_poles : {false, true})
      for (const bool scaled : {false, true})
        knobs.push_back(
            {.kind = Setting::settled, .level = level, .by_poles = by_poles, .scaled = scaled});
  seen.clear();
  for (const Knob& knob : knobs) {
    CAPTURE(in_words(knob));
    CHECK(knob_named(in_words(knob)) == knob);
    CHECK(seen.insert(in_words(knob)).second);
  }

  seen.clear();
  for (int i = 0; i <= static_cast<int>(Kind::operating_points); ++i) {
    Job job{static_cast<Kind>(i)};
    if (job.kind == Kind::settling) job.realization = Realization::crossbar;
    CAPTURE(in_words(job));
    CHECK(job_named(in_words(job)) == job);
    CHECK(seen.insert(in_words(job)).second);
  }
  // A capacitance of the scene keeps the digits that were written: the words stay as they are.
  for (const double farad : {12.3456e-12, 1e-9, 3.3e-18, 0.47e-6}) {
    const std::string words = in_words(ideal_circuit(farad));
    CAPTURE(words);
    REQUIRE(curve_named(words));
    CHECK(in_words(*curve_named(words)) == words);
  }
  // As studies of an older version call it.
  CHECK(curve_named("parity low rank float64") ==
        product(Structure::reflections_low_rank, Precision::float64));
  for (const char* word :
       {"", "nic, 20 MHz", "ideal,  pF a node", "nic, pF a node", "Dense float64",
        "nic of  tractions", "nic of 3 tractions, 20 MHz", "nic tractions of "})
    CHECK_FALSE(curve_named(word));
  for (const char* word : {"rank ", "rank 3 + ", "-1 steps", "1.5 steps", " steps",
                           "settled to 0.5", "16 x taxels", " x 16 taxels", "16 x 16"})
    CHECK_FALSE(knob_named(word));
}

TEST_CASE("how far a study is, in words", "[tradeoff]") {
  const Job job{Kind::settling, Realization::nic};
  CHECK(in_words(StudyProgress{.job = job}) == "0 %, settling, nic");
  CHECK(in_words(StudyProgress{.job = job, .share = 0.25, .seconds_left = 33.2}) ==
        "25 %, settling, nic, about 34 s left");
  CHECK(in_words(StudyProgress{.job = job, .stopping = true}) ==
        "stopping, after what has begun ...");
}
