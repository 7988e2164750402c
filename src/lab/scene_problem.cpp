#include "tactile_net/lab/scene_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "lab/border.hpp"
#include "lab/lines_and_skins.hpp"
#include "tactile_net/inverse/long_array_covariance.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/lab/data_verdict.hpp"

namespace tactile_net::lab {
namespace {

/// Tractions from which tikhonov's matrix comes from the family's decomposition, which rules and
/// bands share, and not from one of its own: that takes seconds.
constexpr std::size_t one_decomposition = 256;

/// Windows of loads, in depths. Dense taxels show how wide a contact is: narrower windows would
/// take the model's error for rough loads. Between coarse ones a narrow contact is not told from a
/// wide one.
constexpr double narrowest_of_dense = 3.5;
constexpr double narrowest_of_coarse = 1.0;

/// Distance of taxels, in depths, from which loads may hide between them.
constexpr double pitch_that_hides = 1.5;
constexpr double power_of_hidden = 0.25;

/// Of a grid in place of taxels: pressure differs that much where one of them has its line load.
constexpr double finest_of_depth = 0.25;
/// Taxels that are denser show to a thousandth where a pressure begins, which a grid of theirs
/// cannot have.
constexpr double finest_of_dense = 0.125;
/// Readings of one unknown up to which a grid twice as fine costs less than half of a frame.
constexpr std::size_t most_of_dense = 128;

/// Tractions over taxels up to which windows of them take less than a second.
constexpr std::size_t most_of_windows = 384;

LineProblemOptions options_of(const Scene& scene) {
  return LineProblemOptions{.unknowns = unknowns(scene),
                            .smoothing_length = scene.reconstruct.smoothing_length,
                            .tangential_weight = scene.reconstruct.tangential_weight.value_or(1.0),
                            .channel_rms = weights_of_channels(scene),
                            .dead_taxels = scene.dead_taxels,
                            .surface = scene.reconstruct.surface,
                            .unknown_offsets = scene.reconstruct.offset};
}

}  // namespace

bool is_large(const Scene& scene, std::size_t tractions) {
  return tractions >= large && is_even(scene.sensor) && !scene.reconstruct.offset;
}

struct SceneProblem::Parts {
  explicit Parts(Scene given)
      : scene(std::move(given)),
        options(options_of(scene)),
        constraints(stated_constraints(scene.reconstruct)) {}

  Scene scene;
  LineProblemOptions options;
  std::optional<Constraints> constraints;
  std::optional<Surface> surface;
  std::optional<LinearProblem> problem;
  std::optional<std::pair<double, Reconstruction>> tikhonov;  // of its alpha
  std::optional<TikhonovFamily> family;
  std::optional<LongArrayFamily> sections;
  std::optional<FftTikhonov> products;
  std::optional<AlphaTables> alpha_tables;
  std::optional<std::vector<std::size_t>> border;
  std::optional<ModeSpace> hidden;
  std::optional<DataJudge> data_judge;
  std::unique_ptr<Covariance> covariance;
  std::pair<double, double> covariance_of;  // its alpha and prior
  std::unique_ptr<SceneProblem> reaching_beyond;
  std::optional<LoadWindows> load_windows;
  std::unique_ptr<SceneProblem> of_mixture;
  std::optional<LoadPrior> load_prior;
  std::map<double, SceneProblem> weighed;  // by tangential weight
};

SceneProblem::SceneProblem(Scene scene) : parts_(std::make_shared<Parts>(std::move(scene))) {}

const Scene& SceneProblem::scene() const noexcept { return parts_->scene; }

const LineProblemOptions& SceneProblem::options() const noexcept { return parts_->options; }

std::size_t SceneProblem::readings() const { return reading_count(parts_->scene.sensor); }

const Surface& SceneProblem::surface() const {
  if (!parts_->surface) parts_->surface = tactile_net::surface(parts_->scene);
  return *parts_->surface;
}

std::size_t SceneProblem::tractions() const { return parts_->options.unknowns * surface().count; }

std::optional<double> SceneProblem::stated_noise() const {
  return noise_of_readings(parts_->scene);
}

const std::optional<Constraints>& SceneProblem::constraints() const noexcept {
  return parts_->constraints;
}

const LinearProblem& SceneProblem::problem() const {
  if (!parts_->problem)
    parts_->problem = make_problem(parts_->scene.sensor, parts_->scene.material, parts_->options);
  return *parts_->problem;
}

SceneProblem SceneProblem::without(std::span<const std::size_t> taxels) const {
  Scene scene = parts_->scene;
  scene.dead_taxels.assign(taxels.begin(), taxels.end());
  SceneProblem other(std::move(scene));
  const auto stays_dead = [&](std::size_t taxel) {
    return std::binary_search(taxels.begin(), taxels.end(), taxel);
  };
  const std::vector<std::size_t>& dead = parts_->scene.dead_taxels;
  if (!std::all_of(dead.begin(), dead.end(), stays_dead))
    return other;                // what is dead here has left no row to take
  if (is_large()) return other;  // no matrix is made of it
  other.parts_->problem = problem();
  leave_out(*other.parts_->problem, taxels);
  return other;
}

bool SceneProblem::estimates_weight() const {
  return parts_->options.unknowns == 2 && !parts_->scene.reconstruct.tangential_weight;
}

const SceneProblem& SceneProblem::weighed(double tangential_weight) const {
  const auto [made, is_new] = parts_->weighed.try_emplace(tangential_weight, parts_->scene);
  if (is_new) {
    Parts& parts = *made->second.parts_;
    parts.scene.reconstruct.tangential_weight = tangential_weight;
    parts.options.tangential_weight = tangential_weight;
    parts.problem = problem();
    parts.problem->tangential_weight = tangential_weight;
  }
  return made->second;
}

bool SceneProblem::chooses_on_active_set() const {
  const ReconstructOptions& options = parts_->scene.reconstruct;
  return parts_->constraints && options.alpha_on_active_set && !options.alpha;
}

const Reconstruction& SceneProblem::tikhonov(double alpha) const {
  auto& made = parts_->tikhonov;
  if (!made || made->first != alpha)
    made.emplace(alpha, tractions() < one_decomposition ? tactile_net::tikhonov(problem(), alpha)
                                                        : family().reconstruction(alpha));
  return made->second;
}

std::optional<double> SceneProblem::known_condition(double alpha) const noexcept {
  const auto& made = parts_->tikhonov;
  if (!made || made->first != alpha) return std::nullopt;
  return made->second.condition();
}

const TikhonovFamily& SceneProblem::family() const {
  if (!parts_->family) parts_->family.emplace(problem());
  return *parts_->family;
}

const LongArrayFamily& SceneProblem::sections() const {
  if (!parts_->sections)
    parts_->sections.emplace(parts_->scene.sensor, parts_->scene.material, parts_->options);
  return *parts_->sections;
}

FftTikhonov& SceneProblem::products() const {
  if (!parts_->products)
    parts_->products.emplace(parts_->scene.sensor, parts_->scene.material, parts_->options, 1.0);
  return *parts_->products;
}

const AlphaTables& SceneProblem::alpha_tables(const FilterFrame& frame) const {
  if (!parts_->alpha_tables) parts_->alpha_tables.emplace(frame.gamma, frame.rows, frame.shares);
  return *parts_->alpha_tables;
}

AlphaRule SceneProblem::alpha_rule(const FilterFrame& frame) const {
  if (const auto named = parts_->scene.reconstruct.alpha_rule) return *named;
  return default_rule(alpha_tables(frame), stated_noise().has_value());
}

const std::vector<std::size_t>& SceneProblem::border() const {
  if (!parts_->border) parts_->border = border_values(*this);
  return *parts_->border;
}

double SceneProblem::residual(std::span<const double> readings,
                              std::span<const double> tractions) const {
  if (is_large()) return products().residual(readings, tractions);
  return residual_norm(problem(), readings, tractions);
}

const ModeSpace& SceneProblem::hidden() const {
  if (parts_->hidden) return *parts_->hidden;
  if (surface().basis == SurfaceBasis::taxels) {
    parts_->hidden = hidden_modes(problem(), family());
  } else {
    LineProblemOptions options = parts_->options;
    options.surface = one_value_per_taxel(scene().sensor);
    parts_->hidden = hidden_modes(make_problem(scene().sensor, scene().material, options));
  }
  return *parts_->hidden;
}

const DataJudge& SceneProblem::data_judge() const {
  if (!parts_->data_judge) parts_->data_judge.emplace(lab::data_judge(*this));
  return *parts_->data_judge;
}

const Covariance& SceneProblem::covariance(double alpha, double prior) const {
  const std::pair of{alpha, prior};
  if (!parts_->covariance || parts_->covariance_of != of) {
    if (is_large())
      parts_->covariance =
          std::make_unique<LongArrayCovariance>(sections(), products(), alpha, prior);
    else
      parts_->covariance = std::make_unique<TractionCovariance>(family(), alpha, prior);
    parts_->covariance_of = of;
  }
  return *parts_->covariance;
}

const SceneProblem& SceneProblem::reaching_beyond() const {
  if (surface().basis == SurfaceBasis::hats) return *this;
  if (!parts_->reaching_beyond) {
    Scene scene = parts_->scene;
    scene.reconstruct.surface = {.basis = SurfaceBasis::hats, .spacing = scene.sensor.pitch};
    parts_->reaching_beyond = std::make_unique<SceneProblem>(std::move(scene));
  }
  return *parts_->reaching_beyond;
}

bool SceneProblem::has_load_windows() const {
  if (surface().basis == SurfaceBasis::hats) return !is_large() && stated_noise().has_value();
  return is_dense(scene().sensor) && tractions() <= most_of_windows;
}

const LoadWindows& SceneProblem::load_windows() const {
  if (!parts_->load_windows) {
    const SensorArray& array = parts_->scene.sensor;
    const double narrowest = is_dense(array) ? narrowest_of_dense : narrowest_of_coarse;
    parts_->load_windows.emplace(reaching_beyond().problem(), narrowest * least_depth(array));
  }
  return *parts_->load_windows;
}

bool SceneProblem::answers_by_mixture() const {
  const ReconstructOptions& options = parts_->scene.reconstruct;
  const bool by_alpha = options.alpha || options.alpha_rule;
  const AnswerKind kind =
      options.answer.value_or(by_alpha ? AnswerKind::alpha : AnswerKind::mixture);
  return kind == AnswerKind::mixture && stated_noise() && has_load_windows() &&
         options.methods == std::vector{Method::tikhonov};
}

const SceneProblem& SceneProblem::of_mixture() const {
  if (surface().basis == SurfaceBasis::hats) return *this;
  if (!parts_->of_mixture) {
    Scene scene = parts_->scene;
    const SensorArray& array = scene.sensor;
    const bool affords =
        parts_->options.unknowns == 1 && channel_count(array) * array.count < most_of_dense;
    const double depth = least_depth(array);
    const double finest =
        std::clamp(0.5 * array.pitch, (affords ? finest_of_dense : finest_of_depth) * depth,
                   finest_of_depth * depth);
    scene.reconstruct.surface = {.basis = SurfaceBasis::hats,
                                 .spacing = std::min(array.pitch, finest)};
    parts_->of_mixture = std::make_unique<SceneProblem>(std::move(scene));
  }
  return *parts_->of_mixture;
}

const LoadPrior& SceneProblem::load_prior() const {
  if (!parts_->load_prior) {
    const SensorArray& array = parts_->scene.sensor;
    const double depth = least_depth(array);
    const bool hides = array.pitch > pitch_that_hides * depth;
    parts_->load_prior.emplace(
        of_mixture().problem(),
        LoadPriorOptions{.depth = depth, .prior_power = hides ? power_of_hidden : 0.0});
  }
  return *parts_->load_prior;
}

namespace {

constexpr double negligible = 0.01;  // a probability

std::vector<SceneFrame::LikelyWeight> likely_weights_of(const SceneProblem& problem,
                                                        std::span<const double> readings) {
  if (!problem.estimates_weight()) return {};
  if (problem.is_large())
    throw std::invalid_argument(
        "a tangential_weight is estimated by a decomposition for each that is tried, which takes "
        "too long for " +
        std::to_string(problem.tractions()) + " tractions: state it");
  const std::optional<double>& alpha = problem.scene().reconstruct.alpha;
  std::vector<SceneFrame::LikelyWeight> weights;
  double least = std::numeric_limits<double>::infinity();
  for (const double weight : tangential_weights) {
    const SceneProblem& weighed = problem.weighed(weight);
    const FilterFrame frame = weighed.family().analyse(readings);
    const double value =
        negative_log_evidence(frame, weighed.alpha_tables(frame), problem.stated_noise(), alpha) +
        negative_log_prior(weight);
    weights.push_back({weight, value});
    least = std::min(least, value);
  }
  const auto normalise = [&] {
    double sum = 0.0;
    for (const auto& one : weights) sum += one.probability;
    for (auto& one : weights) one.probability /= sum;
  };
  for (auto& one : weights) one.probability = std::exp(least - one.probability);
  normalise();
  std::erase_if(weights, [](const auto& one) { return one.probability < negligible; });
  normalise();
  return weights;
}

/// The first of the most likely ones: that nearest to 1.
const SceneFrame::LikelyWeight& most_likely(std::span<const SceneFrame::LikelyWeight> weights) {
  return *std::max_element(weights.begin(), weights.end(), [](const auto& a, const auto& b) {
    return a.probability < b.probability;
  });
}

}  // namespace

SceneFrame::SceneFrame(SceneProblem problem, std::span<const double> readings,
                       std::vector<LikelyWeight> weights)
    : weights_(std::move(weights)),
      given_(std::move(problem)),
      problem_(weights_.empty() ? given_ : given_.weighed(most_likely(weights_).value)),
      readings_(readings.begin(), readings.end()) {}

SceneFrame::SceneFrame(const SceneProblem& problem, std::span<const double> readings,
                       std::shared_ptr<const LoadMixture> mixture)
    : SceneFrame(problem, readings, likely_weights_of(problem, readings)) {
  mixture_ = std::move(mixture);
}

std::optional<double> SceneFrame::estimated_weight() const noexcept {
  if (weights_.empty()) return std::nullopt;
  return most_likely(weights_).value;
}

SceneFrame SceneFrame::weighed(double tangential_weight) const {
  return {given_, readings_, {{.value = tangential_weight}}};
}

const FilterFrame& SceneFrame::analysed() const {
  if (!analysed_)
    analysed_ = problem_.is_large() ? problem_.sections().analyse(readings_)
                                    : problem_.family().analyse(readings_);
  return *analysed_;
}

const SceneFrame& SceneFrame::reaching_beyond() const {
  const SceneProblem& beyond = given_.reaching_beyond();
  if (&beyond == &given_) return *this;
  if (!reaching_beyond_) {
    std::vector<LikelyWeight> weights;
    if (const auto weight = estimated_weight()) weights.push_back({.value = *weight});
    reaching_beyond_ =
        std::make_shared<const SceneFrame>(SceneFrame(beyond, readings_, std::move(weights)));
  }
  return *reaching_beyond_;
}

const std::shared_ptr<const LoadMixture>& SceneFrame::mixture() const {
  if (!mixture_)
    mixture_ = std::make_shared<const LoadMixture>(
        given_.load_prior().given(readings_, load_noise(given_.scene())));
  return mixture_;
}

const AlphaSweep& SceneFrame::sweep() const {
  if (!sweep_)
    sweep_ = sweep_alpha(analysed(), problem_.alpha_tables(analysed()), problem_.stated_noise());
  return *sweep_;
}

ChosenAlpha SceneFrame::alpha() const {
  const ReconstructOptions& options = problem_.scene().reconstruct;
  if (options.alpha) return {.value = *options.alpha, .tangential_weight = estimated_weight()};
  const AlphaChoice& choice = sweep().choice(problem_.alpha_rule(analysed()));
  return {.value = choice.alpha,
          .rule = choice.rule,
          .verdict = choice.verdict,
          .tangential_weight = estimated_weight()};
}

const AlphaChoice& SceneFrame::prior() const {
  if (!prior_) {
    // Of many readings gml bears a noise that is not as stated, and a model that is not the pad.
    const bool known =
        problem_.stated_noise() && problem_.alpha_tables(analysed()).cannot_estimate_noise();
    prior_ = choose_alone(analysed(), problem_.alpha_tables(analysed()), prior_rule(known),
                          problem_.stated_noise());
    // Not even the weakest component shows any noise: there is none to size a prior by.
    const std::vector<double>& gamma = analysed().gamma;
    const double weakest = *std::min_element(gamma.begin(), gamma.end());
    if (!known && prior_->alpha < weakest * weakest) prior_->verdict = AlphaVerdict::border;
  }
  return *prior_;
}

}  // namespace tactile_net::lab
