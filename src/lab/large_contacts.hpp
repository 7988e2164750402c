/// @file
/// What constraints leave of the contacts on a large skin: their bands, and what noise moves their
/// force by. Private.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "tactile_net/inverse/cone_tikhonov.hpp"
#include "tactile_net/inverse/constrained.hpp"
#include "tactile_net/inverse/filter_frame.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/skin/large/part.hpp"

namespace tactile_net::lab {

/// The contacts of one answer, in parts of the skin that are solved one by one: what lies farther
/// apart than a reading reaches errs on its own.
class LargeContacts {
 public:
  /// A part for cells of the whole.
  using Cut = std::function<LargeSkinPart(std::span<const std::size_t>)>;

  /// @param contacts  cells of the whole that lie apart
  /// @param reach     of a part beyond its cells [m]
  LargeContacts(const LinearProblem& whole, const std::vector<std::vector<std::size_t>>& contacts,
                double reach, const Cut& cut);

  /// Of sums over these contacts, constraints taken for certain; refers to this object.
  ///
  /// @param face      of the whole
  /// @param readings  of each part, less what is found beyond it
  /// @param prior     the prior's alpha, of a part's frame
  /// @param free      without constraints, of the whole: kept by reference
  [[nodiscard]] std::unique_ptr<const Covariance> covariance(
      const ActiveFace& face,
      const std::function<std::vector<double>(const LargeSkinPart&)>& readings, double alpha,
      const std::function<double(const FilterFrame&)>& prior, const Covariance& free) const;

  /// `constraint_bias`, of all of them.
  [[nodiscard]] double bias(std::span<const double> tractions, double alpha,
                            const Constraints& constraints, double noise_rms) const;

 private:
  struct Group {
    std::vector<std::size_t> cells;  // of the whole
    LargeSkinPart part;
  };
  class OfGroups;

  std::size_t cells_;  // of the whole
  std::vector<Group> groups_{};
};

}  // namespace tactile_net::lab
