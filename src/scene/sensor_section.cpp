#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/sections.hpp"
#include "scene/taxel_file.hpp"
#include "tactile_net/sensing/aperture.hpp"
#include "tactile_net/sensing/surface.hpp"

namespace tactile_net {
namespace {

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
void read_even(Table& table, SensorArray& array, Read& read) {
  if (const auto count = table.required(
          "count", "the number of taxels along the surface: count = 81", {"positions", "taxels"})) {
    const auto taxels = count->integer(2, most_taxels, which_taxels);
    array.count = static_cast<std::size_t>(taxels.value_or(0));
  }
  if (const auto pitch = table.required("pitch", "the distance from taxel to taxel: pitch = 0.25"))
    array.pitch = pitch->number(positive, read.units.length).value_or(0.0);
  const auto depth =
      table.required("depth", "how far below the surface the taxels are: depth = 1.5", {"depths"});
  array.depths = read_depths(depth, table.value("depths"), read.units.length);
  read.depths_complete = !array.depths.empty();
  if (const auto width = table.value("width")) {
    array.width = width->number(not_negative, read.units.length).value_or(0.0);
    if (read.depths_complete && array.width > Aperture::most_depths * least_depth(array))
      width->misfit("must be at most 10000 depths");
  }
  read.reads = table.required("reads", "what each taxel reads: reads = [\"strain_x\"]");
  if (read.reads) read.reads_complete = read_quantities(*read.reads, line_quantities, array.reads);
}

/// What the table says of every taxel of a list or a file.
struct Common {
  std::optional<Value> depth;
  std::optional<Value> width;
  std::vector<Quantity> reads;
  std::vector<std::vector<Quantity>> reads_of_each;  ///< of positions: where taxels differ
};

/// One list for all taxels, or one for each. @return  it was understood as a whole
bool read_reads(const Value& value, bool may_differ, Common& common) {
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

std::vector<Taxel> read_file(const Value& value, const std::filesystem::path& folder,
                             const Common& common, const Unit& length) {
  const auto path = read_taxel_path(value, folder);
  if (!path) return {};
  Taxel missing{.reads = common.reads};
  if (common.width) missing.width = common.width->number(not_negative, length).value_or(0.0);
  if (common.depth) missing.depth = common.depth->number(below_surface, length).value_or(0.0);
  try {
    return read_taxel_file(*path, missing, length, static_cast<std::size_t>(most_taxels));
  } catch (const std::runtime_error& error) {
    value.problem("names a file that is not in order: " + std::string(error.what()),
                  "a header \"y,depth,reads\", then a row for each taxel, from the lowest y: "
                  "-3.0,1.5,stress_x shear_xy");
    return {};
  }
}

/// Wherever they are.
SensorArray read_uneven(Table& table, const std::optional<Value>& positions,
                        const std::optional<Value>& file, const std::filesystem::path& folder,
                        Read& read) {
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
  if (read.reads) read.reads_complete = read_reads(*read.reads, positions.has_value(), common);
  if (read.reads && !read.reads_complete) return {};
  if (positions && (!read.reads || file)) {
    if (file) file->problem("and sensor.positions exclude each other", "keep one of the two");
    return {};
  }
  const Unit& length = read.units.length;
  std::vector<Taxel> taxels = positions ? read_positions(*positions, common, length)
                                        : read_file(*file, folder, common, length);
  if (taxels.empty()) return {};
  if (!read.reads) read.reads = file;
  try {
    SensorArray array = uneven_array(std::move(taxels));
    read.reads_complete = read.depths_complete = true;
    return array;
  } catch (const std::invalid_argument& error) {
    (positions ? *positions : *file).problem("is not an array: " + std::string(error.what()));
    return {};
  }
}

}  // namespace

SensorArray read_sensor(Table table, const std::filesystem::path& folder, Read& read) {
  const auto positions = table.value("positions");
  const auto file = table.value("taxels");
  SensorArray array;
  if (positions || file)
    array = read_uneven(table, positions, file, folder, read);
  else
    read_even(table, array, read);
  table.finish();
  return array;
}

}  // namespace tactile_net
