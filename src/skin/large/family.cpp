#include "tactile_net/skin/large/family.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/face_coordinates.hpp"
#include "inverse/weighting.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/split_mix.hpp"
#include "skin/large/coordinate_products.hpp"

namespace tactile_net {
namespace {

using Eigen::Index;

constexpr Index most_lanczos_steps = 300;
constexpr Index look_every = 20;  // steps, at whether the nodes will do

/// The spectrum of A A' as a vector of length 1 sees it.
struct Nodes {
  Eigen::VectorXd gamma;    // descending
  Eigen::VectorXd weights;  // their sum is 1
};

/// The tridiagonal matrix that a run makes of A A', over the square of its first length. Alphas of
/// 1e-8 of the largest eigenvalue do not mind that it is squared.
struct Tridiagonal {
  Tridiagonal(std::span<const double> lengths, std::span<const double> below)
      : first(lengths.front()), own(std::ssize(lengths)), beside(std::ssize(below)) {
    for (Index i = 0; i < own.size(); ++i) {
      const double size = lengths[static_cast<std::size_t>(i)] / first;
      const double step = i > 0 ? below[static_cast<std::size_t>(i) - 1] / first : 0.0;
      own(i) = size * size + step * step;
      if (i > 0) beside(i - 1) = step * (lengths[static_cast<std::size_t>(i) - 1] / first);
    }
  }

  [[nodiscard]] Nodes nodes() const {
    const GaussNodes found = tridiagonal_nodes(own, beside);
    return {first * found.values.reverse().cwiseMax(0.0).cwiseSqrt(), found.weights.reverse()};
  }

  /// u'(1 + A A'/alpha)^-1 u for alphas from the largest eigenvalue down, without eigenvectors.
  [[nodiscard]] Eigen::VectorXd fits() const {
    const double largest = largest_tridiagonal_eigenvalue(own, beside);
    constexpr Index decades = 8;
    Eigen::VectorXd all(decades);
    for (Index k = 0; k < decades; ++k) {
      const double alpha = largest * std::pow(10.0, -static_cast<double>(k));
      double pivot = own(own.size() - 1) + alpha;  // of T + alpha from its last row up
      for (Index i = own.size() - 2; i >= 0; --i)
        pivot = own(i) + alpha - beside(i) * (beside(i) / pivot);
      all(k) = alpha / pivot;
    }
    return all;
  }

  double first;
  Eigen::VectorXd own, beside;
};

/// Random signs at the rows that count.
Eigen::VectorXd signs(std::span<const double> weights, std::uint64_t probe) {
  std::uint64_t counter = probe << 40;
  Eigen::VectorXd all(std::ssize(weights));
  for (Index i = 0; i < all.size(); ++i, counter += split_mix_step)
    all(i) = weights[static_cast<std::size_t>(i)] == 0.0 ? 0.0 : random_sign(counter);
  return all;
}

}  // namespace

struct LargeSkinFamily::Parts {
  explicit Parts(const std::shared_ptr<LargeSkinSystem>& made)
      : Parts(made, std::make_unique<WaveCoordinates>(
                        made->problem, stabiliser_spectrum(made->problem).cwiseSqrt())) {}
  Parts(std::shared_ptr<LargeSkinSystem> made, std::unique_ptr<const TractionCoordinates> in)
      : system(std::move(made)),
        coordinates(std::move(in)),
        a{*system, *coordinates},
        rows(static_cast<double>(Weighting(system->problem).rows())) {
    const Eigen::VectorXd spectrum = stabiliser_spectrum(system->problem);
    stabiliser_condition = std::sqrt(spectrum.maxCoeff() / spectrum.minCoeff());
  }

  /// @param u  not 0
  [[nodiscard]] Nodes run(Eigen::VectorXd u) const {
    u.normalize();
    Eigen::VectorXd v = a.sums(u);
    std::vector<double> diagonal{v.norm()};
    std::vector<double> below;
    if (!(diagonal.front() > 0.0)) return {Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
    v /= diagonal.front();
    Eigen::VectorXd before;
    const double nothing = 1e-13 * diagonal.front();
    for (Index step = 1; step < most_lanczos_steps; ++step) {
      u = a.readings(v) - diagonal.back() * u;
      const double next = u.norm();
      if (!(next > nothing)) break;
      u /= next;
      v = a.sums(u) - next * v;
      const double own = v.norm();
      if (!(own > nothing)) break;
      v /= own;
      below.push_back(next);
      diagonal.push_back(own);
      if (step % look_every != 0) continue;
      const Eigen::VectorXd now = Tridiagonal(diagonal, below).fits();
      if (before.size() > 0 && ((now - before).array().abs() <= 1e-3 * now.array()).all()) break;
      before = now;
    }
    return Tridiagonal(diagonal, below).nodes();
  }

  void run_probes(std::size_t count) {
    for (std::size_t probe = 1; probe <= count; ++probe)
      probes.push_back(run(signs(system->problem.weights, probe)));
  }

  [[nodiscard]] double degrees(const Nodes& nodes, double alpha) const {
    const Eigen::ArrayXd squares = nodes.gamma.array().square();
    return rows * (nodes.weights.array() * squares / (squares + alpha)).sum();
  }

  std::shared_ptr<LargeSkinSystem> system;  // its buffers are used, not its meaning changed
  std::unique_ptr<const TractionCoordinates> coordinates;  // in which the stabiliser is simple
  CoordinateProducts a;
  double rows;
  double stabiliser_condition = 1.0;
  std::vector<Nodes> probes{};
};

LargeSkinFamily::LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system,
                                 std::size_t probes) {
  auto parts = std::make_unique<Parts>(system);
  parts->run_probes(probes);
  parts_ = std::move(parts);
}
LargeSkinFamily::LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system,
                                 const ActiveFace& face, std::size_t probes) {
  auto coordinates = std::make_unique<FaceCoordinates>(system->problem, face);
  auto parts = std::make_unique<Parts>(system, std::move(coordinates));
  parts->run_probes(probes);
  parts_ = std::move(parts);
}
LargeSkinFamily::LargeSkinFamily(const LargeSkinTikhonov& solver, std::size_t probes)
    : LargeSkinFamily(solver.system(), probes) {}
LargeSkinFamily::LargeSkinFamily(const std::shared_ptr<LargeSkinSystem>& system,
                                 const LargeSkinFamily& like) {
  auto parts = std::make_unique<Parts>(system);
  parts->probes = like.parts_->probes;  // of each row on average, whatever their number
  parts_ = std::move(parts);
}
LargeSkinFamily::~LargeSkinFamily() = default;
LargeSkinFamily::LargeSkinFamily(LargeSkinFamily&&) noexcept = default;
LargeSkinFamily& LargeSkinFamily::operator=(LargeSkinFamily&&) noexcept = default;

FilterFrame LargeSkinFamily::analyse(std::span<const double> readings) const {
  const Parts& parts = *parts_;
  check_readings(readings, parts.system->readings());
  FilterFrame frame{.rows = static_cast<std::size_t>(parts.rows)};
  const auto add = [&](const Nodes& nodes, double share, double power) {
    for (Index i = 0; i < nodes.gamma.size(); ++i) {
      frame.gamma.push_back(nodes.gamma(i));
      frame.shares.push_back(share * nodes.weights(i));
      frame.powers.push_back(power * nodes.weights(i));
      frame.beta.push_back(std::sqrt(frame.powers.back()));
    }
  };
  for (const Nodes& nodes : parts.probes)
    add(nodes, parts.rows / static_cast<double>(parts.probes.size()), 0.0);
  Eigen::VectorXd g =
      as_eigen(std::span(parts.system->problem.weights)).cwiseProduct(as_eigen(readings));
  frame.scale = g.cwiseAbs().maxCoeff();
  if (!(frame.scale > 0.0)) return frame;
  g = g / frame.scale;
  add(parts.run(g), 0.0, g.squaredNorm());
  return frame;
}

double LargeSkinFamily::degrees_of_freedom(double alpha) const noexcept {
  double sum = 0.0;
  for (const Nodes& nodes : parts_->probes) sum += parts_->degrees(nodes, alpha);
  return sum / static_cast<double>(parts_->probes.size());
}

double LargeSkinFamily::degrees_deviation(double alpha) const noexcept {
  const auto count = static_cast<double>(parts_->probes.size());
  if (count < 2.0) return 0.0;
  const double mean = degrees_of_freedom(alpha);
  double square = 0.0;
  for (const Nodes& nodes : parts_->probes)
    square += std::pow(parts_->degrees(nodes, alpha) - mean, 2);
  return std::sqrt(square / (count - 1.0) / count);
}

double LargeSkinFamily::condition(double alpha) const noexcept {
  double largest = 0.0;
  for (const Nodes& nodes : parts_->probes) largest = std::max(largest, nodes.gamma(0));
  return std::hypot(largest, std::sqrt(alpha)) / std::sqrt(alpha);
}

double LargeSkinFamily::stacked_condition(double alpha) const noexcept {
  return parts_->stabiliser_condition * condition(alpha);
}

}  // namespace tactile_net
