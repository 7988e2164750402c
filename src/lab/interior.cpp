#include "tactile_net/lab/interior.hpp"

#include <algorithm>

#include "tactile_net/elasticity/pad_kernel.hpp"

namespace tactile_net::lab {
namespace {

/// The mean of the kernel over each strip, by the midpoints of parts that are narrower than the
/// row is deep.
std::vector<double> row_of(const Scene& scene, Traction component, double depth) {
  const PadKernel kernel(Quantity::stress_x, component, scene.material, depth);
  const Surface strips = surface(scene);
  const double width = strips.spacing;
  const auto count = static_cast<std::ptrdiff_t>(strips.count);
  const int parts = static_cast<int>(std::clamp(4.0 * width / depth, 4.0, 64.0));
  std::vector<double> row;
  for (std::ptrdiff_t lag = 1 - count; lag < count; ++lag) {
    double sum = 0.0;
    for (int part = 0; part < parts; ++part)
      sum += kernel(width * (static_cast<double>(lag) + (part + 0.5) / parts - 0.5));
    row.push_back(width * sum / parts);
  }
  return row;
}

}  // namespace

double interior_depth(const Scene& scene) {
  const auto& depths = scene.sensor.depths;
  return scene.material.layer ? scene.material.layer->thickness
                              : 2.0 * *std::max_element(depths.begin(), depths.end());
}

InteriorKernels interior_kernels(const Scene& scene, std::size_t rows, bool tangential) {
  const double bottom = interior_depth(scene);
  InteriorKernels kernels{.lags = 2 * surface(scene).count - 1};
  for (std::size_t i = 0; i < rows; ++i) {
    const double depth = bottom * (static_cast<double>(i) + 0.5) / static_cast<double>(rows);
    kernels.depths.push_back(depth);
    const auto append = [&](std::vector<double>& all, Traction component) {
      const std::vector<double> row = row_of(scene, component, depth);
      all.insert(all.end(), row.begin(), row.end());
    };
    append(kernels.of_normal, Traction::normal);
    if (tangential) append(kernels.of_tangential, Traction::tangential_y);
  }
  return kernels;
}

std::vector<double> interior_stress(const InteriorKernels& kernels, std::span<const double> normal,
                                    std::span<const double> tangential) {
  const std::size_t count = normal.size();
  std::vector<double> stress(kernels.depths.size() * count);
  const auto add = [&](const std::vector<double>& of_unit, std::span<const double> tractions) {
    for (std::size_t at = 0; at < stress.size() && !tractions.empty(); ++at) {
      const double* const here =
          of_unit.data() + (at / count) * kernels.lags + at % count + count - 1;
      for (std::size_t i = 0; i < count; ++i)
        stress[at] += *(here - static_cast<std::ptrdiff_t>(i)) * tractions[i];
    }
  };
  add(kernels.of_normal, normal);
  add(kernels.of_tangential, tangential);
  return stress;
}

}  // namespace tactile_net::lab
