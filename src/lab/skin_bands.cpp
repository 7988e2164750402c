#include "lab/skin_bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "lab/large_skin.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/skin_constraint_bias.hpp"
#include "numeric/robust.hpp"
#include "tactile_net/inverse/covariance.hpp"
#include "tactile_net/inverse/data_verdict.hpp"
#include "tactile_net/inverse/stabiliser.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/skin/space_wrench.hpp"

namespace tactile_net::lab {
namespace {

/// Of the prior that sizes the bands, or where its rule has no verdict the tractions' own.
AlphaChoice prior_of(const FilterFrame& frame, const AlphaTables& tables, double alpha,
                     std::optional<double> stated) {
  AlphaChoice prior = choose_alone(frame, tables, prior_rule(stated.has_value()), stated);
  if (prior.verdict != AlphaVerdict::ok) prior.alpha = alpha;
  return prior;
}

/// Whether the sum over cells is certain, though no single one may be: cells that are narrow for
/// their depth share what is told of them. Under constraints noise can only push: of it the sum is
/// some deviations, and not as many as are asked for.
bool is_certain(const Uncertain& force) {
  constexpr double deviations = 6.0;
  return force.value > deviations * force.deviation;
}
bool is_felt(const Uncertain& force) {
  constexpr double deviations = 2.0;
  return force.value > deviations * force.deviation;
}

/// Of sums over windows as wide as what a taxel looks at, without constraints: noise moves a sum
/// that may only be pushed no further.
WindowBands windows_of(const SkinSceneProblem& problem, const CellCovariance& covariance,
                       double rms) {
  const SurfaceGrid& grid = problem.grid();
  WindowBands bands{.window = window_of(grid, least_depth(problem.scene().sensor))};
  bands.deviations = covariance.window_deviations(grid, bands.window);
  for (double& deviation : bands.deviations) deviation *= rms;
  return bands;
}

/// The deviation of what presses in some cells, over the one that it had before the readings.
double assumed_share(const SkinSceneProblem& problem, const Covariance& covariance, double prior,
                     std::span<const std::size_t> cells) {
  std::vector<double> sum(problem.tractions());
  for (const std::size_t cell : cells) sum[cell] = 1.0;
  return covariance.deviation(sum) / prior_deviation(problem.layout(), sum, prior);
}

/// Makes deviations small enough for the highest pressure to be certain.
void scale_to_peak(std::vector<double>& deviations, std::span<const double> pressure) {
  const auto peak = static_cast<std::size_t>(std::max_element(pressure.begin(), pressure.end()) -
                                             pressure.begin());
  const double certain = 0.2 * pressure[peak];
  if (!(deviations[peak] > certain)) return;
  const double factor = certain / deviations[peak];
  for (double& deviation : deviations) deviation *= factor;
}

/// Taxels that lie further apart than this, in depths: it is constraints that decide how much
/// presses between them, and without these the place of what does.
constexpr double between_taxels = 1.25;

/// What the place of a narrow contact changes in the sum of what taxels so far apart read of it,
/// over that sum, rms: the longest waves that look even at their places. Such readings do not tell
/// how narrow a contact is.
///
/// @param pitch  in depths
double hidden_by_place(double pitch) {
  const double wave = 2.0 * std::numbers::pi / pitch;
  return 2.0 * (1.0 + wave) * std::exp(-wave);
}

/// What noise adds to a cell that touches nothing, on average [Pa]: under constraints it can only
/// push there.
double pushed_by_noise(std::span<const double> tractions, std::span<const std::size_t> cells,
                       const std::vector<bool>& unseen) {
  std::vector<bool> empty(unseen.size(), true);
  for (const std::size_t cell : cells) empty[cell] = false;
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t cell = 0; cell < empty.size(); ++cell) {
    if (!empty[cell] || unseen[cell]) continue;
    sum += tractions[cell];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// What constraints let noise do to a contact.
struct Pushed {
  double taken = 0.0;  ///< from the pressure of each of its cells [Pa]
  double doubt = 0.0;  ///< of its force, beside the deviation [N]
};

/// An unknown offset hides a pressure all over the skin, and where nothing may pull it can only be
/// added: what cells that touch nothing hold of it is no contact's, and is taken away.
Pushed pushed_in(const SkinSceneProblem& problem, std::span<const double> tractions,
                 std::span<const std::size_t> cells) {
  if (!problem.layout().unknown_offsets) return {};
  const double each = pushed_by_noise(tractions, cells, problem.unseen());
  return {each, 0.5 * each * problem.grid().area() * static_cast<double>(cells.size())};
}

/// How much further apart a force under constraints and the one without them are than noise makes
/// them [N]: what constraints may have moved it by, where solving again does not tell.
double moved_by_constraints(const Uncertain& held, const Uncertain& free) {
  const double apart = std::abs(held.value - free.value);
  return apart > free.deviation
             ? std::sqrt(apart - free.deviation) * std::sqrt(apart + free.deviation)
             : 0.0;
}

/// A face on which the cells beside those that press may press too: which of them do nobody knows
/// better than by a cell.
ActiveFace with_cells_beside(ActiveFace face, const SurfaceGrid& grid) {
  std::vector<bool> presses(grid.count());
  for (const ActiveFace::Direction& one : face.free)
    if (one.along[0] != 0.0) presses[one.cell] = true;
  std::vector<std::size_t> pressed;
  for (std::size_t cell = 0; cell < presses.size(); ++cell)
    if (presses[cell]) pressed.push_back(cell);
  for (const std::size_t cell : with_neighbours(grid, pressed))
    if (!presses[cell]) face.free.push_back({cell, {1.0, 0.0, 0.0}});
  return face;
}

void doubt_force(FrameAnswer& answer, double doubt) {
  Uncertain& force = answer.wrench.normal;
  force.deviation = std::hypot(force.deviation, doubt);
  answer.wrench.covariance[0] += doubt * doubt;
  if (!answer.friction) return;
  Uncertain& ratio = answer.friction->ratio;
  ratio.deviation = std::hypot(ratio.deviation, ratio.value * (doubt / force.value));
  if (!answer.friction->wrench) return;
  Uncertain& part = answer.friction->wrench->normal;
  const double share = part.value * (doubt / force.value);
  part.deviation = std::hypot(part.deviation, share);
  answer.friction->wrench->covariance[0] += share * share;
}

/// One contact is the whole, with all its doubts; of several each has its share of the force's. The
/// whole's margin is its worst contact's.
void doubt_patches(FrameAnswer& answer, double doubt, std::optional<double> limit) {
  const double force = answer.wrench.normal.value;
  for (ContactPatch& patch : answer.patches) {
    Uncertain& part = patch.wrench.normal;
    const double share = force > 0.0 ? part.value * (doubt / force) : 0.0;
    part.deviation = std::hypot(part.deviation, share);
    patch.wrench.covariance[0] += share * share;
    if (answer.patches.size() == 1) patch.wrench = answer.wrench;
    judge_slip(patch, limit);
  }
  const ContactPatch* const worst = nearest_to_slipping(answer.patches);
  if (worst != nullptr && answer.friction &&
      (answer.friction->contacts > 1 || answer.patches.size() == 1))
    answer.friction->slip_margin = worst->slip_margin;
}

/// What stands out of the map beside the contact's cells, and these leave out: a contact that is
/// weak for the strongest one. It may be there, or not: every sum's deviation holds it. Where
/// several stand out they are there, or not, one by one.
void doubt_what_is_left_out(UncertainWrench& wrench, const SurfaceGrid& grid,
                            std::span<const double> tractions, std::span<const std::size_t> cells,
                            const std::vector<bool>& unseen) {
  constexpr double quiet_share = 0.9;  // of the cells beside the contact
  constexpr double outstanding = 1.5;  // times what these have at most
  std::vector<bool> beside(unseen.size());
  for (std::size_t cell = 0; cell < beside.size(); ++cell) beside[cell] = !unseen[cell];
  for (const std::size_t cell : cells) beside[cell] = false;
  std::vector<double> sizes;
  for (std::size_t cell = 0; cell < beside.size(); ++cell)
    if (beside[cell]) sizes.push_back(std::abs(tractions[cell]));
  if (sizes.empty() || wrench.normal.value == 0.0) return;
  const double least = outstanding * quantile(std::move(sizes), quiet_share);
  // What adjoins the contact is its own rim.
  for (const std::size_t cell : with_neighbours(grid, cells)) beside[cell] = false;
  std::vector<std::size_t> left_out;
  for (std::size_t cell = 0; cell < beside.size(); ++cell)
    if (beside[cell] && tractions[cell] > least) left_out.push_back(cell);
  const auto widen = [&](std::size_t at, Uncertain& sum, double doubt) {
    sum.deviation = std::hypot(sum.deviation, doubt);
    wrench.covariance[7 * at] += doubt * doubt;
  };
  for (const std::vector<std::size_t>& patch : separate_contacts(grid, tractions, left_out)) {
    double share = 0.0;  // of the force that was found: a force times a length may be too large
    double y = 0.0;      // by how much the centre would move
    double z = 0.0;
    std::array<double, 2> drags{};
    for (const std::size_t cell : patch) {
      const double part = grid.area() * tractions[cell] / wrench.normal.value;
      share += part;
      if (wrench.centre_y) y += part * (grid.y(cell / grid.columns) - wrench.centre_y->value);
      if (wrench.centre_z) z += part * (grid.z(cell % grid.columns) - wrench.centre_z->value);
      for (std::size_t u = 0; u < drags.size() && wrench.tangential_y; ++u)
        drags[u] += grid.area() * tractions[(u + 1) * grid.count() + cell];
    }
    widen(0, wrench.normal, share * wrench.normal.value);
    if (wrench.tangential_y) widen(1, *wrench.tangential_y, drags[0]);
    if (wrench.tangential_z) widen(2, *wrench.tangential_z, drags[1]);
    if (wrench.centre_y) widen(3, *wrench.centre_y, y);
    if (wrench.centre_z) widen(4, *wrench.centre_z, z);
  }
}

/// The force that cells beside the contact may hold, by the drag that they hold [N]: readings that
/// tell drags better than pressure, such as moves along the surface, do not tell which cells touch,
/// and what drags presses. It is no more than what they leave of all pressure.
///
/// @param free  without constraints
double pressed_where_it_drags(const UncertainWrench& wrench, const SurfaceGrid& grid,
                              std::span<const double> tractions, std::span<const std::size_t> cells,
                              const std::vector<bool>& unseen, const Covariance& free, double rms) {
  constexpr double drag_deviations = 1.0;   // that make it likely to be no noise
  constexpr double force_deviations = 3.0;  // that hold a force
  constexpr double least_friction = 0.2;    // of contacts that drag; what is found may be none
  if (!wrench.tangential_y || !wrench.tangential_z || !(wrench.normal.value > 0.0)) return 0.0;
  std::vector<bool> beside(unseen.size());
  for (std::size_t cell = 0; cell < beside.size(); ++cell) beside[cell] = !unseen[cell];
  for (const std::size_t cell : cells) beside[cell] = false;
  std::array<double, 2> drags{};
  for (std::size_t u = 0; u < drags.size(); ++u)
    for (std::size_t cell = 0; cell < beside.size(); ++cell)
      if (beside[cell]) drags[u] += grid.area() * tractions[(u + 1) * grid.count() + cell];
  const double drag = std::hypot(drags[0], drags[1]);
  const double friction =
      std::hypot(wrench.tangential_y->value, wrench.tangential_z->value) / wrench.normal.value;
  const double force = drag / std::clamp(friction, least_friction, usual_friction);
  if (!(force > wrench.normal.deviation)) return 0.0;  // which holds it
  // What all cells hold together is better known than which of them hold it.
  const auto deviation_of_all = [&](std::array<double, 3> along) {
    std::vector<double> sum(tractions.size());
    for (std::size_t u = 0; u < along.size(); ++u)
      for (std::size_t cell = 0; cell < unseen.size(); ++cell)
        if (!unseen[cell]) sum[u * grid.count() + cell] = grid.area() * along[u];
    return rms * free.deviation(sum);
  };
  if (!(drag > drag_deviations * deviation_of_all({0.0, drags[0] / drag, drags[1] / drag})))
    return 0.0;
  return std::min(force, force_deviations * deviation_of_all({1.0, 0.0, 0.0}));
}

/// Where constraints leave a single row or column of cells, its place is what they have decided,
/// not what the readings tell: the deviations are those of the cells beside it too, without
/// constraints, and of a place anywhere in the width of a cell.
void widen_centre(UncertainWrench& wrench, const SurfaceGrid& grid,
                  std::span<const double> tractions, std::span<const std::size_t> cells,
                  const Covariance& free, double rms) {
  if (!wrench.centre_y || !wrench.centre_z) return;
  std::vector<std::size_t> pressed;
  for (const std::size_t cell : cells)
    if (tractions[cell] != 0.0) pressed.push_back(cell);
  const bool one_row = is_one_line(grid, pressed, false);
  const bool one_column = is_one_line(grid, pressed, true);
  if (!one_row && !one_column) return;
  const UncertainWrench wider =
      resultant_of(grid, tractions, with_neighbours(grid, pressed), free, rms);
  const auto widen = [&](std::optional<Uncertain>& centre, const std::optional<Uncertain>& of_more,
                         double spacing) {
    centre->deviation = std::hypot(std::max(centre->deviation, of_more ? of_more->deviation : 0.0),
                                   spacing / std::sqrt(12.0));
  };
  if (one_row) widen(wrench.centre_y, wider.centre_y, grid.spacing_y);
  if (one_column) widen(wrench.centre_z, wider.centre_z, grid.spacing_z);
}

}  // namespace

double sum_over(std::span<const double> values, std::span<const std::size_t> cells) {
  double sum = 0.0;
  for (const std::size_t cell : cells) sum += values[cell];
  return sum;
}

void add_space(UncertainWrench& wrench, const SkinSceneProblem& problem,
               std::span<const double> tractions, std::span<const std::size_t> cells,
               const Covariance& covariance, double noise_rms) {
  const SkinScene& scene = problem.scene();
  if (!scene.sensor.curved) return;
  wrench.space = space_wrench(problem.problem(), tractions, cells, covariance, noise_rms, wrench,
                              scene.reconstruct.moment_about);
}

double smoothed_variance(const SkinSceneProblem& problem, double degrees_of_freedom) {
  const SkinArray& skin = problem.scene().sensor;
  const double depth = least_depth(skin);
  const double y = is_even(skin) && skin.rows == 1 ? depth : skin.pitch_y;
  const double z = is_even(skin) && skin.columns == 1 ? depth : skin.pitch_z;
  const auto components = static_cast<double>(problem.layout().components);
  const double each = degrees_of_freedom / components / static_cast<double>(taxel_count(skin));
  return y * z / std::max(each, 1e-3) / 12.0;
}

double pitch_in_depths(const SkinArray& skin) {
  const double y = !is_even(skin) || skin.rows > 1 ? skin.pitch_y : 0.0;
  const double z = !is_even(skin) || skin.columns > 1 ? skin.pitch_z : 0.0;
  return std::max(y, z) / least_depth(skin);
}

void add_bands(FrameAnswer& answer, const SkinSceneProblem& problem, const SkinMethod& method,
               const FilterFrame& frame, const std::optional<TikhonovFamily>& face,
               std::span<const double> readings) {
  const SurfaceGrid& grid = problem.grid();
  const double alpha = answer.alpha.value;
  // An error of the model counts for noise.
  const double rms = answer.noise.model_rms > 0.0 ? answer.noise.residual_rms : answer.noise.rms();
  const double prior =
      prior_of(frame, problem.alpha_tables(frame), alpha, problem.stated_noise()).alpha;
  const std::unique_ptr<const CellCovariance> free = method.covariance(alpha, prior);
  const CellCovariance& own = *free;
  answer.deviations = own.deviations();
  if (const auto error = method.band_error(own); error && answer.iteration)
    answer.iteration->bands = {error->tractions, error->least, error->most};
  for (double& deviation : answer.deviations) deviation *= rms;

  const auto prior_on_face = [&](const FilterFrame& left) {
    const AlphaTables tables(left.gamma, left.rows, left.shares);
    return prior_of(left, tables, alpha, problem.stated_noise()).alpha;
  };
  const auto covariance_on = [&](const TikhonovFamily& some) {
    return TractionCovariance(some, alpha, prior_on_face(some.analyse(readings)));
  };
  std::optional<TractionCovariance> of_face;
  std::vector<double> touching = answer.deviations;
  if (face) {
    of_face.emplace(covariance_on(*face));
    touching = of_face->deviations();
    for (double& deviation : touching) deviation *= rms;
  }
  const Covariance& covariance = of_face ? static_cast<const Covariance&>(*of_face) : own;
  const std::span<const double> f = answer.tractions;
  // Under constraints the cells around a contact hold what noise pushes there, and nothing pulls.
  const bool on_face = answer.cone && !answer.cone->face.free.empty();
  const double rim = (on_face ? 0.5 : 1.0) * least_depth(problem.scene().sensor);
  // Where nothing may pull an unknown offset presses everywhere, and windows would take it for one
  // contact: there cells alone tell.
  std::optional<WindowBands> windows;
  if (!face || !problem.layout().unknown_offsets) windows = windows_of(problem, own, rms);
  const auto contacts_in = [&](std::span<const double> tractions,
                               std::span<const double> deviations, double beside) {
    return windows ? find_contacts(grid, tractions, deviations, *windows, beside)
                   : FoundContacts{.cells = contact_cells(grid, tractions, deviations, beside)};
  };
  const FoundContacts found = contacts_in(f, touching, rim);
  answer.cells = found.cells;
  // What the pad's formula may be off by is in no reading.
  const double share = rms > 0.0 ? model_share(problem.scene()) / rms : 0.0;
  std::vector<std::size_t> summed;
  if (answer.cells.empty()) {
    summed.resize(grid.count());
    std::iota(summed.begin(), summed.end(), std::size_t{0});
    answer.wrench =
        resultant_of(grid, f, summed,
                     ModelErrorCovariance(covariance, f, problem.layout().components, share), rms);
  }
  if (answer.cells.empty() && is_certain(answer.wrench.normal)) {
    scale_to_peak(touching, f.first(grid.count()));
    answer.cells = contact_cells(grid, f, touching, rim);
  }
  if (answer.cells.empty()) {
    // What no cell is certain of may press beside the taxels that see.
    widen_centre(answer.wrench, grid, f, summed, own, rms);
    if (is_felt(answer.wrench.normal)) answer.unseen = unseen_share(f, summed, problem.unseen());
    answer.assumed = assumed_share(problem, own, prior, summed);
    add_space(answer.wrench, problem, f, summed, covariance, rms);
    return;
  }
  answer.unseen = unseen_share(f, answer.cells, problem.unseen());
  const bool seen = answer.unseen <= most_unseen;
  // Where no taxel sees, what constraints hold is not certain either.
  const double prior_of_contact = contact_prior(prior, answer.cells.size(), grid.count(), seen);
  const std::unique_ptr<const Covariance> of_support = method.covariance(alpha, prior_of_contact);
  const Covariance& of_contact = *of_support;
  answer.assumed = assumed_share(problem, of_contact, prior_of_contact, answer.cells);
  // Nor between taxels that lie far apart, where they decide how much presses.
  const double pitch = pitch_in_depths(problem.scene().sensor);
  const bool held = seen && pitch <= far_apart;
  // Friction's limit holds a contact together; where nothing but pulling is forbidden its rim is
  // not certain.
  const bool loose = on_face && held && !problem.constraints()->friction_limit;
  std::optional<TractionCovariance> of_rim;
  std::optional<LargeContacts> of_parts;
  std::unique_ptr<const Covariance> of_large;
  if (on_face && held && problem.is_large()) {
    of_parts.emplace(problem.large().contacts(separate_contacts(grid, f, answer.cells)));
    of_large = of_parts->covariance(
        loose ? with_cells_beside(answer.cone->face, grid) : answer.cone->face,
        [&](const LargeSkinPart& part) { return problem.large().readings_of(part, readings, f); },
        alpha, prior_on_face, of_contact);
  } else if (loose && face) {
    of_rim.emplace(covariance_on(
        TikhonovFamily(problem.problem(), with_cells_beside(answer.cone->face, grid))));
  }
  const Covariance& by_noise = of_large          ? *of_large
                               : of_rim          ? static_cast<const Covariance&>(*of_rim)
                               : of_face && held ? covariance
                                                 : of_contact;
  std::vector<double> contact(f.begin(), f.end());
  const Pushed pushed = on_face ? pushed_in(problem, f, answer.cells) : Pushed{};
  // A pressure that an offset hides is pushed anew each time, and that is known better.
  const bool solved_again =
      held && !problem.layout().unknown_offsets && (of_large != nullptr || (on_face && face));
  const double bias = !solved_again ? 0.0
                      : of_large    ? of_parts->bias(f, alpha, *problem.constraints(), rms)
                                    : constraint_bias(problem, method, f, answer.cells, alpha, rms);
  for (const std::size_t cell : answer.cells)
    contact[cell] = (1.0 - bias) * contact[cell] - pushed.taken;
  const ModelErrorCovariance with_model(by_noise, contact, problem.layout().components, share);
  const Covariance& known = share > 0.0 ? with_model : by_noise;
  answer.wrench = resultant_of(grid, contact, answer.cells, known, rms);
  widen_centre(answer.wrench, grid, f, answer.cells, of_contact, rms);
  doubt_what_is_left_out(answer.wrench, grid, f, answer.cells, problem.unseen());
  answer.friction = friction_of(grid, contact, answer.cells, known, rms,
                                problem.scene().reconstruct.friction_limit);
  // The contact found is smoother than the true one, and so is what it loses the second time.
  double doubt = std::hypot(pushed.doubt, bias * answer.wrench.normal.value,
                            grid.area() * sum_over(f, found.doubted));
  const bool decided = pitch > between_taxels;
  if (answer.cone && (decided || !solved_again)) {
    const std::vector<double> free_tractions = method.solve(frame, readings, alpha);
    double moved = 0.0;
    if (decided) {
      // A contact between taxels is explained with less force by what presses above them, and that
      // is what constraints leave. Without them other cells touch, and the force is theirs.
      std::vector<std::size_t> cells =
          contacts_in(free_tractions, answer.deviations, least_depth(problem.scene().sensor)).cells;
      if (cells.empty()) cells = answer.cells;
      moved = std::abs(grid.area() * sum_over(free_tractions, cells) - answer.wrench.normal.value);
    } else {
      moved = moved_by_constraints(
          answer.wrench.normal,
          resultant_of(grid, free_tractions, answer.cells, of_contact, rms).normal);
    }
    doubt = std::hypot(doubt, moved);
  }
  if (!answer.cone)
    doubt = std::hypot(
        doubt,
        pressed_where_it_drags(answer.wrench, grid, f, answer.cells, problem.unseen(), own, rms),
        decided ? hidden_by_place(pitch) * answer.wrench.normal.value : 0.0);
  doubt_force(answer, doubt);
  // Of tractions without constraints: these change little of what the readings tell of a size.
  const double smoothed = smoothed_variance(problem, method.degrees_of_freedom(alpha));
  const std::optional<double> limit = problem.scene().reconstruct.friction_limit;
  answer.patches = patches_of(grid, contact, separate_contacts(grid, f, answer.cells), known, rms,
                              {.friction_limit = limit, .smoothed_variance = smoothed});
  if (answer.patches.size() > 1)
    for (ContactPatch& patch : answer.patches)
      widen_centre(patch.wrench, grid, f, patch.cells, of_contact, rms);
  doubt_patches(answer, doubt, limit);
  answer.ellipse = answer.patches.front().ellipse;
  add_space(answer.wrench, problem, contact, answer.cells, known, rms);
  if (answer.patches.size() == 1) {
    answer.patches.front().wrench.space = answer.wrench.space;
    return;
  }
  for (ContactPatch& patch : answer.patches)
    add_space(patch.wrench, problem, contact, patch.cells, known, rms);
}

}  // namespace tactile_net::lab
