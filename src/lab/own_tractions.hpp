/// @file
/// The tractions that a line is asked for, of those on the grid that its mixture is of. Private.
///
/// On a grid they are the same. Line loads over taxels D f_i are each what lies around their taxel,
/// weighed by a hat as wide as the pitch, over D: so that sums over the taxels are those of what
/// presses above them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "tactile_net/lab/scene_problem.hpp"

namespace tactile_net::lab {

class OwnTractions {
 public:
  explicit OwnTractions(const SceneProblem& problem)
      : own_(problem.surface()),
        grid_(problem.of_mixture().surface()),
        unknowns_(problem.options().unknowns),
        same_(&problem.of_mixture() == &problem) {}

  /// Whether the grid is the own surface.
  [[nodiscard]] bool same() const noexcept { return same_; }
  [[nodiscard]] const Surface& grid() const noexcept { return grid_; }

  /// What a mixture knows of each.
  [[nodiscard]] std::vector<Distribution> of(const LoadMixture& mixture) const {
    if (same_) return mixture.of_tractions();
    std::vector<Distribution> own;
    if (grid_.stride == 1 && grid_.spacing == own_.spacing) {  // those over the taxels
      std::vector<Distribution> all = mixture.of_tractions();
      for (std::size_t u = 0; u < unknowns_; ++u)
        for (std::size_t i = 0; i < own_.count; ++i)
          own.push_back(std::move(all[u * grid_.count + grid_.margin + i]));
      return own;
    }
    std::vector<std::vector<double>> rows;  // of each the weights of all on the grid
    for (std::size_t u = 0; u < unknowns_; ++u)
      for (std::size_t i = 0; i < own_.count; ++i) {
        std::vector<double>& row = rows.emplace_back(unknowns_ * grid_.count);
        weights(i, [&](std::size_t at, double weight) { row[u * grid_.count + at] = weight; });
      }
    return mixture.of_each(rows);
  }

  /// Of tractions on the grid the own ones.
  [[nodiscard]] std::vector<double> of(const std::vector<double>& all) const {
    if (same_) return all;
    std::vector<double> own;
    own.reserve(unknowns_ * own_.count);
    for (std::size_t u = 0; u < unknowns_; ++u)
      for (std::size_t i = 0; i < own_.count; ++i) {
        double sum = 0.0;
        weights(i,
                [&](std::size_t at, double weight) { sum += weight * all[u * grid_.count + at]; });
        own.push_back(sum);
      }
    return own;
  }

  /// Own tractions on the grid, linear from one to the next, with nothing beyond.
  [[nodiscard]] std::vector<double> on_grid(std::span<const double> own) const {
    std::vector<double> all(unknowns_ * grid_.count);
    for (std::size_t u = 0; u < unknowns_; ++u)
      for (std::size_t i = 0; i < own_.count; ++i)
        hats(i, [&](std::size_t at, double share) {
          all[u * grid_.count + at] += share * own[u * own_.count + i];
        });
    return all;
  }

  /// Of contacts on the grid those that own tractions have a share in.
  [[nodiscard]] std::vector<ContactPatch> of(std::vector<ContactPatch> patches) const {
    if (same_) return patches;
    for (ContactPatch& patch : patches) {
      std::vector<std::size_t> cells;
      for (const std::size_t cell : patch.cells) {
        const std::size_t from_first = cell + grid_.stride / 2;  // to the nearest taxel
        if (from_first < grid_.margin) continue;
        const std::size_t taxel = (from_first - grid_.margin) / grid_.stride;
        if (taxel < own_.count && (cells.empty() || cells.back() != taxel)) cells.push_back(taxel);
      }
      patch.cells = std::move(cells);
    }
    std::erase_if(patches, [](const ContactPatch& patch) { return patch.cells.empty(); });
    return patches;
  }

 private:
  /// Calls `use` with each place on the grid that an own traction is of, and its weight.
  void weights(std::size_t i, const auto& use) const {
    hats(i, [&](std::size_t at, double share) { use(at, share * grid_.spacing / own_.spacing); });
  }

  /// Calls `use` with each place on the grid in the hat around an own traction, and its share.
  void hats(std::size_t i, const auto& use) const {
    if (same_) return use(i, 1.0);
    const auto reach = static_cast<std::ptrdiff_t>(grid_.stride);
    const auto middle = static_cast<std::ptrdiff_t>(grid_.margin + i * grid_.stride);
    for (std::ptrdiff_t off = 1 - reach; off < reach; ++off) {
      const std::ptrdiff_t at = middle + off;
      if (at < 0 || at >= static_cast<std::ptrdiff_t>(grid_.count)) continue;
      use(static_cast<std::size_t>(at),
          1.0 - static_cast<double>(std::abs(off)) / static_cast<double>(reach));
    }
  }

  const Surface& own_;
  const Surface& grid_;
  std::size_t unknowns_;
  bool same_;
};

}  // namespace tactile_net::lab
