// What is a skin's own on the way of a frame.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "lab/border.hpp"
#include "lab/frame_method.hpp"
#include "lab/frame_sharing.hpp"
#include "lab/large_skin.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/recording_method.hpp"
#include "lab/skin_bands.hpp"
#include "lab/skin_data_verdict.hpp"
#include "lab/skin_method.hpp"
#include "lab/skin_mixture.hpp"
#include "skin/cell_wrench.hpp"
#include "tactile_net/inverse/error_bound.hpp"
#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/skin/space_wrench.hpp"

namespace tactile_net::lab {
namespace {

/// What chooses the alpha of a frame, before constraints; absent: the scene's rule, of this frame
/// alone.
using SkinAlphaChooser = std::function<AlphaChoice(const FilterFrame& frame)>;

ChosenAlpha alpha_of(const SkinSceneProblem& problem, const FilterFrame& frame,
                     const SkinAlphaChooser& choose) {
  if (const auto& given = problem.scene().reconstruct.alpha) return {.value = *given};
  const AlphaChoice choice = choose
                                 ? choose(frame)
                                 : choose_alone(frame, problem.alpha_tables(frame),
                                                problem.alpha_rule(frame), problem.stated_noise());
  const double alpha =
      problem.constraints() ? constrained_alpha(choice.rule, choice.alpha) : choice.alpha;
  return {.value = alpha, .rule = choice.rule, .verdict = choice.verdict};
}

/// How far rounding alone may have moved the tractions, over their 2-norm, in coordinates in which
/// the stabiliser is simple.
double rounding_bound(const FilterFrame& frame, double alpha, double condition,
                      std::size_t columns) {
  const double root = std::sqrt(alpha);
  double solution = 0.0;
  double residual = frame.outside;
  double right = frame.outside;
  double largest = root;
  for (std::size_t i = 0; i < frame.gamma.size(); ++i) {
    const double size = std::hypot(frame.gamma[i], root);
    solution = std::hypot(solution, frame.beta[i] / size * (frame.gamma[i] / size));
    residual = std::hypot(residual, frame.beta[i] * (root / size));  // with what alpha takes
    right = std::hypot(right, frame.beta[i]);
    largest = std::max(largest, frame.gamma[i]);
  }
  const double rounding = std::numeric_limits<double>::epsilon() / 2.0 *
                          std::sqrt(static_cast<double>(frame.rows + columns));
  return wedin_bound(condition, largest, right, residual, solution, rounding);
}

/// What a contact that reaches over the skin's edge amounts to, from an answer on a grid that
/// reaches further. The map stays as it is.
void take_from_beyond(FrameAnswer& answer, FrameAnswer beyond, const SurfaceGrid& from,
                      const SurfaceGrid& to) {
  if (beyond.cells.empty()) return;
  answer.patches.clear();
  for (ContactPatch& patch : beyond.patches)
    answer.patches.push_back(on_grid(std::move(patch), from, to));
  answer.wrench = beyond.wrench;
  answer.unseen = beyond.unseen;
  answer.ellipse = beyond.ellipse;
  if (!answer.friction || !beyond.friction) return;
  beyond.friction->cell_margins = std::move(answer.friction->cell_margins);  // of this grid's cells
  answer.friction = std::move(beyond.friction);
}

/// Whether the largest reading is more than noise and beside what no taxel sees: what presses is
/// there, or beyond.
bool strongest_at_edge(const SkinSceneProblem& problem, std::span<const double> readings,
                       double noise) {
  constexpr double deviations = 4.0;  // of the largest of many honest readings
  const LinearProblem& solved = problem.layout();
  const std::vector<double> seen = weighted(solved, readings);
  std::size_t strongest = 0;
  double most = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (const double size = std::abs(seen[i]); size > most) {
      most = size;
      strongest = i;
    }
  if (!(most > deviations * noise)) return false;
  const Site& site = solved.sites[strongest];
  const SurfaceGrid& grid = problem.grid();
  const double reach =
      std::max(grid.spacing_y, grid.spacing_z) + least_depth(problem.scene().sensor);
  for (std::size_t cell = 0; cell < grid.count(); ++cell)
    if (problem.unseen()[cell] && std::hypot(grid.y(cell / grid.columns) - site.y,
                                             grid.z(cell % grid.columns) - site.z) <= reach)
      return true;
  return false;
}

constexpr double most_assumed = 0.7;
/// Taxels, in depths: no deviation holds what is between. Under constraints that is `far_apart`.
constexpr double too_far_apart = 2.001;

/// Whether the readings, not what presses, decide where the force lies: it is then a guess.
bool is_guessed(const FrameAnswer& answer, const SkinSceneProblem& problem,
                std::span<const double> readings) {
  // That of a mixture is of no alpha.
  const bool may_be = answer.verdict != Verdict::ok || answer.mixture != nullptr;
  return answer.unseen > most_guessed || (answer.cells.empty() && may_be &&
                                          strongest_at_edge(problem, readings, answer.noise.rms()));
}

class SkinFrameMethod final : public FrameMethod {
 public:
  SkinFrameMethod(const SkinSceneProblem& given, std::span<const double> readings, bool by_mixture,
                  SkinAlphaChooser choose, std::optional<std::size_t> repeats)
      : mixture_(by_mixture ? mixture_of(given, readings) : nullptr),
        weight_(given.estimates_weight() && !is_mean(given)
                    ? std::optional(given.likeliest_weight(readings))
                    : std::nullopt),
        problem_(weight_ ? given.weighed(*weight_) : given),
        method_(method_of(problem_)),
        readings_(readings),
        frame_(method_->analyse(readings)),
        choose_(std::move(choose)),
        repeats_(repeats),
        mixture_left_out_(!choose_ && given.mixture_is_left_out()) {}

  ChosenAlpha alpha() override {
    ChosenAlpha alpha = alpha_of(problem_, frame_, choose_);
    alpha.tangential_weight = weight_;
    return alpha;
  }

  void solve(FrameAnswer& answer) override {
    answer.mixture = mixture_;
    if (is_mean(problem_)) {
      answer.tractions = mixture_->mean();
      answer.degrees_of_freedom = mixture_->degrees_of_freedom();
      answer.verdict = Verdict::ok;  // alpha's is not of it
    } else {
      solve_by_alpha(answer);
    }
    if (!std::all_of(answer.tractions.begin(), answer.tractions.end(),
                     [](double f) { return std::isfinite(f); }))
      throw FrameOverflow();
    if (problem_.is_large() && !answer.iteration) answer.iteration = FrameAnswer::Iteration{};
    answer.solved = answer.verdict;
    if (mixture_left_out_) answer.remarks.emplace_back(remark::MixtureLeftOut{});
  }

  [[nodiscard]] double residual(std::span<const double> tractions) const override {
    return method_->residual(readings_, tractions);
  }
  [[nodiscard]] double size_of_readings() const override {
    double all = 0.0;
    for (const double reading : weighted(problem_.layout(), readings_))
      all = std::hypot(all, reading);
    return all;
  }
  [[nodiscard]] std::size_t rows() const override { return frame_.rows; }
  [[nodiscard]] std::optional<double> rounding(const FrameAnswer& answer) const override {
    if (is_mean(problem_)) return std::nullopt;
    const double alpha = answer.alpha.value;
    return rounding_bound(frame_, alpha, method_->condition(alpha), problem_.tractions());
  }
  [[nodiscard]] bool ends_at_border(std::span<const double> tractions) const override {
    return presses_at_border(tractions.first(problem_.grid().count()), problem_.border());
  }
  [[nodiscard]] std::optional<DataVerdict> judge_data(
      std::span<const double> tractions) const override {
    return method_->judge(readings_, tractions);
  }
  [[nodiscard]] std::optional<std::vector<double>> unconstrained(double alpha) const override {
    if (!problem_.constraints()) return std::nullopt;
    return method_->solve(frame_, readings_, alpha);
  }

  [[nodiscard]] std::optional<std::size_t> repeating() const override { return repeats_; }

  [[nodiscard]] bool has_bands() const override { return true; }
  Uncertain add_bands(FrameAnswer& answer) override {
    if (mixture_) {
      // Of one alpha: windows leave few degrees of freedom, and hardly smooth.
      const double degrees = method_->degrees_of_freedom(answer.alpha.value);
      add_mixture_bands(answer, problem_, readings_, smoothed_variance(problem_, degrees));
      doubt_flat_kernel(answer);
      return answer.wrench.normal;
    }
    answer.noise = estimate_noise(*answer.residual, frame_.rows, answer.degrees_of_freedom,
                                  problem_.stated_noise());
    if (!problem_.is_large())  // of which they are known
      answer.offsets = offsets(problem_.problem(), readings_, answer.tractions);
    lab::add_bands(answer, problem_, *method_, frame_, face_, readings_);
    if (const double share = model_share(problem_.scene()); share > 0.0)
      for (std::size_t i = 0; i < answer.deviations.size(); ++i)
        answer.deviations[i] = std::hypot(answer.deviations[i], share * answer.tractions[i]);
    if (answer.unseen > most_unseen && !problem_.scene().reconstruct.grid.margin) {
      SkinFrameMethod beyond(problem_.reaching_beyond(), readings_, false, {}, {});
      take_from_beyond(answer, lab::answer(beyond), problem_.reaching_beyond().grid(),
                       problem_.grid());
    }
    doubt_flat_kernel(answer);
    return answer.wrench.normal;
  }
  [[nodiscard]] bool holds_model_error(const FrameAnswer&) const override { return true; }

  /// That verdict which says most of the force.
  void judge_force(FrameAnswer& answer) const override {
    const bool solved =
        answer.verdict != Verdict::iteration_limit && answer.verdict != Verdict::ill_conditioned;
    if (solved && is_guessed(answer, problem_, readings_)) answer.verdict = Verdict::cut_off;
    if (answer.verdict != Verdict::ok) return;
    const bool of_prior = answer.assumed > most_assumed && !answer.data->noise_alone;
    const double largest =
        largest_force(problem_, without_offsets(problem_, readings_, answer.tractions));
    if (of_prior || answer.wrench.normal.deviation > largest)
      answer.verdict = Verdict::undetermined;
    else if (pitch_in_depths(problem_.scene().sensor) > (answer.cone ? far_apart : too_far_apart))
      answer.verdict = Verdict::coarse;
  }

  [[nodiscard]] remark::OffsetsFound named(std::span<const double> offsets) const override {
    return offsets_found(offsets, problem_.scene());
  }
  [[nodiscard]] remark::DataDoubted named(const DataVerdict& data) const override {
    return with_names(data, problem_.scene());
  }

 private:
  static std::shared_ptr<const LoadMixture> mixture_of(const SkinSceneProblem& problem,
                                                       std::span<const double> readings) {
    LoadNoise noise = load_noise(problem.scene());
    const double share = share_of_cells(problem);
    noise.model_share = std::hypot(noise.model_share, share);
    noise.reading_share = share;
    return std::make_shared<const LoadMixture>(problem.load_prior().given(readings, noise));
  }
  /// Whether tractions are the mixture's mean.
  [[nodiscard]] bool is_mean(const SkinSceneProblem& problem) const {
    return mixture_ != nullptr && !problem.constraints();
  }

  /// What balls as curved as the skin would read of the tractions beyond what a flat one reads,
  /// solved as if it were flat, is about as much as they are off by: bands of forces hold that.
  void doubt_flat_kernel(FrameAnswer& answer) const {
    constexpr double least = 0.01;
    const auto& curved = problem_.scene().sensor.curved;
    if (!curved || curved->kernel != CurvedKernel::flat || answer.cells.empty()) return;
    const LinearProblem& balls = problem_.on_balls();
    const LinearProblem& flat = problem_.problem();
    std::vector<double> seen(readings_.size());
    for (std::size_t row = 0; row < seen.size(); ++row)
      if (balls.weights[row] > 0.0) {
        double more = 0.0;
        for (std::size_t i = 0; i < answer.tractions.size(); ++i)
          more += (balls.kernel(row, i) - flat.kernel(row, i)) * answer.tractions[i];
        seen[row] = more / balls.weights[row];
      }
    const std::vector<double> moved =
        method_->solve(problem_.family().analyse(seen), seen, answer.alpha.value);
    const std::size_t count = flat.grid.count();
    SpaceVector force{};
    SpaceVector off{};
    SpaceVector turned{};
    std::array<double, 3> sums{};
    for (const std::size_t at : answer.cells)
      for (std::size_t u = 0; u < flat.components; ++u) {
        const CellWrench of = cell_wrench(flat, at, u, problem_.scene().reconstruct.moment_about);
        const double by = moved[u * count + at];
        force = combined(1.0, force, answer.tractions[u * count + at], of.force);
        off = combined(1.0, off, by, of.force);
        turned = combined(1.0, turned, by, of.moment);
        sums[u] += by * flat.grid.area();
      }
    const auto widen = [](Uncertain& one, double by) {
      one.deviation = std::hypot(one.deviation, by);
    };
    widen(answer.wrench.normal, sums[0]);
    if (answer.wrench.tangential_y) widen(*answer.wrench.tangential_y, sums[1]);
    if (answer.wrench.tangential_z) widen(*answer.wrench.tangential_z, sums[2]);
    if (answer.wrench.space)
      for (std::size_t k = 0; k < off.size(); ++k) {
        widen(answer.wrench.space->force[k], off[k]);
        widen(answer.wrench.space->moment[k], turned[k]);
      }
    const double share = length(off) / length(force);
    if (share > least) answer.remarks.emplace_back(remark::FlatKernel{share});
  }

  void solve_by_alpha(FrameAnswer& answer) {
    const double alpha = answer.alpha.value;
    answer.condition = Condition{method_->stacked_condition(alpha), Condition::Kind::bound};
    require_full_rank(method_->condition(alpha), readings_.size() + problem_.tractions());
    if (problem_.constraints())
      solve_in_cones(answer);
    else
      solve_freely(answer);
  }

  void solve_in_cones(FrameAnswer& answer) {
    const double alpha = answer.alpha.value;
    answer.cone = method_->solve_in_cones(readings_, alpha);
    if (answer.cone->status != FrameStatus::ok) throw FrameOverflow();
    answer.tractions = answer.cone->tractions;
    if (answer.cone->verdict == ConstrainedVerdict::iteration_limit) {
      answer.verdict = Verdict::iteration_limit;
      answer.remarks.emplace_back(remark::IterationLimit{answer.cone->iterations});
    }
    const ActiveFace& face = answer.cone->face;
    if (problem_.is_large()) {
      answer.degrees_of_freedom = problem_.large().degrees_of_freedom(face, alpha);
    } else if (!face.free.empty()) {
      face_.emplace(problem_.problem(), face);
      answer.degrees_of_freedom = face_->degrees_of_freedom(alpha);
    }
  }

  void solve_freely(FrameAnswer& answer) {
    const double alpha = answer.alpha.value;
    answer.tractions = method_->solve(frame_, readings_, alpha);
    if (const auto reached = method_->convergence()) {
      const double off = std::min(reached->bound, reached->estimate);
      answer.iteration = {.steps = reached->steps, .estimate = off};
      if (!reached->converged) {
        answer.verdict = Verdict::iteration_limit;
        answer.remarks.emplace_back(remark::NotConverged{reached->steps, off});
      }
    }
    answer.degrees_of_freedom = method_->degrees_of_freedom(alpha);
  }

  std::shared_ptr<const LoadMixture> mixture_;  // null: one alpha answers
  std::optional<double> weight_;  // that the readings make likeliest; absent: the scene gives it
  SkinSceneProblem problem_;      // with it
  std::unique_ptr<const SkinMethod> method_;
  std::span<const double> readings_;
  FilterFrame frame_;
  SkinAlphaChooser choose_;
  std::optional<std::size_t> repeats_;
  bool mixture_left_out_;
  std::optional<TikhonovFamily> face_{};  // what constraints leave free
};

/// Every reading is taken for what it says.
FrameAnswer solve_as_read(const SkinSceneProblem& problem, std::span<const double> readings,
                          const SkinAlphaChooser& choose = {},
                          std::optional<std::size_t> repeats = {}) {
  const auto found_by = [&](bool mixture) {
    SkinFrameMethod frame(problem, readings, mixture, choose, repeats);
    return answer(frame);
  };
  FrameAnswer found = found_by(!choose && problem.answers_by_mixture());
  // Windows end a depth beyond the taxels: what presses there is held by the bands of one alpha.
  if (found.mixture && found.unseen > most_unseen) found = found_by(false);
  if (problem.scene().sensor.curved)  // which is never large
    for (std::vector<double>* const of_cells :
         {&found.tractions, &found.deviations, &found.low, &found.high})
      put_on_surface(problem.problem(), *of_cells);
  return found;
}

class SkinRecordingMethod final : public RecordingMethod {
 public:
  SkinRecordingMethod(const SkinSceneProblem& problem, std::optional<std::size_t> share_alpha)
      : RecordingMethod(problem), skin_(problem) {
    if (share_alpha) sharing_.emplace(skin_, *share_alpha);
  }

  [[nodiscard]] std::size_t tractions() const override { return skin_.tractions(); }
  [[nodiscard]] std::size_t bytes() const override { return skin_.bytes(); }
  /// A large skin keeps what the last frame needed.
  [[nodiscard]] bool takes_threads() const override { return !sharing_ && !skin_.is_large(); }
  [[nodiscard]] std::shared_ptr<RecordingMethod> without(
      std::span<const std::size_t> taxels) const override {
    return std::make_shared<SkinRecordingMethod>(skin_.without(taxels), std::nullopt);
  }
  FrameAnswer answer(std::span<const double> readings,
                     std::optional<std::size_t> repeats) override {
    if (!sharing_) return solve_as_read(skin_, readings, {}, repeats);
    const auto choose = [this](const FilterFrame& frame) { return sharing_->push(skin_, frame); };
    return solve_as_read(skin_, readings, choose, repeats);
  }

 private:
  SkinSceneProblem skin_;
  std::optional<FrameSharing> sharing_{};
};

}  // namespace

std::shared_ptr<RecordingMethod> recording_method(const SkinSceneProblem& problem,
                                                  std::optional<std::size_t> share_alpha) {
  return std::make_shared<SkinRecordingMethod>(problem, share_alpha);
}

FrameAnswer solve(const SkinSceneProblem& problem, std::span<const double> readings) {
  const SkinScene& scene = problem.scene();
  if (readings.size() != problem.layout().sites.size())
    return solve_as_read(problem, readings);  // which refuses them
  return answer_without_clipped(
      scene, problem.layout().sites, readings,
      [&](const std::vector<std::size_t>& dead) { return measures_without(problem, dead); },
      [&](const std::vector<std::size_t>* dead) {
        return dead != nullptr ? solve_as_read(*problem.left_with(*dead), readings)
                               : solve_as_read(problem, readings);
      });
}

}  // namespace tactile_net::lab
