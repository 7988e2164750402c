#include "tactile_net/elasticity/space/skin_transform.hpp"

#include <cmath>

#include "elasticity/space/plane_wave.hpp"
#include "elasticity/space/read.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

/// The field of a wave in the skin's frame: vectors and tensors turned from (e_L, e_T) to (e_y,
/// e_z).
class TurnedWave {
 public:
  TurnedWave(const PlaneWave& wave, Traction load, double nu, double cosine, double sine)
      : c_(cosine), s_(sine) {
    const Complex odd{0.0, -1.0};
    const bool is_normal = load == Traction::normal;
    const double along = load == Traction::tangential_y ? c_ : s_;    // q_L
    const double across = load == Traction::tangential_y ? -s_ : c_;  // q_T
    const SagittalAmplitudes& f = is_normal ? wave.normal : wave.tangential;
    const Complex even_part = is_normal ? Complex(1.0) : odd * along;
    const Complex odd_part = is_normal ? odd : Complex(along);
    x_ = even_part * f.stress_x;
    in_plane_L_ = even_part * f.stress_along;
    in_plane_T_ = nu * (x_ + in_plane_L_);
    shear_L_ = odd_part * f.shear;
    u_x_ = even_part * f.displacement_x;
    u_L_ = odd_part * f.displacement_along;
    if (is_normal) return;
    shear_T_ = across * wave.across.shear;
    in_plane_LT_ = odd * across * wave.across.shear_along;
    u_T_ = across * wave.across.displacement;
  }

  [[nodiscard]] Complex stress(Axis a, Axis b) const noexcept {
    if (a == Axis::x && b == Axis::x) return x_;
    if (a == Axis::x) return turned(b, shear_L_, shear_T_);
    if (a != b) return c_ * s_ * (in_plane_L_ - in_plane_T_) + (c_ * c_ - s_ * s_) * in_plane_LT_;
    const double sign = a == Axis::y ? 1.0 : -1.0;
    const double l = a == Axis::y ? c_ * c_ : s_ * s_;
    return l * in_plane_L_ + (1.0 - l) * in_plane_T_ - sign * 2.0 * c_ * s_ * in_plane_LT_;
  }
  [[nodiscard]] Complex displacement(Axis a) const noexcept {
    return a == Axis::x ? u_x_ : turned(a, u_L_, u_T_);
  }

 private:
  [[nodiscard]] Complex turned(Axis a, const Complex& l, const Complex& t) const noexcept {
    return a == Axis::y ? c_ * l - s_ * t : s_ * l + c_ * t;
  }

  double c_, s_;
  Complex x_{}, in_plane_L_{}, in_plane_T_{}, in_plane_LT_{}, shear_L_{}, shear_T_{}, u_x_{},
      u_L_{}, u_T_{};
};

/// The mean of those fields over all directions: what remains has no direction.
struct MeanWave {
  const PlaneWave& wave;
  Traction load;
  double nu;

  [[nodiscard]] Complex stress(Axis a, Axis b) const noexcept {
    if (load == Traction::normal) {
      if (a != b) return 0.0;
      if (a == Axis::x) return wave.normal.stress_x;
      return 0.5 * ((1.0 + nu) * wave.normal.stress_along + nu * wave.normal.stress_x);
    }
    return a == Axis::x && b == axis(load) ? 0.5 * (wave.tangential.shear + wave.across.shear)
                                           : 0.0;
  }
  [[nodiscard]] Complex displacement(Axis a) const noexcept {
    if (a != axis(load)) return 0.0;
    return a == Axis::x ? wave.normal.displacement_x
                        : 0.5 * (wave.tangential.displacement_along + wave.across.displacement);
  }
};

}  // namespace

std::complex<double> skin_transform(Quantity quantity, Traction component, const Material& material,
                                    double depth, double wavenumber_y,
                                    double wavenumber_z) noexcept {
  const double k = std::hypot(wavenumber_y, wavenumber_z);
  if (std::isinf(k)) return 0.0;  // it has no direction, and dies at the surface
  const PlaneWave wave = plane_wave(material, depth, k);
  const double nu = material.poisson_ratio;
  if (k == 0.0) return read(quantity, MeanWave{wave, component, nu}, material);
  const TurnedWave field(wave, component, nu, wavenumber_y / k, wavenumber_z / k);
  return read(quantity, field, material);
}

}  // namespace tactile_net
