#include "tactile_net/control/planner.hpp"

#include "src/control/planner_parts.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/control/frames.hpp"
#include "tests/inverse/pads.hpp"

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
  for (const Structure structure : {Structure::dense, Structure::low_rank, Structure::reflections,
                                    Structure::reflections_low_rank, Structure::fft})
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
        const bool square = problem.grid.count() == problem.taxels;
        REQUIRE(((has_reflections(structure) && dead) || (structure == Structure::fft && !square)));
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

TEST_CASE("contacts on a line that are dragged apart have the margin of one of them", "[planner]") {
  const Structure structure = GENERATE(Structure::dense, Structure::fft);
  const double mu = 0.5;
  const SensorArray array{.count = 64,
                          .pitch = 1e-3,
                          .depths = {2e-3},
                          .reads = {Quantity::stress_x, Quantity::shear_xy}};
  const LinearProblem problem = make_problem(array, silicone, {.unknowns = 2});
  ContactEstimator estimator(
      plan_estimator(problem, 1e-4,
                     {.structure = structure, .noise_rms = 10.0, .friction_coefficient = mu})
          .plan,
      fft_convolutions());
  std::vector<double> f(estimator.tractions());
  ContactEstimate e{.tractions = f};
  const auto update = [&](const std::vector<Contact>& contacts) {
    REQUIRE(estimator.update(exact_readings(array, silicone, contacts), e) == FrameStatus::ok);
  };
  const double used = GENERATE(0.3, 0.9);
  RigidContact left{.center = -15e-3, .half_width = 4e-3, .force = 100.0, .friction = used * mu};
  RigidContact right = left;
  right.center = -left.center;
  right.friction = -left.friction;
  update({left});
  CHECK(e.contacts == 1);
  CHECK(e.margin_centre == e.centre);
  const double alone = e.friction_margin;
  CHECK_THAT(alone, WithinAbs((1.0 - used) * mu * left.force, 1.0));
  update({left, right});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.normal_force, WithinRel(200.0, 0.01));  // of both
  CHECK_THAT(e.tangential_force, WithinAbs(0.0, 1.0));
  CHECK_THAT(e.friction_margin, WithinAbs(alone, 1.0));  // of one
  // The weaker one slips first.
  left.force = 20.0;
  right.friction = 0.1 * mu;
  update({right, left});
  CHECK(e.contacts == 2);
  CHECK_THAT(e.margin_centre, WithinAbs(left.center, 1e-3));
  CHECK_THAT(e.friction_margin, WithinAbs((1.0 - used) * mu * left.force, 1.0));
}
