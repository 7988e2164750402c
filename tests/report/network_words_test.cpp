#include "tactile_net/report/words/network_words.hpp"

#include <limits>

#include "tactile_net/report/words/opamp_words.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a remark's sentence holds the number that mends the circuit", "[report][network]") {
  using Kind = CircuitRemark::Kind;
  for (const auto& [kind, key] : {std::pair(Kind::clamps, "volts = 0.125"),
                                  {Kind::divider_rings, "divider = 0.125 at most"},
                                  {Kind::summing_lag, "siemens = 0.125 or more"},
                                  {Kind::not_for_sale, "siemens = 0.125 would"},
                                  {Kind::odd_voltage, "volts = 0.125 would"},
                                  {Kind::slews, "volts is at most 0.125"}})
    CHECK_THAT(report::in_words(CircuitRemark{.kind = kind, .value = 7.0, .repair = 0.125}),
               ContainsSubstring(key));
}

TEST_CASE("an output that carries too much is named, with what it would carry",
          "[report][network]") {
  const CircuitRemark remark{.kind = CircuitRemark::Kind::output_current,
                             .value = 0.05,
                             .limit = 0.02,
                             .repair = 0.4,
                             .part = "Xn3"};
  const std::string text = report::in_words(remark);
  CHECK_THAT(text, ContainsSubstring("the output of Xn3 would carry 50 mA, it gives 20 mA"));
  CHECK_THAT(text, ContainsSubstring("volts = 0.4"));
  Certificate certificate;
  certificate.output_current = OutputCurrent{.largest = 0.05, .opamp = "Xn3"};
  CHECK(report::opamps_in_words(certificate).back() ==
        "an output carries at most 50 mA at rest, that of Xn3");
  certificate.noise =
      CircuitNoise{.largest = 1e-4, .relative = 0.01, .thermal = 0.5, .flicker = 0.1};
  CHECK_THAT(report::opamps_in_words(certificate).front(),
             ContainsSubstring("10 % from the op-amps' 1/f noise above 0.1 Hz"));
}

TEST_CASE("a study of arrays says what they are, and names no parts that were not drawn",
          "[report][network]") {
  const ToleranceResult result{.trials = 1, .stable = 1, .errors = {0.01}, .median = 0.01};
  const std::vector<std::string> lines =
      report::in_words(ToleranceOptions{.bits = 8, .wire_resistance = 0.5}, result);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0],
             ContainsSubstring("1 build of arrays of 8 bits, lines of 0.5 ohm a segment:"));
  ToleranceResult drawn = result;
  drawn.worst = {{"Rk0_0", 0.5}};
  CHECK(report::in_words(ToleranceOptions{.relative = 0.01, .cell_noise = 0.005}, drawn).size() ==
        2);
}

TEST_CASE("a lag beyond its bound names the bandwidth ratio that mends it", "[report][network]") {
  const CircuitRemark remark{
      .kind = CircuitRemark::Kind::summing_lag, .value = 9.0, .limit = 0.25, .repair = 2e-3};
  const std::string text = report::in_words(remark);
  CHECK_THAT(text, ContainsSubstring("bandwidth_ratio = 0.25 or less"));
  CHECK_THAT(text, ContainsSubstring("siemens = 0.002 or more"));
}

TEST_CASE("what op-amps do at rest is said as far as it is known", "[report][network]") {
  Certificate certificate;
  certificate.errors = StaticErrors{.offset = {.alike = 0.002, .either_sign = 0.01}};
  const std::vector<std::string> lines = report::opamps_in_words(certificate);
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], ContainsSubstring("offset 1 % of the answer"));
  CHECK_THAT(lines[0], ContainsSubstring("0.2 % if all have one sign"));
  CHECK_THAT(lines[0], !ContainsSubstring("bias"));
  CHECK(report::opamps_in_words(Certificate{}).empty());
}

TEST_CASE("a moving contact's sentence has units where the scene has them", "[report][network]") {
  const lab::ContactMotion motion{
      .delay = 1e-7, .speed = 134.0, .slowest_hertz = 3e5, .sampled_speed = 0.0146};
  const std::string with = report::in_words(motion, Units{});
  CHECK_THAT(with, ContainsSubstring("134 m/s"));
  CHECK_THAT(with, ContainsSubstring("300 kHz"));
  CHECK_THAT(with, ContainsSubstring("1 % at 14.6 mm/s"));
  CHECK_THAT(report::in_words(motion, {}), !ContainsSubstring("m/s"));
}

TEST_CASE("a theorem that holds has no condition to name", "[report][network]") {
  CHECK(report::condition_in_words(Theorem{.name = "T5"}).empty());
  const UnmetCondition ratio{.condition = TheoremCondition::main_at_most_half_of_inverters,
                             .bandwidth_ratio = 0.75};
  CHECK_THAT(report::condition_in_words(Theorem{.name = "T3", .unmet = ratio}),
             ContainsSubstring("0.75 times"));
}

TEST_CASE("warnings of a relaxation begin with its certificate's, each once", "[report][network]") {
  lab::Relaxation relaxation;
  relaxation.certificate = Certificate{};
  relaxation.certificate->remarks = {{.kind = CircuitRemark::Kind::too_many_states}};
  relaxation.remarks = {{lab::RelaxationRemark::Kind::no_load}};
  const std::vector<std::string> warnings = report::warnings_of(relaxation);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0] == report::in_words(relaxation.certificate->remarks[0]));
  CHECK(warnings[1] == report::in_words(relaxation.remarks[0]));
}

TEST_CASE("a ladder's form, lag and missing noise have their words", "[report][network]") {
  CHECK(report::circuit_in_words(Realization::least_squares, true) ==
        "least_squares with a ladder");
  CHECK(report::circuit_in_words(Realization::lattice, false) == "lattice");
  const UnmetCondition lag{.condition = TheoremCondition::lag_within_bound,
                           .lag = {.number = 7.0, .of_nodes = true}};
  CHECK_THAT(report::condition_in_words(Theorem{.name = "T6L", .unmet = lag}),
             ContainsSubstring("the ladder's nodes is 7 times"));
  using Kind = CircuitRemark::Kind;
  const std::string words = report::in_words(
      CircuitRemark{.kind = Kind::node_lag, .value = 7.0, .limit = 0.14, .repair = 7e-3});
  CHECK_THAT(words, ContainsSubstring("siemens = 0.007 or more, or bandwidth_ratio = 0.14"));
  CHECK_THAT(report::in_words(CircuitRemark{.kind = Kind::noise_without_capacitance}),
             ContainsSubstring("parasitic = { node"));
}

TEST_CASE("a lag for which nothing is proven is no infinite multiple", "[report][network]") {
  const auto said = [](double value) {
    return report::in_words(
        CircuitRemark{.kind = CircuitRemark::Kind::summing_lag, .value = value, .repair = 7.0});
  };
  CHECK(said(1.5) ==
        "the lag of summing nodes and second poles is 1.5 times the largest that is proven stable: "
        "set siemens = 7 or more");
  CHECK(
      said(std::numeric_limits<double>::infinity()) ==
      "the lag of summing nodes and second poles is far beyond the largest that is proven stable: "
      "set siemens = 7 or more");
}
