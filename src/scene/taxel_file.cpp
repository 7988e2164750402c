#include "scene/taxel_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "scene/csv_table.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net {
namespace {

constexpr std::array<std::string_view, 4> known = {"y", "depth", "reads", "width"};
enum Column { y, depth, reads, width };

/// Where each known column stands.
using Places = std::array<std::optional<std::size_t>, known.size()>;

/// "y [mm]" is y if lengths are in mm.
std::string plain(const CsvTable::Row& header, const std::string& name, const Unit& length) {
  const std::size_t open = name.find('[');
  if (open == std::string::npos) return name;
  const std::string unit = name.substr(open + 1, name.find(']') - open - 1);
  if (unit != length.name)
    throw error_in_line(header.line, "a length has another unit than the scene's, " +
                                         std::string(length.name) +
                                         ": convert it, or state that unit under [units]");
  return name.substr(0, name.find_last_not_of(' ', open - 1) + 1);
}

Places places_of(const CsvTable::Row& header, const Unit& length) {
  Places places;
  for (std::size_t k = 0; k < header.fields.size(); ++k) {
    const std::string name = plain(header, header.fields[k], length);
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
      throw error_in_line(header.line, "a column has another name than y, depth, reads, width");
    auto& place = places[static_cast<std::size_t>(found - known.begin())];
    if (place) throw error_in_line(header.line, "a column stands there twice");
    place = k;
  }
  return places;
}

double length_in(const CsvTable::Row& row, std::size_t place, std::string_view what,
                 const Unit& length) {
  double number = 0.0;
  if (!read_number(row.fields[place], number) || !std::isfinite(number))
    throw error_in_line(row.line, std::string(what) + " is not a finite number");
  return length.to_si(number);
}

std::vector<Quantity> quantities_in(const CsvTable::Row& row, std::size_t place) {
  std::vector<Quantity> result;
  std::istringstream words(row.fields[place]);
  for (std::string word; words >> word;) {
    const auto found = std::find_if(quantities.begin(), quantities.end(),
                                    [&](Quantity quantity) { return name(quantity) == word; });
    if (found == quantities.end()) {
      std::string all;
      for (const Quantity quantity : quantities)
        all += (all.empty() ? "" : ", ") + std::string(name(quantity));
      throw error_in_line(row.line, "reads names something else than " + all);
    }
    result.push_back(*found);
  }
  if (result.empty()) throw error_in_line(row.line, "reads names no quantity");
  return result;
}

}  // namespace

std::vector<Taxel> read_taxel_file(const std::filesystem::path& path, const Taxel& missing,
                                   const Unit& length, std::size_t most) {
  const CsvTable table = read_csv_table(path);
  const Places places = places_of(table.header, length);
  const auto require = [&](Column column, bool elsewhere, const std::string& advice) {
    if (!places[column] && !elsewhere)
      throw error_in_line(table.header.line,
                          "there is no column " + std::string(known[column]) + advice);
  };
  require(y, false, "");
  require(depth, missing.depth > 0.0, ", and the scene states no sensor.depth");
  require(reads, !missing.reads.empty(), ", and the scene states no sensor.reads");
  if (table.rows.size() < 2 || table.rows.size() > most)
    throw std::runtime_error("it has " + std::to_string(table.rows.size()) + " taxels: from 2 to " +
                             std::to_string(most) + " are possible");
  std::vector<Taxel> taxels;
  for (const CsvTable::Row& row : table.rows) {
    Taxel taxel = missing;
    taxel.y = length_in(row, *places[y], known[y], length);
    if (places[depth]) taxel.depth = length_in(row, *places[depth], known[depth], length);
    if (places[width]) taxel.width = length_in(row, *places[width], known[width], length);
    if (places[reads]) taxel.reads = quantities_in(row, *places[reads]);
    if (!(taxel.depth > 0.0)) throw error_in_line(row.line, "depth is not > 0");
    if (!(taxel.width >= 0.0)) throw error_in_line(row.line, "width is below 0");
    if (!taxels.empty() && taxel.y < taxels.back().y)
      throw error_in_line(row.line, "y is below the taxel before it: it must rise");
    taxels.push_back(std::move(taxel));
  }
  return taxels;
}

}  // namespace tactile_net
