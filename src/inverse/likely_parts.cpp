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
constexpr Index looked_apart = LoadPrior::Tables::looked_apart;

/// At most so many of these probabilities, others 0, that on average say the same: the large ones
/// are as they are, of the small ones some stand for those about them, all with one probability
/// (the optimal resampling of Fearnhead and Clifford 2003). Which ones no readings' noise decides:
/// one of each stretch of that probability, as far along as the golden section's multiples are.
std::vector<double> few_of(const std::vector<double>& all, std::size_t most) {
  const auto some = static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [](double p) { return p > 0.0; }));
  if (some <= most) return all;
  std::vector<double> falling = all;
  std::sort(falling.begin(), falling.end(), std::greater<>());
  double rest = std::accumulate(falling.begin(), falling.end(), 0.0);
  std::size_t large = 0;
  while (large + 1 < most && falling[large] * static_cast<double>(most - large) > rest)
    rest -= falling[large++];
  const double each = rest / static_cast<double>(most - large);
  std::vector<double> few(all.size(), 0.0);
  double passed = 0.0;
  double section = 0.5;
  double next = section;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
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
    for (const LoadPrior::Tables::Shape& shape : tables_.shapes) look_at(shape, looks);
    std::vector<std::size_t> order(looks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return looks[a].most > looks[b].most; });
    for (const std::size_t w : order) {
      if (!(looks[w].most > best_ + std::log(never_counted))) break;
      look_closely(w, std::move(looks[w]));
    }
    return likely();
  }

 private:
  /// A window's readings onto what its tractions make of them.
  struct Look {
    Eigen::VectorXd within{};  // by an outline: before a weight's matrix rotates them
    Eigen::VectorXd beta{}, square{};
    double outside = 0.0;    // what of |g|^2 no traction in the window explains
    Eigen::VectorXd left{};  // q of each alpha, or less
    double most = 0.0;       // of log p
  };
  struct Found {
    std::size_t window = 0, entry = 0;
    Eigen::VectorXd beta{};
    std::vector<Index> alphas{};
    std::vector<double> left{}, log{};
  };

  [[nodiscard]] const Eigen::VectorXd& readings(std::size_t window) const {
    return reflected_[tables_.windows[window].reflection];
  }
  void project(const LoadPrior::Tables::Entry& entry, std::size_t window, Look& look) const {
    const Eigen::VectorXd& g = readings(window);
    look.beta = entry.u.transpose() * g;
    look.square = look.beta.cwiseAbs2();
    look.outside = square_ - look.square.sum();
    // A difference of squares has its own rounding: seen where little is left.
    if (look.outside < least_outside * square_)
      look.outside = (g - entry.u * look.beta).squaredNorm();
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
      for (Index i = 0; i < inside.size(); ++i)
        inside(i) = (alphas(i) * look.square.array() / (gamma2.array() + alphas(i))).sum();
    }
    return (inside.array() + look.outside).max(least_);
  }
  [[nodiscard]] double log_likelihood(double q) const {
    return std::isinf(known_) ? -0.5 * q : -0.5 * degrees_ * std::log(known_ + q);
  }

  /// At all windows of a shape.
  void look_at(const LoadPrior::Tables::Shape& shape, std::vector<Look>& looks) const {
    const Index count = tables_.alphas.size();
    for (const std::size_t w : shape.windows) looks[w].left.resize(count);
    const auto looked_at = Eigen::seq(Index{0}, count - 1, Eigen::fix<looked_apart>);
    if (tables_.is_long()) {
      Eigen::MatrixXd g(reflected_.front().size(), std::ssize(shape.windows));
      for (Index k = 0; k < g.cols(); ++k)
        g.col(k) = readings(shape.windows[static_cast<std::size_t>(k)]);
      const LoadPrior::Tables::Outline& outline = tables_.outline(shape.first);
      const auto seen = shape.range->coordinates(g);
      const Eigen::MatrixXd rotated = outline.rotated(seen.within);
      const Eigen::MatrixXd left = outline.looks->left(rotated);
      for (Index k = 0; k < g.cols(); ++k) {
        Look& look = looks[shape.windows[static_cast<std::size_t>(k)]];
        look.outside = seen.outside(k);
        look.within = seen.within.col(k);
        look.beta = rotated.col(k);
        look.left(looked_at) = (left.col(k).array() + look.outside).max(least_);
      }
    } else {
      std::vector<Index> at;
      for (Index a = 0; a < count; a += looked_apart) at.push_back(a);
      for (const std::size_t w : shape.windows) {
        project(tables_.entry(shape.first), w, looks[w]);
        looks[w].left(looked_at) = left(shape.first, looks[w], at);
      }
    }
    for (const std::size_t w : shape.windows) {
      Look& look = looks[w];
      for (Index a = looked_apart; a < count; a += looked_apart)
        for (Index i = a - looked_apart + 1; i < a; ++i) {
          const double share = (tables_.alphas(i) - tables_.alphas(a)) /
                               (tables_.alphas(a - looked_apart) - tables_.alphas(a));
          look.left(i) = (1.0 - share) * look.left(a) + share * look.left(a - looked_apart);
        }
      look.most = -std::numeric_limits<double>::infinity();
      for (Index a = 0; a < count; ++a)
        look.most = std::max(look.most, shape.most_log_prior(a) + log_likelihood(look.left(a)));
    }
  }

  void look_closely(std::size_t w, Look look) {
    const LoadPrior::Tables::Shape& shape = tables_.shapes[tables_.windows[w].shape];
    for (std::size_t i = 0; i < tables_.tangential_weights.size(); ++i) {
      const std::size_t entry = shape.first + i;
      const Eigen::VectorXd& log_prior = tables_.entry(entry).log_prior;
      Found found{.window = w, .entry = entry};
      for (Index a = 0; a < tables_.alphas.size(); ++a)
        if (log_prior(a) + log_likelihood(look.left(a)) > best_ + std::log(never_counted))
          found.alphas.push_back(a);
      if (found.alphas.empty()) continue;
      if (i > 0 && tables_.is_long())
        look.beta = tables_.outline(entry).rotated(look.within);
      else if (i > 0)
        project(tables_.entry(entry), w, look);
      const Eigen::VectorXd exactly = left(entry, look, found.alphas);
      look.left(found.alphas) = exactly;
      found.left.assign(exactly.begin(), exactly.end());
      for (std::size_t k = 0; k < found.alphas.size(); ++k) {
        found.log.push_back(log_prior(found.alphas[k]) + log_likelihood(found.left[k]));
        best_ = std::max(best_, found.log.back());
      }
      found.beta = look.beta;
      found_.push_back(std::move(found));
    }
  }

  [[nodiscard]] std::vector<LoadPrior::Part> likely() {
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& a, const Found& b) { return a.window < b.window; });
    double all = 0.0;
    for (Found& found : found_)
      for (double& log : found.log) all += log = std::exp(log - best_);
    std::vector<double> kept;
    for (const Found& found : found_) {
      kept.push_back(0.0);
      for (const double p : found.log)
        if (p > unlikely * all) kept.back() += p;
    }
    const std::vector<double> answering = few_of(kept, most_);
    const double whole = std::accumulate(answering.begin(), answering.end(), 0.0);
    std::vector<LoadPrior::Part> parts;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      Found& found = found_[k];
      if (answering[k] == 0.0) continue;
      LoadPrior::Part part{.window = &tables_.windows[found.window]};
      for (std::size_t i = 0; i < found.log.size(); ++i)
        if (found.log[i] > unlikely * all)
          part.sizes.push_back(
              {.at = found.alphas[i],
               .alpha = tables_.alphas(found.alphas[i]),
               .probability = found.log[i] / kept[k] * (answering[k] / whole),
               .scale2 = std::isinf(known_) ? 1.0 : (known_ + found.left[i]) / degrees_});
      part.entry = &tables_.entry(found.entry);
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
  std::vector<Eigen::VectorXd> reflected_{};                // g, of each reflection
  double best_ = -std::numeric_limits<double>::infinity();  // log p
  std::vector<Found> found_{};
};

}  // namespace

std::vector<LoadPrior::Part> likely_parts(const LoadPrior::Tables& tables, const Eigen::VectorXd& g,
                                          double known, double least, std::size_t most) {
  return LikelyParts(tables, g, known, least, most).found();
}

}  // namespace tactile_net
