#include "tactile_net/lab/workload.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::lab;

const std::string sensor =
    "[sensor]\ncount = 5\npitch = 0.5\ndepth = 1.5\nreads = [\"strain_x\", \"shear_xy\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[noise]\nrms = { strain_x = 1e-3, shear_xy = 1e-3 }\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 0.5\nforce = 1\n";

Scene parse(const std::string& rest) { return parse_scene(sensor + rest, "s.toml"); }

std::vector<Computation> done(const ScenePlan& plan) {
  std::vector<Computation> result;
  for (const PlannedComputation& one : plan.computations) {
    CHECK_FALSE(one.why.empty());
    CHECK(one.cost.empty() != one.done);
    if (one.done) result.push_back(one.what);
  }
  return result;
}
std::vector<Computation> done(const std::string& rest, const PlanRequest& request = {}) {
  return done(make_plan(parse(rest), request));
}

using enum Computation;
using List = std::vector<Computation>;

}  // namespace

TEST_CASE("every computation is named once, whether it is done or not", "[plan]") {
  const ScenePlan plan = make_plan(parse(""));
  for (const PlannedComputation& one : plan.computations)
    CHECK(std::count_if(plan.computations.begin(), plan.computations.end(), [&](const auto& other) {
            return name(other.what) == name(one.what);
          }) == 1);
  CHECK(plan.computations.size() == static_cast<std::size_t>(Computation::report) + 1);
}

TEST_CASE("rules are compared where one chooses alpha, or on request", "[plan]") {
  const std::string given = "[reconstruct]\nalpha = 1e-3\n";
  CHECK(done("") == List{readings, tikhonov, rule_comparison, bands, hidden_modes});
  CHECK(done(given) == List{readings, tikhonov, bands, hidden_modes});
  CHECK(done(given, {.compare_rules = true}) ==
        List{readings, tikhonov, rule_comparison, bands, hidden_modes});
  CHECK(done("[reconstruct]\nmethods = [\"dft\"]\n", {.compare_rules = true}) ==
        List{readings, dft});
}

TEST_CASE("a circuit brings what its table asks for, and nothing else", "[plan]") {
  const std::string network =
      "[reconstruct]\nmethods = [\"network\"]\nalpha = 1e-3\n[network]\nrealization = \"nic\"\n";
  CHECK(done(network) == List{readings, circuit});
  CHECK(done(network + "opamp = { gain = 1e5 }\n") == List{readings, circuit, certificate});
  CHECK(done(network + "settling = { accuracy = 1e-3 }\n") ==
        List{readings, circuit, certificate, transient});
  CHECK(done(network + "tolerance = { relative = 0.01 }\n") ==
        List{readings, circuit, certificate, tolerance});
  // The table alone builds no circuit.
  CHECK(done("[network]\nsettling = { accuracy = 1e-3 }\n[reconstruct]\nalpha = 1\n") ==
        List{readings, tikhonov, bands, hidden_modes});
}

TEST_CASE("the second unknown and the layer's integrals come only where they are called for",
          "[plan]") {
  const std::string alpha = "[reconstruct]\nalpha = 1\n";
  CHECK_FALSE(make_plan(parse(alpha)).does(tangential));
  CHECK(make_plan(parse("friction = 0.1\n" + alpha)).does(tangential));
  CHECK_FALSE(
      make_plan(parse("friction = 0.1\n" + alpha + "tangential = false\n")).does(tangential));
  CHECK_FALSE(make_plan(parse(alpha)).does(layer_kernels));
  std::string layered = sensor;
  layered.insert(layered.find("[noise]"), "layer = { thickness = 3.0, base = \"bonded\" }\n");
  CHECK(make_plan(parse_scene(layered, "s")).does(layer_kernels));
  CHECK_FALSE(make_plan(parse(alpha)).does(history));
  CHECK(make_plan(parse(alpha + "[time]\nrate = 1\nframes = 3\n")).does(history));
  CHECK(make_plan(parse(alpha), {.report = true}).does(Computation::report));
  CHECK_FALSE(make_plan(parse(alpha), {.report = true}).does(time_course));
  const std::string time = "[time]\nrate = 1\nframes = 3\n";
  CHECK(make_plan(parse(alpha + time), {.report = true}).does(time_course));
  CHECK_FALSE(make_plan(parse(alpha + time)).does(time_course));
}

TEST_CASE("an effect costs operations only where it is simulated and has a strength", "[plan]") {
  const auto effect = [](const std::string& rest, std::string_view which) {
    const ScenePlan plan = make_plan(parse(rest));
    const auto found = std::find_if(plan.effects.begin(), plan.effects.end(),
                                    [&](const PlannedEffect& one) { return one.name == which; });
    REQUIRE(found != plan.effects.end());
    return *found;
  };
  CHECK_FALSE(effect("", "crosstalk").simulated);
  CHECK(effect("", "crosstalk").operations == 0.0);
  CHECK(effect("[crosstalk]\nfraction = 0.1\n", "crosstalk").operations == 4.0 * 10);
  const PlannedEffect zero = effect("[crosstalk]\nfraction = 0\n", "crosstalk");
  CHECK(zero.simulated);
  CHECK(zero.operations == 0.0);
  CHECK_THAT(zero.words, ContainsSubstring("strength 0: no stage"));
  const std::string time = "[time]\nrate = 1\nframes = 2\n";
  const PlannedEffect creep = effect(
      time + "[viscoelasticity]\nterms = [{ fraction = 0.1, time = 1 }]\n", "viscoelasticity");
  CHECK(creep.operations == 7.0 * 5);  // strains alone
}

TEST_CASE("effects stand in the order of the signal path", "[plan]") {
  const Scene scene = parse("");
  const ScenePlan plan = make_plan(scene);
  const auto all = effects(scene);
  REQUIRE(plan.effects.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(plan.effects[i].name == all[i].first);
    CHECK(plan.effects[i].simulated == all[i].second);
  }
}
