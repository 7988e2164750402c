#include <algorithm>

#include "report/load_dimension.hpp"
#include "report/words/calibration_parts.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/calibration_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"
#include "tactile_net/scene/calibrated_scene.hpp"

namespace tactile_net::report {
namespace {

/// What is left of the criterion that presses are planned by: a share, or a shift's deviation.
std::string unknown(const lab::SceneCalibration& found, double value) {
  if (found.target == PadParameter::shift || found.target == PadParameter::shift_z)
    return in_unit(found.units(), Dimension::length, value);
  return brief(100.0 * value) + " %";
}

}  // namespace

std::vector<std::vector<std::string>> next_press_cells(const lab::SceneCalibration& found) {
  const auto length = [&](double value) {
    return in_unit(found.units(), Dimension::length, value);
  };
  std::vector<std::vector<std::string>> rows = {
      {"next press", "place", "rod radius", "half width", "force", "unknown then"}};
  if (found.is_skin())
    rows = {{"next press", "shape", "y", "z", "ball radius", "contact radius", "force",
             "unknown then"}};
  for (const NextPress& press : found.next.presses) {
    std::vector<std::string> row{std::to_string(rows.size())};
    if (found.is_skin()) {
      row.emplace_back(name(press.disc));
      row.insert(row.end(), {length(press.position), length(press.position_z),
                             press.radius > 0.0 ? length(press.radius) : "-"});
    } else {
      row.insert(row.end(), {length(press.position), length(press.radius)});
    }
    row.insert(row.end(), {length(press.half_width),
                           in_unit(found.units(), load_dimension(found.is_skin()), press.force),
                           unknown(found, press.remaining)});
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string next_presses_in_words(const lab::SceneCalibration& found) {
  if (found.next.presses.empty()) return {};
  const bool is_skin = found.is_skin();
  const std::string of_target = found.target ? " of the " + spoken_parameter(*found.target, is_skin)
                                             : " of readings under loads all over it";
  const std::string known = is_found(found.fit.at(PadParameter::youngs_modulus).verdict)
                                ? ""
                                : ", if Young's modulus is as stated";
  const std::string now = "Now " + unknown(found, found.next.now) + of_target + " is unknown. ";
  if (is_skin) {
    const bool balls =
        std::any_of(found.next.presses.begin(), found.next.presses.end(),
                    [](const NextPress& press) { return press.disc == DiscProfile::sphere; });
    return now +
           (balls ? "A ball of that radius has that contact under that force" + known +
                        "; a ball of about that size will do. "
                  : std::string()) +
           "Press straight down. The plain rule: the largest force, evenly over the skin to its "
           "edges, small and large contacts in turn.";
  }
  return now + "A rod of that radius has that half width of contact under that force" + known +
         "; a rod of about that size will do. The plain rule: the largest force, evenly over the "
         "array to its ends, narrow and wide rods in turn.";
}

}  // namespace tactile_net::report
