/// @file
/// The DFT approach with a known coefficient of friction (thesis 3.2; target
/// tactile_net::spectral). One of the thesis' own methods, kept to be compared with: `tikhonov`
/// (inverse/reconstruction.hpp) solves for both tractions of any contacts.
///
/// One quantity at one depth, and one contact that is symmetric about the array's middle and slides
/// as a whole. Its tangential traction is taken for constant over the contact, with the resultant
/// that Coulomb's law gives (thesis 3.9, 3.13):
///
///     f_t = c on w taxels around the middle, c = mu / w sum f_v, sum f_v = sum g / sum K1
///
/// so that G = g - c K2 * box holds the normal traction alone (3.14), and f_v = IDFT(DFT(G) /
/// DFT(K1)). A tangential traction adds to g only what is antisymmetric, a normal one only what is
/// symmetric (3.16): the width w is the one whose c K2 * box comes nearest to the antisymmetric
/// part of g. The thesis takes it from the support of the symmetric part's f_v instead, which
/// noise, once amplified by the division, hides.
///
/// The verdict is drawn from the readings, and from f_v blurred to the depth, so that white noise
/// does not decide it. What the pad blurs away it cannot tell: two contacts less than about three
/// depths apart are answered as one, and a drag that follows f_v, on a contact no wider than the
/// depth, as its mean.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "tactile_net/elasticity/material.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/realtime/frame_status.hpp"
#include "tactile_net/sensing/array.hpp"

namespace tactile_net {

enum class FrictionVerdict {
  ok,
  dft,              ///< see `DftInverse::verdict`: noise_amplified, sign_change or cut_off
  not_one_contact,  ///< the readings are not those of one contact in the middle that drags with mu:
                    ///< their antisymmetric part is more than a tenth off, the normal traction has
                    ///< a gap in the middle, or a tenth of the force lies beside the contact
  drag_in_noise,    ///< nothing contradicts it, but noise could hide a tenth of the drag's readings
                    ///< or make the normal force a tenth wrong
  no_contact,       ///< the normal force is not > 0
};

/// The spelling in JSON and tables: "ok", "not_one_contact", "no_contact"; for `dft` see there.
[[nodiscard]] std::string_view name(FrictionVerdict verdict) noexcept;

/// The answer to one frame. Unless the status is `ok`, no other member is set.
struct FrictionSolution {
  FrameStatus status = FrameStatus::ok;
  std::vector<double> normal{};      ///< f_v [Pa], one per taxel
  std::vector<double> tangential{};  ///< c on the contact, 0 elsewhere [Pa]
  std::size_t width = 0;             ///< w, taxels in contact: even or odd like the array's count
  FrictionVerdict verdict = FrictionVerdict::ok;
  DftVerdict dft = DftVerdict::ok;  ///< verdict on the division by K1's DFT
};

class DftFriction {
 public:
  /// @param friction    mu, finite; negative drags along -y
  /// @param gain_limit  as in `DftInverse`
  /// @throw as `DftInverse`; std::invalid_argument if friction is not finite
  DftFriction(const SensorArray& array, const Material& material, double friction,
              double gain_limit = 1e8);

  /// One frame: O(count^2). Uses buffers of its own: one object per thread.
  /// `too_large` if any traction would not be finite, or a square on the way to it.
  [[nodiscard]] FrictionSolution solve(std::span<const double> readings);

  [[nodiscard]] const DftInverse& division() const noexcept { return division_; }

 private:
  /// A box of tangential traction, and what it adds to the readings.
  struct Drag {
    std::size_t width = 0;
    std::vector<double> readings{};
  };
  [[nodiscard]] Drag likeliest(std::span<const double> odd, std::span<const double> normal,
                               double force) const;
  [[nodiscard]] FrictionVerdict judge(std::span<const double> even, std::span<const double> rest,
                                      std::span<const double> normal, const Drag& drag) const;

  DftInverse division_;
  double friction_;
  double depth_;                // in pitches
  std::vector<double> kernel_;  // K2 D, as `sampled_kernel`: a drag does not wrap around the ring
};

}  // namespace tactile_net
