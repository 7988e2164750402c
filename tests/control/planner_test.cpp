#include "tactile_net/control/planner.hpp"

#include "src/control/product_planner.hpp"
#include "tactile_net/control/fft_convolution.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/sensing/exact.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/pads.hpp"

using namespace tactile_net;

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
