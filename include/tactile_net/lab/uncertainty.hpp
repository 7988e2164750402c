/// @file
/// How far one frame's tractions may be from the truth: one rule for every command.
///
///     const lab::FrameUncertainty bands = lab::uncertainty(frame, f, result);
///     std::printf("%g +- %g N/m\n", bands.resultant.normal.value,
///     bands.resultant.normal.deviation);
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tactile_net/inverse/contact_patch.hpp"
#include "tactile_net/inverse/uncertainty.hpp"
#include "tactile_net/lab/method.hpp"

namespace tactile_net::lab {

struct FrameUncertainty {
  NoiseEstimate noise{};
  UncertainResultant resultant{};
  std::optional<UncertainResultant> nearest_to_slipping{};  ///< as `tactile_net` has it
  std::vector<ContactPatch> patches{};  ///< each contact by itself, as `patches_of` finds them
  std::vector<double> deviation{};      ///< of every traction [Pa], one standard deviation
  /// Of every traction, the ends of its interval [Pa], under constraints those of what may not
  /// pull; empty: they are not known.
  std::vector<double> low{}, high{};
  bool holds_model_error = false;  ///< it counts for noise in them
  std::vector<double> offsets{};   ///< of each channel's readings; none where they are known
};

/// By `LoadWindows` where the problem has them; of line loads over taxels with what may press
/// beyond the last of them, and where the noise is not stated by the noise that gml leaves. Else by
/// a prior that is equal everywhere. Its size is the rule gml's alpha, judged without the other
/// rules (with rgcv's two deviations hold the truth 88 % of the time, with gml's 97 to 99 %); where
/// gml's verdict is not ok, the alpha of the tractions.
///
/// Under constraints these are the mean squares of the error about the constrained tractions, by
/// what the readings say without the constraints: the covariance there, and how far the two answers
/// lie apart. A posterior on the active face alone takes for certain what is held at zero, and does
/// not know that noise which cannot pull can only push: its two deviations hold the force of a
/// third to nine tenths of contacts (docs/internals/numerics.md).
///
/// Of a frame that is answered by its mixture (`SceneFrame::mixture`) all of it is the mixture's:
/// under constraints forces and centre too, and the tractions' deviations are about the constrained
/// ones. Deviations are its second moments, and intervals its quantiles.
///
/// Of an estimated tangential weight they are the mean squares over all that the readings leave
/// likely, each as likely as they make it.
///
/// @param tractions  that a solver of the frame's problem found [Pa]
/// @param result     of that solver; its method is tikhonov or closed_form
/// @pre  the problem has bands
[[nodiscard]] FrameUncertainty uncertainty(const SceneFrame& frame,
                                           std::span<const double> tractions,
                                           const FrameResult& result);

/// What a frame's mixture knows of what all tractions amount to.
struct ResultantDistributions {
  Distribution normal{};                     ///< [N/m]
  std::optional<Distribution> tangential{};  ///< [N/m]; absent with one unknown
  /// Of the force's place [m], and of tangential over normal force; absent where the normal force
  /// is less than five deviations away from 0.
  std::optional<Distribution> centre{}, slope{};
};
/// @pre  `frame.problem().answers_by_mixture()`
[[nodiscard]] ResultantDistributions resultant_distributions(const SceneFrame& frame);

/// Where the residual is larger than the noise stated explains.
/// @param held  whether the bands hold it as if it were noise
[[nodiscard]] std::optional<remark::ModelError> model_error(const NoiseEstimate& noise,
                                                            bool held) noexcept;

}  // namespace tactile_net::lab
