/// @file
/// What the rules for alpha ask of a family of solutions, whatever the frame: made once for a
/// recording, it leaves each frame a few products of matrices.
///
///     const AlphaTables tables(family.singular_values(), rows);
///     const AlphaSweep sweep = sweep_alpha(family.analyse(readings), tables);  // frame by frame
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "tactile_net/inverse/alpha.hpp"

namespace tactile_net {

class AlphaTables {
 public:
  /// The filters phi_i at the 200 alphas of a sweep. O(200 x components), five numbers for each.
  ///
  /// @param gamma  as `FilterFrame::gamma`, of every frame
  /// @param rows   as `FilterFrame::rows`
  /// @throw std::invalid_argument  there is no component
  AlphaTables(std::span<const double> gamma, std::size_t rows);
  ~AlphaTables();
  AlphaTables(AlphaTables&&) noexcept;
  AlphaTables& operator=(AlphaTables&&) noexcept;

  struct Parts;
  [[nodiscard]] const Parts& parts() const noexcept { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

/// `sweep_alpha` and `choose_alone` of a frame whose gamma and rows are those of the tables: the
/// same answers to rounding.
///
/// @throw std::invalid_argument  as those; the frame's gamma or rows are others
[[nodiscard]] AlphaSweep sweep_alpha(const FilterFrame& frame, const AlphaTables& tables,
                                     std::optional<double> noise_rms = {});
[[nodiscard]] AlphaChoice choose_alone(const FilterFrame& frame, const AlphaTables& tables,
                                       AlphaRule rule, std::optional<double> noise_rms = {});

}  // namespace tactile_net
