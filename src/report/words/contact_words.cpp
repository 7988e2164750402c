#include "tactile_net/report/words/contact_words.hpp"

#include <algorithm>

#include "report/contact_columns.hpp"
#include "report/words/number_words.hpp"

namespace tactile_net::report {
namespace {

std::string number_in_words(const std::optional<Units>& units, const ContactColumn& column,
                            const Uncertain& number) {
  if (!column.squared) return in_unit(units, column.dimension, number);
  const auto [label, factor] = column.unit(units, number.value);
  const std::string words = plus_minus(number.value * factor, number.deviation * factor);
  return label.empty() ? words : words + ' ' + label;
}

}  // namespace

std::vector<std::vector<std::string>> patch_cells(const std::optional<Units>& units,
                                                  std::span<const ContactPatch> patches,
                                                  std::optional<Dimension> stated) {
  if (patches.size() < 2) return {};
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>{"contact"});
  for (std::size_t i = 1; i <= patches.size(); ++i) rows.emplace_back(1, std::to_string(i));
  const bool of_skin = std::any_of(patches.begin(), patches.end(), [](const auto& one) {
    return one.ellipse || one.wrench.centre_z;
  });
  for (const ContactColumn& column : contact_columns(of_skin, stated)) {
    if (std::none_of(patches.begin(), patches.end(),
                     [&](const auto& one) { return column.of(one).has_value(); }))
      continue;
    rows[0].push_back(column.label);
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const auto number = column.of(patches[i]);
      rows[i + 1].push_back(number ? number_in_words(units, column, *number) : "-");
    }
  }
  return rows;
}

}  // namespace tactile_net::report
