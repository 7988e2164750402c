/// @file
/// Private. Where schemas come from: the fields of a result, or a file of docs/schemas.
#pragma once

#include <span>
#include <string_view>

#include "report/json/values.hpp"

namespace tactile_net::report {

struct WrittenSchema {
  std::string_view name;  ///< of the file, without its end
  std::string_view text;
};

/// The files of docs/schemas, as they were when this was built.
[[nodiscard]] std::span<const WrittenSchema> written_schemas();

// Of the kinds that are described by fields.
[[nodiscard]] Json calibrate_schema();
[[nodiscard]] Json certify_schema();
[[nodiscard]] Json check_schema();
[[nodiscard]] Json explain_schema();
[[nodiscard]] Json identify_schema();
[[nodiscard]] Json deck_schema();
[[nodiscard]] Json grasp_schema();
[[nodiscard]] Json plan_schema();
[[nodiscard]] Json relax_schema();
[[nodiscard]] Json simulate_schema();
[[nodiscard]] Json sweep_schema();
[[nodiscard]] Json tradeoff_schema();
[[nodiscard]] Json recordings_schema();
[[nodiscard]] Json run_schema();

}  // namespace tactile_net::report
