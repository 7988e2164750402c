#include "tactile_net/report/words/workload_words.hpp"

#include <sstream>

#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using lab::Computation;
using lab::Workload;

TEST_CASE("why and cost are sentences of their numbers", "[words]") {
  using Reason = lab::WorkloadReason;
  Workload::Task task{.what = Computation::history,
                      .done = true,
                      .why = {.reason = Reason::effects_remember, .frame = 7},
                      .cost = Workload::Cost{.kind = lab::WorkloadCost::moments, .count = 1}};
  CHECK(report::why_in_words(task) == "effects remember what came before frame 7");
  CHECK(report::cost_in_words(task) == "the readings at 1 moment");
  task.why = {.reason = Reason::rules_judge, .rule = AlphaRule::gcv};
  CHECK(report::why_in_words(task) ==
        "alpha is chosen by the rule gcv; it is flagged if the other rules disagree");
  task.cost = Workload::Cost{
      .kind = lab::WorkloadCost::decompositions, .rows = 15, .columns = 5, .operations = 12345.0};
  CHECK(report::cost_in_words(task) ==
        "QR and SVD of 15 x 5, once; about 1.23e+04 operations a frame");
  task.cost.reset();
  CHECK(report::cost_in_words(task).empty());
}

TEST_CASE("the workload of a scene names every effect and every computation", "[words]") {
  const Scene scene = parse_scene(
      "[sensor]\ncount = 5\npitch = 0.5\ndepth = 1.5\nreads = [\"stress_x\"]\n"
      "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n[crosstalk]\nfraction = 0\n",
      "s.toml");
  const Workload work = lab::workload(scene);
  std::ostringstream out;
  report::print_workload(out, scene, work);
  for (const Workload::Effect& effect : work.effects)
    CHECK_THAT(out.str(), ContainsSubstring('\n' + std::string(effect.row->name) + ' '));
  for (const Workload::Task& task : work.tasks)
    CHECK_THAT(out.str(), ContainsSubstring('\n' + std::string(name(task.what)) + ' '));
  CHECK_THAT(out.str(), ContainsSubstring("strength 0: no stage"));
  CHECK_THAT(out.str(), ContainsSubstring("half plane: kernels are closed formulas"));
}

TEST_CASE("readings that are cut off are counted in words", "[words]") {
  CHECK(report::in_words(CutOffNote{"saturation", 3, 81}) ==
        "saturation: 3 of 81 readings are cut off at the range's ends");
}
