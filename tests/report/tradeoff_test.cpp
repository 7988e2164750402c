// A study's words, CSV and JSON: the strings that stand in files which users have, and back.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/pages/tradeoff_page.hpp"
#include "tactile_net/report/json/tradeoff_json.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"
#include "tactile_net/report/words/work_point_words.hpp"
#include "tactile_net/study/study.hpp"
#include "tests/catch.hpp"
#include "tests/report/measured_study.hpp"

using namespace tactile_net;
using namespace tactile_net::study;
using namespace tactile_net::study::by_hand;
using report::in_words;

namespace {

constexpr std::string_view measured_csv =
    R"text(job,curve,knob,time_of,seconds,seconds_low,seconds_high,error_to_solution,error_to_truth,failure
"products with M","dense float64","",frame,5.778125e-08,5.764453125e-08,5.78984375e-08,1.7033990924008643e-14,0.09099117971275954,""
"products with M","reflections float64","",frame,6.8619140625e-08,6.859765625e-08,7.14921875e-08,1.7033990924008643e-14,0.09099117971275951,""
"products with M","reflections low rank float64","rank 11 + 10",frame,1.0003515625e-07,9.912890625e-08,1.008125e-07,1.7033990924008643e-14,0.09099117971275911,""
"products with M","dense float32","",frame,6.48828125e-08,6.48046875e-08,6.49609375e-08,5.813874928759419e-08,0.09099116192355575,""
"products with M","FFT, ends corrected","rank 1 + 1",frame,2.01703125e-07,2.011640625e-07,2.023359375e-07,0.02464185221652351,0.09450559300692017,""
"products with M","FFT, ends corrected","rank 11 + 10",frame,2.25734375e-07,2.250234375e-07,2.268984375e-07,1.7033990924008643e-14,0.09099117971275951,""
"factorisations","closed form (ch. 4)","",frame,1.0093359375e-07,1.00890625e-07,1.010078125e-07,1.7033990924008643e-14,0.09099117971275943,""
"factorisations","QR of every frame","",frame,8.5558e-05,8.5437e-05,8.5978e-05,1.7033990924008643e-14,0.09099117971275976,""
"FFT","FFT, array as a ring","",frame,4.49125e-07,4.2565625e-07,4.550625e-07,0.01324065723876638,0.0915789114965547,""
"FFT","dft: division (ch. 3)","",frame,2.678984375e-07,2.6234375e-07,3.14140625e-07,,0.014448559283121163,""
"FFT","conjugate gradients, FFT","1 steps",frame,1.2844375e-06,1.266875e-06,1.327e-06,0.09055827609573175,0.12906980220190176,""
"FFT","conjugate gradients, FFT","8 steps",frame,1.00805e-05,9.8095e-06,1.0566e-05,1.7033990924008643e-14,0.0909911797127613,""
"constraints","f_v >= 0, active set","2 exchanges",frame,4.847e-06,4.747e-06,4.957e-06,,1,""
"constraints","f_v >= 0, active set","3 exchanges, optimal",frame,7.7165e-05,7.5092e-05,8.1973e-05,,0.06781426742826878,""
"fewer taxels","fewer taxels","11 taxels",frame,3.75654296875e-08,3.69599609375e-08,3.7751953125e-08,,0.17864203451652008,""
"forward model","readings by the integral","15 points a panel",forward,3.0535e-05,3.0506e-05,3.0576e-05,,3.3748688458978654e-12,""
"forward model","readings by the integral","31 points a panel",forward,5.9679e-05,5.9588e-05,6.03e-05,,1.993533033845753e-16,""
"forward model","readings by the integral","31 points, halved to 1e-14",forward,8.9163e-05,8.8973e-05,8.9293e-05,,2.6058022572012957e-16,""
"forward model","readings by the discrete sum","",forward,9.808125e-07,9.79625e-07,1.5366875e-06,,0.05922791636095724,""
"settling, least_squares","least_squares, 10 MHz","settled to 0.01",settling,1.967733926389021e-06,1.967733926389021e-06,1.967733926389021e-06,0.01,,""
"settling, nic","nic, 10 MHz","settled to 0.01",settling,1.1196447234710799e-06,1.1196447234710799e-06,1.1196447234710799e-06,0.01,,""
"settling, nic","nic, 1 MHz","settled to 0.01, scaled from 10 MHz",settling,1.1196447234710799e-05,1.1196447234710799e-05,1.1196447234710799e-05,0.01,,""
"settling, nic","nic, 100 MHz","settled to 0.01, scaled from 10 MHz",settling,1.1196447234710799e-07,1.1196447234710799e-07,1.1196447234710799e-07,0.01,,""
"settling, crossbar","crossbar, 10 MHz","settled to 0.01",settling,4.4482089959001167e-07,4.4482089959001167e-07,4.4482089959001167e-07,0.01,,""
"settling, rail","rail, 10 MHz","settled to 0.01",settling,1.3521296245832036e-06,1.3521296245832036e-06,1.3521296245832036e-06,0.01,,""
"settling, ideal","ideal, 10 pF a node","settled to 0.01",settling,6.326362071232991e-07,6.326362071232991e-07,6.326362071232991e-07,0.01,,""
"ngspice, operating points","nic","operating point",simulator,0.037259756,0.037259756,0.037259756,3.813814133245498e-15,,""
)text";

}  // namespace

TEST_CASE("a study's CSV is byte by byte what it was", "[tradeoff]") {
  CHECK(report::study_csv(measured()) == measured_csv);
}

TEST_CASE("a study's JSON names each point in words, and its answers", "[tradeoff]") {
  const Study study = measured();
  const auto json = nlohmann::json::parse(report::study_json(study, "[sensor]"));
  CHECK(json["kind"] == "tradeoff");
  CHECK(json["schema"] == 1);
  CHECK(json["scene"] == "pressed.toml");
  CHECK(json["complete"] == true);
  CHECK(json["processor"] == study.processor);
  CHECK(json["clock"] == study.clock);
  CHECK(json["alpha"] == study.input.alpha);
  CHECK(json["reference_agreement"] == study.input.agreement);
  CHECK(json["solution_error_to_truth"] == study.input.solution_error);
  CHECK(json["noise"]["rms"] == study.input.noise_rms);
  CHECK(json["noise"]["stated"] == false);
  CHECK(json["noise"]["floor"] == study.input.noise_floor);
  CHECK(json["answers"] == in_words(study));
  CHECK(in_words(study) ==
        std::vector<std::string>{
            "for 1 % error within 1 ms: dense float64: 57.8 ns, error 1.7e-14 (17000 times inside "
            "the deadline, 5.87e+11 times inside the error)",
            "for 1e-06 error within 100 us: dense float64: 57.8 ns, error 1.7e-14 (1700 times "
            "inside the deadline, 5.87e+07 times inside the error)",
            "for 1e-12 error: dense float64: 57.8 ns, error 1.7e-14 (58.7 times inside the error)",
            "regularisation, sampling and the scene's own noise leave the exact solution 9.1 % "
            "away from the truth: no arithmetic can change that",
            "noise of 0.00158 per reading (1 % of the largest, an assumption) moves the solution "
            "by 3.18 %: higher accuracy has no effect that can be seen",
            "the fastest circuit, crossbar with op-amps of 10 MHz, settles to 1 % in 445 ns: "
            "faster than a controller that needs as many cycles as this machine and has a clock "
            "below 480 MHz; it beats this machine's 57.8 ns from a bandwidth of 77 MHz on",
            "the most accurate circuit, least_squares, errs by 0.632 % (median) with parts of 1 %; "
            "crossbar with such parts: 2.81 %"});
  using Names = std::vector<std::string>;
  CHECK(json["pareto"]["error_to_solution"] == Names{"dense float64"});
  CHECK(json["pareto"]["error_to_truth"] == Names{"fewer taxels, 11 taxels", "dense float64",
                                                  "dense float32", "dft: division (ch. 3)"});
  REQUIRE(json["jobs"].size() == study.sections.size());
  for (std::size_t i = 0; i < study.sections.size(); ++i) {
    const auto& job = json["jobs"][i];
    const auto& section = study.sections[i];
    CHECK(job["job"] == in_words(section.job));
    REQUIRE(job["points"].size() == section.points.size());
    for (std::size_t k = 0; k < section.points.size(); ++k) {
      const auto& point = job["points"][k];
      const WorkPoint& expected = section.points[k];
      const auto is = [](const auto& value, const std::optional<double>& number) {
        return number ? value == *number : value.is_null();
      };
      CHECK(point["curve"] == in_words(expected.curve));
      CHECK(point["knob"] == in_words(expected.knob));
      CHECK(point["seconds"]["median"] == expected.seconds);
      CHECK(point["seconds"]["low"] == expected.seconds_low);
      CHECK(point["seconds"]["high"] == expected.seconds_high);
      CHECK(is(point["error_to_solution"], expected.error_to_solution));
      CHECK(is(point["error_to_truth"], expected.error_to_truth));
      CHECK(point["failure"] == "");
    }
    if (section.floors.empty()) continue;
    CHECK(job["parts"].size() == section.floors.size());
    CHECK(job["parts"][0]["realization"] == "nic");
    CHECK(job["parts"][0]["relative"] == 0.01);
    CHECK(job["parts"][0]["median"] == 0.02583539322967185);
  }
}

TEST_CASE("what is read back from a study's JSON is what was written", "[tradeoff]") {
  const Study study = measured();
  const std::string json = report::study_json(study, "[sensor]");
  CHECK(report::finished_jobs(json, "[sensor]", "AMD EPYC") == study.sections);
  const auto refuses = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(report::finished_jobs(text, "[sensor]", "AMD EPYC"), ContainsSubstring(why));
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = json;
    return text.replace(text.find(from), from.size(), to);
  };
  refuses(changed("\"AMD EPYC\"", "\"VAX\""), "on another processor");
  refuses(changed("\"[sensor]\"", "\"[material]\""), "for another scene");
  refuses(changed("\"0.1.0\"", "\"0.0.9\""), "by another version");
  for (const char* word :
       {"\"task\"", "\"method\"", "\"setting\"", "\"kind\": \"products\"", "\"kind\": \"product\"",
        "\"structure\": \"dense\"", "\"kind\": \"ranks\"", "\"frame\"", "\"kind\": \"settling\"",
        "\"realization\": \"nic\""}) {
    CAPTURE(word);
    std::string other = word;
    other.insert(other.size() - 1, "?");
    refuses(changed(word, other), "it is not a study");
  }
  for (const auto& [from, to] : {std::pair{"\"error\": 0.01,", "\"error\": 0.02,"},
                                 std::pair{"\"count\": 8,", "\"count\": -8,"},
                                 std::pair{"\"count\": 8,", "\"count\": 8.5,"}})
    refuses(changed(from, to), "it is not a study");
  // Words are for people: a study that uses other words is the same study.
  for (const auto& [from, to] :
       {std::pair{"\"curve\": \"dense float64\"", "\"curve\": \"full product\""},
        std::pair{"\"knob\": \"rank 11 + 10\"", "\"knob\": \"\""},
        std::pair{"\"job\": \"settling, nic\"", "\"job\": \"how soon\""}})
    CHECK(report::finished_jobs(changed(from, to), "[sensor]", "AMD EPYC") == study.sections);
  refuses("[]", "it is not a study");
  refuses("tractions", "it is not a study");
}

TEST_CASE("every curve, knob and job that there is comes back from a study's JSON", "[tradeoff]") {
  Study study = measured();
  // Nothing was measured: no answer is drawn from these points.
  const auto add_point = [&](const WorkCurve& curve, const Knob& knob) {
    WorkPoint point;
    point.curve = curve;
    point.knob = knob;
    point.failure = Failure{.what = "left out"};
    study.sections.back().points.push_back(point);
  };
  for (const Job& job : every_job()) {
    study.sections.push_back({.job = job});
    add_point({.family = Family::job, .job = job}, {});
  }
  for (const WorkCurve& curve : every_curve()) add_point(curve, {});
  for (const Knob& knob : every_knob()) add_point({.family = Family::closed_form}, knob);
  CHECK(report::finished_jobs(report::study_json(study, "[sensor]"), "[sensor]", "AMD EPYC") ==
        study.sections);
}

TEST_CASE("each coarser surface has a bar of its own: its values, its time, its error",
          "[tradeoff]") {
  Study study = measured();
  study.sections.push_back({.job = {Kind::coarser_surface}});
  for (const auto& [count, error] :
       {std::pair{std::size_t{39}, 0.21}, std::pair{std::size_t{19}, 0.34}})
    add(study, {Family::coarser_surface}, {.kind = Setting::surface_values, .count = count},
        TimeOf::frame, {5e-8, 4e-8, 6e-8}, {}, error);
  const std::string html = pages::study_html(study).html;
  CHECK_THAT(html, ContainsSubstring("coarser surface, 39 surface values, 50 ns: 21 %"));
  CHECK_THAT(html, ContainsSubstring("coarser surface, 19 surface values, 50 ns: 34 %"));
}

TEST_CASE("a failure is told in words, and stays in the study", "[tradeoff]") {
  Study study = measured();
  const std::size_t points = study.points().size();
  const auto fail = [&](const Job& job, const WorkCurve& curve, TimeOf time_of, Failure failure) {
    WorkPoint point;
    point.curve = curve;
    point.time_of = time_of;
    point.failure = std::move(failure);
    study.sections.push_back({.job = job, .points = {point}});
  };
  using Why = Failure::Kind;
  const WorkCurve coarse{.family = Family::fewer_taxels};
  fail({Kind::fewer_taxels}, coarse, TimeOf::frame, {.kind = Why::dead_taxels});
  fail({Kind::fewer_taxels}, coarse, TimeOf::frame, {.kind = Why::no_stride, .count = 24});
  fail({Kind::forward_model}, {.family = Family::job, .job = Job{Kind::forward_model}},
       TimeOf::frame, {.what = "the integral is known only to 0.1"});
  const WorkCurve slow = circuit(Realization::least_squares, 100e6);
  const Job settling{Kind::settling, Realization::least_squares};
  fail(settling, slow, TimeOf::settling,
       {.kind = Why::not_stable, .stability = Stability::unstable});
  fail(settling, slow, TimeOf::settling, {.kind = Why::unsettled});
  fail(settling, slow, TimeOf::settling, {.kind = Why::no_time});
  CHECK(report::failures_in_words(study) ==
        std::vector<std::string>{
            "fewer taxels: the scene has dead taxels",
            "fewer taxels: no stride leaves both ends of 24 taxels in place",
            "forward model: the integral is known only to 0.1",
            "least_squares, 100 MHz: no settling: unstable",
            "least_squares, 100 MHz: it does not settle",
            "least_squares, 100 MHz: it takes no time",
        });
  CHECK(study.points().size() == points + 6);
  CHECK_THAT(
      report::study_csv(study),
      EndsWith("\"settling, least_squares\",\"least_squares, 100 MHz\",\"\",settling,0,0,0,,,"
               "\"it takes no time\"\n"));
  const auto again =
      report::finished_jobs(report::study_json(study, "[sensor]"), "[sensor]", "AMD EPYC");
  REQUIRE(again.size() == study.sections.size());
  CHECK_FALSE(again.back().whole());
  CHECK(in_words(*again.back().points.front().failure) == "it takes no time");
}

TEST_CASE("circuits are compared at one bandwidth and one error", "[tradeoff]") {
  const std::vector<std::vector<std::string>> expected = {
      {"circuit", "settles to 1 %", "beats a clock below", "beats this machine from",
       "parts of 1 % leave"},
      {"crossbar", "445 ns", "480 MHz", "77 MHz", "2.81 %"},
      {"nic", "1.12 us", "191 MHz", "194 MHz", "2.58 %"},
      {"rail", "1.35 us", "158 MHz", "234 MHz", "11.9 %"},
      {"least_squares", "1.97 us", "108 MHz", "341 MHz", "0.632 %"}};
  CHECK(report::circuit_cells(measured()) == expected);
  const auto front = report::front_cells(measured());
  REQUIRE(front.size() == 2);
  CHECK(front[1] == std::vector<std::string>{"dense float64", "57.8 ns", "57.6 ns ... 57.9 ns",
                                             "1.7e-14", "0.091"});
}

TEST_CASE("the page's data draw each circuit once, and its times over the bandwidth",
          "[tradeoff]") {
  std::string circuits;
  std::string crossover;
  for (const auto& [name, content] : pages::study_html(measured()).files) {
    if (name == "circuits.csv") circuits = content;
    if (name == "crossover.csv") crossover = content;
  }
  CHECK(circuits == R"text(curve,|f - f*| / |f*|,time to settle [s]
"least_squares, 10 MHz",0.01,1.967733926389021e-06
"nic, 10 MHz",0.01,1.1196447234710799e-06
"crossbar, 10 MHz",0.01,4.4482089959001167e-07
"rail, 10 MHz",0.01,1.3521296245832036e-06
"ideal, 10 pF a node",0.01,6.326362071232991e-07
"nic, 1 % parts",0.02583539322967185,4.4482089959001167e-07
"nic, 1 % parts",0.02583539322967185,1.967733926389021e-06
"rail, 1 % parts",0.11861615111565246,4.4482089959001167e-07
"rail, 1 % parts",0.11861615111565246,1.967733926389021e-06
"crossbar, 1 % parts",0.02813582738906404,4.4482089959001167e-07
"crossbar, 1 % parts",0.02813582738906404,1.967733926389021e-06
"least_squares, 1 % parts",0.006320167423327584,4.4482089959001167e-07
"least_squares, 1 % parts",0.006320167423327584,1.967733926389021e-06
"arithmetic here, 57.8 ns",1e-04,5.778125e-08
"arithmetic here, 57.8 ns",1,5.778125e-08
)text");
  CHECK(crossover == R"text(curve,gain-bandwidth of the op-amps [Hz],time [s]
least_squares,1e+07,1.967733926389021e-06
nic,1e+06,1.1196447234710799e-05
nic,1e+07,1.1196447234710799e-06
nic,1e+08,1.1196447234710799e-07
crossbar,1e+07,4.4482089959001167e-07
rail,1e+07,1.3521296245832036e-06
this machine,1e+06,5.778125e-08
this machine,1e+08,5.778125e-08
a controller of 400 MHz,1e+06,5.335087861422337e-07
a controller of 400 MHz,1e+08,5.335087861422337e-07
a controller of 100 MHz,1e+06,2.134035144568935e-06
a controller of 100 MHz,1e+08,2.134035144568935e-06
)text");
}

TEST_CASE("arrays of other sizes: a row each, a loop's verdict, and where a circuit is faster",
          "[tradeoff]") {
  Study study;
  CHECK(report::size_cells(study).size() == 1);
  CHECK(report::sizes_in_words(study).empty());
  study.sections.push_back({.job = {Kind::array_sizes}});
  const auto timed = [&](const WorkCurve& curve, std::size_t side, TimeOf time_of, double seconds) {
    add(study, curve, {.kind = Setting::array, .rows = side, .columns = side}, time_of,
        {seconds, seconds, seconds}, {}, {});
  };
  const WorkCurve exact = product(Structure::reflections, Precision::float64);
  const WorkCurve single = product(Structure::reflections, Precision::float32);
  const WorkCurve coarse{.family = Family::coarse_cells};
  for (const auto& [side, seconds] :
       {std::pair<std::size_t, double>{8, 4e-6}, {16, 40e-6}, {32, 4e-3}}) {
    timed(exact, side, TimeOf::frame, seconds);
    timed(single, side, TimeOf::frame, 0.5 * seconds);
    timed(coarse, side, TimeOf::frame, 0.25 * seconds);
  }
  timed(product(Structure::dense, Precision::float64), 8, TimeOf::frame, 20e-6);
  CHECK(
      report::sizes_in_words(study) ==
      std::vector<std::string>{
          "in a loop of 1 kHz a frame of 16 x 16 such taxels takes 40 us exactly, 20 us in single "
          "precision and 10 us with one cell a taxel: in time; one of 32 x 32 such taxels takes "
          "4 ms exactly, 2 ms in single precision and 1 ms with one cell a taxel: in time "
          "only with one cell a taxel"});
  CHECK(report::size_cells(study)[1] ==
        std::vector<std::string>{"8 x 8", "20 us", "4 us", "2 us", "1 us", "-"});

  const WorkCurve circuit_of_two = circuit(Realization::least_squares, 10e6);
  const auto crossover = [&] { return report::sizes_in_words(study).back(); };
  timed(circuit_of_two, 4, TimeOf::settling, 2e-6);  // no arithmetic beside it
  timed(circuit_of_two, 8, TimeOf::settling, 3e-6);
  CHECK_THAT(crossover(),
             EndsWith("on none up to 8 x 8 (3 us beside 1 us); if it settles no slower "
                      "there, from 16 x 16 on (10 us)"));
  timed(circuit_of_two, 16, TimeOf::settling, 3e-6);
  CHECK_THAT(crossover(), EndsWith("from 16 x 16 taxels on (3 us beside 10 us)"));
  timed(circuit_of_two, 32, TimeOf::settling, 1.0);
  CHECK_THAT(crossover(), EndsWith("on none up to 32 x 32 taxels"));
  CHECK(in_words(study.points().front()) == "reflections float64, 8 x 8 taxels");
}
