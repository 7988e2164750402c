/// @file
/// Rules that choose alpha, side by side.
///
/// With phi_i of filter_frame.hpp, rho the residual's norm, m rows, H the influence matrix
/// (tr H = sum phi_i: L is square, nothing goes unsmoothed):
///
///     rgcv         least  rho^2 / (m - tr H)^2 (c + (1 - c) tr(H^2) / m), c = 0.1   (Lukas 2006)
///     gcv          least  rho^2 / (m - tr H)^2         (Golub, Heath and Wahba 1979)
///     discrepancy  rho = 1.01 sigma sqrt(m), sigma the noise's rms     (Morozov 1966)
///     l_curve      largest curvature of (log rho, log |L f|)     (Hansen and O'Leary 1993)
///     ncp          residual most like white noise: its normalised cumulative periodogram least far
///                  from a straight line in the 2-norm     (Hansen, Kilmer and Kjeldsen 2006)
///     gml          least  g'(I - H) g / det(I - H)^(1/m)     (Wahba 1985)
///     evidence     least  1/2 [ g'(I - H) g / sigma^2 - log det(I - H) ]     (MacKay 1992):
///                  gml with the noise's rms sigma known
///     aicc         least  log(rho^2 / m) + 1 + 2 (tr H + 1) / (m - tr H - 2), infinite where
///                  tr H >= m - 2     (Hurvich, Simonoff and Tsai 1998)
///
/// Which to take: `default_rule` of alpha_tables.hpp. Without the noise's rms a rule must tell
/// noise from signal by the readings alone, which few readings do not allow: then the verdict is
/// `noise_needed`.
///
/// Every rule is a function of log alpha whose slope is known in closed form; the best of 200
/// values is refined to a root of the slope. So the answer is the same in any units, to rounding.
///
///     const TikhonovFamily family(problem);  // once, for every alpha and every frame
///     const FilterFrame frame = family.analyse(readings);
///     const AlphaChoice chosen = choose_alpha(frame, AlphaRule::rgcv);
///     const std::vector<double> tractions = family.solve(frame, chosen.alpha);
///     name(chosen.verdict);                  // "ok", or what is wrong; examples/02_alpha.cpp
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "tactile_net/inverse/filter_frame.hpp"

namespace tactile_net {

enum class AlphaRule { rgcv, gcv, discrepancy, l_curve, ncp, gml, evidence, aicc };

inline constexpr std::array alpha_rules = {
    AlphaRule::rgcv, AlphaRule::gcv, AlphaRule::discrepancy, AlphaRule::l_curve,
    AlphaRule::ncp,  AlphaRule::gml, AlphaRule::evidence,    AlphaRule::aicc};

/// True for discrepancy and evidence, which know the noise's rms instead of guessing it.
[[nodiscard]] constexpr bool needs_noise(AlphaRule rule) noexcept {
  return rule == AlphaRule::discrepancy || rule == AlphaRule::evidence;
}

/// True for ncp, which looks for white noise along a line of taxels: frames of skins have no
/// periodogram (`FilterFrame::periodogram`).
[[nodiscard]] constexpr bool needs_periodogram(AlphaRule rule) noexcept {
  return rule == AlphaRule::ncp;
}

/// The name as scenes, tables and JSON spell it: "rgcv".
[[nodiscard]] std::string_view name(AlphaRule rule) noexcept;

enum class AlphaVerdict {
  ok,
  border,          ///< the best value lies at an end of the bracket: the true one may lie beyond
  unstable,        ///< ten times alpha would change the traction by more than what would be left
  no_root,         ///< no alpha fits: no signal, or the noise stated cannot be met
  rules_disagree,  ///< the traction differs by more than half from that of the other rules' median
  noise_needed,    ///< too few readings for a rule that does not know the noise's rms
};

/// The spelling in JSON and tables: "ok", "border", "unstable", "no_root", "rules_disagree",
/// "noise_needed".
[[nodiscard]] std::string_view name(AlphaVerdict verdict) noexcept;

struct AlphaChoice {
  AlphaRule rule = AlphaRule::rgcv;
  double alpha = 0.0;  ///< [unit of (W K)^2]; for `border` and `no_root` an end of the bracket
  AlphaVerdict verdict = AlphaVerdict::ok;
};

/// All rules over one bracket.
struct AlphaSweep {
  std::vector<double> alphas{};  ///< 200, rising by equal factors
  struct Curve {
    AlphaRule rule = AlphaRule::rgcv;
    /// What the rule minimises, at each of `alphas`; of discrepancy |log ratio|.
    std::vector<double> values{};
    AlphaChoice choice{};
  };
  /// One curve per rule, in the order of `alpha_rules`. Rules that need the noise's rms or a
  /// periodogram have no curve where there is none.
  std::vector<Curve> curves{};

  /// The choice of one rule. @throw std::out_of_range  it is not among the curves
  [[nodiscard]] const AlphaChoice& choice(AlphaRule rule) const;
};

/// Sweeps from max(smallest gamma, 64 rows eps largest)^2, below which double precision resolves
/// nothing, to (largest gamma)^2. About 200 x components x rules operations, and for ncp 200 times
/// the residual's periodogram.
///
/// Where no reading depends on the tractions (every gamma is 0, or there is none) each rule has the
/// verdict `no_root` and the alpha 0.
///
/// @param noise_rms  of one weighted reading; absent: no curves of discrepancy and evidence
/// @throw std::invalid_argument  noise_rms is not >= 0; the frame has not one beta for each gamma
[[nodiscard]] AlphaSweep sweep_alpha(const FilterFrame& frame,
                                     std::optional<double> noise_rms = {});

/// One rule's choice, judged without the other rules, at the cost of one rule. The verdict is never
/// `rules_disagree`.
///
/// @throw std::invalid_argument  as `choose_alpha`
[[nodiscard]] AlphaChoice choose_alone(const FilterFrame& frame, AlphaRule rule,
                                       std::optional<double> noise_rms = {});

/// One rule's choice, judged beside the other rules, at the cost of `sweep_alpha`.
///
/// @throw std::invalid_argument  as `sweep_alpha`; the rule needs the noise's rms or a periodogram,
///                               and there is none
[[nodiscard]] AlphaChoice choose_alpha(const FilterFrame& frame, AlphaRule rule,
                                       std::optional<double> noise_rms = {});

}  // namespace tactile_net
