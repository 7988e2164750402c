#include "tactile_net/lab/calibrate.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

namespace tactile_net::lab {

namespace {

PressModel model_of(const AnyScene& any) {
  return std::visit(
      [](const auto& scene) -> PressModel {
        return {scene.sensor, scene.material, scene.crosstalk ? scene.crosstalk->fraction : 0.0};
      },
      any);
}

double spread_of(const std::vector<FittedPress>& presses, ValueWithSd FittedPress::*centre) {
  const auto [first, last] = std::minmax_element(presses.begin(), presses.end(),
                                                 [&](const FittedPress& a, const FittedPress& b) {
                                                   return (a.*centre).value < (b.*centre).value;
                                                 });
  return ((*last).*centre).value - ((*first).*centre).value;
}

double least_objective(const PressFit& fit) {
  return std::min_element(
             fit.starts.begin(), fit.starts.end(),
             [](const StartOutcome& a, const StartOutcome& b) { return a.objective < b.objective; })
      ->objective;
}

AnyScene on_the_other_base(AnyScene any) {
  std::visit(
      [](auto& scene) {
        Base& base = scene.material.layer->base;
        base = base == Base::bonded ? Base::frictionless : Base::bonded;
      },
      any);
  return any;
}

}  // namespace

const std::string& SceneCalibration::file() const {
  return std::visit([](const auto& one) -> const std::string& { return one.file; }, scene);
}

const std::string& SceneCalibration::title() const {
  return std::visit([](const auto& one) -> const std::string& { return one.title; }, scene);
}

const std::optional<Units>& SceneCalibration::units() const {
  return std::visit([](const auto& one) -> const std::optional<Units>& { return one.units; },
                    scene);
}

const Material& SceneCalibration::material() const {
  return std::visit([](const auto& one) -> const Material& { return one.material; }, scene);
}

SceneCalibration calibrate(const AnyScene& scene, PressLog log, const CalibrationOptions& options,
                           const std::function<void(std::size_t)>& watch) {
  const PressModel model = model_of(scene);
  SceneCalibration result{.scene = scene, .options = options, .log = std::move(log)};
  result.sites = model.sites();
  result.channels = model.channels();
  std::vector<std::size_t> dead;
  std::visit(
      [&](const auto& one) {
        result.readings = reading_names(one.sensor);
        dead = one.dead_taxels;
      },
      scene);
  const auto unread = std::make_unique<bool[]>(result.sites.size());
  for (std::size_t j = 0; j < result.sites.size(); ++j)
    unread[j] = std::count(dead.begin(), dead.end(), result.sites[j].taxel) > 0;
  const std::span<const bool> left_out(unread.get(), result.sites.size());
  result.fit = fit_presses(model, result.log, options, left_out, watch);
  // Depth and thickness make up for a base of the wrong kind: the rms of residuals hardly tells.
  if (result.material().layer && !options.robust &&
      result.fit.verdict != FitVerdict::iteration_limit) {
    CalibrationOptions once = options;
    once.starts = {1.0};
    once.profile = false;
    try {
      const PressFit other =
          fit_presses(model_of(on_the_other_base(scene)), result.log, once, left_out, watch);
      if (other.verdict != FitVerdict::iteration_limit)
        result.other_base_gain = 2.0 * (least_objective(result.fit) - least_objective(other));
    } catch (const std::invalid_argument&) {  // nothing like this log: no rival
    }
  }
  result.spread = std::max(spread_of(result.fit.presses, &FittedPress::center),
                           spread_of(result.fit.presses, &FittedPress::center_z));
  return result;
}

void plan_presses(SceneCalibration& found, std::size_t count, std::optional<PadParameter> target,
                  const std::function<void(std::size_t)>& watch) {
  found.target = target;
  found.next = next_presses(model_of(found.scene), found.log, found.options, found.fit, count,
                            target, watch);
}

}  // namespace tactile_net::lab
