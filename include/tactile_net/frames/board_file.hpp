/// @file
/// What a bench has measured of a board, as CSV: a pattern a row.
///
/// Columns: a current [A] of each of the circuit's inputs, "I0", "I1", ..., then a voltage [V] of
/// each output, "n0", "n1", ... A voltage that is not known, as at the end of a converter, is an
/// empty field or "nan". A row in which every input is 0 is the board's rest, and is subtracted.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "tactile_net/network/board_bench.hpp"

namespace tactile_net::frames {

/// @param noise  standard deviation of a voltage [V]; 0: of a step of 12 bits of twice the largest
/// @throw InputError  the file cannot be read, a column is missing, a field is no number, there is
///                    no pattern, a row has no voltage, or more voltages than `most_responses`
[[nodiscard]] BoardResponses read_board_file(const std::filesystem::path& path,
                                             std::span<const std::string> inputs,
                                             std::span<const std::string> outputs, double noise);

/// The text of such a file.
[[nodiscard]] std::string board_file(std::span<const std::string> inputs,
                                     std::span<const std::string> outputs,
                                     const BoardResponses& responses);

/// A matrix as CSV, a row a line, under these names.
[[nodiscard]] std::string matrix_csv(std::span<const std::string> columns, const Matrix& matrix);

}  // namespace tactile_net::frames
