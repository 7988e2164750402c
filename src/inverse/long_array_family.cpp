#include "tactile_net/inverse/long_array_family.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "inverse/family_factors.hpp"
#include "inverse/sections.hpp"
#include "inverse/welch_periodogram.hpp"
#include "tactile_net/inverse/covariance.hpp"

namespace tactile_net {
namespace {

/// Of the periodogram, which tapers smooth.
constexpr std::size_t most_bins = 64;

/// Sections with the same dead taxels.
struct Alike {
  TikhonovFamily family;
  std::vector<std::size_t> sections;
  Eigen::MatrixXd u;        // the family's left vectors
  Eigen::MatrixXd spectra;  // of u's columns, at the periodogram's frequencies
  Eigen::MatrixXd fourier;  // of rows, likewise
};

}  // namespace

struct LongArrayFamily::Parts {
  Parts(const SensorArray& array, const Material& material, const LineProblemOptions& options)
      : sections(sections_of(array, options)), taxels(array.count), unknowns(options.unknowns) {
    check(array, material, options);
    require_known_offsets(options.unknown_offsets, "sections of an array");
    surface = surface_of(array, options.surface);
    SensorArray piece = array;
    piece.count = sections.length;
    LineProblemOptions all_alive = options;
    all_alive.dead_taxels.clear();
    const LinearProblem alive = make_problem(piece, material, all_alive);
    values = alive.grid.count();
    channels = alive.weights.size() / sections.length;
    for (std::size_t c = 0; c < channels; ++c)
      weights.insert(weights.end(), taxels, alive.weights[c * sections.length]);

    std::map<std::vector<std::size_t>, std::vector<std::size_t>> patterns;
    std::vector<std::size_t> dead = options.dead_taxels;
    std::sort(dead.begin(), dead.end());
    dead.erase(std::unique(dead.begin(), dead.end()), dead.end());
    for (std::size_t s = 0; s < sections.starts.size(); ++s) {
      const std::size_t start = sections.starts[s];
      std::vector<std::size_t> pattern;
      for (const std::size_t taxel : dead)
        if (taxel >= start && taxel < start + sections.length) pattern.push_back(taxel - start);
      patterns[std::move(pattern)].push_back(s);
    }
    for (const std::size_t taxel : dead)
      for (std::size_t c = 0; c < channels; ++c) weights[c * taxels + taxel] = 0.0;
    rows = channels * (taxels - dead.size());
    if (rows == 0) throw std::invalid_argument("every taxel is dead: nothing is measured");
    for (const auto& [pattern, of] : patterns) {
      LinearProblem problem = alive;
      leave_out(problem, pattern);
      add(TikhonovFamily(problem), of);
    }
  }

  void add(TikhonovFamily family, const std::vector<std::size_t>& of) {
    const TikhonovFamily::Factors& factors = *family.factors();
    Eigen::MatrixXd u = factors.left_vectors();
    // What these sections' living taxels count for together.
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(u.rows());
    for (const std::size_t s : of) counts += tapers(s);
    counts.array() *= (factors.weighting.weights().array() != 0.0).cast<double>();
    const Eigen::VectorXd share = u.cwiseAbs2().transpose() * counts;
    gamma.insert(gamma.end(), factors.gamma.begin(), factors.gamma.end());
    shares.insert(shares.end(), share.begin(), share.end());

    const std::size_t all_bins = sections.length / 2;
    const std::size_t every =
        sections.starts.size() == 1 ? 1 : (all_bins + most_bins - 1) / most_bins;
    bins = all_bins / every;
    std::vector<Eigen::Index> rows_of;
    for (std::size_t part = 0; part < 2 * channels; ++part)
      for (std::size_t k = 1; k <= bins; ++k)
        rows_of.push_back(static_cast<Eigen::Index>(part * all_bins + k * every - 1));
    Eigen::MatrixXd spectra = factors.spectra().of_u(rows_of, Eigen::indexing::all);
    Eigen::MatrixXd fourier = factors.spectra().fourier(rows_of, Eigen::indexing::all);
    alikes.push_back({std::move(family), of, std::move(u), std::move(spectra), std::move(fourier)});
  }

  /// Of every row of a section.
  [[nodiscard]] Eigen::VectorXd tapers(std::size_t s) const {
    Eigen::VectorXd taper(static_cast<Eigen::Index>(sections.length));
    for (Eigen::Index i = 0; i < taper.size(); ++i)
      taper(i) =
          sections.weight(s, static_cast<double>(sections.starts[s]) + static_cast<double>(i));
    return taper.replicate(static_cast<Eigen::Index>(channels), 1);
  }

  Sections sections;
  std::size_t taxels, unknowns;
  Surface surface{};       // of the whole array
  std::size_t values = 0;  // of one traction, in a section
  std::size_t channels = 0;
  std::size_t rows = 0;  // that live
  std::vector<double> weights{};
  std::vector<Alike> alikes{};
  std::vector<double> gamma{}, shares{};
  std::size_t bins = 0;  // of the periodogram
};

LongArrayFamily::LongArrayFamily(const SensorArray& array, const Material& material,
                                 const LineProblemOptions& options)
    : parts_(std::make_shared<const Parts>(array, material, options)) {}

std::size_t LongArrayFamily::sections() const noexcept { return parts_->sections.starts.size(); }

FilterFrame LongArrayFamily::analyse(std::span<const double> readings) const {
  const Parts& parts = *parts_;
  check_readings(readings, parts.weights.size());
  FilterFrame frame{.gamma = parts.gamma, .shares = parts.shares, .rows = parts.rows};
  Eigen::VectorXd g = as_eigen(std::span(parts.weights)).cwiseProduct(as_eigen(readings));
  frame.scale = g.cwiseAbs().maxCoeff();
  if (frame.scale > 0.0) g = g / frame.scale;

  const auto length = static_cast<Eigen::Index>(parts.sections.length);
  const auto channels = static_cast<Eigen::Index>(parts.channels);
  double outside = 0.0;
  std::vector<WelchPeriodogram::Part> spectra;
  for (const Alike& alike : parts.alikes) {
    Eigen::MatrixXd pieces(length * channels, std::ssize(alike.sections));
    Eigen::MatrixXd tapers(pieces.rows(), pieces.cols());
    for (Eigen::Index k = 0; k < pieces.cols(); ++k) {
      const std::size_t s = alike.sections[static_cast<std::size_t>(k)];
      for (Eigen::Index c = 0; c < channels; ++c)
        pieces.col(k).segment(c * length, length) =
            g.segment(c * static_cast<Eigen::Index>(parts.taxels) +
                          static_cast<Eigen::Index>(parts.sections.starts[s]),
                      length);
      tapers.col(k) = parts.tapers(s);
    }
    const Eigen::MatrixXd tapered = pieces.cwiseProduct(tapers);
    const Eigen::MatrixXd& u = alike.u;
    const Eigen::MatrixXd whole = u.transpose() * pieces;
    Eigen::MatrixXd beta = u.transpose() * tapered;
    const Eigen::VectorXd powers = whole.cwiseProduct(beta).rowwise().sum();
    const Eigen::VectorXd norms = beta.rowwise().norm();
    const Eigen::MatrixXd left = tapered - u * beta;
    outside += left.cwiseProduct(pieces).sum();
    frame.powers.insert(frame.powers.end(), powers.begin(), powers.end());
    frame.beta.insert(frame.beta.end(), norms.begin(), norms.end());
    spectra.push_back({&alike.spectra, std::move(beta), alike.fourier * left});
  }
  frame.outside = std::sqrt(std::max(outside, 0.0));
  frame.periodogram = std::make_shared<WelchPeriodogram>(parts_, std::move(spectra), parts.bins);
  return frame;
}

std::vector<double> LongArrayFamily::deviations(double alpha, double prior_alpha) const {
  const Parts& parts = *parts_;
  const std::size_t n = parts.surface.count;
  const auto stride = static_cast<double>(parts.surface.stride);
  const auto margin = static_cast<double>(parts.surface.margin);
  std::vector<double> variances(parts.unknowns * n);
  for (const Alike& alike : parts.alikes) {
    const std::vector<double> own =
        TractionCovariance(alike.family, alpha, prior_alpha).deviations();
    for (const std::size_t s : alike.sections) {
      const std::size_t first = parts.sections.starts[s] * parts.surface.stride;
      for (std::size_t i = 0; i < parts.values; ++i) {
        const double place = (static_cast<double>(first + i) - margin) / stride;
        const double weight = parts.sections.weight(s, place);
        for (std::size_t u = 0; u < parts.unknowns; ++u) {
          const double deviation = own[u * parts.values + i];
          variances[u * n + first + i] += weight * deviation * deviation;
        }
      }
    }
  }
  for (double& value : variances) value = std::sqrt(value);
  return variances;
}

double LongArrayFamily::degrees_of_freedom(double alpha) const noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < parts_->gamma.size(); ++i) {
    const double kept = parts_->gamma[i] / std::hypot(parts_->gamma[i], std::sqrt(alpha));
    sum += parts_->shares[i] * kept * kept;
  }
  return sum;
}

}  // namespace tactile_net
