#include "lab/large_skin.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::lab {
namespace {

/// Before anything is made that has the skin's size.
void check_large_memory(const SkinArray& skin, const SkinProblemOptions& options, bool constrained,
                        double available) {
  constexpr double gigabyte = 1e9;
  const SurfaceGrid grid = grid_of(skin, options.grid);
  const double bytes = large_skin_bytes({.cells = grid.count(),
                                         .components = options.components,
                                         .channels = channel_count(skin),
                                         .dead_taxels = options.dead_taxels.size(),
                                         .constrained = constrained});
  if (bytes <= available) return;
  throw std::invalid_argument(std::to_string(options.components * grid.count()) +
                              " unknown tractions take about " + fixed(bytes / gigabyte, 1) +
                              " GB, and " + fixed(available / gigabyte, 1) +
                              " GB are left: choose a larger spacing or a smaller margin");
}

}  // namespace

LargeSkin::LargeSkin(const SkinArray& skin, const Material& material, SkinProblemOptions options,
                     DataLimits limits, double available, bool constrained)
    : skin_(skin), material_(material), options_(std::move(options)), limits_(std::move(limits)) {
  check(skin_, material_, options_);
  check_large_memory(skin_, options_, constrained, available);
  system_ = make_large_skin_system(skin_, material_, options_);
}

LargeSkin::LargeSkin(LargeSkin& whole, const std::vector<std::size_t>& dead)
    : skin_(whole.skin_),
      material_(whole.material_),
      options_(whole.options_),
      limits_(whole.limits_),
      system_(without_taxels(*whole.system_, dead)),
      like_(whole.bands_ ? whole.bands_ : whole.like_) {
  constexpr std::size_t few = 50;  // one of so many taxels
  const std::size_t more = dead.size() - options_.dead_taxels.size();
  options_.dead_taxels = dead;
  if (few * more <= problem().taxels) family_.emplace(system_, whole.family());
}

const LargeSkinFamily& LargeSkin::family() {
  if (!family_) family_.emplace(system_);
  return *family_;
}

double LargeSkin::degrees_of_freedom(const ActiveFace& face, double alpha) const {
  if (face.free.empty()) return 0.0;
  constexpr std::size_t probes = 1;
  return LargeSkinFamily(system_, face, probes).degrees_of_freedom(alpha);
}

LargeSkinTikhonov& LargeSkin::solver(double alpha) {
  if (!solver_)
    solver_ = std::make_unique<LargeSkinTikhonov>(system_, alpha);
  else
    solver_->use_alpha(alpha);
  return *solver_;
}

std::vector<double> LargeSkin::solve(std::span<const double> readings, double alpha) {
  std::vector<double> tractions(problem().components * problem().grid.count());
  const FrameStatus status = solver(alpha).solve(readings, tractions);
  if (status == FrameStatus::too_large) throw FrameOverflow();
  if (status != FrameStatus::ok)
    throw std::invalid_argument("readings have the wrong size or are not finite");
  return tractions;
}

ConeSolution LargeSkin::solve_in_cones(std::span<const double> readings, double alpha,
                                       const Constraints& constraints) {
  return LargeSkinCone(system_, alpha, constraints).solve(readings);
}

std::unique_ptr<const LargeSkinCovariance> LargeSkin::covariance(double alpha, double prior_alpha) {
  LargeSkinTikhonov& own = solver(alpha);
  if (!bands_)
    bands_ = like_ ? std::make_shared<LargeSkinBands>(own, *like_)
                   : std::make_shared<LargeSkinBands>(own, skin_, material_, options_);
  return std::make_unique<LargeSkinCovariance>(*bands_, prior_alpha,
                                               family().degrees_of_freedom(alpha));
}

LargeContacts LargeSkin::contacts(const std::vector<std::vector<std::size_t>>& apart) const {
  constexpr double depths = 4.0;  // as far as a reading tells of a traction
  const double reach = depths * *std::max_element(skin_.depths.begin(), skin_.depths.end());
  return LargeContacts(problem(), apart, reach, [&](std::span<const std::size_t> cells) {
    return LargeSkinPart(skin_, material_, options_, problem(), cells, reach);
  });
}

std::vector<double> LargeSkin::readings_of(const LargeSkinPart& part,
                                           std::span<const double> readings,
                                           std::span<const double> tractions) {
  std::vector<double> beyond = part.among_all(part.tractions(tractions));
  for (std::size_t i = 0; i < beyond.size(); ++i) beyond[i] = tractions[i] - beyond[i];
  const std::vector<double> of_others = part.readings(weighted_product(*system_, beyond));
  const std::vector<double>& weights = problem_of(*part.system()).weights;
  std::vector<double> left = part.readings(readings);
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] = weights[i] > 0.0 ? left[i] - of_others[i] / weights[i] : 0.0;
  return left;
}

double LargeSkin::residual(std::span<const double> readings, std::span<const double> tractions) {
  const std::vector<double> explained = weighted(problem(), readings);
  const std::vector<double> found = weighted_product(*system_, tractions);
  double size = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) size = std::hypot(size, found[i] - explained[i]);
  return size;
}

}  // namespace tactile_net::lab
