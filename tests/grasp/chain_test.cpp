// From readings to torques: the covariance on the way, against draws of noise.
#include <Eigen/Dense>
#include <cmath>

#include "tactile_net/grasp/measured_grasp.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/resultant.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"
#include "tests/grasp/hands.hpp"

using namespace tactile_net;

namespace {

const SensorArray array{
    .count = 21, .pitch = 0.5, .depths = {1.0}, .reads = {Quantity::stress_x, Quantity::shear_xy}};
const Material pad_material{.youngs_modulus = 1.0, .poisson_ratio = 0.45};

std::vector<Contact> dragged() {
  return {RigidContact{.center = 0.7, .half_width = 1.5, .force = 2.0, .friction = 0.4}};
}

Finger finger() {
  Finger result;
  result.links = {8.0, 6.0};
  result.angles = {0.4, 1.1};
  result.pad = {.center = 3.0, .height = 1.0, .half_width = 5.25};
  return result;
}

}  // namespace

TEST_CASE("a traction field's resultant has its force, and no moment about its centre", "[grasp]") {
  const TractionField field = sample(dragged(), array);
  const Resultant sum = resultant_of(field.normal, field.tangential, array.pitch);
  CHECK_THAT(sum.normal, WithinRel(2.0, 0.03));
  CHECK_THAT(sum.tangential, WithinRel(0.4 * sum.normal, 1e-14));
  CHECK_THAT(*sum.centre(), WithinAbs(0.7, 0.02));
  CHECK_THAT(*sum.angle(), WithinRel(std::atan(0.4), 1e-14));
  double about_centre = 0.0;
  for (std::size_t i = 0; i < array.count; ++i)
    about_centre += array.pitch * (position(array, i) - *sum.centre()) * field.normal[i];
  CHECK_THAT(about_centre, WithinAbs(0.0, 1e-14));
  CHECK(resultant_of(field.normal, {}, array.pitch).tangential == 0.0);
  const std::vector<double> pulled = {-1.0, 0.0, 0.5};
  CHECK_FALSE(resultant_of(pulled, {}, 1.0).centre().has_value());
  CHECK_FALSE(resultant_of(pulled, {}, 1.0).angle().has_value());
  CHECK(resultant_of(pulled, {}, 1.0).moment == 1.5);
}

TEST_CASE("noise of the readings reaches the torques as the covariance says", "[grasp][property]") {
  const LinearProblem problem =
      make_problem(array, pad_material, {.unknowns = 2, .smoothing_length = 1.0});
  constexpr double alpha = 1e-3;
  constexpr double noise = 2e-3;
  const Reconstruction inverse = tikhonov(problem, alpha);
  const std::vector<double> exact = sampled_readings(array, pad_material, sample(dragged(), array));
  // A prior without size: what is smoothed away is not drawn here.
  const TractionCovariance covariance(TikhonovFamily(problem), alpha, 1e200);
  std::vector<double> f(2 * array.count);
  const auto measured = [&](const std::vector<double>& readings) {
    REQUIRE(inverse.solve(readings, f) == FrameStatus::ok);
    const UncertainResultant resultant = resultant_of(problem, f, covariance, noise);
    const std::vector<FingertipForce> force = {fingertip_force(resultant, 1.0)};
    return measured_grasp(std::vector{finger()}, force);
  };
  const MeasuredGrasp mean = measured(exact);
  const UncertainResultant predicted = resultant_of(problem, f, covariance, noise);
  for (std::size_t i = 0; i < 3; ++i) {
    const Uncertain value = i == 0   ? predicted.normal
                            : i == 1 ? *predicted.tangential
                                     : *predicted.centre;
    CHECK_THAT(std::sqrt(predicted.covariance[4 * i]), WithinRel(value.deviation, 1e-12));
  }

  constexpr int draws = 4000;
  Eigen::MatrixXd samples(draws, 5);  // F_v, F_t, centre, both torques
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<double> readings = exact;
    add_noise(readings, noise, 1000 + static_cast<std::uint64_t>(draw), 0);
    const MeasuredGrasp grasp = measured(readings);
    const Resultant sum = resultant_of(std::span(f).first(array.count),
                                       std::span(f).subspan(array.count), array.pitch);
    samples.row(draw) << sum.normal, sum.tangential, *sum.centre(),
        grasp.fingers[0].torques[0].value, grasp.fingers[0].torques[1].value;
  }
  const Eigen::MatrixXd centred = samples.rowwise() - samples.colwise().mean();
  const Eigen::MatrixXd found = centred.transpose() * centred / (draws - 1);
  const auto check = [&](double c, double variance_a, double variance_b, Eigen::Index i,
                         Eigen::Index j) {
    CAPTURE(i, j);
    // A sample covariance's own deviation, five times.
    const double spread = std::sqrt((variance_a * variance_b + c * c) / draws);
    CHECK_THAT(found(i, j), WithinAbs(c, 5.0 * spread));
  };
  const auto& c = predicted.covariance;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      check(c[3 * i + j], c[4 * i], c[4 * j], static_cast<Eigen::Index>(i),
            static_cast<Eigen::Index>(j));
  const Matrix& t = mean.torque_covariance;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      check(t(i, j), t(i, i), t(j, j), static_cast<Eigen::Index>(3 + i),
            static_cast<Eigen::Index>(3 + j));
  // The joints share one contact: without their covariance the two would seem independent.
  CHECK(std::abs(t(0, 1)) > 0.15 * std::sqrt(t(0, 0) * t(1, 1)));
}

TEST_CASE("forces per length become forces by the pad's breadth", "[grasp]") {
  UncertainResultant resultant;
  resultant.normal = {3.0, 0.1};
  resultant.tangential = Uncertain{1.0, 0.2};
  resultant.centre = Uncertain{0.5, 0.3};
  resultant.covariance = {0.01, 0.002, 0.003, 0.002, 0.04, 0.005, 0.003, 0.005, 0.09};
  const FingertipForce force = fingertip_force(resultant, 0.1);
  CHECK_THAT(force.normal, WithinRel(0.3, 1e-15));
  CHECK_THAT(force.tangential, WithinRel(0.1, 1e-15));
  CHECK(force.centre == 0.5);
  using enum ContactValue;
  CHECK_THAT(force.covariance(normal, normal), WithinRel(1e-4, 1e-14));
  CHECK_THAT(force.covariance(normal, tangential), WithinRel(2e-5, 1e-14));
  CHECK_THAT(force.covariance(tangential, centre), WithinRel(5e-4, 1e-14));
  CHECK_THAT(force.covariance.deviation(tangential), WithinRel(0.02, 1e-14));
  CHECK(force.covariance(centre, centre) == 0.09);
}
