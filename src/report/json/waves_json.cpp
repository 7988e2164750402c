#include "tactile_net/report/json/waves_json.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "report/json/rounded.hpp"
#include "report/json/values.hpp"
#include "tactile_net/report/words/identify_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

/// Every wavenumber along one axis, from 0, with its place among them.
using Wavenumbers = std::map<double, std::size_t>;

Wavenumbers wavenumbers(const std::vector<SkinResolution>& all, double SkinResolution::*along) {
  Wavenumbers numbers;
  for (const SkinResolution& one : all) numbers.emplace(std::abs(one.*along), 0);
  std::size_t place = 0;
  for (auto& [number, index] : numbers) index = place++;
  return numbers;
}

/// The waves' lengths; null of a uniform load.
Json lengths_json(const Wavenumbers& numbers) {
  Json json = Json::array();
  for (const auto& [number, index] : numbers)
    json.push_back(number > 0.0 ? Json(rounded(2.0 * std::numbers::pi / number, 5))
                                : Json(nullptr));
  return json;
}

}  // namespace

std::string waves_json(const SkinScene& scene, const lab::Survey& survey) {
  constexpr double full_colour = 10.0;  // times the noise
  constexpr double most_times = 1e9;    // where there is hardly any
  const auto& all = survey.own.resolutions;
  const Wavenumbers y = wavenumbers(all, &SkinResolution::wavenumber_y);
  const Wavenumbers z = wavenumbers(all, &SkinResolution::wavenumber_z);
  Json maps = Json::array();
  for (const SkinRipple ripple : lab::ripples_of(survey.own.unknowns)) {
    std::vector<double> times(y.size() * z.size());
    for (const SkinResolution& one : all)
      times[y.at(std::abs(one.wavenumber_y)) * z.size() + z.at(std::abs(one.wavenumber_z))] =
          rounded(
              std::min(survey.traction / one.of_wave[static_cast<std::size_t>(ripple)], most_times),
              4);
    maps.push_back({{"title", in_words(ripple)}, {"times", std::move(times)}});
  }
  const double shortest = 2.0 * std::numbers::pi / std::max(y.rbegin()->first, z.rbegin()->first);
  const ScaledUnit unit = axis_unit(scene.units, Dimension::length, shortest);
  return text_of({{"length", {{"label", unit.label}, {"factor", unit.factor}}},
                  {"y", lengths_json(y)},
                  {"z", lengths_json(z)},
                  {"most", full_colour},
                  {"maps", std::move(maps)}},
                 -1);
}

}  // namespace tactile_net::report
