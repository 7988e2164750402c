#include "tactile_net/network/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "network/draw_stability.hpp"
#include "network/random.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

/// Three digits up to E24's two, as the standard rounds them.
double preferred(int place, int series) {
  const double exact = std::pow(10.0, static_cast<double>(place) / series);
  if (series > 24) {
    const double rounded = std::round(100.0 * exact) / 100.0;
    return rounded == 9.19 ? 9.20 : rounded;  // E192's one exception
  }
  // E24 was fixed before the formula: these differ from it.
  constexpr double e24[] = {1.0, 1.1, 1.2, 1.3, 1.5, 1.6, 1.8, 2.0, 2.2, 2.4, 2.7, 3.0,
                            3.3, 3.6, 3.9, 4.3, 4.7, 5.1, 5.6, 6.2, 6.8, 7.5, 8.2, 9.1};
  return e24[place * (24 / series)];
}

/// Whether anything is random.
bool draws(const ToleranceOptions& options) {
  return options.relative || options.stabiliser || options.balance || !options.each.empty();
}

void check(const ToleranceOptions& options, std::size_t resistors) {
  if (!options.each.empty() && options.each.size() != resistors)
    throw std::invalid_argument("a tolerance of each resistor needs one value a resistor");
  for (const double one : options.each)
    if (!(one > 0.0 && one < 1.0)) throw std::invalid_argument("a tolerance must be > 0 and < 1");
  for (const auto& one : {options.relative, options.stabiliser, options.balance})
    if (one && !(*one > 0.0 && *one < 1.0))
      throw std::invalid_argument("a tolerance must be > 0 and < 1");
  if (!draws(options) && !options.series)
    throw std::invalid_argument("a tolerance needs relative errors or a series");
  if (!(options.accuracy > 0.0)) throw std::invalid_argument("the accuracy must be > 0");
  if (options.trials == 0) throw std::invalid_argument("a tolerance needs at least one trial");
}

Eigen::VectorXd outputs_of(const Reduction& reduction, const Equations& equations) {
  const Eigen::VectorXd right = as_eigen(std::span(equations.right_side));
  const Eigen::VectorXd z = Lu(as_eigen(equations.matrix)).solve(right);
  return z.head(static_cast<Eigen::Index>(reduction.outputs()));
}

/// Of one resistor.
double tolerance_of(const Reduction& reduction, const ToleranceOptions& options,
                    std::size_t resistor) {
  if (!options.each.empty()) return options.each[resistor];
  if (options.stabiliser && reduction.resistors()[resistor].rfind("Rs", 0) == 0)
    return *options.stabiliser;
  return options.relative.value_or(0.0);
}

double quantile(const std::vector<double>& ascending, double q) {
  return ascending[static_cast<std::size_t>(q * static_cast<double>(ascending.size() - 1) + 0.5)];
}

/// The squares of the answer's relative changes by each row of what `errors` says of the equations.
Eigen::VectorXd relative_squares(const Reduction& reduction, const auto& errors) {
  const Equations nominal = reduction.equations();
  const Lu lu(as_eigen(nominal.matrix));
  const Eigen::VectorXd right = as_eigen(std::span(nominal.right_side));
  const Eigen::VectorXd z = lu.solve(right);
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const double size = z.head(n).squaredNorm();
  if (!z.allFinite() || !(size > 0.0))
    throw std::domain_error("without an answer there is nothing to err from");
  // Rows of the inverse that lead to the outputs: |dv|^2 = u' (rows' rows) u.
  const Eigen::MatrixXd rows = lu.inverse().topRows(n);
  const Eigen::MatrixXd gram = rows.transpose() * rows;
  const Matrix by_errors = errors(std::span(z.data(), static_cast<std::size_t>(z.size())));
  const auto u = as_eigen(by_errors);
  return (u * gram).cwiseProduct(u).rowwise().sum() / size;
}

/// The mean square that balances of 1 would make to first order.
double of_balance(const Reduction& reduction) {
  if (reduction.complementary() == 0) return 0.0;
  return relative_squares(
             reduction,
             [&](std::span<const double> z) { return reduction.balance_sensitivities(z); })
      .sum();
}

/// The first-order part of a result.
void predict(const Reduction& reduction, const ToleranceOptions& options, ToleranceResult& result) {
  const std::vector<double> sensitivities = relative_sensitivities(reduction);
  Eigen::VectorXd squares = as_eigen(std::span(sensitivities));
  // Variance of a uniform error; of rounding too, within half a step of the series.
  double rounding = 0.0;
  if (options.series)
    rounding = std::pow(std::log(10.0) / (2.0 * static_cast<double>(*options.series)), 2) / 3.0;
  for (Eigen::Index r = 0; r < squares.size(); ++r) {
    const double relative = tolerance_of(reduction, options, static_cast<std::size_t>(r));
    squares(r) *= relative * relative / 3.0 + rounding;
  }
  double sum = squares.sum();
  if (options.balance) sum += *options.balance * *options.balance / 3.0 * of_balance(reduction);
  result.predicted = std::sqrt(sum);

  std::vector<std::size_t> order(reduction.resistors().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t most = std::min<std::size_t>(5, order.size());
  const auto share = [&](std::size_t r) { return squares(static_cast<Eigen::Index>(r)) / sum; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                    [&](std::size_t a, std::size_t b) { return share(a) > share(b); });
  for (std::size_t k = 0; k < most; ++k)
    result.worst.push_back({reduction.resistors()[order[k]], share(order[k])});
}

}  // namespace

std::vector<double> relative_sensitivities(const Reduction& reduction) {
  const Eigen::VectorXd squares = relative_squares(
      reduction, [&](std::span<const double> z) { return reduction.sensitivities(z); });
  return {squares.begin(), squares.end()};
}

double nearest_in(Series series, double ohm) {
  if (!(ohm > 0.0) || !std::isfinite(ohm))
    throw std::invalid_argument("a resistor must be > 0 and finite");
  const int count = static_cast<int>(series);
  const int near = static_cast<int>(std::lround(count * std::log10(ohm)));
  double best = 0.0;
  for (int place = near - 2; place <= near + 2; ++place) {  // E24 strays a place from its formula
    const int decade = place >= 0 ? place / count : -((count - 1 - place) / count);
    // As it is printed: a whole number of hundredths times or over a power of ten, both exact.
    const double hundredths = std::round(100.0 * preferred(place - decade * count, count));
    const double value = decade >= 2 ? hundredths * std::pow(10.0, decade - 2)
                                     : hundredths / std::pow(10.0, 2 - decade);
    if (best == 0.0 || std::abs(std::log(value / ohm)) < std::abs(std::log(best / ohm)))
      best = value;
  }
  return best;
}

namespace {

/// A conductance whose resistor is of the series.
double preferred_siemens(Series series, double siemens) {
  return std::copysign(1.0 / nearest_in(series, 1.0 / std::abs(siemens)), siemens);
}

/// The conductances that are printed on the parts: nominal, or of the series.
std::vector<double> printed(const Reduction& reduction, const ToleranceOptions& options) {
  std::vector<double> siemens(reduction.siemens().begin(), reduction.siemens().end());
  if (options.series)
    for (double& value : siemens) value = preferred_siemens(*options.series, value);
  return siemens;
}

/// One trial's errors on them.
void spread(const Reduction& reduction, std::vector<double>& siemens,
            const ToleranceOptions& options, std::size_t trial) {
  if (!draws(options)) return;
  for (std::size_t r = 0; r < siemens.size(); ++r)
    siemens[r] /= 1.0 + tolerance_of(reduction, options, r) * uniform(options.seed, trial, r);
}

/// One trial's balances; none: all are exact.
std::vector<double> balances(const Reduction& reduction, const ToleranceOptions& options,
                             std::size_t trial) {
  std::vector<double> balance;
  if (!options.balance) return balance;
  for (std::size_t k = 0; k < reduction.complementary(); ++k)
    balance.push_back(*options.balance *
                      uniform(options.seed, trial, reduction.resistors().size() + k));
  return balance;
}

}  // namespace

Circuit with_parts_of(Series series, Circuit circuit) {
  for (Resistor& resistor : circuit.resistors)
    resistor.siemens = preferred_siemens(series, resistor.siemens);
  circuit.divider = nearest_in(series, circuit.divider);
  return circuit;
}

std::vector<double> drawn(const Reduction& reduction, const ToleranceOptions& options,
                          std::size_t trial) {
  std::vector<double> siemens = printed(reduction, options);
  spread(reduction, siemens, options, trial);
  return siemens;
}

Circuit perturbed(const FlatCircuit& circuit, std::span<const double> siemens) {
  Circuit flat = circuit.circuit();
  if (siemens.size() != flat.resistors.size())
    throw std::invalid_argument("the circuit has another number of resistors");
  for (std::size_t r = 0; r < siemens.size(); ++r) flat.resistors[r].siemens = siemens[r];
  return flat;
}

Trial try_out(const Reduction& reduction, std::span<const double> siemens) {
  const Eigen::VectorXd nominal = outputs_of(reduction, reduction.equations());
  Equations equations;
  reduction.assemble(siemens, equations);
  const Eigen::VectorXd v = outputs_of(reduction, equations);
  return {
      is_stable(reduction, equations), (v - nominal).norm() / nominal.norm(), {v.begin(), v.end()}};
}

ToleranceResult tolerate(const Reduction& reduction, const ToleranceOptions& options) {
  check(options, reduction.resistors().size());
  const Equations nominal = reduction.equations();
  const Eigen::VectorXd v = outputs_of(reduction, nominal);
  if (v.norm() == 0.0) throw std::domain_error("without a load there is no answer to err from");
  if (!v.allFinite()) throw std::domain_error("the network has no unique answer");

  ToleranceResult result{.trials = draws(options) ? options.trials : 1};
  const std::vector<double> parts = printed(reduction, options);
  std::vector<double> siemens;
  std::vector<double>& errors = result.errors;
  Equations equations;
  for (std::size_t trial = 0; trial < result.trials; ++trial) {
    siemens = parts;
    spread(reduction, siemens, options, trial);
    reduction.assemble(siemens, equations, balances(reduction, options, trial));
    if (!is_stable(reduction, equations)) {
      errors.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    ++result.stable;
    errors.push_back((outputs_of(reduction, equations) - v).norm() / v.norm());
    if (errors.back() <= options.accuracy) ++result.accurate;
  }
  std::sort(errors.begin(), errors.end());
  result.median = quantile(errors, 0.5);
  result.p95 = quantile(errors, 0.95);
  predict(reduction, options, result);
  return result;
}

}  // namespace tactile_net
