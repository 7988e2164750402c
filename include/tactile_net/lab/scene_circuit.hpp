/// @file
/// A scene's circuit for one frame of readings, and all that several results need of it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tactile_net/lab/circuit_source.hpp"
#include "tactile_net/lab/condition.hpp"
#include "tactile_net/network/certificate.hpp"
#include "tactile_net/network/deck.hpp"
#include "tactile_net/network/network_circuit.hpp"
#include "tactile_net/network/tolerance.hpp"
#include "tactile_net/numeric/once.hpp"
#include "tactile_net/scene/scene.hpp"

namespace tactile_net::lab {

/// What may stand between the circuit's answer and the direct solve, relative.
struct ExplainedDifference {
  double limit = 0.0;                 ///< largest difference that rounding explains
  double curves = 0.0;                ///< largest that the devices' curves explain
  std::optional<double> predicted{};  ///< the difference that the op-amps' gain and offset make

  /// The largest that all of them explain.
  [[nodiscard]] double total() const noexcept {
    return limit + curves + allowed(predicted.value_or(0.0));
  }
  /// For what was computed: a fifth of it on top.
  [[nodiscard]] static double allowed(double prediction) noexcept { return 1.2 * prediction; }

  bool operator==(const ExplainedDifference&) const = default;
};

/// Everything but the circuit itself is made on first use, and once. Used from one thread at a
/// time.
class SceneCircuit {
 public:
  /// With the scene's alpha, or the one its rule chooses for the frame on the scene's own surface,
  /// also where the nodes lie further apart: alpha does not follow the spacing.
  ///
  /// @throw std::invalid_argument, std::domain_error  the scene's options make no circuit
  explicit SceneCircuit(const SceneFrame& frame);
  SceneCircuit(const SceneFrame& frame, const ChosenAlpha& alpha);
  /// @throw std::invalid_argument  the source refuses the realisation
  SceneCircuit(const std::shared_ptr<const CircuitSource>& source, const ChosenAlpha& alpha);
  /// The same problem with another circuit of it.
  SceneCircuit(const SceneCircuit& other, std::shared_ptr<const NetworkCircuit> network);

  /// `CircuitSource::scene`
  [[nodiscard]] const AnyScene& scene() const noexcept { return source_->scene(); }
  [[nodiscard]] const std::string& file() const noexcept;
  /// The scene's, with the scale that holds for this circuit. Where the scene states no `volts`
  /// the largest of the answer's voltages is 1 V; without a contact, whose answer would be noise,
  /// 1 V stands for the traction that strains the pad by 10 %.
  [[nodiscard]] const NetworkOptions& options() const noexcept { return options_; }
  /// Whether another realisation is one of the same problem: `CircuitSource::refusal`.
  [[nodiscard]] bool fits(Realization realization) const {
    return !source_->refusal(realization).has_value();
  }
  [[nodiscard]] const ChosenAlpha& alpha() const noexcept { return alpha_; }

  /// The circuit, with its flat form, reduction, state space and P's eigenvalues.
  [[nodiscard]] const NetworkCircuit& network() const noexcept { return *network_; }
  /// For whoever outlives this object.
  [[nodiscard]] const std::shared_ptr<const NetworkCircuit>& shared_network() const noexcept {
    return network_;
  }
  [[nodiscard]] std::size_t nodes() const noexcept { return network_->problem().matrix.rows; }

  /// Circuits of op-amps and resistors for the same problem, of which one may be built instead: the
  /// scene's op-amps and scale, complementary outputs, with a ladder after without. This one is
  /// among them if it is such a one.
  [[nodiscard]] const std::vector<std::shared_ptr<const NetworkCircuit>>& candidates() const;

  /// Whether there is an answer to settle to: a load that is not zero.
  [[nodiscard]] bool loaded() const noexcept;

  /// f of the direct solve of P f = b [Pa], by a method that does not form P.
  [[nodiscard]] const std::vector<double>& direct() const;

  /// `CircuitSource::readings_per_length`
  [[nodiscard]] std::vector<double> readings_per_length() const {
    return source_->readings_per_length();
  }

  /// A bound on P's condition number: largest row sum over the smallest eigenvalue; may be
  /// infinite.
  [[nodiscard]] Condition condition() const;

  [[nodiscard]] const ExplainedDifference& explained() const;

  /// The circuit as it is ordered: with resistors of the scene's series.
  struct Ordered {
    Series series = Series::e96;
    Circuit circuit{};
    std::optional<double> moved{};  ///< by the series, of a circuit at rest under load: |dv| / |v|
  };
  /// Absent: the scene names no series.
  [[nodiscard]] const std::optional<Ordered>& ordered() const;

  /// With the scene's accuracy of settling; 1e-3 where it gives none.
  [[nodiscard]] const Certificate& certificate() const;

  /// Where the answer is: the operating point, or one frequency.
  [[nodiscard]] Analysis analysis() const;

  /// The scene's tolerances; parts of 1 % where it has none.
  [[nodiscard]] ToleranceOptions tolerance() const;

 private:
  /// The scene's options with a scale that suits the answer.
  [[nodiscard]] NetworkOptions scaled() const;

  std::shared_ptr<const CircuitSource> source_;
  ChosenAlpha alpha_;
  Once<std::vector<double>> direct_;
  NetworkOptions options_;  // after what its scale follows from
  std::shared_ptr<const NetworkCircuit> network_;
  Once<std::vector<std::shared_ptr<const NetworkCircuit>>> candidates_;
  Once<ExplainedDifference> explained_;
  Once<std::optional<Ordered>> ordered_;
  Once<Certificate> certificate_;
};

/// The circuit for the scene's own frame, as it is simulated.
///
/// @throw std::invalid_argument  there is no contact and a rule would choose alpha on noise: what
///                               such a circuit is made of would be noise too; or of a skin as
///                               `circuit_source` and `too_large`
[[nodiscard]] SceneCircuit simulated_circuit(const AnyScene& scene);

/// Of a skin, for these readings, with alpha and weight as they choose them. @throw  as above
[[nodiscard]] SceneCircuit skin_circuit(const SkinScene& scene, std::vector<double> readings);

}  // namespace tactile_net::lab
