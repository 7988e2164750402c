/// @file
/// What the frames of a large skin share: products, probes, tiles, bands. Private.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lab/large_contacts.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/skin/large/cone.hpp"
#include "tactile_net/skin/large/covariance.hpp"
#include "tactile_net/skin/large/family.hpp"
#include "tactile_net/skin/large/tikhonov.hpp"

namespace tactile_net::lab {

/// Each part is made when it is first asked for. Not thread-safe.
class LargeSkin {
 public:
  /// @param constrained  whether frames will be solved under constraints
  /// @throw std::invalid_argument  as `make_large_skin_system`; it would take more memory than
  ///                               `available` [bytes]
  LargeSkin(const SkinArray& skin, const Material& material, SkinProblemOptions options,
            DataLimits limits, double available, bool constrained = false);

  /// The same without these taxels: transformed kernels and the smaller skin of the bands are
  /// taken over, and where they are few the probes.
  ///
  /// @param dead  all of them, those that `whole` is without among them
  LargeSkin(LargeSkin& whole, const std::vector<std::size_t>& dead);

  /// Without its kernel.
  [[nodiscard]] const LinearProblem& problem() const noexcept { return problem_of(*system_); }
  [[nodiscard]] const LargeSkinFamily& family();
  /// tr H of the tractions that the face leaves free, by one probe of random signs: of a large
  /// skin's many readings one is enough.
  [[nodiscard]] double degrees_of_freedom(const ActiveFace& face, double alpha) const;
  /// With this alpha.
  [[nodiscard]] LargeSkinTikhonov& solver(double alpha);
  /// @throw FrameOverflow          the tractions overflow a double
  /// @throw std::invalid_argument  readings have the wrong size or are not finite
  [[nodiscard]] std::vector<double> solve(std::span<const double> readings, double alpha);
  [[nodiscard]] ConeSolution solve_in_cones(std::span<const double> readings, double alpha,
                                            const Constraints& constraints);
  /// Refers to this object, until its alpha is another one.
  [[nodiscard]] std::unique_ptr<const LargeSkinCovariance> covariance(double alpha,
                                                                      double prior_alpha);
  /// The contacts of an answer, each with what its readings tell of it.
  [[nodiscard]] LargeContacts contacts(const std::vector<std::vector<std::size_t>>& apart) const;
  /// Those of a part, less what tractions beyond it explain.
  [[nodiscard]] std::vector<double> readings_of(const LargeSkinPart& part,
                                                std::span<const double> readings,
                                                std::span<const double> tractions);
  /// |W (K f - g)|
  [[nodiscard]] double residual(std::span<const double> readings,
                                std::span<const double> tractions);
  /// As `DataJudge`, of contacts on the tractions' own cells; where no contact explains a frame
  /// only the taxel that fits worst is tried.
  [[nodiscard]] DataVerdict judge(std::span<const double> readings,
                                  std::span<const double> tractions);

 private:
  SkinArray skin_;
  Material material_;
  SkinProblemOptions options_;
  DataLimits limits_;
  std::shared_ptr<LargeSkinSystem> system_;
  std::optional<LargeSkinFamily> family_{};
  std::unique_ptr<LargeSkinTikhonov> solver_{};
  std::shared_ptr<LargeSkinBands> bands_{};
  std::shared_ptr<const LargeSkinBands> like_{};  // of the whole that this one was made of
};

}  // namespace tactile_net::lab
