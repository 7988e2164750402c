#include "tactile_net/report/words/contact_words.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

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

/// Of each patch the contact that is nearest; none where one is that of two patches.
std::vector<TrueContact> beside(std::span<const ContactPatch> patches,
                                std::span<const TrueContact> truth) {
  std::vector<TrueContact> all;
  std::vector<bool> taken(truth.size());
  if (truth.size() != patches.size()) return {};
  for (const ContactPatch& patch : patches) {
    const UncertainWrench& found = patch.wrench;
    if (!found.centre_y) return {};
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i].z.has_value() != found.centre_z.has_value()) return {};
      const double away = std::hypot(truth[i].y - found.centre_y->value,
                                     truth[i].z ? *truth[i].z - found.centre_z->value : 0.0);
      if (away < least) {
        least = away;
        nearest = i;
      }
    }
    if (taken[nearest]) return {};
    taken[nearest] = true;
    all.push_back(truth[nearest]);
  }
  return all;
}

}  // namespace

std::vector<TrueContact> true_contacts(const AnyScene& scene) {
  std::vector<TrueContact> all;
  if (const auto* line = std::get_if<Scene>(&scene)) {
    for (const Contact& one : line->contacts) {
      const auto* body = std::get_if<RigidContact>(&one);
      if (body == nullptr || body->edge > 0.0) return {};  // whose resultant is another one
      if (body->force != 0.0) all.push_back({body->force, body->center});
    }
    return all;
  }
  for (const SkinLoad& one : std::get<SkinScene>(scene).contacts) {
    const auto* body = std::get_if<SkinContact>(&one);
    if (body == nullptr) return {};
    if (body->force != 0.0) all.push_back({body->force, body->y, body->z});
  }
  return all;
}

std::vector<std::vector<std::string>> patch_cells(const std::optional<Units>& units,
                                                  std::span<const ContactPatch> patches,
                                                  std::optional<Dimension> force,
                                                  std::span<const TrueContact> truth) {
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
  const std::vector<TrueContact> known = beside(patches, truth);
  if (known.empty()) return rows;
  rows[0].insert(rows[0].end(), {"true force", of_skin ? "true centre, y" : "true centre"});
  if (of_skin) rows[0].push_back("true centre, z");
  for (std::size_t i = 0; i < known.size(); ++i) {
    rows[i + 1].push_back(in_unit(units, load, known[i].force));
    rows[i + 1].push_back(in_unit(units, Dimension::length, known[i].y));
    if (of_skin) rows[i + 1].push_back(in_unit(units, Dimension::length, *known[i].z));
  }
  return rows;
}

}  // namespace tactile_net::report
