/// @file
/// Whether an answer is to be trusted, in one word.
#pragma once

#include <optional>
#include <string_view>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/dft.hpp"
#include "tactile_net/inverse/dft_friction.hpp"

namespace tactile_net::lab {

enum class Verdict {
  ok,
  failed,  ///< there is no answer
  // The rule for alpha, see AlphaVerdict.
  border,
  unstable,
  no_root,
  rules_disagree,
  noise_needed,
  // dft, see DftVerdict and FrictionVerdict.
  noise_amplified,
  sign_change,
  cut_off,  ///< also of tikhonov: the contact may reach beyond what taxels see
  not_one_contact,
  drag_in_noise,
  no_contact,
  null_mode,  ///< a combination of tractions that no reading shows was set to zero
  // Iterations that were stopped.
  not_converged,
  iteration_limit,
  unconstrained,  ///< the scene's constraints bind tikhonov alone; this answer does not know them
  // What the answer itself shows.
  oversmoothed,     ///< more than half of the readings' size is left unexplained
  ill_conditioned,  ///< rounding alone may have moved it by more than 1e-3
  inaccurate,       ///< the circuit is more than 1 % off the direct solve, though explained
  // What the readings lack.
  clipped,  ///< taxels read the end of their range: what they would read beyond it is not known
  undetermined,  ///< the readings tell little of the force, or it may be larger than any that such
                 ///< readings could come from
  coarse,        ///< the taxels lie too far apart for their depth
};

/// The spelling in JSON and tables: "ok", "rules_disagree".
[[nodiscard]] std::string_view name(Verdict verdict) noexcept;

/// Nothing for any other text.
[[nodiscard]] std::optional<Verdict> verdict_named(std::string_view name) noexcept;

[[nodiscard]] Verdict verdict_of(AlphaVerdict verdict) noexcept;
[[nodiscard]] Verdict verdict_of(DftVerdict verdict) noexcept;
[[nodiscard]] Verdict verdict_of(const FrictionSolution& solution) noexcept;

}  // namespace tactile_net::lab
