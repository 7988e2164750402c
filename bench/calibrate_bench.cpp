// What a calibration costs: fits of 20, 200 and 2000 presses on a line of 41 taxels and of 20 balls
// on a skin, each in a process of its own, in the processor's seconds and at the largest in memory.
//
//     bench_calibrate [largest number of presses, 2000]
//
// Floors: 20 presses in 0.2 s, 200 in 2 s, 2000 in at most 1.3 times as long a press as 200 take,
// and 200 MB. Logs as in docs/internals/calibration.md.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <functional>
#include <stdexcept>

#include "bench/floors.hpp"
#include "tactile_net/calibration/press_fit.hpp"
#include "tests/calibration/simulated_log.hpp"
#include "tests/calibration/simulated_skin_log.hpp"

namespace {

using namespace tactile_net;

constexpr double megabyte = 1024.0 * 1024.0;

struct FitCost {
  double seconds = 0.0;  ///< of the processor: waiting for others does not count
  double iterations = 0.0;
};

struct ProcessCost {
  FitCost fit{};
  double megabytes = 0.0;  ///< of the whole process, its making of the log among them
};

/// In a child, whose largest memory is nobody else's.
ProcessCost in_a_child(const std::function<FitCost()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    int status = EXIT_FAILURE;
    try {
      const FitCost cost = work();
      if (::write(ends[1], &cost, sizeof cost) == sizeof cost) status = EXIT_SUCCESS;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(status);
  }
  ::close(ends[1]);
  ProcessCost cost;
  const bool told = ::read(ends[0], &cost.fit, sizeof cost.fit) == sizeof cost.fit;
  ::close(ends[0]);
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  if (!told || status != 0) throw std::runtime_error("a fit failed");
  cost.megabytes = static_cast<double>(usage.ru_maxrss) * 1024.0 / megabyte;
  return cost;
}

template <class Log>
FitCost fitted(const Log& made) {
  const auto model = made.model();
  const std::clock_t start = std::clock();
  const PressFit fit = fit_presses(model, made.log);
  FitCost cost{.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
               .iterations = static_cast<double>(fit.iterations)};
  if (fit.verdict != FitVerdict::ok) throw std::runtime_error("a fit that is not ok");
  return cost;
}

void show(const char* what, const ProcessCost& cost) {
  bench::progress(bench::text("%s: %.3g s, %.0f MB, %.0f iterations", what, cost.fit.seconds,
                              cost.megabytes, cost.fit.iterations));
}

}  // namespace

int main(int count, char** arguments) {
  const std::size_t most = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 2000;
  bench::Floors floors;
  const auto line = [](std::size_t presses, bool knows_width) {
    return in_a_child(
        [=] { return fitted(simulated_log(1, {.presses = presses, .knows_width = knows_width})); });
  };
  const ProcessCost few = line(20, true);
  floors.at_most("20 presses, all known: seconds", few.fit.seconds, 0.2);
  show("20 presses, widths unknown, three starts", line(20, false));
  const ProcessCost many = line(200, true);
  floors.at_most("200 presses: seconds", many.fit.seconds, 2.0);
  floors.at_most("200 presses: MB", many.megabytes, 200.0);
  if (most > 200) {
    const ProcessCost all = line(most, true);
    show("the largest log", all);
    const auto of_one = [](const ProcessCost& cost, std::size_t presses) {
      return cost.fit.seconds / cost.fit.iterations / static_cast<double>(presses);
    };
    floors.at_most("a press and iteration of the largest log over one of 200",
                   of_one(all, most) / of_one(many, 200), 1.3);
    floors.at_most("the largest log: MB", all.megabytes, 200.0);
  }
  show("20 balls on a skin of 8 x 8 with three quantities", in_a_child([] {
         return fitted(simulated_skin_log(
             2, {.side = 8,
                 .presses = 20,
                 .reads = {Quantity::stress_x, Quantity::shear_xy, Quantity::shear_xz}}));
       }));
  return floors.all_hold() ? EXIT_SUCCESS : EXIT_FAILURE;
}
