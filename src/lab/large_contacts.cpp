#include "lab/large_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lab/skin_constraint_bias.hpp"
#include "tactile_net/skin/large/cone.hpp"
#include "tactile_net/skin/large/face.hpp"
#include "tactile_net/skin/large/family.hpp"

namespace tactile_net::lab {
namespace {

/// Rows and columns that cells lie in.
struct Box {
  std::size_t first_row, last_row, first_column, last_column;

  [[nodiscard]] bool is_near(const Box& other, std::size_t rows,
                             std::size_t columns) const noexcept {
    return first_row <= other.last_row + rows && other.first_row <= last_row + rows &&
           first_column <= other.last_column + columns &&
           other.first_column <= last_column + columns;
  }
};

Box box_of(const SurfaceGrid& grid, std::span<const std::size_t> cells) {
  Box box{grid.rows, 0, grid.columns, 0};
  for (const std::size_t cell : cells) {
    box.first_row = std::min(box.first_row, cell / grid.columns);
    box.last_row = std::max(box.last_row, cell / grid.columns);
    box.first_column = std::min(box.first_column, cell % grid.columns);
    box.last_column = std::max(box.last_column, cell % grid.columns);
  }
  return box;
}

/// Those whose boxes are within reach of each other are one.
std::vector<std::vector<std::size_t>> joined(const SurfaceGrid& grid,
                                             std::vector<std::vector<std::size_t>> groups,
                                             double reach) {
  const auto rows = static_cast<std::size_t>(std::ceil(reach / grid.spacing_y));
  const auto columns = static_cast<std::size_t>(std::ceil(reach / grid.spacing_z));
  for (std::size_t i = 0; i < groups.size();) {
    const Box own = box_of(grid, groups[i]);
    const auto near = std::find_if(groups.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                   groups.end(), [&](const std::vector<std::size_t>& other) {
                                     return own.is_near(box_of(grid, other), rows, columns);
                                   });
    if (near == groups.end()) {
      ++i;
      continue;
    }
    groups[i].insert(groups[i].end(), near->begin(), near->end());
    groups.erase(near);
    i = 0;  // a larger box may reach one that was passed
  }
  return groups;
}

/// What stands at these cells, of every traction; 0 elsewhere.
std::vector<double> at_cells(std::span<const double> all, std::span<const std::size_t> cells,
                             std::size_t count) {
  std::vector<double> some(all.size());
  for (const std::size_t cell : cells)
    for (std::size_t i = cell; i < some.size(); i += count) some[i] = all[i];
  return some;
}

bool measures_anything(const LinearProblem& problem) {
  return std::any_of(problem.weights.begin(), problem.weights.end(),
                     [](double weight) { return weight > 0.0; });
}

}  // namespace

LargeContacts::LargeContacts(const LinearProblem& whole,
                             const std::vector<std::vector<std::size_t>>& contacts, double reach,
                             const Cut& cut)
    : cells_(whole.grid.count()) {
  for (std::vector<std::size_t>& cells : joined(whole.grid, contacts, reach)) {
    LargeSkinPart part = cut(cells);
    groups_.push_back({std::move(cells), std::move(part)});
  }
}

/// Sums of the variances of each.
class LargeContacts::OfGroups final : public Covariance {
 public:
  struct One {
    const std::vector<std::size_t>* cells;
    std::unique_ptr<const Covariance> covariance;
  };

  OfGroups(std::size_t cells, const Covariance& free, std::vector<One> all)
      : cells_(cells), free_(free), all_(std::move(all)) {}

  [[nodiscard]] std::vector<double> deviations() const override { return free_.deviations(); }
  [[nodiscard]] double deviation(std::span<const double> weights) const override {
    double size = 0.0;
    for (const One& one : all_)
      size = std::hypot(size, one.covariance->deviation(own(one, weights)));
    return size;
  }
  [[nodiscard]] double covariance(std::span<const double> a,
                                  std::span<const double> b) const override {
    double sum = 0.0;
    for (const One& one : all_) sum += one.covariance->covariance(own(one, a), own(one, b));
    return sum;
  }
  [[nodiscard]] double degrees_of_freedom() const noexcept override {
    double sum = 0.0;
    for (const One& one : all_) sum += one.covariance->degrees_of_freedom();
    return sum;
  }

 private:
  [[nodiscard]] std::vector<double> own(const One& one, std::span<const double> weights) const {
    return at_cells(weights, *one.cells, cells_);
  }

  std::size_t cells_;
  const Covariance& free_;
  std::vector<One> all_;
};

std::unique_ptr<const Covariance> LargeContacts::covariance(
    const ActiveFace& face,
    const std::function<std::vector<double>(const LargeSkinPart&)>& readings, double alpha,
    const std::function<double(const FilterFrame&)>& prior, const Covariance& free) const {
  std::vector<OfGroups::One> all;
  for (const Group& group : groups_) {
    const ActiveFace own = group.part.face(face);
    if (own.free.empty() || !measures_anything(problem_of(*group.part.system()))) return nullptr;
    const LargeSkinFamily family(group.part.system(), own);
    const double prior_alpha = prior(family.analyse(readings(group.part)));
    all.push_back({&group.cells, std::make_unique<LargeSkinFaceCovariance>(
                                     group.part, own, alpha, prior_alpha,
                                     family.degrees_of_freedom(alpha), free)});
  }
  return std::make_unique<OfGroups>(cells_, free, std::move(all));
}

double LargeContacts::bias(std::span<const double> tractions, double alpha,
                           const Constraints& constraints, double noise_rms) const {
  double put_in = 0.0;
  double too_much = 0.0;
  for (const Group& group : groups_) {
    const LargeSkinPart& part = group.part;
    const std::vector<double> own = part.tractions(at_cells(tractions, group.cells, cells_));
    double pressed = 0.0;
    std::vector<std::size_t> cells;
    for (const std::size_t cell : group.cells) {
      pressed += tractions[cell];
      cells.push_back(part.cell(cell));
    }
    const LargeSkinCone cone(part.system(), alpha, constraints);
    const double share = constraint_bias(
        {.tractions = own,
         .cells = cells,
         .weights = problem_of(*part.system()).weights,
         .read = weighted_product(*part.system(), own)},
        [&](std::span<const double> again) { return cone.solve(again); }, noise_rms);
    put_in += pressed;
    too_much += share * pressed;
  }
  return put_in > 0.0 ? std::clamp(too_much / put_in, -0.5, 0.5) : 0.0;
}

}  // namespace tactile_net::lab
