// By FFTW.
#include <fftw3.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>

#include "numeric/fft_members.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

/// FFTW's planner is not thread-safe, its execution is: held while plans are made and destroyed.
std::recursive_mutex planner;

struct Destroy {
  void operator()(fftw_plan plan) const noexcept {
    const std::lock_guard lock(planner);
    fftw_destroy_plan(plan);
  }
};
using Plan = std::shared_ptr<std::remove_pointer_t<fftw_plan>>;

fftw_complex* of_fftw(Complex* values) noexcept { return reinterpret_cast<fftw_complex*>(values); }

// From one array to another: in place took twice as long for 256 complex values.
fftw_plan planned(int size, double* from, Complex* to, int /*sign*/, unsigned rigour) {
  return fftw_plan_dft_r2c_1d(size, from, of_fftw(to), rigour);
}
fftw_plan planned(int size, Complex* from, double* to, int /*sign*/, unsigned rigour) {
  return fftw_plan_dft_c2r_1d(size, of_fftw(from), to, rigour);
}
fftw_plan planned(int size, Complex* from, Complex* to, int sign, unsigned rigour) {
  return fftw_plan_dft_1d(size, of_fftw(from), of_fftw(to), sign, rigour);
}

void execute(const Plan& plan, double* from, Complex* to) noexcept {
  fftw_execute_dft_r2c(plan.get(), from, of_fftw(to));
}
void execute(const Plan& plan, Complex* from, double* to) noexcept {
  fftw_execute_dft_c2r(plan.get(), of_fftw(from), to);
}
void execute(const Plan& plan, Complex* from, Complex* to) noexcept {
  fftw_execute_dft(plan.get(), of_fftw(from), of_fftw(to));
}

}  // namespace

FftLibrary fft_library() noexcept { return FftLibrary::fftw; }

/// Copies share the plans.
template <class Sample>
struct Fft<Sample>::Transform {
  Transform(std::span<Sample> samples, std::span<Complex> bins, FftEffort effort) {
    const std::lock_guard lock(planner);
    // FFTW_ESTIMATE never times anything: equal sizes get equal plans.
    const unsigned rigour = effort == FftEffort::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
    const int size = static_cast<int>(samples.size());
    to_bins.reset(planned(size, samples.data(), bins.data(), FFTW_FORWARD, rigour), Destroy{});
    to_samples.reset(planned(size, bins.data(), samples.data(), FFTW_BACKWARD, rigour), Destroy{});
    if (!to_bins || !to_samples) throw std::bad_alloc();
  }

  void forward(std::span<Sample> samples, std::span<Complex> bins) const noexcept {
    execute(to_bins, samples.data(), bins.data());
  }
  void backward(std::span<Complex> bins, std::span<Sample> samples) const noexcept {
    execute(to_samples, bins.data(), samples.data());
  }

  Plan to_bins, to_samples;
};

template <class Sample>
double Fft<Sample>::error(std::size_t size) noexcept {
  return std::log2(static_cast<double>(size) + 2.0) * std::numeric_limits<double>::epsilon();
}

template class Fft<double>;
template class Fft<std::complex<double>>;

}  // namespace tactile_net
