#include "numeric/student_cdf.hpp"

#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

namespace tactile_net {
namespace {

constexpr double no_rest = 1e-17;  // of 1 - F

/// F, and its first two derivatives times the step and its square.
std::array<double, 3> at_place(int degrees, double t, double step) {
  const double n = degrees;
  const double log_size =
      std::lgamma(0.5 * (n + 1.0)) - std::lgamma(0.5 * n) - 0.5 * std::log(n * std::numbers::pi);
  const double density = std::exp(log_size - 0.5 * (n + 1.0) * std::log1p(t * t / n));
  const double slope = -density * t * (n + 1.0) / (n + t * t);
  return {student_series(degrees, t), density * step, slope * step * step};
}

}  // namespace

double student_series(int degrees, double t) {
  const double n = degrees;
  const double cos2 = n / (n + t * t);
  double sum = 0.0;
  for (int k = degrees - 2; k >= 2; k -= 2)
    sum = (1.0 + sum) * cos2 * static_cast<double>(k - 1) / static_cast<double>(k);
  const double sine = std::abs(t) / std::sqrt(n + t * t);
  double inside = sine * (1.0 + sum);  // P(|T| < |t|)
  if (degrees % 2 == 1) {
    inside = std::atan(std::abs(t) / std::sqrt(n));
    if (degrees > 1) inside += sine * std::sqrt(cos2) * (1.0 + sum);
    inside *= 2.0 / std::numbers::pi;
  }
  return 0.5 * (1.0 + std::copysign(inside, t));
}

StudentCdf::StudentCdf(int degrees) : degrees_(degrees) {
  constexpr double step = 1.0 / pieces_in_one;
  std::array<double, 3> left = at_place(degrees, 0.0, step);
  // Beyond t there is less than t times the density.
  while (end_ < most_reach && (end_ < reach || end_ * left[1] * pieces_in_one > no_rest)) {
    end_ += step;
    const std::array<double, 3> right = at_place(degrees, end_, step);
    const double rise = right[0] - left[0] - left[1] - 0.5 * left[2];
    const double slope = right[1] - left[1] - left[2];
    const double curve = right[2] - left[2];
    pieces_.push_back({left[0], left[1], 0.5 * left[2], 10.0 * rise - 4.0 * slope + 0.5 * curve,
                       -15.0 * rise + 7.0 * slope - curve, 6.0 * rise - 3.0 * slope + 0.5 * curve});
    left = right;
  }
}

const StudentCdf& StudentCdf::of(int degrees) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<const StudentCdf>> all;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const StudentCdf>& one = all[degrees];
  if (!one) one = std::make_unique<const StudentCdf>(degrees);
  return *one;
}

double StudentCdf::operator()(double t) const {
  return std::abs(t) < end_ ? rise(t).value : student_series(degrees_, t);
}

}  // namespace tactile_net
