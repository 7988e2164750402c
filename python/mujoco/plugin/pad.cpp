#include "pad.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tactile_net/lab/skin_contacts.hpp"

namespace tactile_net::mujoco {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument(why); }

std::string text(const mjModel& model, int instance, const char* name) {
  const char* value = mj_getPluginConfig(&model, instance, name);
  return value != nullptr ? value : "";
}

std::optional<double> length(const mjModel& model, int instance, const char* name) {
  const std::string words = text(model, instance, name);
  if (words.empty()) return {};
  double value = 0.0;
  const auto [end, error] = std::from_chars(words.data(), words.data() + words.size(), value);
  if (error != std::errc{} || end != words.data() + words.size() || !(value > 0.0 && value < 1e300))
    refuse(std::string(name) + " must be a number > 0, in m (got '" + words + "')");
  return value;
}

std::vector<std::string> words(const std::string& list) {
  std::istringstream in(list);
  std::vector<std::string> result;
  for (std::string word; in >> word;) result.push_back(word);
  return result;
}

int site_of(const mjModel& model, int sensor) { return model.sensor_objid[sensor]; }

std::vector<bool> own_geoms(const mjModel& model, int site, const std::vector<std::string>& names) {
  std::vector<bool> own(static_cast<std::size_t>(model.ngeom));
  for (int geom = 0; names.empty() && geom < model.ngeom; ++geom)
    own[static_cast<std::size_t>(geom)] = model.geom_bodyid[geom] == model.site_bodyid[site];
  for (const std::string& name : names) {
    const int geom = mj_name2id(&model, mjOBJ_GEOM, name.c_str());
    if (geom < 0) refuse("the model has no geom '" + name + "'");
    own[static_cast<std::size_t>(geom)] = true;
  }
  if (std::find(own.begin(), own.end(), true) == own.end())
    refuse("the body of the site has no geom that could be touched: name some by geoms");
  return own;
}

std::vector<double> curvatures(const mjModel& model) {
  std::vector<double> result;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int type = model.geom_type[geom];
    const bool round = type == mjGEOM_SPHERE || type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER;
    result.push_back(round ? 1.0 / model.geom_size[3 * geom] : 0.0);
  }
  return result;
}

/// Said once a process, since a simulation has many steps and many copies.
void warn_once(std::atomic<bool>& told, const char* sentence) {
  if (!told.exchange(true)) mju_warning("tactile_net.pad: %s", sentence);
}
std::atomic<bool> told_of_pull{false};
std::atomic<bool> told_of_flex{false};
std::atomic<bool> told_of_short{false};

}  // namespace

PadSettings settings_of(const mjModel& model, int instance) {
  PadSettings settings{.scene = text(model, instance, "scene"),
                       .breadth = length(model, instance, "breadth"),
                       .edge = length(model, instance, "edge_width"),
                       .geoms = words(text(model, instance, "geoms"))};
  if (settings.scene.empty()) refuse("it needs <config key=\"scene\" value=\"pad.toml\"/>");
  return settings;
}

int sensor_of(const mjModel& model, int instance) {
  int found = -1;
  for (int sensor = 0; sensor < model.nsensor; ++sensor) {
    if (model.sensor_type[sensor] != mjSENS_PLUGIN || model.sensor_plugin[sensor] != instance)
      continue;
    if (model.sensor_objtype[sensor] != mjOBJ_SITE)
      refuse("its sensor must have objtype=\"site\", whose z axis points out of the pad");
    if (found >= 0) refuse("each sensor needs an instance of its own");
    found = sensor;
  }
  if (found < 0) refuse("no sensor has this instance");
  return found;
}

std::variant<Pad::Line, Pad::Skin> Pad::made(const PadSettings& settings) {
  AnyScene scene = read_any_scene(settings.scene);
  if (auto* skin = std::get_if<SkinScene>(&scene)) {
    if (settings.breadth) refuse("breadth is of line arrays: a skin's contacts end where they end");
    const double edge = settings.edge.value_or(0.5 * least_depth(skin->sensor));
    const auto model = std::make_shared<const lab::SkinPadModel>(std::move(*skin));
    const std::size_t count = tactile_net::reading_count(model->scene().sensor);
    return Skin{model, edge, lab::SimulatedSkinPad(model), std::vector<double>(count)};
  }
  if (!settings.breadth)
    refuse("a line array needs <config key=\"breadth\" value=\"20e-3\"/>: the pad's, in m");
  const auto model = std::make_shared<const lab::PadModel>(std::move(std::get<Scene>(scene)));
  double greatest = 0.0;
  for (const Site& site : sites(model->scene.sensor)) greatest = std::max(greatest, site.depth);
  return Line{model, lab::contact_widths(model->scene, *settings.breadth, settings.edge), greatest,
              lab::SimulatedPad(model)};
}

std::size_t Pad::reading_count(const PadSettings& settings) {
  const auto pad = made(settings);
  if (const auto* skin = std::get_if<Skin>(&pad)) return skin->recorded.size();
  return tactile_net::reading_count(std::get<Line>(pad).model->scene.sensor);
}

Pad::Pad(const mjModel& model, int instance)
    : sensor_(sensor_of(model, instance)),
      own_(own_geoms(model, site_of(model, sensor_), settings_of(model, instance).geoms)),
      curvature_(curvatures(model)),
      pad_(made(settings_of(model, instance))) {}

void Pad::reset() {
  if (auto* skin = std::get_if<Skin>(&pad_))
    skin->pad = lab::SimulatedSkinPad(skin->model);
  else
    std::get<Line>(pad_).pad = lab::SimulatedPad(std::get<Line>(pad_).model);
}

void Pad::gather(const mjModel& model, const mjData& data) {
  const int site = site_of(model, sensor_);
  lab::PadFace face;
  std::copy_n(data.site_xpos + 3 * site, 3, face.origin.begin());
  std::copy_n(data.site_xmat + 9 * site, 9, face.axes.begin());
  const auto is_own = [this](int geom) {
    return geom >= 0 && own_[static_cast<std::size_t>(geom)];
  };
  points_.clear();
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const bool is_second = is_own(contact.geom[1]);
    if (is_second == is_own(contact.geom[0])) continue;
    const int object = contact.geom[is_second ? 0 : 1];
    if (object < 0) {
      warn_once(told_of_flex, "a flex touches a pad, and is left out: only geoms are taken");
      continue;
    }
    std::array<mjtNum, 6> force{};
    mj_contactForce(&model, &data, i, force.data());
    lab::PairContact pair;
    std::copy_n(contact.pos, 3, pair.position.begin());
    std::copy_n(contact.frame, 9, pair.frame.begin());
    std::copy_n(force.begin(), 3, pair.force.begin());
    auto [facing, point] = face.touched_by(pair, is_second);
    if (facing < -lab::least_facing)
      warn_once(
          told_of_pull,
          "a contact pulls at a pad, and is left out: its site's z axis must point out of it");
    if (facing < lab::least_facing) continue;
    point.object = static_cast<std::size_t>(object);
    point.curvature = curvature_[point.object] +
                      curvature_[static_cast<std::size_t>(contact.geom[is_second ? 1 : 0])];
    points_.push_back(point);
  }
}

void Pad::read(Line& line, double time, std::span<double> readings) {
  const lab::ContactPatches found =
      lab::contact_patches(points_, line.model->scene.material, line.widths);
  if (found.shortest && *found.shortest < 3.0 * line.greatest_depth)
    warn_once(told_of_short,
              "a contact is shorter across the array than three depths of its taxels: its force is "
              "right, the height of "
              "its readings is that of one which reaches across the pad");
  line.pad.read(time, found.loads, readings);
}

void Pad::read(Skin& skin, double time, std::span<double> readings) {
  const SkinScene& scene = skin.model->scene();
  skin.pad.read(time, lab::skin_patches(points_, scene.material, skin.edge, skin.model->grid()),
                skin.recorded);
  const std::size_t taxels = is_even(scene.sensor) ? taxel_count(scene.sensor) : 1;
  const std::size_t channels = skin.recorded.size() / taxels;
  for (std::size_t i = 0; i < skin.recorded.size(); ++i)
    readings[taxels == 1 ? i : i % taxels * channels + i / taxels] = skin.recorded[i];
}

void Pad::read(const mjModel& model, mjData& data) {
  gather(model, data);
  const std::span<double> readings{data.sensordata + model.sensor_adr[sensor_],
                                   static_cast<std::size_t>(model.sensor_dim[sensor_])};
  std::visit([&](auto& pad) { read(pad, data.time, readings); }, pad_);
}

}  // namespace tactile_net::mujoco
