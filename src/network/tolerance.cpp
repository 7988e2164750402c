#include "tactile_net/network/tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "network/draw_stability.hpp"
#include "network/opamp_draws.hpp"
#include "network/programmed_arrays.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/robust.hpp"
#include "tactile_net/network/network_circuit.hpp"

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
  return options.relative || options.stabiliser || options.balance || !options.each.empty() ||
         options.cell_noise || options.common.any();
}

void check(const ToleranceOptions& options, std::size_t resistors) {
  if (!options.each.empty() && options.each.size() != resistors)
    throw std::invalid_argument("a tolerance of each resistor needs one value a resistor");
  for (const double one : options.each)
    if (!(one > 0.0 && one < 1.0)) throw std::invalid_argument("a tolerance must be > 0 and < 1");
  for (const auto& one : {options.relative, options.stabiliser, options.balance, options.bandwidth})
    if (one && !(*one > 0.0 && *one < 1.0))
      throw std::invalid_argument("a tolerance must be > 0 and < 1");
  if (!draws(options) && !options.series && !is_of_arrays(options))
    throw std::invalid_argument(
        "a tolerance needs relative errors, a series, bits, cell_noise or a wire_resistance");
  check_arrays(options);
  check(options.common);
  if (!(options.accuracy > 0.0)) throw std::invalid_argument("the accuracy must be > 0");
  if (options.trials == 0) throw std::invalid_argument("a tolerance needs at least one trial");
}

Eigen::VectorXd outputs_of(const Reduction& reduction, const Equations& equations) {
  const Eigen::VectorXd right = as_eigen(std::span(equations.right_side));
  const Eigen::VectorXd z = Lu(as_eigen(equations.matrix)).solve(right);
  return z.head(static_cast<Eigen::Index>(reduction.outputs()));
}

/// Of one resistor that is bought.
ResistorError error_of(const Reduction& reduction, const ToleranceOptions& options,
                       std::size_t resistor) {
  if (!options.each.empty()) return {.tolerance = options.each[resistor]};
  if (options.stabiliser && reduction.resistors()[resistor].rfind("Rs", 0) == 0)
    return {.tolerance = *options.stabiliser};
  if (options.relative || !options.common.measured)
    return {.tolerance = options.relative.value_or(0.0)};
  return {.kind = ResistorError::Kind::measured};
}

ResistorErrors errors_of(const Reduction& reduction, const ToleranceOptions& options,
                         const ProgrammedArrays& arrays) {
  std::vector<ResistorError> each;
  for (std::size_t r = 0; r < reduction.resistors().size(); ++r)
    each.push_back(arrays.is_programmed(r) ? ResistorError{.kind = ResistorError::Kind::none}
                                           : error_of(reduction, options, r));
  return ResistorErrors(std::move(each), options.common);
}

/// What first order needs of the nominal network.
struct FirstOrder {
  std::vector<double> unknowns{};
  Eigen::MatrixXd gram{};  // |dv|^2 = u' gram u of currents u
  double size = 0.0;       // |v|^2

  /// The squares of the answer's relative changes, of a row of currents each.
  [[nodiscard]] Eigen::VectorXd squares(const Eigen::MatrixXd& u) const {
    return (u * gram).cwiseProduct(u).rowwise().sum() / size;
  }
};

FirstOrder first_order(const Reduction& reduction) {
  const Equations nominal = reduction.equations();
  const Lu lu(as_eigen(nominal.matrix));
  const Eigen::VectorXd right = as_eigen(std::span(nominal.right_side));
  const Eigen::VectorXd z = lu.solve(right);
  const auto n = static_cast<Eigen::Index>(reduction.outputs());
  const double size = z.head(n).squaredNorm();
  if (!z.allFinite() || !(size > 0.0))
    throw std::domain_error("without an answer there is nothing to err from");
  // Rows of the inverse that lead to the outputs.
  const Eigen::MatrixXd rows = lu.inverse().topRows(n);
  return {.unknowns = {z.begin(), z.end()}, .gram = rows.transpose() * rows, .size = size};
}

/// The mean square that balances of 1 would make to first order.
double of_balance(const Reduction& reduction, const FirstOrder& order) {
  if (reduction.complementary() == 0) return 0.0;
  const Matrix each = reduction.balance_sensitivities(order.unknowns);
  return order.squares(as_eigen(each)).sum();
}

}  // namespace

std::vector<double> relative_sensitivities(const Reduction& reduction) {
  const FirstOrder order = first_order(reduction);
  const Matrix each = reduction.sensitivities(order.unknowns);
  const Eigen::VectorXd squares = order.squares(as_eigen(each));
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

/// What trials are drawn from.
class Draws {
 public:
  Draws(const Reduction& reduction, const ToleranceOptions& options)
      : reduction_(reduction),
        options_(options),
        arrays_(reduction, options),
        errors_(errors_of(reduction, options, arrays_)) {
    parts_.assign(reduction.siemens().begin(), reduction.siemens().end());
    if (options.series)
      for (double& value : parts_) value = preferred_siemens(*options.series, value);
    arrays_.round(parts_);
  }

  /// One trial's conductances, errors and all.
  void draw(std::size_t trial, std::vector<double>& siemens) const {
    siemens = parts_;
    errors_.draw(options_.seed, trial, siemens);
    arrays_.disturb(siemens, trial);
    arrays_.through_lines(siemens);
  }

  [[nodiscard]] double kelvin(std::size_t trial) const noexcept {
    return errors_.kelvin(options_.seed, trial);
  }
  [[nodiscard]] const std::vector<Resistor>& paths() const noexcept { return arrays_.paths(); }
  [[nodiscard]] BoughtParts bought() const { return {parts_, errors_}; }

  /// The first-order part of a result.
  void predict(ToleranceResult& result, const OpAmpErrors& opamps) const;

 private:
  /// Of every resistor's relative error, what is drawn or of a series.
  [[nodiscard]] Eigen::VectorXd variances() const;
  /// The same of what every build has: rounded cells, seen through lines.
  [[nodiscard]] Eigen::VectorXd changes() const;

  const Reduction& reduction_;
  const ToleranceOptions& options_;
  ProgrammedArrays arrays_;
  ResistorErrors errors_;
  std::vector<double> parts_;
};

Eigen::VectorXd Draws::variances() const {
  // Of a uniform error; of rounding too, within half a step of the series.
  double rounding = 0.0;
  if (options_.series)
    rounding = std::pow(std::log(10.0) / (2.0 * static_cast<double>(*options_.series)), 2) / 3.0;
  const std::vector<double> own = errors_.own_squares();
  Eigen::VectorXd result = as_eigen(std::span(own)).array() + rounding;
  arrays_.add_variances(reduction_.siemens(), {result.data(), parts_.size()});
  return result;
}

Eigen::VectorXd Draws::changes() const {
  std::vector<double> seen(reduction_.siemens().begin(), reduction_.siemens().end());
  arrays_.round(seen);
  arrays_.through_lines(seen);
  const auto exact = as_eigen(reduction_.siemens());
  return as_eigen(std::span<const double>(seen)).cwiseQuotient(exact).array() - 1.0;
}

void Draws::predict(ToleranceResult& result, const OpAmpErrors& opamps) const {
  const FirstOrder first = first_order(reduction_);
  const Matrix each = reduction_.sensitivities(first.unknowns);
  const auto by_resistors = as_eigen(each);
  const Eigen::VectorXd squares = first.squares(by_resistors).cwiseProduct(variances());
  double sum = squares.sum();
  if (options_.balance)
    sum += *options_.balance * *options_.balance / 3.0 * of_balance(reduction_, first);
  for (const ResistorErrors::Shared& one : errors_.shared()) {
    const Eigen::MatrixXd moved = as_eigen(std::span(one.shares)).transpose() * by_resistors;
    sum += one.square * first.squares(moved)(0);
  }
  const bool drawn_alone = sum > 0.0;
  if (is_of_arrays(options_)) {
    Eigen::MatrixXd moved = changes().transpose() * by_resistors;
    const std::vector<double> besides = reduction_.currents(paths(), first.unknowns);
    moved += as_eigen(std::span(besides)).transpose();
    sum += first.squares(moved)(0);
  }
  sum += std::pow(shares(opamps, 0, std::sqrt(first.size)).total, 2);
  result.predicted = std::sqrt(sum);
  if (!drawn_alone) return;

  std::vector<std::size_t> order(parts_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t most = std::min<std::size_t>(5, order.size());
  const auto share = [&](std::size_t r) { return squares(static_cast<Eigen::Index>(r)) / sum; };
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                    [&](std::size_t a, std::size_t b) { return share(a) > share(b); });
  for (std::size_t k = 0; k < most; ++k)
    result.worst.push_back({reduction_.resistors()[order[k]], share(order[k])});
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
  std::vector<double> siemens;
  Draws(reduction, options).draw(trial, siemens);
  return siemens;
}

BoughtParts bought_parts(const Reduction& reduction, const ToleranceOptions& options) {
  if (is_of_arrays(options))
    throw std::invalid_argument(
        "cells that are programmed, and lines with a resistance, are not parts that are bought: "
        "leave out bits, cell_noise and wire_resistance");
  return Draws(reduction, options).bought();
}

std::vector<Resistor> paths_of_lines(const Reduction& reduction, const ToleranceOptions& options) {
  return ProgrammedArrays(reduction, options).paths();
}

Circuit perturbed(const FlatCircuit& circuit, std::span<const double> siemens,
                  std::span<const Resistor> paths) {
  Circuit flat = circuit.circuit();
  if (siemens.size() != flat.resistors.size())
    throw std::invalid_argument("the circuit has another number of resistors");
  for (std::size_t r = 0; r < siemens.size(); ++r) flat.resistors[r].siemens = siemens[r];
  std::erase_if(flat.resistors, [](const Resistor& r) { return r.siemens == 0.0; });
  flat.resistors.insert(flat.resistors.end(), paths.begin(), paths.end());
  return flat;
}

Trial try_out(const Reduction& reduction, std::span<const double> siemens,
              std::span<const Resistor> paths) {
  const Eigen::VectorXd nominal = outputs_of(reduction, reduction.equations());
  Equations equations;
  reduction.assemble(siemens, equations, {}, paths);
  const Eigen::VectorXd v = outputs_of(reduction, equations);
  return {
      is_stable(reduction, equations), (v - nominal).norm() / nominal.norm(), {v.begin(), v.end()}};
}

ToleranceResult tolerate(const Reduction& reduction, const ToleranceOptions& options,
                         const OpAmpErrors& opamps) {
  check(options, reduction.resistors().size());
  const Equations nominal = reduction.equations();
  const Eigen::VectorXd v = outputs_of(reduction, nominal);
  if (v.norm() == 0.0) throw std::domain_error("without a load there is no answer to err from");
  if (!v.allFinite()) throw std::domain_error("the network has no unique answer");

  const bool random = draws(options) || opamps.any_of_inputs();
  ToleranceResult result{.trials = random ? options.trials : 1};
  const Draws built(reduction, options);
  const OpAmpDraws amplifiers(reduction, opamps, options.balance.value_or(0.0));
  const std::vector<double> shifts = total_shift(opamps, 0, reduction.outputs());
  const auto shift = as_eigen(std::span(shifts));
  std::vector<double> siemens;
  std::vector<double>& errors = result.errors;
  Equations equations;
  for (std::size_t trial = 0; trial < result.trials; ++trial) {
    built.draw(trial, siemens);
    reduction.assemble(siemens, equations, amplifiers.balances(options.seed, trial), built.paths());
    if (!is_stable(reduction, equations)) {
      errors.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    ++result.stable;
    const Eigen::VectorXd off = outputs_of(reduction, equations) +
                                amplifiers.of_inputs(options.seed, trial, built.kelvin(trial)) +
                                shift - v;
    errors.push_back(off.norm() / v.norm());
    if (errors.back() <= options.accuracy) ++result.accurate;
  }
  std::sort(errors.begin(), errors.end());
  result.median = quantile(errors, 0.5);
  result.p95 = quantile(errors, 0.95);
  built.predict(result, opamps);
  return result;
}

ToleranceResult tolerate(const NetworkCircuit& circuit, const ToleranceOptions& options) {
  const std::vector<std::vector<CurrentSource>> own = {circuit.circuit().sources};
  OpAmpErrors opamps = opamp_errors(circuit.flat(), own);
  return tolerate(circuit.reduction(), options,
                  options.tare ? without_rest(std::move(opamps)) : opamps);
}

}  // namespace tactile_net
