// Frames that obey what contact allows: what they return lies inside the constraints to the last
// bit, and no farther from the minimum than they say, whatever the readings are.
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tests/catch.hpp"
#include "tests/control/plan_cases.hpp"

using namespace tactile_net;

namespace {

constexpr double friction = 0.8;

/// A sensor whose frames obey constraints.
struct ConeCase {
  std::string name;
  PlanCase sensor;
  double alpha;
  Constraints constraints{};
  double noise = 0.0;
};

/// 41 taxels above their own values, as in the literature's dense arrays, on a pad of modulus 1.
PlanCase line_41(std::size_t unknowns) {
  return line_of("line 41", {41, 1.0, {3.0}, {Quantity::stress_x, Quantity::shear_xy}},
                 {.unknowns = unknowns, .smoothing_length = 1.0});
}

std::vector<ConeCase> cone_cases() {
  return {
      {"skin, friction", square(8), 1e-3, {.friction_limit = friction}, 5.0},
      {"skin, friction, little smoothing", square(6), 1e-5, {.friction_limit = 0.2}, 5.0},
      {"skin, p >= 0 alone", rectangle(6, 5), 1e-3, {.nonnegative = true}, 5.0},
      {"skin, one unknown", square(6, 1), 1e-3, {.nonnegative = true}, 5.0},
      {"skin, dead taxels", rectangle(6, 6, {8, 22}), 1e-3, {.friction_limit = friction}, 5.0},
      {"skin, uneven", uneven(20), 1e-3, {.friction_limit = friction}, 5.0},
      {"line, friction", line_41(2), 1e-3, {.friction_limit = friction}, 0.01},
      {"line, p >= 0 alone", line_41(2), 1e-4, {.nonnegative = true}, 0.01},
      {"line, one unknown", line_41(1), 1e-4, {.nonnegative = true}, 0.01},
      {"line, hats", coarse_line({}), 1e-4, {.nonnegative = true}, 0.01},
      {"line, unknown offsets", dense_line({}, true), 1e-3, {.friction_limit = friction}, 0.01}};
}

PlannedEstimator plan_of(const ConeCase& one, bool diagnostics = true) {
  return planned(one.sensor, one.alpha,
                 {.diagnostics = diagnostics,
                  .noise_rms = one.noise,
                  .friction_coefficient = one.constraints.friction_limit,
                  .cone = ConeOptions{.constraints = one.constraints, .steps = 40}});
}

/// A frame's answer.
struct BoundFrame {
  std::vector<double> f;
  ContactEstimate estimate{};
};
BoundFrame bound_frame(ContactEstimator& estimator, const std::vector<double>& readings) {
  BoundFrame result{.f = std::vector<double>(estimator.tractions())};
  result.estimate.tractions = result.f;
  REQUIRE(estimator.update(readings, result.estimate) == FrameStatus::ok);
  return result;
}

/// Readings of `kind`: a contact, its reverse, white, one taxel far off, clipped, drag alone,
/// nothing.
constexpr std::size_t kinds = 7;
std::vector<double> readings_of(const ConeCase& one, std::size_t kind, unsigned seed) {
  const std::size_t m = one.sensor.problem.kernel.rows;
  std::vector<double> g = frame_for(one.sensor, 2 * seed);
  const std::vector<double> white = random_values(m, seed + 77);
  double most = 0.0;
  for (const double value : g) most = std::max(most, std::abs(value));
  if (most == 0.0) most = 1.0;
  switch (kind) {
    case 0:
      break;
    case 1:
      for (double& value : g) value = -value;
      break;
    case 2:
      for (std::size_t i = 0; i < m; ++i) g[i] = most * white[i];
      break;
    case 3:
      g[seed % m] = 100.0 * most;
      break;
    case 4:
      for (double& value : g) value = std::clamp(value, -0.1 * most, 0.1 * most);
      break;
    case 5:  // what one channel reads is taken away
      for (std::size_t i = 0; i < m / 2; ++i) g[i] = 0.0;
      break;
    default:
      for (std::size_t i = 0; i < m; ++i) g[i] = one.noise * white[i];
  }
  for (std::size_t i = 0; i < m; ++i)
    if (one.sensor.problem.weights[i] == 0.0) g[i] = 0.0;
  return g;
}

/// The minimum inside the constraints, by a solver that takes no such steps where there is one.
class ConeMinimum {
 public:
  explicit ConeMinimum(const ConeCase& one) : problem_(one.sensor.problem) {
    if (problem_.is_line)
      exact_.emplace(problem_, one.alpha, one.constraints);
    else
      cone_.emplace(problem_, one.alpha, one.constraints);
    matrix_ = normal_matrix(problem_, one.alpha);
  }
  [[nodiscard]] std::vector<double> operator()(const std::vector<double>& readings) const {
    if (exact_) return exact_->solve(readings, 100'000).tractions;
    return cone_->solve(readings, 100'000, 1e-13).tractions;
  }
  /// |a|_P.
  [[nodiscard]] double size(const std::vector<double>& a) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < a.size(); ++j) sum += a[i] * matrix_(i, j) * a[j];
    return std::sqrt(std::max(sum, 0.0));
  }

 private:
  const LinearProblem& problem_;
  std::optional<ConstrainedTikhonov> exact_{};
  std::optional<ConeTikhonov> cone_{};
  Matrix matrix_{};
};

/// Whether each cell lies in its cone, as a double's comparison says.
bool obeys(const std::vector<double>& f, std::size_t unknowns, const Constraints& constraints) {
  const std::size_t n = f.size() / unknowns;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(f[i] >= 0.0)) return false;
    if (!constraints.friction_limit) continue;
    const double drag = unknowns == 2 ? std::abs(f[n + i]) : std::hypot(f[n + i], f[2 * n + i]);
    if (!(drag <= *constraints.friction_limit * f[i])) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a frame obeys its constraints and is as near to the minimum as it says", "[cone_plan]") {
  const std::vector<ConeCase> cases = cone_cases();
  const ConeCase& one = cases[GENERATE_REF(range(std::size_t{0}, cases.size()))];
  INFO(one.name);
  const PlannedEstimator plan = plan_of(one);
  ContactEstimator estimator(plan.plan);
  const ConeMinimum minimum(one);
  std::mt19937 random(7);
  for (std::size_t kind = 0; kind < kinds; ++kind)
    for (unsigned seed = 0; seed < 3; ++seed) {
      INFO("kind " << kind << ", seed " << seed);
      const std::vector<double> readings = readings_of(one, kind, seed);
      const std::vector<double> best = minimum(readings);
      estimator.set_work({.steps = 1 + random() % 30});
      const BoundFrame found = bound_frame(estimator, readings);
      CHECK(obeys(found.f, plan.plan.unknowns, one.constraints));
      const std::vector<double> free(estimator.free_tractions().begin(),
                                     estimator.free_tractions().end());
      const double off = minimum.size(difference(found.f, best));
      // Both begin with linear frames that are as far apart as the plan is accurate.
      const double apart = 1e-7 * minimum.size(free) + 1e-9 * minimum.size(best);
      CHECK(off <= one.noise * found.estimate.unfinished + apart);
      // In standard deviations: sums too.
      if (!one.sensor.problem.unknown_offsets && minimum.size(free) > 0.0) {
        const double share = one.noise * found.estimate.unfinished / minimum.size(free);
        CHECK_THAT(found.estimate.unfinished_share, WithinRel(share, 0.1));
      }
    }
}

TEST_CASE("steps lead to the minimum, and what is unfinished falls with them", "[cone_plan]") {
  const std::vector<ConeCase> cases = cone_cases();
  const ConeCase& one = cases[GENERATE_REF(values<std::size_t>({0, 2, 3, 6, 8}))];
  INFO(one.name);
  ContactEstimator estimator(plan_of(one).plan);
  const ConeMinimum minimum(one);
  const std::vector<double> readings = readings_of(one, 0, 1);
  const std::vector<double> best = minimum(readings);
  double before = std::numeric_limits<double>::infinity();
  for (const std::size_t steps : {1U, 4U, 16U, 64U}) {
    estimator.set_work({.steps = steps});
    const BoundFrame found = bound_frame(estimator, readings);
    CHECK(found.estimate.steps == steps);
    CHECK(found.estimate.unfinished < before);
    before = found.estimate.unfinished;
    if (steps == 64) CHECK(l2_norm(difference(found.f, best)) < 1e-4 * l2_norm(best));
  }
}

TEST_CASE("a frame is bound by nothing but its readings", "[cone_plan]") {
  const std::vector<ConeCase> cases = cone_cases();
  const ConeCase& one = cases[GENERATE_REF(values<std::size_t>({0, 3, 6}))];
  INFO(one.name);
  const PlannedEstimator plan = plan_of(one);
  ContactEstimator estimator(plan.plan);
  const std::vector<double> readings = readings_of(one, 0, 1);
  const BoundFrame first = bound_frame(estimator, readings);

  SECTION("frames before it leave nothing behind, and a copy answers alike") {
    (void)bound_frame(estimator, readings_of(one, 2, 5));
    CHECK(bound_frame(estimator, readings).f == first.f);
    ContactEstimator copy(estimator);
    CHECK(bound_frame(copy, readings).f == first.f);
  }
  SECTION("times a power of two it gives the same times that") {
    for (const double factor : {0x1p-40, 4.0, 0x1p100}) {
      std::vector<double> scaled = readings;
      for (double& value : scaled) value *= factor;
      const BoundFrame other = bound_frame(estimator, scaled);
      for (std::size_t i = 0; i < first.f.size(); ++i) REQUIRE(other.f[i] == factor * first.f[i]);
      CHECK(other.estimate.unfinished == factor * first.estimate.unfinished);
    }
  }
  SECTION("a batch has the same bits") {
    const std::size_t frames = 13;
    std::vector<double> all;
    std::vector<std::vector<double>> results(frames);
    std::vector<ContactEstimate> estimates(frames);
    for (unsigned i = 0; i < frames; ++i) {
      const std::vector<double> frame = readings_of(one, i % kinds, i);
      all.insert(all.end(), frame.begin(), frame.end());
      results[i].resize(estimator.tractions());
      estimates[i].tractions = results[i];
    }
    REQUIRE(estimator.update_batch(all, estimates) == FrameStatus::ok);
    for (unsigned i = 0; i < frames; ++i) {
      const BoundFrame alone = bound_frame(estimator, readings_of(one, i % kinds, i));
      CHECK(alone.f == results[i]);
      CHECK(alone.estimate.unfinished == estimates[i].unfinished);
      CHECK(alone.estimate.normal_force == estimates[i].normal_force);
    }
  }
  SECTION("its plan's file answers alike") {
    ContactEstimator loaded(decode_plan(encode_plan(plan.plan)));
    const BoundFrame other = bound_frame(loaded, readings);
    CHECK(other.f == first.f);
    CHECK(other.estimate.unfinished == first.estimate.unfinished);
    CHECK(other.estimate.normal_force == first.estimate.normal_force);
  }
  SECTION("instruction sets differ by rounding") {
    for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2}) {
      ContactEstimator narrower(plan.plan, set);
      estimator.set_work({.steps = 40});
      narrower.set_work({.steps = 40});
      const BoundFrame wide = bound_frame(estimator, readings);
      const BoundFrame narrow = bound_frame(narrower, readings);
      CHECK(l2_norm(difference(wide.f, narrow.f)) < 1e-5 * l2_norm(wide.f));
    }
  }
}

TEST_CASE("a frame ends where it is told to", "[cone_plan]") {
  const ConeCase one = cone_cases().front();
  ContactEstimator estimator(plan_of(one).plan);
  const std::vector<double> readings = readings_of(one, 0, 1);
  estimator.set_work({.steps = 64});
  const BoundFrame whole = bound_frame(estimator, readings);
  estimator.set_work({.steps = 64, .enough = 1.0});
  const BoundFrame enough = bound_frame(estimator, readings);
  CHECK(enough.estimate.steps < whole.estimate.steps);
  CHECK(enough.estimate.unfinished <= 1.0);
  CHECK(enough.estimate.unfinished > whole.estimate.unfinished);

  std::atomic<bool> stop = true;
  estimator.set_work({.steps = 64});
  estimator.stop_at(&stop);
  const BoundFrame stopped = bound_frame(estimator, readings);
  CHECK(stopped.estimate.steps == 0);
  CHECK(obeys(stopped.f, 3, one.constraints));
  CHECK(stopped.estimate.unfinished > enough.estimate.unfinished);
  CHECK(std::isfinite(stopped.estimate.unfinished));
  stop = false;
  CHECK(bound_frame(estimator, readings).f == whole.f);
}

TEST_CASE("what obeys the constraints by itself stays as it is", "[cone_plan]") {
  // A press so even that its linear frame pulls nowhere: of cells everywhere.
  const ConeCase one = cone_cases().front();
  const LinearProblem& problem = one.sensor.problem;
  const std::size_t n = problem.grid.count();
  ContactEstimator estimator(plan_of(one).plan);
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    for (std::size_t j = 0; j < n; ++j)
      readings[i] += problem.kernel(i, j) * 1e4 + 0.1 * problem.kernel(i, n + j) * 1e4;
    readings[i] /= problem.weights[i];
  }
  const BoundFrame found = bound_frame(estimator, readings);
  const std::vector<double> free(estimator.free_tractions().begin(),
                                 estimator.free_tractions().end());
  REQUIRE(obeys(free, 3, one.constraints));
  CHECK(found.f == free);
  CHECK(found.estimate.unfinished < 1e-8);
}

TEST_CASE("a pull is nothing, and says that it pulls", "[cone_plan]") {
  const ConeCase one = cone_cases()[3];
  ContactEstimator estimator(plan_of(one).plan);
  const LinearProblem& problem = one.sensor.problem;
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i)
    for (std::size_t j = 0; j < problem.grid.count(); ++j)
      readings[i] -= problem.kernel(i, j) * 1e4 / problem.weights[i];
  const BoundFrame found = bound_frame(estimator, readings);
  for (const double value : found.f) CHECK(value == 0.0);
  CHECK(found.estimate.pulls);
  CHECK_FALSE(found.estimate.contact);
  CHECK(found.estimate.normal_force == 0.0);
}

TEST_CASE("forces are sums over the cells that touch, and nothing where none does", "[cone_plan]") {
  const ConeCase one = cone_cases()[GENERATE(std::size_t{0}, std::size_t{6})];
  INFO(one.name);
  const LinearProblem& problem = one.sensor.problem;
  const std::size_t n = problem.grid.count();
  ContactEstimator bound(plan_of(one).plan);
  PlannerOptions linear{.noise_rms = one.noise, .friction_coefficient = friction};
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, one.noise);
  const auto noisy = [&](const std::vector<double>& f) {
    std::vector<double> readings(problem.kernel.rows);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      for (std::size_t j = 0; j < f.size(); ++j) readings[i] += problem.kernel(i, j) * f[j];
      readings[i] = (readings[i] + noise(generator)) / problem.weights[i];
    }
    return readings;
  };
  // A Hertz contact whose force is known, dragged by half of what friction allows.
  std::vector<double> f(problem.kernel.columns);
  double force = 0.0;
  const double pressure = 300.0 * one.noise;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t columns = problem.grid.columns;
    const double y =
        (static_cast<double>(i / columns) - 0.5 * static_cast<double>(problem.grid.rows - 1)) / 3.0;
    const double z = columns > 1 ? (static_cast<double>(i % columns) - 3.5) / 3.0 : 0.0;
    const double inside = 1.0 - y * y - z * z;
    if (inside <= 0.0) continue;
    f[i] = pressure * std::sqrt(inside);
    f[n + i] = 0.5 * friction * f[i];
    force += problem.grid.area() * f[i];
  }
  double worst = 0.0;
  for (int frame = 0; frame < 20; ++frame) {
    const BoundFrame pressed = bound_frame(bound, noisy(f));
    CHECK(pressed.estimate.contact);
    CHECK(pressed.estimate.touching > 0);
    CHECK(pressed.estimate.touching < n);
    worst = std::max(worst, std::abs(pressed.estimate.normal_force / force - 1.0));
    const BoundFrame empty = bound_frame(bound, noisy(std::vector<double>(f.size())));
    CHECK(empty.estimate.normal_force == 0.0);
    CHECK_FALSE(empty.estimate.contact);
  }
  CHECK(worst < 0.05);
}

TEST_CASE("the smallest and the largest limits of friction bind as others do", "[cone_plan]") {
  const Skin skin = square(6);
  const auto with = [&](const Constraints& constraints) {
    const ConeCase one{"", skin, 1e-3, constraints, 5.0};
    ContactEstimator estimator(plan_of(one).plan);
    estimator.set_work({.steps = 64});
    return bound_frame(estimator, readings_of(one, 0, 1)).f;
  };
  const std::vector<double> large = with({.friction_limit = 1e3});
  const ConeCase reference{"", skin, 1e-3, {.friction_limit = 1e3}, 5.0};
  const std::vector<double> exact = ConeMinimum(reference)(readings_of(reference, 0, 1));
  CHECK(l2_norm(difference(large, exact)) < 1e-2 * l2_norm(exact));
  const std::vector<double> small = with({.friction_limit = 1e-3});
  for (std::size_t i = small.size() / 3; i < small.size(); ++i)
    CHECK(std::abs(small[i]) <= 1e-3 * l2_norm(small));
}

TEST_CASE("a plan says what its steps leave, and refuses to leave too much", "[cone_plan]") {
  const Skin skin = square(8);
  const auto options = [](ConeOptions cone) {
    return PlannerOptions{.diagnostics = false, .noise_rms = 5.0, .cone = cone};
  };
  const ConeOptions cone{.constraints = {.friction_limit = friction}};
  const PlannedEstimator plan = planned(skin, 1e-3, options(cone));
  REQUIRE(plan.plan.cone);
  CHECK(plan.plan.cone->expected.high <= cone.enough);
  CHECK(plan.plan.cone->steps >= 4);
  CHECK(plan.plan.cone->steps <= 20);
  REQUIRE(plan.unfinished.size() == ConePlan::most_steps + 1);
  CHECK(plan.unfinished[plan.plan.cone->steps - 1].high > cone.enough);
  CHECK(plan.unfinished.back().worst < plan.unfinished.front().median);

  const auto refusal = [&](double alpha, const ConeOptions& asked, const Skin& of) {
    try {
      (void)planned(of, alpha, options(asked));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("planned");
  };
  ConeOptions few = cone;
  few.steps = 2;
  CHECK_THAT(refusal(1e-5, few, skin), ContainsSubstring("standard deviations"));
  CHECK_THAT(refusal(1e-5, few, skin), ContainsSubstring("steps at least, or smooth more"));
  ConeOptions many = cone;
  many.steps = 65;
  CHECK_THAT(refusal(1e-3, many, skin), ContainsSubstring("at most 64 steps"));
  ConeOptions none;
  none.constraints.nonnegative = false;
  CHECK_THAT(refusal(1e-3, none, skin), ContainsSubstring("needs a constraint"));
  for (const double limit : {0.0, -1.0, std::nan(""), 2e3}) {
    ConeOptions wrong = cone;
    wrong.constraints.friction_limit = limit;
    CHECK_THAT(refusal(1e-3, wrong, skin), ContainsSubstring("must be > 0"));
  }
  CHECK_THAT(refusal(1e-3, cone, square(6, 1)), ContainsSubstring("tangential tractions"));
}

TEST_CASE("without a noise what is unfinished is a share of the linear frame", "[cone_plan]") {
  ConeCase one = cone_cases().front();
  one.noise = 0.0;
  const PlannedEstimator plan = plan_of(one);
  ContactEstimator estimator(plan.plan);
  const std::vector<double> readings = readings_of(one, 0, 1);
  const BoundFrame found = bound_frame(estimator, readings);
  CHECK(std::isnan(found.estimate.unfinished));
  const ConeMinimum minimum(one);
  const std::vector<double> free(estimator.free_tractions().begin(),
                                 estimator.free_tractions().end());
  const double off = minimum.size(difference(found.f, minimum(readings)));
  CHECK(off <= (found.estimate.unfinished_share + 1e-7) * minimum.size(free));
  CHECK(found.estimate.unfinished_share < 0.05);
}
