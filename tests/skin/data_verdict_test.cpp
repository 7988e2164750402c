#include "tactile_net/inverse/data_verdict.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "inverse/data/frame_judge.hpp"
#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/judged_line.hpp"
#include "tests/skin/skins.hpp"

using namespace tactile_net;

namespace {

/// A line that is pressed, what it reads and what a solver makes of it.
struct PressedLine {
  PressedLine() = default;
  explicit PressedLine(JudgedLine of) : line(std::move(of)) {}

  [[nodiscard]] DataLimits limits() const { return line.limits(); }
  [[nodiscard]] std::vector<double> solved(const std::vector<double>& g) const {
    return tikhonov_solve(problem, 1e-5, g);
  }

  JudgedLine line{};
  LinearProblem problem = line.problem();
  double rms = line.noise;
  std::vector<double> readings = line.frame(contact_at(0.3), 1);
};

/// With tangential tractions among the unknowns.
struct DraggedLine : PressedLine {
  DraggedLine() : PressedLine(JudgedLine::two_tractions()) {}
};

/// The same of a skin.
struct PressedSkin {
  PressedSkin() {
    const SkinContact contact{
        .y = 0.4e-3, .z = -0.3e-3, .radius = 3e-3, .force = 0.05, .friction = 0.3};
    std::mt19937 random(3);
    readings = exact_readings(skin, silicone, std::vector<SkinLoad>{contact});
    rms = add_noise(readings, 0.01, random);
  }

  [[nodiscard]] DataLimits limits() const {
    return {.noise_rms = rms,
            .friction_limit = 0.5,
            .largest_readings = std::vector<double>(readings.size(), silicone.youngs_modulus)};
  }
  [[nodiscard]] std::vector<double> solved(const std::vector<double>& g) const {
    const FilterFrame seen = family.analyse(g);
    return family.solve(seen, choose_alone(seen, AlphaRule::aicc).alpha);
  }

  SkinArray skin = square_skin(6, 2e-3);
  LinearProblem problem = make_problem(skin, silicone);
  TikhonovFamily family{problem};
  double rms = 0.0;
  std::vector<double> readings{};
};

}  // namespace

TEMPLATE_TEST_CASE("readings with the other sign pull, with the noise stated or not",
                   "[skin][data]", PressedLine, DraggedLine, PressedSkin) {
  const TestType sensor;
  DataLimits limits = sensor.limits();
  if (GENERATE(true, false)) limits.noise_rms.reset();
  const DataJudge judge(sensor.problem, limits);
  CHECK(judge.judge(sensor.readings, sensor.solved(sensor.readings)).consistent());
  std::vector<double> turned = sensor.readings;
  for (double& reading : turned) reading = -reading;
  const DataVerdict data = judge.judge(turned, sensor.solved(turned));
  CHECK(data.doubts == only(DataDoubt::pulls));
  CHECK(data.noise_known == limits.noise_rms.has_value());
}

TEMPLATE_TEST_CASE("readings in another unit are implausible, with the noise stated or not",
                   "[skin][data]", PressedLine, DraggedLine, PressedSkin) {
  const TestType sensor;
  DataLimits limits = sensor.limits();
  if (GENERATE(true, false)) limits.noise_rms.reset();
  std::vector<double> readings = sensor.readings;
  for (double& reading : readings) reading *= 1e3;
  const DataVerdict data =
      DataJudge(sensor.problem, limits).judge(readings, sensor.solved(readings));
  CHECK(data.doubts == only(DataDoubt::implausible));
  CHECK(data.strain > 1.0);
}

TEMPLATE_TEST_CASE("noise alone is told from a contact", "[skin][data]", PressedLine, DraggedLine,
                   PressedSkin) {
  const TestType sensor;
  const std::vector<double> nothing(sensor.problem.kernel.columns);
  std::vector<double> noise(sensor.readings.size());
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = i % 2 == 0 ? sensor.rms : -sensor.rms;
  const DataJudge judge(sensor.problem, sensor.limits());
  CHECK(judge.judge(noise, nothing).noise_alone);
  CHECK_FALSE(judge.judge(sensor.readings, sensor.solved(sensor.readings)).noise_alone);
  // Without the noise nothing but readings of nothing is known to be nothing.
  const DataJudge unaware(sensor.problem, {});
  CHECK_FALSE(unaware.judge(noise, nothing).noise_alone);
  CHECK(unaware.judge(std::vector<double>(noise.size()), nothing).noise_alone);
}

TEMPLATE_TEST_CASE("a frame without a reading is consistent, one beyond doubles is not",
                   "[skin][data]", PressedLine, DraggedLine, PressedSkin) {
  const TestType sensor;
  const std::vector<double> nothing(sensor.problem.kernel.columns);
  const DataJudge judge(sensor.problem, {.noise_rms = sensor.rms});
  std::vector<double> readings(sensor.readings.size());
  CHECK(judge.judge(readings, nothing).consistent());
  readings.assign(readings.size(), std::numeric_limits<double>::max());
  const DataVerdict beyond = judge.judge(readings, nothing);
  CHECK(beyond.doubts == only(DataDoubt::misfit));
  CHECK(beyond.residual_rms == std::numeric_limits<double>::infinity());
  // One of them is enough, and is no single taxel that lies: no number says by how much.
  readings.assign(readings.size(), 0.0);
  readings.front() = std::numeric_limits<double>::max();
  CHECK(judge.judge(readings, nothing).doubts == only(DataDoubt::misfit));
}

TEMPLATE_TEST_CASE("limits out of range and sizes that do not fit are refused", "[skin][data]",
                   PressedLine, DraggedLine, PressedSkin) {
  const TestType sensor;
  const LinearProblem& problem = sensor.problem;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const DataLimits& limits, const std::string& rule) {
    CHECK_THROWS_WITH(DataJudge(problem, limits), ContainsSubstring(rule));
  };
  refused({.noise_rms = 0.0}, "noise_rms");
  refused({.noise_rms = infinity}, "noise_rms");
  refused({.friction_limit = -1.0}, "friction_limit");
  refused({.largest_traction = 0.0}, "largest_traction");
  refused({.largest_traction = infinity}, "largest_traction");
  refused({.largest_readings = {1.0}}, "one value > 0 per row");
  refused({.largest_readings = std::vector<double>(problem.weights.size())},
          "one value > 0 per row");

  LinearProblem others = problem;
  leave_out(others, std::vector<std::size_t>{0});
  CHECK_THROWS_WITH(DataJudge(problem, others, {}), ContainsSubstring("rows and components"));
  others = problem;
  others.unknown_offsets = true;
  CHECK_THROWS_WITH(DataJudge(problem, others, {}), ContainsSubstring("rows and components"));

  const DataJudge judge(problem, {.noise_rms = sensor.rms});
  const std::vector<double> nothing(problem.kernel.columns);
  CHECK_THROWS_WITH(judge.judge(std::vector<double>(2), nothing), ContainsSubstring("2 values"));
  CHECK_THROWS_WITH(judge.judge(sensor.readings, std::vector<double>(3)),
                    ContainsSubstring("3 values"));
}

TEST_CASE("a taxel does not contradict all others where there is no other", "[skin][data]") {
  for (LinearProblem problem :
       {JudgedLine{}.problem(),
        make_problem(square_skin(3, 2e-3, {Quantity::stress_x}), silicone, {.components = 1})}) {
    const std::size_t living = problem.taxels / 2;
    std::vector<std::size_t> dead;
    for (std::size_t taxel = 0; taxel < problem.taxels; ++taxel)
      if (taxel != living) dead.push_back(taxel);
    leave_out(problem, dead);
    std::vector<double> readings(problem.weights.size());
    readings[living] = -100.0;
    const DataVerdict data = DataJudge(problem, {.noise_rms = 1.0})
                                 .judge(readings, std::vector<double>(problem.kernel.columns));
    CHECK_FALSE(data.consistent());
    CHECK_FALSE(data.has(DataDoubt::bad_taxel));
    CHECK_FALSE(data.taxel);
  }
}

TEST_CASE("a line is judged by its nearest contact as by contacts in cones", "[skin][data][line]") {
  const auto problem = std::make_shared<const LinearProblem>(
      make_problem({.count = 21, .pitch = 1.0, .depths = {1.5}, .reads = {Quantity::stress_x}},
                   silicone, {.smoothing_length = 1.5}));
  std::vector<double> pressed(problem->kernel.columns);
  for (std::size_t i = 7; i < 14; ++i) pressed[i] = 1.0;
  std::vector<double> readings = product(problem->kernel, pressed);
  std::mt19937 random(4);
  const double rms = add_noise(readings, 1e-3, random);
  const DataLimits limits{.noise_rms = rms};
  const DataJudge nearest(*problem, limits);
  const JudgedProblem by_cones(*problem, limits);
  const FrameJudge flow(by_cones);
  const auto cones = cone_fit(by_cones, [problem] { return problem; });
  const auto judged = [&](const std::vector<double>& g) {
    const std::vector<double> f = tikhonov_solve(*problem, 1e-4, g);
    const DataVerdict one = nearest.judge(g, f);
    const DataVerdict other = flow.judge(*cones, g, f);
    CHECK(one.doubts == other.doubts);
    CHECK(one.taxel == other.taxel);
    CHECK(one.strain == other.strain);
    CHECK(one.residual_limit == other.residual_limit);
    return one;
  };
  CHECK(judged(readings).consistent());
  std::vector<double> lies = readings;
  lies[10] = 0.0;
  CHECK(judged(lies).taxel == 10U);
  for (double& reading : readings) reading = -reading;
  CHECK(judged(readings).doubts == only(DataDoubt::pulls));
}

TEST_CASE("a lie that a narrow contact takes up is told of a skin, and by no honest frame",
          "[skin][data]") {
  const PressedSkin sensor;
  std::vector<double> readings = sensor.readings;
  const DataJudge judge(sensor.problem, sensor.limits());
  const auto judged = [&] { return judge.judge(readings, sensor.solved(readings)); };
  CHECK(judged().consistent());
  for (const std::size_t taxel : {8u, 20u}) {
    readings[taxel] += 15.0 * sensor.rms;
    CAPTURE(taxel);
    const DataVerdict data = judged();
    CHECK(data.doubts == std::vector{DataDoubt::bad_taxel});
    CHECK(data.taxel == taxel);
    readings[taxel] -= 15.0 * sensor.rms;
  }
}

TEST_CASE("what a search meets on its way decides as its end does, wherever it begins",
          "[skin][data]") {
  // From tractions that are nearly a contact's, from none, and on a finer grid: what is said of a
  // frame is one and the same, and where no doubt is said some contact leaves no more than noise.
  const PressedSkin sensor;
  const DataLimits limits{.noise_rms = sensor.rms};
  const DataJudge on_own(sensor.problem, limits);
  const DataJudge on_finer(
      sensor.problem, make_problem(sensor.skin, silicone, {.grid = {.spacing = 0.7e-3}}), limits);
  std::mt19937 random(29);
  std::normal_distribution<double> noise(0.0, sensor.rms);
  const std::vector<double> cold(sensor.problem.kernel.columns);
  for (int i = 0; i < 12; ++i) {
    std::vector<double> readings =
        exact_readings(sensor.skin, silicone, random_contacts(random, 3e-3));
    for (double& reading : readings) reading += noise(random);
    for (const DataJudge* judge : {&on_own, &on_finer})
      for (const std::vector<double>& from : {sensor.solved(readings), cold}) {
        const DataVerdict found = judge->judge(readings, from);
        CAPTURE(i, found.residual_rms, found.residual_limit);
        CHECK(found.consistent());
        CHECK(found.residual_rms <= found.residual_limit);
      }
  }
  std::vector<double> lies = sensor.readings;
  lies[14] += 40.0 * sensor.rms;
  for (const std::vector<double>& from : {sensor.solved(lies), cold}) {
    const DataVerdict found = on_own.judge(lies, from);
    CHECK(found.doubts == std::vector{DataDoubt::bad_taxel});
    CHECK(found.taxel == 14U);
  }
}

TEST_CASE("a skin's limit of friction that is too low is doubted, and no taxel", "[skin][data]") {
  const PressedSkin sensor;  // dragged by 0.3 of what presses
  const std::vector<double> f = sensor.solved(sensor.readings);
  const auto judged = [&](std::optional<double> limit) {
    return DataJudge(sensor.problem, {.noise_rms = sensor.rms, .friction_limit = limit})
        .judge(sensor.readings, f);
  };
  const DataVerdict low = judged(0.05);
  CHECK(low.doubts == only(DataDoubt::friction_limit));
  CHECK_FALSE(low.taxel);
  CHECK(low.residual_rms > low.residual_limit);
  CHECK(judged(0.4).consistent());
  CHECK(judged(std::nullopt).consistent());
}

TEST_CASE("a skin of another depth fits nothing", "[skin][data]") {
  const PressedSkin sensor;
  std::mt19937 random(17);
  std::vector<double> readings =
      exact_readings(square_skin(6, 0.7e-3), silicone, random_contacts(random, 3e-3));
  const double rms = add_noise(readings, 0.01, random);
  const std::vector<double> f = sensor.solved(readings);
  const DataVerdict wrong = DataJudge(sensor.problem, {.noise_rms = 0.1 * rms}).judge(readings, f);
  CHECK_FALSE(wrong.consistent());
  CHECK(wrong.residual_rms > wrong.residual_limit);
  CHECK(DataJudge(sensor.problem, {}).judge(readings, f).consistent());  // nobody said what noise
}

TEST_CASE("constants that are not known change no verdict of a skin", "[skin][data][offset]") {
  std::mt19937 random(5);
  const SkinArray skin = square_skin(6, 2e-3);
  const LinearProblem problem = make_problem(skin, silicone, {.unknown_offsets = true});
  const TikhonovFamily family(problem);
  std::vector<double> readings = exact_readings(skin, silicone, random_contacts(random, 3e-3));
  const double rms = add_noise(readings, 0.01, random);
  const DataJudge judge(
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
  const DataJudge judge(problem, {.noise_rms = 1.0});
  const std::vector<double> none{0.0};
  CHECK(judge.judge(std::vector{0.5}, none).consistent());
  const DataVerdict loud = judge.judge(std::vector{50.0}, none);
  CHECK_FALSE(loud.consistent());
  CHECK_THAT(loud.residual_rms, WithinRel(50.0, 1e-12));
}
