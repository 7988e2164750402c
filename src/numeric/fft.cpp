#include "tactile_net/numeric/fft.hpp"

namespace tactile_net {

std::string_view name(FftLibrary library) noexcept {
  return library == FftLibrary::fftw ? "FFTW (GPL)" : "Eigen (MPL 2.0)";
}

}  // namespace tactile_net
