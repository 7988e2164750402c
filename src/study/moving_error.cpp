#include <algorithm>
#include <cmath>

#include "tactile_net/study/moving_contacts.hpp"

namespace tactile_net::study {
namespace {

/// Of an answer that is so far behind.
double displaced(const MovingContacts& contacts, double displacement) {
  const std::vector<double>& d = contacts.displacements;
  const std::vector<double>& e = contacts.errors;
  if (displacement <= d.front()) return e.front() * displacement / d.front();
  if (displacement >= d.back()) return e.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(d.begin(), d.end(), displacement) - d.begin());
  const double share = std::log(displacement / d[next - 1]) / std::log(d[next] / d[next - 1]);
  return e[next - 1] * std::pow(e[next] / e[next - 1], share);
}

/// The least x from `low` to `high` at which a condition holds, to 1e-12 of itself; it need not
/// hold beyond, but for a tenth of x where it does.
template <typename Condition>
std::optional<double> first(double low, double high, const Condition& holds) {
  if (holds(low)) return low;
  double before = low;
  double next = low;
  do {
    if (!(next < high)) return std::nullopt;
    before = next;
    next = std::min(1.1 * next, high);
  } while (!holds(next));
  while (next > before * (1.0 + 1e-12)) {
    const double middle = std::sqrt(before * next);
    if (!(middle > before && middle < next)) break;
    (holds(middle) ? next : before) = middle;
  }
  return next;
}

/// Speeds between which everything happens: far below the slowest follower's first displacement, to
/// the fastest one's last.
std::pair<double, double> range(const MovingContacts& contacts) {
  double slowest = 0.0;
  double fastest = HUGE_VAL;
  for (const Follower& one : contacts.followers) {
    slowest = std::max(slowest, one.delay);
    fastest = std::min(fastest, one.delay);
  }
  return {1e-9 * contacts.displacements.front() / slowest, contacts.displacements.back() / fastest};
}

}  // namespace

double error_behind(const MovingContacts& contacts, const Follower& follower, double speed) {
  if (follower.realization) return displaced(contacts, speed * follower.delay);
  constexpr int ages = 64;
  double squares = 0.0;
  for (int k = 0; k < ages; ++k) {
    const double age = (k + 0.5) / ages / follower.sampling_hertz;
    squares += std::pow(displaced(contacts, speed * age), 2);
  }
  return std::sqrt(squares / ages);
}

std::optional<double> speed_at_error(const MovingContacts& contacts, const Follower& follower,
                                     double error) {
  const auto [low, high] = range(contacts);
  return first(low, high,
               [&](double speed) { return error_behind(contacts, follower, speed) > error; });
}

std::optional<double> crossover_speed(const MovingContacts& contacts, const Follower& circuit,
                                      double at_rest, const Follower& loop) {
  const auto [low, high] = range(contacts);
  return first(low, high, [&](double speed) {
    return error_behind(contacts, loop, speed) >
           std::hypot(at_rest, error_behind(contacts, circuit, speed));
  });
}

std::vector<double> shown_speeds(const MovingContacts& contacts) {
  double first = HUGE_VAL;
  double last = 0.0;
  for (const Follower& one : contacts.followers) {
    const auto speed = speed_at_error(contacts, one, 0.01);
    if (!speed) continue;
    first = std::min(first, *speed);
    last = std::max(last, *speed);
  }
  std::vector<double> speeds;
  if (!(last > 0.0)) return speeds;
  const auto half_decade = [](double speed) {
    return static_cast<int>(std::floor(2.0 * std::log10(speed)));
  };
  for (int k = half_decade(first) - 2; k <= half_decade(last) + 2; ++k)
    speeds.push_back(std::pow(10.0, 0.5 * k));
  return speeds;
}

}  // namespace tactile_net::study
