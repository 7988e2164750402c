#include "tactile_net/inverse/load_mixture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/load_tables.hpp"
#include "numeric/require.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

constexpr double least_sigma = 1e-14;         // over the largest reading: below is rounding
constexpr double deviations_from_zero = 5.0;  // of a ratio's denominator

/// Of Student's t with these degrees of freedom.
double student_variance(double degrees) {
  if (std::isinf(degrees)) return 1.0;
  return degrees > 2.0 ? degrees / (degrees - 2.0) : std::numeric_limits<double>::infinity();
}

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
      likely_parts(tables, g, known, noise.rms ? 0.0 : least_sigma * least_sigma));
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
    tables_->add(*part.window, tables_->details(*part.entry)->roots * filtered, all);
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
    const auto details = tables_->details(entry);
    const Eigen::MatrixXd all = tables_->sums(entry, tables_->inside(*part.window, sums));
    const Eigen::MatrixXd known = details->v.transpose() * all;
    const Eigen::MatrixXd rest = all - details->v * known;
    const Index inside_one = all.rows() / tables_->components;
    for (const LoadPrior::Part::Size& size : part.sizes) {
      const Eigen::VectorXd filtered = part.filtered(size.alpha);
      Eigen::MatrixXd model(model_share_ > 0.0 ? tables_->components : 0, all.cols());
      for (Index u = 0; u < model.rows(); ++u)
        model.row(u) = model_share_ *
                       (details->v.middleRows(u * inside_one, inside_one) * filtered).transpose() *
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
    const auto details = tables_->details(entry);
    const std::vector<Index>& columns = part.window->columns;
    const Eigen::MatrixXd squares = details->roots.cwiseAbs2();
    for (const LoadPrior::Part::Size& size : part.sizes) {
      Eigen::VectorXd means = Eigen::VectorXd::Zero(tables_->tractions_count());
      tables_->add(*part.window, sigma_ * (details->roots * part.filtered(size.alpha)), means);
      const Eigen::VectorXd variances =
          size.scale2 * (squares * (entry.gamma2.array() + size.alpha).inverse().matrix() +
                         details->hidden / size.alpha);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto column = static_cast<std::size_t>(columns[i]);
        const auto at = static_cast<Index>(i);
        all[column].push_back({.probability = size.probability,
                               .mean = means(columns[i]),
                               .scale = std::hypot(sigma_ * std::sqrt(variances(at)),
                                                   model_share_ * means(columns[i]))});
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
  const double spread = student_variance(degrees_);
  std::vector<Eigen::VectorXd> columns;
  const auto add = [&](const LoadPrior::Tables::Window& window, const Eigen::VectorXd& inside) {
    columns.emplace_back(Eigen::VectorXd::Zero(n));
    tables_->add(window, inside, columns.back());
  };
  for (const LoadPrior::Part& part : *parts_) {
    const LoadPrior::Tables::Entry& entry = *part.entry;
    const auto& window = *part.window;
    const auto details = tables_->details(entry);
    Eigen::VectorXd seen = Eigen::VectorXd::Zero(part.beta.size());
    double hidden = 0.0;
    for (const LoadPrior::Part::Size& size : part.sizes) {
      seen +=
          (size.probability * spread * size.scale2 * (entry.gamma2.array() + size.alpha).inverse())
              .matrix();
      hidden += size.probability * spread * size.scale2 / size.alpha;
      const Eigen::VectorXd means = details->roots * part.filtered(size.alpha);
      const double root = std::sqrt(size.probability);
      columns.emplace_back(-f);
      tables_->add(window, means, columns.back());
      columns.back() *= root;
      const Index own = means.size() / tables_->components;
      for (Index u = 0; u < tables_->components && model_share_ > 0.0; ++u) {
        Eigen::VectorXd of_component = Eigen::VectorXd::Zero(means.size());
        of_component.segment(u * own, own) = means.segment(u * own, own);
        add(window, of_component * (root * std::sqrt(spread) * model_share_));
      }
    }
    for (Index i = 0; i < seen.size(); ++i) add(window, details->roots.col(i) * std::sqrt(seen(i)));
    const Index own = details->v.rows();
    if (details->v.cols() == own) continue;
    const Eigen::MatrixXd rest = tables_->tractions(
        entry, Eigen::MatrixXd::Identity(own, own) - details->v * details->v.transpose());
    for (Index i = 0; i < own; ++i) add(window, rest.col(i) * std::sqrt(hidden));
  }
  Matrix root{static_cast<std::size_t>(n), columns.size(), {}};
  root.values.resize(root.rows * root.columns);
  Eigen::Map<RowMajor> s(root.values.data(), n, std::ssize(columns));
  for (Index i = 0; i < s.cols(); ++i)
    s.col(i) = columns[static_cast<std::size_t>(i)] * (sigma_ / noise_rms);
  return {std::move(root), used_};
}

LoadCovariance::LoadCovariance(LoadMixture mixture, std::span<const double> about, double noise_rms)
    : mixture_(std::move(mixture)), about_(about.begin(), about.end()), noise_rms_(noise_rms) {
  require_positive("noise_rms", noise_rms);
  check_tractions(about, static_cast<std::size_t>(mixture_.tables_->tractions_count()));
}

std::vector<double> LoadCovariance::deviations() const {
  std::vector<double> all;
  for (const Distribution& one : mixture_.of_tractions())
    all.push_back(std::hypot(one.deviation(), one.mean() - about_[all.size()]) / noise_rms_);
  return all;
}

double LoadCovariance::deviation(std::span<const double> weights) const {
  return deviations_of(std::array{std::vector<double>(weights.begin(), weights.end())}).front();
}

double LoadCovariance::covariance(std::span<const double> a, std::span<const double> b) const {
  return covariances(std::array{std::vector<double>(a.begin(), a.end()),
                                std::vector<double>(b.begin(), b.end())})(0, 1);
}

std::vector<double> LoadCovariance::deviations_of(
    std::span<const std::vector<double>> weights) const {
  const std::vector<Distribution> found = mixture_.of_each(weights);
  std::vector<double> all;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double about = as_eigen(std::span(weights[k])).dot(as_eigen(std::span(about_)));
    all.push_back(std::hypot(found[k].deviation(), found[k].mean() - about) / noise_rms_);
  }
  return all;
}

Matrix LoadCovariance::covariances(std::span<const std::vector<double>> weights) const {
  const std::size_t count = weights.size();
  Matrix all{count, count, std::vector<double>(count * count)};
  Eigen::VectorXd about(std::ssize(weights));
  for (std::size_t k = 0; k < count; ++k) {
    check_weights(weights[k], about_.size());
    about(static_cast<Index>(k)) =
        as_eigen(std::span(weights[k])).dot(as_eigen(std::span(about_))) / mixture_.sigma_;
  }
  const double spread = student_variance(mixture_.degrees_);
  const double unit = std::pow(mixture_.sigma_ / noise_rms_, 2);
  mixture_.each(weights, [&](const LoadMixture::Sums& sums) {
    const Eigen::VectorXd error = sums.means - about;
    for (Index a = 0; a < about.size(); ++a)
      for (Index b = 0; b < about.size(); ++b)
        all(static_cast<std::size_t>(a), static_cast<std::size_t>(b)) +=
            unit * sums.probability * (spread * sums.covariance(a, b) + error(a) * error(b));
  });
  return all;
}

}  // namespace tactile_net
