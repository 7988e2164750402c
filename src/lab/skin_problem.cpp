#include "tactile_net/lab/skin_problem.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lab/border.hpp"
#include "lab/large_skin.hpp"
#include "lab/lines_and_skins.hpp"
#include "lab/pattern_cache.hpp"
#include "lab/skin_bands.hpp"
#include "lab/skin_crop.hpp"
#include "lab/skin_data_verdict.hpp"
#include "tactile_net/inverse/tangential_weight.hpp"
#include "tactile_net/lab/skin_sight.hpp"
#include "tactile_net/scene/skin_size.hpp"
#include "tactile_net/skin/curved_skin.hpp"
#include "tactile_net/system/memory.hpp"

namespace tactile_net::lab {
namespace {

/// Of all weights of a scene.
constexpr std::size_t most_bytes_of_weights = std::size_t{512} << 20;

SkinProblemOptions options_of(const SkinScene& scene) {
  return SkinProblemOptions{.components = components(scene),
                            .smoothing_length = scene.reconstruct.smoothing_length,
                            .tangential_weight = scene.reconstruct.tangential_weight.value_or(1.0),
                            .channel_rms = weights_of_channels(scene),
                            .dead_taxels = scene.dead_taxels,
                            .grid = scene.reconstruct.grid,
                            .unknown_offsets = scene.reconstruct.offset};
}

/// A scene without a grid is refused where one is asked for.
bool is_too_large(const SkinScene& scene, std::size_t most_dense) noexcept {
  try {
    return components(scene) * grid(scene).count() > most_dense;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

LoadPriorOptions prior_options(const SkinScene& scene) {
  return {.depth = least_depth(scene.sensor)};
}

// Cores did 5 to 10 billion in a second of the set-up, and a billion of a frame, whose numbers come
// from memory: some four seconds, and half a one where a frame is noise alone.
constexpr double most_set_up = 4e10;
constexpr double most_in_frame = 5e8;
constexpr double most_kept = 32.0 * 1024 * 1024;

/// Whether bands hold without a look at what presses: taxels read what pressure does, and are
/// dense. Between those that lie farther apart narrower contacts press than windows hold; pressure
/// and both shears tell them from wide ones where one quantity does not.
bool is_seen_by_windows(const SkinArray& skin) {
  constexpr double most_apart = 0.75;  // depths
  constexpr double most_apart_of_three = 1.0 + 1e-9;
  const auto tells_pressure = [](Quantity quantity) {
    return quantity == Quantity::stress_x || quantity == Quantity::strain_x ||
           quantity == Quantity::displacement_x;
  };
  return pitch_in_depths(skin) <= (channel_count(skin) < 3 ? most_apart : most_apart_of_three) &&
         std::any_of(skin.reads.begin(), skin.reads.end(), tells_pressure);
}

bool may_answer_by_mixture(const SkinSceneProblem& problem) {
  const SkinArray& skin = problem.scene().sensor;
  return !problem.is_large() && problem.stated_noise() &&
         channel_count(skin) * taxel_count(skin) <= most_mixture_readings;
}

/// What the frames of one key need, lent to all that ask for it at the same time. As many keys are
/// kept as were lent at once: one where frames come one after the other, whichever threads they
/// come from.
template <typename Key, typename Made>
class Lent {
 public:
  /// Of this key; `make` gives it where it is not kept. Several threads may ask.
  std::shared_ptr<const Made> operator()(const Key& key, const auto& make) {
    if (auto kept = find(key)) return kept;
    auto made = std::make_shared<const Made>(make());  // takes long: others go on meanwhile
    const std::lock_guard lock(mutex_);
    if (auto kept = find_locked(key)) return kept;  // of a thread that was faster
    const auto idle = std::find_if(kept_.begin(), kept_.end(),
                                   [](const auto& one) { return one.second.use_count() == 1; });
    if (idle != kept_.end()) kept_.erase(idle);
    kept_.emplace_back(key, made);
    return made;
  }

 private:
  std::shared_ptr<const Made> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    return find_locked(key);
  }
  std::shared_ptr<const Made> find_locked(const Key& key) {
    const auto found =
        std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one.first == key; });
    if (found == kept_.end()) return nullptr;
    std::rotate(found, found + 1, kept_.end());
    return kept_.back().second;
  }

  std::mutex mutex_{};
  std::vector<std::pair<Key, std::shared_ptr<const Made>>> kept_{};  // the last one asked for: last
};

}  // namespace

struct SkinSceneProblem::Parts {
  Parts(SkinScene given, std::size_t most)
      : scene(std::move(given)),
        most_dense(most),
        is_large(is_too_large(scene, most)),
        constraints(stated_constraints(scene.reconstruct)) {}

  SkinScene scene;
  std::size_t most_dense;
  bool is_large;
  std::optional<Constraints> constraints;
  std::shared_ptr<const LinearProblem> problem{};
  std::optional<TikhonovFamily> family{};
  std::unique_ptr<LargeSkin> large{};
  std::optional<AlphaTables> alpha_tables{};
  std::optional<LoadPrior> load_prior{};
  std::optional<bool> takes_long{};  // that prior
  std::optional<DataJudge> data_judge{};
  std::optional<std::vector<bool>> unseen{};
  std::optional<std::vector<std::size_t>> border{};
  std::optional<SkinSceneProblem> beyond{};
  std::optional<LinearProblem> on_balls{};
  std::optional<PatternCache<SkinSceneProblem, double>> weighed{};  // by tangential weight

  std::optional<ConeTikhonov>
      any_cone{};  // whose alpha does not matter: cones of others come from it

  Lent<double, ConeTikhonov> cones{};                        // by alpha
  Lent<std::vector<std::size_t>, SkinSceneProblem> rests{};  // by the taxels that are left out

  /// What all frames share is made under it, from what is made under it.
  std::recursive_mutex mutex{};
};

SkinSceneProblem::SkinSceneProblem(SkinScene scene)
    : SkinSceneProblem(std::move(scene), most_skin_tractions) {}
SkinSceneProblem::SkinSceneProblem(SkinScene scene, std::size_t most_dense)
    : parts_(std::make_shared<Parts>(std::move(scene), most_dense)) {}

const SkinScene& SkinSceneProblem::scene() const noexcept { return parts_->scene; }
bool SkinSceneProblem::is_large() const noexcept { return parts_->is_large; }

SkinProblemOptions SkinSceneProblem::options() const { return options_of(parts_->scene); }

const LinearProblem& SkinSceneProblem::problem() const { return *shared_problem(); }

std::shared_ptr<const LinearProblem> SkinSceneProblem::shared_problem() const {
  if (is_large())
    throw std::invalid_argument(
        "the skin has more than " + std::to_string(most_skin_tractions) +
        " unknown tractions, and this needs a matrix of them: run and solve take it, or choose a "
        "larger spacing or a smaller margin");
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->problem)
    parts_->problem = std::make_shared<const LinearProblem>(
        make_problem(parts_->scene.sensor, parts_->scene.material, options()));
  return parts_->problem;
}

const LinearProblem& SkinSceneProblem::layout() const {
  return is_large() ? large().problem() : problem();
}

LargeSkin& SkinSceneProblem::large() const {
  if (!parts_->large)
    parts_->large = std::make_unique<LargeSkin>(
        parts_->scene.sensor, parts_->scene.material, options_of(parts_->scene), data_limits(*this),
        available_memory(), parts_->constraints.has_value());
  return *parts_->large;
}

void SkinSceneProblem::prepare() const {
  if (is_large())
    (void)large().family();
  else
    (void)family();
}

const TikhonovFamily& SkinSceneProblem::family() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->family) parts_->family.emplace(problem());
  return *parts_->family;
}

const AlphaTables& SkinSceneProblem::alpha_tables(const FilterFrame& frame) const {
  const std::lock_guard lock(parts_->mutex);
  if (is_large() || !parts_->alpha_tables)
    parts_->alpha_tables.emplace(frame.gamma, frame.rows, frame.shares);
  return *parts_->alpha_tables;
}

std::optional<double> SkinSceneProblem::stated_noise() const {
  return noise_of_readings(parts_->scene);
}

const std::optional<Constraints>& SkinSceneProblem::constraints() const noexcept {
  return parts_->constraints;
}

AlphaRule SkinSceneProblem::alpha_rule(const FilterFrame& frame) const {
  if (const auto named = parts_->scene.reconstruct.alpha_rule) return *named;
  return default_rule(alpha_tables(frame), stated_noise().has_value());
}

ChosenAlpha SkinSceneProblem::alpha(std::span<const double> readings) const {
  if (const auto& given = parts_->scene.reconstruct.alpha) return {.value = *given};
  const FilterFrame frame =
      is_large() ? large().family().analyse(readings) : family().analyse(readings);
  const AlphaChoice choice =
      choose_alone(frame, alpha_tables(frame), alpha_rule(frame), stated_noise());
  return {.value = choice.alpha, .rule = choice.rule, .verdict = choice.verdict};
}

AlphaSweep SkinSceneProblem::sweep(std::span<const double> readings) const {
  const FilterFrame frame = family().analyse(readings);
  return sweep_alpha(frame, alpha_tables(frame), stated_noise());
}

bool SkinSceneProblem::estimates_weight() const {
  return !parts_->scene.reconstruct.tangential_weight && components(parts_->scene) == 3;
}

SkinSceneProblem SkinSceneProblem::weighed(double tangential_weight) const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->weighed) parts_->weighed.emplace(bytes(), most_bytes_of_weights);
  return *(*parts_->weighed)(tangential_weight, [&] {
    SkinScene scene = parts_->scene;
    scene.reconstruct.tangential_weight = tangential_weight;
    auto made = std::make_unique<SkinSceneProblem>(std::move(scene), parts_->most_dense);
    if (is_large()) return made;
    LinearProblem own = problem();  // kernels take longest, of layers above all
    own.tangential_weight = tangential_weight;
    made->parts_->problem = std::make_shared<const LinearProblem>(std::move(own));
    return made;
  });
}

double SkinSceneProblem::likeliest_weight(std::span<const double> readings) const {
  if (is_large()) {
    const SkinCrop crop = strongest_part(*this, readings);
    return SkinSceneProblem(crop.scene).likeliest_weight(crop.readings);
  }
  return likeliest_tangential_weight([&](double weight) {
    const SkinSceneProblem one = weighed(weight);
    const FilterFrame frame = one.family().analyse(readings);
    return negative_log_evidence(frame, one.alpha_tables(frame), stated_noise(),
                                 scene().reconstruct.alpha) +
           negative_log_prior(weight);
  });
}

std::size_t SkinSceneProblem::bytes() const {
  if (is_large())
    return static_cast<std::size_t>(
        large_skin_bytes({.cells = layout().grid.count(),
                          .components = layout().components,
                          .channels = channel_count(scene().sensor),
                          .dead_taxels = scene().dead_taxels.size(),
                          .constrained = parts_->constraints.has_value()}));
  constexpr std::size_t matrices = 4;             // K twice, and its decomposition
  constexpr std::size_t numbers_of_rules = 1000;  // AlphaTables, per traction or reading
  const std::size_t rows = problem().kernel.rows;
  const std::size_t columns = problem().kernel.columns;
  return sizeof(double) * (matrices * rows * columns + numbers_of_rules * std::min(rows, columns));
}

std::shared_ptr<const ConeTikhonov> SkinSceneProblem::cone(double alpha) const {
  return parts_->cones(alpha, [&] {
    const ConeTikhonov& any = [&]() -> const ConeTikhonov& {
      const std::lock_guard lock(parts_->mutex);
      if (!parts_->any_cone)
        parts_->any_cone.emplace(ConeTikhonov(problem(), alpha, *parts_->constraints));
      return *parts_->any_cone;
    }();
    return any.with_alpha(alpha);
  });
}

bool SkinSceneProblem::answers_by_mixture() const {
  const auto& options = parts_->scene.reconstruct;
  if (!may_answer_by_mixture(*this)) return false;
  if (options.answer) return *options.answer == AnswerKind::mixture;
  return !options.alpha && !options.alpha_rule && is_seen_by_windows(parts_->scene.sensor) &&
         !mixture_takes_long();
}

bool SkinSceneProblem::mixture_is_left_out() const {
  const auto& options = parts_->scene.reconstruct;
  return !options.answer && !options.alpha && !options.alpha_rule && may_answer_by_mixture(*this) &&
         is_seen_by_windows(parts_->scene.sensor) && mixture_takes_long();
}

bool SkinSceneProblem::mixture_takes_long() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->takes_long) {
    const LoadWork work = load_work(problem(), prior_options(parts_->scene));
    parts_->takes_long =
        work.set_up > most_set_up || work.frame > most_in_frame || work.kept > most_kept;
  }
  return *parts_->takes_long;
}

const LoadPrior& SkinSceneProblem::load_prior() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->load_prior) parts_->load_prior.emplace(problem(), prior_options(parts_->scene));
  return *parts_->load_prior;
}

const DataJudge& SkinSceneProblem::data_judge() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->data_judge) parts_->data_judge.emplace(lab::data_judge(*this));
  return *parts_->data_judge;
}

const std::vector<bool>& SkinSceneProblem::unseen() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->unseen) parts_->unseen = unseen_cells(*this);
  return *parts_->unseen;
}

const std::vector<std::size_t>& SkinSceneProblem::border() const {
  const std::vector<bool>& unseen = this->unseen();
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->border) parts_->border = border_cells(*this, unseen);
  return *parts_->border;
}

const SkinSceneProblem& SkinSceneProblem::reaching_beyond() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->beyond) {
    SkinScene scene = parts_->scene;
    scene.reconstruct.grid.margin = 2.0 * least_depth(scene.sensor);
    parts_->beyond.emplace(std::move(scene), parts_->most_dense);
  }
  return *parts_->beyond;
}

const LinearProblem& SkinSceneProblem::on_balls() const {
  const std::lock_guard lock(parts_->mutex);
  if (!parts_->on_balls) {
    parts_->on_balls = make_problem(with_kernel(parts_->scene.sensor, CurvedKernel::ball),
                                    parts_->scene.material, options());
  }
  return *parts_->on_balls;
}

LinearProblem SkinSceneProblem::on(const SkinGridOptions& grid) const {
  SkinProblemOptions with_grid = options();
  with_grid.grid = grid;
  return make_problem(parts_->scene.sensor, parts_->scene.material, with_grid);
}

SkinSceneProblem SkinSceneProblem::without(std::span<const std::size_t> taxels) const {
  SkinScene scene = parts_->scene;
  const std::vector<std::size_t> dead(taxels.begin(), taxels.end());
  const bool more_are_dead = std::all_of(
      scene.dead_taxels.begin(), scene.dead_taxels.end(),
      [&](std::size_t taxel) { return std::find(dead.begin(), dead.end(), taxel) != dead.end(); });
  scene.dead_taxels = dead;
  SkinSceneProblem rest(std::move(scene), parts_->most_dense);
  if (!more_are_dead || !is_measured(rest.scene().sensor, dead, rest.scene().reconstruct.offset))
    return rest;
  if (is_large()) {
    rest.parts_->large = std::make_unique<LargeSkin>(large(), dead);
    return rest;
  }
  LinearProblem own = problem();  // kernels take longest, of layers above all
  leave_out(own, dead);
  rest.parts_->problem = std::make_shared<const LinearProblem>(std::move(own));
  return rest;
}

std::shared_ptr<const SkinSceneProblem> SkinSceneProblem::left_with(
    const std::vector<std::size_t>& taxels) const {
  return parts_->rests(taxels, [&] { return without(taxels); });
}

}  // namespace tactile_net::lab
