// What is said of a skin's work beside what its run does.
#include <algorithm>
#include <sstream>
#include <string>
#include <variant>

#include "tactile_net/lab/run.hpp"
#include "tactile_net/lab/workload.hpp"
#include "tactile_net/report/words/workload_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::lab;

SkinScene skin_of_taxels(const std::string& more,
                         const std::string& taxels = "rows = 6\ncolumns = 5") {
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\n" + taxels +
          "\npitch = 1e-3\ndepth = 2e-3\nreads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
          "[material]\nyoungs_modulus = 2e5\npoisson_ratio = 0.45\n"
          "[[contact]]\nshape = \"sphere\"\nradius = 2e-3\nforce = 0.5\nfriction = 0.4\n" +
          more,
      "skin.toml"));
}

}  // namespace

TEST_CASE("what is said of a skin's work is what its run does", "[lab][skin][workload]") {
  for (const char* noise : {"[noise]\nrms = 100.0\n", ""})
    for (const char* options : {"alpha = 1e-4\n", "alpha = \"aicc\"\n", "friction_limit = 0.6\n",
                                "tangential_weight = \"evidence\"\n", "tangential = false\n"}) {
      CAPTURE(noise, options);
      const SkinScene scene = skin_of_taxels(std::string(noise) + "[reconstruct]\n" + options);
      const Workload work = workload(scene);
      const Experiment experiment = run(scene);
      REQUIRE(experiment.results.front().has_answer());
      const FrameAnswer& answer = experiment.results.front().answer;
      const auto does = [&](Computation what) { return work.does(what); };
      CHECK(does(Computation::tangential) == (answer.tractions.size() > grid(scene).count()));
      CHECK(does(Computation::constraints) == answer.cone.has_value());
      CHECK(does(Computation::weights) == answer.alpha.tangential_weight.has_value());
      CHECK(does(Computation::data_verdict) == answer.data->noise_known);
      CHECK(does(Computation::bands) == !answer.deviations.empty());
      CHECK_FALSE(does(Computation::report));
      const Workload::Task& rule = *work.task(Computation::alpha_rule);
      CHECK((rule.why.reason == WorkloadReason::prior_by_rule) == !answer.alpha.rule.has_value());
      CHECK(rule.why.rule == scene.reconstruct.alpha_rule);
      if (rule.why.rule) CHECK(rule.why.rule == answer.alpha.rule);
      const Workload::Cost& solved = *work.task(Computation::tikhonov)->cost;
      CHECK(solved.kind == WorkloadCost::classes);
      CHECK(solved.columns == answer.tractions.size());
      CHECK(solved.rows == experiment.frame.readings.size());
      const auto simulated = std::count_if(work.effects.begin(), work.effects.end(),
                                           [](const auto& effect) { return effect.simulated; });
      CHECK(simulated == (*noise != '\0' ? 2 : 1));  // friction, noise
      for (const Workload::Task& one : work.tasks) {
        CHECK(one.cost.has_value() == one.done);
        CHECK_FALSE(report::why_in_words(one).empty());
        CHECK(report::cost_in_words(one).empty() == !one.done);
      }
    }
}

TEST_CASE("a large skin is said to be solved by products", "[lab][skin][workload]") {
  const SkinScene wide =
      skin_of_taxels("[time]\nframes = 3\nrate = 10.0\n[reconstruct]\nfriction_limit = 0.6\n",
                     "rows = 60\ncolumns = 60");
  const Workload told = workload(wide, {.report = true});
  const auto cost = [&](Computation what) { return *told.task(what)->cost; };
  CHECK(cost(Computation::tikhonov).kind == WorkloadCost::tiles);
  CHECK(cost(Computation::tikhonov).count == 3 * 64 * 64);
  CHECK(cost(Computation::alpha_rule).kind == WorkloadCost::probes);
  CHECK(cost(Computation::constraints).kind == WorkloadCost::projected_gradients);
  CHECK(cost(Computation::bands).kind == WorkloadCost::solves);
  CHECK(told.does(Computation::report));
  CHECK(told.does(Computation::history));
  std::ostringstream words;
  report::print_workload(words, wide, told);
  CHECK_THAT(words.str(), ContainsSubstring("60 x 60 taxels") &&
                              ContainsSubstring("the last of 3 frames: frame 2") &&
                              ContainsSubstring("overlapping tiles") &&
                              ContainsSubstring("12288 tractions"));
}
