#include "scene/taxel_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "scene/csv_table.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net {
namespace {

using Row = CsvTable::Row;

/// "y" of "y [mm]".
std::string without_unit(const std::string& name) {
  const std::size_t open = name.find('[');
  if (open == std::string::npos || open == 0) return name;
  return name.substr(0, name.find_last_not_of(' ', open - 1) + 1);
}

void check_length_unit(const Row& header, const std::string& name, const Unit& length) {
  const std::size_t open = name.find('[');
  if (open == std::string::npos) return;
  if (name.substr(open + 1, name.find(']') - open - 1) != length.name)
    throw error_in_line(header.line, "a length has another unit than the scene's, " +
                                         std::string(length.name) +
                                         ": convert it, or state that unit under [units]");
}

/// Where each known column stands.
std::map<std::string_view, std::size_t> places_in(const Row& header,
                                                  std::span<const std::string_view> known,
                                                  const Unit& length) {
  std::map<std::string_view, std::size_t> places;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    check_length_unit(header, header.fields[k], length);
    const auto found = std::find(known.begin(), known.end(), without_unit(header.fields[k]));
    if (found == known.end())
      throw error_in_line(header.line,
                          "a column has another name than " +
                              join(std::vector<std::string>(known.begin(), known.end()), ", "));
    if (!places.try_emplace(*found, k).second)
      throw error_in_line(header.line, "a column stands there twice");
  }
  return places;
}

/// A list with blanks between.
std::vector<Quantity> quantities_in(const Row& row, const std::string& text,
                                    std::span<const Quantity> all) {
  std::vector<Quantity> result;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](Quantity quantity) { return name(quantity) == word; });
    if (found == all.end()) {
      std::string names;
      for (const Quantity quantity : all)
        names += (names.empty() ? "" : ", ") + std::string(name(quantity));
      throw error_in_line(row.line, "reads names something else than " + names);
    }
    result.push_back(*found);
  }
  if (result.empty()) throw error_in_line(row.line, "reads names no quantity");
  return result;
}

/// Each taxel's line, and what is at whose place.
class TaxelPlaces {
 public:
  /// @throw std::runtime_error  another taxel has this one's name, or reads the same in its place
  void add(std::size_t line, const FileTaxel& row) {
    const Taxel& taxel = row.taxel;
    if (const auto [other, is_new] = names_.try_emplace(taxel.name, line);
        !is_new && !taxel.name.empty())
      throw error_in_line(line, "the name is that of the taxel in line " +
                                    std::to_string(other->second) +
                                    " too: columns of recordings "
                                    "are called by it");
    for (const Quantity quantity : taxel.reads)
      if (const auto [other, is_new] = readings_.try_emplace(
              {row.x.value_or(0.0), taxel.y, taxel.z, taxel.depth, quantity}, line);
          !is_new && other->second != line)
        throw error_in_line(line, "the taxel is at the place of that in line " +
                                      std::to_string(other->second) + " and reads the same, " +
                                      std::string(name(quantity)) +
                                      ": leave one out, or average their readings");
  }

 private:
  std::map<std::string, std::size_t> names_{};
  std::map<std::tuple<double, double, double, double, Quantity>, std::size_t> readings_{};
};

}  // namespace

std::vector<FileTaxel> read_taxel_file(const std::filesystem::path& path, const TaxelFileKind& kind,
                                       const Taxel& missing, const Unit& length) {
  const CsvTable table = read_csv_table(path);
  const auto places = places_in(table.header, kind.columns, length);
  const auto is_known = [&](std::string_view column) {
    return std::find(kind.columns.begin(), kind.columns.end(), column) != kind.columns.end();
  };
  const auto require = [&](std::string_view column, bool elsewhere, const char* advice) {
    if (is_known(column) && !places.contains(column) && !elsewhere)
      throw error_in_line(table.header.line, "there is no column " + std::string(column) + advice);
  };
  require("y", false, "");
  require("z", false, "");
  require("depth", missing.depth > 0.0, ", and the scene states no sensor.depth");
  require("reads", !missing.reads.empty(), ", and the scene states no sensor.reads");
  if (table.rows.size() < kind.least || table.rows.size() > kind.most)
    throw std::runtime_error("it has " + std::to_string(table.rows.size()) + " taxels: from " +
                             std::to_string(kind.least) + " to " + std::to_string(kind.most) +
                             " are possible");
  const bool has_normals = places.contains("nx");
  for (const std::string_view column : {"nx", "ny", "nz"})
    if (places.contains(column) != has_normals || (has_normals && !places.contains("x")))
      throw error_in_line(table.header.line,
                          "a normal needs all of the columns x, y, z, nx, ny, nz");
  std::vector<FileTaxel> taxels;
  TaxelPlaces taken;
  for (const Row& row : table.rows) {
    const auto text = [&](std::string_view column) -> const std::string* {
      const auto place = places.find(column);
      return place == places.end() ? nullptr : &row.fields[place->second];
    };
    const auto number_in = [&](std::string_view column, const Unit& unit) {
      double number = 0.0;
      if (!read_number(*text(column), number) || !std::isfinite(number))
        throw error_in_line(row.line, std::string(column) + " is not a finite number");
      return unit.to_si(number);
    };
    const auto put_length = [&](std::string_view column, double& value) {
      if (text(column) != nullptr) value = number_in(column, length);
    };
    FileTaxel one{.taxel = missing};
    Taxel& taxel = one.taxel;
    if (places.contains("x")) one.x = number_in("x", length);
    if (has_normals) one.normal = {number_in("nx", {}), number_in("ny", {}), number_in("nz", {})};
    if (const std::string* own = text("name")) taxel.name = *own;
    put_length("y", taxel.y);
    put_length("z", taxel.z);
    put_length("depth", taxel.depth);
    put_length("width", taxel.width);
    if (const std::string* own = text("reads"))
      taxel.reads = quantities_in(row, *own, kind.quantities);
    if (!(taxel.depth > 0.0)) throw error_in_line(row.line, "depth is not > 0");
    if (!(taxel.width >= 0.0)) throw error_in_line(row.line, "width is below 0");
    if (!is_known("z") && !taxels.empty() && taxel.y < taxels.back().taxel.y)
      throw error_in_line(row.line, "y is below the taxel before it: it must rise");
    taken.add(row.line, one);
    taxels.push_back(std::move(one));
  }
  return taxels;
}

bool has_column(const std::filesystem::path& path, std::string_view name) noexcept {
  try {
    const std::vector<std::string> fields = read_csv_header(path);
    return std::any_of(fields.begin(), fields.end(),
                       [&](const std::string& field) { return without_unit(field) == name; });
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace tactile_net
