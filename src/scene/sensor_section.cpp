// The table [sensor], of a line or of a skin.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/references.hpp"
#include "scene/sections.hpp"
#include "scene/surface_section.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {
namespace {

// --- lines and skins ----------------------------------------------------------------------------

constexpr std::size_t most_depths = 64;

std::vector<double> read_depths(const std::optional<Value>& one,
                                const std::optional<Value>& several, const Unit& length) {
  std::vector<double> result;
  if (one && several) {
    several->problem("and sensor.depth exclude each other", "keep one of the two");
  } else if (one) {
    if (const auto depth = one->number(below_surface, length)) result = {*depth};
  } else if (several) {
    const auto items = several->list("numbers");
    const auto depths = several->numbers(below_surface, length);
    if (!items || !depths) return {};
    if (depths->size() > most_depths) {
      several->problem("must hold at most 64 depths (got " + std::to_string(depths->size()) + ')');
      return {};
    }
    if (depths->empty()) several->problem("must hold at least one depth", "depths = [1.0, 1.5]");
    for (std::size_t i = 0; i < depths->size(); ++i) {
      const double depth = (*depths)[i];
      if (std::find(result.begin(), result.end(), depth) == result.end())
        result.push_back(depth);
      else
        (*items)[i].misfit("names a depth twice", "remove one");
    }
  }
  return result;
}

/// What every taxel reads, in even arrays.
void read_reads(Table& table, const char* example, std::span<const Quantity> all, Read& read,
                std::vector<Quantity>& reads) {
  read.reads =
      table.required("reads", "what each taxel reads: reads = [\"" + std::string(example) + "\"]");
  if (read.reads) read.reads_complete = read_quantities(*read.reads, all, reads);
}

/// The depths of even arrays.
void read_even_depths(Table& table, Read& read, std::vector<double>& depths) {
  const auto depth =
      table.required("depth", "how far below the surface the taxels are: depth = 1.5", {"depths"});
  depths = read_depths(depth, table.value("depths"), read.units.length);
  read.depths_complete = !depths.empty();
}

/// The taxels of a file that the scene names; none: a problem, which has been said.
///
/// @param missing  what the scene says of all
/// @param hint     how such a file looks
std::vector<FileTaxel> taxels_of_file(const Value& value, const std::filesystem::path& folder,
                                      const TaxelFileKind& kind, const Taxel& missing,
                                      const Unit& length, const char* hint) {
  const auto path = path_beside(value, folder, "taxels = \"palm.csv\"");
  if (!path) return {};
  try {
    return read_taxel_file(*path, kind, missing, length);
  } catch (const std::runtime_error& error) {
    value.problem("names a file that is not in order: " + std::string(error.what()), hint);
    return {};
  }
}

std::vector<Taxel> without_space(std::vector<FileTaxel> rows) {
  std::vector<Taxel> taxels;
  taxels.reserve(rows.size());
  for (FileTaxel& row : rows) taxels.push_back(std::move(row.taxel));
  return taxels;
}

/// @param make  an uneven array of taxels
template <typename OfFile, typename Array>
void put_uneven(std::vector<OfFile> taxels, const Value& at, const char* what, const auto& make,
                Read& read, Array& array) {
  if (taxels.empty()) return;
  try {
    array = make(std::move(taxels));
    if (!read.reads) read.reads = at;
    read.reads_complete = read.depths_complete = true;
  } catch (const std::invalid_argument& error) {
    at.problem("is not " + std::string(what) + ": " + error.what());
  }
}

// --- lines --------------------------------------------------------------------------------------

constexpr std::string_view which_taxels =
    "the matrices are dense: 4096 taxels already take 128 MiB for each";

/// One number for all taxels, or one for each.
std::optional<std::vector<double>> one_or_each(const Value& value, std::size_t count, Rule rule,
                                               const Unit& length) {
  if (!value.is_list()) {
    const auto one = value.number(rule, length);
    return one ? std::optional(std::vector<double>(count, *one)) : std::nullopt;
  }
  auto each = value.numbers(rule, length);
  if (each && each->size() != count) {
    value.problem("must be one number, or one for each taxel: " + std::to_string(count) + " (got " +
                  std::to_string(each->size()) + ')');
    return std::nullopt;
  }
  return each;
}

/// Equally far apart.
void read_even_line(Table& table, Read& read, SensorArray& array) {
  if (const auto count = table.required(
          "count", "the number of taxels along the surface: count = 81", {"positions", "taxels"})) {
    const auto taxels = count->integer(2, most_taxels, which_taxels);
    array.count = static_cast<std::size_t>(taxels.value_or(0));
  }
  if (const auto pitch = table.required("pitch", "the distance from taxel to taxel: pitch = 0.25"))
    array.pitch = pitch->number(positive, read.units.length).value_or(0.0);
  read_even_depths(table, read, array.depths);
  if (const auto width = table.value("width")) {
    array.width = width->number(not_negative, read.units.length).value_or(0.0);
    if (read.depths_complete && array.width > Aperture::most_depths * least_depth(array))
      width->misfit("must be at most 10000 depths");
  }
  read_reads(table, "strain_x", line_quantities, read, array.reads);
}

/// What the table says of every taxel of a list or a file.
struct Common {
  std::optional<Value> depth;
  std::optional<Value> width;
  std::vector<Quantity> reads;
  std::vector<std::vector<Quantity>> reads_of_each;  ///< of positions: where taxels differ
};

/// One list for all taxels, or one for each. @return  it was understood as a whole
bool read_common_reads(const Value& value, bool may_differ, Common& common) {
  const auto list = value.list("quantities, such as \"strain_x\"");
  const bool differ = may_differ && list && !list->empty() && list->front().is_list();
  if (!differ) return read_quantities(value, line_quantities, common.reads);
  bool complete = true;
  for (const Value& item : *list)
    complete =
        read_quantities(item, line_quantities, common.reads_of_each.emplace_back()) && complete;
  return complete;
}

std::vector<Taxel> read_positions(const Value& positions, const Common& common,
                                  const Unit& length) {
  const auto items = positions.list("numbers");
  const auto places = positions.numbers(any_number, length);
  if (!items || !places) return {};
  if (places->size() < 2 || places->size() > static_cast<std::size_t>(most_taxels)) {
    positions.problem("must hold from 2 to " + std::to_string(most_taxels) + " taxels (got " +
                          std::to_string(places->size()) + ')',
                      "from the lowest y: positions = [-3.0, -1.0, 0.0, 2.5]");
    return {};
  }
  const auto depths = common.depth
                          ? one_or_each(*common.depth, places->size(), below_surface, length)
                          : std::nullopt;
  const auto widths = common.width
                          ? one_or_each(*common.width, places->size(), not_negative, length)
                          : std::vector<double>(places->size(), 0.0);
  if (!depths || !widths) return {};
  const auto& each = common.reads_of_each;
  if (!each.empty() && each.size() != places->size()) {
    positions.problem("and sensor.reads are of " + std::to_string(places->size()) + " and " +
                          std::to_string(each.size()) + " taxels",
                      "reads = [\"strain_x\"] for all, or a list for each taxel");
    return {};
  }
  std::vector<Taxel> taxels;
  std::size_t misfits = 0;
  for (std::size_t i = 0; i < places->size(); ++i) {
    taxels.push_back({.y = (*places)[i],
                      .depth = (*depths)[i],
                      .reads = each.empty() ? common.reads : each[i],
                      .width = (*widths)[i]});
    if (i == 0 || misfits == most_misfits) continue;
    const double before = (*places)[i - 1];
    if ((*places)[i] < before || ((*places)[i] == before && (*depths)[i] == (*depths)[i - 1])) {
      (*items)[i].misfit((*places)[i] < before ? "is below the taxel before it"
                                               : "is the place of the taxel before it, as deep",
                         "y must rise from taxel to taxel");
      ++misfits;
    }
  }
  return misfits == 0 ? taxels : std::vector<Taxel>{};
}

/// Wherever they are.
void read_uneven_line(Table& table, const std::optional<Value>& positions,
                      const std::optional<Value>& file, const std::filesystem::path& folder,
                      Read& read, SensorArray& array) {
  for (const std::string_view key : {"count", "pitch"})
    table.not_here(key,
                   "applies to taxels that are equally far apart; these have places of their own",
                   "remove it");
  table.not_here("depths", "applies to even arrays, which have every taxel at each depth",
                 "depth = [1.5, 1.2, ...], one for each taxel");
  Common common{.depth = positions ? table.required("depth",
                                                    "how far below the surface the taxels are: "
                                                    "depth = 1.5, or one number for each")
                                   : table.value("depth"),
                .width = table.value("width"),
                .reads = {},
                .reads_of_each = {}};
  read.reads = positions ? table.required("reads", "what each taxel reads: reads = [\"strain_x\"]")
                         : table.value("reads");
  if (read.reads)
    read.reads_complete = read_common_reads(*read.reads, positions.has_value(), common);
  if (read.reads && !read.reads_complete) return;
  if (positions && file)
    file->problem("and sensor.positions exclude each other", "keep one of the two");
  if (positions && (!read.reads || file)) return;
  const Unit& length = read.units.length;
  if (positions)
    return put_uneven(read_positions(*positions, common, length), *positions, "an array",
                      uneven_array, read, array);
  constexpr std::array<std::string_view, 4> columns = {"y", "depth", "reads", "width"};
  const Taxel missing{.depth = number_or(common.depth, below_surface, 0.0, length),
                      .reads = common.reads,
                      .width = number_or(common.width, not_negative, 0.0, length)};
  put_uneven(
      without_space(taxels_of_file(
          *file, folder, {columns, line_quantities, 2, static_cast<std::size_t>(most_taxels)},
          missing, length,
          "a header \"y,depth,reads\", then a row for each taxel, from the "
          "lowest y: -3.0,1.5,stress_x shear_xy")),
      *file, "an array", uneven_array, read, array);
}

// --- skins --------------------------------------------------------------------------------------

/// In rows and columns: what is more than dense matrices take is solved without them.
constexpr std::int64_t most_even_taxels = std::int64_t{1} << 18;
constexpr const char* fewer_taxels = "262144 taxels at most, 512 x 512";

std::size_t read_taxel_count(Table& table, std::string_view key, std::string_view hint) {
  const auto value = table.required(key, hint);
  const auto count = value ? value->integer(1, most_even_taxels, fewer_taxels) : std::nullopt;
  return static_cast<std::size_t>(count.value_or(0));
}

/// rows x columns, equally far apart.
void read_even_skin(Table& table, Read& read, SkinArray& skin) {
  SkinArray array;
  array.rows = read_taxel_count(table, "rows", "the number of taxels along y: rows = 8");
  array.columns = read_taxel_count(table, "columns", "the number of taxels along z: columns = 8");
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
  read_even_depths(table, read, array.depths);
  read_reads(table, "stress_x", skin_quantities, read, array.reads);
  const bool too_many = array.rows * array.columns > static_cast<std::size_t>(most_even_taxels);
  if (too_many) {
    if (const auto rows = table.value("rows"))
      rows->problem("times columns makes " + std::to_string(array.rows * array.columns) +
                        " taxels, more than " + std::to_string(most_even_taxels),
                    fewer_taxels);
  }
  const bool complete = !too_many && array.rows > 0 && array.columns > 0 && array.pitch_y > 0.0 &&
                        array.pitch_z > 0.0 && read.depths_complete && read.reads_complete;
  if (complete) skin = std::move(array);
}

/// Wherever they are.
void read_uneven_skin(Table& table, const std::optional<Value>& surface, const Value& file,
                      const std::filesystem::path& folder, Read& read, SkinArray& skin) {
  for (const std::string_view key : {"rows", "columns", "pitch", "depths"})
    table.not_here(key, "applies to taxels on a lattice; these have places of their own",
                   "remove it");
  Taxel missing{.depth = number_or(table.value("depth"), positive, 0.0, read.units.length)};
  const auto factor = table.value("depth_factor");
  const double depth_factor = number_or(factor, positive, 1.0);
  const std::optional<Value> axes = table.value("frame");
  read.reads = table.value("reads");
  if (read.reads && !read_quantities(*read.reads, skin_quantities, missing.reads)) return;
  constexpr std::array<std::string_view, 9> columns = {"name", "x",  "y",     "z",    "nx",
                                                       "ny",   "nz", "depth", "reads"};
  std::vector<FileTaxel> rows = taxels_of_file(
      file, folder, {columns, skin_quantities, 1, static_cast<std::size_t>(most_taxels)}, missing,
      read.units.length,
      "a header \"name,y,z,depth,reads\", then a row for each taxel: "
      "thumb_1,-3.0,1.0,1.5,stress_x shear_xy shear_xz; of a curved skin a header "
      "\"name,x,y,z,nx,ny,nz,depth,reads\"");
  if (rows.empty()) return;
  if (rows.front().x) {
    const auto stated = table_of(surface);
    const auto options =
        stated ? read_surface(*stated, folder, read.units) : std::optional<CurvedSkinOptions>{};
    if (stated && !options) return;
    const auto make = [&](std::vector<FileTaxel> all) {
      const SkinArray curved =
          curved_skin_of(std::move(all), axes, options.value_or(CurvedSkinOptions{}), read.units);
      return factor ? with_depth_factor(curved, depth_factor) : curved;
    };
    return put_uneven(std::move(rows), file, "a curved skin", make, read, skin);
  }
  for (const auto& [value, what] : {std::pair(surface, "is"), std::pair(axes, "is")})
    if (value)
      value->problem(
          std::string(what) + " of a curved skin, and the file of taxels gives no places in space",
          "give it the columns x, nx, ny and nz, or remove this");
  std::vector<Taxel> taxels = without_space(std::move(rows));
  for (Taxel& taxel : taxels) taxel.depth *= depth_factor;
  put_uneven(std::move(taxels), file, "a skin", uneven_skin, read, skin);
}

}  // namespace

bool read_quantities(const Value& value, std::span<const Quantity> all,
                     std::vector<Quantity>& reads) {
  const auto list = value.list("quantities, such as " + in_quotes(name(all.front())));
  if (!list) return false;
  if (list->empty()) value.problem("must name at least one quantity", "reads = [\"stress_x\"]");
  bool complete = !list->empty();
  std::vector<std::string_view> names;
  for (const Quantity quantity : all) names.push_back(name(quantity));
  for (const Value& item : *list) {
    const auto index = item.one_of("quantity", names);
    complete = complete && index;
    if (!index) continue;
    if (std::find(reads.begin(), reads.end(), all[*index]) == reads.end())
      reads.push_back(all[*index]);
    else
      item.problem("names " + in_quotes(names[*index]) + " twice", "remove one");
  }
  return complete;
}

std::optional<std::array<double, 2>> read_two(const Value& value, const Rule& rule,
                                              const Unit& unit, std::string_view example) {
  const auto numbers = value.numbers(rule, unit);
  if (!numbers) return std::nullopt;
  if (numbers->size() == 2) return std::array{numbers->front(), numbers->back()};
  value.problem("must be two numbers, along y and z (got " + std::to_string(numbers->size()) + ')',
                std::string(example));
  return std::nullopt;
}

void read_sensor(Table table, const std::optional<Value>& surface,
                 const std::filesystem::path& folder, Read& read, SensorArray& sensor) {
  if (surface) surface->problem("is of a curved skin, and this sensor is a line", "remove it");
  const auto positions = table.value("positions");
  const auto file = table.value("taxels");
  if (positions || file)
    read_uneven_line(table, positions, file, folder, read, sensor);
  else
    read_even_line(table, read, sensor);
  table.finish();
}

void read_sensor(Table table, const std::optional<Value>& surface,
                 const std::filesystem::path& folder, Read& read, SkinArray& sensor) {
  if (const auto file = table.value("taxels")) {
    read_uneven_skin(table, surface, *file, folder, read, sensor);
  } else {
    if (surface)
      surface->problem(
          "is of a curved skin, whose taxels have places in space",
          "under [sensor], taxels = \"finger.csv\" with columns name,x,y,z,nx,ny,nz,depth,reads");
    read_even_skin(table, read, sensor);
  }
  table.finish();
}

}  // namespace tactile_net
