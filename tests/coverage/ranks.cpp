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
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "numeric/eigen.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/skin_distributions.hpp"
#include "tactile_net/lab/skin_problem.hpp"
#include "tactile_net/lab/uncertainty.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/sha256.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/inverse/load_draws.hpp"

namespace tactile_net::coverage {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_signal = 10.0;  // largest reading over noise
constexpr double most_signal = 1000.0;

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

namespace {

/// A number, as an answer knows it; absent: it does not.
struct Told {
  const char* name;
  std::optional<Distribution> known;
  double truth;
};

using Mixture = std::shared_ptr<const LoadMixture>;

class Line {
 public:
  explicit Line(const Setting& setting) : scene_(scene_of(setting)) {}

  [[nodiscard]] const LinearProblem& problem() const { return scene_.of_mixture().problem(); }
  [[nodiscard]] const LoadPrior& prior() const { return scene_.load_prior(); }
  /// What the lab takes for the model: see `SceneProblem::load_prior`.
  [[nodiscard]] LoadPriorOptions model() const {
    const SensorArray& array = scene_.scene().sensor;
    const double depth = least_depth(array);
    return {.depth = depth, .prior_power = array.pitch > 1.5 * depth ? 0.25 : 0.0};
  }
  [[nodiscard]] LoadNoise noise() const {
    return {.rms = scene_.stated_noise(), .degrees = scene_.scene().noise->degrees};
  }
  [[nodiscard]] std::vector<Told> told(std::span<const double> readings, const Mixture& mixture,
                                       const Eigen::VectorXd& f) const {
    const lab::ResultantDistributions known =
        lab::resultant_distributions({scene_, readings, mixture});
    const Surface& grid = scene_.of_mixture().surface();
    const auto n = static_cast<Eigen::Index>(grid.count);
    const double force = grid.spacing * f.head(n).sum();
    double moment = 0.0;
    for (Eigen::Index i = 0; i < n; ++i)
      moment += grid.spacing * grid.position(static_cast<std::size_t>(i)) * f(i);
    const double drag = f.size() > n ? grid.spacing * f.tail(n).sum() : 0.0;
    return {{"force", known.normal, force},
            {"centre", known.centre, moment / force},
            {"tangential", known.tangential, drag},
            {"friction", known.slope, drag / force}};
  }

 private:
  lab::SceneProblem scene_;
};

class Skin {
 public:
  explicit Skin(const SkinSetting& setting)
      : scene_(std::get<SkinScene>(parse_any_scene(text_of(setting), "coverage"))) {}

  [[nodiscard]] const LinearProblem& problem() const { return scene_.problem(); }
  [[nodiscard]] const LoadPrior& prior() const { return scene_.load_prior(); }
  [[nodiscard]] LoadPriorOptions model() const {  // see `SkinSceneProblem::load_prior`
    return {.depth = least_depth(scene_.scene().sensor), .narrowest = 3.5};
  }
  [[nodiscard]] LoadNoise noise() const {
    return {.rms = scene_.stated_noise(), .degrees = scene_.scene().noise->degrees};
  }
  [[nodiscard]] std::vector<Told> told(std::span<const double>, const Mixture& mixture,
                                       const Eigen::VectorXd& f) const {
    const lab::WrenchDistributions known = lab::wrench_distributions(*mixture, problem());
    const SurfaceGrid& grid = problem().grid;
    const auto n = static_cast<Eigen::Index>(grid.count());
    const double force = grid.area() * f.head(n).sum();
    double of_y = 0.0, of_z = 0.0;
    for (std::size_t cell = 0; cell < grid.count(); ++cell) {
      const double one = grid.area() * f(static_cast<Eigen::Index>(cell));
      of_y += one * grid.y(cell / grid.columns);
      of_z += one * grid.z(cell % grid.columns);
    }
    const bool drags = f.size() > n;
    const double drag_y = drags ? grid.area() * f.segment(n, n).sum() : 0.0;
    const double drag_z = drags ? grid.area() * f.tail(n).sum() : 0.0;
    return {{"force", known.normal, force},
            {"centre y", known.centre_y, of_y / force},
            {"centre z", known.centre_z, of_z / force},
            {"drag y", known.tangential_y, drag_y},
            {"drag z", known.tangential_z, drag_z}};
  }

 private:
  static std::string text_of(const SkinSetting& setting) {
    const std::string size = std::to_string(setting.rows);
    return "[sensor]\nrows = " + size + "\ncolumns = " + size +
           "\npitch = " + shortest(setting.pitch) + "\ndepth = 1.0\nreads = [\"stress_x\"" +
           (setting.drags ? ", \"shear_xy\", \"shear_xz\"" : "") +
           "]\n[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.5\n[noise]\nrms = 0.01\n"
           "[reconstruct]\nanswer = \"mixture\"\n";
  }

  lab::SkinSceneProblem scene_;
};

ModelRanks ranks_of(const auto& scene, const RankOptions& options) {
  const LinearProblem& problem = scene.problem();
  const LoadDraws model(problem, scene.model());
  const Eigen::MatrixXd kernel = as_eigen(problem.kernel);
  LoadNoise noise = scene.noise();
  const double stated = *noise.rms;
  if (options.degrees) noise.degrees = *options.degrees;
  const bool unknown = noise.degrees == 0.0;
  if (unknown) noise = {};
  const std::size_t channel = channel_length(problem);
  const std::size_t count = problem.grid.count();

  std::vector<std::size_t> chosen;
  std::vector<Ranks> places;
  for (std::size_t u = 0; u < problem.components; ++u)
    for (std::size_t i = 0; i < options.places; ++i) {
      chosen.push_back(u * count + (2 * i + 1) * count / (2 * options.places));
      places.push_back({.name = "place " + std::to_string(chosen.back())});
    }

  Random random(options.seed);
  const bool certain = unknown || std::isinf(noise.degrees);
  boost::random::chi_squared_distribution<double> level(certain ? 1.0 : noise.degrees);
  const auto uniform = [&] { return random.uniform(); };
  const auto white = [&] { return random.white(); };
  const auto add = [&](Ranks& one, const Distribution& of, double truth) {
    const double anywhere = random.uniform();
    one.values.push_back(rank(of, truth, anywhere));
    one.planted.push_back(rank(wider(of, planted_error), truth, anywhere));
  };
  ModelRanks ranks;
  std::string bytes;
  std::vector<double> readings(problem.kernel.rows);
  for (std::size_t done = 0; done < options.draws;) {
    const double sigma =
        certain ? stated : stated * std::sqrt(noise.degrees / level(random.engine));
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
    const double peak = as_eigen(std::span(seen)).cwiseAbs().maxCoeff();
    const auto counts = [&](double of_noise) {
      return peak >= least_signal * of_noise && peak <= most_signal * of_noise;
    };
    if (!unknown && !counts(stated)) continue;
    const auto mixture = std::make_shared<const LoadMixture>(scene.prior().given(readings, noise));
    // Of a noise that is not known only what readings of twice the size have too may choose.
    if (unknown &&
        !counts(estimate_noise(problem, readings, mixture->mean(), mixture->degrees_of_freedom())
                    .rms()))
      continue;
    ++done;
    add_bytes(bytes, std::span(f.data(), static_cast<std::size_t>(f.size())));
    add_bytes(bytes, readings);
    const std::vector<Told> told = scene.told(readings, mixture, f);
    if (ranks.of.empty())
      for (const Told& one : told) ranks.of.push_back({.name = one.name});
    for (std::size_t i = 0; i < told.size(); ++i)
      if (told[i].known) add(ranks.of[i], *told[i].known, told[i].truth);
    const std::vector<Distribution> tractions = mixture->of_tractions();
    for (std::size_t i = 0; i < chosen.size(); ++i)
      add(places[i], tractions[chosen[i]], f(static_cast<Eigen::Index>(chosen[i])));
  }
  ranks.of.insert(ranks.of.end(), places.begin(), places.end());
  std::erase_if(ranks.of, [](const Ranks& one) { return one.values.empty(); });
  ranks.hash = sha256_text(bytes);
  return ranks;
}

}  // namespace

ModelRanks model_ranks(const Setting& setting, const RankOptions& options) {
  return ranks_of(Line(setting), options);
}

ModelRanks model_ranks(const SkinSetting& setting, const RankOptions& options) {
  return ranks_of(Skin(setting), options);
}

}  // namespace tactile_net::coverage
