#include "tactile_net/numeric/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "numeric/gauss_rule.hpp"
#include "numeric/require.hpp"
#include "numeric/student_cdf.hpp"

namespace tactile_net {
namespace {

using Component = Distribution::Component;

using StudentPolicy = boost::math::policies::policy<
    boost::math::policies::promote_double<false>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using Student = boost::math::students_t_distribution<double, StudentPolicy>;

double gaussian_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}
double gaussian_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

constexpr double most_terms_of_student = 400.0;

/// The table that this thread asked for last: those of a frame's distributions are one.
const StudentCdf& tabled_student(int degrees) {
  thread_local const StudentCdf* last = nullptr;
  thread_local int last_degrees = 0;
  if (last_degrees != degrees) {
    last = &StudentCdf::of(degrees);
    last_degrees = degrees;
  }
  return *last;
}

/// The scale of numerator - x denominator.
double scale_at(const Component& one, double x) {
  if (one.divisor_scale == 0.0) return one.scale;
  const double squares = one.scale * one.scale - 2.0 * x * one.covariance +
                         x * x * one.divisor_scale * one.divisor_scale;
  return std::sqrt(std::max(squares, 0.0));
}

/// Where a component lies, and how wide it is.
std::pair<double, double> place_and_size(const Component& one) {
  const double place = one.mean / one.divisor;
  return {place, scale_at(one, place) / one.divisor};
}

/// Of a standard variable t cut below `a`: the mean of t and of t^2 where it lies above, each times
/// the probability that it does.
std::pair<double, double> moments_above(double a, double degrees) {
  if (std::isinf(degrees)) {
    const double density = gaussian_density(a);
    return {density, gaussian_cdf(-a) + a * density};
  }
  const Student t(degrees);
  const double first = degrees > 1.0 ? (degrees + a * a) / (degrees - 1.0) * boost::math::pdf(t, a)
                                     : std::numeric_limits<double>::infinity();
  if (!(degrees > 2.0)) return {first, std::numeric_limits<double>::infinity()};
  const double above_wider = boost::math::cdf(
      boost::math::complement(Student(degrees - 2.0), a * std::sqrt((degrees - 2.0) / degrees)));
  const double above = boost::math::cdf(boost::math::complement(t, a));
  return {first, degrees * ((degrees - 1.0) / (degrees - 2.0) * above_wider - above)};
}

}  // namespace

Distribution::Distribution(std::vector<Component> components, double degrees)
    : components_(std::move(components)), degrees_(degrees) {
  require(!components_.empty(), "a distribution needs one component at least");
  require(degrees > 0.0, "degrees", "be > 0", degrees);
  double sum = 0.0;
  for (const Component& one : components_) {
    require(one.probability >= 0.0 && std::isfinite(one.probability), "probability",
            "be >= 0 and finite", one.probability);
    require_finite("mean", one.mean);
    require(one.scale >= 0.0 && std::isfinite(one.scale), "scale", "be >= 0 and finite", one.scale);
    require_positive("divisor", one.divisor);
    require(one.divisor_scale >= 0.0 && std::isfinite(one.divisor_scale), "divisor_scale",
            "be >= 0 and finite", one.divisor_scale);
    require_finite("covariance", one.covariance);
    sum += one.probability;
  }
  require_positive("the components' probability together", sum);
  for (Component& one : components_) one.probability /= sum;
  find_moments();
}

Distribution Distribution::at_least(double least) const {
  require_finite("least", least);
  for (const Component& one : components_)
    require(one.divisor_scale == 0.0, "a ratio has no moments that a bound could leave");
  Distribution bounded = *this;
  bounded.least_ = least_ ? std::max(*least_, least) : least;
  bounded.find_moments();
  return bounded;
}

void Distribution::find_moments() {
  const double spread = std::isinf(degrees_) ? 1.0
                        : degrees_ > 2.0     ? std::sqrt(degrees_ / (degrees_ - 2.0))
                                             : std::numeric_limits<double>::infinity();
  double numerator = 0.0;
  double denominator = 0.0;
  std::vector<std::pair<double, double>> moments;  // mean and deviation of max(x, least)
  for (const Component& one : components_) {
    auto& [mean, size] = moments.emplace_back(one.mean, one.scale > 0.0 ? spread * one.scale : 0.0);
    if (least_ && one.scale == 0.0) mean = std::max(mean, *least_ * one.divisor);
    if (least_ && one.scale > 0.0) {
      const double a = (*least_ * one.divisor - one.mean) / one.scale;
      const auto [first, second] = moments_above(a, degrees_);
      const double above = 1.0 - standard_cdf(a);
      // Of t less a where it lies above, of which neither place nor bound is left to cancel.
      const double beyond = first - a * above;
      const double square = second - 2.0 * a * first + a * a * above;
      mean = *least_ * one.divisor + one.scale * beyond;
      size = std::sqrt(std::max(square - beyond * beyond, 0.0)) * one.scale;
    }
    numerator += one.probability * mean;
    denominator += one.probability * one.divisor;
  }
  mean_ = numerator / denominator;
  deviation_ = 0.0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const Component& one = components_[i];
    const auto& [mean, size] = moments[i];
    const double own = one.divisor_scale > 0.0 ? spread * scale_at(one, mean_) : size;
    const double share = std::sqrt(one.probability) / denominator;
    // Two by two: std::hypot of three is none of infinity.
    deviation_ =
        std::hypot(deviation_, std::hypot(share * own, share * (mean - mean_ * one.divisor)));
  }
}

double Distribution::standard_cdf(double z) const {
  if (std::isinf(z)) return z > 0.0 ? 1.0 : 0.0;
  if (std::isinf(degrees_)) return gaussian_cdf(z);
  if (std::abs(z) < StudentCdf::reach && degrees_ <= most_terms_of_student &&
      degrees_ == std::floor(degrees_))
    return tabled_student(static_cast<int>(degrees_))(z);
  return boost::math::cdf(Student(degrees_), z);
}

double Distribution::cdf_of(const Component& one, double x) const {
  const double off = x * one.divisor - one.mean;
  const double size = scale_at(one, x);
  if (size == 0.0) return off >= 0.0 ? 1.0 : 0.0;
  return standard_cdf(off / size);
}

double Distribution::cdf(double x) const {
  if (least_ && x < *least_) return 0.0;
  double sum = 0.0;
  for (const Component& one : components_) sum += one.probability * cdf_of(one, x);
  return std::min(sum, 1.0);
}

double Distribution::quantile(double p) const {
  require(p > 0.0 && p < 1.0, "p", "lie between 0 and 1", p);
  const auto bounded = [&](double x) { return least_ ? std::max(x, *least_) : x; };
  const auto unbounded = [&](double x) {
    double sum = -p;
    for (const Component& one : components_) sum += one.probability * cdf_of(one, x);
    return sum;
  };
  // Where a certain component lies the probability jumps: the quantile may be there exactly.
  double low = -std::numeric_limits<double>::infinity();
  double high = -low;
  double size = 0.0;
  for (const Component& one : components_) {
    const auto [place, own] = place_and_size(one);
    size = std::max(size, own);
    if (own > 0.0 || place <= low || place >= high) continue;
    const double here = unbounded(place);
    double jump = 0.0;
    for (const Component& other : components_)
      if (const auto [at, width] = place_and_size(other); width == 0.0 && at == place)
        jump += other.probability;
    if (here >= 0.0 && here - jump < 0.0) return bounded(place);
    (here < 0.0 ? low : high) = place;
  }
  // Most quantiles that anybody asks for lie within a few deviations of the mean.
  constexpr int most_steps = 1100;  // of doubling: to the ends of double precision
  double step = std::isfinite(deviation_) && deviation_ > 0.0 ? deviation_ : size;
  const double middle = std::clamp(mean_, low, high);
  double at_low = std::isinf(low) ? 0.0 : unbounded(low);
  double at_high = std::isinf(high) ? 0.0 : unbounded(high);
  if (std::isinf(low)) {
    low = std::min(middle, high) - 2.0 * step;
    for (int i = 0; i < most_steps && (at_low = unbounded(low)) >= 0.0; ++i) {
      high = low;
      at_high = at_low;
      low -= step *= 2.0;
    }
  }
  if (std::isinf(high)) {
    high = std::max(middle, low) + 2.0 * step;
    for (int i = 0; i < most_steps && (at_high = unbounded(high)) < 0.0; ++i) {
      low = high;
      at_low = at_high;
      high += step *= 2.0;
    }
  }
  if (!(at_low < 0.0 && at_high > 0.0)) return bounded(at_high > 0.0 ? low : high);
  std::uintmax_t evaluations = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      unbounded, low, high, at_low, at_high,
      [&](double a, double b) {
        constexpr double precision = 1e-12;
        return std::abs(b - a) <= precision * std::max(step, std::max(std::abs(a), std::abs(b)));
      },
      evaluations, StudentPolicy());
  return bounded(0.5 * (bracket.first + bracket.second));
}

CentralInterval Distribution::interval(double level) const {
  require(level > 0.0 && level < 1.0, "level", "lie between 0 and 1", level);
  const double left_out = 0.5 * (1.0 - level);
  return {.level = level, .low = quantile(left_out), .high = quantile(1.0 - left_out)};
}

double Distribution::crps(double x) const {
  // Between these the integrand is smooth; tails fall as a power of Student's degrees.
  std::vector<double> ends{x};
  if (least_) ends.push_back(*least_);
  for (const Component& one : components_) {
    const auto [place, size] = place_and_size(one);
    ends.push_back(place);
    const double furthest = std::isinf(degrees_) ? 40.0 : 1e5;
    for (double away = 0.5; away < furthest; away *= away < 4.0 ? 1.5 : 2.0) {
      ends.push_back(place - away * size);
      ends.push_back(place + away * size);
    }
  }
  std::sort(ends.begin(), ends.end());
  const GaussRule rule = gauss_rule<10>();
  double sum = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double half = 0.5 * (ends[i] - ends[i - 1]);
    const double middle = 0.5 * (ends[i] + ends[i - 1]);
    if (half == 0.0) continue;
    for (std::size_t k = 0; k < rule.abscissa.size(); ++k)
      for (const double way : {-1.0, 1.0}) {
        const double at = middle + way * half * rule.abscissa[k];
        const double off = cdf(at) - (at >= x ? 1.0 : 0.0);
        sum += rule.weights[k] * half * off * off;
      }
  }
  return sum;
}

}  // namespace tactile_net
