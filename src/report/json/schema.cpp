#include "tactile_net/report/json/schema.hpp"

#include <algorithm>
#include <stdexcept>

#include "report/json/finding_json.hpp"
#include "report/json/network_values.hpp"
#include "report/json/scene_json.hpp"
#include "report/json/schemas.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::report {
namespace {

struct DescribedKind {
  std::string_view name;
  Json (*schema)();
};
constexpr DescribedKind described_kinds[] = {{kind::calibrate.name, calibrate_schema},
                                             {kind::certify.name, certify_schema},
                                             {kind::check.name, check_schema},
                                             {kind::deck.name, deck_schema},
                                             {kind::explain.name, explain_schema},
                                             {kind::grasp.name, grasp_schema},
                                             {kind::identify.name, identify_schema},
                                             {kind::plan.name, plan_schema},
                                             {kind::relax.name, relax_schema},
                                             {kind::report.name, recordings_schema},
                                             {kind::run.name, run_schema},
                                             {kind::simulate.name, simulate_schema},
                                             {kind::sweep.name, sweep_schema},
                                             {kind::tradeoff.name, tradeoff_schema}};

/// The file that holds parts of others, and is no document.
constexpr std::string_view shared_file = "common";

/// The parts that are described by fields, by the names that written schemas have for them.
Json described_parts() {
  return {{"effects", schema_of<EffectsTold>()}, {"finding", schema_of<FindingTold>()},
          {"frame", schema_of<FrameTold>()},     {"method", schema_of<Method>()},
          {"network", network_schema()},         {"runs", schema_of<lab::FrameRuns>()},
          {"uncertain", schema_of<Uncertain>()}, {"units", schema_of<UnitsTold>()}};
}

/// What a written schema may refer to: in its words parts of "common.json", "described.json" and
/// "circuit.json".
Json shared_parts() {
  Json parts = Json::object();
  for (const WrittenSchema& one : written_schemas())
    if (one.name == shared_file) parts = Json::parse(one.text).at("$defs");
  parts.update(described_parts());
  return {{"$defs", parts}};
}

Json schema_in(std::string_view name) {
  if (name == shared_file || name == "described" || name == "circuit") return shared_parts();
  for (const DescribedKind& one : described_kinds)
    if (one.name == name) return one.schema();
  for (const WrittenSchema& one : written_schemas())
    if (one.name == name) return Json::parse(one.text);
  throw std::logic_error("no schema is called " + std::string(name));
}

void expect_kind(std::string_view kind) {
  const std::vector<std::string_view> kinds = schema_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw std::invalid_argument("no document is of the kind '" + std::string(kind) +
                                "': give one of " +
                                join(std::vector<std::string>(kinds.begin(), kinds.end()), ", "));
}

/// Takes what a schema refers to, in its own file and in others, into one list of definitions.
class Bundle {
 public:
  explicit Bundle(std::string_view kind) : kind_(kind), schema_(schema_in(kind)) {
    schema_.erase("$defs");
    take_in(schema_, kind_);
    if (!definitions_.empty()) schema_["$defs"] = definitions_;
  }

  [[nodiscard]] const Json& schema() const { return schema_; }

 private:
  /// @param part  of the schema `file`
  void take_in(Json& part, const std::string& file) {
    if (part.is_object() && part.contains("$ref")) refer(part["$ref"], file);
    if (part.is_structured())
      for (Json& inner : part) take_in(inner, file);
  }

  /// @param reference  "common.json#/$defs/runs", or "#/$defs/runs" of `file` itself
  void refer(Json& reference, const std::string& file) {
    const std::string text = reference;
    const std::size_t end = text.find(".json#");
    const std::string of = end == text.npos ? file : text.substr(0, end);
    const std::string name = text.substr(text.rfind('/') + 1);
    const std::string here = of == kind_ ? name : of + '_' + name;
    reference = "#/$defs/" + here;
    if (definitions_.contains(here)) return;
    definitions_[here] = nullptr;  // where it refers to itself
    Json definition = schema_in(of).at("$defs").at(name);
    take_in(definition, of);
    definitions_[here] = std::move(definition);
  }

  std::string kind_;
  Json schema_;
  Json definitions_ = Json::object();
};

}  // namespace

std::vector<std::string_view> schema_kinds() {
  std::vector<std::string_view> names;
  for (const DescribedKind& one : described_kinds) names.push_back(one.name);
  for (const WrittenSchema& one : written_schemas())
    if (one.name != shared_file) names.push_back(one.name);
  std::sort(names.begin(), names.end());
  return names;
}

std::string schema(std::string_view kind) {
  expect_kind(kind);
  return text_of(Bundle(kind).schema(), 2);
}

std::string schema_title(std::string_view kind) {
  expect_kind(kind);
  return schema_in(kind).at("title");
}

}  // namespace tactile_net::report
