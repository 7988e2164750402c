#include "tactile_net/skin/data_verdict.hpp"

#include <limits>
#include <optional>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/skin/family.hpp"
#include "tests/catch.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// A skin's readings of honest contacts with 1 % noise, and what a solver makes of them.
class Bench {
 public:
  Bench() : family_(problem_) {}

  struct Frame {
    std::vector<double> readings{};
    double rms = 0.0;
  };
  Frame frame(const Material& material = silicone, double depth = 2e-3) {
    Frame made{exact_readings(square_skin(8, depth), material, random_contacts(random_, 4e-3)),
               0.0};
    made.rms = add_noise(made.readings, 0.01, random_);
    return made;
  }
  DataVerdict judge(const std::vector<double>& readings, DataLimits limits) const {
    const FilterFrame seen = family_.analyse(readings);
    const double alpha = choose_alone(seen, AlphaRule::aicc).alpha;
    return SkinDataJudge(problem_, std::move(limits)).judge(readings, family_.solve(seen, alpha));
  }

 private:
  LinearProblem problem_ = make_problem(square_skin(8, 2e-3), silicone);
  SkinFamily family_;
  std::mt19937 random_{17};
};

}  // namespace

TEST_CASE("honest frames of a skin are not doubted", "[skin][data]") {
  Bench bench;
  for (int i = 0; i < 12; ++i) {
    const auto [readings, rms] = bench.frame();
    const DataVerdict verdict = bench.judge(readings, {.noise_rms = rms});
    CAPTURE(i, verdict.residual_rms, verdict.residual_limit);
    CHECK(verdict.consistent());
    CHECK(verdict.residual_rms <= verdict.residual_limit);
  }
}

TEST_CASE("a skin's single liar is found, and a sign turned round", "[skin][data]") {
  Bench bench;
  for (int i = 0; i < 3; ++i) {
    const auto [readings, rms] = bench.frame();
    std::vector<double> lies = readings;
    lies[27] += 30.0 * rms;
    const DataVerdict liar = bench.judge(lies, {.noise_rms = rms});
    REQUIRE(liar.has(DataDoubt::bad_taxel));
    CHECK(liar.taxel == 27U);
    for (double& reading : lies) reading = 0.0;
    for (std::size_t k = 0; k < lies.size(); ++k) lies[k] = -readings[k];
    CHECK(bench.judge(lies, {.noise_rms = rms}).has(DataDoubt::pulls));
  }
}

TEST_CASE("a lie that a narrow contact takes up is told of a skin, and by no honest frame",
          "[skin][data]") {
  const SkinArray skin = square_skin(6, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  const SkinContact contact{
      .y = 0.4e-3, .z = -0.3e-3, .radius = 3e-3, .force = 0.05, .friction = 0.3};
  std::mt19937 random(3);
  std::vector<double> readings = exact_readings(skin, silicone, std::vector<SkinLoad>{contact});
  const double rms = add_noise(readings, 0.01, random);
  const SkinFamily family(problem);
  const SkinDataJudge judge(problem, {.noise_rms = rms, .friction_limit = 0.5});
  const auto judged = [&] {
    const FilterFrame seen = family.analyse(readings);
    return judge.judge(readings, family.solve(seen, choose_alone(seen, AlphaRule::aicc).alpha));
  };
  CHECK(judged().consistent());
  for (const std::size_t taxel : {8u, 20u}) {
    readings[taxel] += 15.0 * rms;
    CAPTURE(taxel);
    const DataVerdict data = judged();
    CHECK(data.doubts == std::vector{DataDoubt::bad_taxel});
    CHECK(data.taxel == taxel);
    readings[taxel] -= 15.0 * rms;
  }
}

TEST_CASE("a skin's limit of friction that is too low is doubted, and no taxel", "[skin][data]") {
  const SkinArray skin = square_skin(8, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone);
  const SkinContact contact{.y = 0.4e-3,
                            .z = -0.3e-3,
                            .radius = 2.5e-3,
                            .force = 0.05,
                            .friction = 0.6,
                            .direction = 0.7};
  std::mt19937 random(3);
  std::vector<double> readings = exact_readings(skin, silicone, std::vector<SkinLoad>{contact});
  const double rms = add_noise(readings, 0.01, random);
  const SkinFamily family(problem);
  const FilterFrame seen = family.analyse(readings);
  const std::vector<double> found = family.solve(seen, choose_alone(seen, AlphaRule::aicc).alpha);
  const auto judged = [&](std::optional<double> limit) {
    return SkinDataJudge(problem, {.noise_rms = rms, .friction_limit = limit})
        .judge(readings, found);
  };
  const DataVerdict low = judged(0.1);
  CHECK(low.doubts == std::vector{DataDoubt::friction_limit});
  CHECK_FALSE(low.taxel);
  CHECK(low.residual_rms > low.residual_limit);
  CHECK(judged(0.7).consistent());
  CHECK(judged(std::nullopt).consistent());
  CHECK_FALSE(low.noise_alone);
  std::vector<double> noise(readings.size());
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = i % 2 == 0 ? rms : -rms;
  CHECK(SkinDataJudge(problem, {.noise_rms = rms})
            .judge(noise, std::vector<double>(problem.kernel.columns))
            .noise_alone);
}

TEST_CASE("a skin of another depth fits nothing, and a strain beyond 1 is no reading",
          "[skin][data]") {
  Bench bench;
  const auto [readings, rms] = bench.frame(silicone, 0.7e-3);
  const DataVerdict wrong = bench.judge(readings, {.noise_rms = 0.1 * rms});
  CHECK_FALSE(wrong.consistent());
  CHECK(wrong.residual_rms > wrong.residual_limit);
  CHECK(bench.judge(readings, {}).consistent());  // of what noise nobody said
  const DataVerdict huge = bench.judge(
      readings, {.noise_rms = rms, .largest_readings = std::vector<double>(192, 1e-3 * rms)});
  CHECK(huge.has(DataDoubt::implausible));
  CHECK(huge.strain > 1.0);
}

TEST_CASE("limits of a skin's judge that are none are refused", "[skin][data]") {
  const LinearProblem problem = make_problem(square_skin(3, 2e-3), silicone);
  const auto refused = [&](const DataLimits& limits, const std::string& rule) {
    CHECK_THROWS_WITH(SkinDataJudge(problem, limits), ContainsSubstring(rule));
  };
  refused({.noise_rms = 0.0}, "noise_rms");
  refused({.friction_limit = -1.0}, "friction_limit");
  refused({.largest_traction = std::numeric_limits<double>::infinity()}, "largest_traction");
  refused({.largest_readings = {1.0}}, "one value > 0 per row");
  CHECK_THROWS_WITH(SkinDataJudge(problem, make_problem(square_skin(4, 2e-3), silicone), {}),
                    ContainsSubstring("rows and components"));
  const SkinDataJudge judge(problem, {.noise_rms = 1.0});
  CHECK_THROWS_WITH(judge.judge(std::vector<double>(2), std::vector<double>(3)),
                    ContainsSubstring("2 values"));
  CHECK(judge.judge(std::vector<double>(27), std::vector<double>(problem.kernel.columns))
            .consistent());
}

TEST_CASE("constants that are not known change no verdict of a skin", "[skin][data][offset]") {
  std::mt19937 random(5);
  const SkinArray skin = square_skin(6, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone, {.unknown_offsets = true});
  const SkinFamily family(problem);
  std::vector<double> readings = exact_readings(skin, silicone, random_contacts(random, 3e-3));
  const double rms = add_noise(readings, 0.01, random);
  const SkinDataJudge judge(
      problem, {.noise_rms = rms,
                .largest_readings = std::vector<double>(readings.size(), silicone.youngs_modulus)});
  const auto verdict = [&](const std::vector<double>& of) {
    return judge.judge(of, family.solve(family.analyse(of), 1e-3));
  };
  const DataVerdict expected = verdict(readings);
  REQUIRE(expected.consistent());
  for (const double offset : {-2.0, 0.1, 30.0}) {
    std::vector<double> off = readings;
    for (std::size_t i = 0; i < off.size(); ++i)
      if (problem.sites[i].channel != 1) off[i] += offset * silicone.youngs_modulus;
    const DataVerdict found = verdict(off);
    CAPTURE(offset);
    CHECK(found.doubts == expected.doubts);
    CHECK_THAT(found.strain, WithinRel(expected.strain, 1e-9));
    CHECK_THAT(found.residual_rms, WithinRel(expected.residual_rms, 1e-3));
  }
}

TEST_CASE("readings that depend on no traction are judged, and nothing explains them",
          "[skin][data]") {
  const LinearProblem problem = make_problem(square_skin(1, 2e-3, {Quantity::shear_xy}), silicone,
                                             {.components = 1, .grid = {.margin = 0.0}});
  REQUIRE(problem.kernel.columns == 1);
  const SkinDataJudge judge(problem, {.noise_rms = 1.0});
  const std::vector<double> none{0.0};
  CHECK(judge.judge(std::vector{0.5}, none).consistent());
  const DataVerdict loud = judge.judge(std::vector{50.0}, none);
  CHECK_FALSE(loud.consistent());
  CHECK_THAT(loud.residual_rms, WithinRel(50.0, 1e-12));
}
