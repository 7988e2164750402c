#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "scene/skin_sections.hpp"
#include "scene/taxel_table.hpp"

namespace tactile_net {
namespace {

/// Each taxel's line, and what is at whose place.
class Places {
 public:
  /// @throw std::runtime_error  another taxel has this one's name, or reads the same in its place
  void add(std::size_t line, const Taxel& taxel) {
    if (const auto [other, is_new] = names_.try_emplace(taxel.name, line);
        !is_new && !taxel.name.empty())
      throw error_in_line(line, "the name is that of the taxel in line " +
                                    std::to_string(other->second) +
                                    " too: columns of recordings "
                                    "are called by it");
    for (const Quantity quantity : taxel.reads)
      if (const auto [other, is_new] =
              readings_.try_emplace({taxel.y, taxel.z, taxel.depth, quantity}, line);
          !is_new && other->second != line)
        throw error_in_line(line, "the taxel is at the place of that in line " +
                                      std::to_string(other->second) + " and reads the same, " +
                                      std::string(name(quantity)) +
                                      ": leave one out, or average their readings");
  }

 private:
  std::map<std::string, std::size_t> names_{};
  std::map<std::tuple<double, double, double, Quantity>, std::size_t> readings_{};
};

std::vector<Taxel> read_taxels(const std::filesystem::path& path, const Taxel& missing,
                               const Unit& length) {
  constexpr std::array<std::string_view, 5> known = {"name", "y", "z", "depth", "reads"};
  enum Column { name_column, y, z, depth, reads };
  const TaxelTable table(path, known, length);
  table.require(y, false, "");
  table.require(z, false, "");
  table.require(depth, missing.depth > 0.0, ", and the scene states no sensor.depth");
  table.require(reads, !missing.reads.empty(), ", and the scene states no sensor.reads");
  std::vector<Taxel> taxels;
  Places places;
  for (const TaxelTable::Row& row : table.rows(1, static_cast<std::size_t>(most_taxels))) {
    Taxel taxel = missing;
    if (table.has(name_column)) taxel.name = table.text(row, name_column);
    taxel.y = table.length(row, y);
    taxel.z = table.length(row, z);
    if (table.has(depth)) taxel.depth = table.length(row, depth);
    if (table.has(reads)) taxel.reads = table.quantities(row, reads, skin_quantities);
    if (!(taxel.depth > 0.0)) throw error_in_line(row.line, "depth is not > 0");
    places.add(row.line, taxel);
    taxels.push_back(std::move(taxel));
  }
  return taxels;
}

/// In rows and columns: what is more than dense matrices take is solved without them.
constexpr std::int64_t most_even_taxels = std::int64_t{1} << 18;
constexpr const char* fewer_taxels = "262144 taxels at most, 512 x 512";

std::size_t read_count(Table& table, std::string_view key, std::string_view hint) {
  const auto value = table.required(key, hint);
  const auto count = value ? value->integer(1, most_even_taxels, fewer_taxels) : std::nullopt;
  return static_cast<std::size_t>(count.value_or(0));
}

/// rows x columns, equally far apart.
SkinArray read_even(Table& table, Read& read) {
  SkinArray array;
  array.rows = read_count(table, "rows", "the number of taxels along y: rows = 8");
  array.columns = read_count(table, "columns", "the number of taxels along z: columns = 8");
  constexpr std::string_view example = "pitch = 2.0, or pitch = [2.0, 1.5]";
  if (const auto pitch = table.required(
          "pitch", "the distance from taxel to taxel, or two along y and z: pitch = 2.0")) {
    if (!pitch->is_list()) {
      array.pitch_y = array.pitch_z =
          pitch->number(positive, read.units.length).value_or(array.pitch_y);
    } else if (const auto both = read_two(*pitch, positive, read.units.length, example)) {
      array.pitch_y = both->front();
      array.pitch_z = both->back();
    }
  }
  const auto one =
      table.required("depth", "how far below the surface the taxels are: depth = 1.5", {"depths"});
  array.depths = read_depths(one, table.value("depths"), read.units.length);
  read.depths_complete = !array.depths.empty();
  read.reads = table.required("reads", "what each taxel reads: reads = [\"stress_x\"]");
  if (read.reads) read.reads_complete = read_quantities(*read.reads, skin_quantities, array.reads);
  const bool too_many = array.rows * array.columns > static_cast<std::size_t>(most_even_taxels);
  if (too_many) {
    if (const auto rows = table.value("rows"))
      rows->problem("times columns makes " + std::to_string(array.rows * array.columns) +
                        " taxels, more than " + std::to_string(most_even_taxels),
                    fewer_taxels);
  }
  const bool complete = !too_many && array.rows > 0 && array.columns > 0 && array.pitch_y > 0.0 &&
                        array.pitch_z > 0.0 && read.depths_complete && read.reads_complete;
  return complete ? array : SkinArray{};
}

/// Wherever they are.
SkinArray read_uneven(Table& table, const Value& file, const std::filesystem::path& folder,
                      Read& read) {
  for (const std::string_view key : {"rows", "columns", "pitch", "depths"})
    table.not_here(key, "applies to taxels on a lattice; these have places of their own",
                   "remove it");
  Taxel missing;
  if (const auto value = table.value("depth"))
    missing.depth = value->number(positive, read.units.length).value_or(0.0);
  double depth_factor = 1.0;
  if (const auto value = table.value("depth_factor"))
    depth_factor = value->number(positive).value_or(1.0);
  read.reads = table.value("reads");
  if (read.reads && !read_quantities(*read.reads, skin_quantities, missing.reads)) return {};
  if (!read.reads) read.reads = file;
  const auto path = read_taxel_path(file, folder);
  if (!path) return {};
  try {
    std::vector<Taxel> taxels = read_taxels(*path, missing, read.units.length);
    for (Taxel& taxel : taxels) taxel.depth *= depth_factor;
    SkinArray array = uneven_skin(std::move(taxels));
    read.reads_complete = read.depths_complete = true;
    return array;
  } catch (const std::invalid_argument& error) {
    file.problem("is not a skin: " + std::string(error.what()));
  } catch (const std::runtime_error& error) {
    file.problem("names a file that is not in order: " + std::string(error.what()),
                 "a header \"name,y,z,depth,reads\", then a row for each taxel: "
                 "thumb_1,-3.0,1.0,1.5,stress_x shear_xy shear_xz");
  }
  return {};
}

}  // namespace

std::optional<std::array<double, 2>> read_two(const Value& value, const Rule& rule,
                                              const Unit& unit, std::string_view example) {
  const auto numbers = value.numbers(rule, unit);
  if (!numbers) return std::nullopt;
  if (numbers->size() == 2) return std::array{numbers->front(), numbers->back()};
  value.problem("must be two numbers, along y and z (got " + std::to_string(numbers->size()) + ')',
                std::string(example));
  return std::nullopt;
}

SkinArray read_skin_sensor(Table table, const std::filesystem::path& folder, Read& read) {
  const auto file = table.value("taxels");
  SkinArray array = file ? read_uneven(table, *file, folder, read) : read_even(table, read);
  table.finish();
  return array;
}

}  // namespace tactile_net
