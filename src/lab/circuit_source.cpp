#include "tactile_net/lab/circuit_source.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/lab/moved_contacts.hpp"
#include "tactile_net/lab/skin_network.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tactile_net/skin/forward.hpp"

namespace tactile_net::lab {
namespace {

/// The same readings, of tractions as far apart as the nodes.
SceneFrame frame_of_circuit(const SceneFrame& frame) {
  const Scene& scene = frame.problem().scene();
  if (!scene.network.spacing) return frame;
  return {SceneProblem(of_circuit(scene)), frame.readings()};
}

/// d(readings)/dy of contacts that move, by central differences over a share of the depth, below
/// which readings do not vary.
std::vector<double> rate_of(const auto& channels, const auto& readings_at) {
  double depth = channels.front().depth;
  for (const auto& channel : channels) depth = std::min(depth, channel.depth);
  const double step = 1e-3 * depth;
  std::vector<double> rate = readings_at(step);
  const std::vector<double> before = readings_at(-step);
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (rate[i] - before[i]) / (2.0 * step);
  return rate;
}

class LineSource final : public CircuitSource {
 public:
  explicit LineSource(const SceneFrame& frame)
      : frame_(frame_of_circuit(frame)), scene_(frame_.problem().scene()) {}

  const AnyScene& scene() const noexcept override { return scene_; }
  NetworkProblem problem(double alpha) const override {
    return network_problem(frame_.problem().problem(), alpha, frame_.readings());
  }
  std::vector<double> direct(double alpha) const override {
    return tikhonov_solve(frame_.problem().problem(), alpha, frame_.readings());
  }
  std::vector<double> readings_per_length() const override {
    const Scene& scene = frame_.problem().scene();
    if (scene.contacts.empty()) return {};
    return weighted(frame_.problem().problem(), rate_of(channels(scene.sensor), [&](double by) {
                      return exact_readings(scene.sensor, scene.material,
                                            moved(scene.contacts, by));
                    }));
  }
  std::optional<std::string> refusal(Realization) const override { return std::nullopt; }

 private:
  SceneFrame frame_;
  AnyScene scene_;
};

SkinSceneProblem problem_of_circuit(const SkinSceneProblem& problem) {
  if (!problem.scene().network.spacing) return problem;
  return SkinSceneProblem(of_circuit(problem.scene()));
}

SkinScene filled_in(const SkinSceneProblem& problem) {
  SkinScene scene = problem.scene();
  scene.reconstruct.smoothing_length = problem.problem().smoothing_length;
  return scene;
}

class SkinSource final : public CircuitSource {
 public:
  SkinSource(const SkinSceneProblem& problem, std::vector<double> readings)
      : problem_(problem_of_circuit(problem)),
        readings_(std::move(readings)),
        scene_(filled_in(problem_)) {
    if (problem_.constraints())
      throw std::invalid_argument(
          "a circuit of resistors and op-amps is linear, and holds no constraints: leave out "
          "nonnegative and friction_limit under [reconstruct]");
  }

  const AnyScene& scene() const noexcept override { return scene_; }
  NetworkProblem problem(double alpha) const override {
    return skin_network_problem(problem_.problem(), alpha, readings_);
  }
  std::vector<double> direct(double alpha) const override {
    const TikhonovFamily& family = problem_.family();
    return family.solve(family.analyse(readings_), alpha);
  }
  std::vector<double> readings_per_length() const override {
    const SkinScene& scene = problem_.scene();
    if (scene.contacts.empty()) return {};
    const ExactSkinModel model(scene.sensor, scene.material);
    return weighted(problem_.problem(), rate_of(channels(scene.sensor), [&](double by) {
                      return model.readings(moved(scene.contacts, by));
                    }));
  }
  std::optional<std::string> refusal(Realization realization) const override {
    return too_large(realization, problem_.tractions(), problem_.problem().kernel.rows);
  }

 private:
  SkinSceneProblem problem_;
  std::vector<double> readings_;
  AnyScene scene_;
};

}  // namespace

std::shared_ptr<const CircuitSource> circuit_source(const SceneFrame& frame) {
  return std::make_shared<const LineSource>(frame);
}

std::shared_ptr<const CircuitSource> circuit_source(const SkinSceneProblem& problem,
                                                    std::vector<double> readings) {
  return std::make_shared<const SkinSource>(problem, std::move(readings));
}

}  // namespace tactile_net::lab
