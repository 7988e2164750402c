#include "tactile_net/inverse/load_mixture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "inverse/axis_waves.hpp"
#include "inverse/checks.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "inverse/weighting.hpp"
#include "inverse/window_places.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/require.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

/// Alphas that halve, of loads from a tenth of the noise up to what double precision still tells
/// from it.
constexpr Index mixture_alphas = 61;
constexpr double most_alpha = 64.0;    // over the largest gamma squared
constexpr double least_sigma = 1e-14;  // over the largest reading: below is rounding
constexpr double unlikely = 1e-6;      // a probability that is left out
/// Over the largest probability: of as many components as there are, all together are less than
/// a billionth.
constexpr double never_counted = 1e-15;
constexpr Index alphas_apart = 4;       // those at which every window is looked at
constexpr double least_outside = 1e-6;  // of |g|^2, told by a difference
constexpr std::array drag_weights = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
constexpr double deviations_from_zero = 5.0;  // of a ratio's denominator

/// T of a window, f = T c with |c|^2 the stabiliser: waves that end where the window does, each
/// over what (1 + (d/2)^2 Q) stretches it by.
class WindowCoordinates {
 public:
  WindowCoordinates(const LinearProblem& problem, const WindowPlace& place, double depth)
      : y_(waves(place.rows.count)), z_(waves(place.columns.count)) {
    const auto share = [depth](double spacing) { return std::pow(0.5 * depth / spacing, 2); };
    const auto rough = [](Index m, Index count) {
      return roughness(static_cast<std::size_t>(m), static_cast<std::size_t>(count),
                       Boundary::zero_beyond);
    };
    sizes_.resize(y_.cols() * z_.cols());
    for (Index m = 0; m < y_.cols(); ++m)
      for (Index n = 0; n < z_.cols(); ++n) {
        double stretch = 1.0 + share(problem.grid.spacing_y) * rough(m, y_.cols());
        if (!problem.is_line) stretch += share(problem.grid.spacing_z) * rough(n, z_.cols());
        sizes_(m * z_.cols() + n) = 1.0 / (std::sqrt(problem.measure) * stretch);
      }
  }

  /// Of one component.
  [[nodiscard]] Index count() const noexcept { return sizes_.size(); }

  /// T c of one component, column by column.
  [[nodiscard]] Eigen::MatrixXd tractions(const Eigen::Ref<const Eigen::MatrixXd>& c) const {
    Eigen::MatrixXd f = sizes_.asDiagonal() * c;
    for (Index i = 0; i < f.cols(); ++i) {
      Eigen::Map<RowMajor> cells(f.col(i).data(), y_.cols(), z_.cols());
      cells = (y_ * cells * z_.transpose()).eval();
    }
    return f;
  }
  /// T' f.
  [[nodiscard]] Eigen::MatrixXd sums(const Eigen::Ref<const Eigen::MatrixXd>& f) const {
    Eigen::MatrixXd c = f;
    for (Index i = 0; i < c.cols(); ++i) {
      Eigen::Map<RowMajor> cells(c.col(i).data(), y_.cols(), z_.cols());
      cells = (y_.transpose() * cells * z_).eval();
    }
    return sizes_.asDiagonal() * c;
  }

 private:
  static Eigen::MatrixXd waves(Index count) {
    const auto n = static_cast<std::size_t>(count);
    return axis_waves(n, n, Boundary::zero_beyond);
  }

  Eigen::MatrixXd y_, z_;
  Eigen::VectorXd sizes_;
};

}  // namespace

struct LoadPrior::Tables {
  /// Where a load may lie, with whatever tangential weight.
  struct Window {
    std::vector<Index> columns{};  // of K: the window's values, of each component
    WindowCoordinates coordinates;
    std::size_t first = 0, count = 0;  // entries, one of each weight, ascending
    Eigen::VectorXd most_log_prior{};  // of them, of each alpha
  };
  /// Of a window and a weight.
  struct Entry {
    std::size_t window = 0;
    double tangential_weight = 1.0;
    Eigen::MatrixXd u{}, v{};
    Eigen::MatrixXd roots{};   // T V, a row a value
    Eigen::VectorXd hidden{};  // the squares of what no reading shows of each value
    Eigen::VectorXd gamma{}, gamma2{};
    Eigen::VectorXd log_prior{};  // of each alpha, with the log of det(I - H)^(1/2)
  };

  Tables(const LinearProblem& problem, const LoadPriorOptions& options)
      : weighting(problem),
        components(static_cast<Index>(problem.components)),
        block(static_cast<Index>(problem.grid.count())) {
    const auto levels =
        window_levels(problem.grid, options.narrowest * options.depth, problem.is_line);
    const auto weights = problem.components == 1
                             ? std::span<const double>(drag_weights).subspan(1, 1)
                             : std::span<const double>(drag_weights);
    for (auto level = levels.rbegin(); level != levels.rend(); ++level)  // the whole surface first
      for (const WindowPlace& place : *level) {
        Window window{.coordinates = {problem, place, options.depth},
                      .first = entries.size(),
                      .count = weights.size(),
                      .most_log_prior = Eigen::VectorXd::Constant(
                          mixture_alphas, -std::numeric_limits<double>::infinity())};
        for (std::size_t u = 0; u < problem.components; ++u)
          for (Index row = place.rows.first; row < place.rows.first + place.rows.count; ++row)
            for (Index i = 0; i < place.columns.count; ++i)
              window.columns.push_back(static_cast<Index>(u) * block +
                                       row * static_cast<Index>(problem.grid.columns) +
                                       place.columns.first + i);
        windows.push_back(std::move(window));
        const double log_place = -std::log(static_cast<double>(level->size()));
        for (const double weight : weights)
          add(problem, weight, options.prior_power,
              problem.components == 1 ? log_place : log_place - negative_log_prior(weight));
      }
  }

  /// Of the last window.
  void add(const LinearProblem& problem, double weight, double prior_power, double log_prior) {
    const Window& window = windows.back();
    Entry entry{.window = windows.size() - 1, .tangential_weight = weight};
    const Eigen::MatrixXd kernel = as_eigen(problem.kernel)(Eigen::indexing::all, window.columns);
    const Svd parts =
        long_singular_value_decomposition(sums(window, weight, kernel.transpose()).transpose());
    entry.u = parts.u;
    entry.v = parts.v;
    entry.gamma = parts.values;
    entry.gamma2 = parts.values.cwiseAbs2();
    if (alphas.size() == 0) {
      if (!(entry.gamma(0) > 0.0)) throw std::invalid_argument(nothing_is_read);
      alphas.resize(mixture_alphas);
      for (Index a = 0; a < mixture_alphas; ++a)
        alphas(a) = entry.gamma2(0) * most_alpha * std::ldexp(1.0, -static_cast<int>(a));
    }
    const Index n = std::ssize(window.columns);
    entry.roots = tractions(window, weight, entry.v);
    entry.hidden = Eigen::VectorXd::Zero(n);
    if (entry.v.cols() < n) {
      const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - entry.v * entry.v.transpose();
      entry.hidden = tractions(window, weight, rest).rowwise().squaredNorm();
    }
    entry.log_prior.resize(mixture_alphas);
    for (Index a = 0; a < mixture_alphas; ++a) {
      entry.log_prior(a) = 0.5 * (alphas(a) / (entry.gamma2.array() + alphas(a))).log().sum() +
                           log_prior - prior_power * std::log(2.0) * static_cast<double>(a);
    }
    windows.back().most_log_prior = windows.back().most_log_prior.cwiseMax(entry.log_prior);
    entries.push_back(std::move(entry));
  }

  /// T c of all components: the tangential ones are as much smaller as they weigh more.
  [[nodiscard]] Eigen::MatrixXd tractions(const Window& window, double weight,
                                          const Eigen::MatrixXd& c) const {
    return of_each(window, weight, c, &WindowCoordinates::tractions);
  }
  /// T' f.
  [[nodiscard]] Eigen::MatrixXd sums(const Window& window, double weight,
                                     const Eigen::MatrixXd& f) const {
    return of_each(window, weight, f, &WindowCoordinates::sums);
  }
  [[nodiscard]] Eigen::MatrixXd of_each(const Window& window, double weight,
                                        const Eigen::MatrixXd& columns, auto map) const {
    const Index n = window.coordinates.count();
    Eigen::MatrixXd all(columns.rows(), columns.cols());
    for (Index u = 0; u < components; ++u)
      all.middleRows(u * n, n) = (window.coordinates.*map)(columns.middleRows(u * n, n)) /
                                 stabiliser_weight(static_cast<std::size_t>(u), weight);
    return all;
  }

  [[nodiscard]] Index tractions_count() const noexcept { return components * block; }

  Weighting weighting;
  Index components;
  Index block;  // values of one component
  Eigen::VectorXd alphas{};
  std::vector<Window> windows{};  // the whole surface first
  std::vector<Entry> entries{};   // window after window
};

/// What a frame makes of an entry.
struct LoadPrior::Part {
  const Tables::Entry* entry = nullptr;
  Eigen::VectorXd beta{};  // over sigma
  struct Size {
    double alpha = 0.0;
    double probability = 0.0;
    double scale2 = 1.0;  // of variances: (nu + q) / (nu + rows)
  };
  std::vector<Size> sizes{};  // those that are likely

  /// What each component of the decomposition is filtered to.
  [[nodiscard]] Eigen::VectorXd filtered(double alpha) const {
    return entry->gamma.array() / (entry->gamma2.array() + alpha) * beta.array();
  }
};

namespace {

/// The likely components of a frame, found without a look at most of the others.
///
/// Each term of q, alpha beta^2 / (gamma^2 + alpha), rises with alpha and is concave in it: between
/// two alphas q lies above its chord. And q = g'(I + K C K' / alpha)^-1 g rises with the tangential
/// weight, as C falls: what it is for one weight bounds it for those above. The rest of log p is in
/// tables, so that a few alphas of the least weight say how likely a window may be at most.
class LikelyParts {
 public:
  /// @param g      over sigma
  /// @param known  nu
  /// @param least  q is not less
  LikelyParts(const LoadPrior::Tables& tables, const Eigen::VectorXd& g, double known, double least)
      : tables_(tables),
        g_(g),
        square_(g.squaredNorm()),
        known_(known),
        degrees_(known + static_cast<double>(tables.weighting.rows())),
        least_(least) {}

  /// Probabilities that sum to 1, window after window.
  [[nodiscard]] std::vector<LoadPrior::Part> found() {
    std::vector<Look> looks;
    looks.reserve(tables_.windows.size());
    for (std::size_t w = 0; w < tables_.windows.size(); ++w) looks.push_back(look_at(w));
    std::vector<std::size_t> order(looks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return looks[a].most > looks[b].most; });
    for (const std::size_t w : order) {
      if (!(looks[w].most > best_ + std::log(never_counted))) break;
      look_closely(std::move(looks[w]));
    }
    return likely();
  }

 private:
  struct Look {
    std::size_t window = 0;
    Eigen::VectorXd beta{}, square{};
    double outside = 0.0;    // what of |g|^2 no traction in the window explains
    Eigen::VectorXd left{};  // q of each alpha, or less
    double most = 0.0;       // of log p
  };
  struct Found {
    std::size_t entry = 0;
    Eigen::VectorXd beta{};
    std::vector<Index> alphas{};
    std::vector<double> left{}, log{};
  };

  void project(const LoadPrior::Tables::Entry& entry, Look& look) const {
    look.beta = entry.u.transpose() * g_;
    look.square = look.beta.cwiseAbs2();
    look.outside = square_ - look.square.sum();
    // A difference of squares has its own rounding: seen where little is left.
    if (look.outside < least_outside * square_)
      look.outside = (g_ - entry.u * look.beta).squaredNorm();
  }
  [[nodiscard]] double left(const LoadPrior::Tables::Entry& entry, const Look& look,
                            Index a) const {
    const double alpha = tables_.alphas(a);
    return std::max(
        least_,
        look.outside + (alpha * look.square.array() / (entry.gamma2.array() + alpha)).sum());
  }
  [[nodiscard]] double log_likelihood(double q) const {
    return std::isinf(known_) ? -0.5 * q : -0.5 * degrees_ * std::log(known_ + q);
  }

  [[nodiscard]] Look look_at(std::size_t w) const {
    const LoadPrior::Tables::Window& window = tables_.windows[w];
    const LoadPrior::Tables::Entry& entry = tables_.entries[window.first];
    Look look{.window = w};
    project(entry, look);
    look.left.resize(mixture_alphas);
    look.left(0) = left(entry, look, 0);
    for (Index a = alphas_apart; a < mixture_alphas; a += alphas_apart) {
      look.left(a) = left(entry, look, a);
      for (Index i = a - alphas_apart + 1; i < a; ++i) {
        const double share = (tables_.alphas(i) - tables_.alphas(a)) /
                             (tables_.alphas(a - alphas_apart) - tables_.alphas(a));
        look.left(i) = (1.0 - share) * look.left(a) + share * look.left(a - alphas_apart);
      }
    }
    look.most = -std::numeric_limits<double>::infinity();
    for (Index a = 0; a < mixture_alphas; ++a)
      look.most = std::max(look.most, window.most_log_prior(a) + log_likelihood(look.left(a)));
    return look;
  }

  void look_closely(Look look) {
    const LoadPrior::Tables::Window& window = tables_.windows[look.window];
    for (std::size_t e = window.first; e < window.first + window.count; ++e) {
      const LoadPrior::Tables::Entry& entry = tables_.entries[e];
      Found found{.entry = e};
      for (Index a = 0; a < mixture_alphas; ++a)
        if (entry.log_prior(a) + log_likelihood(look.left(a)) > best_ + std::log(never_counted))
          found.alphas.push_back(a);
      if (found.alphas.empty()) continue;
      if (e > window.first) project(entry, look);
      for (const Index a : found.alphas) {
        look.left(a) = left(entry, look, a);
        found.left.push_back(look.left(a));
        found.log.push_back(entry.log_prior(a) + log_likelihood(look.left(a)));
        best_ = std::max(best_, found.log.back());
      }
      found.beta = look.beta;
      found_.push_back(std::move(found));
    }
  }

  [[nodiscard]] std::vector<LoadPrior::Part> likely() {
    std::sort(found_.begin(), found_.end(),
              [](const Found& a, const Found& b) { return a.entry < b.entry; });
    double all = 0.0;
    for (Found& found : found_)
      for (double& log : found.log) all += log = std::exp(log - best_);
    double kept = 0.0;
    for (const Found& found : found_)
      for (const double p : found.log)
        if (p > unlikely * all) kept += p;
    std::vector<LoadPrior::Part> parts;
    for (Found& found : found_) {
      LoadPrior::Part part{.entry = &tables_.entries[found.entry], .beta = std::move(found.beta)};
      for (std::size_t i = 0; i < found.log.size(); ++i)
        if (found.log[i] > unlikely * all)
          part.sizes.push_back(
              {.alpha = tables_.alphas(found.alphas[i]),
               .probability = found.log[i] / kept,
               .scale2 = std::isinf(known_) ? 1.0 : (known_ + found.left[i]) / degrees_});
      if (!part.sizes.empty()) parts.push_back(std::move(part));
    }
    return parts;
  }

  const LoadPrior::Tables& tables_;
  const Eigen::VectorXd& g_;
  double square_;
  double known_;
  double degrees_;
  double least_;
  double best_ = -std::numeric_limits<double>::infinity();  // log p
  std::vector<Found> found_{};
};

}  // namespace

LoadPrior::LoadPrior(const LinearProblem& problem, const LoadPriorOptions& options) {
  require_positive("depth", options.depth);
  require_positive("narrowest", options.narrowest);
  require(options.prior_power >= 0.0 && std::isfinite(options.prior_power), "prior_power",
          "be >= 0 and finite", options.prior_power);
  tables_ = std::make_shared<const Tables>(problem, options);
}

std::size_t LoadPrior::count() const noexcept { return tables_->windows.size(); }

LoadMixture LoadPrior::given(std::span<const double> readings, const LoadNoise& noise) const {
  const Tables& tables = *tables_;
  check_readings(readings, static_cast<std::size_t>(tables.weighting.size()));
  if (noise.rms) require_positive("the noise's rms", *noise.rms);
  require(noise.degrees > 0.0, "the noise's degrees", "be > 0", noise.degrees);
  require(noise.model_share >= 0.0 && std::isfinite(noise.model_share), "the model's share",
          "be >= 0 and finite", noise.model_share);

  LoadMixture mixture(tables_);
  Eigen::VectorXd g = tables.weighting(readings);
  const double largest = g.cwiseAbs().maxCoeff();
  mixture.sigma_ = std::max(noise.rms.value_or(largest), least_sigma * largest);
  if (!(mixture.sigma_ > 0.0)) mixture.sigma_ = 1.0;  // nothing was read, of an unknown noise
  g /= mixture.sigma_;
  const auto rows = static_cast<double>(tables.weighting.rows());
  const double known = noise.rms ? noise.degrees : 0.0;  // nu
  mixture.degrees_ = known + rows;
  mixture.model_share_ = noise.model_share;
  auto parts = std::make_shared<const std::vector<Part>>(
      LikelyParts(tables, g, known, noise.rms ? 0.0 : least_sigma * least_sigma).found());
  for (const Part& part : *parts)
    for (const Part::Size& size : part.sizes)
      mixture.used_ +=
          size.probability *
          (part.entry->gamma2.array() / (part.entry->gamma2.array() + size.alpha)).sum();
  mixture.parts_ = std::move(parts);
  return mixture;
}

LoadMixture::LoadMixture(std::shared_ptr<const LoadPrior::Tables> tables)
    : tables_(std::move(tables)) {}

std::size_t LoadMixture::components() const noexcept {
  std::size_t all = 0;
  for (const LoadPrior::Part& part : *parts_) all += part.sizes.size();
  return all;
}

double LoadMixture::alpha_quantile(double p) const {
  require(p > 0.0 && p < 1.0, "p", "lie between 0 and 1", p);
  std::map<double, double> by_alpha;
  for (const LoadPrior::Part& part : *parts_)
    for (const LoadPrior::Part::Size& size : part.sizes) by_alpha[size.alpha] += size.probability;
  double below = 0.0;
  for (const auto& [alpha, probability] : by_alpha)
    if ((below += probability) >= p) return alpha;
  return by_alpha.rbegin()->first;
}

std::vector<double> LoadMixture::mean() const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(tables_->tractions_count());
  for (const LoadPrior::Part& part : *parts_) {
    Eigen::VectorXd filtered = Eigen::VectorXd::Zero(part.beta.size());
    for (const LoadPrior::Part::Size& size : part.sizes)
      filtered += size.probability * part.filtered(size.alpha);
    all(tables_->windows[part.entry->window].columns) += part.entry->roots * filtered;
  }
  all *= sigma_;
  return {all.begin(), all.end()};
}

struct LoadMixture::Sums {
  double probability;
  const LoadPrior::Part::Size& size;
  Eigen::VectorXd means;
  const Eigen::MatrixXd& known;  // what readings tell of each sum, a column each
  const Eigen::MatrixXd& rest;   // and what none shows
  Eigen::VectorXd over;          // 1 / (gamma^2 + alpha)
  Eigen::MatrixXd model;         // what each traction component's factor may change, a row each

  [[nodiscard]] double covariance(Index a, Index b) const {
    return size.scale2 * (known.col(a).cwiseProduct(over).dot(known.col(b)) +
                          rest.col(a).dot(rest.col(b)) / size.alpha) +
           model.col(a).dot(model.col(b));
  }
  [[nodiscard]] double scale(Index a) const { return std::sqrt(covariance(a, a)); }
};

template <class Take>
void LoadMixture::each(std::span<const std::vector<double>> weights, const Take& take) const {
  Eigen::MatrixXd sums(tables_->tractions_count(), std::ssize(weights));
  for (Index k = 0; k < sums.cols(); ++k) {
    const std::vector<double>& one = weights[static_cast<std::size_t>(k)];
    check_weights(one, static_cast<std::size_t>(sums.rows()));
    sums.col(k) = as_eigen(std::span(one));
  }
  for (const LoadPrior::Part& part : *parts_) {
    const LoadPrior::Tables::Entry& entry = *part.entry;
    const auto& window = tables_->windows[entry.window];
    const Eigen::MatrixXd inside = sums(window.columns, Eigen::indexing::all);
    const Eigen::MatrixXd all = tables_->sums(window, entry.tangential_weight, inside);
    const Eigen::MatrixXd known = entry.v.transpose() * all;
    const Eigen::MatrixXd rest = all - entry.v * known;
    const Index inside_one = window.coordinates.count();
    for (const LoadPrior::Part::Size& size : part.sizes) {
      const Eigen::VectorXd filtered = part.filtered(size.alpha);
      Eigen::MatrixXd model(model_share_ > 0.0 ? tables_->components : 0, all.cols());
      for (Index u = 0; u < model.rows(); ++u)
        model.row(u) = model_share_ *
                       (entry.v.middleRows(u * inside_one, inside_one) * filtered).transpose() *
                       all.middleRows(u * inside_one, inside_one);
      take(Sums{.probability = size.probability,
                .size = size,
                .means = known.transpose() * filtered,
                .known = known,
                .rest = rest,
                .over = (entry.gamma2.array() + size.alpha).inverse(),
                .model = std::move(model)});
    }
  }
}

Distribution LoadMixture::of(std::span<const double> weights) const {
  return of_each(std::array{std::vector<double>(weights.begin(), weights.end())}).front();
}

std::vector<Distribution> LoadMixture::of_each(std::span<const std::vector<double>> weights) const {
  std::vector<std::vector<Distribution::Component>> all(weights.size());
  each(weights, [&](const Sums& sums) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto at = static_cast<Index>(k);
      all[k].push_back({.probability = sums.probability,
                        .mean = sigma_ * sums.means(at),
                        .scale = sigma_ * sums.scale(at)});
    }
  });
  std::vector<Distribution> result;
  result.reserve(all.size());
  for (auto& one : all) result.emplace_back(std::move(one), degrees_);
  return result;
}

std::vector<Distribution> LoadMixture::of_tractions() const {
  std::vector<std::vector<Distribution::Component>> all(
      static_cast<std::size_t>(tables_->tractions_count()));
  std::vector<double> outside(all.size(), 1.0);  // the probability that no window holds it
  for (const LoadPrior::Part& part : *parts_) {
    const LoadPrior::Tables::Entry& entry = *part.entry;
    const std::vector<Index>& columns = tables_->windows[entry.window].columns;
    const Eigen::MatrixXd squares = entry.roots.cwiseAbs2();
    for (const LoadPrior::Part::Size& size : part.sizes) {
      const Eigen::VectorXd means = sigma_ * (entry.roots * part.filtered(size.alpha));
      const Eigen::VectorXd variances =
          size.scale2 * (squares * (entry.gamma2.array() + size.alpha).inverse().matrix() +
                         entry.hidden / size.alpha);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto column = static_cast<std::size_t>(columns[i]);
        const auto at = static_cast<Index>(i);
        all[column].push_back(
            {.probability = size.probability,
             .mean = means(at),
             .scale = std::hypot(sigma_ * std::sqrt(variances(at)), model_share_ * means(at))});
        outside[column] -= size.probability;
      }
    }
  }
  std::vector<Distribution> result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (outside[i] > unlikely) all[i].push_back({.probability = outside[i]});
    result.emplace_back(std::move(all[i]), degrees_);
  }
  return result;
}

std::optional<Distribution> LoadMixture::ratio(std::span<const double> numerator,
                                               std::span<const double> denominator) const {
  const std::array both{std::vector<double>(numerator.begin(), numerator.end()),
                        std::vector<double>(denominator.begin(), denominator.end())};
  std::vector<Distribution::Component> ratios;
  std::vector<Distribution::Component> denominators;
  each(both, [&](const Sums& sums) {
    denominators.push_back(
        {.probability = sums.probability, .mean = sums.means(1), .scale = sums.scale(1)});
    ratios.push_back({.probability = sums.probability,
                      .mean = sums.means(0),
                      .scale = sums.scale(0),
                      .divisor = sums.means(1),
                      .divisor_scale = sums.scale(1),
                      .covariance = sums.covariance(0, 1)});
  });
  const Distribution whole(denominators, degrees_);
  if (!(std::abs(whole.mean()) > deviations_from_zero * whole.deviation())) return std::nullopt;
  if (whole.mean() < 0.0)
    for (Distribution::Component& one : ratios) {
      one.mean = -one.mean;
      one.divisor = -one.divisor;
    }
  // A component in which the denominator changes its sign is one of the unlikely.
  std::erase_if(ratios, [](const auto& one) { return !(one.divisor > 0.0); });
  return Distribution(std::move(ratios), degrees_);
}

RootCovariance LoadMixture::covariance(std::span<const double> about, double noise_rms) const {
  require_positive("noise_rms", noise_rms);
  const Index n = tables_->tractions_count();
  check_tractions(about, static_cast<std::size_t>(n));
  const Eigen::VectorXd f = as_eigen(about) / sigma_;
  const double spread = std::isinf(degrees_) ? 1.0
                        : degrees_ > 2.0     ? degrees_ / (degrees_ - 2.0)
                                             : std::numeric_limits<double>::infinity();
  std::vector<Eigen::VectorXd> columns;
  const auto add = [&](const std::vector<Index>& places, const Eigen::VectorXd& inside) {
    columns.emplace_back(Eigen::VectorXd::Zero(n));
    columns.back()(places) = inside;
  };
  for (const LoadPrior::Part& part : *parts_) {
    const LoadPrior::Tables::Entry& entry = *part.entry;
    const auto& window = tables_->windows[entry.window];
    Eigen::VectorXd seen = Eigen::VectorXd::Zero(part.beta.size());
    double hidden = 0.0;
    for (const LoadPrior::Part::Size& size : part.sizes) {
      seen +=
          (size.probability * spread * size.scale2 * (entry.gamma2.array() + size.alpha).inverse())
              .matrix();
      hidden += size.probability * spread * size.scale2 / size.alpha;
      const Eigen::VectorXd means = entry.roots * part.filtered(size.alpha);
      const double root = std::sqrt(size.probability);
      columns.emplace_back(-f);
      columns.back()(window.columns) += means;
      columns.back() *= root;
      const Index own = window.coordinates.count();
      for (Index u = 0; u < tables_->components && model_share_ > 0.0; ++u) {
        Eigen::VectorXd of_component = Eigen::VectorXd::Zero(means.size());
        of_component.segment(u * own, own) = means.segment(u * own, own);
        add(window.columns, of_component * (root * std::sqrt(spread) * model_share_));
      }
    }
    for (Index i = 0; i < seen.size(); ++i)
      add(window.columns, entry.roots.col(i) * std::sqrt(seen(i)));
    const Index own = entry.v.rows();
    if (entry.v.cols() == own) continue;
    const Eigen::MatrixXd rest =
        tables_->tractions(window, entry.tangential_weight,
                           Eigen::MatrixXd::Identity(own, own) - entry.v * entry.v.transpose());
    for (Index i = 0; i < own; ++i) add(window.columns, rest.col(i) * std::sqrt(hidden));
  }
  Matrix root{static_cast<std::size_t>(n), columns.size(), {}};
  root.values.resize(root.rows * root.columns);
  Eigen::Map<RowMajor> s(root.values.data(), n, std::ssize(columns));
  for (Index i = 0; i < s.cols(); ++i)
    s.col(i) = columns[static_cast<std::size_t>(i)] * (sigma_ / noise_rms);
  return {std::move(root), used_};
}

}  // namespace tactile_net
