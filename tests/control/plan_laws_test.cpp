// What holds of the plans of lines and of skins alike, against the dense answer of a solver that
// knows no plan.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/realtime/plan_file.hpp"
#include "tests/control/plan_cases.hpp"

using namespace tactile_net;

namespace {

/// Lines of every kind, with dead taxels of which the whole is known or not, and small skins.
std::vector<PlanCase> small_sensors() {
  std::vector<PlanCase> all;
  for (const auto& [name, problem] : sample_problems())
    all.push_back({.name = name, .problem = problem});
  all.insert(all.end(), {dense_line({3}), dense_line({0, 7, 8}), dense_line({4}, true),
                         coarse_line({2}), square(6), rectangle(5, 7)});
  return all;
}

bool is_symmetric_or_filled(const PlanCase& sensor) {
  const std::vector<double>& weights = sensor.problem.weights;
  return sensor.whole || std::count(weights.begin(), weights.end(), 0.0) == 0;
}

bool can_have(const PlanCase& sensor, Structure structure) {
  const SurfaceGrid& grid = sensor.problem.grid;
  const bool at_taxels = grid.stride_rows == 1 && grid.count() == sensor.problem.taxels;
  if (structure == Structure::fft && (is_skin(sensor) || !at_taxels)) return false;
  return !has_reflections(structure) || is_symmetric_or_filled(sensor);
}

}  // namespace

TEST_CASE("every planned path keeps its promise, on random readings and on contacts at the edge",
          "[planner]") {
  const std::vector<PlanCase> all = small_sensors();
  const PlanCase& sensor = all.at(GENERATE(range(std::size_t{0}, std::size_t{20})));
  const bool skin = is_skin(sensor);
  for (const double alpha : skin ? std::vector{1e-4} : std::vector{1e-2, 1e-6}) {
    const Reconstruction dense = dense_answer(sensor.problem, alpha);
    for (const double accuracy : skin ? std::vector{5e-2, 1e-7} : std::vector{1e-3, 1e-7, 1e-11})
      for (const Structure structure :
           {Structure::dense, Structure::low_rank, Structure::reflections,
            Structure::reflections_low_rank, Structure::fft})
        for (const Precision precision : {Precision::float64, Precision::float32}) {
          if (structure == Structure::fft && precision == Precision::float32) continue;  // refused
          CAPTURE(sensor.name, alpha, accuracy, name(structure), name(precision));
          const PlannerOptions options{.accuracy = accuracy,
                                       .structure = structure,
                                       .precision = precision,
                                       .diagnostics = false};
          if (!can_have(sensor, structure)) {
            CHECK_THROWS_AS(planned(sensor, alpha, options), std::invalid_argument);
            continue;
          }
          const PlannedEstimator one = planned(sensor, alpha, options);
          const Candidate& candidate = one.candidates.front();
          CHECK(one.plan.reconstruction.structure == structure);
          CHECK(one.plan.reconstruction.precision == precision);
          if (precision == Precision::float64 && accuracy >= 1e-7) CHECK(candidate.accurate);
          if (candidate.accurate)
            CHECK(one.plan.error_bound <=
                  (structure == Structure::dense ? std::max(accuracy, 1e-9) : accuracy));
          for (unsigned seed = 0; seed < 4; ++seed)
            CHECK(share_of_promise(sensor, one.plan, dense, frame_for(sensor, seed)) <= 1.0);
        }
  }
}

TEST_CASE("what the planner chooses keeps its promise, and its file", "[planner]") {
  for (const PlanCase& sensor : std::vector<PlanCase>{
           square(8), square(7, 1), rectangle(5, 9), rectangle(1, 6), two_depths(5), uneven(40),
           fine(6), square(1), dense_line({}), coarse_line({})}) {
    const Reconstruction dense = dense_answer(sensor.problem, 1e-4);
    for (const double accuracy : {1e-2, 1e-4, 1e-7}) {
      const PlannedEstimator one = planned(sensor, 1e-4, {.accuracy = accuracy});
      CAPTURE(sensor.name, accuracy, one.why());
      CHECK(one.plan.error_bound <= accuracy);
      for (unsigned seed = 0; seed < 4; ++seed)
        CHECK(share_of_promise(sensor, one.plan, dense, frame_for(sensor, seed)) <= 1.0);
      const std::vector<std::byte> bytes = encode_plan(one.plan);
      CHECK(encode_plan(decode_plan(bytes)) == bytes);
    }
  }
}

TEST_CASE("the cheapest structure is chosen: what of the symmetry is there", "[planner]") {
  CHECK(choice(planned(square(8), 1e-4)) == "reflections and exchange");
  CHECK(choice(planned(rectangle(8, 9), 1e-4)) == "reflections");
  CHECK(choice(planned(dense_line({}), 1e-4)) == "reflections");
  const std::string of_uneven = choice(planned(uneven(40), 1e-4));
  CHECK((of_uneven == "dense" || of_uneven == "low_rank"));
  // Pressures alone at a few times the depth: hardly anything is left.
  CHECK(choice(planned(uneven(60, 8e-3), 1e-2, {.accuracy = 1e-2})) == "low_rank");
  const PlannedEstimator one = planned(square(8), 1e-4);
  const std::size_t dense = 8 * one.plan.tractions() * one.plan.readings();
  CHECK(80 * streamed_bytes(one.plan.reconstruction) < 11 * dense);
  CHECK_THROWS_WITH(planned(uneven(40), 1e-4, {.structure = Structure::reflections}),
                    ContainsSubstring("not mirror symmetric"));
}

TEST_CASE("dead taxels leave the plan its classes, and the answer is that without them",
          "[planner]") {
  for (const PlanCase& sensor :
       std::vector<PlanCase>{square(8, 0, {9}), square(7, 0, {0, 1, 24, 48}), rectangle(5, 8, {13}),
                             square(6, 0, {0, 1, 2, 3, 4, 5}), dense_line({3}),
                             dense_line({0, 7, 8}), dense_line({4}, true), coarse_line({2})}) {
    const Reconstruction dense = dense_answer(sensor.problem, 1e-4);
    for (const double accuracy : {1e-3, 1e-7}) {
      // A line's matrix is so small that any structure may be the cheapest.
      PlannerOptions options{.accuracy = accuracy};
      if (!is_skin(sensor)) options.structure = Structure::reflections_low_rank;
      const PlannedEstimator one = planned(sensor, 1e-4, options);
      CAPTURE(sensor.name, accuracy, one.why());
      CHECK(choice(one).starts_with("reflections"));
      CHECK(one.plan.fill.has_value());
      CHECK(one.plan.error_bound <= accuracy);
      const EstimatorPlan read = decode_plan(encode_plan(one.plan));
      CHECK(read.fill->values == one.plan.fill->values);
      for (unsigned seed = 0; seed < 4; ++seed)
        CHECK(share_of_promise(sensor, read, dense, frame_for(sensor, seed)) <= 1.0);
      // Without knowing the whole the matrix itself is taken.
      PlanCase alone = sensor;
      alone.whole.reset();
      const PlannedEstimator other = planned(alone, 1e-4, {.accuracy = accuracy});
      CHECK_FALSE(choice(other).starts_with("reflections"));
      CHECK_FALSE(other.plan.fill.has_value());
      CHECK(share_of_promise(alone, other.plan, dense, frame_for(sensor, 3)) <= 1.0);
    }
  }
}

TEST_CASE("dead taxels that are each other's mirror images need nothing filled in", "[planner]") {
  for (const PlanCase& sensor : std::vector<PlanCase>{dense_line({3, 27}), coarse_line({1, 7}),
                                                      square(7, 0, {0, 6, 42, 48})})
    for (const bool known : {true, false}) {
      PlanCase one = sensor;
      if (!known) one.whole.reset();
      const PlannedEstimator made = planned(one, 1e-4, {.structure = Structure::reflections});
      CAPTURE(one.name, known, made.why());
      CHECK_FALSE(made.plan.fill.has_value());
      CHECK(made.asymmetry < 1e-9);
      CHECK(share_of_promise(one, made.plan, dense_answer(one.problem, 1e-4), frame_for(one, 2)) <=
            1.0);
    }
}

TEST_CASE("where most taxels are dead two factors of their rank are cheaper", "[planner]") {
  std::vector<std::size_t> dead(30);
  for (std::size_t i = 0; i < dead.size(); ++i) dead[i] = i;
  const PlanCase sensor = square(6, 0, dead);
  const PlannedEstimator one = planned(sensor, 1e-4);
  CHECK(choice(one) == "low_rank");
  const Reconstruction inverse = dense_answer(sensor.problem, 1e-4);
  for (unsigned seed = 0; seed < 4; ++seed)
    CHECK(share_of_promise(sensor, one.plan, inverse, frame_for(sensor, seed)) <= 1.0);
}

namespace {

/// The same sensor with these taxels dead.
using WithDead = PlanCase (*)(std::vector<std::size_t>);

struct LiveFrame {
  std::vector<double> tractions;
  double residual = 0.0;
};

LiveFrame live_frame(const EstimatorPlan& plan, const std::vector<std::size_t>& dead,
                     const std::vector<double>& readings) {
  ContactEstimator estimator(plan);
  for (const std::size_t taxel : dead) REQUIRE(estimator.set_dead(taxel));
  LiveFrame frame{std::vector<double>(estimator.tractions())};
  ContactEstimate estimate{.tractions = frame.tractions};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  frame.residual = estimate.residual_rms;
  return frame;
}

void check_near(const LiveFrame& a, const LiveFrame& b) {
  CHECK(l2_norm(difference(a.tractions, b.tractions)) <= 1e-5 * l2_norm(b.tractions));
  CHECK_THAT(a.residual, WithinRel(b.residual, 1e-4));
}

}  // namespace

TEST_CASE("a taxel that dies at run time is one that the plan left out", "[planner]") {
  const WithDead with = GENERATE(
      WithDead(
          [](std::vector<std::size_t> dead) -> PlanCase { return square(7, 0, std::move(dead)); }),
      WithDead([](std::vector<std::size_t> dead) { return dense_line(std::move(dead)); }),
      WithDead([](std::vector<std::size_t> dead) { return dense_line(std::move(dead), true); }));
  const PlanCase sensor = with({});
  const auto plan_without = [&](std::vector<std::size_t> dead) {
    PlannerOptions options{.accuracy = 1e-10};
    options.structure = Structure::reflections;
    return planned(with(std::move(dead)), 1e-4, options).plan;
  };
  const EstimatorPlan whole = plan_without({});
  const EstimatorPlan without = plan_without({17});
  const EstimatorPlan both = plan_without({17, 24});  // of a plan with one dead another dies
  REQUIRE(without.fill.has_value());
  std::vector<double> readings = frame_for(sensor, 2);
  const std::vector<double> noise = random_values(readings.size(), 9);
  const double size = l2_norm(readings) / std::sqrt(static_cast<double>(readings.size()));
  for (std::size_t i = 0; i < readings.size(); ++i) readings[i] += 1e-2 * size * noise[i];
  check_near(live_frame(whole, {17}, readings), live_frame(without, {}, readings));
  check_near(live_frame(whole, {17, 24}, readings), live_frame(both, {}, readings));
  check_near(live_frame(without, {24}, readings), live_frame(both, {}, readings));
  const LiveFrame one = live_frame(whole, {}, readings);
  const LiveFrame other = live_frame(without, {}, readings);
  CHECK(l2_norm(difference(one.tractions, other.tractions)) > 1e-5 * l2_norm(one.tractions));
}

namespace {

/// A line's numbers as those of a skin of one column, so wide [m]. Where the line has a tangential
/// traction the skin has the one across, too, on which no reading depends.
LinearProblem as_column(LinearProblem problem, double width) {
  problem.is_line = false;
  problem.grid.spacing_z = width;
  if (problem.components == 1) return problem;
  const auto widen = [&](Matrix& matrix) {
    Matrix wide{matrix.rows, matrix.columns / 2 * 3, {}};
    wide.values.resize(wide.rows * wide.columns);
    for (std::size_t i = 0; i < matrix.rows; ++i)
      for (std::size_t j = 0; j < matrix.columns; ++j) wide(i, j) = matrix(i, j);
    matrix = std::move(wide);
  };
  widen(problem.kernel);
  if (problem.unknown_offsets) widen(problem.constants);
  problem.components = 3;
  return problem;
}

struct Judged {
  std::vector<double> tractions;
  ContactEstimate estimate{};
};

Judged judged(const EstimatorPlan& plan, const std::vector<double>& readings) {
  ContactEstimator estimator(plan);
  Judged frame{std::vector<double>(estimator.tractions())};
  frame.estimate.tractions = frame.tractions;
  REQUIRE(estimator.update(readings, frame.estimate) == FrameStatus::ok);
  frame.estimate.tractions = {};
  return frame;
}

}  // namespace

TEST_CASE("a line's plan is that of a skin of one column", "[planner]") {
  constexpr double width = 0.02;
  constexpr double noise = 1e-3;
  for (const PlanCase& line : {dense_line({}), dense_line({4}), dense_line({}, true),
                               dense_line({4}, true), coarse_line({}), coarse_line({2})}) {
    CAPTURE(line.name, line.problem.unknown_offsets, line.whole.has_value());
    PlanCase column{.name = line.name, .problem = as_column(line.problem, width)};
    if (line.whole) column.whole = as_column(*line.whole, width);
    for (const Structure structure : {Structure::dense, Structure::reflections}) {
      PlannerOptions options{.accuracy = 1e-10, .structure = structure};
      const EstimatorPlan of_line = planned(line, 1e-4, options).plan;
      const EstimatorPlan of_column = planned(column, 1e-4, options).plan;
      CHECK_FALSE(of_line.cells);
      CHECK(of_column.cells);
      if (structure == Structure::reflections)
        CHECK(of_line.fill.has_value() == of_column.fill.has_value());
      CHECK(l2_norm(difference(of_line.leverages, of_column.leverages)) <
            1e-8 * l2_norm(of_line.leverages));
      const std::vector<double> readings = frame_for(line, 2);
      const Judged one = judged(of_line, readings);
      Judged other = judged(of_column, readings);
      other.tractions.resize(one.tractions.size());
      CHECK(l2_norm(difference(one.tractions, other.tractions)) < 1e-7 * l2_norm(one.tractions));
      CHECK_THAT(other.estimate.normal_force, WithinRel(width * one.estimate.normal_force, 1e-6));
      CHECK_THAT(other.estimate.residual_rms, WithinRel(one.estimate.residual_rms, 1e-4));
      CHECK_THAT(other.estimate.centre, WithinAbs(one.estimate.centre, 1e-6));
      if (line.problem.components == 2)
        CHECK_THAT(other.estimate.tangential_y,
                   WithinRel(width * one.estimate.tangential_force, 1e-5));

      options.noise_rms = noise;
      const EstimatorPlan line_limits = planned(line, 1e-4, options).plan;
      const EstimatorPlan column_limits = planned(column, 1e-4, options).plan;
      CHECK(line_limits.residual_limit == column_limits.residual_limit);
      CHECK_THAT(column_limits.force_deviation,
                 WithinRel(width * line_limits.force_deviation, 1e-6));
    }
  }
}

TEST_CASE("a skin of one column has cells, however wide they are", "[planner]") {
  CHECK(plan_estimator(as_column(dense_line({}).problem, 1.0), 1e-4).plan.cells);
}

TEST_CASE("who has a problem's family need not make it twice", "[planner]") {
  for (const PlanCase& sensor : std::vector<PlanCase>{square(5), dense_line({})}) {
    const PlannerOptions options{.accuracy = 1e-9, .noise_rms = 1e-3};
    const EstimatorPlan alone = planned(sensor, 1e-4, options).plan;
    const EstimatorPlan shared =
        plan_estimator(sensor.problem, TikhonovFamily(sensor.problem), 1e-4, options).plan;
    CHECK(shared.cells.has_value() == is_skin(sensor));
    CHECK_THAT(shared.force_deviation, WithinRel(alone.force_deviation, 1e-6));
    const std::vector<double> readings = frame_for(sensor, 2);
    const std::vector<double> f = answer_of(sensor, alone, readings);
    CHECK(l2_norm(difference(answer_of(sensor, shared, readings), f)) < 1e-6 * l2_norm(f));
  }
}

TEST_CASE("what cannot be planned is refused", "[planner]") {
  for (const PlanCase& sensor : std::vector<PlanCase>{square(5), dense_line({3})}) {
    CHECK_THROWS_AS(planned(sensor, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(planned(sensor, 1e-4, {.accuracy = 0.0}), std::invalid_argument);
    const LinearProblem other = is_skin(sensor) ? square(6).problem : coarse_line({}).problem;
    CHECK_THROWS_AS(plan_estimator(sensor.problem, 1e-4, {}, &other), std::invalid_argument);
    CHECK_THROWS_AS(plan_estimator(other, TikhonovFamily(sensor.problem), 1e-4),
                    std::invalid_argument);
  }
  for (const PlanCase& sensor : std::vector<PlanCase>{square(5), coarse_line({})})
    CHECK_THROWS_AS(planned(sensor, 1e-300), std::domain_error);
  const PlanCase dead = dense_line({3});
  CHECK_THROWS_AS(plan_estimator(dead.problem, 1e-4, {}, &dead.problem), std::invalid_argument);
  CHECK_THROWS_WITH(planned(square(5), 1e-4, {.structure = Structure::fft}),
                    ContainsSubstring("of line arrays"));
  CHECK_THROWS_WITH(planned(coarse_line({}), 1e-4, {.structure = Structure::fft}),
                    ContainsSubstring("at the taxels"));
}
