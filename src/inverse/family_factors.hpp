/// @file
/// What a family of solutions is made of. Private.
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
#include "tactile_net/inverse/tikhonov_family.hpp"

namespace tactile_net {

struct TikhonovFamily::Factors {
  /// readings of the class times W K T = U diag(gamma) V'.
  struct Block {
    MirrorClass part;
    Eigen::MatrixXd u{}, v{};
    Eigen::VectorXd gamma{};  // descending
  };

  Factors(const LinearProblem& problem, std::shared_ptr<const TractionCoordinates> basis,
          std::vector<MirrorClass> classes);

  /// V' of each class, applied to coordinates; one class after the other.
  [[nodiscard]] Eigen::MatrixXd components(const Eigen::MatrixXd& from) const;
  /// V of each class, applied to components: coordinates.
  [[nodiscard]] Eigen::MatrixXd from_components(const Eigen::MatrixXd& from) const;
  /// U of all classes: a row a reading, a column a component.
  [[nodiscard]] Eigen::MatrixXd left_vectors() const;

  /// The 2-norm condition number of [W K; sqrt(alpha) L], class by class: as much work as the
  /// decomposition.
  /// @pre   the coordinates are waves, whose stretch is known
  /// @throw std::domain_error  it is more than double precision resolves
  [[nodiscard]] double stacked_condition(double alpha) const;

  /// T V of all classes, a row a traction: what bands are made of. Kept where it is not too large,
  /// so that frames after the first find it. Thread-safe.
  [[nodiscard]] std::shared_ptr<const RowMajor> roots() const;
  /// `roots` of normal tractions, summed over the window around each cell of the problem's grid.
  /// Kept likewise, for the last window.
  [[nodiscard]] std::shared_ptr<const RowMajor> window_roots(const SurfaceGrid& grid,
                                                             const CellWindow& window) const;

  /// The transform of readings to frequencies, which the rule ncp alone asks for.
  struct Spectra {
    Eigen::MatrixXd fourier;  // cosines, then sines, channel by channel
    Eigen::MatrixXd of_u;     // of the left vectors
  };
  /// Made when it is first asked for. Thread-safe.
  /// @pre  the problem is a line's
  [[nodiscard]] const Spectra& spectra() const;

  std::size_t line;  // readings of a line whose spectrum is taken together; 0: of a skin none is
  Weighting weighting;
  std::shared_ptr<const TractionCoordinates> coordinates;
  std::vector<Block> blocks{};
  std::vector<double> gamma{};  // of all blocks
  double stabiliser_condition;  // of L

 private:
  struct Kept {
    std::mutex mutex{};
    std::shared_ptr<const RowMajor> roots{};
    std::optional<std::pair<CellWindow, std::shared_ptr<const RowMajor>>> windows{};
  };
  mutable Kept kept_{};
  mutable std::once_flag spectra_made_{};
  mutable Spectra spectra_{};
};

}  // namespace tactile_net
