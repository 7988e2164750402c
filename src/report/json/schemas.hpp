/// @file
/// Private. The JSON Schema of each document, from the fields of its result.
#pragma once

#include "report/json/values.hpp"

namespace tactile_net::report {

[[nodiscard]] Json calibrate_schema();
[[nodiscard]] Json certify_schema();
[[nodiscard]] Json check_schema();
[[nodiscard]] Json datasheet_schema();
[[nodiscard]] Json deck_schema();
[[nodiscard]] Json explain_schema();
[[nodiscard]] Json grasp_schema();
[[nodiscard]] Json identify_schema();
[[nodiscard]] Json plan_schema();
[[nodiscard]] Json recordings_schema();
[[nodiscard]] Json relax_schema();
[[nodiscard]] Json macromodel_schema();
[[nodiscard]] Json refinement_schema();
[[nodiscard]] Json bench_schema();
[[nodiscard]] Json run_schema();
[[nodiscard]] Json simulate_schema();
[[nodiscard]] Json solve_schema();
[[nodiscard]] Json sweep_schema();
[[nodiscard]] Json tradeoff_schema();

}  // namespace tactile_net::report
