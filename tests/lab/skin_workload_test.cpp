// What is said of a skin's work beside what its run does.
#include "tactile_net/lab/skin_workload.hpp"

#include <sstream>
#include <string>
#include <variant>

#include "tactile_net/lab/skin_run.hpp"
#include "tactile_net/report/words/skin_workload_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::lab;
using SkinComputation = SkinWorkload::Computation;
using SkinCost = SkinWorkload::Cost;
using SkinReason = SkinWorkload::Reason;

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
      const SkinWorkload work = workload(scene);
      const SkinExperiment experiment = run(scene);
      REQUIRE(experiment.answer);
      const FrameAnswer& answer = *experiment.answer;
      const auto does = [&](SkinComputation what) { return work.task(what).done; };
      CHECK(does(SkinComputation::tangential) == (answer.tractions.size() > grid(scene).count()));
      CHECK(does(SkinComputation::constraints) == answer.cone.has_value());
      CHECK(does(SkinComputation::weights) == answer.alpha.tangential_weight.has_value());
      CHECK(does(SkinComputation::data_verdict) == answer.data->noise_known);
      CHECK(does(SkinComputation::bands) == !answer.deviations.empty());
      CHECK_FALSE(does(SkinComputation::report));
      const SkinWorkload::Task& rule = work.task(SkinComputation::alpha_rule);
      CHECK((rule.why == SkinReason::prior_by_rule) == !answer.alpha.rule.has_value());
      CHECK(rule.rule == scene.reconstruct.alpha_rule);
      if (rule.rule) CHECK(rule.rule == answer.alpha.rule);
      CHECK(work.task(SkinComputation::tikhonov).cost == SkinCost::classes);
      CHECK(work.task(SkinComputation::tikhonov).count == answer.tractions.size());
      CHECK(work.task(SkinComputation::tikhonov).rows == experiment.frame.readings.size());
      CHECK(work.effects.size() == (*noise != '\0' ? 2U : 1U));  // friction, noise
      for (const SkinWorkload::Task& one : work.tasks) {
        CHECK(&work.task(one.what) == &one);
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
  const SkinWorkload told = workload(wide, true);
  CHECK(told.task(SkinComputation::tikhonov).cost == SkinCost::tiles);
  CHECK(told.task(SkinComputation::tikhonov).count == 3 * 64 * 64);
  CHECK(told.task(SkinComputation::alpha_rule).cost == SkinCost::probes);
  CHECK(told.task(SkinComputation::constraints).cost == SkinCost::projected_gradients);
  CHECK(told.task(SkinComputation::bands).cost == SkinCost::solves);
  CHECK(told.task(SkinComputation::report).done);
  CHECK(told.task(SkinComputation::history).done);
  std::ostringstream words;
  report::print_workload(words, wide, told);
  CHECK_THAT(words.str(), ContainsSubstring("60 x 60 taxels") &&
                              ContainsSubstring("the last of 3 frames: frame 2") &&
                              ContainsSubstring("overlapping tiles") &&
                              ContainsSubstring("12288 tractions"));
}
