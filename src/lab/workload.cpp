#include "tactile_net/lab/workload.hpp"

#include <algorithm>
#include <cmath>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/scene_effects.hpp"

namespace tactile_net::lab {
namespace {

/// "81 x 81", "1 frame", "5 frames".
std::string times(std::size_t a, std::size_t b) {
  return std::to_string(a) + " x " + std::to_string(b);
}
std::string count_of(std::size_t count, const std::string& thing) {
  return std::to_string(count) + ' ' + thing + (count == 1 ? "" : "s");
}
std::string about(double operations) { return "about " + brief(operations) + " operations"; }

/// Sizes that costs are made of.
struct Sizes {
  explicit Sizes(const Scene& scene)
      : taxels(scene.sensor.count),
        channels(scene.sensor.reads.size() * scene.sensor.depths.size()),
        readings(taxels * channels),
        unknowns(tactile_net::unknowns(scene)),
        tractions(taxels * unknowns),
        fields(any_friction(scene) ? 2 : 1),
        frames(scene.frame + 1),
        moments(instants(scene).size()) {}
  std::size_t taxels, channels, readings, unknowns, tractions, fields, frames, moments;
};

class Planner {
 public:
  Planner(const Scene& scene, const PlanRequest& request)
      : scene_(scene), options_(scene.reconstruct), request_(request), sizes_(scene) {}

  ScenePlan plan() {
    for (const SceneEffect& effect : scene_effects()) add_effect(effect);
    readings();
    unknowns();
    methods();
    errors();
    circuit();
    time_course();
    add(Computation::report, request_.report, request_.report ? "--out asks for files" : "no --out",
        "plots by gnuplot, tables");
    return std::move(plan_);
  }

 private:
  void add(Computation what, bool done, std::string why, std::string cost) {
    plan_.computations.push_back(
        {what, done, std::move(why), done ? std::move(cost) : std::string{}});
  }

  [[nodiscard]] bool uses(Method method) const {
    return std::find(options_.methods.begin(), options_.methods.end(), method) !=
           options_.methods.end();
  }

  void add_effect(const SceneEffect& effect) {
    PlannedEffect planned{.name = effect.name, .simulated = effect.present(scene_)};
    if (!planned.simulated) {
      planned.words = effect.name == "friction" ? "one field of tractions, no tangential kernel"
                      : effect.name == "layer"  ? "half plane: kernels are closed formulas"
                                                : "no stage";
    } else {
      planned.words = effect.words(scene_);
      if (effect.make != nullptr && effect.make(scene_) == nullptr)
        planned.words += "; strength 0: no stage";
      else
        planned.operations = effect.operations(scene_) * static_cast<double>(sizes_.readings);
    }
    plan_.effects.push_back(std::move(planned));
  }

  void readings() {
    const auto [taxels, channels, all, _, __, fields, frames, moments] = sizes_;
    const double blocks = static_cast<double>(channels * fields);
    const auto n = static_cast<double>(taxels);
    if (scene_.forward == ForwardModel::exact)
      add(Computation::readings, true, "forward model exact: the continuous integral",
          "some hundred kernel values for each of " + count_of(all, "reading") + " and contact");
    else
      add(Computation::readings, true, "forward model sampled: the sum over the taxels",
          taxels < 512
              ? times(taxels, taxels) + " sum for " + count_of(channels * fields, "kernel") + ", " +
                    about(2.0 * n * n * blocks)
              : "FFT for " + count_of(channels * fields, "kernel") + ", " +
                    about(20.0 * n * std::log2(4.0 * n) * blocks));
    const bool history = frames > 1;
    const bool memory = moments > frames || signal_path(scene_).has_memory();
    add(Computation::history, history,
        !scene_.time ? "no [time]: one frame"
        : !history   ? "the first frame is reconstructed"
        : memory     ? "effects remember what came before frame " + std::to_string(scene_.frame)
                     : "no effect remembers: of earlier frames only their random draws",
        memory ? "the readings at " + count_of(moments, "moment") : "no reading is computed");
  }

  void unknowns() {
    const bool two = sizes_.unknowns == 2;
    add(Computation::tangential, two,
        two                    ? "both tractions are to be found"
        : sizes_.channels == 1 ? "one quantity at one depth tells the normal traction alone"
        : options_.tangential  ? "tangential = false"
                               : "no friction: the normal traction alone",
        count_of(sizes_.tractions, "unknown") + " instead of " + std::to_string(sizes_.taxels));
    const bool layer = scene_.material.layer.has_value();
    add(Computation::layer_kernels, layer,
        layer ? "[material] has a layer" : "no layer: half plane, closed formulas",
        "integrals at " + std::to_string(2 * sizes_.taxels - 1) + " distances for each kernel");
  }

  void methods() {
    const double n = static_cast<double>(sizes_.tractions);
    const double m = static_cast<double>(sizes_.readings);
    const bool dense = sizes_.tractions < large;
    add(Computation::dft, uses(Method::dft), named(Method::dft),
        "FFT, " + about(20.0 * n * std::log2(2.0 * n)) + " a frame");
    add(Computation::tikhonov, uses(Method::tikhonov), named(Method::tikhonov),
        dense ? "QR and SVD of " + times(sizes_.readings + sizes_.tractions, sizes_.tractions) +
                    ", once; " + about(2.0 * m * n) + " a frame"
              : "conjugate gradients by FFT");
    add(Computation::closed_form, uses(Method::closed_form), named(Method::closed_form),
        "QR and SVD, once; " + about(2.0 * m * n) + " a frame");
    const bool matrix =
        uses(Method::tikhonov) || uses(Method::closed_form) || uses(Method::network);
    const bool rule = matrix && !options_.alpha;
    add(Computation::rule_comparison, rule || (request_.compare_rules && matrix),
        !matrix ? "no method takes alpha from it"
        : rule  ? "alpha is chosen by the rule " + std::string(name(options_.alpha_rule)) +
                     ", whose verdict hears the others"
        : request_.compare_rules ? "--compare-rules asks for it"
                                 : "alpha is given",
        "SVD; 200 values of alpha by " + std::to_string(alpha_rules.size()) + " rules");
  }

  [[nodiscard]] std::string named(Method method) const {
    return uses(method) ? "reconstruct.methods names it" : "reconstruct.methods does not name it";
  }

  void errors() {
    const bool matrix = uses(Method::tikhonov) || uses(Method::closed_form);
    const bool small = sizes_.tractions < large;
    const std::string none = !matrix ? "neither tikhonov nor closed_form is asked for"
                                     : "no matrix is formed for an array as large as this";
    add(Computation::bands, matrix && small,
        matrix && small ? "the forces that are printed have deviations" : none,
        "one rule for alpha, and the inverse of " + times(sizes_.tractions, sizes_.tractions));
    add(Computation::hidden_modes, matrix && small,
        matrix && small ? "what no reading shows must be said" : none,
        "SVD of " + times(sizes_.readings, sizes_.tractions));
  }

  void circuit() {
    const NetworkOptions& network = scene_.network;
    const bool on = uses(Method::network);
    const auto part = [&](Computation what, bool asked, const std::string& by,
                          const std::string& without, const std::string& cost) {
      add(what, on && asked, !on ? "no circuit" : asked ? by : without, cost);
    };
    part(Computation::circuit, true, named(Method::network), "",
         "P, " + count_of(sizes_.tractions, "node") + ", " +
             std::string(name(network.realization)) + ", up to " +
             std::to_string(sizes_.tractions * (sizes_.tractions + 1) / 2) +
             " branches; one operating point in ngspice");
    part(Computation::certificate, calls_for_certificate(network),
         "parts are not ideal, or settling or tolerances are asked for", "ideal parts",
         "theorem, margin, poles");
    part(Computation::transient, network.settling_accuracy.has_value(),
         "network.settling asks for it", "nobody asks for settling", "a transient in ngspice");
    part(Computation::tolerance, calls_for_tolerance(network), "network.tolerance asks for it",
         network.tolerance ? "tolerances are studied for networks of resistors and op-amps"
                           : "every component has its value",
         network.tolerance ? count_of(network.tolerance->trials, "draw") : "");
  }

  void time_course() {
    const bool matrix = uses(Method::tikhonov) || uses(Method::closed_form);
    const std::size_t frames = scene_.time ? scene_.time->frames : 1;
    add(Computation::time_course, request_.report && frames > 1 && matrix,
        frames == 1        ? "one frame"
        : !request_.report ? "no --out"
        : !matrix          ? "neither tikhonov nor closed_form is asked for"
                           : "the report draws the resultant over the scene's time",
        "every frame simulated and solved, at most 400 solved");
  }

  const Scene& scene_;
  const ReconstructOptions& options_;
  PlanRequest request_;
  Sizes sizes_;
  ScenePlan plan_;
};

}  // namespace

std::string_view name(Computation computation) noexcept {
  switch (computation) {
    case Computation::readings:
      return "readings";
    case Computation::history:
      return "history";
    case Computation::tangential:
      return "tangential";
    case Computation::layer_kernels:
      return "layer_kernels";
    case Computation::dft:
      return "dft";
    case Computation::tikhonov:
      return "tikhonov";
    case Computation::closed_form:
      return "closed_form";
    case Computation::rule_comparison:
      return "rule_comparison";
    case Computation::bands:
      return "bands";
    case Computation::hidden_modes:
      return "hidden_modes";
    case Computation::circuit:
      return "circuit";
    case Computation::certificate:
      return "certificate";
    case Computation::transient:
      return "transient";
    case Computation::tolerance:
      return "tolerance";
    case Computation::time_course:
      return "time_course";
    case Computation::report:
      return "report";
  }
  return "";
}

bool ScenePlan::does(Computation computation) const noexcept {
  return std::any_of(computations.begin(), computations.end(),
                     [=](const auto& one) { return one.what == computation && one.done; });
}

ScenePlan make_plan(const Scene& scene, const PlanRequest& request) {
  return Planner(scene, request).plan();
}

bool calls_for_certificate(const NetworkOptions& options) noexcept {
  return !options.parts.opamp.is_nullor() || options.parts.node_capacitance || options.tolerance ||
         options.settling_accuracy;
}

bool calls_for_tolerance(const NetworkOptions& options) noexcept {
  return options.tolerance && options.realization != Realization::lc &&
         options.realization != Realization::ndr;
}

}  // namespace tactile_net::lab
