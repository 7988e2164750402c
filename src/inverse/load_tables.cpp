#include "inverse/load_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "inverse/axis_waves.hpp"
#include "inverse/checks.hpp"
#include "inverse/mirror_classes.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "numeric/decompositions.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"

namespace tactile_net {

using Eigen::Index;

namespace {

/// Alphas that halve, of loads from a tenth of the noise up to what double precision still tells
/// from it.
constexpr Index mixture_alphas = 61;
constexpr double most_alpha = 64.0;  // over the largest gamma squared
/// Over the least alpha: what has a lesser gamma squared no reading shows. Where noise is as much
/// as a millionth of the readings that changes no variance by more than 1e-9.
constexpr double least_gamma2 = 1e-8;
constexpr std::array drag_weights = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
/// Bands of forces and drags of a skin are as wide with these as with those, and hold as often.
constexpr std::array skin_weights = {0.5, 2.0, 8.0};
constexpr double least_difference = 1e-5;  // of two squares, over the larger one

}  // namespace

WindowCoordinates::WindowCoordinates(const LinearProblem& problem, const WindowPlace& place,
                                     double depth) {
  const auto waves = [](Index count) {
    const auto n = static_cast<std::size_t>(count);
    return axis_waves(n, n, Boundary::zero_beyond);
  };
  y_ = waves(place.rows.count);
  z_ = waves(place.columns.count);
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

Eigen::MatrixXd WindowCoordinates::tractions(const Eigen::Ref<const Eigen::MatrixXd>& c) const {
  Eigen::MatrixXd f = sizes_.asDiagonal() * c;
  for (Index i = 0; i < f.cols(); ++i) {
    Eigen::Map<RowMajor> cells(f.col(i).data(), y_.cols(), z_.cols());
    cells = (y_ * cells * z_.transpose()).eval();
  }
  return f;
}

Eigen::MatrixXd WindowCoordinates::sums(const Eigen::Ref<const Eigen::MatrixXd>& f) const {
  Eigen::MatrixXd c = f;
  for (Index i = 0; i < c.cols(); ++i) {
    Eigen::Map<RowMajor> cells(c.col(i).data(), y_.cols(), z_.cols());
    cells = (y_.transpose() * cells * z_).eval();
  }
  return sizes_.asDiagonal() * c;
}

Eigen::VectorXd WindowCoordinates::squares() const {
  Eigen::VectorXd all = sizes_.cwiseAbs2();
  Eigen::Map<RowMajor> cells(all.data(), y_.cols(), z_.cols());
  cells = (y_.cwiseAbs2() * cells * z_.cwiseAbs2().transpose()).eval();
  return all;
}

LoadPrior::Tables::Tables(const LinearProblem& problem, const LoadPriorOptions& options)
    : weighting(problem),
      components(static_cast<Index>(problem.components)),
      block(static_cast<Index>(problem.grid.count())),
      kernel_(as_eigen(problem.kernel)) {
  if (problem.components == 1)
    tangential_weights = {1.0};
  else if (problem.is_line)
    tangential_weights.assign(drag_weights.begin(), drag_weights.end());
  else
    tangential_weights.assign(skin_weights.begin(), skin_weights.end());
  find_reflections(problem);
  const auto levels =
      window_levels(problem.grid, options.narrowest * options.depth, problem.is_line);
  const auto key = [](const WindowPlace& place) {
    return std::tuple(place.rows.first, place.rows.count, place.columns.first, place.columns.count);
  };
  const auto image = [&](WindowPlace place, const Reflection& reflection) {
    const auto turned = [](AxisRange range, std::size_t values) {
      return AxisRange{static_cast<Index>(values) - range.count - range.first, range.count};
    };
    if (reflection.of_y) place.rows = turned(place.rows, problem.grid.rows);
    if (reflection.of_z) place.columns = turned(place.columns, problem.grid.columns);
    return place;
  };
  for (std::size_t i = levels.size(); i-- > 0;) {  // the whole surface first
    const std::vector<WindowPlace>& level = levels[i];
    std::map<decltype(key({})), std::size_t> known;
    for (const WindowPlace& place : level) {
      std::size_t reflection = 0;
      while (reflection < reflections.size() &&
             !known.contains(key(image(place, reflections[reflection]))))
        ++reflection;
      if (reflection == reflections.size()) {
        reflection = 0;
        known.emplace(key(place), shapes.size());
        shapes.push_back({.coordinates = {problem, place, options.depth}});
      }
      add_window(problem, place, known.at(key(image(place, reflections[reflection]))), reflection);
      Shape& shape = shapes[windows.back().shape];
      shape.windows.push_back(windows.size() - 1);
      if (shape.columns.empty()) {
        shape.columns = windows.back().columns;
        decompose(shape, options.prior_power, -std::log(static_cast<double>(level.size())));
      }
    }
  }
  kept_.resize(entries.size());
  asked_.resize(entries.size());
}

void LoadPrior::Tables::find_reflections(const LinearProblem& problem) {
  Reflection none{.readings = std::vector<Index>(problem.sites.size()),
                  .signs = Eigen::VectorXd::Ones(std::ssize(problem.sites)),
                  .tractions = std::vector<double>(problem.components, 1.0)};
  std::iota(none.readings.begin(), none.readings.end(), Index{0});
  reflections.push_back(std::move(none));
  for (const Axis along : {Axis::y, Axis::z}) {
    if (problem.is_line && along == Axis::z) continue;
    const MirroredReadings mirrored = mirrored_readings(problem, along);
    if (!mirrored) continue;
    const std::size_t count = reflections.size();
    for (std::size_t i = 0; i < count; ++i) {
      Reflection both = reflections[i];
      (along == Axis::y ? both.of_y : both.of_z) = true;
      for (std::size_t row = 0; row < problem.sites.size(); ++row) {
        const auto at = static_cast<Index>(row);
        const std::size_t other = (*mirrored)[row];
        both.readings[row] = reflections[i].readings[other];
        both.signs(at) = reflections[i].signs(static_cast<Index>(other));
        if (is_odd(problem.sites[row].quantity, Traction::normal, along)) both.signs(at) *= -1.0;
      }
      for (std::size_t u = 0; u < problem.components; ++u)
        if (skin_tractions[u] ==
            (along == Axis::y ? Traction::tangential_y : Traction::tangential_z))
          both.tractions[u] *= -1.0;
      reflections.push_back(std::move(both));
    }
  }
}

void LoadPrior::Tables::add_window(const LinearProblem& problem, const WindowPlace& place,
                                   std::size_t shape, std::size_t reflection) {
  Window window{.shape = shape, .reflection = reflection};
  const Reflection& by = reflections[reflection];
  const auto value = [](const AxisRange& range, Index i, bool turned) {
    return range.first + (turned ? range.count - 1 - i : i);
  };
  for (Index u = 0; u < components; ++u)
    for (Index row = 0; row < place.rows.count; ++row)
      for (Index column = 0; column < place.columns.count; ++column)
        window.columns.push_back(
            u * block + value(place.rows, row, by.of_y) * static_cast<Index>(problem.grid.columns) +
            value(place.columns, column, by.of_z));
  windows.push_back(std::move(window));
}

void LoadPrior::Tables::decompose(Shape& shape, double prior_power, double log_prior) {
  shape.first = entries.size();
  shape.most_log_prior =
      Eigen::VectorXd::Constant(mixture_alphas, -std::numeric_limits<double>::infinity());
  const Index rows = kernel_.rows();
  const Index own = shape.coordinates.count();
  const Eigen::MatrixXd columns = kernel_(Eigen::indexing::all, shape.columns).transpose();
  Eigen::MatrixXd seen(columns.rows(), rows);  // T'K' of weight 1
  for (Index u = 0; u < components; ++u)
    seen.middleRows(u * own, own) = shape.coordinates.sums(columns.middleRows(u * own, own));
  int exponent = 0;  // a power of two scales without a rounding, and squares stay numbers
  std::frexp(seen.cwiseAbs().maxCoeff(), &exponent);
  const double size = std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
  seen /= size;
  // No more rows than columns say the same: of the normal traction, and of the tangential ones.
  const auto reduced = [rows](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    if (x.rows() > rows) return HouseholderQr(x).triangle();
    return x;
  };
  const Eigen::MatrixXd normal = reduced(seen.topRows(own));
  const Eigen::MatrixXd tangential = reduced(seen.bottomRows(seen.rows() - own));
  for (const double weight : tangential_weights) {
    Eigen::MatrixXd both(normal.rows() + tangential.rows(), rows);
    both << normal, tangential / weight;
    both = reduced(both);
    const Svd parts = both.rows() == rows ? singular_value_decomposition(both)
                                          : long_singular_value_decomposition(both);
    Entry entry{.shape = static_cast<std::size_t>(&shape - shapes.data()),
                .tangential_weight = weight};
    if (alphas.size() == 0) {
      const double largest = size * parts.values(0);
      if (!(largest > 0.0)) throw std::invalid_argument(nothing_is_read);
      alphas.resize(mixture_alphas);
      for (Index a = 0; a < mixture_alphas; ++a)
        alphas(a) = largest * largest * most_alpha * std::ldexp(1.0, -static_cast<int>(a));
    }
    const double least = std::sqrt(least_gamma2 * alphas(mixture_alphas - 1));
    const Index shown = (size * parts.values.array() > least).count();
    entry.u = parts.v.leftCols(shown);
    entry.gamma = size * parts.values.head(shown);
    entry.gamma2 = entry.gamma.cwiseAbs2();
    entry.log_prior = Eigen::VectorXd::Constant(
        mixture_alphas, components == 1 ? log_prior : log_prior - negative_log_prior(weight));
    for (Index a = 0; a < mixture_alphas; ++a)
      entry.log_prior(a) += 0.5 * (alphas(a) / (entry.gamma2.array() + alphas(a))).log().sum() -
                            prior_power * std::log(2.0) * static_cast<double>(a);
    shape.most_log_prior = shape.most_log_prior.cwiseMax(entry.log_prior);
    entries.push_back(std::move(entry));
  }
}

Eigen::MatrixXd LoadPrior::Tables::tractions(const Entry& entry, const Eigen::MatrixXd& c) const {
  return of_components(entry, c, &WindowCoordinates::tractions);
}

Eigen::MatrixXd LoadPrior::Tables::sums(const Entry& entry, const Eigen::MatrixXd& f) const {
  return of_components(entry, f, &WindowCoordinates::sums);
}

Eigen::MatrixXd LoadPrior::Tables::of_components(const Entry& entry, const Eigen::MatrixXd& values,
                                                 auto map) const {
  const WindowCoordinates& coordinates = shapes[entry.shape].coordinates;
  const Index n = coordinates.count();
  Eigen::MatrixXd all(values.rows(), values.cols());
  for (Index u = 0; u < components; ++u)
    all.middleRows(u * n, n) = (coordinates.*map)(values.middleRows(u * n, n));
  all.bottomRows(all.rows() - n) /= entry.tangential_weight;
  return all;
}

Eigen::MatrixXd LoadPrior::Tables::inside(const Window& window, const Eigen::MatrixXd& all) const {
  Eigen::MatrixXd values = all(window.columns, Eigen::indexing::all);
  const Index n = values.rows() / components;
  for (Index u = 0; u < components; ++u)
    values.middleRows(u * n, n) *=
        reflections[window.reflection].tractions[static_cast<std::size_t>(u)];
  return values;
}

void LoadPrior::Tables::add(const Window& window, const Eigen::VectorXd& inside,
                            Eigen::Ref<Eigen::VectorXd> all) const {
  const Index n = inside.size() / components;
  for (Index i = 0; i < inside.size(); ++i)
    all(window.columns[static_cast<std::size_t>(i)]) +=
        reflections[window.reflection].tractions[static_cast<std::size_t>(i / n)] * inside(i);
}

/// V by a QR of (K T)'U = V diag(gamma), its columns descending: R is the diagonal to a rounding of
/// its largest entry, so U diag(gamma) V' is K T as well as a decomposition makes it.
LoadPrior::Tables::Details LoadPrior::Tables::make(const Entry& entry) const {
  const Shape& shape = shapes[entry.shape];
  const Eigen::MatrixXd kernel = kernel_(Eigen::indexing::all, shape.columns);
  const Index n = kernel.cols();
  const Index shown = entry.gamma.size();
  const HouseholderQr qr(sums(entry, kernel.transpose() * entry.u) *
                         entry.gamma.cwiseInverse().asDiagonal());
  Details made{.v = qr.rotate_back(Eigen::MatrixXd::Identity(n, shown))};
  const Eigen::VectorXd diagonal = qr.triangle().diagonal();
  for (Index i = 0; i < shown; ++i)
    if (diagonal(i) < 0.0) made.v.col(i) *= -1.0;
  made.roots = tractions(entry, made.v);
  made.hidden = Eigen::VectorXd::Zero(n);
  if (shown == n) return made;
  const Index own = shape.coordinates.count();
  for (Index u = 0; u < components; ++u)
    made.hidden.segment(u * own, own) =
        shape.coordinates.squares() /
        (u == 0 ? 1.0 : entry.tangential_weight * entry.tangential_weight);
  const Eigen::VectorXd all = made.hidden;
  made.hidden -= made.roots.rowwise().squaredNorm();
  // A difference of squares has its own rounding: seen where little is left.
  std::vector<Index> little;
  for (Index i = 0; i < n; ++i)
    if (made.hidden(i) < least_difference * all(i)) little.push_back(i);
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n, std::ssize(little));
  for (std::size_t i = 0; i < little.size(); ++i) left(little[i], static_cast<Index>(i)) = 1.0;
  left = sums(entry, left);
  left -= made.v * made.roots(little, Eigen::indexing::all).transpose();
  made.hidden(little) = left.colwise().squaredNorm();
  return made;
}

std::shared_ptr<const LoadPrior::Tables::Details> LoadPrior::Tables::details(
    const Entry& entry) const {
  const auto at = static_cast<std::size_t>(&entry - entries.data());
  {
    const std::lock_guard lock(mutex_);
    asked_[at] = ++asks_;
    if (kept_[at]) return kept_[at];
  }
  // Not under the lock: two threads may make the same, which is the same.
  auto made = std::make_shared<const Details>(make(entry));
  const auto numbers = [](const Details& one) {
    return static_cast<std::size_t>(one.v.size() + one.roots.size() + one.hidden.size());
  };
  const std::lock_guard lock(mutex_);
  if (kept_[at]) return kept_[at];
  kept_[at] = made;
  numbers_ += numbers(*made);
  while (numbers_ > room) {
    std::size_t oldest = at;
    for (std::size_t i = 0; i < kept_.size(); ++i)
      if (kept_[i] && asked_[i] < asked_[oldest]) oldest = i;
    if (oldest == at) break;
    numbers_ -= numbers(*kept_[oldest]);
    kept_[oldest].reset();
  }
  return made;
}

}  // namespace tactile_net
