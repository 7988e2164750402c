/// @file
/// What to order: the cheapest resistors of each realisation that meet an accuracy, and which
/// realisation they are cheapest of.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/allocation.hpp"

namespace tactile_net::lab {

struct PartsList {
  struct Candidate {
    Realization realization = Realization::lattice;
    std::size_t opamps = 0;
    bool stable = true;  ///< with the scene's own op-amps
    Allocation list{};
    double price = 0.0;  ///< of the list and the op-amps
    /// Of draws with the list; infinite: more than 1 of 20 is unstable; absent: none was drawn,
    /// since the circuit is unstable or no list meets the target.
    std::optional<double> p95{};

    [[nodiscard]] bool good() const noexcept { return stable && list.met && p95.has_value(); }
  };
  AllocationOptions wanted{};
  double opamp_price = 2.0;  ///< of one, with two outputs; typical
  std::vector<Candidate> candidates{};
  std::optional<std::size_t> choice{};  ///< the cheapest whose draws meet the target; absent: none

  [[nodiscard]] const Candidate& chosen() const { return candidates[*choice]; }
};

/// For the scene's own load, which decides how much a part counts: others of its kind differ by
/// some per cent. Under the same conditions as a recommendation: complementary outputs, resistors
/// of their nominal values.
///
/// @param target  95 of 100 builds err by at most this, > 0
/// @throw std::invalid_argument  the target is out of range, or there is no load
[[nodiscard]] PartsList parts_list(const SceneCircuit& circuit, double target);

/// One line of an order.
struct OrderedPart {
  double ohm = 0.0;
  double tolerance = 0.0;
  std::vector<std::string> references{};
};

/// The chosen candidate's resistors, equal ones together, by tolerance and value. The circuit is
/// built anew. @pre  there is a choice
[[nodiscard]] std::vector<OrderedPart> order_of(const PartsList& list, const SceneCircuit& circuit);

/// How many resistors of each part of the circuit are of each class: "K", "stabiliser", ...
struct PartsOfArray {
  std::string array{};
  std::vector<std::size_t> counts{};
};
/// @pre  there is a choice
[[nodiscard]] std::vector<PartsOfArray> by_array(const PartsList& list,
                                                 const SceneCircuit& circuit);

}  // namespace tactile_net::lab
