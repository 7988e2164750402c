/// @file
/// What contact allows a cell, and the nearest to it. Private.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "numeric/eigen.hpp"
#include "realtime/cell_cone.hpp"
#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"

namespace tactile_net {

/// The contact state of a cell: where on its friction cone the projection ends. Separation: the
/// tip, nothing touches. Slip: the surface, friction is at its limit. Stick: the inside.
enum class ContactState { separation, slip, stick };

/// Projects (p, q_y, q_z) of every cell onto its cone; without a friction limit p alone.
class CellCones {
 public:
  using Index = Eigen::Index;

  CellCones(Index cells, const Constraints& constraints)
      : cells_(cells), constraints_(constraints) {}

  /// @param visit  is called with each cell and its contact state
  void project(Eigen::VectorXd& f, const auto& visit) const {
    for (Index i = 0; i < cells_; ++i) visit(i, project_cell(f, i));
  }
  void project(Eigen::VectorXd& f) const {
    project(f, [](Index, ContactState) {});
  }

 private:
  ContactState project_cell(Eigen::VectorXd& f, Index i) const {
    double& p = f(i);
    if (!constraints_.friction_limit) {
      if (!constraints_.nonnegative || p > 0.0) return ContactState::stick;
      p = 0.0;
      return ContactState::separation;
    }
    const double limit = *constraints_.friction_limit;
    double& y = f(cells_ + i);
    double& z = f(2 * cells_ + i);
    const double drag = std::hypot(y, z);
    const bool sticks = drag < limit * p;
    const CellCone to = cell_cone(p, drag, limit, 1.0 / (1.0 + limit * limit));
    p = to.normal;
    y *= to.shrunk;
    z *= to.shrunk;
    return sticks ? ContactState::stick : p > 0.0 ? ContactState::slip : ContactState::separation;
  }

  Index cells_;
  Constraints constraints_;
};

/// Adds to a face the directions in which the tractions of a cell may still change.
///
/// @param before  tractions whose projection the answer is; drags of any one scale
/// @param limit   of friction, of the tractions themselves
inline void add_free_directions(ActiveFace& face, const Eigen::VectorXd& before, Eigen::Index cells,
                                Eigen::Index at, ContactState state, std::optional<double> limit) {
  const auto cell = static_cast<std::size_t>(at);
  const auto add = [&](double p, double y, double z) { face.free.push_back({cell, {p, y, z}}); };
  const bool three = before.size() == 3 * cells;
  if (state == ContactState::slip) {
    // Of what is projected: the answer of a cell that hardly touches may have been rounded to 0.
    const double drag = std::hypot(before(cells + at), before(2 * cells + at));
    const double y = drag > 0.0 ? before(cells + at) / drag : 1.0;
    const double z = drag > 0.0 ? before(2 * cells + at) / drag : 0.0;
    const double length = std::hypot(1.0, *limit);
    add(1.0 / length, *limit / length * y, *limit / length * z);
    add(0.0, -z, y);
    return;
  }
  if (state == ContactState::stick) add(1.0, 0.0, 0.0);
  if (three && (state == ContactState::stick || !limit)) {
    add(0.0, 1.0, 0.0);
    add(0.0, 0.0, 1.0);
  }
}

/// @throw std::invalid_argument  friction_limit is not > 0 and finite, or there is one component
inline void check_cones(const LinearProblem& problem, const Constraints& constraints) {
  if (!constraints.friction_limit) return;
  check_friction_limit(*constraints.friction_limit);
  if (problem.components != 3)
    throw std::invalid_argument("a friction limit needs the tangential tractions as unknowns");
}

}  // namespace tactile_net
