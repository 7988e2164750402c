#include "tactile_net/report/csv/estimate_csv.hpp"

#include <cmath>

namespace tactile_net::report {
namespace {

using Value = double (*)(const ContactEstimate&);

struct Column {
  const char* line;  ///< its name; null: lines do not have it
  const char* skin;
  Value value;
};

constexpr Column all_columns[] = {
    {"normal_force", "normal", [](const ContactEstimate& e) { return e.normal_force; }},
    {"normal_force_deviation", "normal_deviation",
     [](const ContactEstimate& e) { return e.force_deviation; }},
    {"tangential_force", nullptr, [](const ContactEstimate& e) { return e.tangential_force; }},
    {nullptr, "tangential_y", [](const ContactEstimate& e) { return e.tangential_y; }},
    {nullptr, "tangential_z", [](const ContactEstimate& e) { return e.tangential_z; }},
    {"centre", "centre_y", [](const ContactEstimate& e) { return e.centre; }},
    {nullptr, "centre_z", [](const ContactEstimate& e) { return e.centre_z; }},
    {nullptr, "torsion", [](const ContactEstimate& e) { return e.torsion; }},
    {"angle", "angle", [](const ContactEstimate& e) { return e.angle; }},
    {"friction_margin", "friction_margin",
     [](const ContactEstimate& e) { return e.friction_margin; }},
    {nullptr, "slip_margin", [](const ContactEstimate& e) { return e.slip_margin; }},
    {"margin_centre", "margin_centre_y", [](const ContactEstimate& e) { return e.margin_centre; }},
    {nullptr, "margin_centre_z", [](const ContactEstimate& e) { return e.margin_centre_z; }},
    {"contacts", "contacts",
     [](const ContactEstimate& e) { return static_cast<double>(e.contacts); }},
    {"residual_rms", "residual_rms", [](const ContactEstimate& e) { return e.residual_rms; }},
    {nullptr, "touching", [](const ContactEstimate& e) { return static_cast<double>(e.touching); }},
    {"outlier", "outlier", [](const ContactEstimate& e) { return static_cast<double>(e.outlier); }},
    {"contact", "contact", [](const ContactEstimate& e) { return e.contact ? 1.0 : 0.0; }},
    {"pulls", "pulls", [](const ContactEstimate& e) { return e.pulls ? 1.0 : 0.0; }},
    {"implausible", "implausible",
     [](const ContactEstimate& e) { return e.implausible ? 1.0 : 0.0; }},
    {"misfit", "misfit", [](const ContactEstimate& e) { return e.misfit ? 1.0 : 0.0; }},
    {"beyond_edge", "beyond_edge",
     [](const ContactEstimate& e) { return e.beyond_edge ? 1.0 : 0.0; }},
    {"baseline_moved", "baseline_moved",
     [](const ContactEstimate& e) { return e.baseline_moved ? 1.0 : 0.0; }},
    {"saturated", "saturated", [](const ContactEstimate& e) { return e.saturated ? 1.0 : 0.0; }},
};

}  // namespace

std::vector<std::string> estimate_columns(bool skin) {
  std::vector<std::string> names;
  for (const Column& column : all_columns)
    if (const char* name = skin ? column.skin : column.line) names.emplace_back(name);
  names.emplace_back("status");
  return names;
}

std::vector<double> estimate_values(const ContactEstimate& estimate, bool skin) {
  const bool answered = !std::isnan(estimate.normal_force);
  std::vector<double> values;
  for (const Column& column : all_columns)
    if ((skin ? column.skin : column.line) != nullptr)
      values.push_back(answered ? column.value(estimate) : ContactEstimate::unknown);
  return values;
}

}  // namespace tactile_net::report
