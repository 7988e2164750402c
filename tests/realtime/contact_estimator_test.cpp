#include "tactile_net/realtime/contact_estimator.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/answer.hpp"
#include "tests/realtime/batches.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

namespace {

double sum(std::span<const double> values) {
  return static_cast<double>(std::accumulate(values.begin(), values.end(), 0.0L));
}

}  // namespace

TEST_CASE("with P = 1 constraints are the projection, cell by cell", "[contact_estimator][cone]") {
  for (const bool skin : {false, true})
    for (const Structure structure : {Structure::dense, Structure::reflections}) {
      CAPTURE(skin, name(structure));
      EstimatorPlan plan =
          skin ? made_skin_plan({.structure = structure})
               : made_plan({.count = 13, .channels = 2, .unknowns = 2, .structure = structure});
      const double limit = 0.5;
      add_cone(plan, limit);
      const double scale = plan.cone->tangential_scale;
      ContactEstimator estimator(plan);
      estimator.set_work({.steps = 30});
      for (unsigned seed = 0; seed < 5; ++seed) {
        const std::vector<double> readings = random_values(estimator.readings(), seed);
        std::vector<double> f(estimator.tractions());
        ContactEstimate estimate{.tractions = f};
        REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
        const std::span<const double> free = estimator.free_tractions();
        const std::size_t n = plan.values;
        double off = 0.0;
        double size = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
          // Of scaled drags: |q| <= limit scale p.
          const double p = free[i];
          const double y = scale * free[n + i];
          const double z = skin ? scale * free[2 * n + i] : 0.0;
          const double drag = std::hypot(y, z);
          const double mu = limit * scale;
          const double along =
              drag <= mu * p ? p : std::max((p + mu * drag) / (1.0 + mu * mu), 0.0);
          const double shrunk = drag <= mu * p || drag == 0.0 ? 1.0 : mu * along / drag;
          off = std::max({off, std::abs(f[i] - along), std::abs(scale * f[n + i] - shrunk * y)});
          if (skin) off = std::max(off, std::abs(scale * f[2 * n + i] - shrunk * z));
          size = std::max({size, std::abs(p), drag});
        }
        CHECK(off < 1e-6 * size);
      }
    }
}

TEST_CASE("the resultant, the margin and the residual are those of the tractions",
          "[contact_estimator]") {
  const auto problems = sample_problems();
  const std::size_t which = GENERATE(range(std::size_t{0}, std::size_t{10}));
  const auto& [name, problem] = problems.at(which);
  CAPTURE(name);
  const std::size_t n = problem.grid.count();
  ContactEstimator estimator(
      plan_estimator(problem, 1e-4, {.accuracy = 1e-12, .friction_coefficient = 0.7}).plan);
  bool pressed = false;
  bool pulled = false;
  for (unsigned seed = 0; seed < 8; ++seed) {
    const std::vector<double> g = random_values(estimator.readings(), seed);
    const Answer result = answer(estimator, g, 12.25);
    const ContactEstimate& found = result.estimate;
    const std::span<const double> normal = found.tractions.first(n);
    const std::span<const double> tangential = found.tractions.subspan(n);
    CHECK(found.time == 12.25);
    const double size = problem.grid.spacing_y * static_cast<double>(n) * l2_norm(found.tractions);
    CHECK_THAT(found.normal_force, WithinAbs(problem.grid.spacing_y * sum(normal), 1e-15 * size));
    CHECK(found.contact == (found.normal_force > 0.0));
    (found.contact ? pressed : pulled) = true;
    if (found.contact) {
      long double moment = 0.0L;
      for (std::size_t j = 0; j < n; ++j)
        moment += (static_cast<long double>(j) - 0.5L * static_cast<long double>(n - 1)) *
                  static_cast<long double>(normal[j]);
      const double centre = problem.grid.spacing_y * problem.grid.spacing_y *
                            static_cast<double>(moment) / found.normal_force;
      CHECK_THAT(found.centre, WithinAbs(centre, 1e-13 * size * size / found.normal_force));
    } else {
      CHECK(std::isnan(found.centre));
      CHECK(std::isnan(found.angle));
    }
    if (problem.components == 2) {
      CHECK_THAT(found.tangential_force,
                 WithinAbs(problem.grid.spacing_y * sum(tangential), 1e-15 * size));
      if (found.contacts < 2)  // else that of the one nearest to slipping
        CHECK_THAT(found.friction_margin,
                   WithinRel(0.7 * found.normal_force - std::abs(found.tangential_force), 1e-14));
      if (found.contact) {  // the angle turns the resultant onto the normal
        const double length = std::hypot(found.normal_force, found.tangential_force);
        CHECK_THAT(length * std::cos(found.angle), WithinRel(found.normal_force, 1e-14));
        CHECK_THAT(length * std::sin(found.angle), WithinRel(found.tangential_force, 1e-14));
      }
    } else {
      CHECK(std::isnan(found.tangential_force));
      CHECK(std::isnan(found.angle));
      CHECK(std::isnan(found.friction_margin));
    }
    double squares = 0.0;
    double live = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      double r = problem.weights[i] * g[i];
      for (std::size_t j = 0; j < found.tractions.size(); ++j)
        r -= problem.kernel(i, j) * found.tractions[j];
      squares += r * r;
      live += problem.weights[i] > 0.0 ? 1.0 : 0.0;
    }
    CHECK_THAT(found.residual_rms, WithinRel(std::sqrt(squares / live), 1e-8));
  }
  if (name != "shear") CHECK(pressed);
  CHECK((pressed || pulled));
}

TEST_CASE("a positive traction has its centre where it is, a negative one no centre",
          "[contact_estimator]") {
  EstimatorPlan plan = made_plan({.count = 9, .structure = Structure::dense});
  plan.reconstruction.scale = 1.0;
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = 0; j < 9; ++j)
      plan.reconstruction.factors[0].values[i * 9 + j] = i == j ? 1.0 : 0.0;
  ContactEstimator estimator(plan);
  std::vector<double> g(9, 0.0);
  g[6] = 3.0;
  CHECK(answer(estimator, g).estimate.normal_force == 0.75);
  CHECK(answer(estimator, g).estimate.centre == 0.5);  // (6 - 4) * 0.25
  g[2] = 3.0;
  CHECK(answer(estimator, g).estimate.centre == 0.0);
  g[2] = g[6] = -3.0;
  CHECK_FALSE(answer(estimator, g).estimate.contact);
  CHECK(std::isnan(answer(estimator, g).estimate.centre));
}

TEST_CASE("every structure, precision and instruction set computes the product that is written",
          "[contact_estimator]") {
  const std::size_t count = GENERATE(2U, 3U, 8U, 13U, 40U, 81U, 130U);
  const std::size_t channels = GENERATE(1U, 2U, 3U);
  const std::size_t unknowns = GENERATE(1U, 2U);
  for (const Structure structure : structures)
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      CAPTURE(count, channels, unknowns, name(structure), name(precision));
      const EstimatorPlan plan = made_plan({.count = count,
                                            .channels = channels,
                                            .unknowns = unknowns,
                                            .structure = structure,
                                            .precision = precision,
                                            .diagnostics = false});
      const std::vector<double> g = random_values(plan.readings(), 4);
      const std::vector<double> expected = by_definition(plan.reconstruction, g);
      // Sums of products of entries <= 1, sums of pairs <= 2: two classes, two factors.
      const double terms = 8.0 * static_cast<double>(plan.readings() * plan.readings());
      const double bound = (precision == Precision::float64 ? 0x1p-52 : 0x1p-23) * terms;
      for (const InstructionSet set :
           {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (set > widest_instruction_set()) continue;
        ContactEstimator estimator(plan, set);
        REQUIRE(estimator.instruction_set() == set);
        const Answer result = answer(estimator, g);
        for (std::size_t i = 0; i < expected.size(); ++i)
          REQUIRE(std::abs(result.tractions[i] - expected[i]) <= bound);
      }
    }
}

TEST_CASE("an instruction set that the machine lacks is replaced by its widest",
          "[contact_estimator]") {
  const ContactEstimator estimator(made_plan({}), InstructionSet::avx512);
  CHECK(estimator.instruction_set() == std::min(InstructionSet::avx512, widest_instruction_set()));
}

TEST_CASE("units scale: readings times a power of two give that many times the answer, to the bit",
          "[contact_estimator]") {
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  for (const Structure structure : structures) {
    EstimatorPlan plan =
        made_plan({.count = 21, .unknowns = 2, .structure = structure, .precision = precision});
    plan.ranges.clear();
    ContactEstimator estimator(plan);
    std::vector<double> g = random_values(estimator.readings(), 3);
    g[11] += 40.0;
    const Answer plain = answer(estimator, g);
    CHECK(plain.estimate.outlier == 11);
    for (const int exponent : {-400, -150, -30, -1, 1, 30, 150, 400}) {
      CAPTURE(name(structure), name(precision), exponent);
      const Answer result = answer(estimator, scaled(g, exponent));
      CHECK(result.tractions == scaled(plain.tractions, exponent));
      CHECK(result.estimate.normal_force == std::ldexp(plain.estimate.normal_force, exponent));
      CHECK(result.estimate.tangential_force ==
            std::ldexp(plain.estimate.tangential_force, exponent));
      CHECK(result.estimate.friction_margin ==
            std::ldexp(plain.estimate.friction_margin, exponent));
      CHECK(result.estimate.residual_rms == std::ldexp(plain.estimate.residual_rms, exponent));
      CHECK(std::bit_cast<std::uint64_t>(result.estimate.centre) ==
            std::bit_cast<std::uint64_t>(plain.estimate.centre));
      CHECK(result.estimate.contact == plain.estimate.contact);
      CHECK(result.estimate.outlier == plain.estimate.outlier);
    }
  }
}

TEST_CASE("the smallest readings are answered, without NaN where a number is due",
          "[contact_estimator]") {
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  ContactEstimator estimator(made_plan({.unknowns = 2, .precision = precision}));
  const std::vector<double> plain = random_values(estimator.readings(), 2);
  const std::vector<double> exact = answer(estimator, plain).tractions;
  for (const int exponent : {-1000, -1020, -1060, -1074}) {
    CAPTURE(exponent);
    const Answer result = answer(estimator, scaled(plain, exponent));
    // As exact as denormal readings and tractions are: a few of the smallest double each.
    for (std::size_t i = 0; i < exact.size(); ++i)
      CHECK(std::abs(result.tractions[i] - std::ldexp(exact[i], exponent)) <=
            std::ldexp(precision == Precision::float64 ? 1e-14 : 1e-5, exponent) + 200 * 0x1p-1074);
    CHECK(std::isfinite(result.estimate.normal_force));
    CHECK(std::isfinite(result.estimate.residual_rms));
    CHECK(result.estimate.outlier == -1);
  }
}

TEST_CASE("tractions may take the place of the readings", "[contact_estimator]") {
  const bool diagnostics = GENERATE(true, false);
  const std::size_t count = GENERATE(13U, 130U);
  for (const Structure structure : structures)
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      ContactEstimator estimator(made_plan({.count = count,
                                            .structure = structure,
                                            .precision = precision,
                                            .diagnostics = diagnostics}));
      std::vector<double> g = random_values(estimator.readings(), 6);
      g[5] = 2e9;  // saturated, which is judged by the reading
      Answer apart = answer(estimator, g, 1.0);
      Answer in_place(estimator);
      in_place.estimate.tractions = g;
      REQUIRE(estimator.update(g, in_place.estimate, 1.0) == FrameStatus::ok);
      CHECK(in_place.bits() == apart.bits());
      CHECK(in_place.estimate.saturated);
    }
}

TEST_CASE("equal frames give equal bits, whatever came between", "[contact_estimator]") {
  const auto problems = sample_problems();
  for (const auto& [name, problem] : problems) {
    CAPTURE(name);
    ContactEstimator estimator(plan_estimator(problem, 1e-4).plan);
    const std::vector<double> g = random_values(estimator.readings(), 1);
    const auto first = answer(estimator, g).bits();
    for (unsigned seed = 2; seed < 5; ++seed)
      (void)answer(estimator, random_values(estimator.readings(), seed));
    Answer bad(estimator);
    CHECK(estimator.update(std::vector<double>(g.size(), not_a_number), bad.estimate) ==
          FrameStatus::not_finite);
    CHECK(answer(estimator, g).bits() == first);
    // Where the frame lies in memory does not matter either.
    std::vector<double> shifted(g.size() + 1);
    std::copy(g.begin(), g.end(), shifted.begin() + 1);
    CHECK(answer(estimator, std::span(shifted).subspan(1)).bits() == first);
  }
}

TEST_CASE("the baseline is subtracted, and a bad one leaves the old", "[contact_estimator]") {
  const bool diagnostics = GENERATE(true, false);
  const Structure structure = GENERATE(Structure::dense, Structure::low_rank,
                                       Structure::reflections, Structure::reflections_low_rank);
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  ContactEstimator estimator(made_plan(
      {.unknowns = 2, .structure = structure, .precision = precision, .diagnostics = diagnostics}));
  std::vector<double> g(estimator.readings());
  std::vector<double> baseline(estimator.readings());
  for (std::size_t i = 0; i < g.size(); ++i) {
    g[i] = static_cast<double>(3 * i) - 7.0;
    baseline[i] = static_cast<double>(i * i);
  }
  const auto plain = answer(estimator, g).bits();
  REQUIRE(estimator.set_baseline(baseline) == FrameStatus::ok);
  std::vector<double> loaded = g;  // whole numbers: sums are exact
  for (std::size_t i = 0; i < g.size(); ++i) loaded[i] += baseline[i];
  CHECK(answer(estimator, loaded).bits() == plain);
  CHECK(answer(estimator, baseline).estimate.normal_force == 0.0);

  std::vector<double> bad = baseline;
  bad[0] += 1.0;
  bad[3] = not_a_number;
  CHECK(estimator.set_baseline(bad) == FrameStatus::not_finite);
  bad[3] = infinite;
  CHECK(estimator.set_baseline(bad) == FrameStatus::not_finite);
  CHECK(estimator.set_baseline(std::span(baseline).subspan(1)) == FrameStatus::wrong_size);
  bad[3] = -1e300;  // the largest double less this is none
  CHECK(estimator.set_baseline(bad) == FrameStatus::too_large);
  bad[5] = not_a_number;
  CHECK(estimator.set_baseline(bad) == FrameStatus::not_finite);
  CHECK(answer(estimator, loaded).bits() == plain);

  REQUIRE(estimator.set_baseline(std::vector<double>(g.size(), 0.0)) == FrameStatus::ok);
  CHECK(answer(estimator, g).bits() == plain);
}

TEST_CASE("a sensor with a dead taxel can be zeroed", "[contact_estimator]") {
  ContactEstimator estimator(made_plan({}));
  std::vector<double> baseline(estimator.readings(), 2.0);
  REQUIRE(estimator.set_baseline(baseline) == FrameStatus::ok);
  REQUIRE(estimator.set_dead(4));
  baseline.assign(baseline.size(), 3.0);
  baseline[4] = not_a_number;
  REQUIRE(estimator.set_baseline(baseline) == FrameStatus::ok);
  CHECK(answer(estimator, baseline).estimate.residual_rms == 0.0);
  estimator.revive();
  baseline[4] = 2.0;  // where it was
  CHECK(answer(estimator, baseline).estimate.residual_rms == 0.0);
}

TEST_CASE("a batch is frame after frame, to the bit", "[contact_estimator]") {
  const EstimatorPlan plan = made_plan({.unknowns = 2});
  ContactEstimator estimator(plan);
  ContactEstimator one_by_one(plan);
  constexpr std::size_t frames = 7;
  std::vector<double> readings = random_values(frames * estimator.readings(), 9);
  std::vector<Answer> expected;
  std::vector<Answer> answers(frames, Answer(estimator));
  std::vector<ContactEstimate> estimates;
  for (std::size_t k = 0; k < frames; ++k) {
    const auto frame = std::span(readings).subspan(k * estimator.readings(), estimator.readings());
    expected.push_back(answer(one_by_one, frame, static_cast<double>(k)));
    answers[k].estimate.tractions = answers[k].tractions;
    answers[k].estimate.time = static_cast<double>(k);
    estimates.push_back(answers[k].estimate);
  }
  const auto compare = [&](std::size_t k) {
    answers[k].estimate = estimates[k];
    return answers[k].bits() == expected[k].bits();
  };
  REQUIRE(estimator.update_batch(readings, estimates) == FrameStatus::ok);
  for (std::size_t k = 0; k < frames; ++k) CHECK(compare(k));
  CHECK(estimator.update_batch({}, {}) == FrameStatus::ok);

  // A bad frame keeps its estimate, the others are computed, the first bad status is told.
  for (Answer& each : answers) std::fill(each.tractions.begin(), each.tractions.end(), 17.0);
  readings[2 * estimator.readings() + 1] = not_a_number;
  readings[4 * estimator.readings() + 1] = 1e308;
  CHECK(estimator.update_batch(readings, estimates) == FrameStatus::not_finite);
  for (std::size_t k = 0; k < frames; ++k) CHECK(compare(k) == (k != 2 && k != 4));
  CHECK(answers[2].tractions == std::vector<double>(estimator.tractions(), 17.0));

  // Of a wrong size: nothing is computed.
  for (Answer& each : answers) std::fill(each.tractions.begin(), each.tractions.end(), 17.0);
  CHECK(estimator.update_batch(std::span(readings).subspan(1), estimates) ==
        FrameStatus::wrong_size);
  estimates.back().tractions = estimates.back().tractions.subspan(1);
  CHECK(estimator.update_batch(readings, estimates) == FrameStatus::wrong_size);
  for (const Answer& each : answers)
    CHECK(each.tractions == std::vector<double>(estimator.tractions(), 17.0));
}

TEST_CASE("a batch of a line is frame after frame, to the bit, on every instruction set",
          "[contact_estimator][batch]") {
  constexpr std::size_t frames = 45;  // two blocks, a tile and some beyond
  for (const std::size_t count : {2U, 3U, 13U, 40U})
    for (const Structure structure : structures)
      for (const Precision precision : {Precision::float64, Precision::float32})
        for (const std::size_t blocks : {1U, 2U})
          for (const bool diagnostics : {false, true}) {
            CAPTURE(count, name(structure), name(precision), blocks, diagnostics);
            EstimatorPlan plan = made_plan({.count = count,
                                            .channels = blocks,
                                            .unknowns = 3 - blocks,
                                            .structure = structure,
                                            .precision = precision,
                                            .diagnostics = diagnostics});
            plan.residual_limit = 0.1;
            plan.force_deviation = 0.1;
            std::vector<double> readings = some_readings(frames * plan.readings());
            const std::size_t n = plan.readings();
            readings[3 * n + 1] = not_a_number;
            readings[21 * n] = 1e308;
            readings[44 * n] = 2e9;  // beyond the channel's range
            for (const InstructionSet set :
                 {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
              ContactEstimator estimator(plan, set);
              check_batch(estimator, readings);
              REQUIRE(estimator.set_baseline(std::vector<double>(n, 0.25)) == FrameStatus::ok);
              (void)estimator.set_dead(1);
              check_batch(estimator, readings);
            }
          }
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    ContactEstimator estimator(
        plan_estimator(problem, 1e-4, {.noise_rms = 1e-3, .friction_coefficient = 0.7}).plan);
    check_batch(estimator, some_readings(frames * estimator.readings()));
  }
}

TEST_CASE("copies are independent, and what was moved away can be assigned to again",
          "[contact_estimator]") {
  ContactEstimator original(made_plan({}));
  const std::vector<double> g = random_values(original.readings(), 1);
  const auto plain = answer(original, g).bits();

  ContactEstimator copy(original);
  const std::vector<double> baseline(g.size(), 0.5);
  REQUIRE(copy.set_baseline(baseline) == FrameStatus::ok);
  REQUIRE(copy.set_dead(3));
  REQUIRE(copy.set_dead(7));
  const auto changed = answer(copy, g).bits();
  CHECK(changed != plain);
  CHECK(answer(original, g).bits() == plain);

  // A copy takes the baseline and the dead along.
  ContactEstimator second(copy);
  CHECK(answer(second, g).bits() == changed);
  copy.revive();
  CHECK(answer(copy, g).bits() != changed);
  CHECK(answer(second, g).bits() == changed);

  ContactEstimator moved(std::move(second));
  CHECK(answer(moved, g).bits() == changed);
  second = original;
  CHECK(answer(second, g).bits() == plain);
  original = std::move(moved);
  CHECK(answer(original, g).bits() == changed);
  const ContactEstimator& self = original;
  original = self;
  CHECK(answer(original, g).bits() == changed);
  CHECK(original.label() == "made by hand");
}

TEST_CASE("what lies between the ends of a range is not saturated, zeros of either sign included",
          "[contact_estimator]") {
  const std::vector<double> numbers{-1e300, -1.0, -1e-310, -0.0, 0.0, 1e-310, 1.0, 1e300};
  for (const InstructionSet set :
       {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512})
    for (const double lowest : numbers)
      for (const double highest : numbers) {
        if (!(lowest < highest)) continue;
        EstimatorPlan plan = made_plan({.count = 19, .channels = 1});
        plan.ranges.assign(1, {-2e300, 2e300});
        plan.ranges.resize(plan.readings(), plan.ranges[0]);
        for (const std::size_t place : {0U, 7U, 18U}) {
          EstimatorPlan one = plan;
          one.ranges[place] = {lowest, highest};
          ContactEstimator estimator(one, set);
          for (const double value : numbers) {
            CAPTURE(name(set), lowest, highest, value, place);
            std::vector<double> g(plan.readings(), 0.5);
            g[place] = value;
            Answer out(estimator);
            if (estimator.update(g, out.estimate) != FrameStatus::ok) continue;
            CHECK(out.estimate.saturated == !(value > lowest && value < highest));
          }
        }
      }
}

TEST_CASE("a saturated reading is told, by its channel's range, unless it is dead",
          "[contact_estimator]") {
  EstimatorPlan plan = made_plan({.count = 5, .channels = 2});
  plan.ranges = {{-1.0, 2.0}, {-10.0, 20.0}};
  plan.weights[8] = 0.0;
  ContactEstimator estimator(plan);
  const auto saturated = [&](std::size_t i, double value) {
    std::vector<double> g(10, 0.5);
    g[i] = value;
    return answer(estimator, g).estimate.saturated;
  };
  CHECK_FALSE(saturated(0, 0.0));
  for (const std::size_t i : {0U, 2U, 4U}) {
    CHECK(saturated(i, 2.0));  // at the limit is beyond it: the converter stands still there
    CHECK(saturated(i, -1.0));
    CHECK_FALSE(saturated(i, std::nextafter(2.0, 0.0)));
    CHECK_FALSE(saturated(i + 5 == 8 ? 5 : i + 5, 2.0));
  }
  CHECK(saturated(5, 20.0));
  CHECK(saturated(9, -11.0));
  CHECK_FALSE(saturated(8, 1e6));  // dead in the plan
  CHECK(saturated(2, 3.0));
  REQUIRE(estimator.set_dead(2));
  CHECK_FALSE(saturated(2, 3.0));
  estimator.revive();
  CHECK(saturated(2, 3.0));

  // By what the sensor says, not by what is left of it.
  REQUIRE(estimator.set_baseline(std::vector<double>(10, 1.9)) == FrameStatus::ok);
  CHECK(saturated(0, 2.0));
  CHECK_FALSE(saturated(0, 1.0));

  plan.ranges.clear();
  ContactEstimator unlimited(plan);
  CHECK_FALSE(answer(unlimited, std::vector<double>(10, 1e12)).estimate.saturated);
}
