/// @file
/// A small table as CSV beside a scene. Private.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactile_net {

/// Fields are separated by commas, or by semicolons or tabs where the header has no comma; a comma
/// in a number is a decimal one then. Quotes around a field are none of it. Empty lines and those
/// that begin with # are skipped. What is said of it never quotes what it holds: whoever wrote the
/// scene would have chosen whose.
struct CsvTable {
  struct Row {
    std::size_t line = 0;  ///< from 1
    std::vector<std::string> fields{};
  };
  Row header{};
  std::vector<Row> rows{};
};

/// @return  whose rows have as many fields as the header, and which has one
/// @throw std::runtime_error  the file cannot be read, is larger than 16 MiB, or a row differs
[[nodiscard]] CsvTable read_csv_table(const std::filesystem::path& path);

/// Of the header alone, whatever follows it.
/// @throw std::runtime_error  the file cannot be read, is larger than 16 MiB, or has no header
[[nodiscard]] std::vector<std::string> read_csv_header(const std::filesystem::path& path);

/// "line 7: what".
[[nodiscard]] std::runtime_error error_in_line(std::size_t line, const std::string& what);

}  // namespace tactile_net
