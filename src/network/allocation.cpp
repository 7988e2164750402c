#include "tactile_net/network/allocation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tactile_net {
namespace {

void check(std::span<const double> sensitivities, const AllocationOptions& options) {
  if (!(options.target > 0.0) || !std::isfinite(options.target))
    throw std::invalid_argument("an allocation's target must be > 0 and finite");
  if (options.classes.empty()) throw std::invalid_argument("an allocation needs a class of parts");
  for (const PartClass& one : options.classes)
    if (!(one.tolerance > 0.0 && one.tolerance < 1.0) || !(one.price >= 0.0) ||
        !std::isfinite(one.price))
      throw std::invalid_argument("a class of parts needs 0 < tolerance < 1 and a price >= 0");
  for (std::size_t c = 1; c < options.classes.size(); ++c)
    if (!(options.classes[c].tolerance < options.classes[c - 1].tolerance) ||
        options.classes[c].price < options.classes[c - 1].price)
      throw std::invalid_argument(
          "classes of parts stand in order: each finer than the one before, and not cheaper");
  for (const double one : sensitivities)
    if (!(one >= 0.0) || !std::isfinite(one))
      throw std::invalid_argument("sensitivities must be >= 0 and finite");
}

/// The list of a price on squared error, and what it comes to.
class Market {
 public:
  Market(std::span<const double> sensitivities, const std::vector<PartClass>& classes)
      : sensitivities_(sensitivities), classes_(classes) {}

  /// Squared error that a resistor of a class adds.
  [[nodiscard]] double error(std::size_t resistor, std::size_t of_class) const {
    const auto& [tolerance, price, spread] = classes_[of_class];
    return sensitivities_[resistor] * (spread ? *spread * *spread : tolerance * tolerance / 3.0);
  }

  [[nodiscard]] double price(std::size_t of_class) const { return classes_[of_class].price; }

  [[nodiscard]] std::vector<std::size_t> cheapest(double per_error) const {
    std::vector<std::size_t> list(sensitivities_.size());
    for (std::size_t r = 0; r < list.size(); ++r)
      for (std::size_t c = 1; c < classes_.size(); ++c)
        if (price(c) + per_error * error(r, c) < price(list[r]) + per_error * error(r, list[r]))
          list[r] = c;
    return list;
  }

  [[nodiscard]] double error(const std::vector<std::size_t>& list) const {
    double sum = 0.0;
    for (std::size_t r = 0; r < list.size(); ++r) sum += error(r, list[r]);
    return sum;
  }

  [[nodiscard]] double price(const std::vector<std::size_t>& list) const {
    double sum = 0.0;
    for (const std::size_t c : list) sum += price(c);
    return sum;
  }

  /// Spends what is left of the error on coarser parts, where it saves most first.
  void coarsen(std::vector<std::size_t>& list, double left) const {
    struct Step {
      std::size_t resistor = 0;
      double saved = 0.0;
      double error = 0.0;
    };
    std::vector<Step> steps;
    for (std::size_t r = 0; r < list.size(); ++r)
      if (list[r] > 0)
        steps.push_back(
            {r, price(list[r]) - price(list[r] - 1), error(r, list[r] - 1) - error(r, list[r])});
    std::sort(steps.begin(), steps.end(),
              [](const Step& a, const Step& b) { return a.saved * b.error > b.saved * a.error; });
    for (const Step& step : steps)
      if (step.error <= left) {
        left -= step.error;
        --list[step.resistor];
      }
  }

 private:
  std::span<const double> sensitivities_;
  const std::vector<PartClass>& classes_;
};

Allocation described(const Market& market, std::vector<std::size_t> list, std::size_t classes) {
  Allocation result{.class_of = std::move(list), .counts = std::vector<std::size_t>(classes)};
  for (const std::size_t c : result.class_of) ++result.counts[c];
  result.price = market.price(result.class_of);
  result.p95 = p95_over_rms * std::sqrt(market.error(result.class_of));
  return result;
}

}  // namespace

Allocation allocate(std::span<const double> sensitivities, const AllocationOptions& options) {
  check(sensitivities, options);
  const Market market(sensitivities, options.classes);
  const double allowed = std::pow(options.target / p95_over_rms, 2);
  const std::size_t classes = options.classes.size();
  const std::vector<std::size_t> finest(sensitivities.size(), classes - 1);
  if (market.error(finest) > allowed) {
    Allocation none = described(market, finest, classes);
    none.price_bound = none.price;
    return none;
  }

  // The least price on error that keeps to it: bracketed by powers of 4, then halved.
  double low = 0.0;
  std::vector<std::size_t> list = market.cheapest(low);
  if (market.error(list) > allowed) {
    double high = options.classes.back().price / allowed + 1.0 / allowed;
    while (market.error(market.cheapest(high)) > allowed) {
      low = high;
      high *= 4.0;
    }
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = 0.5 * (low + high);
      (market.error(market.cheapest(middle)) > allowed ? low : high) = middle;
    }
    list = market.cheapest(high);
    low = high;
  }
  const double bound = market.price(list) + low * (market.error(list) - allowed);
  market.coarsen(list, allowed - market.error(list));
  Allocation result = described(market, std::move(list), classes);
  result.price_bound = bound;
  result.met = true;
  return result;
}

}  // namespace tactile_net
