// What the thesis has wrong, proved with numbers.
#include <Eigen/Dense>
#include <cmath>

#include "docs/figures/thesis/chapter.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::thesis {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Example 4.1's constant c by normal equations, and what the functional is there.
struct Constant {
  double c = 0.0;
  double objective = 0.0;
  double slope = 0.0;  ///< of the functional in c, the rest being optimal for that c
};

class Example41 {
 public:
  Example41() {
    const SensorArray array{81, 0.25, {1.5}, {Quantity::strain_x}};
    const Material material{1.0, 0.45};
    problem_ = make_problem(array, material, {.smoothing_length = 1.0});
    const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
    g_ = sampled_readings(array, material, sample(contacts, array));
    k_ = Eigen::Map<const RowMajor>(problem_.kernel.values.data(), n, n);
    sum_ = Eigen::MatrixXd::Zero(n, n);
    sum_.triangularView<Eigen::Lower>().setConstant(0.25);
  }

  [[nodiscard]] Constant solve(bool corrected) const {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
    const Eigen::VectorXd g = Eigen::Map<const Eigen::VectorXd>(g_.data(), n);
    const Eigen::MatrixXd kg = k_ * sum_;
    const Eigen::LDLT<Eigen::MatrixXd> a(
        kg.transpose() * kg + alpha * (sum_.transpose() * sum_ + Eigen::MatrixXd::Identity(n, n)));
    const Eigen::VectorXd b = k_ * ones;
    const Eigen::VectorXd d =
        corrected ? Eigen::VectorXd(sum_.transpose() * ones) : Eigen::VectorXd(sum_ * ones);
    const Eigen::VectorXd u = a.solve(kg.transpose() * g);
    const Eigen::VectorXd v = a.solve(kg.transpose() * b + alpha * d);
    const double more = corrected ? alpha : 0.0;
    Constant result;
    result.c = (b.dot(g) - b.dot(kg * u) - more * d.dot(u)) /
               (b.dot(b) - b.dot(kg * v) + alpha * (corrected ? 81.0 : 1.0) - more * d.dot(v));
    const auto objective = [&](double c) {
      const Eigen::VectorXd h = u - c * v;
      const Eigen::VectorXd f = sum_ * h + c * ones;
      return (k_ * f - g).squaredNorm() + alpha * (f.squaredNorm() + h.squaredNorm());
    };
    result.objective = objective(result.c);
    constexpr double step = 1e-4;
    result.slope = (objective(result.c + step) - objective(result.c - step)) / (2.0 * step);
    return result;
  }

 private:
  static constexpr Eigen::Index n = 81;
  static constexpr double alpha = 1e-3;
  LinearProblem problem_;
  std::vector<double> g_;
  Eigen::MatrixXd k_, sum_;
};

std::string negative_entries() {
  const Material rubber{1.0, 0.5};
  std::string rows;
  for (const auto& [quantity, ratio] :
       {std::pair(Quantity::strain_x, 3.0), std::pair(Quantity::strain_x, 6.0),
        std::pair(Quantity::stress_x, 6.0), std::pair(Quantity::stress_x, 10.0)}) {
    DftInverse inverse({121, 1.5 / ratio, {1.5}, {quantity}}, rubber, 1e300);
    rows += "| " + std::string(name(quantity)) + " | " + three(ratio) + " | " +
            std::to_string(2 * inverse.noise_gain().sign_changes) + " of 121 | " +
            three(inverse.noise_gain().largest) + " |\n";
  }
  return rows;
}

}  // namespace

Chapter errata() {
  const Example41 example;
  const Constant printed = example.solve(false);
  const Constant corrected = example.solve(true);
  return {
      .text =
          "## Errata, with their proofs\n\n"
          "`docs/errata.md` lists what is built instead, and the test that shows each.\n\n"
          "**3.1: \"the DFT of the kernel is real and nonnegative\".** Only for moderate depth "
          "over pitch. Entries of the other sign, and how much the division amplifies:\n\n"
          "| kernel | depth / pitch | wrong sign | largest amplification |\n|---|---|---|---|\n" +
          negative_entries() +
          "\n**4.12, 4.15: the constant c.** With d the column sums of G (the thesis prints row "
          "sums, but its own d(y) = integral of G(x, y) dx has d(1) = 0), the terms alpha d'u "
          "and alpha d'v, and alpha N for alpha. Example 4.1, alpha = 1e-3, half width 2, "
          "force 1:\n\n| | c | functional | its slope in c |\n|---|---|---|---|\n| as printed | " +
          three(printed.c) + " | " + three(printed.objective) + " | " + three(printed.slope) +
          " |\n| corrected | " + three(corrected.c) + " | " + three(corrected.objective) + " | " +
          (std::abs(corrected.slope) < 1e-9 ? "0" : three(corrected.slope)) +
          " |\n\nA slope that is not zero: the printed c is not a minimum of the functional it "
          "is derived from.\n\n"
          "**4.21 to 4.23: two unknowns.** (G*G + I) without alpha, and signs: each block obeys "
          "the same algebra as one unknown. With them corrected the closed form equals the "
          "minimiser found by a QR, as the table of example 4.2 shows.\n\n"
          "**3.3: the flat punch.** P / (pi sqrt((a+e)^2 - y^2)) on [-a, a] has the resultant "
          "P (2/pi) asin(a/(a+e)), which is P only for e = 0: " +
          three(resultant(RigidContact{.shape = Shape::punch, .half_width = 2.0, .edge = 0.1},
                          Traction::normal)) +
          " for P = 1, a = 2, e = 0.1.\n"};
}

}  // namespace tactile_net::thesis
