// What the rules do at the ends of their bracket, with more components than rows, and with few
// rows.
#include <algorithm>
#include <cmath>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/largest.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

/// `rows` components of the given sizes, every one of the same gamma.
FilterFrame equal_gammas(double gamma, const std::vector<double>& beta) {
  return {.gamma = std::vector<double>(beta.size(), gamma),
          .beta = beta,
          .scale = 2.0,
          .rows = beta.size()};
}

double square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

}  // namespace

TEST_CASE("with one gamma the evidence's alpha is known, however far from that it lies",
          "[alpha][bracket]") {
  // 1/2 (q S / sigma^2 - m log q), q = alpha / (gamma^2 + alpha), is least at q = m sigma^2 / S.
  const std::vector<double> beta = {0.3, -1.0, 0.8, 0.1, -0.6, 0.9};
  const double gamma = GENERATE(1e-6, 1.0, 3e4);
  const double lost = GENERATE(1e-9, 1e-4, 0.5, 0.9, 0.99);
  CAPTURE(gamma, lost);
  const FilterFrame frame = equal_gammas(gamma, beta);
  const double noise = frame.scale * std::sqrt(lost * square(beta) / 6.0);
  const AlphaChoice choice = choose_alone(frame, AlphaRule::evidence, noise);
  CHECK_THAT(choice.alpha, WithinRel(gamma * gamma * lost / (1.0 - lost), 1e-9));
  CHECK((choice.verdict == AlphaVerdict::ok) == (lost < 0.1));
}

TEST_CASE("below the bracket the answer stays as it is, above it is nothing", "[alpha][bracket]") {
  const TikhonovFamily family(make_problem(coarse_array, {1.0, 0.45}, {.smoothing_length = 1.0}));
  const FilterFrame frame = family.analyse(random_values(9, 3));
  const std::vector<double> alphas = sweep_alpha(frame).alphas;
  const std::vector<double> least = family.solve(frame, alphas.front());
  CHECK(relative_l2_error(family.solve(frame, 1e-3 * alphas.front()), least) < 1e-10);
  CHECK(std::sqrt(square(family.solve(frame, alphas.back())) / square(least)) < 1e-3);
}

TEST_CASE("nothing is ok where even the largest component is mostly lost", "[alpha][bracket]") {
  std::size_t above = 0;
  for (const auto& [name, problem] : sample_problems()) {
    const TikhonovFamily family(problem);
    const double largest = tactile_net::largest(family.singular_values());
    for (const double noise : {0.1, 0.5, 1.0, 5.0})
      for (const unsigned seed : {1u, 2u, 3u}) {
        const FilterFrame frame = family.analyse(random_values(problem.kernel.rows, seed));
        for (const AlphaSweep::Curve& curve : sweep_alpha(frame, noise).curves) {
          if (curve.choice.alpha < largest * largest / 8.0) continue;
          CAPTURE(name, tactile_net::name(curve.rule), noise, seed);
          CHECK(curve.choice.verdict != AlphaVerdict::ok);
          ++above;
        }
      }
  }
  CHECK(above > 50);
}

TEST_CASE("the end of the bracket is a border, on either side", "[alpha][bracket]") {
  // Smaller than the noise, all of it: the more smoothing the better.
  const std::vector<double> beta = {0.3, -1.0, 0.8, 0.1, -0.6, 0.9};
  const AlphaChoice drowned = choose_alone(equal_gammas(1.0, beta), AlphaRule::evidence, 10.0);
  CHECK(drowned.verdict == AlphaVerdict::border);
  CHECK(drowned.alpha > 1e3);

  // Hardly anything in the weakest component: GCV takes that for the noise.
  FilterFrame rough{.scale = 1.0, .rows = 40};
  for (int i = 0; i < 40; ++i) {
    rough.gamma.push_back(std::pow(10.0, -0.2 * i));
    rough.beta.push_back(i == 39 ? 1e-8 : std::pow(10.0, -0.1 * i));
  }
  const AlphaChoice bare = choose_alone(rough, AlphaRule::gcv);
  CHECK(bare.verdict == AlphaVerdict::border);
  CHECK(bare.alpha < 1e-6 * std::pow(rough.gamma.back(), 2));
}

TEST_CASE("components that outnumber the rows change no choice", "[alpha]") {
  for (const auto& [name, problem] : sample_problems()) {
    const TikhonovFamily family(problem);
    FilterFrame frame = family.analyse(random_values(problem.kernel.rows, 5));
    if (frame.gamma.size() != frame.rows) continue;
    frame.periodogram.reset();  // has no place for more
    FilterFrame wide = frame;
    wide.gamma.insert(wide.gamma.begin(), frame.rows, 0.0);
    wide.gamma.front() = 1e-18 * frame.gamma.front();  // as rounding leaves it
    wide.beta.insert(wide.beta.begin(), frame.rows, 0.0);
    const AlphaSweep narrow = sweep_alpha(frame, 0.1);
    const AlphaSweep swept = sweep_alpha(wide, 0.1);
    for (std::size_t r = 0; r < narrow.curves.size(); ++r) {
      CAPTURE(name, tactile_net::name(narrow.curves[r].rule));
      CHECK_THAT(swept.curves[r].choice.alpha, WithinRel(narrow.curves[r].choice.alpha, 1e-9));
      CHECK(swept.curves[r].choice.verdict == narrow.curves[r].choice.verdict);
    }
  }
}

TEST_CASE("few readings: rules that guess the noise say that they need it, evidence does without",
          "[alpha]") {
  const TikhonovFamily family(make_problem(coarse_array, {1.0, 0.45}, {.smoothing_length = 1.0}));
  const AlphaTables tables(family.singular_values(), 9);
  REQUIRE(tables.cannot_estimate_noise());
  CHECK(default_rule(tables, true) == AlphaRule::evidence);
  CHECK(default_rule(tables, false) == AlphaRule::gml);
  double worst = 0.0;
  double worst_of_rgcv = 0.0;
  for (unsigned k = 0; k < 40; ++k) {
    const std::vector<Contact> contacts = {
        RigidContact{.center = -4.0 + 0.2 * k, .half_width = 1.0 + 0.05 * k}};
    const TractionField truth = sample(contacts, coarse_array);
    std::vector<double> g = sampled_readings(coarse_array, {1.0, 0.45}, truth);
    const double peak = *std::max_element(g.begin(), g.end());
    add_noise(g, 0.01 * peak, k, 0);
    const FilterFrame frame = family.analyse(g);
    const AlphaSweep sweep = sweep_alpha(frame, tables, 0.01 * peak);
    const auto error = [&](double alpha) {
      return relative_l2_error(family.solve(frame, alpha), truth.normal);
    };
    double best = error(sweep.alphas.front());
    for (const double alpha : sweep.alphas) best = std::min(best, error(alpha));
    for (const AlphaSweep::Curve& curve : sweep.curves)
      CHECK((curve.choice.verdict == AlphaVerdict::noise_needed) == !needs_noise(curve.rule));
    CHECK(sweep.choice(AlphaRule::evidence).verdict == AlphaVerdict::ok);
    worst = std::max(worst, error(sweep.choice(AlphaRule::evidence).alpha) / best);
    worst_of_rgcv = std::max(worst_of_rgcv, error(sweep.choice(AlphaRule::rgcv).alpha) / best);
  }
  CHECK(worst < 1.5);
  CHECK(worst_of_rgcv > 3.0);  // or the verdict would warn of nothing

  const TikhonovFamily dense(
      make_problem({41, 0.5, {1.5}, {Quantity::stress_x}}, {1.0, 0.45}, {.smoothing_length = 1.5}));
  const AlphaTables many(dense.singular_values(), 41);
  CHECK_FALSE(many.cannot_estimate_noise());
  CHECK(default_rule(many, true) == AlphaRule::aicc);
  CHECK(default_rule(many, false) == AlphaRule::aicc);
}
