#include "tactile_net/lab/workload.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <variant>
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

std::vector<Computation> done(const Workload& work) {
  std::vector<Computation> result;
  for (const Workload::Task& one : work.tasks) {
    CHECK(one.cost.has_value() == one.done);
    if (one.done) result.push_back(one.what);
  }
  return result;
}
std::vector<Computation> done(const std::string& rest, const WorkloadRequest& request = {}) {
  return done(workload(parse(rest), request));
}

using List = std::vector<Computation>;
using Reason = WorkloadReason;
using Kind = WorkloadCost;

Workload::Task task(const Workload& work, Computation which) {
  const Workload::Task* const found = work.task(which);
  if (found == nullptr) FAIL("not listed: " << name(which));
  return *found;
}

}  // namespace

TEST_CASE("every computation of a sensor is told once, whether it is done or not", "[workload]") {
  const SkinScene skin = std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = 3\ncolumns = 3\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n",
      "s.toml"));
  std::set<Computation> of_either;
  for (const Workload& work : {workload(parse("")), workload(skin)}) {
    for (std::size_t i = 0; i < work.tasks.size(); ++i) {
      CHECK((i == 0 || work.tasks[i - 1].what < work.tasks[i].what));
      CHECK(work.task(work.tasks[i].what) == &work.tasks[i]);
      of_either.insert(work.tasks[i].what);
    }
    CHECK(work.effects.size() == scene_effects().size());
  }
  CHECK(of_either.size() == std::size(computations));
}

TEST_CASE("a line says what a skin says of its weight, constraints and data", "[workload]") {
  using enum Computation;
  const std::string friction = "friction = 0.1\n";
  const std::string evidence = "[reconstruct]\ntangential_weight = \"evidence\"\n";
  CHECK(workload(parse(friction + evidence)).does(weights));
  CHECK_FALSE(workload(parse(evidence)).does(weights));
  const std::string limited = "[reconstruct]\nalpha = 1\nnonnegative = true\n";
  CHECK(workload(parse(limited)).does(constraints));
  CHECK(task(workload(parse(limited + "methods = [\"closed_form\"]\n")), constraints).why.reason ==
        Reason::limits_of_tikhonov);
  CHECK(workload(parse("")).does(data_verdict));
  CHECK(task(workload(parse("[reconstruct]\nmethods = [\"dft\"]\n")), data_verdict).why.reason ==
        Reason::no_matrix_method);
}

TEST_CASE("rules are compared where one chooses alpha, or on request", "[workload]") {
  using enum Computation;
  const std::string given = "[reconstruct]\nalpha = 1e-3\n";
  CHECK(done("") == List{readings, tikhonov, rule_comparison, bands, hidden_modes, data_verdict});
  CHECK(done(given) == List{readings, tikhonov, bands, hidden_modes, data_verdict});
  CHECK(done(given, {.compare_rules = true}) ==
        List{readings, tikhonov, rule_comparison, bands, hidden_modes, data_verdict});
  CHECK(done("[reconstruct]\nmethods = [\"dft\"]\n", {.compare_rules = true}) ==
        List{readings, dft});
}

TEST_CASE("a circuit brings what its table asks for, and nothing else", "[workload]") {
  using enum Computation;
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
        List{readings, tikhonov, bands, hidden_modes, data_verdict});
}

TEST_CASE("the second unknown and the layer's integrals come only where they are called for",
          "[workload]") {
  using enum Computation;
  const std::string alpha = "[reconstruct]\nalpha = 1\n";
  CHECK_FALSE(workload(parse(alpha)).does(tangential));
  CHECK(workload(parse("friction = 0.1\n" + alpha)).does(tangential));
  CHECK_FALSE(
      workload(parse("friction = 0.1\n" + alpha + "tangential = false\n")).does(tangential));
  CHECK_FALSE(workload(parse(alpha)).does(layer_kernels));
  std::string layered = sensor;
  layered.insert(layered.find("[noise]"), "layer = { thickness = 3.0, base = \"bonded\" }\n");
  CHECK(workload(parse_scene(layered, "s")).does(layer_kernels));
  CHECK_FALSE(workload(parse(alpha)).does(history));
  CHECK(workload(parse(alpha + "[time]\nrate = 1\nframes = 3\n")).does(history));
  CHECK(workload(parse(alpha), {.report = true}).does(Computation::report));
  CHECK_FALSE(workload(parse(alpha), {.report = true}).does(time_course));
  const std::string time = "[time]\nrate = 1\nframes = 3\n";
  CHECK(workload(parse(alpha + time), {.report = true}).does(time_course));
  CHECK_FALSE(workload(parse(alpha + time)).does(time_course));
}

TEST_CASE("an effect costs operations only where it is simulated and has a strength",
          "[workload]") {
  const auto effect = [](const std::string& rest, std::string_view which) {
    const Workload work = workload(parse(rest));
    const auto found =
        std::find_if(work.effects.begin(), work.effects.end(),
                     [&](const Workload::Effect& one) { return one.row->name == which; });
    REQUIRE(found != work.effects.end());
    return *found;
  };
  CHECK_FALSE(effect("", "crosstalk").simulated);
  CHECK_FALSE(effect("[crosstalk]\nfraction = 0.1\n", "crosstalk").idle);
  CHECK(effect("", "crosstalk").operations == 0.0);
  CHECK(effect("[crosstalk]\nfraction = 0.1\n", "crosstalk").operations == 4.0 * 10);
  const Workload::Effect zero = effect("[crosstalk]\nfraction = 0\n", "crosstalk");
  CHECK(zero.simulated);
  CHECK(zero.operations == 0.0);
  CHECK(zero.idle);
  const std::string time = "[time]\nrate = 1\nframes = 2\n";
  const Workload::Effect creep = effect(
      time + "[viscoelasticity]\nterms = [{ fraction = 0.1, time = 1 }]\n", "viscoelasticity");
  CHECK(creep.operations == 7.0 * 5);  // strains alone
}

TEST_CASE("effects stand in the order of the signal path", "[workload]") {
  const Scene scene = parse("");
  const Workload work = workload(scene);
  const auto all = effects(scene);
  REQUIRE(work.effects.size() == all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(work.effects[i].row->name == all[i].first);
    CHECK(work.effects[i].simulated == all[i].second);
  }
}

TEST_CASE("reasons tell apart what the scene asks for and what it leaves out", "[workload]") {
  using enum Computation;
  const auto why = [](const std::string& rest, Computation which,
                      const WorkloadRequest& request = {}) {
    return task(workload(parse(rest), request), which).why;
  };
  const std::string given = "[reconstruct]\nalpha = 1e-3\n";
  CHECK(why("", rule_comparison).reason == Reason::rules_judge);
  CHECK(why("[reconstruct]\nalpha = \"l_curve\"\n", rule_comparison).rule == AlphaRule::l_curve);
  CHECK(why(given, rule_comparison).reason == Reason::alpha_given);
  CHECK(why(given, rule_comparison, {.compare_rules = true}).reason ==
        Reason::comparison_requested);
  CHECK(why("[reconstruct]\nmethods = [\"dft\"]\n", rule_comparison).reason ==
        Reason::no_method_takes_alpha);
  CHECK(why("[reconstruct]\nmethods = [\"dft\"]\n", bands).reason == Reason::no_matrix_method);
  CHECK(why(given, tangential).reason == Reason::no_friction);
  CHECK(why("friction = 0.1\n[reconstruct]\ntangential = false\n", tangential).reason ==
        Reason::tangential_excluded);
  CHECK(why(given, certificate).reason == Reason::no_circuit);

  const std::string time = "[time]\nrate = 1\nframes = 3\n";
  CHECK(why("", history).reason == Reason::no_time);
  CHECK(why(time, history).reason == Reason::only_draws_matter);
  const Workload::Why creep =
      why(time + "[viscoelasticity]\nterms = [{ fraction = 0.1, time = 1 }]\n", history);
  CHECK(creep.reason == Reason::effects_remember);
  CHECK(creep.frame == 2);
  CHECK(why(time, time_course).reason == Reason::no_report);
  CHECK(why("", time_course, {.report = true}).reason == Reason::one_frame);

  std::string large_array = sensor;
  large_array.replace(large_array.find("count = 5"), 9, "count = 1200");
  const Workload large_work = workload(parse_scene(large_array, "s"));
  CHECK(task(large_work, bands).why.reason == Reason::forces_have_deviations);
  CHECK(task(large_work, hidden_modes).why.reason == Reason::array_too_large);
  large_array += "[reconstruct]\nnonnegative = true\n";
  CHECK(task(workload(parse_scene(large_array, "s")), bands).why.reason == Reason::array_too_large);
}

TEST_CASE("costs are counted in readings, tractions and operations", "[workload]") {
  using enum Computation;
  const std::string exact = "[reconstruct]\nalpha = 1\n[forward]\nmodel = \"exact\"\n";
  const std::string sampled = "[reconstruct]\nalpha = 1\n[forward]\nmodel = \"sampled\"\n";
  const auto cost = [](const std::string& rest, Computation which,
                       const WorkloadRequest& request = {}) {
    const Workload::Task one = task(workload(parse(rest), request), which);
    REQUIRE(one.cost.has_value());
    return *one.cost;
  };
  CHECK(cost(exact, readings).kind == Kind::kernel_values);
  CHECK(cost(exact, readings).count == 10);  // two quantities at five taxels
  const Workload::Cost sum = cost(sampled, readings);
  CHECK(sum.kind == Kind::direct_sum);
  CHECK(sum.count == 2);  // kernels
  CHECK(sum.rows == 5);
  CHECK(sum.operations == 2.0 * 5 * 5 * 2);

  const Workload::Cost direct = cost("[reconstruct]\nalpha = 1\n", tikhonov);
  CHECK(direct.kind == Kind::decompositions);
  CHECK(direct.rows == 15);  // readings above the smoothing of five tractions
  CHECK(direct.columns == 5);
  CHECK(direct.operations == 2.0 * 10 * 5);
  const Workload::Cost two = cost("friction = 0.1\n[reconstruct]\nalpha = 1\n", tangential);
  CHECK(two.count == 10);
  CHECK(two.rows == 5);

  const Workload::Cost network = cost(
      "[reconstruct]\nmethods = [\"network\"]\nalpha = 1\n[network]\nrealization = "
      "\"nic\"\ntolerance = { relative = 0.01, trials = 7 }\n",
      circuit);
  CHECK(network.rows == 5);
  CHECK(network.count == 15);  // branches
  CHECK(network.realization == Realization::nic);
}
