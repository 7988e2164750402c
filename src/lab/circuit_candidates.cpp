#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/scene/opamp_part.hpp"

namespace tactile_net::lab {
namespace {

/// Whether draws of a ladder, judged by the poles of all its amplifiers, take seconds at most.
bool is_small_ladder(const SceneCircuit& circuit) {
  return circuit.nodes() + circuit.network().problem().kernel.rows <= 260;
}

/// With the scene's own op-amps and scale, and complementary outputs.
RealizationOptions options_of_candidate(const SceneCircuit& circuit, bool ladder) {
  RealizationOptions parts = circuit.options().parts;
  parts.inverters = false;
  parts.ladder = ladder;
  return parts;
}

}  // namespace

const std::vector<std::shared_ptr<const NetworkCircuit>>& SceneCircuit::candidates() const {
  return candidates_.get([&] {
    std::vector<std::shared_ptr<const NetworkCircuit>> result;
    const auto add = [&](Realization one, bool ladder) {
      const bool own = one == network_->realization() && !options_.parts.inverters &&
                       ladder == has_ladder(one, options_.parts);
      result.push_back(
          own ? network_
              : std::make_shared<const NetworkCircuit>(one, network_->shared_problem(),
                                                       options_of_candidate(*this, ladder)));
    };
    for (const Realization one : realizations) {
      // A converter a branch only while there are not tens of thousands of them.
      if (!traits(one).uses_opamps || !traits(one).linear() || !fits(one) ||
          (options_.parts.inputs == Inputs::voltage && !traits(one).drives_nodes) ||
          (traits(one).opamps_per_branch && nodes() > 130))
        continue;
      // Of a part that is named, what it is made for.
      if (options_.opamp_part != nullptr &&
          traits(one).drives_nodes != (options_.opamp_part->outputs == Outputs::complementary))
        continue;
      add(one, false);
      if (has_ladder(one, {.ladder = true}) && is_small_ladder(*this)) add(one, true);
    }
    return result;
  });
}

}  // namespace tactile_net::lab
