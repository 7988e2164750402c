#include "tactile_net/lab/method.hpp"

#include <algorithm>
#include <stdexcept>

#include "tactile_net/inverse/dft.hpp"
#include "tactile_net/inverse/dft_friction.hpp"
#include "tactile_net/inverse/dft_tikhonov.hpp"
#include "tactile_net/inverse/fft_tikhonov.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/tikhonov_family.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/scene_words.hpp"

namespace tactile_net::lab {
namespace {

constexpr const char* dead_taxel_warning = "dft takes a dead taxel's zero for a reading";
constexpr const char* cut_off_warning =
    "the readings have not died away at the array's ends: dft takes the array for a ring, and what "
    "is cut off comes back amplified";

std::size_t traction_count(const Scene& scene) { return unknowns(scene) * scene.sensor.count; }

std::string_view verdict_of(const AlphaChoice& choice) { return name(choice.verdict); }

/// dft of one quantity at one depth: division, without alpha.
class Division final : public Solver {
 public:
  explicit Division(const Scene& scene)
      : inverse_(scene.sensor, scene.material, scene.reconstruct.noise_gain_limit),
        count_(scene.sensor.count) {
    const NoiseGain& gain = inverse_.noise_gain();
    facts_.condition = gain.largest;
    facts_.verdict = name(inverse_.verdict());
    if (inverse_.verdict() != DftVerdict::ok)
      facts_.warnings.push_back("errors of the readings reach the traction multiplied by up to " +
                                brief(gain.largest));
    if (gain.sign_changes > 0)
      facts_.warnings.push_back("the kernel's DFT changes sign at " +
                                std::to_string(gain.sign_changes) +
                                " frequencies: what lies between is not measured");
    if (!scene.dead_taxels.empty()) facts_.warnings.emplace_back(dead_taxel_warning);
    lasting_ = facts_.warnings.size();
  }

  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    const DftVerdict verdict = inverse_.verdict(readings);
    facts_.verdict = name(verdict);
    facts_.warnings.resize(lasting_);
    if (verdict == DftVerdict::cut_off) facts_.warnings.emplace_back(cut_off_warning);
    return inverse_.solve(readings, tractions);
  }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double> readings,
                                                  std::span<const double>) override {
    return inverse_.forward_bound(readings);
  }
  [[nodiscard]] std::size_t tractions() const override { return count_; }

 private:
  DftInverse inverse_;
  std::size_t count_;
  std::size_t lasting_ = 0;  // warnings that hold for every frame
};

/// dft of one channel with known friction.
class Sliding final : public Solver {
 public:
  explicit Sliding(const Scene& scene)
      : inverse_(scene.sensor, scene.material, *scene.reconstruct.contact_friction,
                 scene.reconstruct.noise_gain_limit),
        count_(scene.sensor.count) {
    facts_.condition = inverse_.division().noise_gain().largest;
    if (!scene.dead_taxels.empty()) facts_.warnings.emplace_back(dead_taxel_warning);
    lasting_ = facts_.warnings.size();
  }
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    const FrictionSolution solution = inverse_.solve(readings);
    facts_.verdict =
        solution.verdict == FrictionVerdict::dft ? name(solution.dft) : name(solution.verdict);
    facts_.warnings.resize(lasting_);
    if (solution.verdict == FrictionVerdict::not_one_contact)
      facts_.warnings.emplace_back(
          "these are not the readings of one contact in the array's middle, which contact_friction "
          "and its size and sign take for granted");
    if (solution.verdict == FrictionVerdict::drag_in_noise)
      facts_.warnings.emplace_back(
          "noise could hide a tenth of what contact_friction adds to the readings: the tangential "
          "traction is assumed more than it is measured");
    std::copy(solution.normal.begin(), solution.normal.end(), tractions.begin());
    std::copy(solution.tangential.begin(), solution.tangential.end(),
              tractions.begin() + static_cast<std::ptrdiff_t>(count_));
    return FrameStatus::ok;
  }
  [[nodiscard]] std::size_t tractions() const override { return 2 * count_; }

 private:
  DftFriction inverse_;
  std::size_t count_;
  std::size_t lasting_ = 0;  // warnings that hold for every frame
};

/// dft of several channels: least squares, frequency by frequency.
class Frequencies final : public Solver {
 public:
  explicit Frequencies(const Scene& scene)
      : inverse_(scene.sensor, scene.material, without_dead_taxels(scene)),
        tractions_(traction_count(scene)),
        rule_(scene.reconstruct.alpha_rule),
        fixed_(scene.reconstruct.alpha),
        noise_(stated_noise(scene)) {
    for (const DftNullMode& mode : inverse_.null_modes())
      facts_.warnings.push_back("no reading shows " + inverse_.in_words(mode) +
                                ": it is set to zero, not measured");
    if (!scene.dead_taxels.empty()) facts_.warnings.emplace_back(dead_taxel_warning);
    lasting_ = facts_.warnings.size();
    if (fixed_) set(*fixed_, AlphaVerdict::ok);
  }

  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    if (!fixed_) {
      const AlphaChoice choice = choose_alpha(inverse_.analyse(readings), rule_, noise_);
      set(choice.alpha, choice.verdict);
    }
    facts_.warnings.resize(lasting_);
    facts_.verdict = steady_verdict_;
    if (inverse_.cut_off(readings, *facts_.alpha)) {
      facts_.verdict = "cut_off";
      facts_.warnings.emplace_back(cut_off_warning);
    }
    return inverse_.solve(readings, *facts_.alpha, tractions);
  }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double> readings,
                                                  std::span<const double> tractions) override {
    return inverse_.forward_bound(readings, *facts_.alpha, tractions);
  }
  [[nodiscard]] std::size_t tractions() const override { return tractions_; }

 private:
  static ProblemOptions without_dead_taxels(const Scene& scene) {
    ProblemOptions options = problem_options(scene);
    options.dead_taxels.clear();
    return options;
  }
  void set(double alpha, AlphaVerdict verdict) {
    facts_.alpha = alpha;
    facts_.condition = inverse_.condition(alpha);
    steady_verdict_ = verdict != AlphaVerdict::ok     ? std::string(name(verdict))
                      : inverse_.null_modes().empty() ? "ok"
                                                      : "null_mode";
  }

  DftTikhonov inverse_;
  std::size_t tractions_;
  AlphaRule rule_;
  std::optional<double> fixed_;
  std::optional<double> noise_;
  std::size_t lasting_ = 0;  // warnings that hold for every frame
  std::string steady_verdict_;
};

/// tikhonov or closed_form with a given alpha: one matrix-vector product a frame.
class MatrixProduct final : public Solver {
 public:
  MatrixProduct(const InverseProblem& problem, Method method, double alpha)
      : inverse_(method == Method::closed_form ? closed_form(problem, alpha)
                                               : tikhonov(problem, alpha)) {
    facts_.alpha = alpha;
    facts_.condition = inverse_.condition();
  }
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    return inverse_.solve(readings, tractions);
  }
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }

 private:
  Reconstruction inverse_;
};

/// tikhonov for large arrays.
class ConjugateGradients final : public Solver {
 public:
  ConjugateGradients(const Scene& scene, double alpha)
      : inverse_(scene.sensor, scene.material, problem_options(scene), alpha) {
    facts_.alpha = alpha;
  }
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    const FrameStatus status = inverse_.solve(readings, tractions);
    const Convergence& convergence = inverse_.convergence();
    facts_.verdict = convergence.converged ? "ok" : "not_converged";
    facts_.warnings.clear();
    if (!convergence.converged)
      facts_.warnings.push_back("conjugate gradients stopped after " +
                                std::to_string(convergence.steps) + " steps, about " +
                                brief(convergence.estimate) + " from the minimiser; raise alpha");
    return status;
  }
  [[nodiscard]] std::size_t tractions() const override { return inverse_.tractions(); }
  [[nodiscard]] std::optional<double> error_bound(std::span<const double>,
                                                  std::span<const double>) override {
    return inverse_.convergence().bound;
  }

 private:
  FftTikhonov inverse_;
};

/// tikhonov under constraints, with a given alpha.
class ActiveSet final : public Solver {
 public:
  ActiveSet(const InverseProblem& problem, const Constraints& constraints, double alpha)
      : inverse_(problem, alpha, constraints), tractions_(problem.kernel.columns) {
    facts_.alpha = alpha;
  }
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    ConstrainedSolution solution = inverse_.solve(readings);
    facts_.condition = solution.condition;
    facts_.warnings.clear();
    facts_.verdict = "ok";
    if (solution.verdict == ConstrainedVerdict::iteration_limit) {
      facts_.verdict = "iteration_limit";
      facts_.warnings.push_back("stopped after " + std::to_string(solution.iterations) +
                                " active sets: the constraints hold, but the fit is not the best");
    }
    std::copy(solution.tractions.begin(), solution.tractions.end(), tractions.begin());
    facts_.constrained = std::move(solution);
    return FrameStatus::ok;
  }
  [[nodiscard]] std::size_t tractions() const override { return tractions_; }

 private:
  ConstrainedTikhonov inverse_;
  std::size_t tractions_;
};

/// A solver for a given alpha.
std::unique_ptr<Solver> with_alpha(const Scene& scene, Method method, const InverseProblem& problem,
                                   double alpha) {
  const auto constraints = constraints_of(scene);
  if (method == Method::tikhonov && constraints)
    return std::make_unique<ActiveSet>(problem, *constraints, alpha);
  return std::make_unique<MatrixProduct>(problem, method, alpha);
}

/// Each frame gets the alpha that the scene's rule chooses.
class RuleOfFrame final : public Solver {
 public:
  RuleOfFrame(const Scene& scene, Method method)
      : scene_(scene),
        method_(method),
        problem_(problem_of(scene)),
        family_(problem_),
        noise_(stated_noise(scene)),
        plain_(method == Method::tikhonov && !constraints_of(scene)) {}

  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    const FilterFrame frame = family_.analyse(readings);
    const AlphaChoice choice = choose_alpha(frame, scene_.reconstruct.alpha_rule, noise_);
    if (plain_) {
      facts_.alpha = choice.alpha;
      facts_.condition = family_.condition(choice.alpha);
      const std::vector<double> f = family_.solve(frame, choice.alpha);
      std::copy(f.begin(), f.end(), tractions.begin());
    } else {
      const auto solver = with_alpha(scene_, method_, problem_, choice.alpha);
      const FrameStatus status = solver->solve(readings, tractions);
      facts_ = solver->facts();
      if (status != FrameStatus::ok) return status;
    }
    if (choice.verdict != AlphaVerdict::ok)
      facts_.verdict = verdict_of(choice);
    else if (plain_)
      facts_.verdict = "ok";
    return FrameStatus::ok;
  }
  [[nodiscard]] std::size_t tractions() const override { return problem_.kernel.columns; }

 private:
  Scene scene_;
  Method method_;
  InverseProblem problem_;
  TikhonovFamily family_;
  std::optional<double> noise_;
  bool plain_;
};

/// The same for large arrays: the rule in the Fourier basis, then conjugate gradients.
class LargeRuleOfFrame final : public Solver {
 public:
  explicit LargeRuleOfFrame(const Scene& scene) : scene_(scene) {}
  FrameStatus solve(std::span<const double> readings, std::span<double> tractions) override {
    const AlphaChoice choice = sweep_of(scene_, readings).choice(scene_.reconstruct.alpha_rule);
    ConjugateGradients solver(scene_, choice.alpha);
    const FrameStatus status = solver.solve(readings, tractions);
    facts_ = solver.facts();
    if (choice.verdict != AlphaVerdict::ok) facts_.verdict = verdict_of(choice);
    return status;
  }
  [[nodiscard]] std::size_t tractions() const override { return traction_count(scene_); }

 private:
  Scene scene_;
};

}  // namespace

ProblemOptions problem_options(const Scene& scene) {
  ProblemOptions options{.unknowns = unknowns(scene),
                         .smoothing_length = scene.reconstruct.smoothing_length,
                         .channel_rms = {},
                         .dead_taxels = scene.dead_taxels};
  if (scene.noise && scene.noise->weights_rows)
    for (const Channel& channel : channels(scene.sensor))
      options.channel_rms.push_back(scene.noise->rms.at(channel.quantity));
  return options;
}

InverseProblem problem_of(const Scene& scene) {
  return make_problem(scene.sensor, scene.material, problem_options(scene));
}

std::optional<double> stated_noise(const Scene& scene) {
  if (!scene.noise) return std::nullopt;
  if (scene.noise->weights_rows) return 1.0;
  const double rms = scene.noise->rms.begin()->second;
  return rms > 0.0 ? std::optional(rms) : std::nullopt;
}

std::optional<Constraints> constraints_of(const Scene& scene) {
  const ReconstructOptions& options = scene.reconstruct;
  if (!options.nonnegative && !options.friction_limit) return std::nullopt;
  return Constraints{.nonnegative = true, .friction_limit = options.friction_limit};
}

AlphaSweep sweep_of(const Scene& scene, std::span<const double> readings) {
  if (traction_count(scene) < large)
    return sweep_alpha(TikhonovFamily(problem_of(scene)).analyse(readings), stated_noise(scene));
  ProblemOptions options = problem_options(scene);
  options.dead_taxels.clear();
  return sweep_alpha(DftTikhonov(scene.sensor, scene.material, options).analyse(readings),
                     stated_noise(scene));
}

std::unique_ptr<Solver> make_solver(const Scene& scene, Method method) {
  switch (method) {
    case Method::dft:
      if (scene.reconstruct.contact_friction) return std::make_unique<Sliding>(scene);
      if (scene.sensor.reads.size() * scene.sensor.depths.size() == 1)
        return std::make_unique<Division>(scene);
      return std::make_unique<Frequencies>(scene);
    case Method::tikhonov:
    case Method::closed_form: {
      const bool by_fft =
          traction_count(scene) >= large && method == Method::tikhonov && !constraints_of(scene);
      const auto alpha = scene.reconstruct.alpha;
      if (by_fft && alpha) return std::make_unique<ConjugateGradients>(scene, *alpha);
      if (by_fft) return std::make_unique<LargeRuleOfFrame>(scene);
      if (alpha) return with_alpha(scene, method, problem_of(scene), *alpha);
      return std::make_unique<RuleOfFrame>(scene, method);
    }
    case Method::network:
      break;
  }
  throw std::invalid_argument("the network is relaxed by ngspice, not solved frame by frame");
}

}  // namespace tactile_net::lab
