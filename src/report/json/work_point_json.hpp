/// @file
/// Which point of a study is meant, as fields of JSON, and back. Private.
///
///     as_json(WorkCurve)  {"kind": "circuit", "realization": "nic", "bandwidth": 1e7}
///     as_json(Knob)       {"kind": "settled", "error": 0.01}
#pragma once

#include <stdexcept>
#include <string>

#include "report/json/described.hpp"
#include "tactile_net/study/work_point.hpp"

namespace tactile_net::report {

template <>
struct JsonForm<study::Job> {
  static Json json(const study::Job& job);
  static Json schema();
};
template <>
struct JsonForm<study::WorkCurve> {
  static Json json(const study::WorkCurve& curve);
  static Json schema();
};
template <>
struct JsonForm<study::Knob> {
  static Json json(const study::Knob& knob);
  static Json schema();
};

/// Read what these wrote.
/// @throw Json::exception     a field is missing, or of another type
/// @throw std::runtime_error  a field has a value that these do not write
[[nodiscard]] study::Job job_of(const Json& json);
[[nodiscard]] study::WorkCurve curve_of(const Json& json);
[[nodiscard]] study::Knob knob_of(const Json& json);

/// The enumerator of this name.
/// @throw std::runtime_error  none has it
template <class Enum>
[[nodiscard]] Enum one_named(const Json& text) {
  const std::string word = text.get<std::string>();
  for (const auto& row : Enumerators<Enum>::all)
    if (row.name == word) return row.value;
  throw std::runtime_error("it is not a study");
}

}  // namespace tactile_net::report
