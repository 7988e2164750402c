#include <algorithm>
#include <string>
#include <utility>

#include "pages/tradeoff_figures.hpp"
#include "tactile_net/report/words/tradeoff_words.hpp"

namespace tactile_net::pages {
namespace {

using drawing::Curve;
using drawing::Figure;
using drawing::Plot;

constexpr double least_shown = 1e-6;

/// Of one follower at every speed.
Curve error_curve(const study::MovingContacts& moving, const study::Follower& follower,
                  const std::vector<double>& speeds) {
  Curve curve;
  curve.label = report::in_words(follower);
  for (const double speed : speeds) {
    const double error = study::error_behind(moving, follower, speed);
    if (!(error > least_shown)) continue;
    curve.x.push_back(speed);
    curve.y.push_back(error);
  }
  if (!follower.realization) curve.width = 3.0;
  return curve;
}

/// Every follower, and what parts of 1 % leave of circuits at any speed.
std::vector<Curve> curves_of(const study::Study& study, const study::MovingContacts& moving) {
  std::vector<Curve> curves;
  const std::vector<double> speeds = study::shown_speeds(moving);
  if (speeds.empty()) return curves;
  for (const study::Follower& one : moving.followers) {
    curves.push_back(error_curve(moving, one, speeds));
    curves.back().colour = curves.size();
  }
  for (const study::StudySection& section : study.sections)
    for (const study::PartsFloor& floor : section.floors) {
      const auto own = std::find_if(
          moving.followers.begin(), moving.followers.end(),
          [&](const study::Follower& one) { return one.realization == floor.realization; });
      if (floor.relative != study::one_percent || !(floor.median.value_or(1.0) < 1.0) ||
          own == moving.followers.end())
        continue;
      Curve line;
      line.label = report::in_words(*own) + ", 1 % parts";
      line.x = {speeds.front(), speeds.back()};
      line.y = {*floor.median, *floor.median};
      line.colour = 1 + static_cast<std::size_t>(own - moving.followers.begin());
      line.dashed = true;
      curves.push_back(std::move(line));
    }
  return curves;
}

}  // namespace

Figure moving_figure(const study::Study& study) {
  Plot plot;
  plot.title = "Contacts that move: error over speed";
  plot.x_label = study.input.units() ? "speed [m/s]" : "speed [units of the pitch a second]";
  plot.y_label = "error of the answer, relative";
  plot.logarithmic_x = true;
  plot.logarithmic_y = true;
  plot.wide = true;
  for (const study::StudySection& section : study.sections)
    if (section.moving) plot.curves = curves_of(study, *section.moving);
  return {.name = "moving",
          .section = "moving",
          .caption =
              "Behind contacts that move: how far the answer is from the exact one to where they "
              "are. Heavy: loops. Dashed: what parts of 1 % leave of a circuit at any speed "
              "(median). Right of where a loop's line crosses a dashed one the circuit is nearer. "
              "Beyond some tens of per cent the answer is one to another place.",
          .plot = std::move(plot)};
}

}  // namespace tactile_net::pages
