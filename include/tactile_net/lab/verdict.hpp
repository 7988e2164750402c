/// @file
/// Whether an answer is to be trusted, in one word.
#pragma once

#include <optional>
#include <string_view>

#include "tactile_net/inverse/alpha.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/inverse/thesis/dft_friction.hpp"
#include "tactile_net/inverse/uncertainty.hpp"

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
  no_contact,  ///< also of tikhonov: the readings hold no more than the noise
  null_mode,   ///< a combination of tractions that no reading shows was set to zero
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
  doubted,       ///< no contact explains the readings, see DataVerdict
};

/// The spelling in JSON and tables: "ok", "rules_disagree".
[[nodiscard]] std::string_view name(Verdict verdict) noexcept;

/// Nothing for any other text.
[[nodiscard]] std::optional<Verdict> verdict_named(std::string_view name) noexcept;

[[nodiscard]] Verdict verdict_of(AlphaVerdict verdict) noexcept;
[[nodiscard]] Verdict verdict_of(DftVerdict verdict) noexcept;
[[nodiscard]] Verdict verdict_of(const FrictionSolution& solution) noexcept;

/// The one word for all that is known of an answer, which every output has. `ok` means that the
/// readings can be true, too, and that the force is more than its deviation. Where nothing presses
/// neither alpha's choice nor where a contact would end is a fault: it is `no_contact`.
///
/// @param answer  what else is known of it
/// @param data    absent: nobody has judged the readings
/// @param force   along the normal; absent: its deviation is not known
[[nodiscard]] Verdict overall(Verdict answer, const std::optional<DataVerdict>& data,
                              const std::optional<Uncertain>& force = {}) noexcept;

/// Whether a frame has no fault: `ok`, or `no_contact`.
[[nodiscard]] constexpr bool is_faultless(Verdict verdict) noexcept {
  return verdict == Verdict::ok || verdict == Verdict::no_contact;
}

}  // namespace tactile_net::lab
