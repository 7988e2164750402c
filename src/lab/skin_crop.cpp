#include "lab/skin_crop.hpp"

#include <algorithm>
#include <cmath>

#include "inverse/checks.hpp"

namespace tactile_net::lab {
namespace {

/// Tractions of the part, at most: it is decomposed for each weight that is tried.
constexpr std::size_t most_part = 1200;

/// Taxels [first, first + count) about one, of so many.
struct TaxelRange {
  std::size_t first, count;
  [[nodiscard]] bool has(std::size_t i) const noexcept { return i >= first && i < first + count; }
};

TaxelRange about(std::size_t middle, std::size_t wanted, std::size_t all) {
  const std::size_t count = std::min(wanted, all);
  const std::size_t before = std::min(middle, count / 2);
  return {std::min(middle - before, all - count), count};
}

}  // namespace

SkinCrop strongest_part(const SkinSceneProblem& problem, std::span<const double> readings) {
  const SkinScene& whole = problem.scene();
  const LinearProblem& layout = problem.layout();
  check_readings(readings, layout.sites.size());
  std::vector<double> squares(layout.taxels);
  for (std::size_t i = 0; i < readings.size(); ++i)
    squares[layout.sites[i].taxel] =
        std::hypot(squares[layout.sites[i].taxel], layout.weights[i] * readings[i]);
  const auto strongest =
      static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
  const std::size_t columns = whole.sensor.columns;

  SkinCrop crop{.scene = whole};
  SkinArray& part = crop.scene.sensor;
  crop.scene.reconstruct.smoothing_length = layout.smoothing_length;
  crop.scene.reconstruct.tangential = true;
  crop.scene.contacts.clear();
  crop.scene.trajectories.clear();
  TaxelRange rows{};
  TaxelRange across{};
  for (std::size_t side = 24; side >= 4; --side) {
    rows = about(strongest / columns, side, whole.sensor.rows);
    across = about(strongest % columns, side, columns);
    part.rows = rows.count;
    part.columns = across.count;
    if (3 * grid(crop.scene).count() <= most_part) break;
  }
  crop.scene.dead_taxels.clear();
  for (const std::size_t dead : whole.dead_taxels)
    if (rows.has(dead / columns) && across.has(dead % columns))
      crop.scene.dead_taxels.push_back((dead / columns - rows.first) * across.count +
                                       dead % columns - across.first);
  for (const Channel& channel : channels(whole.sensor))
    for (std::size_t row = rows.first; row < rows.first + rows.count; ++row)
      for (std::size_t column = across.first; column < across.first + across.count; ++column)
        crop.readings.push_back(readings[channel.first + row * columns + column]);
  return crop;
}

}  // namespace tactile_net::lab
