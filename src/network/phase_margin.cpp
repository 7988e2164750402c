#include "tactile_net/network/phase_margin.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "network/angular_frequency.hpp"
#include "network/nodal_equations.hpp"
#include "numeric/decompositions.hpp"

namespace tactile_net {
namespace {

using Complex = std::complex<double>;

/// The amplifiers' loops, opened at their inputs: M x = E d with d of other inputs than the
/// amplifiers have, which in turn are D x. L = -D M^-1 E; 1 + l turns 0 at a pole, l an eigenvalue
/// of L.
class Loops {
 public:
  explicit Loops(const FlatCircuit& circuit) : equations_(circuit) {
    const auto amplifiers = equations_.amplifiers();
    const Eigen::Index count = eigen_index(amplifiers.size());
    if (count == 0) throw std::invalid_argument("a phase margin is of amplifiers: there is none");
    inputs_ = Eigen::MatrixXd::Zero(count, equations_.size());
    cores_ = Eigen::MatrixXd::Zero(2 * equations_.size(), 2 * count);
    opened_ = equations_.conductances();
    for (std::size_t k = 0; k < amplifiers.size(); ++k) {
      const OpAmp& opamp = amplifiers[k].opamp;
      if (!opamp.bandwidth)
        throw std::invalid_argument("a phase margin needs the amplifiers' bandwidth");
      least_ = k == 0 ? *opamp.bandwidth : std::min(least_, *opamp.bandwidth);
      largest_ = std::max(largest_, *opamp.bandwidth);
      const FlatCircuit::Amplifier& x = circuit.amplifiers()[k];
      const double common = opamp.common_mode_rejection ? 0.5 / *opamp.common_mode_rejection : 0.0;
      const auto see = [&](Node node, double factor) {
        each_term(equations_.nodes().voltages[node], [&](std::size_t at, double sign) {
          inputs_(eigen_index(k), eigen_index(at)) += factor * sign;
          opened_.coeffRef(eigen_index(amplifiers[k].core), eigen_index(at)) += factor * sign;
        });
      };
      see(x.plus, 1.0 + common);
      see(x.minus, common - 1.0);
      const Eigen::Index core = eigen_index(amplifiers[k].core);
      cores_(core, eigen_index(k)) = cores_(equations_.size() + core, count + eigen_index(k)) = 1.0;
    }
  }

  [[nodiscard]] double least() const noexcept { return least_; }
  [[nodiscard]] double largest() const noexcept { return largest_; }

  /// Loci at one frequency, of either sign of their imaginary part, the largest first. In real
  /// arithmetic: a complex number a + ib as [a -b; b a].
  [[nodiscard]] std::vector<Complex> at(double hertz) const {
    const Eigen::Index n = equations_.size();
    const double w = angular_frequency(hertz);
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const Eigen::SparseMatrix<double>& from, auto&& each) {
      for (Eigen::Index column = 0; column < from.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator one(from, column); one; ++one)
          each(one.row(), one.col(), one.value());
    };
    add(opened_, [&](Eigen::Index row, Eigen::Index column, double value) {
      entries.emplace_back(row, column, value);
      entries.emplace_back(n + row, n + column, value);
    });
    add(equations_.capacitances(), [&](Eigen::Index row, Eigen::Index column, double value) {
      entries.emplace_back(row, n + column, -w * value);
      entries.emplace_back(n + row, column, w * value);
    });
    Eigen::SparseMatrix<double> m(2 * n, 2 * n);
    m.setFromTriplets(entries.begin(), entries.end());
    const SparseLu lu(m);
    if (!lu.regular()) throw std::domain_error("nodes without capacitance have no unique voltage");
    const Eigen::Index count = inputs_.rows();
    const Eigen::MatrixXd x = lu.solve(Eigen::MatrixXd(cores_.leftCols(count)));
    const Eigen::MatrixXd real = -inputs_ * x.topRows(n);
    const Eigen::MatrixXd imaginary = -inputs_ * x.bottomRows(n);
    Eigen::MatrixXd loops(2 * count, 2 * count);
    loops << real, -imaginary, imaginary, real;
    const Eigen::VectorXcd values = eigenvalues(loops);
    // Each comes with its conjugate.
    std::vector<Complex> loci(values.begin(), values.end());
    std::sort(loci.begin(), loci.end(),
              [](const Complex& a, const Complex& b) { return std::abs(a) > std::abs(b); });
    return loci;
  }

 private:
  NodalEquations equations_;
  Eigen::MatrixXd inputs_, cores_;
  Eigen::SparseMatrix<double> opened_;
  double least_ = 0.0, largest_ = 0.0;
};

struct LociSample {
  double hertz = 0.0;
  std::vector<Complex> loci{};
};

/// From -1, of either sign.
double degrees_from_oscillation(const Complex& locus) {
  return 180.0 - std::abs(std::arg(locus)) * 180.0 / std::numbers::pi;
}

/// A locus that passes through the unit circle between two samples, as the straight line between
/// them in the logarithms says.
struct UnitCrossing {
  PhaseMargin margin{};
  std::size_t interval = 0;
};

std::vector<UnitCrossing> unit_crossings(const std::vector<LociSample>& samples) {
  std::vector<UnitCrossing> found;
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const auto& [from, a] = samples[k];
    const auto& [to, b] = samples[k + 1];
    for (std::size_t l = 0; l < a.size(); ++l) {
      const double first = std::log(std::abs(a[l]));
      const double second = std::log(std::abs(b[l]));
      if ((first > 0.0) == (second > 0.0)) continue;
      const double share = first / (first - second);
      found.push_back(
          {{(1.0 - share) * degrees_from_oscillation(a[l]) + share * degrees_from_oscillation(b[l]),
            from * std::pow(to / from, share)},
           k});
    }
  }
  std::sort(found.begin(), found.end(), [](const UnitCrossing& a, const UnitCrossing& b) {
    return a.margin.degrees < b.margin.degrees;
  });
  return found;
}

constexpr double first_ratio = 1.5;    // of neighbouring frequencies
constexpr double last_ratio = 1.0005;  // to which the margin's own are refined
constexpr double may_be_least = 10.0;  // [degrees]: intervals that are refined with the least
constexpr std::size_t most_samples = 400;

}  // namespace

std::optional<PhaseMargin> phase_margin(const FlatCircuit& circuit) {
  const Loops loops(circuit);
  std::vector<LociSample> samples;
  // Beyond ten times the largest bandwidth no loop has gain; loops that hardly feed back cross far
  // below their bandwidths.
  for (double f = 10.0 * loops.largest(); samples.size() < 100; f /= first_ratio) {
    samples.insert(samples.begin(), {f, loops.at(f)});
    const auto& loci = samples.front().loci;
    if (f < loops.least() && std::abs(loci.back()) > 1.0) break;
  }
  for (;;) {
    const std::vector<UnitCrossing> found = unit_crossings(samples);
    if (found.empty()) return std::nullopt;
    std::vector<bool> split(samples.size());
    bool any = false;
    for (const UnitCrossing& one : found) {
      const double ratio = samples[one.interval + 1].hertz / samples[one.interval].hertz;
      // What lies further from the least than its own interval may hide needs no more digits.
      const double doubt =
          may_be_least * std::min(1.0, 2.0 * std::log(ratio) / std::log(first_ratio));
      if (one.margin.degrees > found.front().margin.degrees + doubt || ratio <= last_ratio)
        continue;
      split[one.interval] = any = true;
    }
    if (!any || samples.size() > most_samples) return found.front().margin;
    std::vector<LociSample> finer;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      finer.push_back(std::move(samples[k]));
      if (!split[k]) continue;
      const double middle = std::sqrt(finer.back().hertz * samples[k + 1].hertz);
      finer.push_back({middle, loops.at(middle)});
    }
    samples = std::move(finer);
  }
}

}  // namespace tactile_net
