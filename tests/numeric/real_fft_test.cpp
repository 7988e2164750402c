// The transforms by the FFT that is linked: the build's own, and Eigen's beside FFTW.
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

std::vector<double> random_values(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> values(size);
  for (double& value : values) value = static_cast<double>(generator()) / 0x1p31 - 1.0;
  return values;
}

/// exp(sign 2 pi i k j / n), its angle reduced before it is rounded.
std::complex<long double> root(std::size_t k, std::size_t j, std::size_t n, int sign) {
  const long double angle = 2.0L * std::numbers::pi_v<long double> *
                            static_cast<long double>(k * j % n) / static_cast<long double>(n);
  return {std::cos(angle), static_cast<long double>(sign) * std::sin(angle)};
}

std::size_t tested() {
  return sizes[static_cast<std::size_t>(GENERATE(range(0, static_cast<int>(std::size(sizes)))))];
}

}  // namespace

TEST_CASE("a transform is the sum that it stands for", "[real_fft]") {
  const std::size_t n = tested();
  CAPTURE(n, name(fft_library()));
  RealFft fft(n);
  const std::vector<double> values = random_values(n, 1);
  std::copy(values.begin(), values.end(), fft.samples().begin());
  fft.forward();
  REQUIRE(fft.bins().size() == n / 2 + 1);
  long double wrong = 0.0L;
  long double power = 0.0L;
  for (std::size_t k = 0; k <= n / 2; ++k) {
    std::complex<long double> sum{};
    for (std::size_t j = 0; j < n; ++j)
      sum += static_cast<long double>(values[j]) * root(k, j, n, -1);
    wrong += std::norm(std::complex<long double>(fft.bins()[k]) - sum);
    power += std::norm(sum);
  }
  const double error = static_cast<double>(std::sqrt(wrong / power));
  CHECK(error < 5e-15);  // so any two differ by less than 1e-14
  CHECK(error < RealFft::error(n));
  CHECK(std::equal(values.begin(), values.end(), fft.samples().begin()));
}

TEST_CASE("the way back multiplies by the size", "[real_fft]") {
  const std::size_t n = tested();
  CAPTURE(n, name(fft_library()));
  RealFft fft(n);
  const std::vector<double> parts = random_values(2 * (n / 2 + 1), 2);
  const auto bin = [&](std::size_t k) { return std::complex(parts[2 * k], parts[2 * k + 1]); };
  for (std::size_t k = 0; k <= n / 2; ++k) fft.bins()[k] = bin(k);
  fft.backward();
  long double wrong = 0.0L;
  long double power = 0.0L;
  for (std::size_t j = 0; j < n; ++j) {
    long double sum = bin(0).real();  // what is imaginary of the first and the last has no say
    for (std::size_t k = 1; k <= n / 2; ++k) {
      const bool last = 2 * k == n;
      sum += (last ? 1.0L : 2.0L) *
             (std::complex<long double>(last ? bin(k).real() : bin(k)) * root(k, j, n, 1)).real();
    }
    wrong += (static_cast<long double>(fft.samples()[j]) - sum) *
             (static_cast<long double>(fft.samples()[j]) - sum);
    power += sum * sum;
  }
  CHECK(static_cast<double>(std::sqrt(wrong / power)) < 5e-15);
}

TEST_CASE("a copy begins with zeros and gives the same bits", "[real_fft]") {
  const std::size_t n = GENERATE(std::size_t{41}, std::size_t{96});
  RealFft fft(n);
  const std::vector<double> values = random_values(n, 3);
  std::copy(values.begin(), values.end(), fft.samples().begin());
  RealFft copy = fft;
  for (const double sample : copy.samples()) REQUIRE(sample == 0.0);
  for (const std::complex<double> bin : copy.bins()) REQUIRE(bin == 0.0);
  std::copy(values.begin(), values.end(), copy.samples().begin());
  fft.forward();
  copy.forward();
  CHECK(std::equal(fft.bins().begin(), fft.bins().end(), copy.bins().begin()));
  const RealFft moved = std::move(copy);
  CHECK(moved.size() == n);
}

}  // namespace tactile_net
