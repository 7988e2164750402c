#include "tactile_net/report/json/schema.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "report/json/document.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::report {
namespace {

struct DescribedKind {
  std::string_view name;
  Json (*schema)();
};
/// By their names.
constexpr DescribedKind described_kinds[] = {{kind::bench.name, bench_schema},
                                             {kind::calibrate.name, calibrate_schema},
                                             {kind::certify.name, certify_schema},
                                             {kind::check.name, check_schema},
                                             {kind::datasheet.name, datasheet_schema},
                                             {kind::deck.name, deck_schema},
                                             {kind::explain.name, explain_schema},
                                             {kind::grasp.name, grasp_schema},
                                             {kind::identify.name, identify_schema},
                                             {kind::macromodel.name, macromodel_schema},
                                             {kind::plan.name, plan_schema},
                                             {kind::refinement.name, refinement_schema},
                                             {kind::relax.name, relax_schema},
                                             {kind::report.name, recordings_schema},
                                             {kind::run.name, run_schema},
                                             {kind::simulate.name, simulate_schema},
                                             {kind::solve.name, solve_schema},
                                             {kind::sweep.name, sweep_schema},
                                             {kind::tradeoff.name, tradeoff_schema}};

Json schema_named(std::string_view kind) {
  const auto* found = std::ranges::find(described_kinds, kind, &DescribedKind::name);
  if (found != std::end(described_kinds)) return found->schema();
  const std::vector<std::string_view> kinds = schema_kinds();
  throw std::invalid_argument("no document is of the kind '" + std::string(kind) +
                              "': give one of " +
                              join(std::vector<std::string>(kinds.begin(), kinds.end()), ", "));
}

}  // namespace

std::vector<std::string_view> schema_kinds() {
  std::vector<std::string_view> names;
  for (const DescribedKind& one : described_kinds) names.push_back(one.name);
  return names;
}

std::string schema(std::string_view kind) { return text_of(schema_named(kind), 2); }

std::string schema_title(std::string_view kind) { return schema_named(kind).at("title"); }

}  // namespace tactile_net::report
