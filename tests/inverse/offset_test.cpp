// A constant in each channel that nobody knows, of lines and of skins.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/identifiability.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/load_windows.hpp"
#include "tactile_net/inverse/long_array_family.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/eigen.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/inverse/solutions.hpp"

using namespace tactile_net;

namespace {

std::vector<double> listed(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

/// The same problem with its offsets known to be 0, and with them to be found.
struct Pair {
  std::string name;
  LinearProblem known;
  LinearProblem unknown;
};

Pair pair_of(const std::string& name, const SensorArray& array, LineProblemOptions options) {
  options.unknown_offsets = false;
  LinearProblem known = make_problem(array, pad, options);
  options.unknown_offsets = true;
  return {name, std::move(known), make_problem(array, pad, options)};
}

Pair pair_of(const std::string& name, const SkinArray& skin, SkinProblemOptions options) {
  LinearProblem known = make_problem(skin, pad, options);
  options.unknown_offsets = true;
  return {name, std::move(known), make_problem(skin, pad, options)};
}

SkinArray lattice(std::size_t side) {
  using enum Quantity;
  return {.rows = side,
          .columns = side,
          .pitch_y = 1.0,
          .pitch_z = 1.0,
          .depths = {2.0},
          .reads = {stress_x, shear_xy, shear_xz}};
}

bool is_skin(const LinearProblem& problem) { return problem.grid.columns > 1; }

SensorArray uneven() {
  using enum Quantity;
  return uneven_array({{.y = -6.0, .depth = 1.2, .reads = {stress_x}},
                       {.y = -3.5, .depth = 1.0, .reads = {stress_x, shear_xy}},
                       {.y = -2.0, .depth = 1.0, .reads = {shear_xy}},
                       {.y = 0.3, .depth = 1.2, .reads = {stress_x, shear_xy}},
                       {.y = 1.9, .depth = 1.0, .reads = {stress_x}},
                       {.y = 4.4, .depth = 1.0, .reads = {stress_x, shear_xy}},
                       {.y = 6.0, .depth = 1.4, .reads = {shear_xy}}});
}

std::vector<Pair> pairs() {
  using enum Quantity;
  const SurfaceOptions grid{.basis = SurfaceBasis::hats};
  return {
      pair_of("dense", {31, 0.5, {1.0}, {stress_x}}, {.smoothing_length = 1.0}),
      pair_of("two quantities, weighted, dead taxels", {31, 0.5, {1.0}, {stress_x, strain_x}},
              {.smoothing_length = 1.0, .channel_rms = {2.0, 0.1}, .dead_taxels = {3, 17}}),
      pair_of("two unknowns, coarse", {9, 2.0, {1.0}, {stress_x, shear_xy}},
              {.unknowns = 2, .smoothing_length = 1.0, .surface = grid}),
      pair_of("uneven, a dead taxel", uneven(),
              {.unknowns = 2, .smoothing_length = 1.0, .dead_taxels = {2}, .surface = grid}),
      pair_of("a skin, in four classes", lattice(5), {}),
      pair_of("a skin, weighted, a dead taxel", lattice(4),
              {.channel_rms = {2.0, 1.0, 0.5}, .dead_taxels = {5}}),
      pair_of("a skin's taxels anywhere",
              uneven_skin({{"a", -1.0, 0.2, 2.0, lattice(1).reads},
                           {"b", 1.1, 0.9, 3.0, {stress_x}},
                           {"c", 2.1, -0.4, 2.0, lattice(1).reads},
                           {"d", 0.3, -2.0, 2.0, lattice(1).reads}}),
              {}),
  };
}

/// W 1 of every channel that is read.
Eigen::MatrixXd constants(const LinearProblem& problem) {
  const auto rows = static_cast<Eigen::Index>(problem.sites.size());
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(problem.sites.back().channel) + 1);
  for (std::size_t i = 0; i < problem.sites.size(); ++i)
    all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(problem.sites[i].channel)) =
        problem.weights[i];
  return all;
}

Eigen::MatrixXd penalty(LinearProblem problem) {
  std::fill(problem.kernel.values.begin(), problem.kernel.values.end(), 0.0);
  return view(normal_matrix(problem, 1.0));
}

/// The unknowns of [W K, W 1; sqrt(alpha) L, 0] by one QR: tractions, then offsets.
std::vector<double> augmented(const LinearProblem& known, double alpha,
                              const std::vector<double>& g) {
  const Eigen::MatrixXd k = view(known.kernel);
  const Eigen::MatrixXd c = constants(known);
  const Eigen::MatrixXd l = penalty(known).llt().matrixU();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(k.rows() + l.rows(), k.cols() + c.cols());
  a.topLeftCorner(k.rows(), k.cols()) = k;
  a.topRightCorner(k.rows(), c.cols()) = c;
  a.bottomLeftCorner(l.rows(), l.cols()) = std::sqrt(alpha) * l;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(a.rows());
  right.head(k.rows()) = view(known.weights).cwiseProduct(view(g));
  return listed(a.colPivHouseholderQr().solve(right));
}

/// g and a constant of its own in each channel.
std::vector<double> moved(const LinearProblem& problem, std::vector<double> g, double size) {
  for (std::size_t i = 0; i < g.size(); ++i)
    g[i] += problem.sites[i].channel == 0 ? size : -0.7 * size;
  return g;
}

}  // namespace

TEST_CASE("with unknown offsets every method solves the least squares that has them as unknowns",
          "[offset][property]") {
  const double alpha = GENERATE(1e-6, 1e-3, 1.0);
  for (const auto& [name, known, unknown] : pairs()) {
    CAPTURE(name, alpha);
    const std::vector<double> g = moved(known, random_values(known.sites.size(), 4), 3.0);
    std::vector<double> expected = augmented(known, alpha, g);
    const std::vector<double> constant(expected.begin() + std::ssize(expected) - 1 -
                                           static_cast<std::ptrdiff_t>(known.sites.back().channel),
                                       expected.end());
    expected.resize(known.kernel.columns);
    CHECK(relative_l2_error(offsets(unknown, g, expected), constant) <= 1e-10);
    const auto agrees = [&](const std::vector<double>& f) {
      CHECK(relative_l2_error(f, expected) <= 1e-10);
    };
    CHECK(offsets(known, g, expected).empty());
    agrees(tikhonov_solve(unknown, alpha, g));
    const TikhonovFamily family(unknown);
    agrees(family.solve(family.analyse(g), alpha));
    agrees(solved(family.reconstruction(alpha), g));
    const Eigen::VectorXd b = view(normal_right_side(unknown, g));
    agrees(listed(view(normal_matrix(unknown, alpha)).llt().solve(b)));
    if (is_skin(known)) continue;
    agrees(solved(tikhonov(unknown, alpha), g));
    agrees(solved(closed_form(unknown, alpha), g));
    agrees(ConstrainedTikhonov(unknown, alpha, {.nonnegative = false}).solve(g).tractions);
  }
}

TEST_CASE("a constant in each channel changes nothing", "[offset][property]") {
  const double sigma = 0.02;
  const double offset = GENERATE(0.3, 50.0);
  for (const auto& [name, known, unknown] : pairs()) {
    CAPTURE(name, offset);
    std::vector<double> pressed(known.kernel.columns);
    for (std::size_t i = 0; i < unknown.grid.count(); ++i)
      pressed[i] = std::exp(-std::pow(unknown.grid.y(i) / 1.5, 2));
    const Eigen::VectorXd rows = view(known.kernel) * view(pressed);
    std::vector<double> g(known.sites.size());
    const std::vector<double> noise = random_values(g.size(), 8);
    for (std::size_t i = 0; i < g.size(); ++i)
      if (known.weights[i] > 0.0)
        g[i] = rows(static_cast<Eigen::Index>(i)) / known.weights[i] + sigma * noise[i];
    const std::vector<double> other = moved(known, g, offset);
    const double rounding = 1e-12 * (1.0 + offset);

    const TikhonovFamily family(unknown);
    const FilterFrame a = family.analyse(g);
    const FilterFrame b = family.analyse(other);
    for (const AlphaRule rule : {AlphaRule::evidence, AlphaRule::aicc, AlphaRule::gml}) {
      if (rule != AlphaRule::evidence && known.taxels < 31)
        continue;  // too few to do without noise
      const double alpha = choose_alone(a, rule, sigma).alpha;
      CHECK_THAT(choose_alone(b, rule, sigma).alpha, WithinRel(alpha, 1e-5));
    }
    const double alpha = 1e-3;
    const std::vector<double> f = tikhonov_solve(unknown, alpha, g);
    CHECK(relative_l2_error(tikhonov_solve(unknown, alpha, other), f) <= 1e3 * rounding);
    const double dof = family.degrees_of_freedom(alpha);
    CHECK_THAT(estimate_noise(unknown, other, f, dof, {}).residual_rms,
               WithinRel(estimate_noise(unknown, g, f, dof, {}).residual_rms, 1e-8));

    CHECK(relative_l2_error(weighted(unknown, other), weighted(unknown, g)) <= 1e3 * rounding);

    DataLimits limits{.noise_rms = sigma};
    if (is_skin(known)) {
      const ConeTikhonov cone(unknown, alpha, {.friction_limit = 0.8});
      const ConeSolution one = cone.solve(g);
      const ConeSolution same = cone.solve(other);
      REQUIRE(one.verdict == ConstrainedVerdict::ok);
      REQUIRE(same.verdict == ConstrainedVerdict::ok);
      CHECK(relative_l2_error(same.tractions, one.tractions) <= 1e-3);
    } else {
      const ConstrainedTikhonov constrained(unknown, alpha, {.nonnegative = true});
      CHECK(relative_l2_error(constrained.solve(other).tractions, constrained.solve(g).tractions) <=
            1e3 * rounding);
      const LoadWindows windows(unknown, 3.5);
      CHECK_THAT(windows.covariance(other, f, alpha, sigma).deviations().front(),
                 WithinRel(windows.covariance(g, f, alpha, sigma).deviations().front(), 1e-6));
      limits.inner = {{-3.0, 3.0}};
    }
    const DataJudge judge(unknown, limits);
    CHECK(judge.judge(g, f).consistent());
    CHECK(judge.judge(other, f).consistent());
    DataMemory memory;  // as without one
    CHECK(judge.judge(g, f, &memory).consistent());
    CHECK(judge.judge(other, f, &memory).consistent());
  }
}

TEST_CASE("an offset takes one independent number a channel", "[offset]") {
  for (const auto& [name, known, unknown] : pairs()) {
    CAPTURE(name);
    const std::size_t channels = known.sites.back().channel + 1;
    CHECK(independent_readings(unknown) + channels == independent_readings(known));
    CHECK((constants(known).transpose() * view(unknown.kernel)).norm() <=
          1e-13 * view(known.kernel).norm() * view(known.weights).maxCoeff());

    // The noise's estimate, which counts them, is not biased.
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    double squares = 0.0;
    constexpr int frames = 600;
    for (int k = 0; k < frames; ++k) {
      std::vector<double> g(known.sites.size());
      for (std::size_t i = 0; i < g.size(); ++i)
        if (known.weights[i] > 0.0) g[i] = normal(generator) / known.weights[i];
      const std::vector<double> none(known.kernel.columns);
      squares += std::pow(estimate_noise(unknown, g, none, 0.0, {}).residual_rms, 2);
    }
    CHECK_THAT(squares / frames, WithinAbs(1.0, 0.05));
  }
}

TEST_CASE("evidence is that of readings whose offsets may be anything", "[offset]") {
  for (const auto& [name, known, unknown] : pairs()) {
    CAPTURE(name);
    if (is_skin(known)) continue;  // so small that its evidence has no least
    const double sigma = 0.3;
    std::vector<double> pressed(known.kernel.columns);
    for (std::size_t i = 0; i < unknown.grid.count(); ++i)
      pressed[i] = 5.0 * std::exp(-std::pow(unknown.grid.y(i) / 1.5, 2));
    const Eigen::VectorXd rows = view(known.kernel) * view(pressed);
    std::vector<double> g(known.sites.size());
    const std::vector<double> noise = random_values(g.size(), 5);
    for (std::size_t i = 0; i < g.size(); ++i)
      if (known.weights[i] > 0.0)
        g[i] = (rows(static_cast<Eigen::Index>(i)) + sigma * noise[i]) / known.weights[i];
    g = moved(known, g, 2.0);

    const Eigen::MatrixXd k = view(known.kernel);
    const Eigen::MatrixXd c = constants(known);
    const Eigen::VectorXd y = view(known.weights).cwiseProduct(view(g)) / sigma;
    const Eigen::MatrixXd shape = k * penalty(known).llt().solve(k.transpose());
    const auto negative_log_evidence = [&](double alpha) {
      const Eigen::MatrixXd covariance =
          Eigen::MatrixXd::Identity(y.size(), y.size()) + shape / alpha + 1e6 * c * c.transpose();
      const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
      return 0.5 * y.dot(llt.solve(y)) +
             llt.matrixL().toDenseMatrix().diagonal().array().log().sum();
    };
    const double alpha =
        choose_alone(TikhonovFamily(unknown).analyse(g), AlphaRule::evidence, sigma).alpha;
    CHECK(negative_log_evidence(1.2 * alpha) > negative_log_evidence(alpha));
    CHECK(negative_log_evidence(alpha / 1.2) > negative_log_evidence(alpha));
  }
}

TEST_CASE("where offsets are unknown the mean may hide, and the band says so", "[offset]") {
  const Pair pair = pair_of("dense", {31, 0.5, {1.0}, {Quantity::stress_x}}, {});
  CHECK(identifiability(pair.known).rank == 31);
  CHECK(identifiability(pair.unknown).rank == 30);
  CHECK(hidden_modes(pair.unknown, TikhonovFamily(pair.unknown)).dimension == 1);

  const std::vector<double> all(31, 0.5);
  const double alpha = 1e-2;
  const auto deviation = [&](const LinearProblem& problem) {
    return TractionCovariance(TikhonovFamily(problem), alpha, alpha).deviation(all);
  };
  CHECK(deviation(pair.unknown) > 2.0 * deviation(pair.known));
}

TEST_CASE("taxels left out later are as if dead from the start", "[offset]") {
  using enum Quantity;
  const std::vector<std::size_t> dead{4, 11};
  const auto check_same = [&](LinearProblem later, const LinearProblem& fresh) {
    leave_out(later, std::vector<std::size_t>{4});
    leave_out(later, dead);
    CHECK(later.weights == fresh.weights);
    CHECK((view(later.kernel) - view(fresh.kernel)).norm() <= 1e-13 * view(fresh.kernel).norm());
    CHECK(relative_l2_error(later.constants.values, fresh.constants.values) <= 1e-13);
    const std::vector<double> g = random_values(fresh.sites.size(), 3);
    const std::vector<double> f = random_values(fresh.kernel.columns, 4);
    CHECK(relative_l2_error(offsets(later, g, f), offsets(fresh, g, f)) <= 1e-12);
  };
  LineProblemOptions of_line{
      .unknowns = 2, .smoothing_length = 1.0, .channel_rms = {2.0, 0.5}, .unknown_offsets = true};
  const SensorArray array{31, 0.5, {1.0}, {stress_x, shear_xy}};
  const LinearProblem line = make_problem(array, pad, of_line);
  of_line.dead_taxels = dead;
  check_same(line, make_problem(array, pad, of_line));
  check_same(make_problem(lattice(4), pad, {.unknown_offsets = true}),
             make_problem(lattice(4), pad, {.dead_taxels = dead, .unknown_offsets = true}));
}

TEST_CASE("offsets that leave nothing, and methods that need them, are refused", "[offset]") {
  const SensorArray three{3, 0.5, {1.0}, {Quantity::stress_x}};
  CHECK_NOTHROW(make_problem(three, pad, {.dead_taxels = {0}, .unknown_offsets = true}));
  CHECK_THROWS_WITH(make_problem(three, pad, {.dead_taxels = {0, 2}, .unknown_offsets = true}),
                    ContainsSubstring("no channel has two living taxels"));
  CHECK_THROWS_WITH(make_problem(lattice(1), pad, {.unknown_offsets = true}),
                    ContainsSubstring("no channel has two living taxels"));
  CHECK(is_measured(lattice(1), {}, false));
  CHECK_FALSE(is_measured(lattice(1), {}, true));
  CHECK(is_measured(lattice(2), std::vector<std::size_t>{0, 1}, true));
  CHECK_FALSE(is_measured(lattice(2), std::vector<std::size_t>{0, 1, 2}, true));
  CHECK_THROWS_WITH(LongArrayFamily(three, pad, {.unknown_offsets = true}),
                    ContainsSubstring("cannot tell an unknown offset"));
}
