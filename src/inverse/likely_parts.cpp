#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "inverse/load_tables.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

/// Over the largest probability: of as many components as there are, all together are less than
/// a billionth.
constexpr double never_counted = 1e-15;
constexpr double least_outside = 1e-6;  // of |g|^2, told by a difference
/// Of a frame of noise, whose loads are of any size, a cell's deviation is that of the rare large
/// ones: one component of eight answers.
constexpr std::size_t least_thinned = 8;
constexpr Index looked_apart = LoadPrior::Tables::looked_apart;

/// At most so many of these probabilities, others 0, that on average say the same: the large ones
/// are as they are, of the small ones some stand for those about them in this order, all with one
/// probability (the optimal resampling of Fearnhead and Clifford 2003). Which ones no readings'
/// noise decides: one of each stretch of that probability, as far along as the golden section's
/// multiples are.
std::vector<double> few_of(const std::vector<double>& all, const std::vector<std::size_t>& order,
                           std::size_t most) {
  const auto some = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](double p) { return p > 0.0; }));
  if (some <= most) return all;
  std::vector<double> sorted = all;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  double rest = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  std::size_t large = 0;
  while (large + 1 < most && sorted[large] * static_cast<double>(most - large) > rest)
    rest -= sorted[large++];
  const double each = rest / static_cast<double>(most - large);
  std::vector<double> few(all.size(), 0.0);
  double passed = 0.0;
  double section = 0.5;
  double next = section;
  std::size_t chosen = 0;
  for (const std::size_t i : order) {
    if (all[i] > each) {
      few[i] = all[i];
      continue;
    }
    passed += all[i] / each;
    while (passed >= next) {
      few[i] += each;
      section = std::fmod(section + 0.5 * (std::sqrt(5.0) - 1.0), 1.0);
      next = static_cast<double>(++chosen) + section;
    }
  }
  return few;
}

/// Places of values, the largest one's first.
std::vector<std::size_t> falling(const std::vector<double>& values) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
  return places;
}

/// Each term of q, alpha beta^2 / (gamma^2 + alpha), rises with alpha and is concave in it: between
/// two alphas q lies above its chord. And q = g'(I + K C K' / alpha)^-1 g rises with the tangential
/// weight, as C falls: what it is for one weight bounds it for those above. The rest of log p is in
/// tables, so that a few alphas of the least weight say how likely a window may be at most.
class LikelyParts {
 public:
  /// @param g      over sigma
  /// @param known  nu
  /// @param least  q is not less
  /// @param most   that answer
  LikelyParts(const LoadPrior::Tables& tables, const Eigen::VectorXd& g, double known, double least,
              std::size_t most)
      : tables_(tables),
        square_(g.squaredNorm()),
        known_(known),
        degrees_(known + static_cast<double>(tables.weighting.rows())),
        least_(least),
        most_(most) {
    for (const LoadPrior::Tables::Reflection& by : tables_.reflections)
      reflected_.emplace_back(by.signs.cwiseProduct(g(by.readings)));
  }

  /// Probabilities that sum to 1, window after window.
  [[nodiscard]] std::vector<LoadPrior::Part> found() {
    std::vector<Look> looks(tables_.windows.size());
    left_.resize(tables_.looked_at().size(), std::ssize(looks));
    for (const LoadPrior::Tables::Shape& shape : tables_.shapes) look_at(shape, looks);
    std::vector<double> most;
    most.reserve(looks.size());
    for (const Look& look : looks) most.push_back(look.most);
    for (const std::size_t w : falling(most)) {
      if (!(looks[w].most > best_ + std::log(never_counted))) break;
      look_closely(w, std::move(looks[w]));
    }
    return likely();
  }

 private:
  /// A window's readings onto what its tractions make of them.
  struct Look {
    Eigen::VectorXd within{};  // by an outline: before a weight's matrix rotates them
    Eigen::VectorXd beta{};    // by an outline: of the least weight
    double outside = 0.0;      // what of |g|^2 no traction in the window explains
    double most = 0.0;         // of log p
  };
  struct Found {
    std::size_t window = 0, entry = 0;
    Eigen::VectorXd beta{};
    std::vector<Index> alphas{};
    std::vector<double> left{};
    std::vector<double> log{};  // p, from `likely` on
  };

  [[nodiscard]] const Eigen::VectorXd& readings(std::size_t window) const {
    return reflected_[tables_.windows[window].reflection];
  }
  /// |g|^2 less that of beta = U'g.
  [[nodiscard]] double outside(const LoadPrior::Tables::Entry& entry, const Eigen::VectorXd& g,
                               const auto& beta) const {
    const double difference = square_ - beta.squaredNorm();
    // A difference of squares has its own rounding: seen where little is left.
    return difference < least_outside * square_ ? (g - entry.u * beta).squaredNorm() : difference;
  }
  /// q of these alphas.
  [[nodiscard]] Eigen::VectorXd left(std::size_t entry, const Look& look,
                                     const std::vector<Index>& at) const {
    const Eigen::VectorXd alphas = tables_.alphas(at);
    Eigen::VectorXd inside(alphas.size());
    if (tables_.is_long()) {
      inside = tables_.outline(entry).damped(alphas).left(look.beta);
    } else {
      const Eigen::VectorXd& gamma2 = tables_.entry(entry).gamma2;
      const Eigen::VectorXd square = look.beta.cwiseAbs2();
      for (Index i = 0; i < inside.size(); ++i)
        inside(i) = (alphas(i) * square.array() / (gamma2.array() + alphas(i))).sum();
    }
    return (inside.array() + look.outside).max(least_);
  }
  [[nodiscard]] double log_likelihood(double q) const {
    return std::isinf(known_) ? -0.5 * q : -0.5 * degrees_ * std::log(known_ + q);
  }

  /// At all windows of a shape.
  void look_at(const LoadPrior::Tables::Shape& shape, std::vector<Look>& looks) {
    if (tables_.is_long()) {
      Eigen::MatrixXd g(reflected_.front().size(), std::ssize(shape.windows));
      for (Index k = 0; k < g.cols(); ++k)
        g.col(k) = readings(shape.windows[static_cast<std::size_t>(k)]);
      const LoadPrior::Tables::Outline& outline = tables_.outline(shape.first);
      const auto seen = shape.range->coordinates(g);
      const Eigen::MatrixXd rotated = outline.rotated(seen.within);
      const Eigen::MatrixXd left = outline.looks->left(rotated);
      for (Index k = 0; k < g.cols(); ++k) {
        const std::size_t w = shape.windows[static_cast<std::size_t>(k)];
        looks[w].outside = seen.outside(k);
        looks[w].within = seen.within.col(k);
        looks[w].beta = rotated.col(k);
        left_.col(static_cast<Index>(w)) = left.col(k);
      }
    } else {
      const LoadPrior::Tables::Entry& entry = tables_.entry(shape.first);
      Eigen::VectorXd beta(entry.u.cols());
      for (const std::size_t w : shape.windows) {
        beta.noalias() = entry.u.transpose() * readings(w);
        looks[w].outside = outside(entry, readings(w), beta);
        left_.col(static_cast<Index>(w)).noalias() = shape.looks * beta.cwiseAbs2();
      }
    }
    for (const std::size_t w : shape.windows) {
      Look& look = looks[w];
      auto left = left_.col(static_cast<Index>(w)).array();
      left = (left + look.outside).max(least_);
      // Of the alphas between two, which are larger than the second one, q is more than its.
      look.most = shape.most_log_prior(0) + log_likelihood(left(0));
      for (Index i = 1; i < left.size(); ++i)
        look.most = std::max(look.most, shape.most_log_prior(i) + log_likelihood(left(i)));
    }
  }

  /// q of every alpha, or less.
  [[nodiscard]] Eigen::VectorXd left_of(std::size_t window) const {
    const auto looked_at = left_.col(static_cast<Index>(window));
    Eigen::VectorXd left(tables_.alphas.size());
    left(0) = looked_at(0);
    for (Index a = looked_apart; a < left.size(); a += looked_apart) {
      const double first = looked_at(a / looked_apart - 1);
      const double last = looked_at(a / looked_apart);
      const double apart = tables_.alphas(a - looked_apart) - tables_.alphas(a);
      for (Index i = a - looked_apart + 1; i <= a; ++i)
        left(i) = last + (tables_.alphas(i) - tables_.alphas(a)) / apart * (first - last);
    }
    return left;
  }

  void look_closely(std::size_t w, Look look) {
    const LoadPrior::Tables::Shape& shape = tables_.shapes[tables_.windows[w].shape];
    Eigen::VectorXd left = left_of(w);
    for (std::size_t i = 0; i < tables_.tangential_weights.size(); ++i) {
      const std::size_t entry = shape.first + i;
      const Eigen::VectorXd& log_prior = tables_.entry(entry).log_prior;
      Found found{.window = w, .entry = entry};
      for (Index a = 0; a < tables_.alphas.size(); ++a)
        if (log_prior(a) + log_likelihood(left(a)) > best_ + std::log(never_counted))
          found.alphas.push_back(a);
      if (found.alphas.empty()) continue;
      if (!tables_.is_long()) {
        const LoadPrior::Tables::Entry& one = tables_.entry(entry);
        look.beta = one.u.transpose() * readings(w);
        look.outside = outside(one, readings(w), look.beta);
      } else if (i > 0) {
        look.beta = tables_.outline(entry).rotated(look.within);
      }
      const Eigen::VectorXd exactly = this->left(entry, look, found.alphas);
      left(found.alphas) = exactly;
      found.left.assign(exactly.begin(), exactly.end());
      for (std::size_t k = 0; k < found.alphas.size(); ++k) {
        found.log.push_back(log_prior(found.alphas[k]) + log_likelihood(found.left[k]));
        best_ = std::max(best_, found.log.back());
      }
      found.beta = look.beta;
      found_.push_back(std::move(found));
    }
  }

  /// Of many readings what a window needs is what takes the time, not how many alphas it has. Of
  /// windows side by side one stands for the others.
  void thin_windows() {
    std::vector<double> all;
    for (const Found& found : found_)
      all.push_back(std::accumulate(found.log.begin(), found.log.end(), 0.0));
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::vector<double> few = few_of(all, order, most_);
    for (std::size_t k = 0; k < found_.size(); ++k)
      for (double& p : found_[k].log) p *= all[k] > 0.0 ? few[k] / all[k] : 0.0;
  }
  /// Of components as likely as one another: a mirrored frame's are the mirrored ones.
  void thin_components() {
    std::vector<double> all;
    for (const Found& found : found_) all.insert(all.end(), found.log.begin(), found.log.end());
    const auto likely = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](double p) { return p > 0.0; }));
    const std::vector<double> few =
        few_of(all, falling(all), std::max(most_, likely / least_thinned));
    auto next = few.begin();
    for (Found& found : found_)
      for (double& p : found.log) p = *next++;
  }

  [[nodiscard]] std::vector<LoadPrior::Part> likely() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& a, const Found& b) { return a.window < b.window; });
    double all = 0.0;
    for (Found& found : found_)
      for (double& log : found.log) all += log = std::exp(log - best_);
    for (Found& found : found_)
      for (double& p : found.log)
        if (p <= unlikely * all) p = 0.0;
    if (tables_.is_long())
      thin_windows();
    else
      thin_components();
    double whole = 0.0;
    for (const Found& found : found_)
      whole = std::accumulate(found.log.begin(), found.log.end(), whole);
    std::vector<LoadPrior::Part> parts;
    for (Found& found : found_) {
      LoadPrior::Part part{.entry = &tables_.entry(found.entry),
                           .window = &tables_.windows[found.window]};
      for (std::size_t i = 0; i < found.log.size(); ++i)
        if (found.log[i] > 0.0)
          part.sizes.push_back(
              {.at = found.alphas[i],
               .alpha = tables_.alphas(found.alphas[i]),
               .probability = found.log[i] / whole,
               .scale2 = std::isinf(known_) ? 1.0 : (known_ + found.left[i]) / degrees_});
      if (part.sizes.empty()) continue;
      if (tables_.is_long()) part.damped = tables_.outline(found.entry).damped(part.alphas());
      part.beta = std::move(found.beta);
      parts.push_back(std::move(part));
    }
    return parts;
  }

  const LoadPrior::Tables& tables_;
  double square_;
  double known_;
  double degrees_;
  double least_;
  std::size_t most_;
  std::vector<Eigen::VectorXd> reflected_{};  // g, of each reflection
  Eigen::MatrixXd left_{};                    // of each alpha that is looked at and each window: q
  double best_ = -std::numeric_limits<double>::infinity();  // log p
  std::vector<Found> found_{};
};

}  // namespace

std::vector<LoadPrior::Part> likely_parts(const LoadPrior::Tables& tables, const Eigen::VectorXd& g,
                                          double known, double least, std::size_t most) {
  return LikelyParts(tables, g, known, least, most).found();
}

}  // namespace tactile_net
