#include "tactile_net/report/csv/estimate_csv.hpp"

#include <cmath>

#include "report/columns.hpp"
#include "report/csv/estimate_fields.hpp"

namespace tactile_net::report {

std::vector<std::string> estimate_columns(bool skin, bool curved) {
  std::vector<std::string> names = columns_of<ContactEstimate>(skin, false, curved);
  names.emplace_back("status");
  return names;
}

std::vector<double> estimate_values(const ContactEstimate& estimate, bool skin, bool curved) {
  std::vector<double> values = values_of(estimate, skin, false, curved);
  if (std::isnan(estimate.normal_force)) values.assign(values.size(), ContactEstimate::unknown);
  return values;
}

}  // namespace tactile_net::report
