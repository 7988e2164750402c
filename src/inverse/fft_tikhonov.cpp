#include "tactile_net/inverse/fft_tikhonov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "inverse/checks.hpp"
#include "inverse/line_stabiliser.hpp"
#include "numeric/conjugate_gradients.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"
#include "numeric/real_fft.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;
using Spectrum = std::vector<Complex>;

}  // namespace

struct FftTikhonov::Plan {
  Plan(const Surface& surface_, std::size_t taxels_, std::size_t channels_, std::size_t unknowns_)
      : surface(surface_),
        count(surface_.count),
        taxels(taxels_),
        channels(channels_),
        unknowns(unknowns_),
        padded(RealFft::fast_size(2 * surface_.count - 1)),
        circle(surface_.count),
        input(unknowns_, Spectrum(padded.bins().size())),
        output(std::max(unknowns_, channels_), Spectrum(padded.bins().size())),
        circular(unknowns_, Spectrum(circle.bins().size())) {
    const std::size_t n = unknowns * count;
    const std::size_t m = channels * taxels;
    right.resize(m);
    residual.resize(m + 2 * n);
    image.resize(m + 2 * n);
    f.resize(n);
    gradient.resize(n);
    preconditioned.resize(n);
    direction.resize(n);
  }

  /// Of a value's own size in sqrt(alpha) L, where hats at the ends have a slope of their own.
  [[nodiscard]] double size_of(std::size_t unknown, std::size_t i) const noexcept {
    const bool ends = i == 0 || i + 1 == count;
    return stabiliser_weight(unknown, tangential_weight) *
           (ends && surface.basis == SurfaceBasis::hats ? end_size : size);
  }
  [[nodiscard]] double slope_of(std::size_t unknown) const noexcept {
    return stabiliser_weight(unknown, tangential_weight) * slope;
  }

  /// [W K; sqrt(alpha) L] x.
  void apply(std::span<const double> x, std::span<double> y) noexcept {
    for (std::size_t u = 0; u < unknowns; ++u) to_spectrum(x.subspan(u * count, count), input[u]);
    for (std::size_t c = 0; c < channels; ++c) {
      std::fill(padded.bins().begin(), padded.bins().end(), Complex{});
      for (std::size_t u = 0; u < unknowns; ++u) {
        const Spectrum& kernel = kernels[c * unknowns + u];
        for (std::size_t k = 0; k < kernel.size(); ++k)
          padded.bins()[k] += product(kernel[k], input[u][k]);
      }
      padded.backward();
      for (std::size_t j = 0; j < taxels; ++j)
        y[c * taxels + j] =
            weights[c * taxels + j] * padded.samples()[surface.margin + j * surface.stride];
    }
    auto* slope_out = y.data() + channels * taxels;
    auto* size_out = slope_out + unknowns * count;
    for (std::size_t u = 0; u < unknowns; ++u)
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = u * count + i;
        slope_out[at] = i + 1 < count ? slope_of(u) * (x[at + 1] - x[at]) : 0.0;
        size_out[at] = size_of(u, i) * x[at];
      }
  }

  /// Its transpose.
  void apply_transposed(std::span<const double> y, std::span<double> x) noexcept {
    for (std::size_t c = 0; c < channels; ++c) {
      std::fill(padded.samples().begin(), padded.samples().end(), 0.0);
      for (std::size_t j = 0; j < taxels; ++j)
        padded.samples()[surface.margin + j * surface.stride] =
            weights[c * taxels + j] * y[c * taxels + j];
      padded.forward();
      std::copy(padded.bins().begin(), padded.bins().end(), output[c].begin());
    }
    const double* slope_in = y.data() + channels * taxels;
    const double* size_in = slope_in + unknowns * count;
    for (std::size_t u = 0; u < unknowns; ++u) {
      std::fill(padded.bins().begin(), padded.bins().end(), Complex{});
      for (std::size_t c = 0; c < channels; ++c) {
        const Spectrum& kernel = kernels[c * unknowns + u];
        for (std::size_t k = 0; k < kernel.size(); ++k)
          padded.bins()[k] += conjugate_product(kernel[k], output[c][k]);
      }
      padded.backward();
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = u * count + i;
        x[at] =
            padded.samples()[i] + size_of(u, i) * size_in[at] +
            slope_of(u) * ((i > 0 ? slope_in[at - 1] : 0.0) - (i + 1 < count ? slope_in[at] : 0.0));
      }
    }
  }

  /// z = (circular P)^-1 x.
  void precondition(std::span<const double> x, std::span<double> z) noexcept {
    const auto scale = 1.0 / static_cast<double>(count);
    for (std::size_t u = 0; u < unknowns; ++u) {
      std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(u * count), count,
                  circle.samples().begin());
      circle.forward();
      std::copy(circle.bins().begin(), circle.bins().end(), circular[u].begin());
    }
    for (std::size_t u = 0; u < unknowns; ++u) {
      for (std::size_t k = 0; k < circle.bins().size(); ++k) {
        Complex sum{};
        for (std::size_t v = 0; v < unknowns; ++v)
          sum += product(inverse[(u * unknowns + v) * circle.bins().size() + k], circular[v][k]);
        circle.bins()[k] = scale * sum;
      }
      circle.backward();
      std::copy_n(circle.samples().begin(), count,
                  z.begin() + static_cast<std::ptrdiff_t>(u * count));
    }
  }

  /// Conjugate gradients from x, whose gradient is in `gradient`; `image` is the direction's.
  double iterate(std::span<double> x, std::size_t step_limit, auto&& follow, auto&& done) {
    return conjugate_gradients(
        {x, gradient, preconditioned, direction}, step_limit,
        [&] {
          apply(direction, image);
          return dot_in_order(image, image);
        },
        follow, [&](std::span<const double> from, std::span<double> to) { precondition(from, to); },
        dot_in_order, done);
  }

  void to_spectrum(std::span<const double> x, Spectrum& spectrum) noexcept {
    std::copy(x.begin(), x.end(), padded.samples().begin());
    std::fill(padded.samples().begin() + static_cast<std::ptrdiff_t>(count), padded.samples().end(),
              0.0);
    padded.forward();
    std::copy(padded.bins().begin(), padded.bins().end(), spectrum.begin());
  }

  Surface surface;
  std::size_t count, taxels, channels, unknowns;  // count: of the surface's values
  RealFft padded;  // for Toeplitz blocks: nothing that wraps around is read
  RealFft circle;  // for the preconditioner
  double alpha = 0.0;
  double measure = 1.0;   // h / D
  double size = 0.0;      // sqrt(alpha h / D)
  double slope = 0.0;     // that times l / h
  double end_size = 0.0;  // of both together
  double ratio = 0.0;     // l / h
  double tangential_weight = 1.0;
  std::vector<double> weights;
  std::vector<Spectrum> kernels;  // channels x unknowns, over the padded size
  /// A frequency's A'A of the circular kernels, a Hermitian matrix of unknowns x unknowns.
  struct Gram {
    double first = 0.0, last = 0.0;  // the diagonal
    Complex mixed{};                 // row 1, column 0
  };
  std::vector<Gram> grams;
  Spectrum inverse;  // unknowns x unknowns x frequencies
  std::vector<Spectrum> input, output, circular;
  std::vector<double> right, residual, image, f, gradient, preconditioned, direction;
  Convergence convergence;
};

FftTikhonov::~FftTikhonov() = default;
FftTikhonov::FftTikhonov(FftTikhonov&&) noexcept = default;
FftTikhonov& FftTikhonov::operator=(FftTikhonov&&) noexcept = default;

FftTikhonov::FftTikhonov(const SensorArray& array, const Material& material,
                         const LineProblemOptions& options, double alpha) {
  check(array, material, options);
  require_even(array, "conjugate gradients by FFT");
  require_known_offsets(options.unknown_offsets, "conjugate gradients by FFT");
  const Surface surface = surface_of(array, options.surface);
  const std::size_t n = surface.count;
  const std::vector<Channel> all = channels(array);
  plan_ = std::make_unique<Plan>(surface, array.count, all.size(), options.unknowns);
  Plan& plan = *plan_;
  plan.measure = measure_of(array, surface);
  plan.ratio = options.smoothing_length / surface.spacing;
  plan.tangential_weight = options.tangential_weight;

  std::vector<double> channel_weights(all.size(), 1.0);
  for (std::size_t c = 0; c < options.channel_rms.size(); ++c)
    channel_weights[c] = 1.0 / options.channel_rms[c];
  for (std::size_t c = 0; c < all.size(); ++c) {
    plan.weights.insert(plan.weights.end(), array.count, channel_weights[c]);
    for (const std::size_t taxel : options.dead_taxels) plan.weights[c * array.count + taxel] = 0.0;
  }

  // The circular stand-in: the Toeplitz blocks' lags, those beyond half the surface wrapped
  // (Strang), as if there were a taxel at every value and each counted for a part.
  const double thinned = std::sqrt(plan.measure);
  const std::size_t bins = plan.circle.bins().size();
  const auto u_count = static_cast<Eigen::Index>(plan.unknowns);
  std::vector<Eigen::MatrixXcd> a(
      bins, Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(all.size()), u_count));
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t u = 0; u < plan.unknowns; ++u) {
      const std::vector<double> kernel =
          surface_kernel(all[c], line_tractions[u], material, surface).lags;
      transform_kernel(plan.padded, kernel);
      Spectrum spectrum(plan.padded.bins().begin(), plan.padded.bins().end());
      for (Complex& bin : spectrum) bin /= static_cast<double>(plan.padded.size());
      plan.kernels.push_back(std::move(spectrum));

      for (std::size_t i = 0; i < n; ++i)
        plan.circle.samples()[i] = 2 * i <= n ? kernel[i + n - 1] : kernel[i - 1];
      plan.circle.forward();
      for (std::size_t k = 0; k < bins; ++k)
        a[k](static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(u)) =
            thinned * channel_weights[c] * plan.circle.bins()[k];
    }

  for (const Eigen::MatrixXcd& one : a) {
    const Eigen::MatrixXcd gram = one.adjoint() * one;
    plan.grams.push_back(
        {gram(0, 0).real(), gram(u_count - 1, u_count - 1).real(), gram(u_count - 1, 0)});
  }
  plan.inverse.resize(plan.unknowns * plan.unknowns * bins);
  use_alpha(alpha);
}

void FftTikhonov::use_alpha(double alpha) {
  check_alpha(alpha);
  Plan& plan = *plan_;
  plan.alpha = alpha;
  plan.size = std::sqrt(alpha * plan.measure);
  plan.slope = plan.size * plan.ratio;
  plan.end_size = std::hypot(plan.size, plan.slope);
  const std::size_t bins = plan.circle.bins().size();
  for (std::size_t k = 0; k < bins; ++k) {
    const double wave =
        2.0 * plan.ratio *
        std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(plan.count));
    const double shift = alpha * plan.measure * (1.0 + wave * wave);
    const Plan::Gram& gram = plan.grams[k];
    if (plan.unknowns == 1) {
      plan.inverse[k] = 1.0 / (gram.first + shift);
      continue;
    }
    // Scaled to a unit diagonal, so that the determinant of a large kernel stays in range.
    const double a = gram.first + shift;
    const double d = gram.last + shift * plan.tangential_weight * plan.tangential_weight;
    const double root = std::sqrt(a) * std::sqrt(d);
    const Complex b = gram.mixed / root;  // of row 1, column 0
    const double determinant = std::max(1.0 - std::norm(b), std::numeric_limits<double>::epsilon());
    plan.inverse[k] = 1.0 / a / determinant;
    plan.inverse[3 * bins + k] = 1.0 / d / determinant;
    plan.inverse[2 * bins + k] = -b / root / determinant;
    plan.inverse[bins + k] = std::conj(plan.inverse[2 * bins + k]);
  }
}

FrameStatus FftTikhonov::solve(std::span<const double> readings, std::span<double> tractions,
                               double tolerance, std::size_t step_limit) noexcept {
  Plan& p = *plan_;
  if (readings.size() != p.right.size() || tractions.size() != p.f.size())
    return FrameStatus::wrong_size;
  if (!all_finite(readings)) return FrameStatus::not_finite;

  p.convergence = {};
  double scale = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    p.right[i] = p.weights[i] * readings[i];
    scale = std::max(scale, std::abs(p.right[i]));
  }
  if (!std::isfinite(scale)) return FrameStatus::too_large;
  if (scale == 0.0) {
    std::fill(tractions.begin(), tractions.end(), 0.0);
    return FrameStatus::ok;
  }
  std::fill(p.residual.begin(), p.residual.end(), 0.0);
  for (std::size_t i = 0; i < readings.size(); ++i) p.residual[i] = p.right[i] / scale;
  std::fill(p.f.begin(), p.f.end(), 0.0);

  p.apply_transposed(p.residual, p.gradient);
  // What the last steps took off the error in the norm of P: a step later than that, the error was
  // about as large (Hestenes and Stiefel 1952, 6). P >= alpha h / D, times the lighter traction's
  // weight squared, turns it into the 2-norm.
  const double lighter = std::min(1.0, stabiliser_weight(p.unknowns - 1, p.tangential_weight));
  const double least = p.alpha * p.measure * lighter * lighter;
  std::array<double, 4> gains{};
  Convergence& c = p.convergence;
  c.converged = false;
  c.steps = 0;
  const double power = p.iterate(
      p.f, step_limit,
      [&](double step) {
        add_multiple(p.residual, -step, p.image);
        p.apply_transposed(p.residual, p.gradient);
      },
      [&](std::size_t steps, double gain) {
        c.steps = steps;
        const double size = std::sqrt(dot_in_order(p.f, p.f));
        gains[steps % gains.size()] = gain;
        double gained = 0.0;
        for (const double one : gains) gained += one;
        c.estimate = std::sqrt(gained / least) / size;
        c.bound = std::sqrt(dot_in_order(p.gradient, p.gradient)) / (least * size);
        c.converged = c.bound <= tolerance || (steps >= gains.size() && c.estimate <= tolerance);
        return c.converged;
      });
  if (power == 0.0) c.converged = true;
  for (double& traction : p.f) traction *= scale;
  if (!all_finite(p.f)) return FrameStatus::too_large;
  std::copy(p.f.begin(), p.f.end(), tractions.begin());
  return FrameStatus::ok;
}

std::vector<double> FftTikhonov::solve_normal(std::span<const double> right) {
  Plan& p = *plan_;
  std::vector<double> x(right.size());
  std::copy(right.begin(), right.end(), p.gradient.begin());
  const double enough = 1e-20 * dot_in_order(right, right);
  const auto is_small = [&] { return !(dot_in_order(p.gradient, p.gradient) > enough); };
  if (is_small()) return x;
  p.iterate(
      x, 1000,
      [&](double step) {
        p.apply_transposed(p.image, p.preconditioned);  // P times the direction
        add_multiple(p.gradient, -step, p.preconditioned);
      },
      [&](std::size_t, double) { return is_small(); });
  return x;
}

std::vector<double> FftTikhonov::stacked_product(std::span<const double> tractions) {
  std::vector<double> product(plan_->image.size());
  plan_->apply(tractions, product);
  return product;
}

double FftTikhonov::residual(std::span<const double> readings, std::span<const double> tractions) {
  check_size(readings, plan_->weights.size());
  check_tractions(tractions, plan_->f.size());
  const std::vector<double> product = stacked_product(tractions);
  double size = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i)
    size = std::hypot(size, product[i] - plan_->weights[i] * readings[i]);
  return size;
}

const Convergence& FftTikhonov::convergence() const noexcept { return plan_->convergence; }
std::size_t FftTikhonov::readings() const noexcept { return plan_->right.size(); }
std::size_t FftTikhonov::tractions() const noexcept { return plan_->f.size(); }

}  // namespace tactile_net
