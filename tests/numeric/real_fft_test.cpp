// The laws of the transforms, by the FFT that is linked: the build's own, and Eigen's beside FFTW.
#include "src/numeric/real_fft.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/catch.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t sizes[] = {1,   2,   3,   4,   5,   6,   7,   8,   9,   10,  11,  12,   14,
                                 15,  16,  18,  20,  21,  25,  30,  41,  49,  60,  64,  81,   97,
                                 100, 128, 162, 180, 194, 210, 243, 256, 350, 401, 640, 1000, 1024};

using Complex = std::complex<double>;
using Exact = std::complex<long double>;

/// Real ones, or complex.
template <class Number>
std::vector<Number> random_values(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  const auto next = [&] { return static_cast<double>(generator()) / 0x1p31 - 1.0; };
  std::vector<Number> values(size);
  for (Number& value : values) {
    value = next();
    if constexpr (std::is_same_v<Number, Complex>) value += Complex(0.0, next());
  }
  return values;
}

/// exp(sign 2 pi i k j / n), its angle reduced before it is rounded.
std::complex<long double> root(std::size_t k, std::size_t j, std::size_t n, int sign) {
  const long double angle = 2.0L * std::numbers::pi_v<long double> *
                            static_cast<long double>(k * j % n) / static_cast<long double>(n);
  return {std::cos(angle), static_cast<long double>(sign) * std::sin(angle)};
}

/// sum_j values_j exp(sign 2 pi i j k / n) for each k.
std::vector<Exact> sums(const std::vector<Complex>& values, int sign) {
  const std::size_t n = values.size();
  std::vector<Exact> all(n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j) all[k] += Exact(values[j]) * root(k, j, n, sign);
  return all;
}

/// Of the first sums, in the 2-norm.
double relative_error(const auto& found, const std::vector<Exact>& exact) {
  long double wrong = 0.0L;
  long double power = 0.0L;
  for (std::size_t k = 0; k < found.size(); ++k) {
    wrong += std::norm(Exact(found[k]) - exact[k]);
    power += std::norm(exact[k]);
  }
  return static_cast<double>(std::sqrt(wrong / power));
}

void law_of_each_size(const auto& law) {
  for (const std::size_t n : sizes) {
    CAPTURE(n, name(fft_library()));
    law(n);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("a transform is the sum that it stands for", "[real_fft]", double, Complex) {
  using Sample = TestType;
  law_of_each_size([](std::size_t n) {
    Fft<Sample> fft(n);
    const std::vector<Sample> values = random_values<Sample>(n, 1);
    std::copy(values.begin(), values.end(), fft.samples().begin());
    fft.forward();
    REQUIRE(fft.bins().size() == (std::is_same_v<Sample, double> ? n / 2 + 1 : n));
    const double error = relative_error(fft.bins(), sums({values.begin(), values.end()}, -1));
    CHECK(error < 5e-15);  // so any two differ by less than 1e-14
    CHECK(error < Fft<Sample>::error(n));
    CHECK(std::equal(values.begin(), values.end(), fft.samples().begin()));
  });
}

TEMPLATE_TEST_CASE("the way back multiplies by the size", "[real_fft]", double, Complex) {
  using Sample = TestType;
  law_of_each_size([](std::size_t n) {
    Fft<Sample> fft(n);
    const std::vector<Complex> bins = random_values<Complex>(fft.bins().size(), 2);
    std::copy(bins.begin(), bins.end(), fft.bins().begin());
    fft.backward();
    std::vector<Complex> all = bins;
    if constexpr (std::is_same_v<Sample, double>) {
      all.resize(n);
      for (std::size_t k = 1; 2 * k < n; ++k) all[n - k] = std::conj(bins[k]);
      // What is imaginary of the first and the last has no say.
      all[0] = bins[0].real();
      if (n % 2 == 0) all[n / 2] = bins[n / 2].real();
    }
    CHECK(relative_error(fft.samples(), sums(all, 1)) < 5e-15);
  });
}

TEMPLATE_TEST_CASE("a copy begins with zeros and gives the same bits, both ways", "[real_fft]",
                   double, Complex) {
  using Sample = TestType;
  for (const std::size_t n : {41U, 96U, 97U}) {
    Fft<Sample> fft(n);
    const std::vector<Sample> values = random_values<Sample>(n, 3);
    std::copy(values.begin(), values.end(), fft.samples().begin());
    Fft<Sample> copy = fft;
    for (const Sample sample : copy.samples()) REQUIRE(sample == 0.0);
    for (const Complex bin : copy.bins()) REQUIRE(bin == 0.0);
    std::copy(values.begin(), values.end(), copy.samples().begin());
    fft.forward();
    copy.forward();
    CHECK(std::equal(fft.bins().begin(), fft.bins().end(), copy.bins().begin()));
    fft.backward();
    copy.backward();
    CHECK(std::equal(fft.samples().begin(), fft.samples().end(), copy.samples().begin()));
    const Fft<Sample> moved = std::move(copy);
    CHECK(moved.size() == n);
  }
}

TEST_CASE("a transform of no samples is refused", "[real_fft]") {
  CHECK_THROWS_AS(RealFft(0), std::bad_alloc);
  CHECK_THROWS_AS(ComplexFft(0), std::bad_alloc);
}

}  // namespace tactile_net
