#include "tests/hard/reference.hpp"

#include <array>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tactile_net::hard {
namespace {

const Real pi = boost::math::constants::pi<Real>();

struct Number {  // a complex number
  Real re, im;
  friend Number operator+(const Number& a, const Number& b) { return {a.re + b.re, a.im + b.im}; }
  friend Number operator-(const Number& a, const Number& b) { return {a.re - b.re, a.im - b.im}; }
  friend Number operator*(const Number& a, const Number& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Number operator/(const Number& a, const Number& b) {
    const Real d = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / d, (a.im * b.re - a.re * b.im) / d};
  }
};
Number conjugate(const Number& a) { return {a.re, -a.im}; }

struct Stresses {
  Real x, y, shear;
};

/// Plane strain by the compliance of the solid: the stress out of plane holds the strain there.
Real reading(Quantity quantity, const Stresses& s, const Material& material) {
  const Real nu = material.poisson_ratio;
  const Real out_of_plane = nu * (s.x + s.y);
  switch (quantity) {
    case Quantity::stress_x:
      return s.x;
    case Quantity::stress_y:
      return s.y;
    case Quantity::shear_xy:
      return s.shear;
    case Quantity::strain_x:
      return (s.x - nu * (s.y + out_of_plane)) / Real(material.youngs_modulus);
    case Quantity::strain_y:
      return (s.y - nu * (s.x + out_of_plane)) / Real(material.youngs_modulus);
    default:
      throw std::invalid_argument("no quantity of a line");
  }
}

/// Kolosov and Muskhelishvili on the half plane Im z > 0, z = y + i x: Phi = A / z, and the Psi
/// that leaves the surface free, Psi = -Phi - conj(A) / z - z Phi'. Of loads spread over the
/// surface, `inverse` and `square` are the sums of 1 / z and of 1 / z^2.
Stresses half_plane(Traction load, const Real& x, const Number& inverse, const Number& square) {
  const Real half = 1 / (2 * pi);
  const Number a = load == Traction::normal ? Number{0, half} : Number{half, 0};
  const Number phi = a * inverse;
  const Number slope = Number{0, 0} - a * square;
  // (s_x - s_y) / 2 + i s_xy = conj(z) Phi' + Psi, where conj(z) - z is -2 i x for every load.
  const Number rotated = Number{0, -2 * x} * slope - phi - conjugate(a) * inverse;
  const Real mean = 2 * phi.re;
  return {mean + rotated.re, mean - rotated.re, rotated.im};
}

Stresses below_line(Traction load, const Real& x, const Real& y) {
  const Number inverse = Number{1, 0} / Number{y, x};
  return half_plane(load, x, inverse, inverse * inverse);
}

Number logarithm(const Number& z) {
  return {log(z.re * z.re + z.im * z.im) / 2, atan2(z.im, z.re)};
}

/// A hat is the second difference of a ramp, and z log z - z twice the integral of 1 / z. Of a hat
/// as narrow as 1e-12 depths that leaves 25 digits.
Stresses below_hat(Traction load, const Real& x, const Real& y, const Real& width) {
  const auto second_difference = [&](const auto& function) {
    const Number middle = function(Number{y, x});
    const Number ends = function(Number{y + width, x}) + function(Number{y - width, x});
    return (ends - middle - middle) * Number{1 / width, 0};
  };
  const Number square = second_difference([](const Number& z) { return logarithm(z); });
  return half_plane(load, x,
                    second_difference([](const Number& z) { return z * logarithm(z) - z; }),
                    Number{0, 0} - square);
}

/// Gauss with pivots; destroys its arguments.
template <std::size_t n>
std::array<Real, n> solve(std::array<std::array<Real, n>, n> m, std::array<Real, n> b) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(m[i][k]) > abs(m[pivot][k])) pivot = i;
    std::swap(m[k], m[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const Real factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < n; ++j) m[i][j] -= factor * m[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= m[k][j] * b[j];
    b[k] /= m[k][k];
  }
  return b;
}

/// One wavenumber of a layer from its boundary conditions: an Airy function
/// (A + B x) exp(-k x) + (C + D (h - x)) exp(-k (h - x)), times exp(i k y).
class AiryLayer {
 public:
  AiryLayer(const Material& material, Traction load, const Real& k, const Real& depth)
      : k_(k), h_(material.layer->thickness), normal_(load == Traction::normal) {
    const Real nu = material.poisson_ratio;
    const bool bonded = material.layer->base == Base::bonded;
    std::array<std::array<Real, 4>, 4> m;
    for (std::size_t j = 0; j < 4; ++j) {
      const auto top = derivatives(j, 0);
      const auto base = derivatives(j, h_);
      // For a normal load stress_x = -k^2 phi, shear = -i k phi'; for a tangential one phi is
      // imaginary, phi = i psi, which makes shear = k psi' real.
      m[0][j] = normal_ ? -k * k * top[0] : k * top[1];
      m[1][j] = normal_ ? top[1] : top[0];
      m[2][j] = bonded ? (1 - nu * nu) * base[2] + nu * (1 + nu) * k * k * base[0] : base[1];
      m[3][j] = 2 * (1 + nu) * k * k * base[1] -
                ((1 - nu * nu) * base[3] + nu * (1 + nu) * k * k * base[1]);
    }
    const auto c = solve<4>(m, {1, 0, 0, 0});
    std::array<Real, 3> phi{0, 0, 0};
    for (std::size_t j = 0; j < 4; ++j) {
      const auto d = derivatives(j, depth);
      for (std::size_t i = 0; i < 3; ++i) phi[i] += c[j] * d[i];
    }
    // Amplitudes; the imaginary ones over i.
    stresses_ = {-k * k * phi[0], phi[2], normal_ ? -k * phi[1] : k * phi[1]};
  }
  [[nodiscard]] const Stresses& stresses() const { return stresses_; }

 private:
  /// phi and its first three derivatives, of one of the four functions.
  [[nodiscard]] std::array<Real, 4> derivatives(std::size_t j, const Real& x) const {
    const bool rising = j >= 2;
    const Real distance = rising ? h_ - x : x;
    const Real e = exp(-k_ * distance);
    std::array<Real, 4> d;
    Real power = 1;  // (-k)^i
    for (std::size_t i = 0; i < 4; ++i) {
      d[i] = power * e;
      if (j % 2 == 1)  // distance exp(-k distance)
        d[i] = power * e * distance + (i == 0 ? Real(0) : Real(i) * power / (-k_) * e);
      if (rising && i % 2 == 1) d[i] = -d[i];
      power *= -k_;
    }
    return d;
  }
  Real k_, h_;
  bool normal_;
  Stresses stresses_;
};

/// The inverse transform by the trapezoidal rule at half steps. Its error is the kernel itself a
/// period away, exp(-0.739 * 56), and what lies beyond the last wavenumber, exp(-42): 1e-18.
Reals layer_kernel(const Channel& channel, Traction load, const Material& material,
                   std::size_t count, double pitch) {
  const Real h = material.layer->thickness;
  const Real reach = Real(count - 1) * pitch;
  const Real step = 2 * pi / (2 * reach + 56 * h);
  const Real last = 42 / Real(channel.depth);
  const bool odd = (channel.quantity == Quantity::shear_xy) == (load == Traction::normal);
  Reals right(count, 0);  // at lags 0 ... count - 1
  for (Real k = step / 2; k < last; k += step) {
    const Real amplitude =
        reading(channel.quantity, AiryLayer(material, load, k, channel.depth).stresses(), material);
    const Number turn{cos(k * pitch), sin(k * pitch)};
    Number wave{1, 0};
    for (Real& value : right) {
      value += amplitude * (odd ? -wave.im : wave.re);
      wave = wave * turn;
    }
  }
  Reals kernel(2 * count - 1);
  for (std::size_t m = 0; m < count; ++m) {
    const Real value = right[m] * step / pi * pitch;
    kernel[count - 1 + m] = value;
    kernel[count - 1 - m] = odd ? Real(-value) : value;
  }
  return kernel;
}

/// Of hats on a layer, at any distances: the same sum, each wave times the hat's own transform.
Reals layer_hats(const Site& site, Traction load, const Material& material, const Reals& distances,
                 const Real& width) {
  const Real h = material.layer->thickness;
  Real reach = 0;
  for (const Real& y : distances) reach = std::max(reach, Real(abs(y) + width));
  const Real step = 2 * pi / (2 * reach + 56 * h);
  const Real last = 42 / Real(site.depth);
  const bool odd = (site.quantity == Quantity::shear_xy) == (load == Traction::normal);
  Reals sums(distances.size(), 0);
  for (Real k = step / 2; k < last; k += step) {
    const Real sinc = sin(k * width / 2) / (k * width / 2);
    const Real amplitude =
        width * sinc * sinc *
        reading(site.quantity, AiryLayer(material, load, k, site.depth).stresses(), material);
    for (std::size_t i = 0; i < distances.size(); ++i)
      sums[i] += amplitude * (odd ? Real(-sin(k * distances[i])) : Real(cos(k * distances[i])));
  }
  for (Real& sum : sums) sum *= step / pi;
  return sums;
}

}  // namespace

RealMatrix reference_hat_matrix(const SensorArray& array, const Material& material,
                                const LineProblemOptions& options, const Surface& surface) {
  const std::vector<Site> all = sites(array);
  const std::size_t n = surface.count;
  RealMatrix matrix{all.size(), options.unknowns * n, {}};
  for (const Site& site : all)
    for (std::size_t u = 0; u < options.unknowns; ++u) {
      const Traction load = u == 0 ? Traction::normal : Traction::tangential_y;
      const Real weight =
          options.channel_rms.empty() ? Real(1) : 1 / Real(options.channel_rms[site.channel]);
      Reals distances;
      for (std::size_t j = 0; j < n; ++j)
        distances.push_back(Real(site.y) - Real(surface.position(j)));
      Reals row;
      if (material.layer)
        row = layer_hats(site, load, material, distances, surface.spacing);
      else
        for (const Real& y : distances)
          row.push_back(
              reading(site.quantity, below_hat(load, site.depth, y, surface.spacing), material));
      for (const Real& value : row) matrix.values.push_back(weight * value);
    }
  return matrix;
}

Reals reference_kernel(const Channel& channel, Traction load, const Material& material,
                       std::size_t count, double pitch) {
  if (material.layer) return layer_kernel(channel, load, material, count, pitch);
  Reals kernel;
  for (std::size_t i = 0; i < 2 * count - 1; ++i) {
    const Real y = (Real(i) - Real(count - 1)) * pitch;
    kernel.push_back(reading(channel.quantity, below_line(load, channel.depth, y), material) *
                     pitch);
  }
  return kernel;
}

RealMatrix reference_matrix(const SensorArray& array, const Material& material,
                            const LineProblemOptions& options, bool circular) {
  const std::size_t n = array.count;
  const std::vector<Channel> all = channels(array);
  RealMatrix matrix{all.size() * n, options.unknowns * n, {}};
  matrix.values.assign(matrix.rows * matrix.columns, 0);
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t u = 0; u < options.unknowns; ++u) {
      const Reals kernel = reference_kernel(
          all[c], u == 0 ? Traction::normal : Traction::tangential_y, material, n, array.pitch);
      for (std::size_t i = 0; i < n; ++i) {
        Real weight = options.channel_rms.empty() ? Real(1) : 1 / Real(options.channel_rms[c]);
        for (const std::size_t dead : options.dead_taxels)
          if (dead == i) weight = 0;
        for (std::size_t j = 0; j < n; ++j) {
          Real value = kernel[i + n - 1 - j];
          if (circular) {
            const std::size_t lag = (i + n - j) % n;
            const Real& forward = kernel[n - 1 + lag];
            const Real& backward = kernel[lag == 0 ? n - 1 : lag - 1];
            value = 2 * lag < n ? forward : 2 * lag > n ? backward : (forward + backward) / 2;
          }
          matrix(c * n + i, u * n + j) = weight * value;
        }
      }
    }
  return matrix;
}

namespace {

/// alpha (1 + ratio^2 Q) f, block by block.
Reals smoothed(const Reals& f, double alpha, double ratio, std::size_t count, bool circular) {
  const Real coupling = Real(ratio) * ratio;
  Reals out = f;
  for (std::size_t start = 0; start < f.size(); start += count)
    for (std::size_t i = 0; i < count; ++i) {
      if (!circular && i + 1 == count) continue;
      const std::size_t a = start + i;
      const std::size_t b = start + (i + 1) % count;
      const Real difference = coupling * (f[b] - f[a]);
      out[a] -= difference;
      out[b] += difference;
    }
  for (Real& value : out) value *= alpha;
  return out;
}

Reals transposed_times(const RealMatrix& kernel, const Reals& x) {
  Reals out(kernel.columns, 0);
  for (std::size_t i = 0; i < kernel.rows; ++i)
    for (std::size_t j = 0; j < kernel.columns; ++j) out[j] += kernel(i, j) * x[i];
  return out;
}

}  // namespace

Reals solved(RealMatrix p, Reals f) {
  const std::size_t n = p.columns;
  for (std::size_t k = 0; k < n; ++k) {
    if (!(p(k, k) > 0)) throw std::domain_error("P is singular in 50 digits");
    for (std::size_t i = k + 1; i < n; ++i) {
      const Real factor = p(k, i) / p(k, k);
      for (std::size_t j = i; j < n; ++j) p(i, j) -= factor * p(k, j);
      f[i] -= factor * f[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) f[k] -= p(k, j) * f[j];
    f[k] /= p(k, k);
  }
  return f;
}

Reals reference_minimiser(const RealMatrix& kernel, const Reals& right, double alpha, double ratio,
                          std::size_t count, bool circular) {
  const std::size_t n = kernel.columns;
  RealMatrix p{n, n, Reals(n * n, 0)};
  for (std::size_t j = 0; j < n; ++j) {
    Reals unit(n, 0);
    unit[j] = 1;
    const Reals column = smoothed(unit, alpha, ratio, count, circular);
    for (std::size_t i = 0; i <= j; ++i) {
      p(i, j) = column[i];
      for (std::size_t r = 0; r < kernel.rows; ++r) p(i, j) += kernel(r, i) * kernel(r, j);
    }
  }
  return solved(std::move(p), transposed_times(kernel, right));
}

Reals reference_hat_minimiser(const RealMatrix& kernel, const Reals& right, double alpha,
                              const LinearProblem& problem) {
  const std::size_t n = kernel.columns;
  const Real weight = Real(alpha) * problem.measure;
  const Real ratio = Real(problem.smoothing_length) / problem.grid.spacing_y;
  const Real coupling = weight * ratio * ratio;
  RealMatrix p{n, n, Reals(n * n, 0)};
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i <= j; ++i)
      for (std::size_t r = 0; r < kernel.rows; ++r) p(i, j) += kernel(r, i) * kernel(r, j);
    p(j, j) += weight + 2 * coupling;  // the outermost hats fall to 0 too
    if (j % problem.grid.rows != 0) p(j - 1, j) -= coupling;
  }
  return solved(std::move(p), transposed_times(kernel, right));
}

Reals reference_gradient(const RealMatrix& kernel, const Reals& right, double alpha, double ratio,
                         std::size_t count, const Reals& f) {
  Reals residual(kernel.rows, 0);
  for (std::size_t i = 0; i < kernel.rows; ++i) {
    residual[i] = -right[i];
    for (std::size_t j = 0; j < kernel.columns; ++j) residual[i] += kernel(i, j) * f[j];
  }
  Reals gradient = transposed_times(kernel, residual);
  const Reals more = smoothed(f, alpha, ratio, count, false);
  for (std::size_t j = 0; j < gradient.size(); ++j) gradient[j] += more[j];
  return gradient;
}

Real norm(std::span<const Real> x) {
  Real sum = 0;
  for (const Real& value : x) sum += value * value;
  return sqrt(sum);
}

double relative_error(std::span<const double> x, std::span<const Real> reference) {
  Reals difference;
  for (std::size_t i = 0; i < x.size(); ++i) difference.push_back(Real(x[i]) - reference[i]);
  const Real size = norm(reference);
  if (size == 0) return norm(difference) == 0 ? 0.0 : std::numeric_limits<double>::infinity();
  return static_cast<double>(norm(difference) / size);
}

}  // namespace tactile_net::hard
