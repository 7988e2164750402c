// dft: division by the kernel's DFT, with known friction (thesis 3.2), or least squares frequency
// by frequency where there are several channels.
#include "tactile_net/inverse/thesis/dft.hpp"

#include <algorithm>
#include <stdexcept>

#include "inverse/checks.hpp"
#include "lab/methods/frame_check.hpp"
#include "lab/methods/methods.hpp"
#include "tactile_net/inverse/alpha_tables.hpp"
#include "tactile_net/inverse/thesis/dft_friction.hpp"
#include "tactile_net/inverse/thesis/dft_tikhonov.hpp"

namespace tactile_net::lab {
namespace {

Remarks dead_taxels(const Scene& scene) {
  if (scene.dead_taxels.empty()) return {};
  return {remark::DeadTaxelsRead{}};
}

/// Of one quantity at one depth: without alpha.
class Division final : public FrameSolver {
 public:
  explicit Division(const Scene& scene)
      : inverse_(scene.sensor, scene.material, scene.reconstruct.noise_gain_limit),
        count_(scene.sensor.count) {
    const NoiseGain& gain = inverse_.noise_gain();
    if (inverse_.verdict() != DftVerdict::ok)
      remarks_.emplace_back(remark::NoiseAmplified{gain.largest});
    if (gain.sign_changes > 0) remarks_.emplace_back(remark::SignChanges{gain.sign_changes});
    for (const Remark& one : dead_taxels(scene)) remarks_.push_back(one);
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    FrameResult result{.status = inverse_.solve(readings, tractions)};
    if (result.status != FrameStatus::ok) return result;
    const DftVerdict verdict = inverse_.verdict(readings);
    result.verdict = verdict_of(verdict);
    result.condition = {inverse_.noise_gain().largest, Condition::Kind::noise_gain,
                        Condition::Matrix::kernel};
    result.remarks = remarks_;
    if (verdict == DftVerdict::cut_off) result.remarks.emplace_back(remark::CutOff{});
    return result;
  }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double> readings,
                                                  std::span<const double>) override {
    return inverse_.forward_bound(readings);
  }
  [[nodiscard]] std::size_t tractions() const override { return count_; }
  [[nodiscard]] Remarks remarks() const override { return remarks_; }

 private:
  DftInverse inverse_;
  std::size_t count_;
  Remarks remarks_;
};

/// Of one channel with known friction.
class Sliding final : public FrameSolver {
 public:
  explicit Sliding(const Scene& scene)
      : inverse_(scene.sensor, scene.material, *scene.reconstruct.contact_friction,
                 scene.reconstruct.noise_gain_limit),
        count_(scene.sensor.count),
        remarks_(dead_taxels(scene)) {}

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    if (tractions.size() != 2 * count_) return {.status = FrameStatus::wrong_size};
    const FrictionSolution solution = inverse_.solve(readings);
    if (solution.status != FrameStatus::ok) return {.status = solution.status};
    std::copy(solution.normal.begin(), solution.normal.end(), tractions.begin());
    std::copy(solution.tangential.begin(), solution.tangential.end(),
              tractions.begin() + static_cast<std::ptrdiff_t>(count_));
    FrameResult result{
        .verdict = verdict_of(solution),
        .condition = Condition{inverse_.division().noise_gain().largest,
                               Condition::Kind::noise_gain, Condition::Matrix::kernel},
        .remarks = remarks_};
    if (solution.verdict == FrictionVerdict::not_one_contact)
      result.remarks.emplace_back(remark::NotOneContact{});
    if (solution.verdict == FrictionVerdict::drag_in_noise)
      result.remarks.emplace_back(remark::DragInNoise{});
    return result;
  }
  [[nodiscard]] std::size_t tractions() const override { return 2 * count_; }
  [[nodiscard]] Remarks remarks() const override { return remarks_; }

 private:
  DftFriction inverse_;
  std::size_t count_;
  Remarks remarks_;
};

/// Of several channels, the dead taxels for living ones.
class Frequencies final : public FrameSolver {
 public:
  Frequencies(const SceneProblem& problem, std::optional<double> alpha)
      : inverse_(own(problem)),
        readings_(problem.readings()),
        tractions_(problem.tractions()),
        rule_(problem.scene().reconstruct.alpha_rule),
        given_(alpha),
        noise_(problem.stated_noise()) {
    for (const DftNullMode& mode : inverse_.null_modes())
      remarks_.emplace_back(remark::NullMode{mode});
    for (const Remark& one : dead_taxels(problem.scene())) remarks_.push_back(one);
  }

  FrameResult solve(std::span<const double> readings, std::span<double> tractions) override {
    ChosenAlpha alpha{.value = given_.value_or(0.0)};
    if (!given_) {
      if (const auto status = check_frame(readings, readings_, tractions, tractions_);
          status != FrameStatus::ok)
        return {.status = status};
      const FilterFrame frame = inverse_.analyse(readings);
      if (!tables_) tables_.emplace(frame.gamma, frame.rows);
      const AlphaRule rule = rule_.value_or(default_rule(*tables_, noise_.has_value()));
      const AlphaChoice choice = sweep_alpha(frame, *tables_, noise_).choice(rule);
      alpha = {choice.alpha, choice.rule, choice.verdict};
    }
    FrameResult result{.status = inverse_.solve(readings, alpha.value, tractions)};
    if (result.status != FrameStatus::ok) return result;
    alpha_ = alpha.value;
    result.alpha = alpha;
    result.verdict = alpha.verdict != AlphaVerdict::ok ? verdict_of(alpha.verdict)
                     : inverse_.null_modes().empty()   ? Verdict::ok
                                                       : Verdict::null_mode;
    result.condition = {inverse_.condition(alpha.value), Condition::Kind::exact,
                        Condition::Matrix::circular};
    result.remarks = remarks_;
    if (inverse_.cut_off(readings, alpha.value)) {
      result.verdict = Verdict::cut_off;
      result.remarks.emplace_back(remark::CutOff{});
    }
    return result;
  }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double> readings,
                                                  std::span<const double> tractions) override {
    return inverse_.forward_bound(readings, alpha_, tractions);
  }
  [[nodiscard]] std::size_t tractions() const override { return tractions_; }
  [[nodiscard]] Remarks remarks() const override { return remarks_; }

 private:
  static DftTikhonov own(const SceneProblem& problem) {
    LineProblemOptions options = problem.options();
    options.dead_taxels.clear();
    return {problem.scene().sensor, problem.scene().material, options};
  }

  DftTikhonov inverse_;
  std::size_t readings_;
  std::size_t tractions_;
  std::optional<AlphaRule> rule_;
  std::optional<AlphaTables> tables_;  // of the first frame, for all
  std::optional<double> given_;
  std::optional<double> noise_;
  double alpha_ = 0.0;  // of the last frame
  Remarks remarks_;
};

}  // namespace

std::unique_ptr<FrameSolver> make_dft(const SceneProblem& problem, std::optional<double> alpha) {
  const Scene& scene = problem.scene();
  require_at_taxels(scene.reconstruct.surface);
  require_known_offsets(scene.reconstruct.offset, "dft");
  if (scene.reconstruct.contact_friction) return std::make_unique<Sliding>(scene);
  if (channel_count(scene.sensor) == 1) return std::make_unique<Division>(scene);
  if (problem.estimates_weight())
    throw std::invalid_argument(
        "dft takes a tangential_weight that is stated: tikhonov estimates one");
  return std::make_unique<Frequencies>(problem, alpha);
}

}  // namespace tactile_net::lab
