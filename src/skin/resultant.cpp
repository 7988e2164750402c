#include "tactile_net/skin/resultant.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "inverse/contact_sizes.hpp"
#include "realtime/touching_cells.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net {
namespace {

using Gradient = std::vector<double>;

/// Tractions of some cells alone, and what they amount to.
class Contact {
 public:
  Contact(const SurfaceGrid& grid, std::span<const double> tractions,
          std::span<const std::size_t> cells)
      : grid_(grid), count_(grid.count()), cells_(cells), own_(tractions.size()) {
    if (tractions.size() != count_ && tractions.size() != 3 * count_)
      throw std::invalid_argument("tractions need one value per cell, or three");
    for (const std::size_t cell : cells) {
      if (cell >= count_) throw std::invalid_argument("a cell of another grid");
      for (std::size_t i = cell; i < own_.size(); i += count_) own_[i] = tractions[i];
    }
    wrench_ = resultant(own_, grid);
    centre_ = centre_of_pressure();
    // About the centre: moments about the middle of the skin may be out of a double's range.
    if (presses_ && drags()) {
      torsion_ = 0.0;
      for (const std::size_t cell : cells)
        torsion_ += y(cell) * (q_z(cell) * area()) - z(cell) * (q_y(cell) * area());
    }
  }

  [[nodiscard]] const SkinWrench& wrench() const noexcept { return wrench_; }
  [[nodiscard]] bool presses() const noexcept { return presses_; }
  /// Of pressure [m]. @pre  it presses
  [[nodiscard]] const SkinWrench::Centre& centre() const noexcept { return centre_; }
  [[nodiscard]] double torsion() const noexcept { return torsion_; }
  /// sum p r A: torsion at which all slides about the centre, over mu [N m].
  [[nodiscard]] double lever() const {
    double sum = 0.0;
    for (const std::size_t cell : cells_)
      sum += area() * std::max(p(cell), 0.0) * std::hypot(y(cell), z(cell));
    return sum;
  }
  [[nodiscard]] bool drags() const noexcept { return own_.size() > count_; }
  [[nodiscard]] std::span<const std::size_t> cells() const noexcept { return cells_; }

  [[nodiscard]] double p(std::size_t cell) const { return own_[cell]; }
  [[nodiscard]] double q_y(std::size_t cell) const { return own_[count_ + cell]; }
  [[nodiscard]] double q_z(std::size_t cell) const { return own_[2 * count_ + cell]; }
  /// From the centre of pressure [m].
  [[nodiscard]] double y(std::size_t cell) const {
    return grid_.y(cell / grid_.columns) - centre_.y;
  }
  [[nodiscard]] double z(std::size_t cell) const {
    return grid_.z(cell % grid_.columns) - centre_.z;
  }
  [[nodiscard]] double area() const { return grid_.area(); }

  /// The gradient of a result that changes by `of(cell, component)` per Pa.
  [[nodiscard]] Gradient gradient(const auto& of) const {
    Gradient all(own_.size());
    for (const std::size_t cell : cells_)
      for (std::size_t u = 0; u * count_ < own_.size(); ++u) all[u * count_ + cell] = of(cell, u);
    return all;
  }
  [[nodiscard]] Gradient of_force(std::size_t component) const {
    return gradient([&](std::size_t, std::size_t u) { return u == component ? area() : 0.0; });
  }
  [[nodiscard]] Gradient of_centre(bool along_z) const {
    const double share = area() / wrench_.force[0];
    return gradient([&](std::size_t cell, std::size_t u) {
      return u == 0 ? share * (along_z ? z(cell) : y(cell)) : 0.0;
    });
  }
  [[nodiscard]] Gradient of_torsion() const {
    const auto& force = wrench_.force;
    return gradient([&](std::size_t cell, std::size_t u) {
      const double on_centre = force[1] / force[0] * z(cell) - force[2] / force[0] * y(cell);
      return area() * (u == 0 ? on_centre : u == 1 ? -z(cell) : y(cell));
    });
  }
  /// Of a single cell.
  [[nodiscard]] Gradient at(std::size_t cell, double on_p, double on_y, double on_z) const {
    Gradient all(own_.size());
    all[cell] = on_p;
    if (drags()) {
      all[count_ + cell] = on_y;
      all[2 * count_ + cell] = on_z;
    }
    return all;
  }

 private:
  /// By pressures over the largest one: neither forces nor moments need be of a size.
  SkinWrench::Centre centre_of_pressure() {
    double most = 0.0;
    for (const std::size_t cell : cells_) most = std::max(most, std::abs(p(cell)));
    if (!(most > 0.0)) return {};
    double all = 0.0;
    double sizes = 0.0;
    SkinWrench::Centre sum;
    for (const std::size_t cell : cells_) {
      const double share = p(cell) / most;
      all += share;
      sizes += std::abs(share);
      sum.y += share * grid_.y(cell / grid_.columns);
      sum.z += share * grid_.z(cell % grid_.columns);
    }
    presses_ = all > 1e-12 * sizes;  // pushes and pulls that cancel leave rounding, and no centre
    return presses_ ? SkinWrench::Centre{sum.y / all, sum.z / all} : SkinWrench::Centre{};
  }

  const SurfaceGrid& grid_;
  std::size_t count_;
  std::span<const std::size_t> cells_;
  std::vector<double> own_;
  SkinWrench wrench_{};
  SkinWrench::Centre centre_{};
  bool presses_ = false;
  double torsion_ = 0.0;
};

/// A value, and how it errs.
struct Result {
  double value;
  Gradient gradient;
};

/// Of several at once: they share what the covariance has to read.
std::vector<Uncertain> uncertain(std::span<const Result> results, const Covariance& covariance,
                                 double noise_rms) {
  std::vector<Gradient> gradients;
  for (const Result& one : results) gradients.push_back(one.gradient);
  const std::vector<double> deviations = covariance.deviations_of(gradients);
  std::vector<Uncertain> all;
  for (std::size_t i = 0; i < results.size(); ++i)
    all.push_back({results[i].value, deviations[i] * noise_rms});
  return all;
}

/// a x + b y of gradients.
Gradient sum(double a, const Gradient& x, double b, const Gradient& y) {
  Gradient all(x.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = a * x[i] + b * y[i];
  return all;
}

/// |q| / p of a cell. @pre  p > 0
Result ratio_at(const Contact& contact, std::size_t cell) {
  const double p = contact.p(cell);
  const double y = contact.q_y(cell);
  const double z = contact.q_z(cell);
  const double drag = std::hypot(y, z);
  const double over = drag > 0.0 ? 1.0 / drag / p : 0.0;
  return {drag / p, contact.at(cell, -drag / p / p, y * over, z * over)};
}

/// The cell at which the cells of smaller |q| / p bear 90 % of the force. Of cells with the same
/// |q| / p, as all that slide have, the one that bears most, whatever order rounding gives them.
std::size_t ninety_percent(const Contact& contact) {
  std::vector<std::size_t> order;
  double all = 0.0;
  for (const std::size_t cell : contact.cells())
    if (contact.p(cell) > 0.0) {
      order.push_back(cell);
      all += contact.p(cell);
    }
  const auto ratio = [&](std::size_t cell) {
    return std::hypot(contact.q_y(cell), contact.q_z(cell)) / contact.p(cell);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ratio(a) < ratio(b); });
  constexpr double same = 1.0 + 1e-6;
  double borne = 0.0;
  auto at = order.begin();
  while (at + 1 != order.end() && (borne += contact.p(*at)) < 0.9 * all) ++at;
  const double found = ratio(*at);
  const auto first = std::find_if(order.begin(), order.end(),
                                  [&](std::size_t cell) { return ratio(cell) * same >= found; });
  const auto last =
      std::find_if(at, order.end(), [&](std::size_t cell) { return ratio(cell) > found * same; });
  return *std::max_element(
      first, last, [&](std::size_t a, std::size_t b) { return contact.p(a) < contact.p(b); });
}

/// The cells of the contact that needs the most friction, and how many it is one of.
struct NearestToSlipping {
  std::vector<std::size_t> cells;
  std::size_t contacts;
};

/// One contact alone has all cells, those of nothing beside it too.
/// @param torsion  counts too
NearestToSlipping nearest_to_slipping(const SurfaceGrid& grid, std::span<const double> tractions,
                                      std::span<const std::size_t> cells, bool torsion) {
  NearestToSlipping nearest{{cells.begin(), cells.end()}, 0};
  double strongest = 0.0;
  double most = -1.0;
  for (std::vector<std::size_t>& patch : separate_contacts(grid, tractions, cells)) {
    const Contact contact(grid, tractions, patch);
    const auto& force = contact.wrench().force;
    strongest = std::max(strongest, force[0]);
    if (!contact.presses() || !(force[0] > least_share * strongest)) continue;
    ++nearest.contacts;
    const double lever = contact.lever();
    const double twist = torsion && lever > 0.0 ? contact.torsion() / lever : 0.0;
    const double needed = std::hypot(std::hypot(force[1], force[2]) / force[0], twist);
    if (!(needed > most)) continue;
    most = needed;
    nearest.cells = std::move(patch);
  }
  if (nearest.contacts < 2) return {{cells.begin(), cells.end()}, 1};
  return nearest;
}

}  // namespace

UncertainWrench resultant_of(const SurfaceGrid& grid, std::span<const double> tractions,
                             std::span<const std::size_t> cells, const Covariance& covariance,
                             double noise_rms) {
  const Contact contact(grid, tractions, cells);
  const auto& force = contact.wrench().force;
  std::vector<Gradient> gradients;
  std::vector<std::size_t> places;  // of each in the covariance
  const auto differentiated = [&](std::size_t place, Gradient gradient) {
    gradients.push_back(std::move(gradient));
    places.push_back(place);
  };
  differentiated(0, contact.of_force(0));
  if (contact.drags()) {
    differentiated(1, contact.of_force(1));
    differentiated(2, contact.of_force(2));
  }
  if (contact.presses()) {
    differentiated(3, contact.of_centre(false));
    differentiated(4, contact.of_centre(true));
    // In a unit of length of 1e-150 m it is no number.
    if (contact.drags() && std::isfinite(contact.torsion()))
      differentiated(5, contact.of_torsion());
  }
  std::array<double, 6> deviations{};
  const std::vector<double> found = covariance.deviations_of(gradients);
  for (std::size_t i = 0; i < found.size(); ++i) deviations[places[i]] = found[i] * noise_rms;
  UncertainWrench result;
  result.normal = {force[0], deviations[0]};
  if (contact.drags()) {
    result.tangential_y = {force[1], deviations[1]};
    result.tangential_z = {force[2], deviations[2]};
  }
  if (contact.presses()) {
    result.centre_y = {contact.centre().y, deviations[3]};
    result.centre_z = {contact.centre().z, deviations[4]};
    if (places.back() == 5) result.torsion = {contact.torsion(), deviations[5]};
  }
  const Matrix joint = covariance.covariances(gradients);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j)
      result.covariance[6 * places[i] + places[j]] = joint(i, j) * noise_rms * noise_rms;
  return result;
}

std::optional<SkinFriction> friction_of(const SurfaceGrid& grid, std::span<const double> tractions,
                                        std::span<const std::size_t> cells,
                                        const Covariance& covariance, double noise_rms,
                                        std::optional<double> limit) {
  if (limit && !(*limit > 0.0)) throw std::invalid_argument("friction limit must be > 0");
  const Contact all(grid, tractions, cells);
  if (!all.presses() || !all.drags()) return std::nullopt;
  const NearestToSlipping nearest = nearest_to_slipping(grid, tractions, cells, limit.has_value());
  const Contact contact(grid, tractions, nearest.cells);
  const auto& force = contact.wrench().force;
  const double drag = std::hypot(force[1], force[2]);
  const double along_y = drag > 0.0 ? force[1] / drag : 1.0;
  const double along_z = drag > 0.0 ? force[2] / drag : 0.0;
  const double ratio = drag / force[0];
  const Gradient of_drag = sum(along_y, contact.of_force(1), along_z, contact.of_force(2));
  const Gradient of_ratio = sum(1.0 / force[0], of_drag, -ratio / force[0], contact.of_force(0));

  SkinFriction friction{
      .contacts = nearest.contacts, .lever = contact.lever(), .lever_of_all = all.lever()};
  if (nearest.contacts > 1)
    friction.wrench = resultant_of(grid, tractions, nearest.cells, covariance, noise_rms);
  std::vector<Result> results{{ratio, of_ratio}, ratio_at(contact, ninety_percent(contact))};
  if (limit) {
    const double slide = ratio / *limit;
    const double most = *limit * friction.lever;
    const double twist = most > 0.0 ? contact.torsion() / most : 0.0;
    const double used = std::hypot(slide, twist);
    // The lever's own error is of second order beside the torsion's.
    const Gradient of_slip_margin =
        used > 0.0 ? sum(-slide / used / *limit, of_ratio, most > 0.0 ? -twist / used / most : 0.0,
                         contact.of_torsion())
                   : Gradient(tractions.size());
    results.push_back({1.0 - used, of_slip_margin});
  }
  const std::vector<Uncertain> told = uncertain(results, covariance, noise_rms);
  friction.ratio = told[0];
  friction.least_limit = told[1];
  if (!limit) return friction;
  friction.slip_margin = told[2];
  // Some at a time: of a large skin a weight for every traction and cell would be gigabytes.
  constexpr std::size_t most_weights = std::size_t{1} << 20;
  const std::size_t batch = std::max<std::size_t>(most_weights / tractions.size(), 1);
  std::vector<Gradient> of_cells;
  std::size_t done = 0;
  const auto add_deviations = [&] {
    for (const double deviation : covariance.deviations_of(of_cells))
      friction.cell_margins[done++].deviation = deviation * noise_rms;
    of_cells.clear();
  };
  for (const std::size_t cell : cells) {
    const double q = std::hypot(all.q_y(cell), all.q_z(cell));
    const double over = q > 0.0 ? -1.0 / q : 0.0;
    friction.cell_margins.push_back({*limit * all.p(cell) - q, 0.0});
    of_cells.push_back(all.at(cell, *limit, all.q_y(cell) * over, all.q_z(cell) * over));
    if (of_cells.size() == batch) add_deviations();
  }
  add_deviations();
  return friction;
}

std::optional<ContactEllipse> contact_ellipse(const SurfaceGrid& grid,
                                              std::span<const double> tractions,
                                              std::span<const std::size_t> cells,
                                              const Covariance& covariance, double noise_rms,
                                              PressureLaw law) {
  const Contact contact(grid, tractions, cells);
  if (!contact.presses()) return std::nullopt;
  const double force = contact.wrench().force[0];
  const auto moment = [&](const auto& square) {
    double all = 0.0;
    for (const std::size_t cell : cells) all += contact.p(cell) * square(cell);
    return all * contact.area() / force;
  };
  const double yy = moment([&](std::size_t i) { return contact.y(i) * contact.y(i); });
  const double zz = moment([&](std::size_t i) { return contact.z(i) * contact.z(i); });
  const double yz = moment([&](std::size_t i) { return contact.y(i) * contact.z(i); });
  const double half = std::hypot(0.5 * (yy - zz), yz);
  const double longer = 0.5 * (yy + zz) + half;
  const double shorter = 0.5 * (yy + zz) - half;
  if (!(shorter > 0.0)) return std::nullopt;
  double angle = 0.5 * std::atan2(2.0 * yz, yy - zz);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto on_p = [&](const auto& of) {
    return contact.gradient([&](std::size_t cell, std::size_t u) {
      const double v = c * contact.y(cell) + s * contact.z(cell);
      const double w = c * contact.z(cell) - s * contact.y(cell);
      return u == 0 ? contact.area() / force * of(v, w) : 0.0;
    });
  };
  constexpr std::array squares{5.0, 4.0, 3.0};  // a^2 over the variance, by law
  const double square = squares[static_cast<std::size_t>(law)];
  const double a = std::sqrt(square * longer);
  const double b = std::sqrt(square * shorter);
  std::vector<Result> results{
      {a, on_p([&](double v, double) { return 0.5 * square / a * (v * v - longer); })},
      {b, on_p([&](double, double w) { return 0.5 * square / b * (w * w - shorter); })}};
  if (half > 0.0)
    results.push_back({angle, on_p([&](double v, double w) { return 0.5 * v * w / half; })});
  const std::vector<Uncertain> all = uncertain(results, covariance, noise_rms);
  return ContactEllipse{.radius = all[0],
                        .second_radius = all[1],
                        // Of a circle any.
                        .angle = half > 0.0 ? all[2] : Uncertain{0.0, std::numbers::pi}};
}

std::vector<ContactPatch> patches_of(const SurfaceGrid& grid, std::span<const double> tractions,
                                     std::span<const std::vector<std::size_t>> contacts,
                                     const Covariance& covariance, double noise_rms,
                                     const PatchOptions& options) {
  constexpr double hertz = 5.0;  // the radius' square over the variance of place
  std::vector<ContactPatch> patches;
  for (const std::vector<std::size_t>& cells : contacts) {
    const Contact contact(grid, tractions, cells);
    ContactPatch patch{.cells = cells,
                       .wrench = resultant_of(grid, tractions, cells, covariance, noise_rms),
                       .lever = contact.lever()};
    judge_slip(patch, options.friction_limit);
    patch.ellipse = contact_ellipse(grid, tractions, cells, covariance, noise_rms);
    double share = options.smoothed_variance > 0.0 ? 0.0 : 1.0;  // of the area, without smoothing
    if (patch.ellipse) {
      const auto least_share_of = [&](const Uncertain& radius) {
        return share_without(radius.value * radius.value / hertz, options.smoothed_variance);
      };
      Uncertain& radius = patch.ellipse->radius;
      Uncertain& second = patch.ellipse->second_radius;
      const double of_radius = least_share_of(radius);
      const double of_second = least_share_of(second);
      share = of_radius * of_second;
      radius = down_to(radius, radius.value * of_radius, options.is_mean);
      second = down_to(second, second.value * of_second, options.is_mean);
    }
    std::vector<double> pressures;
    for (const std::size_t cell : cells) pressures.push_back(contact.p(cell));
    if (const std::optional<Extent> extent = extent_of(pressures, grid.area())) {
      Gradient gradient(tractions.size());
      for (std::size_t i = 0; i < cells.size(); ++i) gradient[cells[i]] = extent->gradient[i];
      const std::vector<Result> area{{extent->value, std::move(gradient)}};
      patch.extent = down_to(uncertain(area, covariance, noise_rms).front(), share * extent->value,
                             options.is_mean);
    }
    patches.push_back(std::move(patch));
  }
  std::stable_sort(patches.begin(), patches.end(), [](const auto& a, const auto& b) {
    return a.wrench.normal.value > b.wrench.normal.value;
  });
  return patches;
}

ContactPatch on_grid(ContactPatch patch, const SurfaceGrid& from, const SurfaceGrid& to) {
  const auto nearest = [](double place, double first, double spacing, std::size_t count) {
    const double at = std::round((place - first) / spacing);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  for (std::size_t& cell : patch.cells) {
    const std::size_t row = nearest(from.y(cell / from.columns), to.y(0), to.spacing_y, to.rows);
    cell =
        row * to.columns + nearest(from.z(cell % from.columns), to.z(0), to.spacing_z, to.columns);
  }
  std::sort(patch.cells.begin(), patch.cells.end());
  patch.cells.erase(std::unique(patch.cells.begin(), patch.cells.end()), patch.cells.end());
  return patch;
}

}  // namespace tactile_net
