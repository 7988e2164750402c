#include "tactile_net/report/words/contact_words.hpp"

#include <algorithm>

#include "report/told_numbers.hpp"
#include "report/words/number_words.hpp"
#include "tactile_net/lab/answer_fields.hpp"

namespace tactile_net::report {
namespace {

std::string number_in_words(const std::optional<Units>& units, Measure measure, Dimension load,
                            const Uncertain& number) {
  if (measure != Measure::area) return in_unit(units, dimension_of(measure, load), number);
  const auto [label, factor] = unit_of(measure, load, units, number.value);
  const std::string words = plus_minus(number.value * factor, number.deviation * factor);
  return label.empty() ? words : words + ' ' + label;
}

}  // namespace

std::vector<std::vector<std::string>> patch_cells(const std::optional<Units>& units,
                                                  std::span<const ContactPatch> patches,
                                                  std::optional<Dimension> force) {
  if (patches.size() < 2) return {};
  const bool of_skin = std::any_of(patches.begin(), patches.end(), [](const auto& one) {
    return one.ellipse || one.wrench.centre_z;
  });
  const Dimension load = force.value_or(load_dimension(of_skin));
  std::vector<std::vector<ToldNumber>> all;
  for (const ContactPatch& patch : patches)
    all.push_back(told_numbers(patch, contact_fields, of_skin));
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>{"contact"});
  for (std::size_t i = 1; i <= all.size(); ++i) rows.emplace_back(1, std::to_string(i));
  for (std::size_t k = 0; k < all.front().size(); ++k) {
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& one) { return one[k].number.has_value(); }))
      continue;
    rows[0].push_back(all.front()[k].label);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [label, measure, number] = all[i][k];
      rows[i + 1].push_back(number ? number_in_words(units, measure, load, *number) : "-");
    }
  }
  return rows;
}

}  // namespace tactile_net::report
