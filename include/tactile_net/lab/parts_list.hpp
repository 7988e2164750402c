/// @file
/// What to order: the cheapest resistors of each realisation that meet an accuracy, and which
/// realisation they are cheapest of.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tactile_net/lab/scene_circuit.hpp"
#include "tactile_net/network/allocation.hpp"
#include "tactile_net/network/board.hpp"
#include "tactile_net/network/part_values.hpp"
#include "tactile_net/network/static_errors.hpp"

namespace tactile_net::lab {

/// One line of an order.
struct OrderedPart {
  double ohm = 0.0;
  double tolerance = 0.0;
  std::vector<std::string> references{};
};

/// How many resistors of each part of the circuit are of each class: "K", "stabiliser", ...
struct PartsOfArray {
  std::string array{};
  std::vector<std::size_t> counts{};
};

struct PartsList {
  struct Candidate {
    Realization realization = Realization::lattice;
    bool ladder = false;  ///< see `has_ladder`
    std::size_t opamps = 0;
    StabilityVerdict stability{};  ///< with everything that the scene states
    /// What its op-amps do with exact resistors: root mean squares to first order, and what 95 of
    /// 100 draws are within. No list of resistors errs by less.
    OpAmpShares opamps_alone{};
    double opamps_p95 = 0.0;
    /// The same with what all resistors have in common, their reel and the temperature.
    double common_p95 = 0.0;
    Allocation list{};      ///< what is left for errors of parts once their values are rounded
    std::size_t pairs = 0;  ///< resistors that are two parts, the second of the same class
    double resistors_price = 0.0;  ///< of the list with its pairs
    double resistors_bound = 0.0;  ///< no list with these values is cheaper
    double rounding = 0.0;         ///< what values of the series do to the answer, relative
    double price = 0.0;            ///< of resistors and op-amps
    bool tuned = false;            ///< the draws that the list was made with meet the target
    /// Of draws with the list and the op-amps, with which nothing was chosen; infinite: more than 1
    /// of 20 is unstable; absent: none was drawn, since the circuit is not known to be stable or no
    /// list meets the target.
    std::optional<double> p95{};
    std::size_t builds = 0;  ///< that were drawn
    std::size_t within = 0;  ///< of them within the target

    [[nodiscard]] bool stable() const noexcept { return stability.stability == Stability::stable; }
    /// Whether it may be ordered: its own draws meet the target, and those that nothing was chosen
    /// with do not speak against 95 of 100.
    [[nodiscard]] bool good() const noexcept {
      return stable() && list.met && tuned && interval().second >= 0.95;
    }
    /// `share_interval` of the builds within the target.
    [[nodiscard]] std::pair<double, double> interval() const noexcept;
  };

  /// The chosen candidate as it is soldered.
  struct Choice {
    SolderedCircuit soldered{};
    std::shared_ptr<const Board> board{};  ///< that it stands on
    std::vector<OrderedPart> order{};      ///< equal ones together, by tolerance and value
    std::vector<PartsOfArray> arrays{};    ///< of resistors as they are wanted, a pair counted once
    std::shared_ptr<const NetworkCircuit> network{};  ///< whose resistors they are
    BoughtParts bought;                               ///< for these: values, and what they are off
  };

  AllocationOptions wanted{};
  Series series = Series::e96;
  std::size_t loads = 1;     ///< the scene's contacts at so many places
  double opamp_price = 2.0;  ///< of one, with two outputs; typical where the scene states none
  std::string opamp_part{};  ///< by which op-amps are ordered; empty: the scene names none
  bool tare = false;         ///< builds are read less their answer without readings
  std::vector<Candidate> candidates{};
  std::optional<std::size_t> chosen_at{};  ///< the cheapest that may be ordered
  std::shared_ptr<const Choice> choice{};  ///< null: there is none

  /// Whether no candidate that is stable has op-amps that would do with exact resistors.
  [[nodiscard]] bool opamps_too_coarse() const noexcept;
  /// Whether one that is stable would do, but for what all resistors have in common.
  [[nodiscard]] bool common_too_coarse() const noexcept;

  /// @pre  there is a choice
  [[nodiscard]] const Candidate& chosen() const { return candidates[*chosen_at]; }
};

/// Values are of the scene's series, E96 where it names none: two parts where one would take more
/// of the target than it may. How much a part counts is the mean over the scene's contacts where
/// they are and moved along the sensor, and a build's error the root mean square over them. The
/// scene's op-amps are in every build: offsets and bias currents drawn as
/// `InputSpread` says, the balance of `tolerance`, finite gain, common-mode rejection and output
/// resistance. Under the same conditions as a recommendation: complementary outputs.
///
/// @param target  95 of 100 builds err by at most this, > 0
/// @throw std::invalid_argument  the target is out of range, or there is no load
[[nodiscard]] PartsList parts_list(const SceneCircuit& circuit, double target);

/// The same of the scene's own realisation alone.
///
/// @throw std::invalid_argument  as above, or the realisation is not of resistors and op-amps with
///                               complementary outputs
[[nodiscard]] PartsList own_parts_list(const SceneCircuit& circuit, double target);

}  // namespace tactile_net::lab
