#include <limits>

#include "tests/inverse/problems.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/answer.hpp"
#include "tests/realtime/plans.hpp"

using namespace tactile_net;

TEST_CASE("a bad frame is reported and leaves every member of the estimate alone",
          "[contact_estimator]") {
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  const bool diagnostics = GENERATE(true, false);
  const Structure structure = GENERATE(Structure::dense, Structure::low_rank,
                                       Structure::reflections, Structure::reflections_low_rank);
  ContactEstimator estimator(made_plan(
      {.unknowns = 2, .structure = structure, .precision = precision, .diagnostics = diagnostics}));
  const std::vector<double> good = random_values(estimator.readings(), 1);
  const auto refused = [&](const std::vector<double>& readings, FrameStatus status) {
    Answer kept(estimator);
    const auto before = kept.bits();
    CHECK(estimator.update(readings, kept.estimate, 99.0) == status);
    CHECK(kept.bits() == before);
  };
  refused({}, FrameStatus::wrong_size);
  refused(std::vector<double>(good.begin(), good.end() - 1), FrameStatus::wrong_size);
  refused(std::vector<double>(estimator.readings() + 1), FrameStatus::wrong_size);
  for (const double bad : {not_a_number, -not_a_number, infinite, -infinite})
    for (std::size_t i = 0; i < good.size(); ++i) {
      std::vector<double> readings = good;
      readings[i] = bad;
      refused(readings, FrameStatus::not_finite);
      readings[(i + 5) % readings.size()] = 1e308;  // not finite comes before too large
      refused(readings, FrameStatus::not_finite);
    }
  for (const double huge : {1e308, -1.7e308, std::numeric_limits<double>::max()}) {
    std::vector<double> readings = good;
    readings[2] = huge;
    refused(readings, FrameStatus::too_large);
    refused(std::vector<double>(good.size(), huge), FrameStatus::too_large);
  }

  Answer small(estimator);
  small.estimate.tractions = std::span(small.tractions).first(3);
  const auto before = small.bits();
  CHECK(estimator.update(good, small.estimate) == FrameStatus::wrong_size);
  CHECK(small.bits() == before);
}

TEST_CASE("what is not refused is finite, up to the largest readings", "[contact_estimator]") {
  for (const Structure structure : structures)
    for (const Precision precision : {Precision::float64, Precision::float32})
      for (const bool diagnostics : {true, false}) {
        EstimatorPlan plan = made_plan({.unknowns = 2,
                                        .structure = structure,
                                        .precision = precision,
                                        .diagnostics = diagnostics});
        plan.friction_coefficient = 1e6;
        if (precision == Precision::float64) add_cone(plan, 0.5);
        ContactEstimator estimator(plan);
        if (diagnostics) REQUIRE(estimator.set_dead(4));
        int accepted = 0;
        for (int exponent = 1023; exponent > 300; exponent -= 3)
          for (unsigned seed = 0; seed < 3; ++seed) {
            const std::vector<double> g =
                scaled(random_values(estimator.readings(), seed), exponent);
            Answer result(estimator);
            if (estimator.update(g, result.estimate) != FrameStatus::ok) continue;
            ++accepted;
            const ContactEstimate& found = result.estimate;
            for (const double f : found.tractions) REQUIRE(std::isfinite(f));
            REQUIRE(std::isfinite(found.normal_force));
            REQUIRE(std::isfinite(found.tangential_force));
            REQUIRE(std::isfinite(found.friction_margin));
            if (diagnostics) REQUIRE(std::isfinite(found.residual_rms));
          }
        CHECK(accepted > 100);
        CHECK(accepted < 3 * 241);
      }
}

TEST_CASE("what is filled in for dead readings may be too large itself", "[contact_estimator]") {
  // Two readings that say the same: of weight 1 and 1e-9, the second predicted as 1e9 times the
  // first. Where only the first is large, the frame passes; with the second dead it must not.
  EstimatorPlan plan = made_plan({.count = 2, .structure = Structure::dense});
  plan.weights = {1.0, 1e-9};
  plan.prediction->factors[0].values = {0.4, 0.4e-9, 0.4e9, 0.4};
  plan.leverages = {0.4, 0.4};
  ContactEstimator estimator(plan);
  REQUIRE(estimator.set_dead(1));
  double largest = 1.0;
  Answer result(estimator);
  for (; largest < 1e300; largest *= 2.0) {
    const std::vector<double> g{largest, 0.0};
    if (estimator.update(g, result.estimate) != FrameStatus::ok) break;
    REQUIRE(std::isfinite(result.estimate.normal_force));
  }
  const std::vector<double> g{largest, 0.0};
  CHECK(estimator.update(g, result.estimate) == FrameStatus::too_large);
  estimator.revive();
  CHECK(estimator.update(g, result.estimate) == FrameStatus::ok);
}

TEST_CASE("a frame of zeros gives zeros, no contact and no outlier", "[contact_estimator]") {
  const Precision precision = GENERATE(Precision::float64, Precision::float32);
  ContactEstimator estimator(made_plan({.unknowns = 2, .precision = precision}));
  const Answer result = answer(estimator, std::vector<double>(estimator.readings(), 0.0));
  CHECK(result.tractions == std::vector<double>(estimator.tractions(), 0.0));
  CHECK(result.estimate.normal_force == 0.0);
  CHECK(result.estimate.tangential_force == 0.0);
  CHECK(result.estimate.friction_margin == 0.0);
  CHECK(result.estimate.residual_rms == 0.0);
  CHECK(std::isnan(result.estimate.centre));
  CHECK(std::isnan(result.estimate.angle));
  CHECK_FALSE(result.estimate.contact);
  CHECK_FALSE(result.estimate.saturated);
  CHECK(result.estimate.outlier == -1);
}
