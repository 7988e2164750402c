/// @file
/// One alpha for neighbouring frames of a stream.
///
/// What a rule chooses for one frame is an estimate with the noise of that frame, and tractions
/// flicker with it. Frames taken one after another want nearly the same alpha: here it is the best
/// for the sum of what the rule minimises over the last few of them.
///
///     SharedAlpha shared(AlphaTables(family.singular_values(), rows), AlphaRule::aicc, 20);
///     const FilterFrame frame = family.analyse(readings);  // frame by frame
///     const std::vector<double> tractions = family.solve(frame, shared.push(frame).alpha);
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "tactile_net/inverse/alpha_tables.hpp"

namespace tactile_net {

class SharedAlpha {
 public:
  /// @param tables     of the family of all frames. If frames have shares, whose components are
  ///                   nodes of a quadrature (skin/large/family.hpp): of the first frame; each
  ///                   other frame has nodes of its own, at the same alphas
  /// @param frames     how many the sum is over: the last `frames` pushed, fewer at the beginning
  /// @param noise_rms  of one weighted reading
  /// @throw std::invalid_argument  frames is 0; noise_rms is not >= 0, or absent and the rule needs
  ///                               it
  SharedAlpha(AlphaTables tables, AlphaRule rule, std::size_t frames,
              std::optional<double> noise_rms = {});
  ~SharedAlpha();
  SharedAlpha(SharedAlpha&&) noexcept;
  SharedAlpha& operator=(SharedAlpha&&) noexcept;

  /// The choice for this frame from the last ones and itself; its verdict is on this frame alone,
  /// as that of `choose_alone`. Equal frames get the alpha that each of them would choose. Frames
  /// in which nothing was read do not count. Costs one rule's values of one frame and the
  /// refinement over all: some ten sums over frames x components.
  ///
  /// @throw std::invalid_argument  the frame is of another family, or has no periodogram and the
  ///                               rule needs it
  AlphaChoice push(FilterFrame frame);

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace tactile_net
