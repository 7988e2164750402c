#include "frames/log_sensor.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <variant>

#include "numeric/named.hpp"
#include "tactile_net/calibration/ball_contact.hpp"
#include "tactile_net/calibration/rod_contact.hpp"
#include "tactile_net/skin/signal_layout.hpp"

namespace tactile_net::frames {
namespace {

constexpr std::array line_shapes = {std::pair{std::string_view("cylinder"), Shape::cylinder},
                                    std::pair{std::string_view("punch"), Shape::punch},
                                    std::pair{std::string_view("wedge"), Shape::wedge}};
const std::array skin_shapes = {std::pair{name(DiscProfile::sphere), DiscProfile::sphere},
                                std::pair{name(DiscProfile::punch), DiscProfile::punch},
                                std::pair{name(DiscProfile::cone), DiscProfile::cone}};

template <typename Shapes, typename Kind>
bool set(const Shapes& shapes, std::string_view text, Kind& kind) {
  for (const auto& [name, value] : shapes)
    if (name == text) {
      kind = value;
      return true;
    }
  return false;
}

LogSensor::End ends(const std::vector<double>& places) {
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  return {*low, *high};
}

SignalLayout signal_layout_of(const Scene& scene) { return {scene.sensor}; }
SignalLayout signal_layout_of(const SkinScene& scene) { return signal_layout(scene.sensor); }

}  // namespace

LogSensor::LogSensor(const AnyScene& scene) : is_skin(std::holds_alternative<SkinScene>(scene)) {
  std::visit(
      [this](const auto& one) {
        units = one.units.value_or(Units{});
        layout = signal_layout_of(one);
        readings = reading_names(one.sensor);
        for (const auto& channel : tactile_net::channels(one.sensor))
          channels.push_back(channel.name);
        std::vector<double> along_y;
        std::vector<double> along_z;
        for (const auto& site : sites(one.sensor)) {
          dead.push_back(std::count(one.dead_taxels.begin(), one.dead_taxels.end(), site.taxel) >
                         0);
          along_y.push_back(site.y);
          along_z.push_back(site.z);
          depth = std::max(depth, site.depth);
        }
        y = ends(along_y);
        z = ends(along_z);
        calibration = one.calibration;
        material = one.material;
        has_contacts = !one.contacts.empty();
      },
      scene);
  force = units.force;
  if (const auto* skin = std::get_if<SkinScene>(&scene)) curved = skin->sensor.curved;
}

std::vector<std::string> LogSensor::described() const {
  if (by_place)
    return {"press",   "shape",   "force",       "force_sd", "place_x",
            "place_y", "place_z", "position_sd", "radius",   "half_width"};
  if (is_skin)
    return {"press",      "shape",       "force",  "force_sd",  "position_y",
            "position_z", "position_sd", "radius", "half_width"};
  return {"press", "shape", "force", "force_sd", "position", "position_sd", "radius", "half_width"};
}

std::vector<std::string> LogSensor::optional_columns() const {
  std::vector<std::string> columns{"half_width_sd", "friction", "friction_sd", "t"};
  if (is_skin) columns.emplace_back("direction");
  return columns;
}

std::string LogSensor::header() const {
  std::string text;
  for (const std::string& name : described()) text += (text.empty() ? "" : ",") + name;
  return text;
}

bool LogSensor::set_shape(std::string_view text, Press& press) const {
  return is_skin ? set(skin_shapes, text, press.disc) : set(line_shapes, text, press.shape);
}

std::string_view LogSensor::shapes() const noexcept {
  return is_skin
             ? "sphere, punch, cone; none: unloaded. Rods longer than the skin are not supported"
             : "cylinder, punch, wedge; none: unloaded. A ball does not press evenly across a line "
               "of taxels";
}

std::string_view LogSensor::round_shape() const noexcept { return is_skin ? "sphere" : "cylinder"; }

bool LogSensor::is_round(const Press& press) const noexcept {
  return is_skin ? press.disc == DiscProfile::sphere : press.shape == Shape::cylinder;
}

double LogSensor::half_width(const Press& press) const {
  const double press_force = *press.force.value;
  if (!is_skin) return rod_half_width(material, press_force, *press.radius);
  const double bend =
      curved ? curved->surface
                   .at(press.position.value.value_or(0.0), press.position_z.value.value_or(0.0))
                   .mean_curvature
             : 0.0;
  const double relative = 1.0 / *press.radius + bend;
  if (!(relative > 0.0)) return std::numeric_limits<double>::infinity();
  return ball_contact_radius(material, press_force, 1.0 / relative);
}

}  // namespace tactile_net::frames
