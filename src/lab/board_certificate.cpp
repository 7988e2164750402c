#include "tactile_net/lab/board_certificate.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "tactile_net/network/board.hpp"
#include "tactile_net/network/laid_board.hpp"
#include "tactile_net/network/state_space.hpp"
#include "tactile_net/network/supply_drop.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/opamp_part.hpp"
#include "tactile_net/scene/scale_units.hpp"

namespace tactile_net::lab {
namespace {

using Judged = BoardCertificate::Judged;

/// Of more the loops' loci take minutes: poles alone are asked.
constexpr std::size_t most_margin_states = 600;

/// Without what stands for a board: the copper takes its place.
RealizationOptions without_board(const tactile_net::NetworkOptions& options) {
  RealizationOptions parts = options.parts;
  parts.node_capacitance.reset();
  parts.opamp.input_capacitance = options.own_input_capacitance;
  return parts;
}

/// One problem, its board's capacitances, and any siemens.
class OnBoard {
 public:
  OnBoard(const SceneCircuit& circuit, const LaidBoard& board, double wanted)
      : problem_(circuit.network().shared_problem()),
        accuracy_(circuit.options().settling_accuracy.value_or(1e-3)) {
    const RealizationOptions options = without_board(circuit.options());
    result_.realization = circuit.network().realization();
    result_.ladder = has_ladder(result_.realization, options);
    result_.wanted = wanted;
    const ScaleUnits units =
        std::visit([](const auto& scene) { return scale_units(scene); }, circuit.scene());
    result_.siemens_unit = units.siemens.to_si(1.0);
    volts_unit_ = units.volts.to_si(1.0);
    result_.has_planes = board.has_planes;
    result_.to_plane = board.layers.front().to_plane;
    result_.copper = net_copper(board);
    result_.supply = supply_drop(board, "VEE");
    if (const OpAmpPart* const part = circuit.options().opamp_part)
      result_.supply_current = part->supply_current;
    const NetworkCircuit plain(result_.realization, problem_, options);
    result_.nodes = node_capacitances(board, result_.copper, plain.flat().circuit(),
                                      package_of(circuit.options().opamp_part));
    has_subcircuits_ = plain.flat().had_subcircuits();
    options_ = options;
    result_.circuit = at(options.scale.siemens);
    result_.stated = result_.used = judged(*result_.circuit, true);
  }

  /// Raises the siemens by doubling until the margin is there, then halves the step.
  void raise() {
    if (result_.stated.enough(result_.wanted) || !may_be_raised(result_.stated)) return;
    constexpr double step = 1.4142135623730951;
    Judged best = result_.stated;
    double low = result_.stated.siemens;
    for (double siemens = low * step;; siemens *= step) {
      const auto here = at(siemens);
      const Judged one = judged(*here, false);
      if (one.least_ohm < least_board_ohm) break;
      if (is_better(one, best)) best = one;
      if (one.enough(result_.wanted)) break;
      low = siemens;
    }
    for (double high = best.siemens; best.enough(result_.wanted) && high > 1.02 * low;) {
      const double middle = std::sqrt(low * high);
      const Judged one = judged(*at(middle), false);
      (one.enough(result_.wanted) ? high : low) = middle;
      if (one.enough(result_.wanted)) best = one;
    }
    if (best.siemens != result_.stated.siemens) result_.used = judged(*at(best.siemens), true);
  }

  [[nodiscard]] BoardCertificate& result() noexcept { return result_; }

 private:
  [[nodiscard]] std::shared_ptr<const NetworkCircuit> at(double siemens) const {
    RealizationOptions options = options_;
    options.scale.siemens = siemens;
    return std::make_shared<const NetworkCircuit>(result_.realization, problem_, options,
                                                  result_.nodes);
  }

  [[nodiscard]] static bool may_be_raised(const Judged& one) {
    return one.stable() || one.oscillates();
  }

  [[nodiscard]] static bool is_better(const Judged& a, const Judged& b) {
    if (a.stable() != b.stable()) return a.stable();
    if (!a.stable()) return a.slowest.value_or(0.0) < b.slowest.value_or(0.0);
    return !a.margin || (b.margin && a.margin->degrees > b.margin->degrees);
  }

  [[nodiscard]] Judged judged(const NetworkCircuit& circuit, bool settling) const {
    Judged one{.siemens = circuit.options().scale.siemens, .stability = stability_of(circuit)};
    for (const double ohm : resistances(circuit.flat()))
      one.least_ohm = one.least_ohm == 0.0 ? ohm : std::min(one.least_ohm, ohm);
    if (settling) {
      const Certificate certificate = tactile_net::certify(circuit, accuracy_);
      if (certificate.dynamics) {
        one.slowest = certificate.dynamics->slowest;
        one.damping = certificate.dynamics->damping;
        one.settling_seconds = certificate.dynamics->settling_seconds;
      }
      if (!has_subcircuits_) one.proposal = certificate.proposal;
      for (const CircuitRemark& remark : certificate.remarks)
        if (remark.kind == CircuitRemark::Kind::output_current) {
          one.overload = remark;
          one.overload->unit = volts_unit_;
        }
    } else if (one.stable() || one.oscillates()) {
      one.slowest = circuit.poles().front().real();
    }
    if (one.stable() && circuit.options().opamp.bandwidth &&
        count_states(circuit.flat()) <= most_margin_states)
      one.margin = phase_margin(circuit.flat());
    return one;
  }

  std::shared_ptr<const NetworkProblem> problem_;
  double accuracy_;
  double volts_unit_ = 1.0;
  bool has_subcircuits_ = false;  // they are opened on a board, and have dividers of their own
  RealizationOptions options_;
  BoardCertificate result_;
};

void check_boards(Realization realization) {
  if (!traits(realization).uses_opamps || !traits(realization).linear())
    throw std::invalid_argument("a board is of resistors and op-amps: the realization " +
                                std::string(name(realization)) + " is not");
}

void check_wanted(double degrees) {
  if (!(degrees > 0.0 && degrees < 90.0))
    throw std::invalid_argument("a phase margin must be > 0 and < 90 degrees");
}

/// The scene with another circuit: what a list of parts has chosen, at other siemens.
AnyScene scene_with(const AnyScene& scene, Realization realization, bool ladder, double siemens) {
  AnyScene other = scene;
  std::visit(
      [&](auto& one) {
        one.network.realization = realization;
        one.network.parts.inverters = false;
        one.network.parts.ladder = ladder;
        one.network.parts.scale.siemens = siemens;
      },
      other);
  return other;
}

/// To three digits, so that a scene can state it.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
  double rounded = 0.0;
  (void)read_number(brief(std::ceil(value / unit) * unit, 3), rounded);
  return rounded;
}

LaidBoard laid(const Board& board) {
  std::ostringstream text;
  write_kicad_board(text, board);
  return read_kicad_board(text.str(), "board.kicad_pcb");
}

}  // namespace

SceneCircuit on_board(const SceneCircuit& circuit, const LaidBoard& board) {
  check_boards(circuit.network().realization());
  const NetworkCircuit plain(circuit.network().realization(), circuit.network().shared_problem(),
                             without_board(circuit.options()));
  return {circuit, std::make_shared<const NetworkCircuit>(
                       plain.realization(), plain.shared_problem(), plain.options(),
                       node_capacitances(board, net_copper(board), plain.flat().circuit(),
                                         package_of(circuit.options().opamp_part)))};
}

SceneCircuit circuit_on_board(const AnyScene& scene, const std::optional<LaidBoard>& board) {
  SceneCircuit circuit = simulated_circuit(scene);
  return board ? on_board(circuit, *board) : circuit;
}

BoardCertificate certify_board(const SceneCircuit& circuit, const LaidBoard& board, double wanted) {
  check_wanted(wanted);
  check_boards(circuit.network().realization());
  OnBoard on(circuit, board, wanted);
  on.raise();
  on.result().file = board.file;
  return std::move(on.result());
}

BoardCertificate close_board(const SceneCircuit& circuit, PartsList& list, double wanted) {
  check_wanted(wanted);
  const Realization realization = list.chosen().realization;
  const bool ladder = list.chosen().ladder;
  double siemens = circuit.options().parts.scale.siemens;
  std::optional<Judged> stated;
  for (int attempt = 1;; ++attempt) {
    const SceneCircuit one =
        simulated_circuit(scene_with(circuit.scene(), realization, ladder, siemens));
    OnBoard on(one, laid(*list.choice->board), wanted);
    on.raise();
    BoardCertificate& result = on.result();
    if (!stated) stated = result.stated;
    constexpr int most_attempts = 4;
    if (!result.changed() || attempt == most_attempts) {
      result.used = result.stated;  // of the siemens that the list is made for
      result.stated = *stated;
      return std::move(result);
    }
    // A little more, since larger parts or other pairs may load it more.
    siemens = rounded_up(1.02 * result.used.siemens / result.siemens_unit) * result.siemens_unit;
    const SceneCircuit raised =
        simulated_circuit(scene_with(circuit.scene(), realization, ladder, siemens));
    const PartsList anew = own_parts_list(raised, list.wanted.target);
    if (!anew.choice) {
      result.used = result.stated;
      result.stated = *stated;
      return std::move(result);
    }
    list.candidates[*list.chosen_at] = anew.chosen();
    list.choice = anew.choice;
  }
}

}  // namespace tactile_net::lab
