#include "tactile_net/frames/board_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "numeric/csv_fields.hpp"
#include "numeric/field_value.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/scene/bounded_text.hpp"
#include "tactile_net/scene/diagnostic.hpp"

namespace tactile_net::frames {
namespace {

[[noreturn]] void refuse_board(const std::string& file, std::size_t line,
                               const std::string& message, const std::string& hint) {
  throw InputError({Diagnostic{file, line, line == 0 ? 0U : 1U, message, hint, {}, 0}});
}

/// Where each wanted column stands.
std::vector<std::size_t> places_of(std::span<const std::string> wanted,
                                   const std::vector<std::string_view>& header,
                                   const std::string& file, std::size_t line) {
  std::vector<std::size_t> places;
  for (const std::string& name : wanted) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end() || std::count(header.begin(), header.end(), name) != 1)
      refuse_board(file, line, "has not one column '" + name + "'",
                   "columns are the circuit's inputs and outputs: " + wanted.front() + ", ..., " +
                       wanted.back() + "; a simulated board's file is such a one");
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  return places;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double most_of_a_board = 1e6;  // [A] and [V]
constexpr double least_voltage = 1e-30;

/// Of what is known.
struct Mean {
  double sum = 0.0;
  double count = 0.0;
  void add(double one) {
    if (!std::isfinite(one)) return;
    sum += one;
    count += 1.0;
  }
  [[nodiscard]] double value() const { return count > 0.0 ? sum / count : unknown; }
};

}  // namespace

BoardResponses read_board_file(const std::filesystem::path& path,
                               std::span<const std::string> inputs,
                               std::span<const std::string> outputs, double noise) {
  const std::string file = path.string();
  const std::string text =
      bounded_text(path, std::uintmax_t{64} << 20, "a file of responses has some kilobytes");
  std::vector<std::size_t> of_inputs;
  std::vector<std::size_t> of_outputs;
  CsvLayout layout;
  std::size_t columns = 0;
  BoardResponses result;
  std::vector<Mean> rest(outputs.size());
  bool is_rest_measured = false;
  std::size_t number = 0;
  for (const std::string_view whole : split(text, '\n')) {
    ++number;
    std::string_view line = whole.substr(0, whole.find_last_not_of(" \t\r") + 1);
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    if (columns == 0) layout = layout_of(line);
    std::vector<std::string_view> fields;
    for (const std::string_view field : fields_of(line, layout)) fields.push_back(trimmed(field));
    if (columns == 0) {
      columns = fields.size();
      of_inputs = places_of(inputs, fields, file, number);
      of_outputs = places_of(outputs, fields, file, number);
      continue;
    }
    if (fields.size() != columns)
      refuse_board(file, number,
                   "has " + std::to_string(fields.size()) + " fields, and the header " +
                       std::to_string(columns),
                   "a field for each column, separated as in the header; an unknown voltage is "
                   "empty");
    const auto value = [&](std::size_t at, bool may_lack) {
      double one = 0.0;
      const FieldKind kind = read_field(fields[at], layout.may_have_decimal_comma(), one);
      if (may_lack && kind == FieldKind::missing) return unknown;
      if (kind != FieldKind::number)
        refuse_board(file, number, why_no_number(fields[at], kind),
                     may_lack ? "in volts; empty where it is not known" : "in ampere");
      if (!(std::abs(one) <= most_of_a_board))
        refuse_board(file, number,
                     "has " + brief(one) + (may_lack ? " V" : " A") + ", which no board has",
                     may_lack ? "in volts; empty where it is not known" : "in ampere");
      return one;
    };
    std::vector<double> currents;
    std::vector<double> voltages;
    currents.reserve(of_inputs.size());
    voltages.reserve(of_outputs.size());
    for (const std::size_t at : of_inputs) currents.push_back(value(at, false));
    for (const std::size_t at : of_outputs) voltages.push_back(value(at, true));
    const bool at_rest =
        std::all_of(currents.begin(), currents.end(), [](double ampere) { return ampere == 0.0; });
    if (at_rest) {
      is_rest_measured = true;
      for (std::size_t n = 0; n < rest.size(); ++n) rest[n].add(voltages[n]);
      continue;
    }
    ++result.currents.rows;
    result.currents.values.insert(result.currents.values.end(), currents.begin(), currents.end());
    result.voltages.values.insert(result.voltages.values.end(), voltages.begin(), voltages.end());
    if (result.voltages.values.size() > most_responses)
      refuse_board(file, number, "has more than " + std::to_string(most_responses) + " voltages",
                   "fewer patterns: one for each input is enough");
  }
  if (columns == 0) refuse_board(file, 0, "is empty", "a header, then a pattern a row");
  if (result.currents.rows == 0)
    refuse_board(file, 0, "has no pattern that drives an input",
                 "a row for each input, with a current in its column");
  result.currents.columns = inputs.size();
  result.voltages.rows = result.currents.rows;
  result.voltages.columns = outputs.size();
  double largest = 0.0;
  for (std::size_t m = 0; m < result.voltages.rows; ++m)
    for (std::size_t n = 0; n < rest.size(); ++n) {
      if (is_rest_measured) result.voltages(m, n) -= rest[n].value();
      if (std::isfinite(result.voltages(m, n)))
        largest = std::max(largest, std::abs(result.voltages(m, n)));
    }
  if (!(largest > least_voltage))
    refuse_board(file, 0, "has no voltage beside 0", "what the outputs show under each pattern");
  result.noise = noise > 0.0 ? noise : std::ldexp(largest, -11) / std::sqrt(12.0);
  return result;
}

std::string board_file(std::span<const std::string> inputs, std::span<const std::string> outputs,
                       const BoardResponses& responses) {
  std::vector<std::string> names(inputs.begin(), inputs.end());
  names.insert(names.end(), outputs.begin(), outputs.end());
  std::string text;
  append_header(text, names, false);
  std::vector<double> row;
  for (std::size_t m = 0; m < responses.currents.rows; ++m) {
    row.clear();
    for (std::size_t i = 0; i < responses.currents.columns; ++i)
      row.push_back(responses.currents(m, i));
    for (std::size_t n = 0; n < responses.voltages.columns; ++n)
      row.push_back(responses.voltages(m, n));
    append_row(text, row);
  }
  return text;
}

std::string matrix_csv(std::span<const std::string> columns, const Matrix& matrix) {
  std::string text;
  append_header(text, columns, false);
  for (std::size_t i = 0; i < matrix.rows; ++i)
    append_row(text, std::span(matrix.values).subspan(i * matrix.columns, matrix.columns));
  return text;
}

}  // namespace tactile_net::frames
