#include "inverse/load_tables.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/mirror_classes.hpp"
#include "inverse/stabiliser_weight.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/threads.hpp"
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
constexpr double least_entry = 1e-15;      // over the largest entry of T'K'
constexpr double least_difference = 1e-5;  // of two squares, over the larger one

/// No more rows than columns say the same.
Eigen::MatrixXd reduced(const Eigen::MatrixXd& x) {
  if (x.rows() > x.cols()) return HouseholderQr(x).triangle();
  return x;
}

Eigen::MatrixXd stacked(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows() + b.rows(), a.cols());
  both << a, b;
  return both;
}

}  // namespace

WindowSteps mixture_steps(const LinearProblem& problem, double depth) {
  if (!problem.is_line) return {.apart = 1.0 / 3.0, .wide = 3.5 * depth, .step = 0.5 * depth};
  if (problem.kernel.rows >= LoadPrior::Tables::few_readings) return {};
  return {.apart = problem.components == 1 ? 0.125 : 0.25,
          .wider = std::pow(2.0, 0.25),
          .most_widths = 18};
}

LoadPrior::Tables::Tables(const LinearProblem& problem, const LoadPriorOptions& options,
                          std::size_t least_parted)
    : Tables(problem, options, WindowsAlone{}) {
  kernel_ = as_eigen(problem.kernel);
  is_long_ = problem.kernel.rows >= least_parted;
  entries_.resize(shapes.size() * tangential_weights.size());
  kept_.resize(entries_.size());
  asked_.resize(entries_.size());
  prepare(options.threads);
}

LoadPrior::Tables::Tables(const LinearProblem& problem, const LoadPriorOptions& options,
                          WindowsAlone)
    : weighting(problem),
      components(static_cast<Index>(problem.components)),
      block(static_cast<Index>(problem.grid.count())),
      most_components(options.most_components),
      prior_power_(options.prior_power),
      is_long_(problem.kernel.rows >= few_readings) {
  if (problem.components == 1)
    tangential_weights = {1.0};
  else if (problem.is_line)
    tangential_weights.assign(drag_weights.begin(), drag_weights.end());
  else
    tangential_weights.assign(skin_weights.begin(), skin_weights.end());
  find_reflections(problem);
  add_windows(problem, options);
  for (std::size_t i = 0; i < shapes.size(); ++i) shapes[i].first = i * tangential_weights.size();
}

WindowPlace LoadPrior::Tables::Reflection::image(const WindowPlace& place,
                                                 const SurfaceGrid& grid) const {
  const auto turned = [](const AxisRange& range, std::size_t values) {
    return AxisRange{static_cast<Index>(values) - range.count - range.first, range.count};
  };
  WindowPlace found{of_y ? turned(place.rows, grid.rows) : place.rows,
                    of_z ? turned(place.columns, grid.columns) : place.columns};
  if (exchanged) std::swap(found.rows, found.columns);
  return found;
}

void LoadPrior::Tables::find_reflections(const LinearProblem& problem) {
  Reflection none{.readings = std::vector<Index>(problem.sites.size()),
                  .signs = Eigen::VectorXd::Ones(std::ssize(problem.sites)),
                  .components = std::vector<std::size_t>(problem.components),
                  .tractions = std::vector<double>(problem.components, 1.0)};
  std::iota(none.readings.begin(), none.readings.end(), Index{0});
  std::iota(none.components.begin(), none.components.end(), std::size_t{0});
  reflections.push_back(std::move(none));
  // With each that there is by then, and behind it.
  const auto add = [&](const MirroredReadings& of, const auto& change) {
    if (!of) return;
    const std::size_t count = reflections.size();
    for (std::size_t i = 0; i < count; ++i) {
      Reflection both = reflections[i];
      for (std::size_t row = 0; row < of->size(); ++row) {
        both.readings[row] = reflections[i].readings[(*of)[row]];
        both.signs(static_cast<Index>(row)) = reflections[i].signs(static_cast<Index>((*of)[row]));
      }
      change(both);
      reflections.push_back(std::move(both));
    }
  };
  for (const Axis along : {Axis::y, Axis::z}) {
    if (problem.is_line && along == Axis::z) continue;
    add(mirrored_readings(problem, along), [&](Reflection& both) {
      (along == Axis::y ? both.of_y : both.of_z) = true;
      for (std::size_t row = 0; row < problem.sites.size(); ++row)
        if (is_odd(problem.sites[row].quantity, Traction::normal, along))
          both.signs(static_cast<Index>(row)) *= -1.0;
      for (std::size_t u = 0; u < problem.components; ++u)
        if (axis(skin_tractions[u]) == along) both.tractions[u] *= -1.0;
    });
  }
  add(exchanged_readings(problem), [&](Reflection& both) {
    both.exchanged = true;
    if (problem.components < 3) return;
    std::swap(both.components[1], both.components[2]);
    std::swap(both.tractions[1], both.tractions[2]);
  });
}

void LoadPrior::Tables::add_windows(const LinearProblem& problem, const LoadPriorOptions& options) {
  const auto levels = window_levels(problem.grid, options.narrowest * options.depth,
                                    mixture_steps(problem, options.depth), problem.is_line);
  const auto key = [](const WindowPlace& place) {
    return std::tuple(place.rows.first, place.rows.count, place.columns.first, place.columns.count);
  };
  for (std::size_t i = levels.size(); i-- > 0;) {  // the whole surface first
    std::map<decltype(key({})), std::size_t> known;
    for (const WindowPlace& place : levels[i]) {
      const auto shape_of = [&](const Reflection& by) {
        return known.find(key(by.image(place, problem.grid)));
      };
      std::size_t reflection = 0;
      while (reflection < reflections.size() && shape_of(reflections[reflection]) == known.end())
        ++reflection;
      if (reflection == reflections.size()) {
        reflection = 0;
        known.emplace(key(place), shapes.size());
        Shape shape{.coordinates = {problem, place, options.depth},
                    .log_prior = -std::log(static_cast<double>(levels[i].size())),
                    .columns = columns_of(problem, place, reflections.front())};
        for (std::size_t k = 1; k < reflections.size(); ++k)
          if (key(reflections[k].image(place, problem.grid)) == key(place)) shape.own.push_back(k);
        shapes.push_back(std::move(shape));
      }
      const Reflection& by = reflections[reflection];
      const std::size_t shape = shape_of(by)->second;
      shapes[shape].windows.push_back(windows.size());
      windows.push_back(
          {.shape = shape, .reflection = reflection, .columns = columns_of(problem, place, by)});
    }
  }
}

std::vector<Index> LoadPrior::Tables::columns_of(const LinearProblem& problem,
                                                 const WindowPlace& place,
                                                 const Reflection& by) const {
  const auto value = [](const AxisRange& range, Index i, bool turned) {
    return range.first + (turned ? range.count - 1 - i : i);
  };
  const WindowPlace shape = by.image(place, problem.grid);
  std::vector<Index> columns;
  for (const std::size_t u : by.components)
    for (Index i = 0; i < shape.rows.count; ++i)
      for (Index j = 0; j < shape.columns.count; ++j)
        columns.push_back(static_cast<Index>(u) * block +
                          value(place.rows, by.exchanged ? j : i, by.of_y) *
                              static_cast<Index>(problem.grid.columns) +
                          value(place.columns, by.exchanged ? i : j, by.of_z));
  return columns;
}

void LoadPrior::Tables::size_alphas(double largest_gamma) {
  if (!(largest_gamma > 0.0)) throw std::invalid_argument(nothing_is_read);
  alphas.resize(mixture_alphas);
  for (Index a = 0; a < mixture_alphas; ++a)
    alphas(a) = largest_gamma * largest_gamma * most_alpha * std::ldexp(1.0, -static_cast<int>(a));
}

void LoadPrior::Tables::prepare(std::size_t threads) {
  const auto make_all = [this](std::size_t of) {
    Shape& shape = shapes[of];
    const std::size_t weights = tangential_weights.size();
    if (is_long_) {
      outline_all(of);
    } else {
      for (std::size_t i = 0; i < weights; ++i) {
        Entry& entry = entries_[shape.first + i];
        entry = decomposed(shape.first + i);
        if (alphas.size() == 0) size_alphas(entry.gamma(0));
        weigh(entry);
      }
    }
    const Eigen::VectorXd looks = looked_at();
    shape.most_log_prior.setConstant(looks.size(), -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < weights; ++i)
      for (Index a = 0; a < alphas.size(); ++a) {
        double& most = shape.most_log_prior((a + looked_apart - 1) / looked_apart);
        most = std::max(most, entries_[shape.first + i].log_prior(a));
      }
    if (is_long_) return;
    const Eigen::RowVectorXd gamma2 = entries_[shape.first].gamma2.transpose();
    shape.looks.resize(looks.size(), gamma2.size());
    for (Index i = 0; i < looks.size(); ++i)
      shape.looks.row(i) = looks(i) / (gamma2.array() + looks(i));
  };
  if (is_long_) outlines_.resize(entries_.size());
  make_all(0);
  if (!is_long_) {
    for (std::size_t i = 1; i < shapes.size(); ++i) make_all(i);
    return;
  }
  std::atomic<std::size_t> next = 1;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < shapes.size(); i = next++) make_all(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  {
    Threads others;
    const std::size_t most = threads == 0 ? processors() : threads;
    try {
      for (std::size_t k = 1; k < std::min(most, shapes.size()); ++k) others.start(work);
    } catch (const std::system_error&) {  // what has no thread is worked out here
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Of y and of z with both, or of one exchange: those that undo themselves and one another.
std::vector<const LoadPrior::Tables::Reflection*> LoadPrior::Tables::classifying(
    const Shape& shape) const {
  std::vector<const Reflection*> by;
  if (!is_long_) return by;
  for (const std::size_t k : shape.own)
    if (!reflections[k].exchanged) by.push_back(&reflections[k]);
  for (const std::size_t k : shape.own)
    if (by.empty() && reflections[k].of_y == reflections[k].of_z) by.push_back(&reflections[k]);
  return by;
}

std::vector<Eigen::SparseMatrix<double>> LoadPrior::Tables::classes_by(
    std::span<const Reflection* const> by) const {
  const Index rows = kernel_.rows();
  std::vector<Eigen::SparseMatrix<double>> classes;
  if (by.empty()) {
    classes.emplace_back(rows, rows).setIdentity();
    return classes;
  }
  const bool has_two = by.size() > 1;
  for (const double of_first : {1.0, -1.0})
    for (const double of_second : {1.0, -1.0}) {
      if (!has_two && of_second < 0.0) continue;
      const auto character = [&](const Reflection& one) {
        if (!has_two) return of_first;
        return (one.of_y ? of_first : 1.0) * (one.of_z ? of_second : 1.0);
      };
      std::vector<Eigen::Triplet<double>> numbers;
      Index count = 0;
      for (Index row = 0; row < rows; ++row) {
        std::map<Index, double> sum{{row, 1.0}};
        for (const Reflection* const one : by) {
          const Index other = one->readings[static_cast<std::size_t>(row)];
          sum[other] += character(*one) * one->signs(other);
        }
        if (sum.begin()->first < row) continue;
        double square = 0.0;
        for (const auto& [unused, value] : sum) square += value * value;
        if (square == 0.0) continue;  // it is its own image, with the other sign
        for (const auto& [at, value] : sum)
          numbers.emplace_back(at, count, value / std::sqrt(square));
        ++count;
      }
      if (count == 0) continue;
      classes.emplace_back(rows, count).setFromTriplets(numbers.begin(), numbers.end());
    }
  return classes;
}

LoadPrior::Tables::Shown LoadPrior::Tables::shown(const Shape& shape) const {
  const Index own = shape.coordinates.count();
  Eigen::MatrixXd seen = kernel_(Eigen::indexing::all, shape.columns).transpose();
  for (Index u = 0; u < components; ++u)  // T'K' of weight 1
    seen.middleRows(u * own, own) = shape.coordinates.sums(seen.middleRows(u * own, own));
  int exponent = 0;  // a power of two scales without a rounding, and squares stay numbers
  std::frexp(seen.cwiseAbs().maxCoeff(), &exponent);
  Shown made{.size = std::ldexp(1.0, std::clamp(exponent, -1000, 1000))};
  seen /= made.size;
  const std::vector<const Reflection*> by = classifying(shape);
  if (!by.empty() && by.front()->exchanged) shape.coordinates.part_exchanged(seen);
  made.classes = classes_by(by);
  // Half of a class's rows, or three quarters, are nothing but rounding.
  const auto own_rows = [&](const Eigen::MatrixXd& x) {
    Rows rows;
    for (Index i = 0; i < x.rows(); ++i)
      if (by.empty() || x.row(i).cwiseAbs().maxCoeff() > least_entry) rows.kept.push_back(i);
    rows.seen = x(rows.kept, Eigen::indexing::all);
    if (rows.seen.rows() <= x.cols()) return rows;
    rows.qr.emplace(rows.seen);
    rows.seen = rows.qr->triangle();
    return rows;
  };
  for (const Eigen::SparseMatrix<double>& one : made.classes) {
    const Eigen::MatrixXd of_class = by.empty() ? seen : Eigen::MatrixXd(seen * one);
    made.normal.push_back(own_rows(of_class.topRows(own)));
    made.tangential.push_back(own_rows(of_class.bottomRows(seen.rows() - own)));
  }
  return made;
}

LoadPrior::Tables::Entry LoadPrior::Tables::decomposed(std::size_t at) const {
  const std::size_t of = at / tangential_weights.size();
  const double weight = tangential_weights[at % tangential_weights.size()];
  const Shown shown = this->shown(shapes[of]);
  struct Value {
    double gamma = 0.0;  // over size
    std::size_t of = 0;  // class
    Index column = 0;
  };
  std::vector<Svd> parts;
  std::vector<Value> values;
  for (std::size_t c = 0; c < shown.classes.size(); ++c) {
    const Eigen::MatrixXd both =
        reduced(stacked(shown.normal[c].seen, shown.tangential[c].seen / weight));
    parts.push_back(both.rows() == both.cols() ? singular_value_decomposition(both)
                                               : long_singular_value_decomposition(both));
    for (Index k = 0; k < parts[c].values.size(); ++k)
      values.push_back({.gamma = parts[c].values(k), .of = c, .column = k});
  }
  std::stable_sort(values.begin(), values.end(),
                   [](const Value& a, const Value& b) { return a.gamma > b.gamma; });
  Entry entry{.shape = of, .tangential_weight = weight};
  entry.u.resize(kernel_.rows(), std::ssize(values));
  entry.gamma.resize(std::ssize(values));
  for (Index k = 0; k < entry.gamma.size(); ++k) {
    const Value& one = values[static_cast<std::size_t>(k)];
    entry.u.col(k) = shown.classes[one.of] * parts[one.of].v.col(one.column);
    entry.gamma(k) = shown.size * one.gamma;
  }
  return entry;
}

double LoadPrior::Tables::log_prior(const Shape& shape, double tangential_weight, Index a) const {
  return shape.log_prior - (components == 1 ? 0.0 : negative_log_prior(tangential_weight)) -
         prior_power_ * std::log(2.0) * static_cast<double>(a);
}

void LoadPrior::Tables::weigh(Entry& entry) const {
  const double least = std::sqrt(least_gamma2 * alphas(mixture_alphas - 1));
  const Index seen = (entry.gamma.array() > least).count();
  entry.u.conservativeResize(Eigen::NoChange, seen);
  entry.gamma.conservativeResize(seen);
  entry.gamma2 = entry.gamma.cwiseAbs2();
  entry.log_prior.resize(mixture_alphas);
  entry.used.resize(mixture_alphas);
  for (Index a = 0; a < mixture_alphas; ++a) {
    const Eigen::ArrayXd damped = entry.gamma2.array() + alphas(a);
    entry.log_prior(a) = log_prior(shapes[entry.shape], entry.tangential_weight, a) +
                         0.5 * (alphas(a) / damped).log().sum();
    entry.used(a) = (entry.gamma2.array() / damped).sum();
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
Eigen::MatrixXd LoadPrior::Tables::value_vectors(const Entry& entry) const {
  const Eigen::MatrixXd kernel = kernel_(Eigen::indexing::all, shapes[entry.shape].columns);
  const HouseholderQr qr(sums(entry, kernel.transpose() * entry.u) *
                         entry.gamma.cwiseInverse().asDiagonal());
  Eigen::MatrixXd v = qr.rotate_back(Eigen::MatrixXd::Identity(kernel.cols(), entry.gamma.size()));
  const Eigen::VectorXd diagonal = qr.triangle().diagonal();
  for (Index i = 0; i < diagonal.size(); ++i)
    if (diagonal(i) < 0.0) v.col(i) *= -1.0;
  return v;
}

void LoadPrior::Tables::make(const Entry& entry, Details& made) const {
  made.v = is_long_ ? outlined_vectors(index_of(entry)) : value_vectors(entry);
  made.roots = tractions(entry, made.v);
  const Shape& shape = shapes[entry.shape];
  const Index n = made.v.rows();
  made.hidden = Eigen::VectorXd::Zero(n);
  if (is_long_) made.spreads.resize(static_cast<std::size_t>(mixture_alphas));
  if (made.v.cols() == n) {
    if (is_long_) made.v.resize(0, 0);
    return;
  }
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
}

std::shared_ptr<const LoadPrior::Tables::Details> LoadPrior::Tables::details(
    const Entry& entry) const {
  const std::size_t at = index_of(entry);
  {
    const std::lock_guard lock(mutex_);
    asked_[at] = ++asks_;
    if (kept_[at]) return kept_[at];
  }
  // Not under the lock: two threads may make the same, which is the same.
  const auto own = std::make_shared<Details>();
  make(entry, *own);
  std::shared_ptr<const Details> made = own;
  const auto numbers = [](const Details& one) {
    return static_cast<std::size_t>(one.v.size() + one.roots.size()) +
           static_cast<std::size_t>(one.hidden.size()) * (1 + one.spreads.size());
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
