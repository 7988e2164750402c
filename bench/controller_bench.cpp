// The per-frame call of a controller, against what else turns readings into tractions and against
// the time in which the dense matrix can be read at all. With arguments only those floors, 1 to 5,
// and those numbers of taxels. A floor that is missed makes the exit status 1.
#include <time.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <random>
#include <set>

#include "bench/floors.hpp"
#include "bench/latency.hpp"
#include "bench/native.hpp"
#include "bench/rivals.hpp"
#include "tactile_net/control/planner.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/sampled.hpp"

namespace {

using namespace tactile_net;
using bench::Floors;
using bench::progress;
using bench::text;

constexpr double alpha = 1e-4;

/// Results nobody looks at must be computed all the same.
volatile double sink = 0.0;

void say(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

/// Where the arrays stand: thesis, 4.3, or with its pitch at 81 taxels whatever their number.
enum class Spacing { thesis_aperture, fixed_pitch };

LinearProblem problem_of(std::size_t count, std::size_t unknowns, Spacing spacing) {
  const double pitch =
      spacing == Spacing::thesis_aperture ? 10.0 / static_cast<double>(count - 1) : 0.125;
  SensorArray array{.count = count, .pitch = pitch, .depths = {1.5}, .reads = {Quantity::stress_x}};
  if (unknowns == 2) array.reads.push_back(Quantity::shear_xy);
  LineProblemOptions options;
  options.unknowns = unknowns;
  options.smoothing_length = 1.0;
  return make_problem(array, {.youngs_modulus = 1.0, .poisson_ratio = 0.45}, options);
}

/// Two contacts, one of them at the edge, and noise of a thousandth.
std::vector<std::vector<double>> frames_of(const LinearProblem& problem) {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise;
  std::vector<std::vector<double>> frames(8, std::vector<double>(problem.kernel.rows));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::vector<double> f(problem.kernel.columns);
    for (std::size_t j = 0; j < f.size(); ++j) {
      const double y =
          static_cast<double>(j % problem.grid.count()) / static_cast<double>(problem.grid.count());
      const double middle = (y - 0.3 - 0.02 * static_cast<double>(k)) / 0.1;
      const double edge = (1.0 - y) / 0.1;
      f[j] = (std::sqrt(std::max(0.0, 1.0 - middle * middle)) +
              0.5 * std::sqrt(std::max(0.0, 1.0 - edge * edge))) *
             (j < problem.grid.count() ? 1.0 : 0.3);
    }
    for (std::size_t i = 0; i < problem.kernel.rows; ++i) {
      for (std::size_t j = 0; j < f.size(); ++j) frames[k][i] += problem.kernel(i, j) * f[j];
      frames[k][i] += 1e-3 * noise(generator);
    }
  }
  return frames;
}

/// A plan at work on frames in turn.
class Runner {
 public:
  Runner(const EstimatorPlan& plan, const std::vector<std::vector<double>>& frames,
         InstructionSet set = widest_instruction_set())
      : estimator_(plan, set), frames_(&frames), f_(plan.tractions()) {
    estimate_.tractions = f_;
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  void operator()() noexcept {
    if (estimator_.update((*frames_)[next_++ % 8], estimate_) != FrameStatus::ok) std::abort();
  }
  [[nodiscard]] const std::vector<double>& tractions() const noexcept { return f_; }
  void restart() noexcept { next_ = 0; }

 private:
  ContactEstimator estimator_;
  const std::vector<std::vector<double>>* frames_;
  std::vector<double> f_;
  ContactEstimate estimate_{};
  std::size_t next_ = 0;
};

/// One array with all that is timed on it.
struct Case {
  std::size_t count, unknowns;
  Spacing spacing;
  LinearProblem problem;
  std::vector<std::vector<double>> frames;
  std::vector<double> right_side;  // of the first frame
  std::optional<bench::Rivals> rivals{};
  EstimatorPlan planned{};    // accuracy 1e-7, no diagnostics
  EstimatorPlan diagnosed{};  // and a residual, outliers
  EstimatorPlan exact{};      // the dense matrix itself
  std::string choice{};

  Case(std::size_t n, std::size_t u, Spacing s)
      : count(n),
        unknowns(u),
        spacing(s),
        problem(problem_of(n, u, s)),
        frames(frames_of(problem)) {
    say("setting up " + name());
    right_side = normal_right_side(problem, frames[0]);
    const Matrix normal = normal_matrix(problem, alpha);
    rivals.emplace(problem.kernel.values.data(), normal.values.data(), problem.kernel.rows,
                   problem.kernel.columns);
    PlannedEstimator result = plan_estimator(problem, alpha, {.accuracy = 1e-7});
    diagnosed = std::move(result.plan);
    planned = diagnosed;
    planned.prediction.reset();
    planned.leverages.clear();
    for (const Candidate& candidate : result.candidates)
      if (candidate.chosen) {
        choice = std::string(tactile_net::name(candidate.structure));
        for (const std::size_t rank : candidate.ranks) choice += " " + std::to_string(rank);
      }
    exact = planned;
    const std::size_t rows = problem.kernel.columns;
    const std::size_t columns = problem.kernel.rows;
    exact.reconstruction = {.rows = rows, .columns = columns};
    Factor m{rows, columns, std::vector<double>(rows * columns)};
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        m.values[i * columns + j] = rivals->matrix()[j * rows + i];
    exact.reconstruction.factors.push_back(std::move(m));
  }

  [[nodiscard]] std::string name() const {
    return text("%zu taxels, %zu unknown%s, %s", count, unknowns, unknowns == 1 ? "" : "s",
                spacing == Spacing::thesis_aperture ? "thesis aperture" : "pitch 0.125");
  }
};

/// 1. Seconds a frame, hot, everything in turn.
void frame_times(Floors& floors, Case& one) {
  bench::Rivals& rivals = *one.rivals;
  Runner planned(one.planned, one.frames);
  Runner diagnosed(one.diagnosed, one.frames);
  Runner exact(one.exact, one.frames);
  std::vector<double> f(one.planned.tractions());
  std::size_t next = 0;
  const auto frame = [&] { return one.frames[next++ % 8].data(); };

  enum : std::size_t {
    limit_plain,
    limit_prefetch,
    ours,
    with_diagnostics,
    dense,
    eigen,
    ldlt,
    solve,
    openblas
  };
  std::vector<bench::Call> calls{
      [&] { sink = rivals.stream(); },
      [&] { sink = rivals.stream_with_prefetch(); },
      [&] { planned(); },
      [&] { diagnosed(); },
      [&] { exact(); },
      [&] { rivals.eigen_product(frame(), f.data()); },
      [&] { rivals.ldlt(frame(), f.data()); },
      [&] { rivals.ldlt_solve(one.right_side.data(), f.data()); },
  };
  if (!bench::openblas().empty())
    calls.push_back([&] { rivals.openblas_product(frame(), f.data()); });
  const bench::InTurn hot = bench::in_turn(calls, 61);
  const bench::InTurn factoring = bench::in_turn(
      {[&] { rivals.factor_and_solve(one.frames[0].data(), f.data()); }, [&] { planned(); }},
      one.problem.kernel.columns > 500 ? 3 : 15);
  const std::size_t limit =
      hot.median(limit_plain) < hot.median(limit_prefetch) ? limit_plain : limit_prefetch;

  // All of them solve the same problem.
  double apart = 0.0;
  std::vector<double> expected(f.size());
  rivals.ldlt(one.frames[0].data(), expected.data());
  for (Runner* runner : {&planned, &diagnosed, &exact}) {
    runner->restart();
    (*runner)();
    apart = std::max(apart, relative_l2_error(runner->tractions(), expected));
  }
  const auto ns = [&](std::size_t call) { return 1e9 * hot.median(call); };
  progress(text(
      "ns a frame: planned %.0f (%s, %zu bytes), with diagnostics %.0f, exact dense %.0f, "
      "limit %.0f (%s)",
      ns(ours), one.choice.c_str(), streamed_bytes(one.planned.reconstruction),
      ns(with_diagnostics), ns(dense), ns(limit), limit == limit_plain ? "plain" : "prefetching"));
  progress(
      text("rivals: Eigen dense %.0f, OpenBLAS %s, K'g + LDLT solve %.0f, LDLT solve %.0f, "
           "LDLT each frame %.0f; tractions %.1e apart",
           ns(eigen), calls.size() > openblas ? text("%.0f", ns(openblas)).c_str() : "-", ns(ldlt),
           ns(solve), 1e9 * factoring.median(0), apart));

  const bool thesis = one.spacing == Spacing::thesis_aperture;
  if (one.count >= 121)
    floors.at_most("1. exact dense over the streaming limit", hot.ratio(dense, limit), 1.15);
  else
    progress(text("exact dense over the streaming limit: %.2f", hot.ratio(dense, limit)));
  if (thesis && one.count >= 81) {
    const double most = one.count == 81 ? 0.35 : one.count <= 256 ? 0.25 : 0.06;
    floors.at_most("1. planned over the dense streaming limit", hot.ratio(ours, limit), most);
    progress(text("with diagnostics: %.3f", hot.ratio(with_diagnostics, limit)));
  } else {
    progress(text("planned over the dense streaming limit: %.3f, with diagnostics %.3f",
                  hot.ratio(ours, limit), hot.ratio(with_diagnostics, limit)));
  }
  if (thesis)
    floors.at_least("1. LDLT solve, prefactored, over planned", hot.ratio(solve, ours), 12);
  else
    progress(text("LDLT solve, prefactored, over planned: %.1f", hot.ratio(solve, ours)));
  if (thesis && one.count == 81)
    floors.at_least("1. LDLT each frame over planned", factoring.ratio(0, 1), 200);
  else
    progress(text("LDLT each frame over planned: %.0f", factoring.ratio(0, 1)));
}

std::string row(const bench::Distribution& times) {
  return text("p50 %.3f, p99 %.3f, p99.9 %.3f, worst %.1f us", 1e6 * times.p50, 1e6 * times.p99,
              1e6 * times.p999, 1e6 * times.worst);
}

/// 2. How much 100000 frames one after the other differ.
void jitter(Floors& floors, Case& one, const bench::Ticks& ticks) {
  constexpr std::size_t calls = 100000;
  const bench::FirstInLine first;
  double shortest = 0.0;
  for (const bool diagnostics : {false, true}) {
    Runner runner(diagnostics ? one.diagnosed : one.planned, one.frames);
    const bench::Distribution times = bench::distribution(
        ticks, calls, [] {}, [&] { runner(); });
    progress("hot" + std::string(diagnostics ? ", with diagnostics: " : ": ") + row(times));
    if (diagnostics) continue;
    floors.at_most("2. p99.9 over p50, hot", times.p999 / times.p50, 2.0);
    shortest = times.p50;
  }
  // What the machine itself does to as long a time without a single access to memory.
  constexpr std::size_t many = 1000000;
  const double round = bench::distribution(
                           ticks, 3, [] {}, [&] { bench::spin(many); })
                           .p50 /
                       double{many};
  const auto rounds = static_cast<std::size_t>(shortest / round);
  const bench::Distribution idle = bench::distribution(
      ticks, calls, [] {}, [&] { bench::spin(rounds); });
  progress("as long in registers: " + row(idle) +
           text(" (p99.9 over p50: %.3g)", idle.p999 / idle.p50));
}

/// 3. A control loop: 1 kHz, and 4 MB of other data in every cycle.
void paced(Floors& floors, Case& one, const bench::Ticks& ticks) {
  constexpr std::size_t cycles = 3000;
  const bench::FirstInLine first;
  Runner runner(one.planned, one.frames);
  const double hot = bench::distribution(
                         ticks, 10000, [] {}, [&] { runner(); })
                         .p50;
  std::vector<double> foreign((4U << 20) / sizeof(double), 1.0);
  std::vector<double> same_bytes(
      (streamed_bytes(one.planned.reconstruction) / sizeof(double) + 15) / 8 * 8, 1.0);
  auto* start = static_cast<void*>(same_bytes.data());
  std::size_t room = same_bytes.size() * sizeof(double);
  const auto* aligned = static_cast<const double*>(std::align(64, 64, start, room));
  const std::size_t count = room / 64 * 8;

  timespec next{};
  clock_gettime(CLOCK_MONOTONIC, &next);
  const auto cycle = [&] {
    for (double& value : foreign) value += 1.0;
    next.tv_nsec += 1000000;
    if (next.tv_nsec >= 1000000000) {
      next.tv_nsec -= 1000000000;
      ++next.tv_sec;
    }
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
  };
  const bench::Distribution cold = bench::distribution(ticks, cycles, cycle, [&] { runner(); });
  const bench::Distribution reading =
      bench::distribution(ticks, cycles / 3, cycle, [&] { sink = bench::sum(aligned, count); });
  progress(text("1 kHz, 4 MB: hot %.3f, cold ", 1e6 * hot) + row(cold));
  progress(text("1 kHz, 4 MB, as many bytes only read: p50 %.3f us, x %.2f of it",
                1e6 * reading.p50, cold.p50 / reading.p50));
  floors.at_most("3. 1 kHz with 4 MB of other data, p50 over hot", cold.p50 / hot, 3.0);
}

/// 4. What the portable build and each instruction set cost.
void builds(Floors& floors, Case& one) {
  for (const bool exact : {false, true}) {
    const EstimatorPlan& plan = exact ? one.exact : one.planned;
    const char* what = exact ? "exact dense" : "planned";
    Runner portable(plan, one.frames);
    const bench::Native native(bench::make_native(plan));
    std::vector<double> f(plan.tractions());
    ContactEstimate estimate{.tractions = f};
    std::size_t next = 0;
    std::vector<bench::Call> calls{
        [&] { portable(); },
        [&] {
          if (bench::update(*native, one.frames[next++ % 8], estimate) != FrameStatus::ok)
            std::abort();
        }};
    std::vector<std::unique_ptr<Runner>> narrower;
    std::string sets = std::string(name(widest_instruction_set())) + " 1";
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::baseline})
      if (set < widest_instruction_set()) {
        narrower.push_back(std::make_unique<Runner>(plan, one.frames, set));
        calls.push_back([runner = narrower.back().get()] { (*runner)(); });
      }
    const bench::InTurn times = bench::in_turn(calls, 61);
    std::size_t k = 2;
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::baseline})
      if (set < widest_instruction_set())
        sets += ", " + std::string(name(set)) + text(" %.2f", times.ratio(k++, 0));
    progress(text("%s, %.0f ns; over it: ", what, 1e9 * times.median(0)) + sets);
    floors.at_most(text("4. portable build over -march=native, %s", what), times.ratio(0, 1), 1.15);
  }
}

/// 5. Whether the planner's choice is the fastest of all that are accurate enough.
void choices(Floors& floors, std::size_t count, std::size_t unknowns, double accuracy) {
  const LinearProblem problem = problem_of(count, unknowns, Spacing::thesis_aperture);
  const std::vector<std::vector<double>> frames = frames_of(problem);
  PlannerOptions options{.accuracy = accuracy};
  options.diagnostics = false;
  options.all_candidates = true;
  const PlannedEstimator planned = plan_estimator(problem, alpha, options);
  std::vector<std::unique_ptr<Runner>> runners;
  std::vector<bench::Call> calls;
  std::vector<std::string> names;
  std::size_t chosen = 0;
  for (const Candidate& candidate : planned.candidates) {
    if (!candidate.accurate) continue;
    options.structure = candidate.structure;
    options.precision = candidate.precision;
    if (candidate.chosen) chosen = calls.size();
    runners.push_back(std::make_unique<Runner>(
        candidate.chosen ? planned.plan : plan_estimator(problem, alpha, options).plan, frames));
    calls.push_back([runner = runners.back().get()] { (*runner)(); });
    names.push_back(std::string(name(candidate.structure)) + " " +
                    std::string(name(candidate.precision)));
  }
  const bench::InTurn times = bench::in_turn(calls, 41);
  double worst = 0.0;
  std::string line = text("%zu taxels, %zu unknowns, accuracy %.0e:", count, unknowns, accuracy);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    line += text(" %s%s %.0f ns", i == chosen ? "* " : "", names[i].c_str(), 1e9 * times.median(i));
    worst = std::max(worst, times.ratio(chosen, i));
  }
  progress(line);
  floors.at_most("5. the planner's choice over the best", worst, 1.1);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace

int main(int argument_count, char** arguments) {
  std::set<std::size_t> wanted;
  std::set<std::size_t> sizes;
  for (int i = 1; i < argument_count; ++i) {
    const std::size_t number = std::strtoul(arguments[i], nullptr, 10);
    (number <= 5 ? wanted : sizes).insert(number);
  }
  if (wanted.empty()) wanted = {1, 2, 3, 4, 5};
  if (sizes.empty()) sizes = {41, 81, 121, 256, 512, 1024};

  const bool pinned = bench::pin_to_one_core();
  const bench::Ticks ticks;
  double load = 0.0;
  (void)getloadavg(&load, 1);
  std::printf("%s, %s instructions; %s; %s, load %.1f\n", processor().c_str(),
              name(widest_instruction_set()).data(), COMPILER,
              pinned ? "one core" : "NOT on one core", load);
  std::printf("OpenBLAS: %s\n",
              bench::openblas().empty() ? "not installed" : bench::openblas().c_str());
  std::printf("single calls by %s, less the %.0f ns that it takes itself\n",
#if defined(__x86_64__)
              "the time stamp counter",
#else
              "std::chrono::steady_clock",
#endif
              1e9 * ticks.overhead());

  std::printf("floors 2 and 3 %s\n", bench::FirstInLine().granted()
                                         ? "before all other programs (SCHED_FIFO)"
                                         : "among all other programs (no right to SCHED_FIFO)");

  Floors floors;
  const auto any = [&](std::initializer_list<std::size_t> numbers) {
    return std::any_of(numbers.begin(), numbers.end(),
                       [&](std::size_t number) { return wanted.count(number) > 0; });
  };
  for (const std::size_t unknowns : {1U, 2U})
    for (const Spacing spacing : {Spacing::thesis_aperture, Spacing::fixed_pitch})
      for (const std::size_t count : sizes) {
        if (!any({1}) && (spacing == Spacing::fixed_pitch || !any({2, 3, 4}))) continue;
        Case one(count, unknowns, spacing);
        std::printf("%s\n", one.name().c_str());
        if (wanted.count(1) > 0) frame_times(floors, one);
        if (spacing == Spacing::fixed_pitch) continue;
        if (wanted.count(2) > 0) jitter(floors, one, ticks);
        if (wanted.count(3) > 0) paced(floors, one, ticks);
        if (wanted.count(4) > 0) builds(floors, one);
      }
  if (wanted.count(5) > 0)
    for (const std::size_t unknowns : {1U, 2U})
      for (const std::size_t count : sizes)
        for (const double accuracy : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12})
          if (unknowns * count <= 256 || (accuracy == 1e-7 && unknowns * count <= 1024))
            choices(floors, count, unknowns, accuracy);
  return floors.all_hold() ? EXIT_SUCCESS : EXIT_FAILURE;
}
