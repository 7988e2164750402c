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

void check_options(const LoadPriorOptions& options) {
  require_positive("depth", options.depth);
  require_positive("narrowest", options.narrowest);
  require(options.most_components > 0, "most_components", "be > 0",
          static_cast<double>(options.most_components));
  require(options.prior_power >= 0.0 && std::isfinite(options.prior_power), "prior_power",
          "be >= 0 and finite", options.prior_power);
}

/// Of Student's t with these degrees of freedom.
double student_variance(double degrees) {
  if (std::isinf(degrees)) return 1.0;
  return degrees > 2.0 ? degrees / (degrees - 2.0) : std::numeric_limits<double>::infinity();
}

}  // namespace

LoadWork load_work(const LinearProblem& problem, const LoadPriorOptions& options) {
  check_options(options);
  return LoadPrior::Tables(problem, options, LoadPrior::Tables::WindowsAlone{}).work();
}

LoadPrior::LoadPrior(const LinearProblem& problem, const LoadPriorOptions& options) {
  check_options(options);
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
  require(noise.reading_share >= 0.0 && std::isfinite(noise.reading_share), "the reading's share",
          "be >= 0 and finite", noise.reading_share);

  LoadMixture mixture(tables_);
  Eigen::VectorXd g = tables.weighting(readings);
  const double largest = g.cwiseAbs().maxCoeff();
  const double certain = noise.rms ? noise.reading_share * largest : 0.0;
  mixture.sigma_ =
      std::max(std::hypot(noise.rms.value_or(largest), certain), least_sigma * largest);
  if (!(mixture.sigma_ > 0.0)) mixture.sigma_ = 1.0;  // nothing was read, of an unknown noise
  g /= mixture.sigma_;
  const auto rows = static_cast<double>(tables.weighting.rows());
  // Nu; of a sum of two variances of which one is certain as Satterthwaite (1946) has it.
  const double known =
      noise.rms ? noise.degrees * std::pow(std::hypot(*noise.rms, certain) / *noise.rms, 4) : 0.0;
  mixture.degrees_ = known + rows;
  mixture.model_share_ = noise.model_share;
  auto parts = std::make_shared<const std::vector<Part>>(
      likely_parts(tables, g, known, noise.rms ? 0.0 : least_sigma * least_sigma,
                   tables.is_long() ? Tables::most_windows : tables.most_components));
  for (const Part& part : *parts)
    for (const Part::Size& size : part.sizes)
      mixture.used_ += size.probability * part.entry->used(size.at);
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
    Eigen::VectorXd probabilities(std::ssize(part.sizes));
    for (Index i = 0; i < probabilities.size(); ++i)
      probabilities(i) = part.sizes[static_cast<std::size_t>(i)].probability;
    const Eigen::VectorXd filtered = tables_->filtered(part) * probabilities;
    tables_->add(*part.window, tables_->details(*part.entry)->roots * filtered, all);
  }
  all *= sigma_;
  return {all.begin(), all.end()};
}

/// Of one window and weight: what it knows of the sums that it has a share in.
struct LoadSums::Piece {
  const LoadPrior::Part* part = nullptr;
  std::vector<Index> sums{};  // which of all
  Eigen::MatrixXd known{};    // what readings tell of each, a row each
  Eigen::MatrixXd rest{};     // and what none shows, a column each; without columns: nothing
  // Of each size a column.
  Eigen::RowVectorXd scale2{}, alphas{};
  Eigen::MatrixXd means{};               // of each sum a row
  std::vector<Eigen::MatrixXd> model{};  // what each component's factor may change of it
  Index first = 0;                       // component of the mixture

  /// Of two of the window's sums, for each size.
  [[nodiscard]] Eigen::RowVectorXd covariances(const LoadPrior::Tables& tables, Index a,
                                               Index b) const {
    Eigen::RowVectorXd all = tables.products(*part, known.row(a), known.row(b));
    if (rest.cols() > 0) all.array() += rest.col(a).dot(rest.col(b)) / alphas.array();
    all.array() *= scale2.array();
    for (const Eigen::MatrixXd& one : model) all += one.row(a).cwiseProduct(one.row(b));
    return all;
  }
  /// Of each sum, for each size.
  [[nodiscard]] Eigen::MatrixXd variances(const LoadPrior::Tables& tables) const {
    Eigen::MatrixXd all = tables.spreads(*part, known);
    if (rest.cols() > 0) all += rest.colwise().squaredNorm().transpose() * alphas.cwiseInverse();
    all.array().rowwise() *= scale2.array();
    for (const Eigen::MatrixXd& one : model) all += one.cwiseAbs2();
    return all;
  }
};

/// Of all components; zero where a window has no share in a sum.
struct LoadSums::Table {
  std::shared_ptr<const LoadPrior::Tables> tables{};
  std::shared_ptr<const std::vector<LoadPrior::Part>> parts{};
  double sigma = 1.0;
  double degrees = 0.0;
  std::vector<Piece> pieces{};
  Eigen::VectorXd probabilities{};
  // Of each sum a power of two near its largest weight: squares stay numbers in any unit.
  Eigen::RowVectorXd sizes{};
  // Over sigma and size, and over their squares: a column for each sum.
  Eigen::MatrixXd means{}, variances{};

  [[nodiscard]] Eigen::VectorXd covariances(Index a, Index b) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(probabilities.size());
    for (const Piece& piece : pieces) {
      const auto at = [&](Index sum) {
        return std::find(piece.sums.begin(), piece.sums.end(), sum) - piece.sums.begin();
      };
      const Index i = at(a);
      const Index j = at(b);
      if (std::max(i, j) < std::ssize(piece.sums))
        all.segment(piece.first, piece.alphas.size()) =
            piece.covariances(*tables, i, j).transpose();
    }
    return all;
  }
};

LoadSums::LoadSums(std::shared_ptr<const Table> table) : table_(std::move(table)) {}

std::size_t LoadSums::count() const noexcept {
  return static_cast<std::size_t>(table_->means.cols());
}

Distribution LoadSums::of(std::size_t sum) const {
  const auto at = static_cast<Index>(sum);
  const auto means = table_->means.col(at);
  const auto variances = table_->variances.col(at);
  const double size = table_->sigma * table_->sizes(at);
  std::vector<Distribution::Component> all;
  all.reserve(static_cast<std::size_t>(means.size()));
  double outside = 0.0;  // the probability that no window holds any of it
  for (Index c = 0; c < means.size(); ++c) {
    if (means(c) == 0.0 && variances(c) == 0.0)
      outside += table_->probabilities(c);
    else
      all.push_back({.probability = table_->probabilities(c),
                     .mean = size * means(c),
                     .scale = size * std::sqrt(variances(c))});
  }
  if (outside > 0.0) all.push_back({.probability = outside});
  return Distribution(std::move(all), table_->degrees);
}

std::optional<Distribution> LoadSums::ratio(std::size_t numerator, std::size_t denominator) const {
  const auto above = static_cast<Index>(numerator);
  const auto below = static_cast<Index>(denominator);
  const Distribution whole = of(denominator);
  if (!(std::abs(whole.mean()) > deviations_from_zero * whole.deviation())) return std::nullopt;
  const double sign = whole.mean() < 0.0 ? -1.0 : 1.0;
  const double size = table_->sizes(above) / table_->sizes(below);
  const Eigen::VectorXd covariances = table_->covariances(above, below);
  std::vector<Distribution::Component> ratios;
  for (Index c = 0; c < covariances.size(); ++c) {
    const double divisor = sign * table_->means(c, below);
    // A component in which the denominator changes its sign is one of the unlikely.
    if (!(divisor > 0.0)) continue;
    ratios.push_back({.probability = table_->probabilities(c),
                      .mean = size * sign * table_->means(c, above),
                      .scale = size * std::sqrt(table_->variances(c, above)),
                      .divisor = divisor,
                      .divisor_scale = std::sqrt(table_->variances(c, below)),
                      .covariance = size * covariances(c)});
  }
  return Distribution(std::move(ratios), table_->degrees);
}

LoadSums LoadMixture::sums(std::span<const std::vector<double>> weights) const {
  Eigen::MatrixXd all(tables_->tractions_count(), std::ssize(weights));
  Eigen::RowVectorXd sizes = Eigen::RowVectorXd::Ones(all.cols());
  for (Index k = 0; k < all.cols(); ++k) {
    const std::vector<double>& one = weights[static_cast<std::size_t>(k)];
    check_weights(one, static_cast<std::size_t>(all.rows()));
    all.col(k) = as_eigen(std::span(one));
    int exponent = 0;
    std::frexp(all.col(k).cwiseAbs().maxCoeff(), &exponent);
    sizes(k) = std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
  }
  all.array().rowwise() /= sizes.array();
  const auto count = static_cast<Index>(components());
  LoadSums::Table table{.tables = tables_,
                        .parts = parts_,
                        .sigma = sigma_,
                        .degrees = degrees_,
                        .probabilities = Eigen::VectorXd(count),
                        .sizes = std::move(sizes),
                        .means = Eigen::MatrixXd::Zero(count, all.cols()),
                        .variances = Eigen::MatrixXd::Zero(count, all.cols())};
  const LoadPrior::Tables::Window* window = nullptr;
  Eigen::MatrixXd inside;     // what the window holds of each sum that it has a share in
  std::vector<Index> shared;  // which these are
  Index first = 0;
  for (const LoadPrior::Part& part : *parts_) {
    if (part.window != window) {
      window = part.window;
      inside = tables_->inside(*window, all);
      shared.clear();
      for (Index k = 0; k < all.cols(); ++k)
        if ((inside.col(k).array() != 0.0).any()) shared.push_back(k);
      inside = inside(Eigen::indexing::all, shared).eval();
    }
    const auto details = tables_->details(*part.entry);
    const Index own = inside.rows() / tables_->components;
    const Eigen::MatrixXd filtered = tables_->filtered(part);
    LoadSums::Piece piece{.part = &part, .sums = shared, .first = first};
    piece.known = Eigen::MatrixXd::Zero(inside.cols(), details->roots.cols());
    piece.means = Eigen::MatrixXd::Zero(inside.cols(), filtered.cols());
    for (Index u = 0; u < tables_->components; ++u) {
      const Eigen::MatrixXd of_one =
          inside.middleRows(u * own, own).transpose() * details->roots.middleRows(u * own, own);
      const Eigen::MatrixXd means = of_one * filtered;
      piece.known += of_one;
      piece.means += means;
      if (model_share_ > 0.0) piece.model.emplace_back(model_share_ * means);
    }
    if (details->v.cols() < details->v.rows())
      piece.rest = tables_->sums(*part.entry, inside) - details->v * piece.known.transpose();
    piece.scale2.resize(filtered.cols());
    piece.alphas.resize(filtered.cols());
    for (Index i = 0; i < piece.alphas.size(); ++i) {
      const LoadPrior::Part::Size& size = part.sizes[static_cast<std::size_t>(i)];
      piece.scale2(i) = size.scale2;
      piece.alphas(i) = size.alpha;
      table.probabilities(first + i) = size.probability;
    }
    const auto here = Eigen::seqN(first, piece.alphas.size());
    table.means(here, shared) = piece.means.transpose();
    table.variances(here, shared) = piece.variances(*tables_).transpose();
    first += piece.alphas.size();
    table.pieces.push_back(std::move(piece));
  }
  return LoadSums(std::make_shared<const LoadSums::Table>(std::move(table)));
}

Distribution LoadMixture::of(std::span<const double> weights) const {
  return sums(std::array{std::vector<double>(weights.begin(), weights.end())}).of(0);
}

std::vector<Distribution> LoadMixture::of_each(std::span<const std::vector<double>> weights) const {
  const LoadSums all = sums(weights);
  std::vector<Distribution> result;
  result.reserve(all.count());
  for (std::size_t k = 0; k < all.count(); ++k) result.push_back(all.of(k));
  return result;
}

std::optional<Distribution> LoadMixture::ratio(std::span<const double> numerator,
                                               std::span<const double> denominator) const {
  return sums(std::array{std::vector<double>(numerator.begin(), numerator.end()),
                         std::vector<double>(denominator.begin(), denominator.end())})
      .ratio(0, 1);
}

std::vector<Distribution> LoadMixture::of_tractions() const {
  const auto count = static_cast<std::size_t>(tables_->tractions_count());
  std::vector<std::size_t> sizes(count);
  std::vector<double> outside(count, 1.0);  // the probability that no window holds it
  for (const LoadPrior::Part& part : *parts_)
    for (const Index column : part.window->columns) {
      sizes[static_cast<std::size_t>(column)] += part.sizes.size();
      for (const LoadPrior::Part::Size& size : part.sizes)
        outside[static_cast<std::size_t>(column)] -= size.probability;
    }
  std::vector<std::vector<Distribution::Component>> all(count);
  for (std::size_t i = 0; i < count; ++i) all[i].reserve(sizes[i] + 1);
  for (const LoadPrior::Part& part : *parts_) {
    const auto details = tables_->details(*part.entry);
    const Eigen::MatrixXd means = details->roots * tables_->filtered(part);
    const Eigen::MatrixXd seen = tables_->spreads(part, *details);
    const std::vector<double>& signs = tables_->reflections[part.window->reflection].tractions;
    const auto own = means.rows() / tables_->components;
    for (Index i = 0; i < means.rows(); ++i) {
      const double sign = signs[static_cast<std::size_t>(i / own)];
      auto& here = all[static_cast<std::size_t>(part.window->columns[static_cast<std::size_t>(i)])];
      for (Index a = 0; a < means.cols(); ++a) {
        const LoadPrior::Part::Size& size = part.sizes[static_cast<std::size_t>(a)];
        const double mean = means(i, a);
        const double variance = size.scale2 * (seen(i, a) + details->hidden(i) / size.alpha) +
                                model_share_ * mean * (model_share_ * mean);
        here.push_back({.probability = size.probability,
                        .mean = sigma_ * sign * mean,
                        .scale = sigma_ * std::sqrt(variance)});
      }
    }
  }
  std::vector<Distribution> result;
  result.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (outside[i] > unlikely) all[i].push_back({.probability = outside[i]});
    result.emplace_back(std::move(all[i]), degrees_);
  }
  return result;
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
  Eigen::RowVectorXd about(std::ssize(weights));
  for (std::size_t k = 0; k < count; ++k) {
    check_weights(weights[k], about_.size());
    about(static_cast<Index>(k)) =
        as_eigen(std::span(weights[k])).dot(as_eigen(std::span(about_))) / mixture_.sigma_;
  }
  const LoadSums sums = mixture_.sums(weights);
  const LoadSums::Table& known = *sums.table_;
  const double spread = student_variance(mixture_.degrees_);
  const double unit = std::pow(mixture_.sigma_ / noise_rms_, 2);
  about.array() /= known.sizes.array();
  const Eigen::MatrixXd errors = known.means.rowwise() - about;
  const auto at = [&](Index a, Index b) {
    const Eigen::VectorXd own = a == b ? known.variances.col(a) : known.covariances(a, b);
    return unit * known.sizes(a) * known.sizes(b) *
           known.probabilities.dot(spread * own + errors.col(a).cwiseProduct(errors.col(b)));
  };
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b)
      all(a, b) = all(b, a) = at(static_cast<Index>(a), static_cast<Index>(b));
  return all;
}

}  // namespace tactile_net
