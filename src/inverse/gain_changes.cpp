#include "tactile_net/inverse/gain_changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "inverse/cone_edges.hpp"
#include "inverse/nonnegative.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t active_set_limit = 400;
constexpr int newton_steps = 3;        // of Gauss and Newton
constexpr double offset_prior = 0.5;   // sd of an offset's change, in its noise
constexpr double change_prior = 0.1;   // sd of a change that is looked for
constexpr double beyond_doubt = 3.5;   // standard deviations: names one of 200 sound recordings
constexpr double in_a_half = 1.5;      // the same, of half of the frames
constexpr double least_change = 0.02;  // that is worth a calibration
constexpr double explained = 1.1;      // rms over the noise
constexpr std::size_t fewest_frames = 8;
/// Of all gains about what the calibration says, sds to choose from.
constexpr std::array spreads = {0.001, 0.003, 0.006, 0.01, 0.015, 0.02, 0.03, 0.05};

/// The likelihood of changes d of the gains, with loads and offsets whatever suits them best: the
/// misfit (-2 log of it) is c - 2 slope'd + d'information d.
struct GainLikelihood {
  Eigen::MatrixXd information{};
  Eigen::VectorXd slope{};
  Eigen::VectorXd offsets{};  // that suit the gains of the state
  double residual = 0.0;      // |residual|^2 of the state
  double rows = 0.0;          // readings
};

struct Fitted {
  Eigen::VectorXd changes{}, variances{};
  GainLikelihood likelihood{};
};

class Changes {
 public:
  Changes(const Eigen::MatrixXd& cone, const std::vector<Eigen::VectorXd>& loads,
          const Eigen::VectorXd& rest, std::size_t resting)
      : cone_(cone), loads_(loads), rest_(rest), resting_(static_cast<double>(resting)) {}

  /// @param variances  of the gains' changes, before frames say more; 0: none
  /// @param frames     that count
  [[nodiscard]] Fitted fit(const Eigen::VectorXd& variances,
                           const std::vector<std::size_t>& frames) const;

 private:
  [[nodiscard]] GainLikelihood likelihood(const Eigen::VectorXd& gains,
                                          const Eigen::VectorXd& offsets,
                                          const std::vector<std::size_t>& frames) const;
  [[nodiscard]] static std::vector<bool> widened(const std::vector<bool>& free);

  const Eigen::MatrixXd& cone_;
  const std::vector<Eigen::VectorXd>& loads_;
  const Eigen::VectorXd& rest_;
  double resting_;
};

/// A load may move as well as grow: its neighbours' columns are free, too.
std::vector<bool> Changes::widened(const std::vector<bool>& free) {
  std::vector<bool> wide = free;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (!free[i]) continue;
    if (i > 0) wide[i - 1] = true;
    if (i + 1 < free.size()) wide[i + 1] = true;
  }
  return wide;
}

GainLikelihood Changes::likelihood(const Eigen::VectorXd& gains, const Eigen::VectorXd& offsets,
                                   const std::vector<std::size_t>& frames) const {
  const Eigen::Index n = cone_.rows();
  Eigen::MatrixXd gain_gain = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd gain_offset = gain_gain;
  Eigen::MatrixXd offset_offset = gain_gain;
  Eigen::VectorXd gain_pull = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd offset_pull = gain_pull;
  GainLikelihood all;
  const Eigen::VectorXd factors = (gains.array() + 1.0).matrix();
  Eigen::MatrixXd columns = factors.asDiagonal() * cone_;
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    if (const double norm = columns.col(j).norm(); norm > 0.0) columns.col(j) /= norm;
  const std::vector<bool> bounded(static_cast<std::size_t>(columns.cols()), true);
  for (const std::size_t t : frames) {
    const Eigen::VectorXd d = loads_[t] - offsets;
    const NonnegativeSolution solved = sparse_nonnegative_least_squares(
        columns, d, bounded, active_set_limit, {.gradient = 0.3 / std::max(d.norm(), 1.0)});
    const Eigen::VectorXd fitted = columns * solved.z;
    const Eigen::VectorXd residual = d - fitted;
    const Eigen::VectorXd pure = fitted.cwiseQuotient(factors);
    std::vector<Eigen::Index> kept;
    const std::vector<bool> wide = widened(solved.free);
    for (std::size_t j = 0; j < wide.size(); ++j)
      if (wide[j]) kept.push_back(static_cast<Eigen::Index>(j));
    // Loads may change by as much as all of them together: what is left of a frame then.
    const double most = solved.z.sum();
    const Eigen::MatrixXd near = most * columns(Eigen::indexing::all, kept);
    const Eigen::MatrixXd projector =
        Lu(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n) + near * near.transpose())).inverse();
    const Eigen::VectorXd pull = projector * residual;
    const Eigen::MatrixXd by_gain = pure.asDiagonal() * projector;
    gain_gain += by_gain * pure.asDiagonal();
    gain_offset += by_gain;
    offset_offset += projector;
    gain_pull += pure.cwiseProduct(pull);
    offset_pull += pull;
    all.residual += residual.squaredNorm();
  }
  constexpr double offset_precision = 1.0 / (offset_prior * offset_prior);
  offset_offset.diagonal().array() += offset_precision + resting_;
  offset_pull -= offset_precision * offsets;
  if (resting_ > 0.0) offset_pull += resting_ * (rest_ - offsets);
  const Lu eliminated(offset_offset);
  const Eigen::MatrixXd by_offset = eliminated.solve(Eigen::MatrixXd(gain_offset.transpose()));
  all.information = gain_gain - gain_offset * by_offset;
  all.slope = gain_pull - by_offset.transpose() * offset_pull + all.information * gains;
  all.offsets = offsets + eliminated.solve(offset_pull);
  return all;
}

/// Changes that are most likely, and their variances after frames have spoken.
void settle(const Eigen::VectorXd& variances, Fitted& fitted) {
  const Eigen::VectorXd roots = variances.cwiseSqrt();
  const Eigen::Index n = variances.size();
  const Lu system(
      Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n) +
                      roots.asDiagonal() * fitted.likelihood.information * roots.asDiagonal()));
  const Eigen::MatrixXd inverse = system.inverse();
  fitted.changes =
      roots.cwiseProduct(inverse * Eigen::VectorXd(roots.cwiseProduct(fitted.likelihood.slope)));
  fitted.variances = inverse.diagonal().cwiseProduct(variances);
}

/// -2 log of the evidence for these variances of the gains' changes, but for a constant.
double twice_negative_log_evidence(const GainLikelihood& likelihood,
                                   const Eigen::VectorXd& variances) {
  const Eigen::VectorXd roots = variances.cwiseSqrt();
  const Eigen::Index n = variances.size();
  const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) +
                                 roots.asDiagonal() * likelihood.information * roots.asDiagonal();
  const Eigen::VectorXd pull = roots.cwiseProduct(likelihood.slope);
  return symmetric_eigenvalues(system).cwiseMax(1e-12).array().log().sum() -
         pull.dot(solve_definite(system, pull));
}

Fitted Changes::fit(const Eigen::VectorXd& variances,
                    const std::vector<std::size_t>& frames) const {
  const Eigen::Index n = cone_.rows();
  Fitted fitted;
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd offsets = gains;
  for (int step = 0; step < newton_steps; ++step) {
    fitted.likelihood = likelihood(gains, offsets, frames);
    fitted.likelihood.rows =
        static_cast<double>(frames.size()) * static_cast<double>((variances.array() > 0.0).count());
    settle(variances, fitted);
    gains = fitted.changes.cwiseMax(-0.8).cwiseMin(2.0);
    offsets = fitted.likelihood.offsets;
  }
  return fitted;
}

/// How far a change lies from zero, squared, in standard deviations: those of what frames say of it
/// by themselves, and of `spread`.
double squared_distance(const Fitted& fitted, Eigen::Index j, double variance, double spread) {
  const double precision = 1.0 / fitted.variances(j) - 1.0 / variance;
  if (!(precision > 1e-6 / variance)) return 0.0;
  const double change = fitted.changes(j) / fitted.variances(j) / precision;
  return change * change / (1.0 / precision + spread * spread);
}

}  // namespace

GainChanges gain_changes(const LinearProblem& contacts, double friction_limit,
                         const GainFrames& given) {
  const std::size_t n = given.noise.size();
  const auto fits = [n](const std::vector<double>& one) { return one.size() == n; };
  if (n > contacts.weights.size() || !std::all_of(given.loads.begin(), given.loads.end(), fits) ||
      (given.resting > 0 && !fits(given.rest)))
    throw std::invalid_argument("frames need one value for each reading");
  GainChanges result{.frames = given.loads.size()};
  if (given.loads.size() < fewest_frames) return result;

  Eigen::VectorXd weights(static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i)
    weights(static_cast<Eigen::Index>(i)) = given.noise[i] > 0.0 ? 1.0 / given.noise[i] : 0.0;
  const auto weighted_by_noise = [&](const std::vector<double>& one) -> Eigen::VectorXd {
    return weights.cwiseProduct(as_eigen(std::span<const double>(one)));
  };
  const Constraints press{.nonnegative = true, .friction_limit = friction_limit};
  const Eigen::MatrixXd cone =
      weights.asDiagonal() *
      ConeEdges(contacts, press).applied(as_eigen(contacts.kernel).topRows(weights.size()));
  std::vector<Eigen::VectorXd> loads;
  for (const std::vector<double>& one : given.loads) loads.push_back(weighted_by_noise(one));
  const Eigen::VectorXd rest =
      given.resting > 0 ? weighted_by_noise(given.rest) : Eigen::VectorXd::Zero(weights.size());
  const Changes changes(cone, loads, rest, given.resting);
  std::vector<std::size_t> frames(loads.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});

  const Eigen::ArrayXd live = (cone.rowwise().squaredNorm().array() > 0.0).cast<double>();
  std::vector<Eigen::Index> suspects;
  double spread = spreads.front();
  const auto variances = [&](double of_all) {
    Eigen::VectorXd all = of_all * of_all * live.matrix();
    for (const Eigen::Index j : suspects) all(j) = change_prior * change_prior;
    return all;
  };
  Fitted found;
  while (true) {
    found = changes.fit(variances(spread), frames);
    if (suspects.empty()) result.rms = std::sqrt(found.likelihood.residual / found.likelihood.rows);
    // How far apart the gains lie anyhow is what the frames themselves make likeliest.
    const auto choose_spread = [&] {
      spread = *std::min_element(spreads.begin(), spreads.end(), [&](double a, double b) {
        return twice_negative_log_evidence(found.likelihood, variances(a)) <
               twice_negative_log_evidence(found.likelihood, variances(b));
      });
      Eigen::VectorXd own = variances(spread);
      settle(own, found);
      return own;
    };
    const Eigen::VectorXd before = choose_spread();
    Eigen::Index farthest = -1;
    double most = 0.0;
    for (Eigen::Index j = 0; j < before.size(); ++j) {
      if (live(j) == 0.0 || std::find(suspects.begin(), suspects.end(), j) != suspects.end())
        continue;
      if (const double one = squared_distance(found, j, before(j), spread); one > most) {
        most = one;
        farthest = j;
      }
    }
    if (farthest < 0) break;
    if (4.0 * static_cast<double>(suspects.size() + 1) > live.sum()) return result;
    // One that changed alone must not be what makes all others uncertain.
    suspects.push_back(farthest);
    const Eigen::VectorXd after = choose_spread();
    if (squared_distance(found, farthest, after(farthest), spread) > beyond_doubt * beyond_doubt)
      continue;
    suspects.pop_back();
    choose_spread();
    break;
  }
  if (suspects.empty() || found.likelihood.residual > explained * explained * found.likelihood.rows)
    return result;

  const Eigen::VectorXd own = variances(spread);
  std::vector<std::size_t> halves[2];
  for (const std::size_t t : frames) halves[2 * t < frames.size() ? 0 : 1].push_back(t);
  const Fitted half[2] = {changes.fit(own, halves[0]), changes.fit(own, halves[1])};
  for (const Eigen::Index j : suspects) {
    const double change = found.changes(j);
    const auto tells = [&](const Fitted& fitted, double times) {
      return fitted.changes(j) * change > 0.0 &&
             squared_distance(fitted, j, own(j), spread) > times * times;
    };
    if (std::abs(change) > least_change && tells(found, beyond_doubt) &&
        tells(half[0], in_a_half) && tells(half[1], in_a_half))
      result.named.push_back({.reading = static_cast<std::size_t>(j),
                              .change = change,
                              .sd = std::sqrt(found.variances(j))});
  }
  return result;
}

}  // namespace tactile_net
