/// @file
/// Which point of a study is meant, as fields of JSON, and back. Private.
///
///     method_json(WorkCurve)  {"kind": "circuit", "realization": "nic", "bandwidth": 1e7}
///     setting_json(Knob)      {"kind": "settled", "error": 0.01}
#pragma once

#include <stdexcept>
#include <string>

#include "report/json/values.hpp"
#include "tactile_net/study/work_point.hpp"

namespace tactile_net::report {

[[nodiscard]] Json task_json(const study::Job& job);
[[nodiscard]] Json method_json(const study::WorkCurve& curve);
[[nodiscard]] Json setting_json(const study::Knob& knob);

/// Read what these wrote.
/// @throw Json::exception     a field is missing, or of another type
/// @throw std::runtime_error  a field has a value that these do not write
[[nodiscard]] study::Job job_of(const Json& json);
[[nodiscard]] study::WorkCurve curve_of(const Json& json);
[[nodiscard]] study::Knob knob_of(const Json& json);

/// The one of `all` that has this name.
/// @throw std::runtime_error  none has it
[[nodiscard]] auto one_named(const auto& all, const Json& text) {
  const std::string word = text.get<std::string>();
  for (const auto& one : all)
    if (name(one) == word) return one;
  throw std::runtime_error("it is not a study");
}

}  // namespace tactile_net::report
