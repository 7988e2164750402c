#include "tactile_net/network/board_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "network/nodal_equations.hpp"
#include "network/random.hpp"
#include "numeric/cholesky.hpp"
#include "numeric/decompositions.hpp"
#include "numeric/eigen.hpp"
#include "numeric/named.hpp"
#include "tactile_net/network/tolerance.hpp"

namespace tactile_net {
namespace {

constexpr std::size_t most_candidates = 10;
/// The best by the circuit's own sensitivities are tried with those of the faulty board.
constexpr std::size_t most_shortlisted = 24;
/// Of this many parts every fault is on that list.
constexpr std::size_t parts_with_every_fault = 4;
/// Multiplications that closer looks may take together, but for the first of them.
constexpr double most_work = 2e11;
constexpr std::size_t least_looks = 6;
/// Where a fault moves much, other parts' errors move with what it does: so much of it.
constexpr double share_of_large = 0.02;
/// Of swaps, one part is among those that explain most by themselves.
constexpr std::size_t swap_partners = 64;
constexpr std::size_t most_exact_swaps = 256;
/// Parts whose values are nearer than this swap unseen.
constexpr double alike_values = 0.05;
/// A bridge, over the part's own conductance.
constexpr double bridge = 1e6;
/// 5 of 100 healthy boards are thought faulty at most, and a likelihood 20 times less is as good.
constexpr double one_in_twenty = 3.0;  // log 20

constexpr std::array<std::pair<PartFault, double>, 4> fixed_faults = {{{PartFault::open, 0.0},
                                                                       {PartFault::shorted, bridge},
                                                                       {PartFault::ten_times, 0.1},
                                                                       {PartFault::tenth, 10.0}}};

/// The equations of one set of conductances, under patterns of currents.
struct SolvedBoard {
  Eigen::MatrixXd unknowns;    // z of each pattern, a column
  Eigen::MatrixXd to_outputs;  // outputs by a current into each row
  Eigen::MatrixXd inverse;
};

/// What a change of each part's conductance does.
struct PartEffects {
  Eigen::MatrixXd at_outputs;  // a_r: a column a part
  Eigen::MatrixXd voltages;    // b_r: of each pattern, a column a part
  Eigen::MatrixXd columns;     // a_r b_r' as it is measured, a column a part
};

/// Voltages as measured, outputs a row; those that are not numbers are missing.
struct Measured {
  Measured(const Matrix& measured, double deviation)
      : voltages(as_eigen(measured).transpose()), noise(deviation) {
    for (Eigen::Index k = 0; k < voltages.size(); ++k)
      if (!std::isnan(voltages.data()[k])) present.push_back(k);
  }

  /// What there is of a matrix of that shape, in one column.
  [[nodiscard]] Eigen::VectorXd of(const Eigen::MatrixXd& answers) const {
    Eigen::VectorXd some(eigen_index(present.size()));
    for (std::size_t k = 0; k < present.size(); ++k)
      some(eigen_index(k)) = answers.data()[present[k]];
    return some;
  }
  [[nodiscard]] Eigen::VectorXd off(const Eigen::MatrixXd& answers) const {
    return of(voltages - answers);
  }

  Eigen::MatrixXd voltages;
  std::vector<Eigen::Index> present;
  double noise;
};

std::vector<double> plain_tolerances(std::vector<double> tolerances, std::size_t parts) {
  if (tolerances.size() != parts)
    throw std::invalid_argument("a tolerance of each resistor needs one value a resistor");
  for (const double one : tolerances)
    if (!(one > 0.0 && one < 1.0)) throw std::invalid_argument("a tolerance must be > 0 and < 1");
  return tolerances;
}

}  // namespace

std::string_view name(PartFault fault) noexcept {
  return name_in<Enumerators<PartFault>::all>(fault);
}

std::vector<BoardInput> board_inputs(std::span<const CurrentSource> sources) {
  std::vector<BoardInput> inputs;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::string& name = sources[i].name;
    const std::string stem = name.substr(0, name.size() - 1);
    if (i + 1 < sources.size() && name.ends_with('p') && sources[i + 1].name == stem + 'n') {
      inputs.push_back(
          {stem, {{name, sources[i].into, -1.0}, {sources[i + 1].name, sources[i + 1].into, 1.0}}});
      ++i;
    } else {
      inputs.push_back({name, {{name, sources[i].into, 1.0}}});
    }
  }
  return inputs;
}

std::vector<double> with_fault(std::span<const double> siemens, const BoardFault& fault) {
  std::vector<double> built(siemens.begin(), siemens.end());
  if (fault.kind == PartFault::swapped)
    std::swap(built[fault.part], built[fault.other]);
  else
    built[fault.part] *= fault.factor;
  return built;
}

namespace {

/// What a bench knows of the circuit.
struct BoardParts {
  BoardParts(const Reduction& network, std::vector<BoardInput> driven, std::vector<double> within)
      : reduction(network),
        inputs(std::move(driven)),
        tolerances(plain_tolerances(std::move(within), network.resistors().size())) {
    if (inputs.empty()) throw std::invalid_argument("a board without inputs has no responses");
    for (std::size_t r = 0; r < reduction.resistors().size(); ++r)
      branches.push_back(reduction.branch(r));
    by_input.resize(eigen_index(reduction.rows()), eigen_index(inputs.size()));
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const std::vector<double> right = reduction.right_side(inputs[i].per_ampere);
      by_input.col(eigen_index(i)) = as_eigen(std::span(right));
    }
  }

  [[nodiscard]] std::size_t outputs() const noexcept { return reduction.outputs(); }
  [[nodiscard]] std::span<const double> nominal() const noexcept { return reduction.siemens(); }

  [[nodiscard]] SolvedBoard solve(std::span<const double> siemens,
                                  const Eigen::MatrixXd& currents) const {
    Equations equations;
    reduction.assemble(siemens, equations);
    SolvedBoard solved;
    solved.inverse = Lu(as_eigen(equations.matrix)).inverse();
    if (!solved.inverse.allFinite()) throw std::domain_error("the board has no unique answer");
    solved.unknowns = solved.inverse * (by_input * currents.transpose());
    solved.to_outputs = solved.inverse.topRows(eigen_index(outputs()));
    return solved;
  }

  /// Outputs a row, patterns a column.
  [[nodiscard]] Eigen::MatrixXd answers(const SolvedBoard& solved) const {
    return solved.unknowns.topRows(eigen_index(outputs()));
  }

  [[nodiscard]] PartEffects effects(const SolvedBoard& solved, const Measured& measured) const {
    const Eigen::Index parts = eigen_index(branches.size());
    const Eigen::Index patterns = solved.unknowns.cols();
    const Eigen::Index n = eigen_index(outputs());
    PartEffects all{Eigen::MatrixXd::Zero(n, parts), Eigen::MatrixXd::Zero(patterns, parts),
                    Eigen::MatrixXd(eigen_index(measured.present.size()), parts)};
    for (Eigen::Index r = 0; r < parts; ++r) {
      const Reduction::Branch& branch = branches[static_cast<std::size_t>(r)];
      for (const auto& [row, factor] : branch.law)
        all.at_outputs.col(r) += factor * solved.to_outputs.col(eigen_index(row));
      for (const auto& [at, factor] : branch.voltage)
        all.voltages.col(r) += factor * solved.unknowns.row(eigen_index(at)).transpose();
      all.columns.col(r) = measured.of(all.at_outputs.col(r) * all.voltages.col(r).transpose());
    }
    return all;
  }

  /// The voltage at one part by a current through another.
  [[nodiscard]] double across(const SolvedBoard& solved, std::size_t part, std::size_t by) const {
    double sum = 0.0;
    for (const auto& [at, of_voltage] : branches[part].voltage)
      for (const auto& [row, of_law] : branches[by].law)
        sum += of_voltage * of_law * solved.inverse(eigen_index(at), eigen_index(row));
    return sum;
  }

  const Reduction& reduction;
  std::vector<BoardInput> inputs;
  std::vector<double> tolerances;
  std::vector<Reduction::Branch> branches;
  Eigen::MatrixXd by_input;  // rows by inputs
};

/// Parts' variances, of uniform errors.
Eigen::VectorXd variances_of(std::span<const double> tolerances) {
  return as_eigen(tolerances).cwiseAbs2() / 3.0;
}

/// Responses of boards within their tolerances have the mean and the covariance of the circuit
/// linearised about some conductances: tested against, and the parts told by it.
struct LinearBoard {
  LinearBoard(const PartEffects& effects, std::span<const double> siemens,
              std::span<const double> tolerances, double noise)
      : by_part(effects.columns * (-as_eigen(siemens)).asDiagonal()),
        variances(variances_of(tolerances)),
        covariance(decomposed(by_part, variances, noise)) {}
  /// With a part whose value is not known: of its logarithm the deviation is 1.
  LinearBoard(const PartEffects& effects, std::span<const double> siemens,
              std::span<const double> tolerances, double noise, std::size_t unknown)
      : by_part(effects.columns * (-as_eigen(siemens)).asDiagonal()),
        variances(variances_of(tolerances)),
        covariance([&] {
          variances(eigen_index(unknown)) = 1.0;
          return decomposed(by_part, variances, noise);
        }()) {}

  static Cholesky decomposed(const Eigen::MatrixXd& by_part, const Eigen::VectorXd& variances,
                             double noise) {
    const Eigen::MatrixXd scaled = by_part * variances.cwiseSqrt().asDiagonal();
    Eigen::MatrixXd sum = scaled * scaled.transpose();
    sum.diagonal().array() += noise * noise;
    return Cholesky(sum);
  }

  /// sigma^-1/2 x.
  [[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& x) const {
    return covariance.solve_lower(x);
  }

  Eigen::MatrixXd by_part;    // d(answers) / d(log conductance)
  Eigen::VectorXd variances;  // of those logarithms
  Cholesky covariance;
};

/// Twice the negative log likelihood of that distance from the mean, but for a constant.
double improbability(const LinearBoard& linear, const Eigen::VectorXd& off) {
  return linear.whitened(off).squaredNorm() + linear.covariance.log_determinant();
}

double log10_of(double natural) { return natural / std::numbers::ln10; }

/// Every fault by itself, against the responses.
class FaultSearch {
 public:
  FaultSearch(const BoardParts& board, const SolvedBoard& solved, const PartEffects& effects,
              const Measured& measured, const LinearBoard& linear)
      : board_(board),
        solved_(solved),
        effects_(effects),
        measured_(measured),
        linear_(linear),
        off_(linear.whitened(measured.off(board.answers(solved)))),
        columns_(linear.whitened(effects.columns)),
        along_(columns_.transpose() * off_),
        squares_(columns_.colwise().squaredNorm()) {}

  void run() {
    for (std::size_t r = 0; r < board_.branches.size(); ++r) try_alone(r);
    try_swaps();
    std::stable_sort(found_.begin(), found_.end(),
                     [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
    if (found_.size() > most_shortlisted) found_.resize(most_shortlisted);
  }

  [[nodiscard]] std::vector<BoardDiagnosis::Candidate> found() && { return std::move(found_); }
  [[nodiscard]] double tried() const noexcept { return tried_; }
  [[nodiscard]] double squared() const { return off_.squaredNorm(); }

 private:
  void keep(const BoardFault& fault, double gained) {
    tried_ += 1.0;
    found_.push_back({fault, log10_of(gained)});
    if (found_.size() < 4096) return;
    std::nth_element(found_.begin(), found_.begin() + most_shortlisted, found_.end(),
                     [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
    found_.resize(most_shortlisted);
  }

  /// What a change of one conductance makes of the inverse: a factor of its column.
  [[nodiscard]] static double reach(double change, double across) {
    return -change / (1.0 + change * across);
  }

  void try_alone(std::size_t r) {
    const double siemens = board_.nominal()[r];
    const double own = board_.across(solved_, r, r);
    const double along = along_(eigen_index(r));
    const double square = squares_(eigen_index(r));
    if (!(square > 0.0)) return;
    const auto gained = [&](double factor) {
      const double c = reach((factor - 1.0) * siemens, own);
      return c * along - 0.5 * c * c * square;
    };
    for (const auto& [kind, factor] : fixed_faults)
      keep({.kind = kind, .part = r, .factor = factor}, gained(factor));
    // Of a value that is not known: c as if drawn with the part's conductance as its deviation,
    // which costs what it may be.
    const double prior = siemens * siemens;
    const double best = along / (square + 1.0 / prior);
    const double factor = 1.0 - best / (siemens * (1.0 + best * own));
    if (!(factor > 0.0) || !std::isfinite(factor)) return;
    keep({.kind = PartFault::other_value, .part = r, .factor = factor},
         0.5 * along * best - 0.5 * std::log1p(prior * square));
  }

  void try_swaps() {
    const auto parts = board_.branches.size();
    std::vector<std::size_t> order(parts);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t most = std::min(swap_partners, parts);
    const auto alone = [&](std::size_t r) {
      const double square = squares_(eigen_index(r));
      return square > 0.0 ? std::pow(along_(eigen_index(r)), 2) / square : 0.0;
    };
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most), order.end(),
                      [&](std::size_t a, std::size_t b) { return alone(a) > alone(b); });
    struct Pair {
      std::size_t first, second;
      double gained;
    };
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < most; ++k) {
      const std::size_t r = order[k];
      const Eigen::VectorXd products = columns_.transpose() * columns_.col(eigen_index(r));
      for (std::size_t s = 0; s < parts; ++s) {
        // Of two that are both among the first, once.
        const auto place =
            std::find(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k), s) -
            order.begin();
        if (s == r || place < static_cast<std::ptrdiff_t>(k)) continue;
        const double change = board_.nominal()[s] - board_.nominal()[r];
        if (std::abs(std::log(std::abs(board_.nominal()[s] / board_.nominal()[r]))) < alike_values)
          continue;
        tried_ += 1.0;
        const double c = reach(change, board_.across(solved_, r, r));
        const double d = reach(-change, board_.across(solved_, s, s));
        pairs.push_back(
            {r, s,
             c * along_(eigen_index(r)) + d * along_(eigen_index(s)) -
                 0.5 * (c * c * squares_(eigen_index(r)) + d * d * squares_(eigen_index(s))) -
                 c * d * products(eigen_index(s))});
      }
    }
    const std::size_t exact = std::min(most_exact_swaps, pairs.size());
    std::partial_sort(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(exact),
                      pairs.end(),
                      [](const Pair& a, const Pair& b) { return a.gained > b.gained; });
    for (std::size_t k = 0; k < exact; ++k)
      found_.push_back(
          {{.kind = PartFault::swapped,
            .part = pairs[k].first,
            .other = pairs[k].second,
            .factor = board_.nominal()[pairs[k].second] / board_.nominal()[pairs[k].first]},
           log10_of(gained_by_swap(pairs[k].first, pairs[k].second))});
  }

  /// Exactly, by Woodbury's formula of rank two.
  [[nodiscard]] double gained_by_swap(std::size_t r, std::size_t s) const {
    const double change = board_.nominal()[s] - board_.nominal()[r];
    Eigen::Matrix2d inner;
    inner << 1.0 / change + board_.across(solved_, r, r), board_.across(solved_, r, s),
        board_.across(solved_, s, r), -1.0 / change + board_.across(solved_, s, s);
    const double determinant = inner(0, 0) * inner(1, 1) - inner(0, 1) * inner(1, 0);
    Eigen::Matrix2d adjugate;
    adjugate << inner(1, 1), -inner(0, 1), -inner(1, 0), inner(0, 0);
    const Eigen::Matrix2d factors = -adjugate / determinant;
    const std::array<Eigen::Index, 2> of = {eigen_index(r), eigen_index(s)};
    Eigen::MatrixXd shift =
        Eigen::MatrixXd::Zero(effects_.at_outputs.rows(), effects_.voltages.rows());
    for (Eigen::Index k = 0; k < 2; ++k)
      for (Eigen::Index l = 0; l < 2; ++l)
        shift += factors(k, l) * effects_.at_outputs.col(of[static_cast<std::size_t>(k)]) *
                 effects_.voltages.col(of[static_cast<std::size_t>(l)]).transpose();
    const Eigen::VectorXd seen = linear_.whitened(measured_.of(shift));
    return seen.dot(off_) - 0.5 * seen.squaredNorm();
  }

  const BoardParts& board_;
  const SolvedBoard& solved_;
  const PartEffects& effects_;
  const Measured& measured_;
  const LinearBoard& linear_;
  Eigen::VectorXd off_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd along_;
  Eigen::RowVectorXd squares_;
  std::vector<BoardDiagnosis::Candidate> found_;
  double tried_ = 0.0;
};

/// As far as an open resistor has a logarithm.
std::vector<double> without_zeros(std::vector<double> siemens) {
  for (double& one : siemens)
    if (one == 0.0) one = std::numeric_limits<double>::min();
  return siemens;
}

/// With the sensitivities that a board with the fault has.
double improbability_of(const BoardParts& board, const BoardFault& fault,
                        const Eigen::MatrixXd& currents, const Measured& measured) {
  const std::vector<double> siemens = without_zeros(with_fault(board.nominal(), fault));
  const SolvedBoard solved = board.solve(siemens, currents);
  const PartEffects effects = board.effects(solved, measured);
  Eigen::VectorXd off = measured.off(board.answers(solved));
  if (fault.kind != PartFault::other_value)
    return improbability(LinearBoard(effects, siemens, board.tolerances, measured.noise), off);
  const LinearBoard linear(effects, siemens, board.tolerances, measured.noise, fault.part);
  off += linear.by_part.col(eigen_index(fault.part)) * std::log(fault.factor);
  return improbability(linear, off);
}

bool same(const BoardFault& a, const BoardFault& b) {
  if (a.kind != b.kind) return false;
  return (a.part == b.part && a.other == b.other) ||
         (a.kind == PartFault::swapped && a.part == b.other && a.other == b.part);
}

/// The faults that are worth a closer look.
std::vector<BoardFault> shortlist(const std::vector<BoardDiagnosis::Candidate>& candidates) {
  std::vector<BoardFault> list;
  const auto add = [&](const BoardFault& fault) {
    if (std::none_of(list.begin(), list.end(),
                     [&](const BoardFault& one) { return same(one, fault); }))
      list.push_back(fault);
  };
  std::vector<std::size_t> parts;
  for (const auto& [fault, evidence] : candidates) {
    add(fault);
    if (fault.kind == PartFault::swapped || parts.size() == parts_with_every_fault ||
        std::find(parts.begin(), parts.end(), fault.part) != parts.end())
      continue;
    parts.push_back(fault.part);
  }
  for (const std::size_t part : parts)
    for (const auto& [kind, factor] : fixed_faults)
      add({.kind = kind, .part = part, .factor = factor});
  return list;
}

/// Fills in what is said of faults.
void search(const BoardParts& board, const SolvedBoard& ideal, const Eigen::MatrixXd& currents,
            const Measured& measured, BoardDiagnosis& result) {
  const PartEffects effects = board.effects(ideal, measured);
  const Eigen::VectorXd off = measured.off(board.answers(ideal));
  const auto count = static_cast<double>(off.size());
  double healthy = 0.0;
  {
    const LinearBoard linear(effects, board.nominal(), board.tolerances, measured.noise);
    FaultSearch first(board, ideal, effects, measured, linear);
    first.run();
    healthy = improbability(linear, off);
    result.misfit = std::sqrt(first.squared() / count);
    result.needed = log10_of(std::log(first.tried()) + one_in_twenty);
    result.candidates = std::move(first).found();
  }
  if (result.candidates.empty()) return;
  const auto best_first = [&] {
    std::stable_sort(result.candidates.begin(), result.candidates.end(),
                     [](const auto& a, const auto& b) { return a.evidence > b.evidence; });
    if (result.candidates.size() > most_candidates) result.candidates.resize(most_candidates);
  };
  if (result.candidates.front().evidence < 0.5 * result.needed) return best_first();
  const double large = share_of_large * std::sqrt(off.squaredNorm() / count);
  if (large > measured.noise) {
    const LinearBoard linear(effects, board.nominal(), board.tolerances, large);
    FaultSearch second(board, ideal, effects, measured, linear);
    second.run();
    const auto more = std::move(second).found();
    result.candidates.insert(result.candidates.begin(), more.begin(), more.end());
  }
  std::vector<BoardFault> faults = shortlist(result.candidates);
  const double each = count * count * static_cast<double>(board.branches.size());
  const auto looks = static_cast<std::size_t>(most_work / each);
  if (faults.size() > looks) faults.resize(std::min(faults.size(), std::max(looks, least_looks)));
  result.candidates.clear();
  for (const BoardFault& fault : faults)
    result.candidates.push_back(
        {fault, log10_of(0.5 * (healthy - improbability_of(board, fault, currents, measured)))});
  best_first();
  const double best = result.candidates.front().evidence;
  if (best < result.needed) return;
  for (const auto& one : result.candidates)
    if (one.evidence >= best - log10_of(one_in_twenty)) ++result.named;
}

}  // namespace

struct BoardModel::Parts : BoardParts {
  using BoardParts::BoardParts;
};

BoardModel::BoardModel(const Reduction& reduction, std::vector<BoardInput> inputs,
                       std::vector<double> tolerances)
    : parts_(std::make_unique<const Parts>(reduction, std::move(inputs), std::move(tolerances))) {}
BoardModel::BoardModel(BoardModel&&) noexcept = default;
BoardModel::~BoardModel() = default;

std::span<const BoardInput> BoardModel::inputs() const noexcept { return parts_->inputs; }

Matrix BoardModel::exact(const Matrix& currents) const {
  const SolvedBoard solved = parts_->solve(parts_->nominal(), as_eigen(currents));
  return from_eigen(parts_->answers(solved).transpose());
}

Matrix BoardModel::single_inputs(double volts) const {
  const Eigen::Index count = eigen_index(parts_->inputs.size());
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(count, count);
  const Eigen::MatrixXd answers = parts_->answers(parts_->solve(parts_->nominal(), unit));
  RowMajor currents = RowMajor::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    currents(i, i) = volts / answers.col(i).lpNorm<Eigen::Infinity>();
  return from_eigen(currents);
}

BoardDiagnosis BoardModel::diagnose(const BoardResponses& responses) const {
  const Parts& board = *parts_;
  const Eigen::MatrixXd currents = as_eigen(responses.currents);
  const Measured measured(responses.voltages, responses.noise);
  if (currents.rows() == 0 || currents.rows() != measured.voltages.cols() ||
      currents.cols() != eigen_index(board.inputs.size()) ||
      measured.voltages.rows() != eigen_index(board.outputs()))
    throw std::invalid_argument(
        "responses need a current of each input and a voltage of each output in every pattern");
  if (responses.voltages.values.size() > most_responses)
    throw std::invalid_argument("more than " + std::to_string(most_responses) +
                                " voltages: measure fewer patterns");
  if (!currents.allFinite() || !measured.of(measured.voltages).allFinite() ||
      measured.present.empty() || !(responses.noise > 0.0))
    throw std::invalid_argument("currents and voltages must be finite, and their noise > 0");

  BoardDiagnosis result;
  const SolvedBoard ideal = board.solve(board.nominal(), currents);
  const Eigen::MatrixXd exact = board.answers(ideal);
  const auto count = static_cast<double>(measured.present.size());
  search(board, ideal, currents, measured, result);

  // The parts, beside the fault: Gauss and Newton's steps towards the most likely errors.
  std::vector<double> begin(board.nominal().begin(), board.nominal().end());
  if (result.named > 0) begin = without_zeros(with_fault(begin, result.candidates.front().fault));
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(eigen_index(begin.size()));
  Eigen::MatrixXd fitted;
  constexpr int steps = 3;
  for (int step = 0; step <= steps; ++step) {
    std::vector<double> siemens = begin;
    for (std::size_t r = 0; r < siemens.size(); ++r) siemens[r] *= std::exp(errors(eigen_index(r)));
    const SolvedBoard solved = board.solve(siemens, currents);
    fitted = board.answers(solved);
    if (step == steps) break;
    const LinearBoard linear(board.effects(solved, measured), siemens, board.tolerances,
                             responses.noise);
    const Eigen::VectorXd off = measured.off(fitted) + linear.by_part * errors;
    Eigen::MatrixXd weighted = off;
    linear.covariance.solve_in_place(weighted);
    errors = linear.variances.cwiseProduct(linear.by_part.transpose() * weighted.col(0));
    if (step == 0)
      result.misfit_with_fault = std::sqrt(std::max(off.dot(weighted.col(0)), 0.0) / count);
    if (step + 1 < steps) continue;
    const Eigen::MatrixXd seen = linear.whitened(linear.by_part);
    const Eigen::VectorXd known = seen.colwise().squaredNorm();
    for (Eigen::Index r = 0; r < errors.size(); ++r) {
      const double variance = linear.variances(r);
      result.part_deviations.push_back(
          std::sqrt(std::max(variance * (1.0 - variance * known(r)), 0.0)));
    }
  }
  result.part_errors.assign(errors.begin(), errors.end());

  // T fitted = exact as far as noise allows: the least correction of those.
  const Eigen::MatrixXd gap = exact - fitted;
  Eigen::MatrixXd gram = fitted * fitted.transpose();
  gram.diagonal().array() +=
      responses.noise * responses.noise * static_cast<double>(currents.rows());
  Eigen::MatrixXd added = fitted * gap.transpose();
  Cholesky(gram).solve_in_place(added);
  const Eigen::MatrixXd correction =
      Eigen::MatrixXd::Identity(gram.rows(), gram.cols()) + added.transpose();
  result.correction = from_eigen(correction);
  result.error = gap.norm() / exact.norm();
  result.remaining = (correction * fitted - exact).norm() / exact.norm();
  result.noise_gain = singular_values(correction).maxCoeff();
  return result;
}

}  // namespace tactile_net
