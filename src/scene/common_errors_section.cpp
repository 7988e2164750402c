#include "scene/common_errors_section.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/csv_table.hpp"
#include "scene/references.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::string_view measured_example = "measured = { file = \"reel.csv\", nominal = 10e3 }";

/// Of the one column that holds them, by its name.
struct MeasuredColumn {
  std::size_t place = 0;
  double ohm = 1.0;  ///< of its unit
};

MeasuredColumn measured_column(const CsvTable::Row& header) {
  constexpr std::array<std::pair<std::string_view, double>, 5> names = {{{"ohms", 1.0},
                                                                         {"value [ohm]", 1.0},
                                                                         {"value [kohm]", 1e3},
                                                                         {"value [Mohm]", 1e6},
                                                                         {"value [mohm]", 1e-3}}};
  std::optional<MeasuredColumn> found;
  for (std::size_t k = 0; k < header.fields.size(); ++k)
    for (const auto& [name, ohm] : names) {
      if (header.fields[k] != name) continue;
      if (found)
        throw error_in_line(header.line, "there are two columns of measured parts, '" +
                                             header.fields[found->place] + "' and '" +
                                             header.fields[k] + "': leave one");
      found = {k, ohm};
    }
  if (!found)
    throw error_in_line(header.line,
                        "there is no column of measured parts: ohms, or value with its unit, such "
                        "as value [kohm]");
  return *found;
}

MeasuredReel measured_in(const std::filesystem::path& path, double nominal) {
  const CsvTable table = read_csv_table(path);
  const MeasuredColumn column = measured_column(table.header);
  std::vector<double> ohms;
  for (const CsvTable::Row& row : table.rows) {
    double value = 0.0;
    if (!read_number(row.fields[column.place], value) || !std::isfinite(value))
      throw error_in_line(row.line, "a measured part is not a finite number");
    ohms.push_back(column.ohm * value);
    if (!(std::abs(ohms.back() / nominal - 1.0) <= most_off_nominal))
      throw error_in_line(row.line,
                          "the part is further than 10 % from the nominal value: it is of another "
                          "value, or in another unit");
  }
  return measured_reel(ohms, nominal);
}

std::optional<MeasuredReel> read_measured(const Value& value, const std::filesystem::path& folder) {
  std::optional<MeasuredReel> reel;
  auto table = value.table();
  if (!table) return reel;
  const auto file =
      table->required("file", "parts that were measured: " + std::string(measured_example));
  const auto nominal = table->required("nominal", "what is printed on them, ohm: nominal = 10e3");
  const auto ohm = nominal ? nominal->number(positive) : std::nullopt;
  const auto path = file ? path_beside(*file, folder, measured_example) : std::nullopt;
  if (ohm && path) {
    try {
      reel = measured_in(*path, *ohm);
    } catch (const std::exception& error) {
      file->misfit(std::string("is no file of measured parts: ") + error.what());
    }
  }
  table->finish();
  return reel;
}

std::optional<Temperature> read_temperature(const Value& value) {
  auto table = value.table();
  if (!table) return std::nullopt;
  Temperature temperature;
  if (const auto kelvin =
          table->required("kelvin", "how far from where the parts have their values: kelvin = 40"))
    temperature.kelvin = kelvin->number(positive, in_kelvin).value_or(1.0);
  const auto ppm = [&](std::string_view key, double& target) {
    const auto stated = table->value(key);
    if (!stated) return false;
    target = 1e-6 * stated->number(not_negative).value_or(0.0);
    return true;
  };
  const bool alike = ppm("ppm", temperature.coefficient);
  const bool apart = ppm("tracking_ppm", temperature.tracking);
  if (!alike && !apart)
    value.problem("changes no part",
                  "beside kelvin, ppm = 50, of all parts alike, or tracking_ppm "
                  "= 5, of each beside that");
  if (!(temperature.kelvin * (temperature.coefficient + temperature.tracking) < 1.0))
    value.problem("changes parts by all of their value", "ppm is per million and kelvin: ppm = 50");
  table->finish();
  return temperature;
}

}  // namespace

CommonErrors read_common_errors(Table& tolerance, const std::filesystem::path& folder) {
  constexpr Rule share{"must be > 0 and < 1", [](double x) noexcept { return x > 0.0 && x < 1.0; }};
  CommonErrors common;
  if (const auto reel = tolerance.value("reel")) common.reel = reel->number(share);
  if (const auto measured = tolerance.value("measured"))
    common.measured = read_measured(*measured, folder);
  if (const auto temperature = tolerance.value("temperature"))
    common.temperature = read_temperature(*temperature);
  return common;
}

}  // namespace tactile_net
