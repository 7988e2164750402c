// P f = b for 1024 taxels, one unknown, boundaries included: conjugate gradients by FFT.
// Rival: Eigen's LLT of P, given P: its factorisation and one solve. Limits to hold: 10 times
// faster, 1e-8 apart.
#include <Eigen/Cholesky>

#include "bench/measure.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/sampled.hpp"

int main() {
  using namespace tactile_net;
  const std::size_t n = 1024;
  const double alpha = 1e-3;
  const SensorArray array{n, 0.125, {1.5}, {Quantity::stress_x}};
  const Material pad{1.0, 0.45};
  const LineProblemOptions options{.smoothing_length = 1.0};
  const std::vector<Contact> contacts = {RigidContact{.center = -20.0, .half_width = 3.0},
                                         RigidContact{.center = 63.0, .half_width = 2.0}};
  const std::vector<double> g = sampled_readings(array, pad, sample(contacts, array));

  const LinearProblem problem = make_problem(array, pad, options);
  const Matrix normal = normal_matrix(problem, alpha);
  const std::vector<double> right = normal_right_side(problem, g);
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::MatrixXd p = Eigen::Map<const Eigen::MatrixXd>(normal.values.data(), size, size);
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(right.data(), size);
  Eigen::VectorXd dense(size);

  FftTikhonov solver(array, pad, options, alpha);
  std::vector<double> f(n);
  const auto [ours, rival] = bench::compare(
      15, [&] { return bench::in_process([&] { (void)solver.solve(g, f, 1e-9); }); },
      [&] { return bench::in_process([&] { dense = Eigen::LLT<Eigen::MatrixXd>(p).solve(b); }); });
  const double apart = relative_l2_error(f, std::vector<double>(dense.begin(), dense.end()));
  std::printf(
      "large, 1024 taxels: %.3f ms in %zu steps; Eigen's LLT %.2f ms; ratio %.0f (limit 10), "
      "%.1e apart (limit 1e-8)\n",
      1e3 * ours.seconds, solver.convergence().steps, 1e3 * rival.seconds,
      rival.seconds / ours.seconds, apart);
}
