#include "tactile_net/inverse/dft.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "inverse/finite.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net {
namespace {

constexpr double accepted_gain = 1e4;

struct Release {
  void operator()(fftw_plan_s* plan) const noexcept { fftw_destroy_plan(plan); }
  void operator()(void* memory) const noexcept { fftw_free(memory); }
};

}  // namespace

std::string_view name(DftVerdict verdict) noexcept {
  switch (verdict) {
    case DftVerdict::ok:
      return "ok";
    case DftVerdict::noise_amplified:
      return "noise_amplified";
    case DftVerdict::sign_change:
      return "sign_change";
    case DftVerdict::cut_off:
      return "cut_off";
  }
  return "";
}

struct DftInverse::Plan {
  explicit Plan(std::size_t count)
      : samples(count),
        bins(count / 2 + 1),
        real(fftw_alloc_real(count)),
        spectrum(reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(bins))),
        forward(fftw_plan_dft_r2c_1d(static_cast<int>(count), real.get(), fftw_spectrum(),
                                     FFTW_ESTIMATE)),
        backward(fftw_plan_dft_c2r_1d(static_cast<int>(count), fftw_spectrum(), real.get(),
                                      FFTW_ESTIMATE)),
        inverse(bins) {
    if (!real || !spectrum || !forward || !backward)
      throw std::runtime_error("FFTW made no plan for " + std::to_string(count) + " points");
  }
  [[nodiscard]] fftw_complex* fftw_spectrum() const noexcept {
    return reinterpret_cast<fftw_complex*>(spectrum.get());
  }

  std::size_t samples;
  std::size_t bins;
  std::unique_ptr<double, Release> real;
  std::unique_ptr<std::complex<double>, Release> spectrum;
  std::unique_ptr<fftw_plan_s, Release> forward;
  std::unique_ptr<fftw_plan_s, Release> backward;
  std::vector<std::complex<double>> inverse;  // 1 / (count * DFT of the kernel)
  NoiseGain gain;
};

DftInverse::~DftInverse() = default;
DftInverse::DftInverse(DftInverse&&) noexcept = default;
DftInverse& DftInverse::operator=(DftInverse&&) noexcept = default;

DftInverse::DftInverse(const SensorArray& array, const Material& material, double gain_limit) {
  check(array);
  check(material);
  if (!(gain_limit >= 1.0)) throw std::invalid_argument("the noise gain's limit must be >= 1");
  if (array.reads.size() * array.depths.size() != 1)
    throw std::invalid_argument("dft solves for one quantity at one depth, not for several");

  const std::size_t n = array.count;
  plan_ = std::make_unique<Plan>(n);
  const PadKernel response(array.reads[0], Traction::normal, material, array.depths[0]);
  double* const kernel = plan_->real.get();
  for (std::size_t i = 0; i < n; ++i) {  // offsets 0, 1, ..., -2, -1 around the circle
    const double offset = i <= n / 2 ? static_cast<double>(i) : -static_cast<double>(n - i);
    kernel[i] = array.pitch * response(offset * array.pitch);
  }
  fftw_execute(plan_->forward.get());

  const std::span spectrum(plan_->spectrum.get(), plan_->bins);
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

  if (gain.largest > gain_limit) {
    std::ostringstream text;
    text << "dft would multiply errors of the readings by up to " << gain.largest << " (limit "
         << gain_limit << "): ";
    if (gain.frequency == 0)
      text << "the mean of the traction is invisible to " << name(array.reads[0]);
    else
      text << "a ripple of wavelength "
           << static_cast<double>(n) * array.pitch / static_cast<double>(gain.frequency)
           << " (frequency " << gain.frequency << " of " << n / 2 << ") is lost at depth "
           << array.depths[0];
    if (gain.sign_changes > 0)
      text << "; the kernel's DFT changes sign at " << gain.sign_changes << " of " << plan_->bins
           << " frequencies";
    throw std::domain_error(text.str());
  }
  std::transform(spectrum.begin(), spectrum.end(), plan_->inverse.begin(),
                 [n](auto value) { return 1.0 / (static_cast<double>(n) * value); });
}

Status DftInverse::solve(std::span<const double> readings, std::span<double> tractions) noexcept {
  if (readings.size() != plan_->samples || tractions.size() != plan_->samples)
    return Status::wrong_size;
  if (!all_finite(readings)) return Status::not_finite;

  std::copy(readings.begin(), readings.end(), plan_->real.get());
  fftw_execute(plan_->forward.get());
  for (std::size_t k = 0; k < plan_->bins; ++k) plan_->spectrum.get()[k] *= plan_->inverse[k];
  fftw_execute(plan_->backward.get());
  std::copy_n(plan_->real.get(), tractions.size(), tractions.begin());
  return Status::ok;
}

const NoiseGain& DftInverse::noise_gain() const noexcept { return plan_->gain; }

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
