#include "tactile_net/numeric/distribution.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
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

constexpr double most_terms_of_student = 2000.0;

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

/// A starting point: its error is below 4.5e-4 (Abramowitz and Stegun 1964, 26.2.23).
double gaussian_quantile(double p) {
  const double t = std::sqrt(-2.0 * std::log(std::min(p, 1.0 - p)));
  const double z = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                           (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  return p < 0.5 ? -z : z;
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

Distribution Distribution::moved_by(double deviation) const {
  require(deviation >= 0.0 && std::isfinite(deviation), "deviation", "be >= 0 and finite",
          deviation);
  Distribution moved = *this;
  for (Component& one : moved.components_)
    one.scale = std::hypot(one.scale, deviation * one.divisor);
  moved.find_moments();
  return moved;
}

void Distribution::find_moments() {
  const double spread = std::isinf(degrees_) ? 1.0
                        : degrees_ > 2.0     ? std::sqrt(degrees_ / (degrees_ - 2.0))
                                             : std::numeric_limits<double>::infinity();
  double numerator = 0.0;
  double denominator = 0.0;
  std::vector<std::pair<double, double>> moments;  // mean and deviation of max(x, least)
  moments.reserve(components_.size());
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
  std::vector<double> parts;  // whose squares' sum is the variance
  parts.reserve(2 * components_.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const Component& one = components_[i];
    const auto& [mean, size] = moments[i];
    const double own = one.divisor_scale > 0.0 ? spread * scale_at(one, mean_) : size;
    const double share = std::sqrt(one.probability) / denominator;
    for (const double part : {share * own, share * (mean - mean_ * one.divisor)}) {
      parts.push_back(std::abs(part));
      largest = std::max(largest, parts.back());
    }
  }
  deviation_ = largest;
  if (!(largest > 0.0) || std::isinf(largest)) return;
  double sum = 0.0;
  for (const double part : parts) sum += (part / largest) * (part / largest);
  deviation_ = largest * std::sqrt(sum);
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

/// F, and how fast it rises, of a mixture without its bound.
class Distribution::Rising {
 public:
  /// @param p  of the quantile that is sought: where it is small no table tells it
  Rising(const Distribution& of, double p) : of_(of), left_out_(p) {
    const double degrees = of.degrees_;
    if (degrees <= most_terms_of_student && degrees == std::floor(degrees)) {
      table_ = &tabled_student(static_cast<int>(degrees));
      const bool is_tabled = std::min(p, 1.0 - p) > least_of_table;
      end_ = is_tabled ? table_->end() : StudentCdf::reach;
      ends_ = is_tabled && table_->holds_all();
    } else if (std::isfinite(degrees)) {
      student_.emplace(degrees);
    }
  }

  /// Less p.
  [[nodiscard]] StudentCdf::Rise at(double x) const {
    StudentCdf::Rise sum{.value = -left_out_};
    for (const Component& one : of_.components_) {
      const double off = x * one.divisor - one.mean;
      const double size = scale_at(one, x);
      if (size == 0.0) {
        sum.value += off >= 0.0 ? one.probability : 0.0;
        continue;
      }
      const double z = off / size;
      double faster = one.divisor / size;
      if (one.divisor_scale != 0.0)
        faster -= z * ((x * one.divisor_scale * one.divisor_scale - one.covariance) / size) / size;
      const StudentCdf::Rise own = standard(z);
      sum.value += one.probability * own.value;
      sum.slope += one.probability * own.slope * faster;
    }
    return sum;
  }

 private:
  static constexpr double least_of_table = 1e-4;  // errs by 1e-12

  [[nodiscard]] StudentCdf::Rise standard(double z) const {
    if (table_ != nullptr && std::abs(z) < end_) return table_->rise(z);
    if (ends_) return {z < 0.0 ? 0.0 : 1.0, 0.0};
    const double value = of_.standard_cdf(z);
    if (std::isinf(of_.degrees_)) return {value, gaussian_density(z)};
    if (!std::isfinite(z)) return {value, 0.0};
    return {value, boost::math::pdf(student_ ? *student_ : Student(of_.degrees_), z)};
  }

  const Distribution& of_;
  double left_out_;
  const StudentCdf* table_ = nullptr;
  double end_ = 0.0;
  bool ends_ = false;  // beyond is nothing
  std::optional<Student> student_{};
};

double Distribution::quantile(double p) const {
  require(p > 0.0 && p < 1.0, "p", "lie between 0 and 1", p);
  const auto bounded = [&](double x) { return least_ ? std::max(x, *least_) : x; };
  const Rising rising(*this, p);
  // Where a certain component lies the probability jumps: the quantile may be there exactly.
  double low = -std::numeric_limits<double>::infinity();
  double high = -low;
  double size = 0.0;
  for (const Component& one : components_) {
    const auto [place, own] = place_and_size(one);
    size = std::max(size, own);
    if (own > 0.0 || place <= low || place >= high) continue;
    const double here = rising.at(place).value;
    double jump = 0.0;
    for (const Component& other : components_)
      if (const auto [at, width] = place_and_size(other); width == 0.0 && at == place)
        jump += other.probability;
    if (here >= 0.0 && here - jump < 0.0) return bounded(place);
    (here < 0.0 ? low : high) = place;
  }
  // Newton's steps from where a Gaussian's would be; between what is known to lie below and above
  // where they leave that or come no nearer, and twice as far each time where neither is known.
  constexpr int most_steps = 1300;  // of doubling: to the ends of double precision
  constexpr double precision = 1e-12;
  double step = std::isfinite(deviation_) && deviation_ > 0.0 ? deviation_ : size;
  const auto tolerance = [scale = step](double x) {
    return precision * std::max(scale, std::abs(x));
  };
  double x = mean_ + step * gaussian_quantile(p);
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    if (!(x > low && x < high))
      x = std::isinf(low)    ? high - (step *= 2.0)
          : std::isinf(high) ? low + (step *= 2.0)
                             : low + 0.5 * (high - low);
    if (high - low <= tolerance(x)) break;
    const auto [off, slope] = rising.at(x);
    (off < 0.0 ? low : high) = x;
    const double newton = -off / slope;
    if (std::abs(newton) <= tolerance(x)) return bounded(x + newton);
    const bool is_nearer = std::abs(off) < 0.5 * before;
    before = std::abs(off);
    x = is_nearer ? x + newton : std::numeric_limits<double>::quiet_NaN();
  }
  return bounded(x);
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
