#include "tactile_net/network/state_space.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "network/angular_frequency.hpp"
#include "network/nodal_equations.hpp"
#include "numeric/eigen.hpp"
#include "numeric/lyapunov.hpp"

namespace tactile_net {

std::size_t count_states(const FlatCircuit& circuit) {
  std::vector<bool> held = held_nodes(circuit.circuit());
  std::vector<Capacitor> capacitors = circuit.circuit().capacitors;
  std::size_t states = 0;
  held[0] = true;
  for (const FlatCircuit::Amplifier& x : circuit.amplifiers()) {
    const OpAmp& opamp = circuit.opamp(x);
    states += opamp.second_pole ? 2U : 1U;
    held[x.inverse] = true;
    if (!opamp.output_resistance) held[x.out] = true;
    for (Capacitor& one : pin_capacitors(x, opamp)) capacitors.push_back(std::move(one));
  }
  for (const Capacitor& one : capacitors)
    for (const Node end : {one.from, one.to}) {
      if (held[end]) continue;
      held[end] = true;  // counted
      ++states;
    }
  return states;
}

namespace {

NodalEquations with_bandwidths(const FlatCircuit& circuit) {
  NodalEquations equations(circuit);
  for (std::size_t k = 0; k < equations.amplifiers().size(); ++k)
    if (!equations.amplifiers()[k].opamp.bandwidth)
      throw std::invalid_argument("element " + circuit.circuit().instances[k].name +
                                  ": an amplifier without bandwidth");
  return equations;
}

/// The equations once the unknowns without capacitance have followed the states.
class Followed {
 public:
  explicit Followed(const FlatCircuit& circuit)
      : equations_(with_bandwidths(circuit)),
        states_(equations_.states()),
        followers_(equations_.size() - states_),
        to_outputs_(equations_.to_outputs()) {
    follow();
    if (states_ > 0) inertia_.emplace(equations_.capacitances());
  }

  [[nodiscard]] const NodalEquations& equations() const noexcept { return equations_; }

  [[nodiscard]] StateSpace system() const {
    const Eigen::SparseMatrix<double>& g = equations_.conductances();
    const Eigen::MatrixXd of_followers = g.bottomLeftCorner(followers_, states_);
    const Eigen::MatrixXd rate =
        from_followers_ * of_followers - Eigen::MatrixXd(g.topLeftCorner(states_, states_));
    const Eigen::MatrixXd seen = to_outputs_.leftCols(states_) - at_outputs_ * of_followers;
    const Eigen::VectorXd right = equations_.right_side(equations_.circuit().circuit().sources);
    const Eigen::VectorXd driven = drive(right);
    const Eigen::VectorXd direct = at_outputs_ * right.tail(followers_);
    StateSpace system{.dynamics = from_eigen(over_inertia(rate)),
                      .drive = {driven.begin(), driven.end()},
                      .output = from_eigen(seen),
                      .direct = {direct.begin(), direct.end()}};
    if (const Eigen::VectorXd charge = equations_.jump(); !charge.isZero(0.0)) {
      const Eigen::VectorXd jump = over_inertia(charge);
      system.jump.assign(jump.begin(), jump.end());
    }
    for (const auto& [opamp, core] : equations_.amplifiers()) {
      if (opamp.slew)
        system.slewing.push_back(
            {core, angular_frequency(*opamp.bandwidth) / opamp.dc_gain(), *opamp.slew});
      if ((opamp.offset || opamp.bias_current) && system.idle_drive.empty()) {
        const Eigen::VectorXd idle = drive(equations_.right_side({}));
        system.idle_drive.assign(idle.begin(), idle.end());
      }
    }
    return system;
  }

  /// x' by the right side.
  [[nodiscard]] Eigen::MatrixXd by_right_side() const {
    Eigen::MatrixXd by(states_, states_ + followers_);
    by << Eigen::MatrixXd::Identity(states_, states_), -from_followers_;
    return over_inertia(by);
  }

  /// Whether every output is a state, or behind a resistance, where it is no state, and of white
  /// noise what the states leave.
  [[nodiscard]] bool outputs_have_size() const {
    const FlatCircuit& circuit = equations_.circuit();
    const std::vector<Node>& outputs = circuit.circuit().outputs;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      const auto is_behind_resistance = [&](const FlatCircuit::Amplifier& x) {
        return x.out == outputs[i] && circuit.opamp(x).output_resistance;
      };
      if (!to_outputs_.row(eigen_index(i)).tail(followers_).isZero(0.0) &&
          std::none_of(circuit.amplifiers().begin(), circuit.amplifiers().end(),
                       is_behind_resistance))
        return false;
    }
    return true;
  }

 private:
  void follow() {
    const Eigen::Index outputs = to_outputs_.rows();
    from_followers_.resize(states_, followers_);
    at_outputs_.resize(outputs, followers_);
    if (followers_ == 0) return;
    const Eigen::SparseMatrix<double>& g = equations_.conductances();
    Eigen::SparseMatrix<double> own = g.bottomRightCorner(followers_, followers_);
    // In units of each node's own conductance, so that no scale decides what is singular.
    Eigen::VectorXd units = Eigen::VectorXd::Zero(followers_);
    for (Eigen::Index column = 0; column < followers_; ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator one(own, column); one; ++one)
        units(one.row()) = std::max(units(one.row()), std::abs(one.value()));
    units = units.cwiseInverse().eval();
    const auto fail = [] {
      throw std::domain_error("nodes without capacitance have no unique voltage");
    };
    if (!units.allFinite()) fail();
    own = units.asDiagonal() * own;
    const SparseLu lu(own);
    if (!lu.regular() || !(lu.reciprocal_condition() > 1e-15)) fail();
    Eigen::MatrixXd into(followers_, states_ + outputs);
    into << Eigen::MatrixXd(g.topRightCorner(states_, followers_)).transpose(),
        to_outputs_.rightCols(followers_).transpose();
    const Eigen::MatrixXd by = lu.solve_transposed(into).transpose() * units.asDiagonal();
    from_followers_ = by.topRows(states_);
    at_outputs_ = by.bottomRows(outputs);
  }

  /// C^-1 of it.
  [[nodiscard]] Eigen::MatrixXd over_inertia(const Eigen::MatrixXd& of) const {
    return inertia_ ? inertia_->solve(of) : of;
  }

  [[nodiscard]] Eigen::VectorXd drive(const Eigen::VectorXd& right) const {
    const Eigen::VectorXd into = right.head(states_) - from_followers_ * right.tail(followers_);
    return over_inertia(into);
  }

  NodalEquations equations_;
  Eigen::Index states_, followers_;
  std::optional<SparseLu> inertia_{};
  Eigen::MatrixXd to_outputs_;  // v = M x
  // What the right side of the followers' equations does to the states' and to the outputs.
  Eigen::MatrixXd from_followers_, at_outputs_;
};

/// What noise adds to the right side, as intensities of white noise [two-sided]; of 1/f noise that
/// at 1 Hz.
struct Intensity {
  Eigen::SparseMatrix<double> thermal, amplifiers, flicker;
};

Intensity intensity_of(const NodalEquations& equations, double kelvin) {
  constexpr double boltzmann = 1.380649e-23;
  using Triplets = std::vector<Eigen::Triplet<double>>;
  const auto add = [](Triplets& to, const auto& terms, double density) {
    stamp(terms, terms, density, [&](std::size_t row, std::size_t column, double value) {
      to.emplace_back(eigen_index(row), eigen_index(column), value);
    });
  };
  Triplets thermal, amplifiers, flicker;
  for (const Resistor& r : equations.circuit().circuit().resistors)
    add(thermal, equations.nodes().between(r.from, r.to).law,
        2.0 * boltzmann * kelvin * std::abs(r.siemens));
  for (std::size_t k = 0; k < equations.amplifiers().size(); ++k) {
    const auto& [opamp, core] = equations.amplifiers()[k];
    const std::array own = {NodalTerm{core}};
    const double white = 0.5 * std::pow(opamp.noise_voltage.value_or(0.0), 2);
    add(amplifiers, own, white);
    add(flicker, own, opamp.noise_corner.value_or(0.0) * white);
    const FlatCircuit::Amplifier& x = equations.circuit().amplifiers()[k];
    for (const Node input : {x.plus, x.minus})
      add(amplifiers, equations.nodes().laws[input],
          0.5 * std::pow(opamp.noise_current.value_or(0.0), 2));
  }
  const auto matrix = [&](const Triplets& entries) {
    Eigen::SparseMatrix<double> result(equations.size(), equations.size());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  };
  return {matrix(thermal), matrix(amplifiers), matrix(flicker)};
}

}  // namespace

StateSpace state_space(const FlatCircuit& circuit) { return Followed(circuit).system(); }

OutputNoise output_noise(const FlatCircuit& circuit, double kelvin, double lowest_hertz) {
  if (!(kelvin >= 0.0) || !std::isfinite(kelvin))
    throw std::invalid_argument("a temperature must be >= 0 and finite");
  if (!(lowest_hertz > 0.0) || !std::isfinite(lowest_hertz))
    throw std::invalid_argument("the frequency that 1/f noise begins at must be > 0 and finite");
  const Followed followed(circuit);
  const StateSpace system = followed.system();
  const Eigen::MatrixXd c = as_eigen(system.output);
  if (!followed.outputs_have_size())
    throw std::domain_error("white noise at an output without capacitance has no size");
  const Lyapunov equation(as_eigen(system.dynamics));
  if (!(equation.largest_real_part() < 0.0))
    throw std::domain_error("an unstable circuit's noise grows without end");
  const Intensity noise = intensity_of(followed.equations(), kelvin);
  const Eigen::MatrixXd by = followed.by_right_side();
  const auto into_states = [&](const Eigen::SparseMatrix<double>& of) -> Eigen::MatrixXd {
    return Eigen::MatrixXd(by * of) * by.transpose();
  };
  const auto at_outputs = [&](const Eigen::MatrixXd& covariance) {
    return from_eigen(c * covariance * c.transpose());
  };
  const Eigen::MatrixXd flicker = into_states(noise.flicker);
  return {at_outputs(equation.solve(into_states(noise.thermal))),
          at_outputs(equation.solve(into_states(noise.amplifiers))),
          at_outputs(flicker.isZero(0.0)
                         ? flicker
                         : equation.solve_flicker(flicker, angular_frequency(lowest_hertz)))};
}

}  // namespace tactile_net
