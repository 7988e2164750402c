// An FFT may allocate in some of its executions: not for the sizes that plans may have.
#include "src/numeric/real_fft.hpp"
#include "tests/catch.hpp"
#include "tests/counted_malloc.hpp"

using namespace tactile_net;

TEST_CASE("the counter sees what FFTW allocates, for sizes with a large prime factor",
          "[real_fft][no_allocation]") {
  RealFft fft(2 * 97);
  const long allocated = allocations_of([&] { fft.forward(); });
  CHECK((allocated > 0) == (fft_library() == FftLibrary::fftw));
}

TEMPLATE_TEST_CASE("a transform of a fast size allocates nothing, nor does a copy's",
                   "[real_fft][no_allocation]", RealFft, ComplexFft) {
  int tested = 0;
  for (std::size_t size = 2; size <= 32768; size = RealFft::fast_size(size + 1)) {
    TestType fft(size);
    TestType copy = fft;
    const long allocated = allocations_of([&] {
      for (TestType* one : {&fft, &copy}) {
        one->forward();
        one->backward();
      }
    });
    CAPTURE(size);
    CHECK(allocated == 0);
    ++tested;
  }
  CHECK(tested > 300);
}
