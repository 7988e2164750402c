#include "tactile_net/control/planner.hpp"

#include "src/control/planner_parts.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"

using namespace tactile_net;

TEST_CASE("every planned path keeps its accuracy, on random readings and on contacts at the edge",
          "[planner]") {
  const auto problems = sample_problems();
  const std::size_t which = GENERATE(range(std::size_t{0}, std::size_t{14}));
  const auto& [name, problem] = problems.at(which);
  const double alpha = GENERATE(1e-2, 1e-6);
  const double accuracy = GENERATE(1e-3, 1e-7, 1e-11);
  CAPTURE(name, alpha, accuracy);
  const Reconstruction dense = tikhonov(problem, alpha);
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::parity,
                                    Structure::parity_low_rank, Structure::fft})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      if (structure == Structure::fft && precision == Precision::float32) continue;  // refused
      CAPTURE(tactile_net::name(structure), tactile_net::name(precision));
      PlannerOptions options{.accuracy = accuracy, .structure = structure};
      options.precision = precision;
      options.diagnostics = false;
      std::optional<PlannedEstimator> planned;
      try {
        planned = plan_estimator(problem, alpha, options);
      } catch (const std::invalid_argument&) {
        const bool dead = name == "weighted, a dead taxel" || name.starts_with("a finer surface");
        const bool square = problem.surface.count == problem.taxels;
        REQUIRE(((has_parity(structure) && dead) || (structure == Structure::fft && !square)));
        continue;
      }
      const Candidate& candidate = planned->candidates.front();
      if (precision == Precision::float64 && accuracy >= 1e-7) CHECK(candidate.accurate);
      ContactEstimator estimator(planned->plan, fft_convolutions());
      std::vector<double> f(dense.tractions());
      std::vector<double> expected(f.size());
      ContactEstimate estimate{.tractions = f};
      for (unsigned seed = 0; seed < 6; ++seed) {
        const std::vector<double> g =
            seed % 2 == 0 ? contact_readings(problem, seed) : random_values(dense.readings(), seed);
        REQUIRE(dense.solve(g, expected) == FrameStatus::ok);
        REQUIRE(estimator.update(g, estimate) == FrameStatus::ok);
        const double error = l2_norm(difference(f, expected));
        CHECK(error <= candidate.error_bound * unit_of_error(problem, dense, g, expected) +
                           1e-13 * l2_norm(expected));
        if (candidate.accurate)
          CHECK(candidate.error_bound <=
                (structure == Structure::dense ? std::max(accuracy, 1e-9) : accuracy));
      }
    }
}

TEST_CASE("a dear way that is accurate is better than a cheap one that is not", "[planner]") {
  const Candidate dear{.cost = 9.0, .error_bound = 1e-8, .accurate = true};
  const Candidate cheap{.cost = 1.0, .error_bound = 1e-6, .accurate = false};
  CHECK(is_better(dear, cheap));
  CHECK_FALSE(is_better(cheap, dear));
  const Candidate cheaper{.cost = 8.0, .error_bound = 5e-8, .accurate = true};
  CHECK(is_better(cheaper, dear));
  CHECK_FALSE(is_better(dear, dear));
  // Where none is accurate, the one that errs less: whoever asks for its structure has the best.
  const Candidate coarse{.cost = 0.5, .error_bound = 1e-5, .accurate = false};
  CHECK(is_better(cheap, coarse));
  CHECK_FALSE(is_better(coarse, cheap));
}
