#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "inverse/checks.hpp"
#include "inverse/line_stabiliser.hpp"
#include "inverse/rounding.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/finite.hpp"
#include "numeric/real_fft.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/sensing/surface_kernel.hpp"

namespace tactile_net {
namespace {

constexpr double negligible = 1e-13;

/// The circular kernel's spectrum: lags -count/2 ... count/2; for even counts the farthest lag is
/// both, and its mean is taken.
void transform_circular(RealFft& fft, std::span<const double> kernel) {
  const std::size_t n = fft.size();
  const auto at = [&](std::ptrdiff_t lag) {
    return kernel[static_cast<std::size_t>(lag + static_cast<std::ptrdiff_t>(n) - 1)];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const auto lag = static_cast<std::ptrdiff_t>(i);
    const auto back = lag - static_cast<std::ptrdiff_t>(n);
    fft.samples()[i] = 2 * i < n ? at(lag) : 2 * i > n ? at(back) : 0.5 * (at(lag) + at(back));
  }
  fft.forward();
}

/// Readings under way in the Fourier basis: bin by bin.
class BinnedPeriodogram final : public ResidualPeriodogram {
 public:
  BinnedPeriodogram(std::vector<std::size_t> bin_of, std::vector<double> outside)
      : bin_of_(std::move(bin_of)), outside_(std::move(outside)) {}

  [[nodiscard]] std::size_t size() const noexcept override { return outside_.size(); }

  void power(std::span<const double> left, std::span<const double> change, std::span<double> values,
             std::span<double> slopes) const override {
    std::copy(outside_.begin(), outside_.end(), values.begin());
    std::fill(slopes.begin(), slopes.end(), 0.0);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (bin_of_[i] == 0) continue;  // the mean
      values[bin_of_[i] - 1] += left[i] * left[i];
      slopes[bin_of_[i] - 1] += 2.0 * left[i] * change[i];
    }
  }

 private:
  std::vector<std::size_t> bin_of_;  // frequency of each component
  std::vector<double> outside_;      // power at frequencies 1, 2, ...
};

}  // namespace

struct DftTikhonov::Plan {
  /// A / sqrt(l) = U S V' at one frequency, A's columns over the weights of the tractions.
  struct Frequency {
    Eigen::MatrixXcd u, v;
    Eigen::VectorXd s;
    double root = 1.0;      // of l = 1 + 4 l^2/D^2 sin^2
    double multiple = 1.0;  // how many of the DFT's frequencies look alike: k and count - k
  };

  explicit Plan(std::size_t count) : fft(count) {}

  /// The readings' spectrum at every frequency, channel by channel.
  void transform(std::span<const double> readings) {
    const std::size_t n = fft.size();
    for (std::size_t c = 0; c < weights.size(); ++c) {
      for (std::size_t i = 0; i < n; ++i) fft.samples()[i] = weights[c] * readings[c * n + i];
      fft.forward();
      for (std::size_t k = 0; k < frequencies.size(); ++k)
        spectrum(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) = fft.bins()[k];
    }
  }

  RealFft fft;
  std::size_t unknowns = 1;
  double tangential_weight = 1.0;
  std::vector<double> weights;  // of each channel
  std::vector<Frequency> frequencies;
  std::vector<DftNullMode> null_modes;
  double largest = 0.0;
  double kernel_error = 0.0;  // of the matrices' entries
  Eigen::MatrixXcd spectrum;  // channels x frequencies
  Eigen::MatrixXcd solution;  // unknowns x frequencies
  std::vector<double> tractions;
};

DftTikhonov::~DftTikhonov() = default;
DftTikhonov::DftTikhonov(DftTikhonov&&) noexcept = default;
DftTikhonov& DftTikhonov::operator=(DftTikhonov&&) noexcept = default;

DftTikhonov::DftTikhonov(const SensorArray& array, const Material& material,
                         const LineProblemOptions& options) {
  check(array, material, options);
  require_even(array, "the Fourier basis");
  if (!options.dead_taxels.empty())
    throw std::invalid_argument("dft takes a dead taxel's zero for a reading: use tikhonov");
  require_at_taxels(options.surface);
  require_known_offsets(options.unknown_offsets, "dft");

  const std::size_t n = array.count;
  const std::vector<Channel> all = channels(array);
  plan_ = std::make_unique<Plan>(n);
  Plan& plan = *plan_;
  plan.unknowns = options.unknowns;
  plan.tangential_weight = options.tangential_weight;
  plan.weights.assign(all.size(), 1.0);
  for (std::size_t c = 0; c < options.channel_rms.size(); ++c)
    plan.weights[c] = 1.0 / options.channel_rms[c];

  const std::size_t bins = n / 2 + 1;
  const auto rows = static_cast<Eigen::Index>(all.size());
  const auto columns = static_cast<Eigen::Index>(plan.unknowns);
  std::vector<Eigen::MatrixXcd> a(bins, Eigen::MatrixXcd::Zero(rows, columns));
  for (std::size_t c = 0; c < all.size(); ++c)
    for (std::size_t u = 0; u < plan.unknowns; ++u) {
      const Traction component = line_tractions[u];
      const SurfaceKernel kernel = surface_kernel(all[c], component, material, surface_of(array));
      plan.kernel_error = std::hypot(plan.kernel_error, plan.weights[c] * kernel.error);
      transform_circular(plan.fft, kernel.lags);
      const bool odd = is_odd(all[c].quantity, component);
      for (std::size_t k = 0; k < bins; ++k) {
        // Rounding must not give an odd kernel a mean, nor an even one a phase.
        const std::complex<double> value =
            plan.weights[c] * (odd ? std::complex<double>(0.0, plan.fft.bins()[k].imag())
                                   : std::complex<double>(plan.fft.bins()[k].real(), 0.0));
        a[k](static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(u)) =
            value / stabiliser_weight(u, options.tangential_weight);
      }
    }

  const double ratio = options.smoothing_length / array.pitch;
  for (std::size_t k = 0; k < bins; ++k) {
    const double wave =
        2.0 * ratio * std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
    Plan::Frequency frequency;
    frequency.root = std::hypot(1.0, wave);
    frequency.multiple = k == 0 || 2 * k == n ? 1.0 : 2.0;
    ComplexSvd svd = singular_value_decomposition(Eigen::MatrixXcd(a[k] / frequency.root));
    frequency.u = std::move(svd.u);
    frequency.v = std::move(svd.v);
    frequency.s = std::move(svd.values);
    plan.largest = std::max(plan.largest, frequency.s(0));
    plan.frequencies.push_back(std::move(frequency));
  }
  for (std::size_t k = 0; k < bins; ++k) {
    Plan::Frequency& frequency = plan.frequencies[k];
    for (Eigen::Index j = 0; j < frequency.s.size(); ++j) {
      if (frequency.s(j) > negligible * plan.largest) continue;
      frequency.s(j) = 0.0;
      const bool tangential =
          columns == 2 && std::abs(frequency.v(1, j)) > std::abs(frequency.v(0, j));
      DftNullMode mode{.frequency = k,
                       .unknown = tangential ? Traction::tangential_y : Traction::normal,
                       .alternating = 2 * k == n};
      if (k > 0) mode.wavelength = static_cast<double>(n) * array.pitch / static_cast<double>(k);
      plan.null_modes.push_back(mode);
    }
  }
  plan.spectrum.resize(rows, static_cast<Eigen::Index>(bins));
  plan.solution.resize(columns, static_cast<Eigen::Index>(bins));
  plan.tractions.resize(plan.unknowns * n);
}

std::span<const DftNullMode> DftTikhonov::null_modes() const noexcept { return plan_->null_modes; }

double DftTikhonov::condition(double alpha) const noexcept {
  const double root = std::sqrt(alpha);
  double smallest = plan_->largest;
  for (const Plan::Frequency& frequency : plan_->frequencies)
    for (const double s : frequency.s)
      if (s > 0.0) smallest = std::min(smallest, s);
  return std::hypot(plan_->largest, root) / std::hypot(smallest, root);
}

double DftTikhonov::forward_bound(std::span<const double> readings, double alpha,
                                  std::span<const double> tractions) {
  const FilterFrame frame = analyse(readings);
  if (frame.scale == 0.0) return 0.0;
  double right = frame.outside * frame.outside;
  double residual = right;  // of the stacked system: the functional's least value
  for (std::size_t i = 0; i < frame.beta.size(); ++i) {
    const double power = frame.beta[i] * frame.beta[i];
    right += power;
    const double square = frame.gamma[i] * frame.gamma[i];
    if (square > 0.0 || alpha > 0.0) residual += alpha / (square + alpha) * power;
  }
  double solution = 0.0;
  double weighted = 0.0;  // as the stacked system has them
  for (std::size_t i = 0; i < tractions.size(); ++i) {
    const double f = tractions[i] / frame.scale;
    const double weight = stabiliser_weight(i / plan_->fft.size(), plan_->tangential_weight);
    solution += f * f;
    weighted += weight * f * (weight * f);
  }
  const double lighter =
      std::min(1.0, stabiliser_weight(plan_->unknowns - 1, plan_->tangential_weight));
  const double of_tractions = solution > 0.0 ? std::sqrt(weighted / solution) / lighter : 1.0;
  const double underflow = underflow_error(readings.size() + tractions.size(), frame.scale);
  const double lost = solution > 0.0 ? underflow / std::sqrt(solution) : 0.0;
  return of_tractions * wedin_bound(condition(alpha), std::hypot(plan_->largest, std::sqrt(alpha)),
                                    std::sqrt(right), std::sqrt(residual), std::sqrt(weighted),
                                    plan_->kernel_error / lighter / plan_->largest +
                                        3.0 * RealFft::error(plan_->fft.size()) + underflow) +
         lost;
}

bool DftTikhonov::cut_off(std::span<const double> readings, double alpha) const noexcept {
  const std::size_t n = plan_->fft.size();
  const std::size_t end = std::max<std::size_t>(n / 40, 1);
  const double gain = condition(alpha);
  for (std::size_t c = 0; (c + 1) * n <= readings.size(); ++c) {
    const auto channel = readings.subspan(c * n, n);
    double peak = 0.0;
    for (const double reading : channel) peak = std::max(peak, std::abs(reading));
    double first = 0.0;
    double last = 0.0;
    for (std::size_t i = 0; i < end; ++i) {
      first += channel[i] / static_cast<double>(end);
      last += channel[n - 1 - i] / static_cast<double>(end);
    }
    if (std::max(std::abs(first), std::abs(last)) * gain > peak) return true;
  }
  return false;
}

FilterFrame DftTikhonov::analyse(std::span<const double> readings) {
  Plan& plan = *plan_;
  const std::size_t n = plan.fft.size();
  check_readings(readings, plan.weights.size() * n);

  FilterFrame frame;
  frame.rows = readings.size();
  for (std::size_t i = 0; i < readings.size(); ++i)
    frame.scale = std::max(frame.scale, std::abs(plan.weights[i / n] * readings[i]));
  const double unit = frame.scale > 0.0 ? frame.scale : 1.0;

  std::vector<double> scaled(readings.begin(), readings.end());
  for (double& reading : scaled) reading /= unit;
  plan.transform(scaled);
  const double parseval = std::sqrt(1.0 / static_cast<double>(n));
  std::vector<std::size_t> bin_of;
  std::vector<double> outside(n / 2, 0.0);
  for (std::size_t k = 0; k < plan.frequencies.size(); ++k) {
    const Plan::Frequency& frequency = plan.frequencies[k];
    const Eigen::VectorXcd g = parseval * plan.spectrum.col(static_cast<Eigen::Index>(k));
    const Eigen::VectorXcd beta = frequency.u.adjoint() * g;
    const double rest = frequency.multiple * (g - frequency.u * beta).squaredNorm();
    frame.outside += rest;
    if (k > 0) outside[k - 1] += rest;
    for (Eigen::Index j = 0; j < beta.size(); ++j)
      for (int copy = 0; copy < static_cast<int>(frequency.multiple); ++copy) {
        frame.gamma.push_back(frequency.s(j));
        frame.beta.push_back(std::abs(beta(j)));
        bin_of.push_back(k);
      }
  }
  frame.outside = std::sqrt(frame.outside);
  frame.periodogram = std::make_shared<BinnedPeriodogram>(std::move(bin_of), std::move(outside));
  return frame;
}

FrameStatus DftTikhonov::solve(std::span<const double> readings, double alpha,
                               std::span<double> tractions) noexcept {
  Plan& plan = *plan_;
  const std::size_t n = plan.fft.size();
  if (readings.size() != plan.weights.size() * n || tractions.size() != plan.unknowns * n)
    return FrameStatus::wrong_size;
  if (!all_finite(readings)) return FrameStatus::not_finite;

  plan.transform(readings);
  const double root = std::sqrt(alpha);
  for (std::size_t k = 0; k < plan.frequencies.size(); ++k) {
    const Plan::Frequency& frequency = plan.frequencies[k];
    const auto at = static_cast<Eigen::Index>(k);
    plan.solution.col(at).setZero();
    for (Eigen::Index j = 0; j < frequency.s.size(); ++j) {
      if (frequency.s(j) == 0.0) continue;
      const double size = std::hypot(frequency.s(j), root);
      const double inverse = frequency.s(j) / size / size / frequency.root;
      plan.solution.col(at) +=
          frequency.v.col(j) * (inverse * frequency.u.col(j).dot(plan.spectrum.col(at)));
    }
  }
  for (std::size_t u = 0; u < plan.unknowns; ++u) {
    for (std::size_t k = 0; k < plan.frequencies.size(); ++k)
      plan.fft.bins()[k] =
          plan.solution(static_cast<Eigen::Index>(u), static_cast<Eigen::Index>(k)) /
          static_cast<double>(n) / stabiliser_weight(u, plan.tangential_weight);
    plan.fft.backward();
    std::copy_n(plan.fft.samples().begin(), n,
                plan.tractions.begin() + static_cast<std::ptrdiff_t>(u * n));
  }
  if (!all_finite(plan.tractions)) return FrameStatus::too_large;
  std::copy(plan.tractions.begin(), plan.tractions.end(), tractions.begin());
  return FrameStatus::ok;
}

}  // namespace tactile_net
