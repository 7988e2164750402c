/// @file
/// What a sweep keeps of a point and a method: one row, in the study's order the same whoever
/// computed it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/lab/observer.hpp"
#include "tactile_net/simulator/simulator.hpp"
#include "tactile_net/sweep/study.hpp"

namespace tactile_net::sweep {

/// An absent number is an empty field of CSV: not known, not finite, or there is no answer.
struct Row {
  std::size_t index = 0;
  std::vector<std::string> values{};  ///< of the axes, `AxisValue::plain`
  std::uint64_t seed = 0;
  std::string method{};  ///< empty: the point failed before any
  std::optional<double> alpha{};
  std::string verdict = "failed";            ///< as lab::name(Verdict)
  std::optional<double> error{};             ///< |f_v - truth|_2 / |truth|_2
  std::optional<double> error_tangential{};  ///< the same of f_t
  std::optional<double> mean_error{};        ///< mean |f_v - truth| [Pa]
  std::optional<double> force{};             ///< [N/m]; of skins into them [N]
  std::optional<double> tangential_force{};  ///< [N/m]; of skins the length of their drag [N]
  std::optional<double> centre_y{};          ///< of the normal tractions [m]
  std::optional<double> centre_z{};          ///< the same, of skins
  std::optional<double> condition{};
  std::optional<double> error_bound{};  ///< of rounding, over the answer's 2-norm
  std::vector<double> readings{};       ///< as a recording has them
  std::vector<double> truth{};          ///< [Pa], component after component
  std::vector<double> tractions{};      ///< the same, of those that were found
  std::string failure{};                ///< why there is no answer, on one line
  std::string version{};                ///< of the library
  std::string instructions{};           ///< the machine's: bits are equal on one set alone
};

/// "index", the axes' keys, "seed", "method", ... in the order of `csv`.
[[nodiscard]] std::string header(const std::vector<std::string>& axes,
                                 const std::vector<Kept>& keep);

/// What of a row is kept as CSV (RFC 4180), without its line's end. Lists are one field, with
/// blanks between their numbers.
[[nodiscard]] std::string csv(const Row& row, const std::vector<Kept>& keep);

/// The same read back. Nothing: it is no row with so many axes.
[[nodiscard]] std::optional<Row> row_in(std::string_view line, std::size_t axes,
                                        const std::vector<Kept>& keep);

/// The fields of a line of CSV.
[[nodiscard]] std::vector<std::string> fields(std::string_view line);

/// What becomes of a point: a row for each method, or one that says why there is none. Points may
/// be solved on several threads at once, each with a simulator of its own.
///
/// @param observer  may end it between steps: what is returned then means nothing
[[nodiscard]] std::vector<Row> solve(const Study& study, std::size_t index, Simulator& simulator,
                                     lab::Observer& observer = lab::silent);

}  // namespace tactile_net::sweep
