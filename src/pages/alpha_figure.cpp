#include "pages/alpha_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::pages {
namespace {

constexpr std::size_t colours = 6;  // of curves, in web/chart.js

}  // namespace

drawing::Figure alpha_figure(const AlphaSweep& sweep, std::optional<AlphaRule> used,
                             std::string_view section) {
  drawing::Plot plot{"What each rule for alpha makes least",
                     "alpha [unit of K'K]",
                     "criterion, 0 to 1",
                     sweep.alphas,
                     {},
                     true};
  for (const AlphaSweep::Curve& curve : sweep.curves) {
    std::vector<double> values = curve.values;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (!(high > low)) continue;  // without readings a rule has nothing to choose by
    for (double& value : values) value = (value - low) / (high - low);
    drawing::Curve drawn{std::string(name(curve.rule)) + " " + brief(curve.choice.alpha), values,
                         1 + plot.curves.size()};
    drawn.width = curve.rule == used ? 4.0 : 1.5;
    drawn.dashed = plot.curves.size() >= colours;  // which then come again
    const auto chosen = std::lower_bound(sweep.alphas.begin(), sweep.alphas.end() - 1,
                                         curve.choice.alpha * (1.0 - 1e-9));
    drawn.names.resize(sweep.alphas.size());
    drawn.names[static_cast<std::size_t>(chosen - sweep.alphas.begin())] =
        std::string(name(curve.rule)) + (curve.rule == used ? ", used" : "");
    plot.curves.push_back(std::move(drawn));
  }
  return {"alpha", std::string(section),
          "Every rule's criterion over alpha, each scaled to run from 0 to 1; a rule chooses where "
          "its own curve is lowest, at its name and the value in the key; the thick one was used. "
          "A flat valley "
          "means that other values do as well; valleys far apart mean that the rules disagree.",
          std::move(plot)};
}

}  // namespace tactile_net::pages
