// By FFTW.
#include <fftw3.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <type_traits>

#include "numeric/real_fft.hpp"

namespace tactile_net {
namespace {

/// FFTW's planner is not thread-safe, its execution is: held while plans are made and destroyed.
std::recursive_mutex planner;

struct Free {
  void operator()(void* memory) const noexcept { fftw_free(memory); }
};
struct Destroy {
  void operator()(fftw_plan plan) const noexcept {
    const std::lock_guard lock(planner);
    fftw_destroy_plan(plan);
  }
};
using Plan = std::shared_ptr<std::remove_pointer_t<fftw_plan>>;

template <class Number>
std::unique_ptr<Number[], Free> allocate(std::size_t count) {
  void* memory = fftw_malloc(count * sizeof(Number));
  if (memory == nullptr) throw std::bad_alloc();
  const auto first = static_cast<Number*>(memory);
  std::uninitialized_value_construct_n(first, count);
  return std::unique_ptr<Number[], Free>(first);
}

}  // namespace

FftLibrary fft_library() noexcept { return FftLibrary::fftw; }

/// Copies share the plans.
struct RealFft::Transform {
  explicit Transform(std::size_t count)
      : size(count),
        samples(allocate<double>(count)),
        bins(allocate<std::complex<double>>(count / 2 + 1)) {}

  [[nodiscard]] fftw_complex* complex_bins() const noexcept {
    return reinterpret_cast<fftw_complex*>(bins.get());
  }

  std::size_t size;
  std::unique_ptr<double[], Free> samples;
  std::unique_ptr<std::complex<double>[], Free> bins;
  Plan forward, backward;
};

RealFft::RealFft(std::unique_ptr<Transform> transform)
    : transform_(std::move(transform)),
      samples_(transform_->samples.get(), transform_->size),
      bins_(transform_->bins.get(), transform_->size / 2 + 1) {}

RealFft::RealFft(std::size_t size, FftEffort effort) : RealFft(std::make_unique<Transform>(size)) {
  const std::lock_guard lock(planner);
  // FFTW_ESTIMATE never times anything: equal sizes get equal plans.
  const unsigned rigour = effort == FftEffort::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
  const int n = static_cast<int>(size);
  Transform& own = *transform_;
  own.forward.reset(fftw_plan_dft_r2c_1d(n, own.samples.get(), own.complex_bins(), rigour),
                    Destroy{});
  own.backward.reset(fftw_plan_dft_c2r_1d(n, own.complex_bins(), own.samples.get(), rigour),
                     Destroy{});
  if (!own.forward || !own.backward) throw std::bad_alloc();
  // A planner that measures writes there.
  std::fill(samples_.begin(), samples_.end(), 0.0);
  std::fill(bins_.begin(), bins_.end(), 0.0);
}

RealFft::RealFft(const RealFft& other) : RealFft(std::make_unique<Transform>(other.size())) {
  transform_->forward = other.transform_->forward;
  transform_->backward = other.transform_->backward;
}

RealFft::RealFft(RealFft&&) noexcept = default;
RealFft& RealFft::operator=(RealFft&&) noexcept = default;
RealFft::~RealFft() = default;

void RealFft::forward() noexcept {
  fftw_execute_dft_r2c(transform_->forward.get(), transform_->samples.get(),
                       transform_->complex_bins());
}

void RealFft::backward() noexcept {
  fftw_execute_dft_c2r(transform_->backward.get(), transform_->complex_bins(),
                       transform_->samples.get());
}

/// Copies share the plans. From one array to another: in place took twice as long for 256 values.
struct ComplexFft::Transform {
  explicit Transform(std::size_t count)
      : size(count),
        samples(allocate<std::complex<double>>(count)),
        bins(allocate<std::complex<double>>(count)) {}

  [[nodiscard]] fftw_complex* complex_samples() const noexcept {
    return reinterpret_cast<fftw_complex*>(samples.get());
  }
  [[nodiscard]] fftw_complex* complex_bins() const noexcept {
    return reinterpret_cast<fftw_complex*>(bins.get());
  }

  std::size_t size;
  std::unique_ptr<std::complex<double>[], Free> samples, bins;
  Plan forward, backward;
};

ComplexFft::ComplexFft(std::unique_ptr<Transform> transform)
    : transform_(std::move(transform)),
      samples_(transform_->samples.get(), transform_->size),
      bins_(transform_->bins.get(), transform_->size) {}

ComplexFft::ComplexFft(std::size_t size) : ComplexFft(std::make_unique<Transform>(size)) {
  const std::lock_guard lock(planner);
  Transform& own = *transform_;
  const auto plan = [&](fftw_complex* from, fftw_complex* to, int sign) {
    fftw_plan made = fftw_plan_dft_1d(static_cast<int>(size), from, to, sign, FFTW_ESTIMATE);
    if (made == nullptr) throw std::bad_alloc();
    return Plan(made, Destroy{});
  };
  own.forward = plan(own.complex_samples(), own.complex_bins(), FFTW_FORWARD);
  own.backward = plan(own.complex_bins(), own.complex_samples(), FFTW_BACKWARD);
}

ComplexFft::ComplexFft(const ComplexFft& other)
    : ComplexFft(std::make_unique<Transform>(other.transform_->size)) {
  transform_->forward = other.transform_->forward;
  transform_->backward = other.transform_->backward;
}

ComplexFft::ComplexFft(ComplexFft&&) noexcept = default;
ComplexFft& ComplexFft::operator=(ComplexFft&&) noexcept = default;
ComplexFft::~ComplexFft() = default;

void ComplexFft::forward() noexcept {
  fftw_execute_dft(transform_->forward.get(), transform_->complex_samples(),
                   transform_->complex_bins());
}

void ComplexFft::backward() noexcept {
  fftw_execute_dft(transform_->backward.get(), transform_->complex_bins(),
                   transform_->complex_samples());
}

double RealFft::error(std::size_t size) noexcept {
  return std::log2(static_cast<double>(size) + 2.0) * std::numeric_limits<double>::epsilon();
}

}  // namespace tactile_net
