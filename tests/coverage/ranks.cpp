#include "tests/coverage/ranks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/chi_squared_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <limits>

#include "numeric/eigen.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/sha256.hpp"
#include "tests/inverse/load_draws.hpp"

namespace tactile_net::coverage {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_signal = 10.0;  // largest reading over noise
constexpr double most_signal = 1000.0;

/// What the lab takes for the model: see `SceneProblem::load_prior`.
LoadPriorOptions prior_of(const SensorArray& array) {
  const double depth = least_depth(array);
  return {.depth = depth, .prior_power = array.pitch > 1.5 * depth ? 0.25 : 0.0};
}

/// The engines and distributions of Boost are the same on every platform.
struct Random {
  explicit Random(std::uint64_t seed) : engine(seed) {}

  double uniform() { return std::ldexp(static_cast<double>(engine() >> 11U), -53); }
  double white() { return normal(engine); }

  boost::random::mt19937_64 engine;
  boost::random::normal_distribution<double> normal{};
};

/// What is certain has a rank anywhere in its jump.
double rank(const Distribution& known, double truth, double anywhere) {
  const double up_to = known.cdf(truth);
  if (truth != 0.0) return up_to;  // elsewhere it has none
  const double below = known.cdf(std::nextafter(truth, -infinite));
  return below + anywhere * (up_to - below);
}

}  // namespace

double kolmogorov(std::vector<double> ranks) {
  std::sort(ranks.begin(), ranks.end());
  const auto n = static_cast<double>(ranks.size());
  double most = 0.0;
  for (std::size_t i = 0; i < ranks.size(); ++i)
    most = std::max(
        {most, ranks[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - ranks[i]});
  return std::sqrt(n) * most;
}

double dispersion(std::span<const double> ranks) {
  const boost::math::normal_distribution<double> normal;
  double sum = 0.0;
  for (const double rank : ranks)
    sum += std::pow(boost::math::quantile(normal, std::clamp(rank, 1e-4, 1.0 - 1e-4)), 2) - 1.0;
  return sum / std::sqrt(2.0 * static_cast<double>(ranks.size()));
}

double share_within(std::span<const double> ranks, double level) {
  const auto within = std::count_if(
      ranks.begin(), ranks.end(), [&](double rank) { return std::abs(rank - 0.5) <= 0.5 * level; });
  return static_cast<double>(within) / static_cast<double>(ranks.size());
}

Distribution wider(const Distribution& known, double times) {
  std::vector<Distribution::Component> components(known.components().begin(),
                                                  known.components().end());
  for (Distribution::Component& one : components) {
    one.scale *= times;
    one.divisor_scale *= times;
    one.covariance *= times * times;
  }
  return Distribution(std::move(components), known.degrees_of_freedom());
}

void add_bytes(std::string& bytes, std::span<const double> values) {
  for (const double value : values) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 64; i += 8) bytes += static_cast<char>(bits >> i & 0xFFU);
  }
}

ModelRanks model_ranks(const Setting& setting, std::size_t draws, std::size_t places,
                       std::uint64_t seed) {
  const lab::SceneProblem scene(scene_of(setting));
  const LinearProblem& problem = scene.of_mixture().problem();
  const Surface& grid = scene.of_mixture().surface();
  const LoadDraws model(problem, prior_of(scene.scene().sensor));
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  const double stated = *scene.stated_noise();
  const double degrees = scene.scene().noise->degrees;
  const std::size_t channel = channel_length(problem);
  const bool two = problem.components == 2;

  ModelRanks ranks;
  for (const char* name : {"force", "centre", "tangential", "friction"})
    ranks.of.push_back({.name = name});
  std::vector<std::size_t> chosen;
  for (std::size_t u = 0; u < problem.components; ++u)
    for (std::size_t i = 0; i < places; ++i) {
      chosen.push_back(u * grid.count + (2 * i + 1) * grid.count / (2 * places));
      ranks.of.push_back({.name = "place " + std::to_string(chosen.back())});
    }

  Random random(seed);
  boost::random::chi_squared_distribution<double> level(degrees);
  const auto uniform = [&] { return random.uniform(); };
  const auto white = [&] { return random.white(); };
  std::string bytes;
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t done = 0; done < draws;) {
    const double sigma = stated * std::sqrt(degrees / level(random.engine));
    const Eigen::VectorXd f = model.draw(sigma, uniform, white);
    const Eigen::VectorXd g = kernel * f;
    double constant = 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (i % channel == 0 && problem.unknown_offsets) constant = 10.0 * sigma * white();
      const double reading = g(static_cast<Eigen::Index>(i)) + sigma * white() + constant;
      const double weight = problem.weights[i];
      readings[i] = weight > 0.0 ? reading / weight : 0.0;
    }
    const std::vector<double> seen = weighted(problem, readings);
    const double peak = as_eigen(std::span(seen)).cwiseAbs().maxCoeff() / stated;
    if (peak < least_signal || peak > most_signal) continue;
    ++done;
    add_bytes(bytes, std::span(f.data(), static_cast<std::size_t>(f.size())));
    add_bytes(bytes, readings);

    const lab::SceneFrame frame(scene, readings);
    const lab::ResultantDistributions known = lab::resultant_distributions(frame);
    const auto n = static_cast<Eigen::Index>(grid.count);
    const double force = grid.spacing * f.head(n).sum();
    double moment = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      moment += grid.spacing * grid.position(static_cast<std::size_t>(i)) * f(i);
    const double drag = two ? grid.spacing * f.tail(n).sum() : 0.0;
    const auto add = [&](Ranks& one, const Distribution& of, double truth) {
      const double anywhere = random.uniform();
      one.values.push_back(rank(of, truth, anywhere));
      one.planted.push_back(rank(wider(of, planted_error), truth, anywhere));
    };
    add(ranks.of[0], known.normal, force);
    if (known.centre) add(ranks.of[1], *known.centre, moment / force);
    if (known.tangential) add(ranks.of[2], *known.tangential, drag);
    if (known.slope) add(ranks.of[3], *known.slope, drag / force);
    const std::vector<Distribution> tractions = frame.mixture()->of_tractions();
    for (std::size_t i = 0; i < chosen.size(); ++i)
      add(ranks.of[4 + i], tractions[chosen[i]], f(static_cast<Eigen::Index>(chosen[i])));
  }
  std::erase_if(ranks.of, [](const Ranks& one) { return one.values.empty(); });
  ranks.hash = sha256_text(bytes);
  return ranks;
}

}  // namespace tactile_net::coverage
