/// @file
/// From journals to a table: nothing missing, in the study's order, with a hash that is the same
/// whoever computed what.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "tactile_net/sweep/journal.hpp"
#include "tactile_net/sweep/sweep.hpp"

namespace tactile_net::sweep {

struct Table {
  std::string title{};  ///< of the study
  std::string study{};  ///< `Study::hash`
  std::vector<std::string> axes{};
  SweepUnits units{};
  std::vector<Kept> keep{};
  std::size_t points = 0;
  std::vector<Row> rows{};  ///< by index, and of a point in the order of the scene's methods
  std::string csv{};        ///< the same: a header, and a line for each
  std::string sha256{};     ///< of `csv`
};

/// Points that no journal has.
class MissingPoints : public std::runtime_error {
 public:
  MissingPoints(std::size_t missing, std::size_t points, std::size_t first);
};

/// @throw MissingPoints  naming how many, and the first
[[nodiscard]] Table table(const Rows& rows);

/// The points of one shard alone, which are the table's: others may be missing.
///
/// @param folder  of the sweep, with the journals of all its shards
/// @throw InputError     as `merge`
/// @throw MissingPoints  as `table`, of the shard's points
[[nodiscard]] Table shard_table(const Study& study, const std::filesystem::path& folder,
                                const Shard& shard);

/// All journals of these folders and of the folders in them, of one study.
/// @throw InputError     there is no journal, or not all are of one study; as `Rows::add`
/// @throw MissingPoints  as `table`
[[nodiscard]] Table merge(std::span<const std::filesystem::path> folders);

}  // namespace tactile_net::sweep
