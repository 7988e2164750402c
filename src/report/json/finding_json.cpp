#include "report/json/finding_json.hpp"

#include "tactile_net/report/words/check_words.hpp"

namespace tactile_net::report {
namespace {

template <class One>
Json schema_of_kind() {
  Json schema = object_schema<One>(
      {{"kind", {{"const", One::kind}}},
       {"text", {{"type", "string"}, {"description", "What was seen, in a sentence."}}},
       {"advice", {{"type", "string"}, {"description", "What to write or to do."}}}});
  schema["description"] = One::text;
  return schema;
}

/// An object for each alternative of a variant.
template <class Variant>
struct KindsOf;
template <class... Kinds>
struct KindsOf<std::variant<Kinds...>> {
  static Json schemas() { return Json::array({schema_of_kind<Kinds>()...}); }
};

}  // namespace

Json JsonForm<FindingTold>::json(const FindingTold& told) {
  Json json = {{"kind", lab::name(told.finding)}, {"text", told.text}, {"advice", told.advice}};
  std::visit([&]<class One>(const One& found) { add_fields(json, found); }, told.finding);
  return json;
}

Json JsonForm<FindingTold>::schema() { return {{"oneOf", KindsOf<lab::Finding>::schemas()}}; }

std::vector<FindingTold> findings_told(const lab::Findings& findings, const AnyScene& scene) {
  std::vector<FindingTold> all;
  for (const lab::Finding& one : findings)
    all.push_back({one, in_words(one, scene), advice(one, scene)});
  return all;
}

}  // namespace tactile_net::report
