#include "tactile_net/network/soldered_error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include "network/draw_stability.hpp"
#include "network/opamp_draws.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"

namespace tactile_net {
namespace {

Eigen::MatrixXd right_sides(const Reduction& reduction, std::span<const Load> loads,
                            std::span<const double> siemens) {
  if (loads.empty()) throw std::invalid_argument("a loaded network needs a load");
  Eigen::MatrixXd all(static_cast<Eigen::Index>(reduction.rows()),
                      static_cast<Eigen::Index>(loads.size()));
  for (std::size_t load = 0; load < loads.size(); ++load) {
    const std::vector<double> one = reduction.right_side(loads[load], siemens);
    all.col(static_cast<Eigen::Index>(load)) = as_eigen(std::span(one));
  }
  return all;
}

}  // namespace

struct LoadedNetwork::Solved {
  Solved(const Reduction& network, std::span<const Load> given, BuiltOpAmps built)
      : reduction(network),
        loads(given.begin(), given.end()),
        resting(std::move(built.errors)),
        counted(built.tare ? without_rest(resting) : resting),
        balance(built.balance),
        draws(network, counted, balance),
        draws_at_rest(network, resting, balance),
        right(right_sides(network, given, network.siemens())),
        lu(as_eigen(network.equations().matrix)),
        unknowns(lu.solve(right)),
        outputs(unknowns.topRows(static_cast<Eigen::Index>(network.outputs()))),
        sizes(outputs.colwise().norm()) {
    if (!unknowns.allFinite()) throw std::domain_error("the network has no unique answer");
    if (!(sizes.minCoeff() > 0.0))
      throw std::domain_error("without an answer there is nothing to err from");
    shifts.resize(outputs.rows(), outputs.cols());
    for (Eigen::Index load = 0; load < outputs.cols(); ++load) {
      const std::vector<double> shift = total_shift(counted, static_cast<std::size_t>(load),
                                                    static_cast<std::size_t>(outputs.rows()));
      shifts.col(load) = as_eigen(std::span(shift));
    }
  }

  [[nodiscard]] Eigen::MatrixXd to_outputs() const {
    return lu.inverse().topRows(outputs.rows()).transpose();
  }

  /// Of changes d(S z - h) made from the resistors', a row each.
  [[nodiscard]] std::vector<double> squares(
      std::size_t count,
      const std::function<Eigen::MatrixXd(const Eigen::Map<const RowMajor>&)>& changes) const {
    const Eigen::MatrixXd by_currents = to_outputs();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    for (Eigen::Index load = 0; load < unknowns.cols(); ++load) {
      const Eigen::VectorXd z = unknowns.col(load);
      const Matrix each = reduction.sensitivities({z.data(), static_cast<std::size_t>(z.size())},
                                                  loads[static_cast<std::size_t>(load)]);
      sum += (changes(as_eigen(each)) * by_currents).rowwise().squaredNorm() /
             (sizes(load) * sizes(load));
    }
    sum /= static_cast<double>(unknowns.cols());
    return {sum.begin(), sum.end()};
  }

  /// The outputs less the nominal ones, of other conductances.
  [[nodiscard]] Eigen::MatrixXd moved(const Equations& equations,
                                      std::span<const double> siemens) const {
    const Lu own(as_eigen(equations.matrix));
    const Eigen::MatrixXd z =
        own.solve(reduction.has_voltages() ? right_sides(reduction, loads, siemens) : right);
    return z.topRows(outputs.rows()) - outputs;
  }

  [[nodiscard]] double relative(const Eigen::MatrixXd& off) const {
    const double square = (off.colwise().norm().array() / sizes.array()).square().mean();
    return std::isfinite(square) ? std::sqrt(square) : std::numeric_limits<double>::infinity();
  }

  const Reduction& reduction;
  const std::vector<Load> loads;
  const OpAmpErrors resting;  // of the builds as they are
  const OpAmpErrors counted;  // and of their answers as they are read
  const double balance;
  const OpAmpDraws draws;
  const OpAmpDraws draws_at_rest;
  Eigen::MatrixXd right;
  Lu lu;
  Eigen::MatrixXd unknowns;
  Eigen::MatrixXd outputs;
  Eigen::RowVectorXd sizes;
  Eigen::MatrixXd shifts;  // what the op-amps of every build add, a column a load
};

LoadedNetwork::LoadedNetwork(const Reduction& reduction, std::span<const Load> loads,
                             BuiltOpAmps opamps)
    : solved_(std::make_unique<const Solved>(reduction, loads, std::move(opamps))) {}
LoadedNetwork::LoadedNetwork(LoadedNetwork&&) noexcept = default;
LoadedNetwork::~LoadedNetwork() = default;

std::vector<double> LoadedNetwork::sensitivities() const {
  return solved_->squares(solved_->reduction.resistors().size(),
                          [](const auto& each) -> Eigen::MatrixXd { return each; });
}

std::vector<double> LoadedNetwork::squared_errors(
    std::span<const std::vector<ResistorChange>> changes) const {
  return solved_->squares(changes.size(), [&](const auto& each) -> Eigen::MatrixXd {
    Eigen::MatrixXd sums =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(changes.size()), each.cols());
    for (std::size_t c = 0; c < changes.size(); ++c)
      for (const ResistorChange& one : changes[c])
        sums.row(static_cast<Eigen::Index>(c)) +=
            one.relative * each.row(static_cast<Eigen::Index>(one.resistor));
    return sums;
  });
}

double LoadedNetwork::error(std::span<const double> siemens) const {
  Equations equations;
  solved_->reduction.assemble(siemens, equations);
  return solved_->relative(solved_->moved(equations, siemens));
}

OpAmpShares LoadedNetwork::opamp_shares() const {
  const Solved& s = *solved_;
  OpAmpShares squares;
  const auto add = [](double& sum, double share) { sum += share * share; };
  const Eigen::MatrixXd by_currents = s.to_outputs();
  for (Eigen::Index load = 0; load < s.outputs.cols(); ++load) {
    const OpAmpShares one = shares(s.counted, static_cast<std::size_t>(load), s.sizes(load));
    add(squares.offset, one.offset);
    add(squares.bias_current, one.bias_current);
    add(squares.gain, one.gain);
    add(squares.common_mode, one.common_mode);
    add(squares.output_resistance, one.output_resistance);
    add(squares.total, one.total);
    if (s.balance > 0.0 && s.reduction.complementary() > 0) {
      const Eigen::VectorXd z = s.unknowns.col(load);
      const Matrix each =
          s.reduction.balance_sensitivities({z.data(), static_cast<std::size_t>(z.size())});
      add(squares.balance,
          s.balance / std::sqrt(3.0) * (as_eigen(each) * by_currents).norm() / s.sizes(load));
    }
  }
  const auto loads = static_cast<double>(s.outputs.cols());
  const auto root = [&](double sum) { return std::sqrt(sum / loads); };
  return {.offset = root(squares.offset),
          .bias_current = root(squares.bias_current),
          .balance = root(squares.balance),
          .gain = root(squares.gain),
          .common_mode = root(squares.common_mode),
          .output_resistance = root(squares.output_resistance),
          .total = root(squares.total + squares.balance)};
}

std::vector<double> LoadedNetwork::offsets(const ResistorErrors& of_resistors, std::size_t count,
                                           std::uint64_t seed) const {
  std::vector<double> result;
  if (!solved_->resting.any_of_inputs()) return result;
  for (std::size_t build = 0; build < count; ++build)
    result.push_back(solved_->relative(
        solved_->draws_at_rest.of_inputs(seed, build, of_resistors.kelvin(seed, build))
            .replicate(1, solved_->outputs.cols())));
  return result;
}

std::vector<double> LoadedNetwork::builds(std::span<const double> printed,
                                          const ResistorErrors& of_resistors, std::size_t count,
                                          std::uint64_t seed) const {
  const std::size_t resistors = solved_->reduction.resistors().size();
  if (printed.size() != resistors || of_resistors.size() != resistors)
    throw std::invalid_argument("builds need a conductance and an error a resistor");
  std::vector<double> errors;
  std::vector<double> siemens;
  Equations equations;
  for (std::size_t build = 0; build < count; ++build) {
    siemens.assign(printed.begin(), printed.end());
    of_resistors.draw(seed, build, siemens);
    solved_->reduction.assemble(siemens, equations, solved_->draws.balances(seed, build));
    if (!is_stable(solved_->reduction, equations)) {
      errors.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    const Eigen::MatrixXd off =
        (solved_->moved(equations, siemens) + solved_->shifts).colwise() +
        solved_->draws.of_inputs(seed, build, of_resistors.kelvin(seed, build));
    errors.push_back(solved_->relative(off));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace tactile_net
