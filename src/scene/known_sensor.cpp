#include "tactile_net/scene/known_sensor.hpp"

#include <stdexcept>
#include <utility>

#include "scene/document.hpp"
#include "scene/known_sensor_files.hpp"
#include "scene/problems.hpp"
#include "scene/table.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net {
namespace {

constexpr FileKind sensors_file{"file of sensors", "a table for each sensor"};

std::vector<Quantity> quantities_in(const Value& value) {
  std::vector<Quantity> all;
  for (const Value& one : value.list("quantities").value_or(std::vector<Value>{}))
    if (const auto name = one.text())
      if (const auto quantity = quantity_named(*name)) all.push_back(*quantity);
  return all;
}

/// @param like  the sensor whose refusal is this one's too; "": none
KnownSensor sensor_of(const std::string& name, Table table, std::string& like) {
  KnownSensor sensor{.name = name};
  const auto text = [&](std::string_view key, std::string& target) {
    if (const auto value = table.value(key)) target = value->text().value_or("");
  };
  if (const auto reads = table.value("reads")) sensor.reads = quantities_in(*reads);
  if (const auto lattice = table.value("lattice")) sensor.lattice = lattice->text();
  text("needs", sensor.needs);
  text("call", sensor.call);
  text("refusal", sensor.refusal);
  text("like", like);
  table.finish();
  for (const KnownSensorModel& model : known_sensor_models())
    if (model.sensor == name) sensor.models.emplace(model.model, model.taxels);
  return sensor;
}

}  // namespace

std::span<const KnownSensor> known_sensors() {
  static const std::vector<KnownSensor> sensors = [] {
    const std::string_view text = known_sensors_toml();
    Problems problems("sensors.toml", text, sensors_file);
    const toml::table document = parse_document(text, "sensors.toml", problems);
    Table table(document, "", problems);
    std::vector<KnownSensor> all;
    std::vector<std::string> alike;
    for (const auto& [key, node] : document)
      if (auto own = table_of(table.value(key.str())))
        all.push_back(sensor_of(std::string(key.str()), std::move(*own), alike.emplace_back()));
    table.finish();
    problems.throw_if_any();
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const KnownSensor& one : all)
        if (one.name == alike[i]) all[i].refusal = one.refusal;
    return all;
  }();
  return sensors;
}

const KnownSensor& known_sensor(std::string_view name) {
  std::vector<std::string> names;
  for (const KnownSensor& one : known_sensors()) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  throw std::invalid_argument("there is no sensor '" + std::string(name) + "': known are " +
                              join(names, ", "));
}

std::optional<std::pair<std::size_t, std::size_t>> lattice_of(std::string_view text) {
  constexpr std::size_t most = 256;
  const std::vector<std::string_view> parts = split(text, 'x');
  if (parts.size() != 2) return std::nullopt;
  const auto rows = whole_number(parts[0]);
  const auto columns = whole_number(parts[1]);
  if (!rows || !columns || *rows < 1 || *columns < 1 || *rows > most || *columns > most)
    return std::nullopt;
  return std::pair{*rows, *columns};
}

}  // namespace tactile_net
