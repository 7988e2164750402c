#include "tactile_net/sensing/resampled.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const SensorArray coarse_array{
    .count = 5, .pitch = 2.0, .depths = {1.0}, .reads = {Quantity::stress_x}};

Surface grid(double spacing, double margin = 2.0) {
  return surface_of(coarse_array,
                    {.basis = SurfaceBasis::hats, .spacing = spacing, .margin = margin});
}

double integral(const std::vector<double>& values, const Surface& surface) {
  return surface.spacing * std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("straight lines stay the same lines on a finer grid", "[surface]") {
  const Surface coarse = grid(1.0);
  const Surface fine = grid(0.25);
  std::vector<double> f;  // normal, then tangential
  for (std::size_t i = 0; i < 2 * coarse.count; ++i)
    f.push_back(std::sin(0.7 * static_cast<double>(i * i)));
  const std::vector<double> finer = resampled(f, coarse, fine);
  REQUIRE(finer.size() == 2 * fine.count);
  for (const std::size_t unknown : {std::size_t{0}, std::size_t{1}}) {
    const auto part = [&](const std::vector<double>& all, std::size_t count) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(unknown * count);
      return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(count));
    };
    CHECK_THAT(integral(part(finer, fine.count), fine),
               WithinAbs(integral(part(f, coarse.count), coarse), 1e-13));
  }
  const std::vector<double> back = resampled(finer, fine, coarse);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK_THAT(back[i], WithinAbs(f[i], 1e-14));
}

TEST_CASE("beyond their last points tractions fall to nothing", "[surface]") {
  const Surface narrow = grid(1.0, 1.0);
  const Surface wide = grid(0.5, 4.0);
  const std::vector<double> values =
      resampled(std::vector<double>(narrow.count, 3.0), narrow, wide);
  const double end = narrow.position(narrow.count - 1);
  for (std::size_t i = 0; i < wide.count; ++i) {
    const double beyond = std::abs(wide.position(i)) - end;
    CHECK_THAT(values[i], WithinAbs(3.0 * std::clamp(1.0 - beyond, 0.0, 1.0), 1e-13));
  }
}
