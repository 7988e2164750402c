#include "tactile_net/inverse/alpha.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/problems.hpp"

using namespace tactile_net;

namespace {

/// One random frame of one or two cylinders with noise.
struct RandomContact {
  std::vector<double> truth, readings;
  double noise;
};

class RandomContacts {
 public:
  RandomContacts(SensorArray array, Material material, unsigned seed)
      : array_(std::move(array)), material_(material), generator_(seed) {}

  RandomContact next() {
    std::vector<Contact> contacts;
    for (int left = uniform(0.0, 1.0) < 0.5 ? 1 : 2; left > 0; --left)
      contacts.push_back(RigidContact{.center = uniform(-6.0, 6.0),
                                      .half_width = uniform(0.5, 3.5),
                                      .force = uniform(0.3, 1.3)});
    const TractionField field = sample(contacts, array_);
    RandomContact frame{field.normal, sampled_readings(array_, material_, field), 0.0};
    double peak = 0.0;
    for (const double reading : frame.readings) peak = std::max(peak, std::abs(reading));
    frame.noise = peak * 0.001 * std::pow(50.0, uniform(0.0, 1.0));
    add_noise(frame.readings, frame.noise, generator_(), 0);
    return frame;
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  SensorArray array_;
  Material material_;
  std::mt19937 generator_;
};

SensorArray array_of(Quantity quantity) { return {81, 0.25, {1.5}, {quantity}}; }

FilterFrame frame_of(const LinearProblem& problem, const std::vector<double>& readings) {
  return TikhonovFamily(problem).analyse(readings);
}

double percentile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
}

}  // namespace

TEST_CASE("rules come near the best alpha on contacts nobody chose, or say that they do not",
          "[alpha]") {
  const Material pad{1.0, 0.45};
  std::vector<std::vector<double>> ratios(alpha_rules.size());
  std::vector<double> caught;  // of gcv, what its verdict lets pass
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    const LinearProblem problem = make_problem(array_of(quantity), pad, {.smoothing_length = 1.0});
    const TikhonovFamily family(problem);
    RandomContacts contacts(array_of(quantity), pad, 11);
    for (int i = 0; i < 60; ++i) {
      const RandomContact contact = contacts.next();
      const FilterFrame frame = family.analyse(contact.readings);
      const AlphaSweep sweep = sweep_alpha(frame, contact.noise);
      const auto error = [&](double alpha) {
        return relative_l2_error(family.solve(frame, alpha), contact.truth);
      };
      double best = error(sweep.alphas.front());
      for (const double alpha : sweep.alphas) best = std::min(best, error(alpha));
      for (std::size_t r = 0; r < sweep.curves.size(); ++r) {
        const AlphaChoice& choice = sweep.curves[r].choice;
        ratios[r].push_back(error(choice.alpha) / best);
        if (choice.rule == AlphaRule::gcv && choice.verdict == AlphaVerdict::ok)
          caught.push_back(ratios[r].back());
        if (choice.rule == AlphaRule::l_curve && ratios[r].back() > 3.0)
          CHECK(choice.verdict != AlphaVerdict::ok);
      }
    }
  }
  CHECK(percentile(ratios[0], 0.95) <= 1.2);  // rgcv
  CHECK(percentile(ratios[0], 1.0) <= 1.5);
  CHECK(percentile(ratios[1], 0.5) <= 1.05);   // gcv
  CHECK(percentile(ratios[2], 0.95) <= 1.35);  // discrepancy
  CHECK(percentile(ratios[4], 0.95) <= 1.35);  // ncp
  CHECK(percentile(ratios[6], 1.0) <= 2.5);    // evidence
  CHECK(percentile(ratios[7], 0.95) <= 1.2);   // aicc
  CHECK(percentile(ratios[7], 1.0) <= 2.5);
  CHECK(percentile(caught, 1.0) <= 3.0);
}

TEST_CASE("rules find the least of what they are defined by", "[alpha]") {
  // From P itself, between the 200 values: a change of 1 % in alpha is worse on either side.
  const Material pad{1.0, 0.45};
  const LinearProblem problem =
      make_problem({31, 0.5, {1.5}, {Quantity::stress_x}}, pad, {.smoothing_length = 1.0});
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.5}};
  std::vector<double> g =
      sampled_readings({31, 0.5, {1.5}, {Quantity::stress_x}}, pad,
                       sample(contacts, {31, 0.5, {1.5}, {Quantity::stress_x}}));
  const double noise = 3e-3;
  add_noise(g, noise, 2, 3);  // a frame in which gcv has a least too
  const Eigen::MatrixXd k = view(problem.kernel);
  const auto readings = view(g);
  const auto criterion = [&](AlphaRule rule, double alpha) {
    const Matrix p = normal_matrix(problem, alpha);
    const Eigen::MatrixXd h = k * view(p).llt().solve(k.transpose());
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(31, 31) - h;
    if (rule == AlphaRule::gml)
      return readings.dot(left * readings) / std::pow(left.determinant(), 1.0 / 31.0);
    if (rule == AlphaRule::evidence)
      return 0.5 * (readings.dot(left * readings) / (noise * noise) - std::log(left.determinant()));
    if (rule == AlphaRule::aicc)
      return std::log((left * readings).squaredNorm() / 31.0) + 1.0 +
             2.0 * (h.trace() + 1.0) / (31.0 - h.trace() - 2.0);
    const double gcv = (left * readings).squaredNorm() / std::pow(left.trace(), 2);
    return rule == AlphaRule::gcv ? gcv : gcv * (0.1 + 0.9 * (h * h).trace() / 31.0);
  };
  const FilterFrame frame = frame_of(problem, g);
  for (const AlphaRule rule :
       {AlphaRule::rgcv, AlphaRule::gcv, AlphaRule::gml, AlphaRule::evidence, AlphaRule::aicc}) {
    const auto [same_rule, alpha, verdict] = choose_alpha(frame, rule, noise);
    CAPTURE(name(rule), alpha);
    REQUIRE(verdict != AlphaVerdict::border);
    CHECK(criterion(rule, alpha) < criterion(rule, 1.01 * alpha));
    CHECK(criterion(rule, alpha) < criterion(rule, alpha / 1.01));
  }
}

TEST_CASE("the answer is the same in any units", "[alpha][property]") {
  // Lengths in millimetres, another modulus, readings in other units: alpha changes, f / E does
  // not.
  const auto [length, modulus] =
      GENERATE(std::pair(1e-3, 1.0), std::pair(1.0, 1e6), std::pair(25.4, 1e-12));
  const auto solve = [](double unit, double e, AlphaRule rule) {
    const SensorArray array{41, 0.5 * unit, {1.5 * unit}, {Quantity::strain_x}};
    const Material pad{e, 0.45};
    const std::vector<Contact> contacts = {
        RigidContact{.center = unit, .half_width = 3.0 * unit, .force = 0.1 * e * unit}};
    std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));
    add_noise(g, 3e-4, 7, 0);
    const LinearProblem problem = make_problem(array, pad, {.smoothing_length = unit});
    const TikhonovFamily family(problem);
    const FilterFrame frame = family.analyse(g);
    std::vector<double> f = family.solve(frame, choose_alpha(frame, rule, 3e-4).alpha);
    for (double& value : f) value /= e;
    return f;
  };
  for (const AlphaRule rule : alpha_rules) {
    CAPTURE(name(rule), length, modulus);
    CHECK(relative_l2_error(solve(length, modulus, rule), solve(1.0, 1.0, rule)) < 1e-10);
  }
}

TEST_CASE("the discrepancy's residual is as large as the noise", "[alpha]") {
  const Material pad{1.0, 0.45};
  const LinearProblem problem =
      make_problem(array_of(Quantity::stress_x), pad, {.smoothing_length = 1.0});
  const TikhonovFamily family(problem);
  const RandomContact contact = RandomContacts(array_of(Quantity::stress_x), pad, 5).next();
  const FilterFrame frame = family.analyse(contact.readings);
  const AlphaChoice choice = choose_alpha(frame, AlphaRule::discrepancy, contact.noise);
  REQUIRE(choice.verdict == AlphaVerdict::ok);
  const std::vector<double> f = family.solve(frame, choice.alpha);
  std::vector<double> back(81);
  for (std::size_t i = 0; i < 81; ++i)
    for (std::size_t j = 0; j < 81; ++j) back[i] += problem.kernel(i, j) * f[j];
  double residual = 0.0;
  for (std::size_t i = 0; i < 81; ++i) residual += std::pow(back[i] - contact.readings[i], 2);
  CHECK_THAT(std::sqrt(residual), WithinRel(1.01 * contact.noise * 9.0, 1e-10));
}

TEST_CASE("no rule answers without a signal, or beyond its bracket, in silence", "[alpha]") {
  const LinearProblem problem =
      make_problem(array_of(Quantity::stress_x), {1.0, 0.45}, {.smoothing_length = 1.0});
  const FilterFrame silent = frame_of(problem, std::vector<double>(81));
  for (const AlphaSweep::Curve& curve : sweep_alpha(silent, 1e-3).curves)
    CHECK(curve.choice.verdict == AlphaVerdict::no_root);

  const std::vector<double> noise = random_values(81, 9);
  CHECK(choose_alpha(frame_of(problem, noise), AlphaRule::discrepancy, 1e3).verdict ==
        AlphaVerdict::no_root);
  CHECK(choose_alpha(frame_of(problem, noise), AlphaRule::discrepancy, 0.0).verdict ==
        AlphaVerdict::no_root);
  CHECK_THROWS_AS(choose_alpha(frame_of(problem, noise), AlphaRule::discrepancy),
                  std::invalid_argument);
}

TEST_CASE("readings without noise are smoothed by what rounding asks for", "[alpha]") {
  const LinearProblem problem =
      make_problem(array_of(Quantity::stress_x), {1.0, 0.45}, {.smoothing_length = 1.0});
  std::vector<double> f(81);
  for (std::size_t i = 30; i < 50; ++i) f[i] = 1.0;
  const TikhonovFamily family(problem);
  const FilterFrame clean =
      family.analyse(sampled_readings(array_of(Quantity::stress_x), {1.0, 0.45}, {f, {}}));
  for (const AlphaRule rule : {AlphaRule::rgcv, AlphaRule::gml, AlphaRule::aicc}) {
    CAPTURE(name(rule));
    CHECK(relative_l2_error(family.solve(clean, choose_alone(clean, rule).alpha), f) < 0.1);
  }
}

TEST_CASE("denormal and huge readings get the alpha of ordinary ones", "[alpha]") {
  const Material pad{1.0, 0.45};
  const LinearProblem problem =
      make_problem(array_of(Quantity::stress_x), pad, {.smoothing_length = 1.0});
  const RandomContact contact = RandomContacts(array_of(Quantity::stress_x), pad, 6).next();
  const double alpha = choose_alpha(frame_of(problem, contact.readings), AlphaRule::rgcv).alpha;
  for (const double scale : {1e-150, 1e150, 1e-300}) {
    std::vector<double> scaled = contact.readings;
    for (double& reading : scaled) reading *= scale;
    CHECK_THAT(choose_alpha(frame_of(problem, scaled), AlphaRule::rgcv).alpha,
               WithinRel(alpha, 1e-9));
  }
}

TEST_CASE("tables made once serve every frame of a family, and no other's", "[alpha]") {
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const TikhonovFamily family(problem);
    const FilterFrame first = family.analyse(random_values(problem.kernel.rows, 3));
    const AlphaTables tables(first.gamma, first.rows);
    for (const unsigned seed : {4u, 5u}) {
      const FilterFrame frame = family.analyse(random_values(problem.kernel.rows, seed));
      const AlphaSweep alone = sweep_alpha(frame, 0.1);
      const AlphaSweep shared = sweep_alpha(frame, tables, 0.1);
      CHECK(shared.alphas == alone.alphas);
      for (const AlphaRule rule : alpha_rules) {
        CHECK(shared.choice(rule).alpha == alone.choice(rule).alpha);
        CHECK(shared.choice(rule).verdict == alone.choice(rule).verdict);
      }
      CHECK(choose_alone(frame, tables, AlphaRule::gml).alpha ==
            choose_alone(frame, AlphaRule::gml).alpha);
    }
    FilterFrame other = first;
    other.gamma.front() *= 2.0;
    CHECK_THROWS_AS(sweep_alpha(other, tables), std::invalid_argument);
    other = first;
    ++other.rows;
    CHECK_THROWS_AS(sweep_alpha(other, tables), std::invalid_argument);
  }
}

TEST_CASE("what a rule minimises has the slope that its root is sought of", "[alpha]") {
  // The refined alpha is a stationary point: one of the 200 values beside it is less than both of
  // its own neighbours.
  for (const auto& [name, problem] : sample_problems()) {
    const FilterFrame frame = frame_of(problem, random_values(problem.kernel.rows, 8));
    const AlphaSweep sweep = sweep_alpha(frame, 0.1);
    for (const AlphaSweep::Curve& curve : sweep.curves) {
      if (curve.rule == AlphaRule::discrepancy || curve.choice.verdict == AlphaVerdict::border ||
          curve.choice.verdict == AlphaVerdict::no_root)
        continue;
      CAPTURE(name, tactile_net::name(curve.rule));
      if (curve.choice.verdict == AlphaVerdict::noise_needed &&
          (curve.choice.alpha == sweep.alphas.front() || curve.choice.alpha == sweep.alphas.back()))
        continue;  // a border too
      const auto above =
          std::upper_bound(sweep.alphas.begin(), sweep.alphas.end(), curve.choice.alpha);
      const auto at = static_cast<std::size_t>(above - sweep.alphas.begin());
      REQUIRE(at > 1);
      REQUIRE(at + 1 < sweep.alphas.size());
      const auto dips = [&](std::size_t i) {
        return curve.values[i] <= curve.values[i - 1] && curve.values[i] <= curve.values[i + 1];
      };
      CHECK((dips(at - 1) || dips(at)));
    }
  }
}

TEST_CASE("powers of several residuals are those of each alone", "[alpha]") {
  for (const auto& [name, problem] : sample_problems()) {
    CAPTURE(name);
    const FilterFrame frame = frame_of(problem, random_values(problem.kernel.rows, 9));
    const std::size_t n = frame.beta.size();
    const std::size_t bins = frame.periodogram->size();
    const std::vector<double> left = random_values(3 * n, 10);
    std::vector<double> together(3 * bins);
    frame.periodogram->powers(left, n, together);
    std::vector<double> alone(3 * bins);
    frame.periodogram->ResidualPeriodogram::powers(left, n, alone);
    CHECK(relative_l2_error(together, alone) < 1e-14);
  }
}
