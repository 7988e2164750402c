// One build, cycle by cycle.
#include <algorithm>
#include <cmath>
#include <limits>

#include "network/opamp_draws.hpp"
#include "network/random.hpp"
#include "network/refinement_parts.hpp"
#include "numeric/power_iteration.hpp"

namespace tactile_net {
namespace {

// Places of draws, beyond those of resistors, op-amps and what they have in common.
constexpr std::uint64_t of_channels = std::uint64_t{1} << 43U;
constexpr std::uint64_t of_codes = std::uint64_t{1} << 44U;
constexpr std::uint64_t of_answers = std::uint64_t{1} << 45U;

/// The converters of one build.
class DrawnConverters {
 public:
  DrawnConverters(const Refinement::Parts& parts, std::uint64_t build)
      : seed_(parts.tolerances.seed), build_(build) {
    if (!parts.options.converters) return;
    wanted_ = *parts.options.converters;
    exact_ = false;
    offset_ =
        OpAmpDraws(parts.reduction, parts.opamps, 0.0).of_inputs(seed_, build, 0.0) / parts.range;
  }

  [[nodiscard]] Eigen::VectorXd to_circuit(const Eigen::VectorXd& values) const {
    if (exact_) return values;
    const double range = values.cwiseAbs().maxCoeff();
    return range > 0.0 ? Eigen::VectorXd(range * codes(values / range, 0)) : values;
  }

  /// With the circuit's offset, and noise that differs from cycle to cycle.
  [[nodiscard]] Eigen::VectorXd from_circuit(const Eigen::VectorXd& values,
                                             std::uint64_t cycle) const {
    if (exact_) return values;
    const double range = values.cwiseAbs().maxCoeff();
    if (!(range > 0.0)) return values;
    Eigen::VectorXd seen = values / range + offset_;
    for (Eigen::Index i = 0; i < seen.size(); ++i)
      seen(i) += wanted_.noise *
                 normal(seed_, build_, of_answers + cycle * 65536 + static_cast<std::uint64_t>(i));
    return range * codes(seen, 1);
  }

 private:
  /// Of values within +-1: each by a channel's gain, to the next code, which lies within half a
  /// step of its place.
  [[nodiscard]] Eigen::VectorXd codes(const Eigen::VectorXd& values, std::uint64_t side) const {
    const double step = std::ldexp(1.0, 1 - wanted_.bits);
    Eigen::VectorXd result(values.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const std::uint64_t channel = 2 * static_cast<std::uint64_t>(i) + side;
      const double gain = 1.0 + wanted_.gain * uniform(seed_, build_, of_channels + channel);
      const double code = std::round(gain * values(i) / step);
      const auto place = static_cast<std::uint64_t>(static_cast<std::int64_t>(code));
      const double off = 0.5 * uniform(seed_, build_, (of_codes + channel * 4194304) ^ place);
      result(i) = step * (code == 0.0 ? 0.0 : code + off);
    }
    return result;
  }

  std::uint64_t seed_, build_;
  bool exact_ = true;
  Converters wanted_;
  Eigen::VectorXd offset_;
};

/// f and what belongs to it, in numbers of one precision.
template <class Number>
class Residual {
 public:
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
  using Square = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

  explicit Residual(const Refinement::Parts& parts)
      : kernel_(parts.kernel.cast<Number>()),
        stabiliser_(parts.stabiliser.cast<Number>()),
        readings_(parts.readings.cast<Number>()) {}

  void begin(const Eigen::VectorXd& answer) {
    f_ = answer.cast<Number>();
    left_ = readings_ - times(kernel_, f_);
  }
  [[nodiscard]] Eigen::VectorXd tractions() const { return f_.template cast<double>(); }

  /// K'(g - K f) - R f.
  [[nodiscard]] const Vector& next() {
    r_ = times(kernel_.transpose(), left_) - times(stabiliser_, f_);
    return r_;
  }

  /// Goes along d, and says how far: |w d|.
  double go(const Eigen::VectorXd& answer, RefinementStep step) {
    Direction way{answer.cast<Number>(), {}, {}, Number{1}};
    way.seen = times(kernel_, way.d);
    way.held = times(stabiliser_, way.d);
    if (step == RefinementStep::conjugate)
      for (const Direction& before : gone_) {
        const Number share = (way.seen.dot(before.seen) + way.d.dot(before.held)) / before.energy;
        way.d -= share * before.d;
        way.seen -= share * before.seen;
        way.held -= share * before.held;
      }
    way.energy = way.seen.squaredNorm() + way.d.dot(way.held);
    const Number w = step == RefinementStep::plain ? Number{1} : Number(r_.dot(way.d) / way.energy);
    if (!std::isfinite(w)) return 0.0;  // nothing is left
    f_ += w * way.d;
    left_ -= w * way.seen;
    const auto length = static_cast<double>(std::abs(w) * way.d.norm());
    if (step == RefinementStep::conjugate) gone_.push_back(std::move(way));
    return length;
  }

 private:
  struct Direction {
    Vector d, seen, held;  // d, K d, R d
    Number energy;         // d'P d
  };
  static Vector times(const auto& a, const Vector& x) { return a.lazyProduct(x); }

  Square kernel_, stabiliser_;
  Vector readings_, f_, left_, r_;
  std::vector<Direction> gone_;
};

/// Cycles of an exact pair of converters: far beyond where the error ends.
template <class Number>
double floor_of(const Refinement::Parts& parts, const SeenBuild& build) {
  constexpr int settled = 24;
  constexpr int looked_at = 8;
  Residual<Number> residual(parts);
  residual.begin(build.answer);
  double most = 0.0;
  for (int cycle = 0; cycle < settled; ++cycle) {
    const Eigen::VectorXd r = residual.next().template cast<double>();
    residual.go(build.inverse * r, RefinementStep::search);
    if (cycle >= settled - looked_at)
      most = std::max(most, (residual.tractions() - parts.direct).norm() / parts.direct.norm());
  }
  return most;
}

/// The largest singular value, from below.
double stretch_of(const Eigen::MatrixXd& a) {
  constexpr int most_steps = 300;
  const Eigen::VectorXd some = Eigen::VectorXd::LinSpaced(a.cols(), 1.0, 1.7);
  const auto squared = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return a.transpose() * (a * x);
  };
  return a.allFinite() ? std::sqrt(power_iteration(some, most_steps, 1e-9, squared)) : 0.0;
}

}  // namespace

Refined refined(const Refinement::Parts& parts, const SeenBuild& build, std::uint64_t trial,
                const Refinement::Answers& answers) {
  Refined result{.stable = build.stable, .deviation = stretch_of(parts.deviation(build.matrix))};
  if (!build.stable) {
    result.errors.assign(parts.options.cycles, std::numeric_limits<double>::infinity());
    return result;
  }
  const DrawnConverters converters(parts, trial);
  const double whole = parts.energy(parts.direct);
  const auto answered = [&](std::span<const double> sent, std::uint64_t cycle) {
    const std::vector<double> d = answers(sent);
    return converters.from_circuit(as_eigen(std::span(d)), cycle);
  };
  Residual<double> residual(parts);
  residual.begin(answered({}, 0));
  for (std::size_t cycle = 1;; ++cycle) {
    const Eigen::VectorXd f = residual.tractions();
    const Eigen::VectorXd error = f - parts.direct;
    result.tractions.emplace_back(f.begin(), f.end());
    result.errors.push_back(error.norm() / parts.direct.norm());
    result.energies.push_back(parts.energy(error) / whole);
    if (cycle == parts.options.cycles) return result;
    const Eigen::VectorXd sent = converters.to_circuit(residual.next());
    const double length = residual.go(answered(as_span(sent), cycle), parts.options.step);
    result.steps.push_back(length / residual.tractions().norm());
  }
}

double single_floor(const Refinement::Parts& parts, const SeenBuild& build) {
  return floor_of<float>(parts, build);
}
double double_floor(const Refinement::Parts& parts, const SeenBuild& build) {
  return floor_of<double>(parts, build);
}

}  // namespace tactile_net
