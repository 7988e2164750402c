/// @file
/// What tractions on a skin amount to, each with its deviation: forces, centre, torsion, friction,
/// and the ellipse that touches.
///
/// Sums over all cells carry the noise of the empty ones; so they are taken over the cells of
/// contacts, as `contact_cells` finds them. All deviations are by first-order propagation of the
/// covariance.
///
///     const std::vector<std::size_t> cells = contact_cells(problem.grid, tractions, bands);
///     const UncertainWrench wrench =
///         resultant_of(problem.grid, tractions, cells, covariance, rms);
///     wrench.torsion->value;                 // [N m], about the centre of pressure
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/skin/grid.hpp"

namespace tactile_net {

/// Cells that touch: patches of neighbours whose normal traction is above twice its deviation, with
/// a peak above four times its own, and around each a rim as wide as what a contact is blurred by,
/// as far as it presses. Indices of cells, in rising order.
///
/// @param tractions   one component or three, the normal one first [Pa]
/// @param deviations  of the normal tractions at least, the noise included [Pa]
/// @param rim         width of the rim [m], >= 0: a taxel's depth, say
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] std::vector<std::size_t> contact_cells(const SurfaceGrid& grid,
                                                     std::span<const double> tractions,
                                                     std::span<const double> deviations,
                                                     double rim = 0.0);

/// The window that reaches `reach` from a cell's middle, no larger than the grid.
/// @param reach  [m], >= 0 and finite
[[nodiscard]] CellWindow window_of(const SurfaceGrid& grid, double reach);

/// Deviations of the sums over the windows around cells, the noise included.
struct WindowBands {
  CellWindow window{};
  std::vector<double> deviations{};  ///< one for each cell: `window_deviations` [Pa]
};

/// Cells that touch, and cells that may.
struct FoundContacts {
  std::vector<std::size_t> cells{};    ///< cells that touch, in rising order
  std::vector<std::size_t> doubted{};  ///< cells where a contact or noise shows, in rising order
};

/// Finds the cells of `contact_cells`; then, among the other cells, patches of cells whose windows'
/// sums are above twice their deviation, with a peak above four times its own. Readings tell narrow
/// cells only by their sums, so that a contact may be certain while each of its cells is not.
/// Patches without such a peak are doubted.
///
/// @throw std::invalid_argument  as `contact_cells`
[[nodiscard]] FoundContacts find_contacts(const SurfaceGrid& grid,
                                          std::span<const double> tractions,
                                          std::span<const double> deviations,
                                          const WindowBands& windows, double rim = 0.0);

/// The separate contacts: each patch of cells that touch one another, by an edge or a corner, the
/// strongest first.
[[nodiscard]] std::vector<std::vector<std::size_t>> separate_contacts(
    const SurfaceGrid& grid, std::span<const double> tractions, std::span<const std::size_t> cells);

/// Whether cells lie in a single row, or a single column.
[[nodiscard]] bool is_one_line(const SurfaceGrid& grid, std::span<const std::size_t> cells,
                               bool along_y);

/// Cells and those that touch them, by an edge or a corner, in rising order.
[[nodiscard]] std::vector<std::size_t> with_neighbours(const SurfaceGrid& grid,
                                                       std::span<const std::size_t> cells);

/// Wrench of the tractions of some cells.
///
/// @param cells      cells to sum over: `contact_cells`, or all
/// @param noise_rms  of one weighted reading
/// @throw std::invalid_argument  a size does not fit
[[nodiscard]] UncertainWrench resultant_of(const SurfaceGrid& grid,
                                           std::span<const double> tractions,
                                           std::span<const std::size_t> cells,
                                           const Covariance& covariance, double noise_rms);

/// How near contacts are to slipping, as they are and against a limit mu = |q| / p. Where several
/// lie apart, ratio, limit, lever and margin are those of the contact that needs the most friction,
/// for drag and torsion together, or without a limit for drag: two contacts dragged in opposite
/// directions both slip while the sum of their drags is 0.
struct SkinFriction {
  std::size_t contacts = 1;  ///< that lie apart, with a tenth or more of the strongest's force
  /// Wrench of the contact nearest to slipping; absent: there is one contact, of all cells.
  std::optional<UncertainWrench> wrench{};
  Uncertain ratio{};  ///< |(F_y, F_z)| / F_x
  /// A quantile of |q| / p: the least mu that explains cells that bear 90 % of the force.
  Uncertain least_limit{};
  /// sum p r A [N m]: the torsion at which the whole contact turns, over mu; no shape is assumed.
  double lever = 0.0;
  double lever_of_all = 0.0;  ///< sum p r A over all cells, about their common centre [N m]
  /// 1 - sqrt((F_t / (mu F_x))^2 + (T / (mu lever))^2): < 0 beyond the ellipsoid (Howe and Cutkosky
  /// 1996). Absent without a limit.
  std::optional<Uncertain> slip_margin{};
  std::vector<Uncertain> cell_margins{};  ///< mu p - |q| of each cell [Pa]; empty without a limit
};

/// How near the contacts on some cells are to slipping; absent with one component, or if F_x <= 0.
///
/// @param cells  cells of one contact, or of several: `separate_contacts` tells them apart
/// @param limit  mu, > 0; absent: no margins
/// @throw std::invalid_argument  a size does not fit, limit is not > 0
[[nodiscard]] std::optional<SkinFriction> friction_of(
    const SurfaceGrid& grid, std::span<const double> tractions, std::span<const std::size_t> cells,
    const Covariance& covariance, double noise_rms, std::optional<double> limit = {});

/// How the pressure of a contact is spread: what its second moments mean for its size.
enum class PressureLaw {
  hertz,    ///< variance of the place: a^2 / 5, a = radius
  uniform,  ///< variance of the place: a^2 / 4
  punch,    ///< variance of the place: a^2 / 3
};

/// The ellipse of one contact's pressure as the tractions have it, with what the solver has
/// blurred. Absent if F_x <= 0 or the moments are not an ellipse's.
[[nodiscard]] std::optional<ContactEllipse> contact_ellipse(
    const SurfaceGrid& grid, std::span<const double> tractions, std::span<const std::size_t> cells,
    const Covariance& covariance, double noise_rms, PressureLaw law = PressureLaw::hertz);

/// Each contact by itself, the strongest first.
///
/// @param contacts  their cells: `separate_contacts`
/// @throw std::invalid_argument  a size does not fit, the friction limit is not > 0
[[nodiscard]] std::vector<ContactPatch> patches_of(
    const SurfaceGrid& grid, std::span<const double> tractions,
    std::span<const std::vector<std::size_t>> contacts, const Covariance& covariance,
    double noise_rms, const PatchOptions& options = {});

/// The same on another grid: its cells that lie nearest to the patch's.
[[nodiscard]] ContactPatch on_grid(ContactPatch patch, const SurfaceGrid& from,
                                   const SurfaceGrid& to);

}  // namespace tactile_net
