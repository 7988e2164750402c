#include <cmath>
#include <tactile_net/inverse/line_problem.hpp>
#include <tactile_net/inverse/reconstruction.hpp>
#include <tactile_net/inverse/thesis/dft_tikhonov.hpp>
#include <tactile_net/numeric/fft.hpp>
#include <vector>

// A uniform pressure reads as itself in the middle of the pad, and is found there; by Eigen's FFT
// too.
int main() {
  using namespace tactile_net;
  const SensorArray array{
      .count = 41, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x}};
  const LinearProblem problem =
      make_problem(array, Material{.youngs_modulus = 1.0, .poisson_ratio = 0.45});
  const std::vector<double> tractions = tikhonov_solve(problem, 1e-6, std::vector<double>(41, 1.0));
  if (!(std::abs(tractions[20] - 1.0) < 0.05)) return 1;

  if (fft_library() != FftLibrary::eigen) return 2;
  DftTikhonov by_fft(array, Material{.youngs_modulus = 1.0, .poisson_ratio = 0.45}, {});
  std::vector<double> circular(41);
  const FrameStatus status = by_fft.solve(std::vector<double>(41, 1.0), 1e-6, circular);
  return status == FrameStatus::ok && std::abs(circular[20] - 1.0) < 0.1 ? 0 : 3;
}
