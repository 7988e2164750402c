#include "tactile_net/inverse/thesis/dft_friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/sensing/effects/noise.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

const Material incompressible{1.0, 0.5};

SensorArray array_reading(std::size_t count, Quantity quantity) {
  return {count, 0.5, {1.5}, {quantity}};
}

/// A parabola over `width` taxels around `centre`, and the constant drag of Coulomb's law.
TractionField sliding(std::size_t count, std::size_t width, double friction,
                      std::ptrdiff_t shift = 0) {
  TractionField field{std::vector<double>(count), std::vector<double>(count)};
  const std::size_t first = (count - width) / 2;
  double force = 0.0;
  for (std::size_t i = 0; i < width; ++i) {
    const double t = (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(width) - 1.0;
    const auto at = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(first + i) + shift);
    field.normal[at] = 1.0 - t * t;
    force += field.normal[at];
  }
  for (std::size_t i = 0; i < width; ++i)
    field.tangential[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(first + i) + shift)] =
        friction * force / static_cast<double>(width);
  return field;
}

}  // namespace

TEST_CASE("one sliding contact in the middle is found, its width too", "[dft_friction]") {
  const double friction = GENERATE(0.5, -0.3, 0.05, 0.0);
  const std::size_t count = GENERATE(as<std::size_t>{}, 121, 120);
  const std::size_t width = GENERATE(as<std::size_t>{}, 5, 11) + (count % 2 == 0 ? 1 : 0);
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    const SensorArray array = array_reading(count, quantity);
    const TractionField truth = sliding(count, width, friction);
    DftFriction inverse(array, incompressible, friction);
    const FrictionSolution solution = inverse.solve(sampled_readings(array, incompressible, truth));
    CAPTURE(friction, count, width, name(quantity));
    // A strain's readings are still 1e-3 of the peak at the ends: dft's own verdict says cut off.
    CHECK((solution.verdict == FrictionVerdict::ok || solution.dft == DftVerdict::cut_off));
    if (friction != 0.0) CHECK(solution.width == width);
    // What is left is the truncation of the readings, as in the approach without friction.
    CHECK(relative_l2_error(solution.normal, truth.normal) < 2e-2);
    if (friction != 0.0) CHECK(relative_l2_error(solution.tangential, truth.tangential) < 1e-2);
  }
}

TEST_CASE("one per cent of noise does not lose the contact", "[dft_friction]") {
  const SensorArray array = array_reading(121, Quantity::stress_x);
  const TractionField truth = sliding(121, 9, 0.4);
  std::vector<double> g = sampled_readings(array, incompressible, truth);
  double peak = 0.0;
  for (const double value : g) peak = std::max(peak, std::abs(value));
  DftFriction inverse(array, incompressible, 0.4);
  for (std::size_t frame = 0; frame < 10; ++frame) {
    std::vector<double> noisy = g;
    add_noise(noisy, 0.01 * peak, 3, frame);
    const FrictionSolution solution = inverse.solve(noisy);
    CHECK(solution.width >= 5);
    CHECK(solution.width <= 13);
    double drag = 0.0;
    double right = 0.0;
    for (std::size_t i = 0; i < 121; ++i) {
      drag += solution.tangential[i];
      right += truth.tangential[i];
    }
    CHECK_THAT(drag, WithinRel(right, 0.2));
  }
}

TEST_CASE("noise alone does not contradict a contact", "[dft_friction]") {
  const SensorArray array = array_reading(121, Quantity::stress_x);
  const double friction = GENERATE(0.5, -0.3);
  const std::vector<double> g = sampled_readings(array, incompressible, sliding(121, 9, friction));
  const double peak = *std::max_element(g.begin(), g.end());
  DftFriction inverse(array, incompressible, friction);
  // A thousandth lets the drag be seen to a tenth, a twentieth does not.
  for (const auto& [noise, verdict] :
       {std::pair(0.001, FrictionVerdict::ok), std::pair(0.05, FrictionVerdict::drag_in_noise)}) {
    std::size_t right = 0;
    for (std::size_t frame = 0; frame < 100; ++frame) {
      std::vector<double> noisy = g;
      add_noise(noisy, noise * peak, 7, frame);
      const FrictionSolution solution = inverse.solve(noisy);
      // Noise at the ends is what dft's own verdict calls cut off.
      right += solution.verdict == verdict ||
               (verdict == FrictionVerdict::ok && solution.verdict == FrictionVerdict::dft);
    }
    CAPTURE(friction, noise);
    CHECK(right >= 95);
  }
}

TEST_CASE("what is not one contact in the middle gets its verdict", "[dft_friction]") {
  const SensorArray array = array_reading(121, Quantity::stress_x);
  DftFriction inverse(array, incompressible, 0.4);
  const auto verdict = [&](const TractionField& field) {
    return inverse.solve(sampled_readings(array, incompressible, field)).verdict;
  };
  CHECK(verdict(sliding(121, 9, 0.4, 6)) == FrictionVerdict::not_one_contact);
  CHECK(verdict(sliding(121, 9, 0.4, 1)) == FrictionVerdict::not_one_contact);
  CHECK(verdict(sliding(121, 9, -0.4)) == FrictionVerdict::not_one_contact);
  CHECK(verdict(sliding(121, 9, 0.2)) == FrictionVerdict::not_one_contact);
  for (const std::ptrdiff_t shift : {7, 9, 12, 20}) {
    TractionField two = sliding(121, 9, 0.4, shift);
    const TractionField other = sliding(121, 9, 0.4, -shift);
    for (std::size_t i = 0; i < 121; ++i) {
      two.normal[i] += other.normal[i];
      two.tangential[i] += other.tangential[i];
    }
    CAPTURE(shift);
    CHECK(verdict(two) == FrictionVerdict::not_one_contact);
  }
  // The smallest drag of the wrong sign, and a drag where none is assumed.
  DftFriction slight(array, incompressible, 0.05);
  CHECK(slight.solve(sampled_readings(array, incompressible, sliding(121, 9, -0.05))).verdict ==
        FrictionVerdict::not_one_contact);
  DftFriction without(array, incompressible, 0.0);
  CHECK(without.solve(sampled_readings(array, incompressible, sliding(121, 9, 0.4))).verdict !=
        FrictionVerdict::ok);
  CHECK(inverse.solve(std::vector<double>(121)).verdict == FrictionVerdict::no_contact);
  CHECK(inverse.solve(std::vector<double>(120)).status == FrameStatus::wrong_size);
  CHECK_THROWS_AS(DftFriction(array, incompressible, std::nan("")), std::invalid_argument);
}
