// Plans of skins against the dense answer: `SkinFamily::solve`, which knows no plan.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/control/skin_planner.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/skin/forward.hpp"
#include "tactile_net/skin/load.hpp"
#include "tests/catch.hpp"
#include "tests/control/skins.hpp"

using namespace tactile_net;

namespace {

double norm(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

struct Planned {
  Skin skin;
  SkinFamily family;
  PlannedEstimator estimator;
};

Planned planned(const Skin& skin, double alpha, const PlannerOptions& options = {}) {
  SkinFamily family(skin.problem);
  PlannedEstimator estimator =
      plan_estimator(skin.problem, family, alpha, options, skin.whole ? &*skin.whole : nullptr);
  return {skin, std::move(family), std::move(estimator)};
}

/// |planned - dense| over what the plan promises for this frame.
double share_of_bound(const Planned& one, const std::vector<double>& readings) {
  const EstimatorPlan& plan = one.estimator.plan;
  ContactEstimator estimator(plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate estimate{.tractions = f};
  REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
  std::vector<double> live = readings;
  for (std::size_t i = 0; i < live.size(); ++i)
    if (one.skin.problem.weights[i] == 0.0) live[i] = 0.0;
  const std::vector<double> exact = one.family.solve(one.family.analyse(live), plan.alpha);
  const Matrix& kernel = one.skin.problem.kernel;
  const std::vector<double> rows = weighted(one.skin.problem, live);
  double residual = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double left = rows[i];
    for (std::size_t j = 0; j < exact.size(); ++j) left -= kernel(i, j) * exact[j];
    residual = std::hypot(residual, left);
  }
  std::vector<double> difference(f.size());
  for (std::size_t i = 0; i < f.size(); ++i) difference[i] = f[i] - exact[i];
  // |M W^-1|_2 from below: what the frame itself is multiplied by. Sharper than the promise.
  const double gain = norm(exact) / norm(rows);
  return norm(difference) / (plan.accuracy * (norm(exact) + gain * residual));
}

std::string choice(const PlannedEstimator& planned) {
  for (const Candidate& candidate : planned.candidates)
    if (candidate.chosen)
      return std::string(name(candidate.structure)) + (candidate.exchanged ? " and exchange" : "");
  return {};
}

}  // namespace

TEST_CASE("every frame of a skin's plan is as near to the dense answer as promised",
          "[skin_plan]") {
  for (const Skin& skin : {square(8), square(7, 1), rectangle(5, 9), rectangle(1, 6), two_depths(5),
                           uneven(40), fine(6), square(1)})
    for (const double accuracy : {1e-2, 1e-4, 1e-7}) {
      const Planned one = planned(skin, 1e-4, {.accuracy = accuracy});
      CAPTURE(skin.name, accuracy, one.estimator.why());
      CHECK(one.estimator.plan.error_bound <= accuracy);
      for (unsigned seed = 0; seed < 4; ++seed)
        CHECK(share_of_bound(one, frame_of(skin.problem, seed)) <= 1.0);
      CHECK(encode_plan(decode_plan(encode_plan(one.estimator.plan))) ==
            encode_plan(one.estimator.plan));
    }
}

TEST_CASE("every structure that can be asked for gives the same tractions", "[skin_plan]") {
  for (const Skin& skin : {square(6), rectangle(5, 7)})
    for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                      Structure::reflections_low_rank})
      for (const Precision precision : {Precision::float64, Precision::float32}) {
        const double accuracy = precision == Precision::float64 ? 1e-7 : 5e-2;
        const Planned one = planned(
            skin, 1e-4, {.accuracy = accuracy, .structure = structure, .precision = precision});
        CAPTURE(skin.name, name(structure), name(precision), one.estimator.why());
        CHECK(one.estimator.plan.reconstruction.structure == structure);
        CHECK(one.estimator.plan.reconstruction.precision == precision);
        CHECK(one.estimator.plan.error_bound <= accuracy);
        for (unsigned seed = 0; seed < 4; ++seed)
          CHECK(share_of_bound(one, frame_of(skin.problem, seed)) <= 1.0);
      }
}

TEST_CASE("the cheapest structure is chosen: what of the symmetry is there", "[skin_plan]") {
  CHECK(choice(planned(square(8), 1e-4).estimator) == "reflections and exchange");
  CHECK(choice(planned(rectangle(8, 9), 1e-4).estimator) == "reflections");
  const std::string of_uneven = choice(planned(uneven(40), 1e-4).estimator);
  CHECK((of_uneven == "dense" || of_uneven == "low_rank"));
  // Pressures alone at a few times the depth: hardly anything is left.
  CHECK(choice(planned(uneven(60, 8e-3), 1e-2, {.accuracy = 1e-2}).estimator) == "low_rank");
  const Planned one = planned(square(8), 1e-4);
  const std::size_t dense = 8 * one.estimator.plan.tractions() * one.estimator.plan.readings();
  CHECK(80 * streamed_bytes(one.estimator.plan.reconstruction) < 11 * dense);
  CHECK_THROWS_WITH(plan_estimator(uneven(40).problem, SkinFamily(uneven(40).problem), 1e-4,
                                   {.structure = Structure::reflections}),
                    ContainsSubstring("not mirror symmetric"));
}

TEST_CASE("dead taxels leave the plan its classes, and the answer is that without them",
          "[skin_plan]") {
  for (const Skin& skin : {square(8, 0, {9}), square(7, 0, {0, 1, 24, 48}), rectangle(5, 8, {13}),
                           square(6, 0, {0, 1, 2, 3, 4, 5})})
    for (const double accuracy : {1e-3, 1e-7}) {
      const Planned one = planned(skin, 1e-4, {.accuracy = accuracy});
      CAPTURE(skin.name, accuracy, one.estimator.why());
      CHECK(choice(one.estimator).starts_with("reflections"));
      CHECK(one.estimator.plan.error_bound <= accuracy);
      for (unsigned seed = 0; seed < 4; ++seed) {
        std::vector<double> readings = frame_of(skin.problem, seed);
        for (std::size_t i = 0; i < readings.size(); ++i)
          if (one.skin.problem.weights[i] == 0.0)
            readings[i] = i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e250;
        CHECK(share_of_bound(one, readings) <= 1.0);
      }
      // Without knowing the whole the matrix itself is taken.
      Skin alone = skin;
      alone.whole.reset();
      const Planned dense = planned(alone, 1e-4, {.accuracy = accuracy});
      CHECK_FALSE(choice(dense.estimator).starts_with("reflections"));
      CHECK(share_of_bound(dense, frame_of(skin.problem, 3)) <= 1.0);
    }
}

TEST_CASE("where most taxels are dead two factors of their rank are cheaper", "[skin_plan]") {
  std::vector<std::size_t> dead(30);
  for (std::size_t i = 0; i < dead.size(); ++i) dead[i] = i;
  const Planned one = planned(square(6, 0, dead), 1e-4);
  CHECK(choice(one.estimator) == "low_rank");
  for (unsigned seed = 0; seed < 4; ++seed)
    CHECK(share_of_bound(one, frame_of(one.skin.problem, seed)) <= 1.0);
}

TEST_CASE("a taxel that dies at run time is one that the plan left out", "[skin_plan]") {
  const Planned whole = planned(square(7), 1e-4);
  const Planned without = planned(square(7, 0, {17}), 1e-4);
  // Of a plan with one dead another dies.
  const Planned both = planned(square(7, 0, {17, 30}), 1e-4);
  std::vector<double> readings = frame_of(whole.skin.problem, 5);
  const auto answer = [&](const Planned& one, std::vector<std::size_t> dead) {
    ContactEstimator estimator(one.estimator.plan);
    for (const std::size_t taxel : dead) REQUIRE(estimator.set_dead(taxel));
    std::vector<double> f(estimator.tractions());
    ContactEstimate estimate{.tractions = f};
    REQUIRE(estimator.update(readings, estimate) == FrameStatus::ok);
    f.push_back(1e3 * estimate.residual_rms);
    return f;
  };
  const auto near = [&](const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> difference(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
    return norm(difference) <= 1e-5 * norm(b);
  };
  CHECK(near(answer(whole, {17}), answer(without, {})));
  CHECK_FALSE(near(answer(whole, {}), answer(without, {})));
  CHECK(near(answer(whole, {17, 30}), answer(both, {})));
  CHECK(near(answer(without, {30}), answer(both, {})));
}

TEST_CASE("a press, a drag and a twist are found in a frame", "[skin_plan]") {
  const double noise = 5.0;  // Pa, of some 10 kPa
  const Skin skin = square(12);
  const Planned one = planned(skin, 1e-4, {.noise_rms = noise, .friction_coefficient = 0.8});
  ContactEstimator estimator(one.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const SkinContact contact{
      .y = 1e-3, .z = -2e-3, .radius = 4e-3, .force = 1.5, .friction = 0.3, .direction = 0.6};
  const std::vector<SkinLoad> loads{contact};
  std::vector<double> readings = exact_readings(skin.array, skin.material, loads);
  std::mt19937 generator(3);
  std::normal_distribution<double> of_noise(0.0, noise);
  for (double& reading : readings) reading += of_noise(generator);
  REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
  CHECK(e.contact);
  CHECK(e.touching > 10);
  CHECK(e.touching < one.estimator.plan.values / 2);
  CHECK_THAT(e.normal_force, WithinRel(1.5, 0.05));
  CHECK_THAT(e.tangential_y, WithinAbs(0.45 * std::cos(0.6), 0.03));
  CHECK_THAT(e.tangential_z, WithinAbs(0.45 * std::sin(0.6), 0.03));
  CHECK_THAT(e.centre, WithinAbs(1e-3, 1e-4));
  CHECK_THAT(e.centre_z, WithinAbs(-2e-3, 1e-4));
  CHECK_THAT(e.torsion, WithinAbs(0.0, 1e-4));
  CHECK_THAT(e.friction_margin, WithinRel(0.8 * 1.5 - 0.45, 0.1));
  CHECK_THAT(e.slip_margin, WithinAbs(1.0 - 0.3 / 0.8, 0.05));
  CHECK_FALSE(e.misfit);
  CHECK_FALSE(e.pulls);
  CHECK(e.outlier == -1);

  // Nothing touches: noise alone.
  for (double& reading : readings) reading = of_noise(generator);
  REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
  CHECK_FALSE(e.contact);
  CHECK(std::isnan(e.centre));
}

TEST_CASE("two contacts that are dragged apart have the margin of one of them", "[skin_plan]") {
  const double noise = 5.0;
  const double mu = 0.5;
  const Skin skin = fine(10);
  const Planned one = planned(skin, 1e-4, {.noise_rms = noise, .friction_coefficient = mu});
  ContactEstimator estimator(one.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const auto update = [&](const std::vector<SkinLoad>& loads) {
    REQUIRE(estimator.update(exact_readings(skin.array, skin.material, loads), e) ==
            FrameStatus::ok);
  };
  const double used = GENERATE(0.3, 0.9);
  SkinContact left{.y = -5e-3, .radius = 2.5e-3, .force = 0.5, .friction = used * mu};
  SkinContact right = left;
  right.y = -left.y;
  right.direction = std::numbers::pi;
  update({left});
  CHECK(e.contacts == 1);
  const double alone = e.slip_margin;
  const double in_newtons = e.friction_margin;
  CHECK_THAT(alone, WithinAbs(1.0 - used, 0.15));  // the pad blurs drag and pressure
  update({left, right});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.normal_force, WithinRel(1.0, 0.1));  // of both
  CHECK_THAT(e.tangential_force, WithinAbs(0.0, 0.01));
  CHECK_THAT(e.slip_margin, WithinAbs(alone, 0.05));  // of one
  CHECK_THAT(e.friction_margin, WithinAbs(in_newtons, 0.05 * mu * left.force));
  // The weaker one slips first.
  left.force = 0.2;
  right.friction = 0.1 * mu;
  update({left, right});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.margin_centre, WithinAbs(left.y, 5e-4));
  CHECK_THAT(e.margin_centre_z, WithinAbs(0.0, 5e-4));
  CHECK_THAT(e.slip_margin, WithinAbs(alone, 0.1));
}

TEST_CASE("the deviation of a found contact's force holds what noise does to it", "[skin_plan]") {
  const double noise = GENERATE(5.0, 50.0);
  const Skin skin = GENERATE(fine(8), square(9));
  const Planned one = planned(skin, 1e-3, {.noise_rms = noise});
  ContactEstimator estimator(one.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const std::vector<SkinLoad> loads{SkinContact{.y = 1e-3, .radius = 3e-3, .force = 1.0}};
  const std::vector<double> exact = exact_readings(skin.array, skin.material, loads);
  std::mt19937 generator(5);
  std::normal_distribution<double> of_noise(0.0, noise);
  double sum = 0.0;
  double squares = 0.0;
  double said = 0.0;
  constexpr int frames = 60;
  for (int k = 0; k < frames; ++k) {
    std::vector<double> readings = exact;
    for (double& reading : readings) reading += of_noise(generator);
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    REQUIRE(e.touching > 0);
    sum += e.normal_force / frames;
    squares += e.normal_force * e.normal_force / frames;
    said += e.force_deviation / frames;
  }
  const double spread = std::sqrt(squares - sum * sum);
  CAPTURE(skin.name, noise, spread, said);
  CHECK(said > 0.8 * spread);
  CHECK(said < 6.0 * spread);
}

TEST_CASE("a taxel that lies is found, and no contact near the edge is taken for one",
          "[skin_plan]") {
  const double noise = 5.0;
  const Skin skin = square(10);
  const Planned one = planned(skin, 1e-4, {.noise_rms = noise});
  ContactEstimator estimator(one.estimator.plan);
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  std::mt19937 generator(8);
  std::normal_distribution<double> of_noise(0.0, noise);
  int alarms = 0;
  int found = 0;
  for (int k = 0; k < 40; ++k) {
    const double y = -10e-3 + 0.5e-3 * k;
    const std::vector<SkinLoad> loads{
        SkinContact{.y = y, .z = 7e-3, .radius = 3e-3, .force = 1.0, .friction = 0.2}};
    std::vector<double> readings = exact_readings(skin.array, skin.material, loads);
    for (double& reading : readings) reading += of_noise(generator);
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    alarms += e.outlier >= 0 ? 1 : 0;
    const std::size_t liar = 44 + 100 * static_cast<std::size_t>(k % 3);
    readings[liar] += 3000.0;
    REQUIRE(estimator.update(readings, e) == FrameStatus::ok);
    found += e.outlier == static_cast<std::ptrdiff_t>(liar) ? 1 : 0;
  }
  CHECK(alarms == 0);
  CHECK(found == 40);
}

TEST_CASE("what cannot be planned is refused", "[skin_plan]") {
  const Skin skin = square(5);
  const SkinFamily family(skin.problem);
  CHECK_THROWS_AS(plan_estimator(skin.problem, family, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(plan_estimator(skin.problem, family, 1e-4, {.accuracy = 0.0}),
                  std::invalid_argument);
  CHECK_THROWS_WITH(plan_estimator(skin.problem, family, 1e-4, {.structure = Structure::fft}),
                    ContainsSubstring("of line arrays"));
  const Skin other = square(6);
  CHECK_THROWS_AS(plan_estimator(other.problem, family, 1e-4), std::invalid_argument);
  CHECK_THROWS_AS(plan_estimator(skin.problem, family, 1e-4, {}, &other.problem),
                  std::invalid_argument);
}
