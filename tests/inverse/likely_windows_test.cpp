// Which windows, or components, answer for a frame that makes more of them likely than may answer.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "inverse/load_tables.hpp"
#include "tactile_net/skin/problem.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/pads.hpp"
#include "tests/inverse/pressed_line.hpp"

using namespace tactile_net;

namespace {

LinearProblem skin_of_144() {
  const SkinArray skin{.rows = 12,
                       .columns = 12,
                       .pitch_y = 1.0,
                       .pitch_z = 1.0,
                       .depths = {1.0},
                       .reads = {Quantity::stress_x}};
  return make_problem(skin, pad, {.components = 1});
}

/// What of a frame's probability is in windows that hold each cell, and the mean of log2 alpha.
struct Covered {
  explicit Covered(const std::vector<LoadPrior::Part>& parts, std::size_t cells) : holds(cells) {
    for (const LoadPrior::Part& part : parts)
      for (const LoadPrior::Part::Size& size : part.sizes) {
        all += size.probability;
        alpha += size.probability * std::log2(size.alpha);
        for (const Eigen::Index cell : part.window->columns)
          holds[static_cast<std::size_t>(cell)] += size.probability;
      }
  }
  double all = 0.0, alpha = 0.0;
  std::vector<double> holds;
};

double probability(const LoadPrior::Part& part) {
  double sum = 0.0;
  for (const LoadPrior::Part::Size& size : part.sizes) sum += size.probability;
  return sum;
}

}  // namespace

TEST_CASE("few windows stand for all that a frame of noise makes likely", "[load_mixture]") {
  const LinearProblem problem = skin_of_144();
  const LoadPrior::Tables tables(problem, {.depth = 1.0, .narrowest = 3.5});
  REQUIRE(tables.is_long());
  std::mt19937 engine(3);
  std::normal_distribution<double> white;
  Eigen::VectorXd readings(144);
  for (double& one : readings) one = white(engine);
  const Eigen::VectorXd g = tables.weighting.projected(readings);
  const auto likely = likely_parts(tables, g, 5.0, 0.0);
  const std::size_t most = GENERATE(std::size_t{64}, std::size_t{24});
  REQUIRE(likely.size() > 2 * most);
  const auto few = likely_parts(tables, g, 5.0, 0.0, most);
  CHECK(few.size() <= most);
  CHECK(4 * few.size() > 3 * most);  // of one that stands for two there is one less
  const Covered whole(likely, problem.grid.count());
  const Covered some(few, problem.grid.count());
  CHECK_THAT(some.all, WithinAbs(1.0, 1e-12));
  CHECK_THAT(some.alpha, WithinAbs(whole.alpha, 0.2));
  double squares = 0.0;
  for (std::size_t cell = 0; cell < whole.holds.size(); ++cell)
    squares += std::pow(some.holds[cell] - whole.holds[cell], 2);
  // Drawn blindly: sqrt(p (1 - p) / most).
  CHECK(std::sqrt(squares / static_cast<double>(whole.holds.size())) <
        0.4 / std::sqrt(static_cast<double>(most)));
  // The likeliest, if it is above what each of the others stands for, is as it was.
  const auto largest = [](const auto& parts) {
    return *std::max_element(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
      return probability(a) < probability(b);
    });
  };
  const double each =
      probability(*std::min_element(few.begin(), few.end(), [](const auto& a, const auto& b) {
        return probability(a) < probability(b);
      }));
  CHECK(probability(largest(likely)) > each);
  CHECK(largest(few).window == largest(likely).window);
  CHECK_THAT(probability(largest(few)), WithinAbs(probability(largest(likely)), 1e-12));
}

TEST_CASE("all windows that a contact makes likely answer", "[load_mixture]") {
  const LinearProblem problem = skin_of_144();
  const LoadPrior::Tables tables(problem, {.depth = 1.0, .narrowest = 3.5});
  const auto cell = static_cast<Eigen::Index>(problem.grid.count() / 2 + 3);
  const Eigen::VectorXd pressed = as_eigen(problem.kernel).col(cell);
  const Eigen::VectorXd g =
      tables.weighting.projected(Eigen::VectorXd(pressed * 300.0 / pressed.cwiseAbs().maxCoeff()));
  const auto likely = likely_parts(tables, g, 5.0, 0.0);
  const auto few = likely_parts(tables, g, 5.0, 0.0, LoadPrior::Tables::most_windows);
  REQUIRE(few.size() == likely.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    CHECK(few[i].window == likely[i].window);
    CHECK_THAT(probability(few[i]), WithinAbs(probability(likely[i]), 1e-14));
  }
}

TEST_CASE("few components of a line say what all of them say", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPriorOptions of_all{.depth = 1.0,
                                .most_components = std::numeric_limits<std::size_t>::max()};
  const LoadPrior all(problem, of_all);
  const LoadPrior few(problem, {.depth = 1.0});
  const std::vector<double> readings = pressed(1);
  const LoadMixture whole = all.given(readings, {.rms = pad_noise});
  const LoadMixture some = few.given(readings, {.rms = pad_noise});
  REQUIRE(whole.components() > 2 * LoadPriorOptions{}.most_components);
  CHECK(some.components() <= LoadPriorOptions{}.most_components);
  CHECK(3 * some.components() > 2 * LoadPriorOptions{}.most_components);

  const std::vector<double> of_force(problem.grid.count(), problem.grid.spacing_y);
  const Distribution force = whole.of(of_force);
  const double deviation = force.deviation();
  CHECK_THAT(some.of(of_force).mean(), WithinAbs(force.mean(), 0.1 * deviation));
  CHECK_THAT(some.of(of_force).deviation(), WithinRel(deviation, 0.1));
  const CentralInterval band = force.interval();
  CHECK_THAT(some.of(of_force).interval().low, WithinAbs(band.low, 0.25 * deviation));
  CHECK_THAT(some.of(of_force).interval().high, WithinAbs(band.high, 0.25 * deviation));
}

TEST_CASE("of a line's frame of noise one component of eight answers", "[load_mixture]") {
  const LinearProblem problem = line_of(1);
  const LoadPrior::Tables tables(problem, {.depth = 1.0});
  REQUIRE(!tables.is_long());
  std::mt19937 engine(3);
  std::normal_distribution<double> white;
  Eigen::VectorXd readings(static_cast<Eigen::Index>(problem.sites.size()));
  for (double& one : readings) one = white(engine);
  const Eigen::VectorXd g = tables.weighting.projected(readings);
  const auto count = [](const std::vector<LoadPrior::Part>& parts) {
    std::size_t components = 0;
    for (const LoadPrior::Part& part : parts) components += part.sizes.size();
    return components;
  };
  const auto likely = likely_parts(tables, g, 5.0, 0.0);
  const auto few = likely_parts(tables, g, 5.0, 0.0, tables.most_components);
  REQUIRE(count(likely) > 16 * tables.most_components);
  CHECK(8 * count(few) <= count(likely));
  CHECK(10 * count(few) > count(likely));
  const Covered whole(likely, problem.grid.count());
  const Covered some(few, problem.grid.count());
  CHECK_THAT(some.all, WithinAbs(1.0, 1e-12));
  CHECK_THAT(some.alpha, WithinAbs(whole.alpha, 0.2));
  for (std::size_t cell = 0; cell < whole.holds.size(); ++cell)
    CHECK_THAT(some.holds[cell], WithinAbs(whole.holds[cell], 0.05));
}
