/// @file
/// Values as JSON that several results write: what is absent or infinite is null.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/numeric/matrix.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/system/printable.hpp"

namespace tactile_net::report {

using Json = nlohmann::ordered_json;

/// The document as text, fit for a terminal; bytes of a file's name that are not UTF-8 are
/// replaced.
inline std::string text_of(const Json& json, int indent = 1) {
  return printable_json(json.dump(indent, ' ', false, Json::error_handler_t::replace)) + '\n';
}

inline Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json(nullptr);
}

inline Json finite_or_null(double number) {
  return std::isfinite(number) ? Json(number) : Json(nullptr);
}

inline Json list_or_null(const std::vector<double>& values) {
  return values.empty() ? Json(nullptr) : Json(values);
}

/// Row by row.
inline Json matrix_json(const Matrix& matrix) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < matrix.rows; ++i) rows.push_back(matrix.row(i));
  return rows;
}

inline Json uncertain_json(const Uncertain& number) {
  return {{"value", number.value}, {"deviation", number.deviation}};
}

inline Json uncertain_or_null(const std::optional<Uncertain>& number) {
  return number ? uncertain_json(*number) : Json(nullptr);
}

inline void add_remarks(Json& json, const Sentences& said) {
  json["warnings"] = said.warnings;
  json["notes"] = said.notes;
}

}  // namespace tactile_net::report
