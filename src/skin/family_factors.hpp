/// @file
/// What a skin's family of solutions is made of. Private.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "inverse/coordinates.hpp"
#include "inverse/mirror_classes.hpp"
#include "inverse/weighting.hpp"
#include "numeric/eigen.hpp"
#include "tactile_net/skin/family.hpp"

namespace tactile_net {

struct SkinFamily::Factors {
  /// readings of the class times W K T = U diag(gamma) V'.
  struct Block {
    MirrorClass part;
    Eigen::MatrixXd u{}, v{};
    Eigen::VectorXd gamma{};  // descending
  };

  /// @param condition  of L, at most
  Factors(const LinearProblem& problem, std::shared_ptr<const TractionCoordinates> basis,
          std::vector<MirrorClass> classes, double condition);

  /// V' of each class, applied to coordinates; one class after the other.
  [[nodiscard]] Eigen::MatrixXd components(const Eigen::MatrixXd& coordinates) const;
  /// V of each class, applied to components: coordinates.
  [[nodiscard]] Eigen::MatrixXd from_components(const Eigen::MatrixXd& components) const;

  /// T V of all classes, a row a traction: what bands are made of. Kept where it is not too large,
  /// so that frames after the first find it. Thread-safe.
  [[nodiscard]] std::shared_ptr<const RowMajor> roots() const;
  /// Of normal tractions, summed over the window around each cell of the problem's grid. Kept as
  /// those, for the last window.
  [[nodiscard]] std::shared_ptr<const RowMajor> window_roots(const SurfaceGrid& grid,
                                                             const CellWindow& window) const;

  Weighting weighting;
  std::shared_ptr<const TractionCoordinates> coordinates;
  std::vector<Block> blocks{};
  std::vector<double> gamma{};  // of all blocks
  double stabiliser_condition;

  struct Kept {
    std::mutex mutex{};
    std::shared_ptr<const RowMajor> roots{};
    std::optional<std::pair<CellWindow, std::shared_ptr<const RowMajor>>> windows{};
  };
  std::unique_ptr<Kept> kept = std::make_unique<Kept>();
};

/// The most by which L stretches one traction more than another.
[[nodiscard]] double stabiliser_condition(const LinearProblem& problem);

}  // namespace tactile_net
