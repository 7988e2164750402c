#include "tactile_net/inverse/thesis/dft.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "inverse/rounding.hpp"
#include "numeric/finite.hpp"
#include "numeric/named.hpp"
#include "numeric/real_fft.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/aperture.hpp"

namespace tactile_net {
namespace {

constexpr double accepted_gain = 1e4;

constexpr Named<DftVerdict> dft_verdicts[] = {{DftVerdict::ok, "ok"},
                                              {DftVerdict::noise_amplified, "noise_amplified"},
                                              {DftVerdict::sign_change, "sign_change"},
                                              {DftVerdict::cut_off, "cut_off"}};

std::string refusal(const SensorArray& array, const NoiseGain& gain, double limit) {
  const auto number = [](double value) { return brief(value, 6); };
  const std::size_t half = array.count / 2;
  std::string text = "dft would multiply errors of the readings by up to " + number(gain.largest) +
                     " (limit " + number(limit) + "): ";
  if (gain.frequency == 0)
    text += "the mean of the traction is invisible to " + std::string(name(array.reads[0]));
  else
    text += "a ripple of wavelength " +
            number(static_cast<double>(array.count) * array.pitch /
                   static_cast<double>(gain.frequency)) +
            " (frequency " + std::to_string(gain.frequency) + " of " + std::to_string(half) +
            ") is lost at depth " + number(array.depths[0]);
  if (gain.sign_changes > 0)
    text += "; the kernel's DFT changes sign at " + std::to_string(gain.sign_changes) + " of " +
            std::to_string(half + 1) + " frequencies";
  return text;
}

}  // namespace

std::string_view name(DftVerdict verdict) noexcept { return name_in<dft_verdicts>(verdict); }

struct DftInverse::Plan {
  explicit Plan(std::size_t count) : fft(count), inverse(fft.bins().size()) {}

  RealFft fft;
  std::vector<std::complex<double>> inverse;  // 1 / (count * DFT of the kernel)
  NoiseGain gain;
  double kernel_error = 0.0;  // of the kernel's DFT, over its largest entry
};

DftInverse::~DftInverse() = default;
DftInverse::DftInverse(DftInverse&&) noexcept = default;
DftInverse& DftInverse::operator=(DftInverse&&) noexcept = default;

DftInverse::DftInverse(const SensorArray& array, const Material& material, double gain_limit) {
  check(array);
  require_even(array, "dft");
  check(material);
  if (!(gain_limit >= 1.0)) throw std::invalid_argument("the noise gain's limit must be >= 1");
  if (channel_count(array) != 1)
    throw std::invalid_argument("dft solves for one quantity at one depth, not for several");

  const std::size_t n = array.count;
  plan_ = std::make_unique<Plan>(n);
  const PadKernel response(array.reads[0], Traction::normal, material, array.depths[0]);
  const Aperture aperture(array.width, array.depths[0]);
  const auto kernel = plan_->fft.samples();
  for (std::size_t i = 0; i < n; ++i) {  // offsets 0, 1, ..., -2, -1 around the circle
    const double offset = i <= n / 2 ? static_cast<double>(i) : -static_cast<double>(n - i);
    kernel[i] = array.pitch * aperture.mean(response, offset * array.pitch);
  }
  plan_->fft.forward();

  const auto spectrum = plan_->fft.bins();
  const auto smaller = [](auto a, auto b) { return std::abs(a) < std::abs(b); };
  const auto least = std::min_element(spectrum.begin(), spectrum.end(), smaller);
  const auto most = std::max_element(spectrum.begin(), spectrum.end(), smaller);
  NoiseGain& gain = plan_->gain;
  gain.largest = std::abs(*least) == 0.0 ? std::numeric_limits<double>::infinity()
                                         : std::abs(*most) / std::abs(*least);
  gain.frequency = static_cast<std::size_t>(least - spectrum.begin());
  gain.sign_changes =
      static_cast<std::size_t>(std::count_if(spectrum.begin(), spectrum.end(), [&](auto value) {
        return std::real(value * std::conj(*most)) < 0.0;
      }));

  double sum = 0.0;
  for (const double value : plan_->fft.samples()) sum += std::abs(value);
  plan_->kernel_error = relative_kernel_error(material) * sum / std::abs(*most);

  if (gain.largest > gain_limit) throw std::domain_error(refusal(array, gain, gain_limit));
  std::transform(spectrum.begin(), spectrum.end(), plan_->inverse.begin(),
                 [n](auto value) { return 1.0 / (static_cast<double>(n) * value); });
}

FrameStatus DftInverse::solve(std::span<const double> readings,
                              std::span<double> tractions) noexcept {
  RealFft& fft = plan_->fft;
  if (readings.size() != fft.size() || tractions.size() != fft.size())
    return FrameStatus::wrong_size;
  if (!all_finite(readings)) return FrameStatus::not_finite;

  std::copy(readings.begin(), readings.end(), fft.samples().begin());
  fft.forward();
  for (std::size_t k = 0; k < plan_->inverse.size(); ++k)
    fft.bins()[k] = product(fft.bins()[k], plan_->inverse[k]);
  fft.backward();
  if (!all_finite(fft.samples())) return FrameStatus::too_large;
  std::copy_n(fft.samples().begin(), tractions.size(), tractions.begin());
  return FrameStatus::ok;
}

const NoiseGain& DftInverse::noise_gain() const noexcept { return plan_->gain; }

double DftInverse::forward_bound(std::span<const double> readings) const noexcept {
  double peak = 0.0;
  for (const double reading : readings) peak = std::max(peak, std::abs(reading));
  if (peak == 0.0) return 0.0;
  return plan_->gain.largest * (plan_->kernel_error + 3.0 * RealFft::error(plan_->fft.size()) +
                                underflow_error(2 * readings.size(), peak));
}

DftVerdict DftInverse::verdict() const noexcept {
  if (plan_->gain.sign_changes > 0) return DftVerdict::sign_change;
  return plan_->gain.largest > accepted_gain ? DftVerdict::noise_amplified : DftVerdict::ok;
}

DftVerdict DftInverse::verdict(std::span<const double> readings) const noexcept {
  if (verdict() != DftVerdict::ok || readings.empty()) return verdict();
  double peak = 0.0;
  for (const double reading : readings) peak = std::max(peak, std::abs(reading));
  const double ends = std::max(std::abs(readings.front()), std::abs(readings.back()));
  return ends * plan_->gain.largest > peak ? DftVerdict::cut_off : DftVerdict::ok;
}

}  // namespace tactile_net
