/// @file
/// A sensor's calibration as CSV: a row per reading. Private.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactile_net {

/// Columns by name, each with a number per reading.
using CalibrationColumns = std::map<std::string, std::vector<double>, std::less<>>;

/// Fields are separated by commas; empty lines and those that begin with # are skipped. Of what the
/// file holds nothing is quoted: whoever wrote the scene would have chosen whose.
///
/// @param known     names that its columns may have, beside "reading"
/// @param readings  names of the readings, which the rows follow, and the column "reading" repeats
/// @throw std::runtime_error  what is wrong, and in which line
[[nodiscard]] CalibrationColumns read_calibration_file(const std::filesystem::path& path,
                                                       std::span<const std::string_view> known,
                                                       std::span<const std::string> readings);

}  // namespace tactile_net
