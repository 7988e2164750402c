#include "scene/taxel_file.hpp"

#include <array>
#include <string_view>

#include "scene/taxel_table.hpp"

namespace tactile_net {

std::vector<Taxel> read_taxel_file(const std::filesystem::path& path, const Taxel& missing,
                                   const Unit& length, std::size_t most) {
  constexpr std::array<std::string_view, 4> known = {"y", "depth", "reads", "width"};
  enum Column { y, depth, reads, width };
  const TaxelTable table(path, known, length);
  table.require(y, false, "");
  table.require(depth, missing.depth > 0.0, ", and the scene states no sensor.depth");
  table.require(reads, !missing.reads.empty(), ", and the scene states no sensor.reads");
  std::vector<Taxel> taxels;
  for (const TaxelTable::Row& row : table.rows(2, most)) {
    Taxel taxel = missing;
    taxel.y = table.length(row, y);
    if (table.has(depth)) taxel.depth = table.length(row, depth);
    if (table.has(width)) taxel.width = table.length(row, width);
    if (table.has(reads)) taxel.reads = table.quantities(row, reads, line_quantities);
    if (!(taxel.depth > 0.0)) throw error_in_line(row.line, "depth is not > 0");
    if (!(taxel.width >= 0.0)) throw error_in_line(row.line, "width is below 0");
    if (!taxels.empty() && taxel.y < taxels.back().y)
      throw error_in_line(row.line, "y is below the taxel before it: it must rise");
    taxels.push_back(std::move(taxel));
  }
  return taxels;
}

}  // namespace tactile_net
