// An array in sections is the array itself: where both can be asked, they agree.
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/long_array_covariance.hpp"
#include "tactile_net/inverse/long_array_family.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;
using enum Quantity;

namespace {

struct Case {
  std::string name;
  SensorArray array;
  LineProblemOptions options;
  std::size_t sections;  // at least
};

/// Long enough for sections, with few enough rows for one decomposition.
std::vector<Case> cases() {
  const SurfaceOptions hats{.basis = SurfaceBasis::hats};
  return {
      {"coarse", {80, 3.0, {1.5}, {stress_x}}, {.smoothing_length = 1.5, .surface = hats}, 4},
      {"coarse, dead taxels, at an end too",
       {80, 3.0, {1.5}, {stress_x}},
       {.smoothing_length = 1.5, .dead_taxels = {0, 31, 40, 41}, .surface = hats},
       4},
      {"both tractions, weighted, a dead taxel",
       {70, 1.5, {1.5}, {stress_x, shear_xy}},
       {.unknowns = 2,
        .smoothing_length = 1.5,
        .channel_rms = {2e-3, 1e-3},
        .dead_taxels = {29},
        .surface = hats},
       2},
      {"a strain in a layer",
       {120, 1.5, {1.0}, {strain_x}},
       {.smoothing_length = 1.0, .dead_taxels = {70}, .surface = hats},
       2},
  };
}

Material material_of(const Case& one) {
  Material material = pad;
  if (one.array.reads[0] == strain_x) material.layer = Layer{2.0, Base::bonded};
  return material;
}

std::vector<double> readings_of(const Case& one) {
  const std::vector<Contact> contacts = {
      RigidContact{.center = 1.0, .half_width = 4.0},
      RigidContact{.center = 0.4 * one.array.pitch * static_cast<double>(one.array.count),
                   .half_width = 6.0}};
  std::vector<double> g =
      sampled_readings(one.array, material_of(one), sample(contacts, one.array));
  add_noise(g, pad_noise, 3, 0);
  for (const std::size_t taxel : one.options.dead_taxels)
    for (std::size_t row = taxel; row < g.size(); row += one.array.count) g[row] = 0.0;
  return g;
}

double rms_of(const Case& one) { return one.options.channel_rms.empty() ? pad_noise : 1.0; }

}  // namespace

TEST_CASE("a short array is one section: nothing is approximated", "[long_array]") {
  const SensorArray array{41, 0.5, {1.5}, {stress_x}};
  const LineProblemOptions options{.smoothing_length = 1.5, .dead_taxels = {7}};
  const LongArrayFamily sections(array, pad, options);
  REQUIRE(sections.sections() == 1);
  const TikhonovFamily whole(make_problem(array, pad, options));
  const std::vector<double> g = random_values(41, 2);
  const AlphaSweep a = sweep_alpha(sections.analyse(g), 0.1);
  const AlphaSweep b = sweep_alpha(whole.analyse(g), 0.1);
  REQUIRE(a.curves.size() == alpha_rules.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    CAPTURE(name(a.curves[i].rule));
    CHECK_THAT(a.curves[i].choice.alpha, WithinRel(b.curves[i].choice.alpha, 1e-6));
    CHECK(a.curves[i].choice.verdict == b.curves[i].choice.verdict);
  }
}

TEST_CASE("rules choose the same alpha by sections as by the whole", "[long_array]") {
  for (const Case& one : cases()) {
    CAPTURE(one.name);
    const Material material = material_of(one);
    const LongArrayFamily sections(one.array, material, one.options);
    CHECK(sections.sections() >= one.sections);
    const TikhonovFamily whole(make_problem(one.array, material, one.options));
    const std::vector<double> g = readings_of(one);
    const FilterFrame frame = sections.analyse(g);
    const AlphaSweep a = sweep_alpha(frame, rms_of(one));
    const AlphaSweep b = sweep_alpha(whole.analyse(g), rms_of(one));
    REQUIRE(a.curves.size() == b.curves.size());
    for (std::size_t i = 0; i < a.curves.size(); ++i) {
      const AlphaRule rule = a.curves[i].rule;
      CAPTURE(name(rule));
      if (rule == AlphaRule::ncp) continue;  // by Welch's periodogram, another estimate
      if (b.curves[i].choice.verdict == AlphaVerdict::noise_needed) continue;  // it means nothing
      CHECK_THAT(a.curves[i].choice.alpha, WithinRel(b.curves[i].choice.alpha, 3e-4));
      CHECK(a.curves[i].choice.verdict == b.curves[i].choice.verdict);
    }
  }
}

TEST_CASE("sections count every living reading once", "[long_array]") {
  for (const Case& one : cases()) {
    CAPTURE(one.name);
    const LongArrayFamily sections(one.array, material_of(one), one.options);
    const std::vector<double> g = readings_of(one);
    const FilterFrame frame = sections.analyse(g);
    const std::size_t channels = channel_count(one.array);
    CHECK(frame.rows == channels * (one.array.count - one.options.dead_taxels.size()));
    CHECK_THAT(std::accumulate(frame.shares.begin(), frame.shares.end(), 0.0),
               WithinRel(static_cast<double>(frame.rows), 1e-9));
    // At so large an alpha that nothing is kept all of the frame is left.
    double all = frame.outside * frame.outside;
    for (const double power : frame.powers) all += power;
    double size = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const std::size_t channel = i / one.array.count;
      const double rms = one.options.channel_rms.empty() ? 1.0 : one.options.channel_rms[channel];
      size += std::pow(g[i] / rms / frame.scale, 2);
    }
    CHECK_THAT(all, WithinRel(size, 1e-12));
  }
}

TEST_CASE("whatever a dead taxel reads changes nothing", "[long_array]") {
  const Case one = cases()[1];
  const LongArrayFamily sections(one.array, pad, one.options);
  const std::vector<double> g = readings_of(one);
  std::vector<double> other = g;
  for (const std::size_t taxel : one.options.dead_taxels) other[taxel] = 1e3;
  const FilterFrame a = sections.analyse(g);
  const FilterFrame b = sections.analyse(other);
  CHECK(a.powers == b.powers);
  CHECK(a.beta == b.beta);
  CHECK(a.scale == b.scale);
}

TEST_CASE("bands, force and degrees of freedom are those of the whole", "[long_array]") {
  for (const Case& one : cases()) {
    CAPTURE(one.name);
    const Material material = material_of(one);
    const LinearProblem problem = make_problem(one.array, material, one.options);
    const TikhonovFamily whole(problem);
    const std::vector<double> g = readings_of(one);
    const FilterFrame frame = whole.analyse(g);
    const double alpha = choose_alone(frame, AlphaRule::discrepancy, rms_of(one)).alpha;
    const double prior = choose_alone(frame, AlphaRule::evidence, rms_of(one)).alpha;
    const TractionCovariance expected(whole, alpha, prior);
    const LongArrayFamily sections(one.array, material, one.options);
    FftTikhonov products(one.array, material, one.options, 1.0);
    const LongArrayCovariance covariance(sections, products, alpha, prior);
    const std::vector<double> a = covariance.deviations();
    const std::vector<double> b = expected.deviations();
    REQUIRE(a.size() == b.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] / b[i] - 1.0));
    CHECK(worst < 1e-4);
    CHECK_THAT(covariance.degrees_of_freedom(), WithinRel(expected.degrees_of_freedom(), 1e-5));
    const std::vector<double> f = whole.solve(frame, alpha);
    const UncertainResultant x = resultant_of(problem, f, covariance, pad_noise);
    const UncertainResultant y = resultant_of(problem, f, expected, pad_noise);
    for (std::size_t i = 0; i < 9; ++i) {
      const double size = std::sqrt(y.covariance[i / 3 * 4] * y.covariance[i % 3 * 4]);
      CHECK_THAT(x.covariance[i], WithinAbs(y.covariance[i], 1e-6 * size));
    }
    CHECK_THAT(x.normal.deviation, WithinRel(y.normal.deviation, 1e-6));
    REQUIRE(x.centre);
    CHECK_THAT(x.centre->deviation, WithinRel(y.centre->deviation, 1e-6));
  }
}

TEST_CASE("the residual by FFT is the residual", "[long_array]") {
  for (const Case& one : cases()) {
    CAPTURE(one.name);
    const Material material = material_of(one);
    const LinearProblem problem = make_problem(one.array, material, one.options);
    FftTikhonov products(one.array, material, one.options, 0.7);
    const std::vector<double> g = readings_of(one);
    const std::vector<double> f = random_values(problem.kernel.columns, 4);
    double sum = 0.0;
    for (std::size_t i = 0; i < g.size(); ++i) {
      const std::span<const double> row = problem.kernel.row(i);
      sum += std::pow(
          std::inner_product(row.begin(), row.end(), f.begin(), -problem.weights[i] * g[i]), 2);
    }
    CHECK_THAT(products.residual(g, f), WithinRel(std::sqrt(sum), 1e-10));
  }
}

TEST_CASE("sections refuse what they cannot take", "[long_array]") {
  const Case one = cases()[0];
  const LongArrayFamily sections(one.array, pad, one.options);
  CHECK_THROWS_AS(sections.analyse(std::vector<double>(79)), std::invalid_argument);
  std::vector<double> bad(80);
  bad[3] = NAN;
  CHECK_THROWS_AS(sections.analyse(bad), std::invalid_argument);
  CHECK_THROWS_AS(sections.deviations(0.0, 1.0), std::invalid_argument);
  LineProblemOptions blind = one.options;
  for (std::size_t i = 0; i < 80; ++i) blind.dead_taxels.push_back(i);
  CHECK_THROWS_AS(LongArrayFamily(one.array, pad, blind), std::invalid_argument);
}
