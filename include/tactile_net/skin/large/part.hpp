/// @file
/// The part of a large skin about some of its cells (target tactile_net::spectral): what a reading
/// tells of a traction lies within a few depths, so that of a contact a part knows what the whole
/// does, at the price of its own size.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/skin/array.hpp"
#include "tactile_net/skin/large/system.hpp"
#include "tactile_net/skin/problem.hpp"

namespace tactile_net {

/// A smaller skin whose taxels and cells are taxels and cells of the large one.
class LargeSkinPart {
 public:
  /// Transforms the part's kernels.
  ///
  /// @param options  of the whole skin
  /// @param whole    problem of the whole skin; its weights count, whatever taxels the options call
  ///                 dead
  /// @param cells    cells of the whole skin to surround; at least one
  /// @param reach    how far the part's taxels reach beyond the cells [m], >= 0
  /// @throw std::invalid_argument  as `make_large_skin_system`; there is no such cell
  LargeSkinPart(SkinArray skin, const Material& material, SkinProblemOptions options,
                const LinearProblem& whole, std::span<const std::size_t> cells, double reach);

  [[nodiscard]] const std::shared_ptr<LargeSkinSystem>& system() const noexcept { return system_; }
  /// The part's readings among those of the whole. @pre  one value per reading of the whole
  [[nodiscard]] std::vector<double> readings(std::span<const double> whole) const;
  /// The part's tractions among those of the whole. @pre  one value per traction of the whole
  [[nodiscard]] std::vector<double> tractions(std::span<const double> whole) const;
  /// The part's tractions as tractions of the whole, 0 elsewhere.
  /// @pre  one value per traction of the part
  [[nodiscard]] std::vector<double> among_all(std::span<const double> part) const;
  /// True if the part has this cell of the whole.
  [[nodiscard]] bool has(std::size_t whole_cell) const noexcept;
  /// Index in the part of a cell of the whole. @pre  the part has the cell
  [[nodiscard]] std::size_t cell(std::size_t whole_cell) const noexcept;
  /// The directions of a face of the whole that lie in the part, with the part's cell indices.
  [[nodiscard]] ActiveFace face(const ActiveFace& whole) const;

 private:
  SurfaceGrid whole_;
  std::size_t first_row_ = 0, first_column_ = 0;  // of the part's cells
  std::vector<std::size_t> readings_{};           // where in the whole
  std::shared_ptr<LargeSkinSystem> system_{};
};

}  // namespace tactile_net
