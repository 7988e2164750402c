#include "report/json/course.hpp"

#include <algorithm>
#include <cmath>

#include "report/json/rounded.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::report {

std::string bands_in_words(double level, bool interval, bool deviation) {
  const std::string of_deviations = "two standard deviations";
  if (!interval) return deviation ? of_deviations : "";
  return percent(level) + " intervals" + (deviation ? ", elsewhere " + of_deviations : "");
}

Json course_json(const std::optional<Units>& units, double level, const std::string& title,
                 const std::string& axis, Dimension dimension, const std::vector<Course>& courses) {
  double most = 0.0;
  for (const Course& course : courses)
    for (const double value : course.values)
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
  if (!(most > 0.0)) return nullptr;
  const ScaledUnit unit = axis_unit(units, dimension, most);
  const auto list = [&](const std::vector<double>& values) {
    Json json = Json::array();
    for (const double value : values) json.push_back(rounded_or_null(value * unit.factor));
    return json;
  };
  Json lines = Json::array();
  bool interval = false, deviation = false;
  for (const Course& course : courses) {
    lines.push_back({{"label", course.label},
                     {"colour", course.colour},
                     {"dashed", course.dashed},
                     {"y", list(course.values)}});
    if (course.has_band() && !course.dashed) {
      interval = interval || course.any_interval;
      deviation = deviation || course.any_deviation;
      lines.back()["low"] = list(course.low);
      lines.back()["high"] = list(course.high);
    }
  }
  return {{"title", title},
          {"label", axis + (unit.label.empty() ? "" : " [" + unit.label + "]")},
          {"bands", bands_in_words(level, interval, deviation)},
          {"lines", std::move(lines)}};
}

}  // namespace tactile_net::report
