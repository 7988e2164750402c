#include "tactile_net/inverse/identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

#include "inverse/decompositions.hpp"
#include "inverse/eigen.hpp"
#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The frequency j = 0 ... count / 2 at which one block of a mode is strongest.
std::size_t strongest_frequency(const Eigen::Ref<const Eigen::VectorXd>& block) {
  const auto n = static_cast<std::size_t>(block.size());
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t j = 0; j <= n / 2; ++j) {
    std::complex<double> sum{};
    for (std::size_t i = 0; i < n; ++i)
      sum += block(static_cast<Eigen::Index>(i)) *
             std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(j * i % n) /
                                 static_cast<double>(n));
    // Both k and count - k hold a ripple's power, but for the mean and Nyquist.
    const double power = std::norm(sum) * (j == 0 || 2 * j == n ? 1.0 : 2.0);
    if (power > most) {
      most = power;
      best = j;
    }
  }
  return best;
}

NullMode named(const Eigen::VectorXd& mode, double singular_value, const InverseProblem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.count);
  NullMode result{.singular_value = singular_value};
  Eigen::Index start = 0;
  if (problem.unknowns == 2) {
    const double normal = mode.head(n).squaredNorm() / mode.squaredNorm();
    result.unknown = normal >= 0.5 ? Traction::normal : Traction::tangential;
    result.share = std::max(normal, 1.0 - normal);
    if (result.unknown == Traction::tangential) start = n;
  }
  const std::size_t frequency = strongest_frequency(mode.segment(start, n));
  std::ostringstream text;
  text << (result.unknown == Traction::normal ? "normal" : "tangential") << " traction";
  if (result.share < 0.9)
    text << " (" << std::lround(100.0 * result.share) << " %) with "
         << (result.unknown == Traction::normal ? "tangential" : "normal");
  if (frequency == 0) {
    text << ", constant (k = 0)";
  } else {
    result.wavelength =
        static_cast<double>(problem.count) * problem.pitch / static_cast<double>(frequency);
    if (2 * frequency + 1 >= problem.count)
      text << ", alternating from taxel to taxel (Nyquist)";
    else
      text << ", wavelength " << *result.wavelength;
  }
  result.description = text.str();
  return result;
}

}  // namespace

Identifiability identifiability(const InverseProblem& problem) {
  const Svd svd = singular_value_decomposition(Eigen::MatrixXd(as_eigen(problem.kernel)));
  const Eigen::VectorXd& s = svd.values;
  Identifiability result{.singular_values = {s.begin(), s.end()}};
  const double largest = s(0);
  const double smallest = s(s.size() - 1);
  result.condition = smallest > 0.0 ? largest / smallest : infinity;
  result.noise_gain = smallest > 0.0 ? 1.0 / smallest : infinity;
  const double floor = std::max(
      static_cast<double>(problem.kernel.rows) * std::numeric_limits<double>::epsilon() * largest,
      problem.kernel_error);
  result.rank = static_cast<std::size_t>((s.array() > floor).count());
  for (Eigen::Index i = s.size(); i-- > static_cast<Eigen::Index>(result.rank);)
    result.null_modes.push_back(named(svd.v.col(i), s(i), problem));
  return result;
}

std::vector<Resolution> resolutions(const SensorArray& array, const Material& material,
                                    const ProblemOptions& options) {
  check(array, material, options);
  const std::vector<Channel> all = channels(array);
  const std::size_t n = array.count;
  const auto unknowns = static_cast<Eigen::Index>(options.unknowns);
  std::vector<Resolution> result;
  for (std::size_t j = 0; j <= n / 2; ++j) {
    const double k =
        2.0 * std::numbers::pi * static_cast<double>(j) / (static_cast<double>(n) * array.pitch);
    const bool single = j == 0 || 2 * j == n;
    Eigen::MatrixXcd a(static_cast<Eigen::Index>(all.size()), unknowns);
    for (std::size_t c = 0; c < all.size(); ++c)
      for (Eigen::Index u = 0; u < unknowns; ++u) {
        const Traction load = u == 0 ? Traction::normal : Traction::tangential;
        const bool odd = (all[c].quantity == Quantity::shear_xy) == (load == Traction::normal);
        const double weight = options.channel_rms.empty() ? 1.0 : 1.0 / options.channel_rms[c];
        a(static_cast<Eigen::Index>(c), u) =
            odd && single
                ? 0.0
                : weight * pad_transform(all[c].quantity, load, material, all[c].depth, k);
      }
    const ComplexSvd svd = singular_value_decomposition(a);
    const auto deviation = [&](Eigen::Index u) {
      double variance = 0.0;
      for (Eigen::Index i = 0; i < svd.values.size(); ++i) {
        const double part = std::norm(svd.v(u, i));
        const double s = svd.values(i);
        if (s > 1e-14 * svd.values(0))
          variance += part / (s * s);
        else if (part > 1e-20)
          return infinity;
      }
      return std::sqrt((single ? 1.0 : 2.0) / static_cast<double>(n) * variance);
    };
    result.push_back({.wavelength = j == 0 ? infinity : 2.0 * std::numbers::pi / k,
                      .normal = deviation(0),
                      .tangential = unknowns == 2 ? deviation(1) : infinity});
  }
  return result;
}

std::optional<double> resolvable_wavelength(const std::vector<Resolution>& all, Traction component,
                                            double limit) {
  std::optional<double> shortest;
  for (std::size_t j = 1; j < all.size(); ++j) {
    const double deviation = component == Traction::normal ? all[j].normal : all[j].tangential;
    if (!(deviation <= limit)) break;
    shortest = all[j].wavelength;
  }
  return shortest;
}

}  // namespace tactile_net
