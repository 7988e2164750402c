#include "tactile_net/report/words/network_words.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("a remark's sentence holds the number that mends the circuit", "[report][network]") {
  using Kind = CircuitRemark::Kind;
  for (const auto& [kind, key] : {std::pair(Kind::clamps, "volts = 0.125"),
                                  {Kind::divider_rings, "divider = 0.125 at most"},
                                  {Kind::summing_lag, "siemens = 0.125 or more"},
                                  {Kind::not_for_sale, "siemens = 0.125 would"},
                                  {Kind::odd_voltage, "volts = 0.125 would"}})
    CHECK_THAT(report::in_words(CircuitRemark{.kind = kind, .value = 7.0, .repair = 0.125}),
               ContainsSubstring(key));
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
