// What the readings leave of a load: a mixture that is its model's posterior. How often it is
// right: tests/coverage.
#include "tactile_net/inverse/load_mixture.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "inverse/load_tables.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/load_draws.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/pressed_line.hpp"

using namespace tactile_net;

namespace {

constexpr double certain = std::numeric_limits<double>::infinity();
constexpr std::size_t all_components = std::numeric_limits<std::size_t>::max();

/// The posterior by matrices that are inverted, component by component.
struct DenseModel {
  LinearProblem problem;
  LoadDraws model;

  DenseModel(LinearProblem of, const LoadPriorOptions& with)
      : problem(std::move(of)), model(problem, with) {}

  [[nodiscard]] Eigen::MatrixXd kernel() const { return as_eigen(problem.kernel); }

  struct Found {
    double mean = 0.0, deviation = 0.0, below = 0.0;  // `below`: probability of less than `at`
  };
  /// Of a sum of tractions. @param degrees  nu
  [[nodiscard]] Found of(std::span<const double> weights, std::span<const double> readings,
                         double rms, double degrees, double at) const {
    const Eigen::MatrixXd k = kernel();
    const Eigen::VectorXd g = as_eigen(readings) / rms;
    const Eigen::VectorXd s = as_eigen(weights);
    const auto rows = static_cast<double>(independent_readings(problem));
    const Eigen::Index m = g.size();
    std::vector<double> logs, means, variances;
    const auto add = [&](const Eigen::MatrixXd& c, double log_prior) {
      const Eigen::MatrixXd spread = k * c * k.transpose();
      const Eigen::VectorXd of_sum = k * (c * s);
      const double own = s.dot(c * s);
      for (std::size_t a = 0; a < 40; ++a) {  // beyond, these readings leave nothing
        const double alpha = model.alphas()[a];
        const Eigen::LDLT<Eigen::MatrixXd> factor(spread + alpha * Eigen::MatrixXd::Identity(m, m));
        const double q = alpha * g.dot(factor.solve(g));
        const double log_determinant =
            (factor.vectorD().array() / alpha).log().sum();  // of I + K C K' / alpha
        double log_p = log_prior - 0.5 * log_determinant + model.log_prior_of_alpha(alpha);
        double scale = 1.0;
        if (std::isinf(degrees)) {
          log_p -= 0.5 * q;
        } else {
          log_p -= 0.5 * (rows + degrees) * std::log(degrees + q);
          scale = (degrees + q) / (degrees + rows);
        }
        logs.push_back(log_p);
        means.push_back(rms * of_sum.dot(factor.solve(g)));
        variances.push_back(rms * rms * scale * (own - of_sum.dot(factor.solve(of_sum))) / alpha);
      }
    };
    for (const LoadDraws::Window& window : model.windows())
      for (const auto& [weight, log_prior] : model.weights()) {
        const Eigen::MatrixXd root = model.all_of(window, weight);
        add(root * root.transpose(), window.log_prior + log_prior);
      }
    const double most = *std::max_element(logs.begin(), logs.end());
    double sum = 0.0;
    for (double& one : logs) sum += one = std::exp(one - most);
    double likely = 0.0;
    for (double& one : logs) likely += one = one > 1e-6 * sum ? one : 0.0;
    sum = likely;
    Found found;
    for (std::size_t i = 0; i < logs.size(); ++i) found.mean += logs[i] / sum * means[i];
    const double spread = std::isinf(degrees) ? 1.0 : (rows + degrees) / (rows + degrees - 2.0);
    double square = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      square += logs[i] / sum * (spread * variances[i] + std::pow(means[i] - found.mean, 2));
      const Distribution one(
          std::vector<Distribution::Component>{
              {.mean = means[i], .scale = std::sqrt(variances[i])}},
          std::isinf(degrees) ? degrees : rows + degrees);
      found.below += logs[i] / sum * one.cdf(at);
    }
    found.deviation = std::sqrt(square);
    return found;
  }
};

std::vector<double> weights_of_force(const LinearProblem& problem, std::size_t component = 0) {
  const std::size_t n = problem.grid.count();
  std::vector<double> weights(problem.components * n);
  std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(component * n), n,
              problem.grid.spacing_y);
  return weights;
}

std::vector<double> weights_of_moment(const LinearProblem& problem) {
  std::vector<double> weights = weights_of_force(problem);
  for (std::size_t i = 0; i < problem.grid.count(); ++i) weights[i] *= problem.grid.y(i);
  return weights;
}

}  // namespace

TEST_CASE("the mixture is the posterior of its model, as dense inverses have it",
          "[load_mixture]") {
  const std::size_t unknowns = GENERATE(std::size_t{1}, std::size_t{2});
  const double power = unknowns == 1 ? 0.5 : 0.0;
  const LoadPriorOptions options{
      .depth = 1.0, .narrowest = 6.0, .prior_power = power, .most_components = all_components};
  const DenseModel model(line_of(unknowns), options);
  const LoadPrior prior(model.problem, options);
  CHECK(prior.count() == model.model.windows().size());
  CHECK(model.model.weights().size() == (unknowns == 1 ? 1 : 6));
  const std::vector<double> readings = pressed(unknowns);
  std::vector<std::vector<double>> sums{weights_of_force(model.problem)};
  sums.emplace_back(model.problem.components * model.problem.grid.count());
  sums.back()[20] = 1.0;
  if (unknowns == 2) sums.push_back(weights_of_force(model.problem, 1));
  for (const double degrees : {5.0, certain}) {
    const LoadMixture mixture = prior.given(readings, {.rms = pad_noise, .degrees = degrees});
    const auto found = mixture.of_each(sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      CAPTURE(unknowns, degrees, i);
      const double at = found[i].mean() + 0.7 * found[i].deviation();
      const auto dense = model.of(sums[i], readings, pad_noise, degrees, at);
      CHECK_THAT(found[i].mean(), WithinRel(dense.mean, 1e-9) || WithinAbs(dense.mean, 1e-11));
      CHECK_THAT(found[i].deviation(), WithinRel(dense.deviation, 1e-9));
      CHECK_THAT(found[i].cdf(at), WithinAbs(dense.below, 1e-9));
    }
  }
}

TEST_CASE("what a mixture does not look at is not likely", "[load_mixture]") {
  const std::size_t unknowns = GENERATE(std::size_t{1}, std::size_t{2});
  const LoadPriorOptions options{.depth = 1.0, .narrowest = 3.5, .most_components = all_components};
  const DenseModel model(line_of(unknowns), options);
  const LoadPrior prior(model.problem, options);
  const SensorArray array = array_of(unknowns);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform;
  const std::vector<double> force = weights_of_force(model.problem);
  for (int i = 0; i < 12; ++i) {
    // In the middle, at the end and over it; dragged more or less, or as white as noise.
    const std::vector<Contact> contacts = {
        RigidContact{.center = 9.0 * uniform(engine),
                     .half_width = 0.4 + uniform(engine),
                     .friction = unknowns == 2 ? 2.0 * uniform(engine) * uniform(engine) : 0.0}};
    std::vector<double> readings = exact_readings(array, pad, contacts);
    if (i % 4 == 3) std::fill(readings.begin(), readings.end(), 0.0);
    const double rms = std::array{0.3, 0.01, 3e-3, 1.0}[static_cast<std::size_t>(i % 4)] * 0.1;
    add_noise(readings, rms, 5, static_cast<std::size_t>(i));
    for (const double degrees : {5.0, certain}) {
      CAPTURE(unknowns, i, degrees);
      const Distribution found = prior.given(readings, {.rms = rms, .degrees = degrees}).of(force);
      const double at = found.mean() - found.deviation();
      const auto dense = model.of(force, readings, rms, degrees, at);
      CHECK_THAT(found.mean(), WithinAbs(dense.mean, 1e-9 * found.deviation()));
      CHECK_THAT(found.deviation(), WithinRel(dense.deviation, 1e-9));
      CHECK_THAT(found.cdf(at), WithinAbs(dense.below, 1e-9));
    }
  }
}

TEST_CASE("a skin's mixture is the posterior of squares of cells", "[load_mixture]") {
  const SkinArray skin{.rows = 4,
                       .columns = 3,
                       .pitch_y = 1.0,
                       .pitch_z = 1.2,
                       .depths = {1.0},
                       .reads = {Quantity::stress_x}};
  const LinearProblem problem = make_problem(skin, pad, {.components = 1});
  const LoadPriorOptions options{.depth = 1.0, .narrowest = 2.0, .most_components = all_components};
  const DenseModel model(problem, options);
  const LoadPrior prior(problem, options);
  CHECK(prior.count() == model.model.windows().size());
  CHECK(prior.count() > 4);
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t i = 0; i < readings.size(); ++i)  // of one cell that presses
    readings[i] = 0.1 * problem.kernel(i, problem.grid.count() / 2) + (i % 2 == 0 ? 1e-3 : -1e-3);
  const std::vector<double> force(problem.grid.count(), problem.grid.area());
  const LoadMixture mixture = prior.given(readings, {.rms = pad_noise});
  const Distribution found = mixture.of(force);
  const double at = found.mean() - 0.5 * found.deviation();
  const auto dense = model.of(force, readings, pad_noise, 5.0, at);
  CHECK_THAT(found.mean(), WithinRel(dense.mean, 1e-9));
  CHECK_THAT(found.deviation(), WithinRel(dense.deviation, 1e-9));
  CHECK_THAT(found.cdf(at), WithinAbs(dense.below, 1e-9));
}

namespace {

/// Of three readings a taxel. 0: it mirrors itself along both axes; 1: along none; 2: with unknown
/// offsets; 3: and its axes may be exchanged; 4: only that.
LinearProblem dragged_skin(int kind) {
  const SkinArray skin{.rows = kind < 3 ? std::size_t{4} : std::size_t{3},
                       .columns = 3,
                       .pitch_y = 1.0,
                       .pitch_z = 1.0,
                       .depths = {1.0},
                       .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}};
  SkinProblemOptions given{.components = 3, .grid = {.spacing = 1.0}};
  if (kind == 1 || kind == 4) given.dead_taxels = {0};
  if (kind == 2) given.unknown_offsets = true;
  return make_problem(skin, pad, given);
}

}  // namespace

TEST_CASE("a dragged skin's mixture is its model's, whether windows mirror one another or not",
          "[load_mixture]") {
  const int kind = GENERATE(0, 1, 2, 3, 4);
  const LinearProblem problem = dragged_skin(kind);
  const LoadPriorOptions options{.depth = 1.0, .narrowest = 2.0, .most_components = all_components};
  const DenseModel model(problem, options);
  const LoadPrior::Tables tables(problem, options);
  CHECK(tables.windows.size() == model.model.windows().size());
  CHECK((tables.shapes.size() < tables.windows.size()) == (kind != 1));
  CHECK(tables.reflections.size() ==
        std::array<std::size_t, 5>{4, 1, 4, 8, 2}.at(static_cast<std::size_t>(kind)));
  const LoadPrior prior(problem, options);
  const std::size_t cells = problem.grid.count();
  std::vector<std::vector<double>> sums;
  for (std::size_t u = 0; u < 3; ++u) {
    sums.emplace_back(3 * cells);
    std::fill_n(sums.back().begin() + static_cast<std::ptrdiff_t>(u * cells), cells, 1.0);
  }
  std::mt19937 engine(1);
  std::normal_distribution<double> white;
  // Near either end of both axes, and a frame of noise alone.
  for (const std::size_t corner : {std::size_t{1}, std::size_t{2}, std::size_t{0}}) {
    const double size = corner == 0 ? 0.0 : 1.0;
    const std::size_t row = corner == 1 ? 1 : problem.grid.rows - 2;
    const std::size_t at = row * problem.grid.columns + (corner == 1 ? 3 : 1);
    std::vector<double> readings(problem.kernel.rows);
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i] = size * (problem.kernel(i, at) + 0.3 * problem.kernel(i, cells + at) -
                            0.2 * problem.kernel(i, 2 * cells + at)) +
                    2e-3 * white(engine);
    const LoadMixture mixture = prior.given(readings, {.rms = 2e-3});
    const auto each = mixture.of_tractions();
    const std::vector<double> mean = mixture.mean();
    const std::vector<double> explained = weighted(problem, readings);
    std::vector<std::vector<double>> all = sums;
    for (const std::size_t cell : {at, cells + at, 2 * cells + at}) {
      all.emplace_back(3 * cells);
      all.back()[cell] = 1.0;
    }
    const auto found = mixture.of_each(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CAPTURE(kind, corner, i);
      const double point = found[i].mean() + 0.4 * found[i].deviation();
      const auto dense = model.of(all[i], explained, 2e-3, 5.0, point);
      CHECK_THAT(found[i].mean(), WithinAbs(dense.mean, 1e-9));
      CHECK_THAT(found[i].deviation(), WithinRel(dense.deviation, 1e-9));
      CHECK_THAT(found[i].cdf(point), WithinAbs(dense.below, 1e-9));
      CHECK_THAT(found[i].mean(),
                 WithinAbs(as_eigen(std::span(all[i])).dot(as_eigen(std::span(mean))), 1e-12));
      if (i < 3) continue;
      const Distribution& own = each[(i - 3) * cells + at];
      CHECK_THAT(own.mean(), WithinAbs(dense.mean, 1e-9));
      CHECK_THAT(own.deviation(), WithinRel(dense.deviation, 1e-9));
    }
  }
}

TEST_CASE("a window that is its own image is outlined class by class, by any number of threads",
          "[load_mixture]") {
  const int kind = GENERATE(-1, 0, 1, 2, 3, 4);
  const LinearProblem problem = kind < 0 ? line_of(2) : dragged_skin(kind);
  LoadPriorOptions options{.depth = 1.0, .narrowest = 2.0, .most_components = all_components};
  const LoadPrior::Tables whole(problem, options);
  const LoadPrior::Tables parted(problem, options, 1);
  options.threads = 3;
  const LoadPrior::Tables together(problem, options, 1);
  REQUIRE(parted.entries_count() == whole.entries_count());
  REQUIRE(together.entries_count() == whole.entries_count());
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  bool is_parted = false;
  for (std::size_t i = 0; i < whole.entries_count(); ++i) {
    CAPTURE(kind, i);
    const auto& a = whole.entry(i);
    const auto& b = parted.entry(i);
    const auto& outline = parted.outline(i);
    const LoadPrior::Tables::Shape& shape = parted.shapes[b.shape];
    is_parted = is_parted || outline.classes.size() > 1;
    const double largest = whole.entry(0).gamma(0);
    const Eigen::MatrixXd rotation =  // U'
        outline.rotated(
            shape.range->coordinates(Eigen::MatrixXd::Identity(kernel.rows(), kernel.rows()))
                .within);
    Eigen::MatrixXd bidiagonal = outline.diagonal.asDiagonal();
    bidiagonal.diagonal<1>() = outline.above;
    CHECK((rotation * rotation.transpose()).isIdentity(1e-13));
    const Eigen::MatrixXd seen = rotation.transpose() * bidiagonal;
    CHECK((a.u * a.gamma2.asDiagonal() * a.u.transpose() - seen * seen.transpose()).norm() <
          1e-13 * largest * largest);
    CHECK((a.log_prior - b.log_prior).head(36).cwiseAbs().maxCoeff() < 1e-8);
    CHECK((a.used - b.used).head(36).cwiseAbs().maxCoeff() < 1e-8);
    // K T = U B V', and T T' is all that V shows with what it hides.
    const auto details = parted.details(b);
    const Eigen::MatrixXd own = kernel(Eigen::indexing::all, shape.columns);
    const Eigen::MatrixXd through = parted.sums(b, own.transpose()).transpose();  // K T
    CHECK((through * through.transpose() - seen * seen.transpose()).norm() <
          1e-13 * largest * largest);
    CHECK((own * details->roots - seen).norm() < 1e-12 * largest);
    const Eigen::Index values = own.cols();
    const Eigen::VectorXd squares =
        parted.sums(b, Eigen::MatrixXd::Identity(values, values)).colwise().squaredNorm();
    CHECK(
        (details->roots.rowwise().squaredNorm() + details->hidden - squares).cwiseAbs().maxCoeff() <
        1e-12 * squares.maxCoeff());
    CHECK(together.outline(i).diagonal == outline.diagonal);
    CHECK(together.details(together.entry(i))->roots == details->roots);
    CHECK(together.entry(i).log_prior == b.log_prior);
  }
  CHECK(is_parted == (kind != 1));
}

TEST_CASE(
    "bidiagonal matrices find the same components as singular vectors, and the same means and "
    "variances, in any order of frames",
    "[load_mixture]") {
  const int kind = GENERATE(-1, 0, 1, 2, 3, 4);
  const LinearProblem problem = kind < 0 ? line_of(2) : dragged_skin(kind);
  const LoadPriorOptions options{.depth = 1.0, .narrowest = 2.0, .most_components = all_components};
  const LoadPrior::Tables whole(problem, options);
  const LoadPrior::Tables outlined(problem, options, 1);
  const LoadPrior::Tables backwards(problem, options, 1);
  REQUIRE_FALSE(whole.is_long());
  REQUIRE(outlined.is_long());
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  std::mt19937 engine(7);
  std::normal_distribution<double> white;
  std::vector<Eigen::VectorXd> frames;  // over the noise: of it alone, and of two places that press
  for (const double size : {0.0, 3.0, 30.0, 1e3}) {
    Eigen::VectorXd readings(kernel.rows());
    for (double& one : readings) one = white(engine);
    const auto at = static_cast<Eigen::Index>(problem.grid.count() / 3);
    const double largest = kernel.col(at).cwiseAbs().maxCoeff();
    const Eigen::VectorXd load = kernel.col(at) + 0.4 * kernel.col(kernel.cols() - 2);
    readings += size / largest * load;
    frames.push_back(whole.weighting.projected(readings));
  }
  const auto check = [&](const Eigen::VectorXd& g, double known, const auto& tables) {
    const auto expected = likely_parts(whole, g, known, 0.0);
    const auto found = likely_parts(tables, g, known, 0.0);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].window - tables.windows.data() == expected[i].window - whole.windows.data());
      CHECK(found[i].entry->tangential_weight == expected[i].entry->tangential_weight);
      REQUIRE(found[i].sizes.size() == expected[i].sizes.size());
      for (std::size_t k = 0; k < found[i].sizes.size(); ++k) {
        const auto& a = found[i].sizes[k];
        const auto& b = expected[i].sizes[k];
        CHECK_THAT(a.alpha, WithinRel(b.alpha, 1e-12));
        CHECK_THAT(a.probability, WithinRel(b.probability, 1e-8));
        CHECK_THAT(a.scale2, WithinRel(b.scale2, 1e-9));
      }
      const auto& one = found[i];
      const auto& other = expected[i];
      const auto details = tables.details(*one.entry);
      const auto whole_details = whole.details(*other.entry);
      const Eigen::MatrixXd means = whole_details->roots * whole.filtered(other);
      CHECK((details->roots * tables.filtered(one) - means).cwiseAbs().maxCoeff() <
            1e-9 * means.cwiseAbs().maxCoeff());
      const auto variances = [](const auto& of, const auto& part, const auto& seen) {
        return Eigen::MatrixXd(of.spreads(part, seen) +
                               seen.hidden * part.alphas().cwiseInverse().transpose());
      };
      const Eigen::MatrixXd expected_variances = variances(whole, other, *whole_details);
      CHECK((variances(tables, one, *details) - expected_variances)
                .cwiseQuotient(expected_variances)
                .cwiseAbs()
                .maxCoeff() < 1e-9);
      const Eigen::MatrixXd sums = details->roots.topRows(5);  // few are taken as many are
      CHECK((tables.spreads(one, sums) - tables.spreads(one, details->roots).topRows(5)).norm() <
            1e-13 * tables.spreads(one, sums).norm());
      for (const Eigen::Index k : {Eigen::Index{0}, Eigen::Index{3}})
        CHECK((tables.spreads(one, sums.middleRows(k, 2)).row(0) -
               tables.products(one, sums.row(k), sums.row(k)))
                  .norm() < 1e-13 * tables.spreads(one, sums).norm());
      // With what no reading shows of both.
      const auto covariance = [](const auto& of, const auto& part, const auto& seen) {
        Eigen::MatrixXd both = Eigen::MatrixXd::Zero(seen.roots.rows(), 2);
        both(0, 0) = both(3, 1) = 1.0;
        both = of.sums(*part.entry, both);
        const double hidden =
            both.col(0).dot(both.col(1)) - seen.roots.row(0).dot(seen.roots.row(3));
        return Eigen::RowVectorXd(of.products(part, seen.roots.row(0), seen.roots.row(3)) +
                                  hidden * part.alphas().cwiseInverse().transpose());
      };
      CHECK((covariance(tables, one, *details) - covariance(whole, other, *whole_details))
                .cwiseQuotient(expected_variances.row(0))
                .cwiseAbs()
                .maxCoeff() < 1e-9);
    }
    return found;
  };
  for (const double known : {5.0, certain}) {
    std::vector<std::vector<LoadPrior::Part>> first;
    for (const Eigen::VectorXd& g : frames) first.push_back(check(g, known, outlined));
    for (std::size_t i = frames.size(); i-- > 0;) {
      const auto again = check(frames[i], known, backwards);
      for (std::size_t k = 0; k < again.size(); ++k) {
        CHECK(again[k].beta == first[i][k].beta);
        for (std::size_t a = 0; a < again[k].sizes.size(); ++a)
          CHECK(again[k].sizes[a].probability == first[i][k].sizes[a].probability);
      }
    }
  }
}

TEST_CASE("what answers need is made again where there was no room for it", "[load_mixture]") {
  const LinearProblem problem = line_of(2);
  const LoadPriorOptions options{.depth = 1.0};
  const LoadPrior::Tables whole(problem, options);
  LoadPrior::Tables narrow(problem, options);
  narrow.room = 40'000;
  std::vector<std::shared_ptr<const LoadPrior::Tables::Details>> own;
  for (std::size_t i = 0; i < whole.entries_count(); ++i)
    own.push_back(whole.details(whole.entry(i)));
  CHECK(whole.numbers() > 2 * narrow.room);
  CHECK(whole.details(whole.entry(0)) == own.front());
  std::vector<std::thread> threads;
  std::atomic<std::size_t> same = 0;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = 0; i < own.size(); ++i) {
        const std::size_t at = (i * (t + 1) + t) % own.size();
        const auto made = narrow.details(narrow.entry(at));
        if (made->roots == own[at]->roots && made->hidden == own[at]->hidden) ++same;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(same == 4 * own.size());
  CHECK(narrow.numbers() <= narrow.room);
  // K T = U diag(gamma) V', V'V = 1, and what V leaves of T is hidden.
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  for (std::size_t i = 0; i < own.size(); i += 17) {
    CAPTURE(i);
    const auto& entry = whole.entry(i);
    const Eigen::MatrixXd& v = own[i]->v;
    const Eigen::MatrixXd columns =
        kernel(Eigen::indexing::all, whole.shapes[entry.shape].columns).transpose();
    const Eigen::MatrixXd seen = whole.sums(entry, columns).transpose();
    CHECK((seen - entry.u * entry.gamma.asDiagonal() * v.transpose()).norm() <
          1e-12 * whole.entry(0).gamma(0));
    CHECK((v.transpose() * v - Eigen::MatrixXd::Identity(v.cols(), v.cols())).norm() < 1e-13);
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(v.rows(), v.rows()) - v * v.transpose();
    const Eigen::VectorXd hidden = whole.tractions(entry, rest).rowwise().squaredNorm();
    const Eigen::VectorXd scale = hidden + own[i]->roots.rowwise().squaredNorm() * 1e-12;
    CHECK(((hidden - own[i]->hidden).array().abs() / scale.array()).maxCoeff() < 1e-9);
  }
}

TEST_CASE("sums of the mean tractions are the sums' means", "[load_mixture]") {
  const LinearProblem problem = line_of(2);
  const LoadMixture mixture =
      LoadPrior(problem, {.depth = 1.0}).given(pressed(2), {.rms = pad_noise});
  const std::vector<double> mean = mixture.mean();
  for (const auto& weights :
       {weights_of_force(problem), weights_of_force(problem, 1), weights_of_moment(problem)}) {
    const Distribution known = mixture.of(weights);
    const double sum = as_eigen(std::span(weights)).dot(as_eigen(std::span(mean)));
    CHECK_THAT(known.mean(), WithinAbs(sum, 1e-12));
  }
  const auto each = mixture.of_tractions();
  std::vector<std::vector<double>> single(mean.size(), std::vector<double>(mean.size()));
  for (std::size_t i = 0; i < mean.size(); ++i) single[i][i] = 1.0;
  const LoadSums sums = mixture.sums(single);
  REQUIRE(sums.count() == mean.size());
  for (std::size_t i = 0; i < mean.size(); ++i) {
    CHECK_THAT(each[i].mean(), WithinAbs(mean[i], 1e-12));
    CHECK_THAT(sums.of(i).mean(), WithinAbs(mean[i], 1e-12));
    CHECK_THAT(sums.of(i).deviation(), WithinRel(each[i].deviation(), 1e-9));
    for (const double p : {0.025, 0.5, 0.8})
      CHECK_THAT(sums.of(i).quantile(p),
                 WithinAbs(each[i].quantile(p), 1e-9 * each[i].deviation()));
  }
  const auto force = weights_of_force(problem);
  const auto centre = mixture.ratio(weights_of_moment(problem), force);
  REQUIRE(centre);
  CHECK_THAT(
      centre->mean(),
      WithinRel(mixture.of(weights_of_moment(problem)).mean() / mixture.of(force).mean(), 1e-12));
  CHECK(mixture.degrees_of_freedom() > 2.0);
  CHECK(mixture.degrees_of_freedom() < 18.0);
  CHECK(mixture.student_degrees() == 23.0);
  CHECK(mixture.alpha_quantile(0.25) <= mixture.alpha_quantile(0.75));
}

TEST_CASE("a covariance is that of the sums' distributions, about any tractions",
          "[load_mixture]") {
  const std::size_t unknowns = GENERATE(std::size_t{1}, std::size_t{2});
  const LinearProblem problem = line_of(unknowns);
  const LoadPrior prior(problem, {.depth = 1.0});
  const std::vector<double> loud = pressed(unknowns);
  std::vector<double> quiet(loud.size());
  add_noise(quiet, pad_noise, 3, 0);
  for (const std::vector<double>& readings : {loud, quiet}) {
    const LoadMixture mixture = prior.given(readings, {.rms = pad_noise, .model_share = 0.02});
    std::vector<double> about = mixture.mean();
    about[7] += 0.05;
    const LoadCovariance covariance(mixture, about, 3.0);
    CHECK(covariance.degrees_of_freedom() == mixture.degrees_of_freedom());
    std::vector<std::vector<double>> weights{weights_of_force(problem), weights_of_moment(problem)};
    weights.emplace_back(problem.components * problem.grid.count());
    weights.back()[7] = 1.0;
    if (unknowns == 2) weights.push_back(weights_of_force(problem, 1));
    /// The mean square of the error of a sum.
    const auto square = [&](const std::vector<double>& sum) {
      const Distribution known = mixture.of(sum);
      const double off =
          known.mean() - as_eigen(std::span(sum)).dot(as_eigen(std::span(std::as_const(about))));
      return (std::pow(known.deviation(), 2) + off * off) / 9.0;
    };
    const Matrix all = covariance.covariances(weights);
    const std::vector<double> deviations = covariance.deviations_of(weights);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      CHECK_THAT(std::pow(deviations[i], 2), WithinRel(square(weights[i]), 1e-9));
      CHECK_THAT(covariance.deviation(weights[i]), WithinRel(deviations[i], 1e-12));
      for (std::size_t j = 0; j < weights.size(); ++j) {
        // Cov(a, b) = (V(a + b) - V(a - b)) / 4, of sums as large as each other.
        const double size = deviations[i] / deviations[j];
        std::vector<double> sum = weights[i];
        std::vector<double> difference = sum;
        for (std::size_t k = 0; k < sum.size(); ++k) {
          sum[k] += size * weights[j][k];
          difference[k] -= size * weights[j][k];
        }
        const double scale = deviations[i] * deviations[j];
        const double expected = (square(sum) - square(difference)) / (4.0 * size);
        CAPTURE(unknowns, i, j);
        CHECK_THAT(all(i, j), WithinAbs(expected, 1e-9 * scale));
        CHECK_THAT(covariance.covariance(weights[i], weights[j]),
                   WithinAbs(all(i, j), 1e-12 * scale));
      }
    }
    const std::vector<double> found = covariance.deviations();
    for (std::size_t i = 0; i < found.size(); ++i) {
      std::vector<double> single(found.size());
      single[i] = 1.0;
      CHECK_THAT(found[i], WithinRel(covariance.deviation(single), 1e-9));
    }
    CHECK_THROWS_AS(LoadCovariance(mixture, about, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(LoadCovariance(mixture, readings, 1.0), std::invalid_argument);
    CHECK_THROWS_AS(covariance.deviation(readings), std::invalid_argument);
    CHECK_THROWS_AS(covariance.covariance(about, readings), std::invalid_argument);
  }
}

TEST_CASE("the unit of readings does not matter", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior prior(problem, {.depth = 1.0});
  const auto force = weights_of_force(problem);
  const std::vector<double> readings = pressed(1);
  for (const double unit : {1e6, 1e-9}) {
    std::vector<double> other = readings;
    for (double& one : other) one *= unit;
    for (const bool is_known : {true, false}) {
      LoadNoise noise, of_other;
      if (is_known) {
        noise.rms = pad_noise;
        of_other.rms = pad_noise * unit;
      }
      const Distribution own = prior.given(readings, noise).of(force);
      const Distribution scaled = prior.given(other, of_other).of(force);
      for (const double p : {0.025, 0.5, 0.9})
        CHECK_THAT(scaled.quantile(p), WithinRel(unit * own.quantile(p), 1e-9));
    }
  }
}

TEST_CASE("a mirrored frame has the mirrored answer", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior prior(problem, {.depth = 1.0});
  const std::vector<double> readings = pressed(1);
  const std::vector<double> turned(readings.rbegin(), readings.rend());
  const auto own = prior.given(readings, {.rms = pad_noise}).of_tractions();
  const auto mirrored = prior.given(turned, {.rms = pad_noise}).of_tractions();
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Distribution& other = mirrored[own.size() - 1 - i];
    CHECK_THAT(other.quantile(0.9), WithinAbs(own[i].quantile(0.9), 1e-7));
    CHECK_THAT(other.mean(), WithinAbs(own[i].mean(), 1e-7));
  }
}

TEST_CASE("a noise that is known by few degrees is learnt from the readings", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior prior(problem, {.depth = 1.0});
  const auto force = weights_of_force(problem);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const std::vector<double> readings = pressed(1, 1.3, seed);
    const auto width = [&](const LoadNoise& noise) {
      const CentralInterval band = prior.given(readings, noise).of(force).interval();
      return band.high - band.low;
    };
    // Many degrees are a certain noise.
    const double true_width = width({.rms = pad_noise, .degrees = certain});
    CHECK_THAT(width({.rms = pad_noise, .degrees = 1e9}), WithinRel(true_width, 1e-4));
    // Stated a third as large for certain makes it up to seventeen times as wide, or half.
    const double learnt = width({.rms = pad_noise / 3.0, .degrees = 5.0});
    CHECK(learnt > 0.5 * true_width);
    CHECK(learnt < 1.5 * true_width);
    CHECK(width({}) > 0.0);
  }
}

TEST_CASE("a contact in the middle leaves the ends certain", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior prior(problem, {.depth = 1.0});
  const auto at_end = [&](double centre) {
    return prior.given(pressed(1, centre), {.rms = pad_noise}).of_tractions().back().deviation();
  };
  CHECK(at_end(8.5) > 5.0 * at_end(0.0));
}

TEST_CASE("a mixture takes any frame and no other size", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior prior(problem, {.depth = 1.0});
  const auto force = weights_of_force(problem);
  for (const double size : {0.0, 1e-200, 1e150})
    for (const bool is_known : {true, false}) {
      CAPTURE(size, is_known);
      LoadNoise noise;
      if (is_known) noise.rms = pad_noise;
      const LoadMixture mixture = prior.given(std::vector<double>(9, size), noise);
      CHECK(std::isfinite(mixture.of(force).deviation()));
      CHECK(mixture.of(force).deviation() > 0.0);
    }
  const LoadMixture nothing = prior.given(std::vector<double>(9), {.rms = pad_noise});
  CHECK_FALSE(nothing.ratio(weights_of_moment(problem), force));
  const std::vector<double> bad(9, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(prior.given(bad, {}), std::invalid_argument);
  CHECK_THROWS_AS(prior.given(std::vector<double>(8), {}), std::invalid_argument);
  CHECK_THROWS_AS(prior.given(pressed(1), {.rms = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(prior.given(pressed(1), {.rms = 1.0, .degrees = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(nothing.of(std::vector<double>(3)), std::invalid_argument);
  CHECK_THROWS_AS(nothing.alpha_quantile(1.0), std::invalid_argument);
  CHECK_THROWS_AS(LoadPrior(problem, {.depth = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(LoadPrior(problem, {.depth = 1.0, .narrowest = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(LoadPrior(problem, {.depth = 1.0, .prior_power = -1.0}), std::invalid_argument);
  CHECK_THROWS_AS(LoadPrior(problem, {.depth = 1.0, .most_components = 0}), std::invalid_argument);
}

TEST_CASE("what a formula may be off by is in every sum but not in a ratio of one component's",
          "[load_mixture]") {
  const LinearProblem problem = line_of(2);
  const LoadPrior prior(problem, {.depth = 1.0});
  const std::vector<double> readings = pressed(2);
  const double share = 0.02;
  const LoadMixture plain = prior.given(readings, {.rms = pad_noise});
  const LoadMixture doubted = prior.given(readings, {.rms = pad_noise, .model_share = share});
  CHECK(plain.mean() == doubted.mean());
  CHECK(plain.components() == doubted.components());

  // Each component has a factor of its own: variances of the two add.
  const std::vector<double> normal = weights_of_force(problem);
  const std::vector<double> drag = weights_of_force(problem, 1);
  std::vector<double> both = normal;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += drag[i];
  const double spread = plain.student_degrees() / (plain.student_degrees() - 2.0);
  const auto added = [&](const std::vector<double>& sum) {
    return (std::pow(doubted.of(sum).deviation(), 2) - std::pow(plain.of(sum).deviation(), 2)) /
           (spread * share * share);
  };
  const double force2 = added(normal);
  const double drag2 = added(drag);
  CHECK_THAT(force2, WithinRel(std::pow(plain.of(normal).mean(), 2), 0.01));
  CHECK_THAT(drag2, WithinRel(std::pow(plain.of(drag).mean(), 2), 0.01));
  CHECK_THAT(added(both), WithinRel(force2 + drag2, 1e-9));

  // A factor moves no centre; of two it moves the friction.
  const std::vector<double> moment = weights_of_moment(problem);
  CHECK_THAT(doubted.ratio(moment, normal)->quantile(0.9),
             WithinRel(plain.ratio(moment, normal)->quantile(0.9), 1e-4));
  const Distribution friction = *plain.ratio(drag, normal);
  const double friction2 =
      std::pow(doubted.ratio(drag, normal)->deviation(), 2) - std::pow(friction.deviation(), 2);
  CHECK_THAT(friction2, WithinRel(2.0 * spread * std::pow(share * friction.mean(), 2), 0.05));

  // The covariance has the same.
  const LoadCovariance covariance(doubted, doubted.mean(), pad_noise);
  const std::vector<std::vector<double>> parts{normal, drag};
  const Matrix all = covariance.covariances(parts);
  CHECK_THAT((all(0, 0) + 2.0 * all(0, 1) + all(1, 1)) * pad_noise * pad_noise,
             WithinRel(std::pow(doubted.of(both).deviation(), 2), 1e-9));
  CHECK_THROWS_AS(prior.given(readings, {.rms = pad_noise, .model_share = -0.1}),
                  std::invalid_argument);
}
