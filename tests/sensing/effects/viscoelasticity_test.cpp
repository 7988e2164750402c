#include "tactile_net/sensing/effects/viscoelasticity.hpp"

#include <cmath>
#include <vector>

#include "sensing/effects/creep.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const SensorArray one_taxel{1, 1.0, {1.0}, {Quantity::strain_x}};
const std::vector<PronyTerm> prony_terms{{0.3, 0.05}, {0.2, 1.0}, {0.1, 1.1}, {0.05, 40.0}};

/// Strains at `times` under an elastic strain `in(t)`, a straight line between the times.
std::vector<double> strains(const std::vector<PronyTerm>& terms, const std::vector<double>& times,
                            auto in) {
  const auto stage = make_effect(Viscoelasticity{terms}, one_taxel);
  std::vector<double> out;
  double before = 0.0;
  for (const double t : times) {
    std::vector<double> readings{in(t)};
    stage->apply({.time = t, .since = t - before}, readings);
    out.push_back(readings[0]);
    before = t;
  }
  return out;
}

std::vector<double> equal_steps(double end, int steps) {
  std::vector<double> times;
  for (int i = 0; i <= steps; ++i) times.push_back(end * i / steps);
  return times;
}

}  // namespace

TEST_CASE("one Prony term creeps as the standard linear solid", "[effects]") {
  // g and tau: compliance g / (1 - g), retardation time tau / (1 - g).
  for (const double g : {1e-9, 0.3, 0.9, 0.999}) {
    CAPTURE(g);
    const std::vector<CreepTerm> creep = creep_terms(std::vector<PronyTerm>{{g, 2.0}});
    REQUIRE(creep.size() == 1);
    CHECK_THAT(creep[0].compliance, WithinRel(g / (1.0 - g), 1e-12));
    CHECK_THAT(creep[0].time, WithinRel(2.0 / (1.0 - g), 1e-12));
  }
}

TEST_CASE("modulus and compliance are each other's inverse at every rate", "[effects][property]") {
  // The Carson transforms: (1 - sum g / (1 + s tau)) (1 + sum c / (1 + s lambda)) = 1.
  const std::vector<CreepTerm> creep = creep_terms(prony_terms);
  REQUIRE(creep.size() == prony_terms.size());
  for (double s = 0.0; s < 1e4; s = s * 1.7 + 1e-3) {
    double modulus = 1.0;
    for (const PronyTerm& term : prony_terms) modulus -= term.fraction / (1.0 + s * term.time);
    double compliance = 1.0;
    for (const CreepTerm& term : creep) compliance += term.compliance / (1.0 + s * term.time);
    CAPTURE(s);
    CHECK_THAT(modulus * compliance, WithinRel(1.0, 1e-13));
  }
}

TEST_CASE("retardation times lie between the relaxation times", "[effects][property]") {
  const std::vector<CreepTerm> creep = creep_terms(prony_terms);
  for (std::size_t i = 0; i < creep.size(); ++i) {
    CHECK(creep[i].compliance > 0.0);
    CHECK(creep[i].time > prony_terms[i].time);
    if (i + 1 < creep.size()) CHECK(creep[i].time < prony_terms[i + 1].time);
  }
}

TEST_CASE("terms that say the same count once, terms of nothing do not count", "[effects]") {
  const std::vector<PronyTerm> twice{{0.1, 1.0}, {0.0, 7.0}, {0.2, 1.0}};
  const std::vector<CreepTerm> creep = creep_terms(twice);
  REQUIRE(creep.size() == 1);
  CHECK_THAT(creep[0].compliance, WithinRel(0.3 / 0.7, 1e-12));
  CHECK(creep_terms(std::vector<PronyTerm>{{0.0, 1.0}}).empty());
}

TEST_CASE("a sudden load shows E at once, the creep compliance then, and E (1 - sum g) in the end",
          "[effects][property]") {
  const std::vector<CreepTerm> terms = creep_terms(prony_terms);
  const std::vector<double> times =
      GENERATE(std::vector<double>{0.0, 0.01, 0.3, 5.0, 1e4}, std::vector<double>{0.0, 1e4},
               std::vector<double>{0.0, 1e-9, 1.0, 1.5, 20.0, 1e4});
  const std::vector<double> out = strains(prony_terms, times, [](double) { return 2.0; });
  CHECK(out.front() == 2.0);
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(out[i], WithinRel(2.0 * creep(terms, times[i]), 1e-13));
  CHECK_THAT(out.back(), WithinRel(2.0 / (1.0 - 0.65), 1e-12));
  CHECK_THAT(relaxation(prony_terms, 1e4), WithinRel(1.0 - 0.65, 1e-12));
}

TEST_CASE("a load that relaxes like the modulus holds the strain", "[effects][property]") {
  // Each term alone, and all together; the error of straight lines is of second order.
  std::vector<std::vector<PronyTerm>> pads{prony_terms};
  for (const PronyTerm& term : prony_terms) pads.push_back({term});
  for (const auto& terms : pads) {
    const auto load = [&](double t) { return 3.0 * relaxation(terms, t); };
    const auto error = [&](int steps) {
      double worst = 0.0;
      for (const double strain : strains(terms, equal_steps(2.0, steps), load))
        worst = std::max(worst, std::abs(strain / 3.0 - 1.0));
      return worst;
    };
    CHECK(error(4000) < 1e-5);
    CHECK(error(4000) < error(2000) / 3.5);
  }
}

TEST_CASE("a ramp's strain does not depend on the frames in between", "[effects][property]") {
  const auto ramp = [](double t) { return 0.5 * t; };
  const double whole = strains(prony_terms, {0.0, 3.0}, ramp).back();
  for (const int steps : {2, 30, 5000})
    CHECK_THAT(strains(prony_terms, equal_steps(3.0, steps), ramp).back(), WithinRel(whole, 1e-12));
}

TEST_CASE("strains superpose", "[effects][property]") {
  const std::vector<double> times = equal_steps(2.0, 20);
  const auto a = [](double t) { return std::sin(3.0 * t); };
  const auto b = [](double t) { return t < 0.7 ? 0.0 : 1.0; };
  const auto out_a = strains(prony_terms, times, a);
  const auto out_b = strains(prony_terms, times, b);
  const auto both = strains(prony_terms, times, [&](double t) { return 2.0 * a(t) - 5.0 * b(t); });
  for (std::size_t i = 0; i < times.size(); ++i)
    CHECK_THAT(both[i], WithinAbs(2.0 * out_a[i] - 5.0 * out_b[i], 1e-13));
}

TEST_CASE("stresses under given loads do not creep", "[effects]") {
  const SensorArray stresses{2, 1.0, {1.0}, {Quantity::stress_x, Quantity::shear_xy}};
  CHECK(make_effect(Viscoelasticity{prony_terms}, stresses) == nullptr);
  const SensorArray mixed{1, 1.0, {1.0}, {Quantity::stress_x, Quantity::strain_y}};
  const auto stage = make_effect(Viscoelasticity{prony_terms}, mixed);
  std::vector<double> readings{1.0, 1.0};
  stage->apply({}, readings);
  readings = {1.0, 1.0};
  stage->apply({.time = 1.0, .since = 1.0}, readings);
  CHECK(readings[0] == 1.0);
  CHECK_THAT(readings[1], WithinRel(creep(creep_terms(prony_terms), 1.0), 1e-13));
}
