// Chapters 2 to 4: figures and examples, from the library's functions.
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>

#include "docs/figures/thesis/chapter.hpp"
#include "tactile_net/elasticity/half_plane.hpp"
#include "tactile_net/inverse/line_problem.hpp"
#include "tactile_net/inverse/reconstruction.hpp"
#include "tactile_net/inverse/thesis/closed_form.hpp"
#include "tactile_net/inverse/thesis/dft.hpp"
#include "tactile_net/inverse/thesis/dft_friction.hpp"
#include "tactile_net/numeric/comparison.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/sensing/sampled.hpp"
#include "tactile_net/sensing/traction_field.hpp"

namespace tactile_net::thesis {
namespace {

using drawing::Curve;
using drawing::Plot;

constexpr double depth = 1.5;
const Material rubber{1.0, 0.5};

SensorArray array_of(std::size_t count, double pitch, std::vector<Quantity> reads) {
  return {count, pitch, {depth}, std::move(reads)};
}

std::vector<double> dft_of(const SensorArray& array, const std::vector<double>& g) {
  DftInverse inverse(array, rubber);
  std::vector<double> f(array.count);
  (void)inverse.solve(g, f);
  return f;
}

/// So that rounding, which differs from machine to machine, does not change the page.
double power_of_ten_above(double number) { return std::pow(10.0, std::ceil(std::log10(number))); }

}  // namespace

std::string three(double number) { return brief(number); }

Chapter kernels() {
  using enum Quantity;
  Chapter chapter;
  const auto places = positions(array_of(161, 0.1, {stress_x}));
  const auto plot = [&](const std::string& title, std::vector<Quantity> all, Traction load,
                        const Material& material) {
    drawing::Plot result{title, "y", "kernel", places, {}};
    for (const Quantity quantity : all) {
      drawing::Curve curve{std::string(name(quantity)), {}, result.curves.size() + 1};
      for (const double y : places)
        curve.y.push_back(half_plane_kernel(quantity, load, material, depth, y));
      result.curves.push_back(std::move(curve));
    }
    chapter.plots.push_back(std::move(result));
  };
  plot("Stress under a normal line load, x = 1.5", {stress_x, stress_y, shear_xy}, Traction::normal,
       rubber);
  plot("Stress under a tangential line load, x = 1.5", {stress_x, stress_y, shear_xy},
       Traction::tangential_y, rubber);
  plot("Strain under a normal line load, x = 1.5, nu = 0.5", {strain_x, strain_y}, Traction::normal,
       rubber);
  plot("Strain under a tangential line load, x = 1.5, nu = 0.5", {strain_x, strain_y},
       Traction::tangential_y, rubber);

  // The transforms, and the DFT of 121 samples at the same wavenumbers.
  const SensorArray array = array_of(121, 0.5, {stress_x});
  drawing::Plot transforms{
      "Transforms of the normal kernels, and the DFT of 121 samples", "k", "transform", {}, {}};
  std::vector<drawing::Curve> curves;
  double largest_difference = 0.0;
  for (const Quantity quantity : {stress_x, strain_x}) {
    const std::vector<double> kernel =
        sampled_kernel({quantity, depth, ""}, Traction::normal, rubber, 121, 0.5);
    drawing::Curve exact{std::string(name(quantity)), {}, curves.size() + 1};
    drawing::Curve sampled{std::string(name(quantity)) + ", DFT", {}, curves.size() + 1, true};
    for (std::size_t j = 0; j <= 60; ++j) {
      const double k = 2.0 * 3.141592653589793 * static_cast<double>(j) / (121 * 0.5);
      if (quantity == stress_x) transforms.x.push_back(k);
      double sum = 0.0;
      for (int lag = -60; lag <= 60; ++lag)
        sum += kernel[static_cast<std::size_t>(lag + 120)] * std::cos(k * 0.5 * lag);
      sampled.y.push_back(sum);
      exact.y.push_back(half_plane_transform(quantity, Traction::normal, rubber, depth, k).real());
      largest_difference = std::max(largest_difference, std::abs(sum - exact.y.back()));
    }
    curves.push_back(std::move(exact));
    curves.push_back(std::move(sampled));
  }
  transforms.curves = std::move(curves);
  chapter.plots.push_back(std::move(transforms));
  chapter.names = {"kernels-stress-normal", "kernels-stress-tangential", "kernels-strain-normal",
                   "kernels-strain-tangential", "transforms"};
  chapter.text =
      "## Kernels and transforms (figures 2.2, 2.3, 3.1 to 3.4)\n\n{0}\n{1}\n{2}\n{3}\n\n"
      "A normal load's kernels of stress_x, stress_y and the strains are even in y, a tangential "
      "load's are odd; for shear_xy it is the other way round. At nu = 0.5 strain_y is "
      "-strain_x.\n\n{4}\n\nThe strain's transform vanishes at k = 0: a uniform load does not "
      "deform an incompressible half plane. The DFT of 121 samples differs from it by at most " +
      three(largest_difference) +
      ", all of it from cutting the kernel off, which is also why its value at k = 0 is not zero "
      "and the division works at all.\n\n";
  return chapter;
}

Chapter example_3_1() {
  Chapter chapter;
  std::array<double, 2> errors{};
  const std::array<double, 2> printed = {3.03e-7, 4.04e-5};
  std::size_t which = 0;
  const std::vector<Contact> contacts = {RigidContact{.half_width = 1.0, .force = 3.534}};
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    const SensorArray array = array_of(121, 0.5, {quantity});
    const TractionField truth = sample(contacts, array);
    const std::vector<double> g = sampled_readings(array, rubber, truth);
    const std::vector<double> f = dft_of(array, g);
    errors[which++] = mean_absolute_error(f, truth.normal);
    chapter.plots.push_back({"Example 3.1 from " + std::string(name(quantity)),
                             "y",
                             "",
                             positions(array),
                             {{"reconstructed", f, 1},
                              {"reading", g, 2},
                              {"designed traction", truth.normal, 0, true}}});
    chapter.names.push_back("example-3.1-" + std::string(name(quantity)));
  }
  chapter.text =
      "## Example 3.1: a cylinder without friction (figure 3.6)\n\n"
      "121 sensors, pitch 0.5, depth 1.5, E = 1, nu = 0.5; plain division of DFTs (3.8). The load "
      "is not stated. The ratio of the two printed errors, " +
      three(printed[1] / printed[0]) +
      ", is that of every load on exactly three samples and of no wider one; half width 1 with "
      "force 3.534 gives\n\n| read as | printed (3.17) | here |\n|---|---|---|\n| stress_x | " +
      three(printed[0]) + " | " + three(errors[0]) + " |\n| strain_x | " + three(printed[1]) +
      " | " + three(errors[1]) + " |\n\n{0}\n{1}\n\n";
  return chapter;
}

Chapter example_3_2() {
  // The load is not stated either: a punch of half width 2 over nine samples, and constant drag.
  Chapter chapter;
  const double friction = 0.5;
  std::string rows;
  const std::array<std::string, 2> printed = {"6.21e-? and 1.15e-? (the exponents cannot be read)",
                                              "2.95e-3 and 1.45e-3"};
  std::size_t which = 0;
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    const SensorArray array = array_of(121, 0.5, {quantity});
    const std::vector<Contact> contacts = {
        RigidContact{.shape = Shape::punch, .half_width = 2.0, .edge = 0.1}};
    TractionField truth = sample(contacts, array);
    double sum = 0.0;
    double width = 0.0;
    for (const double f : truth.normal) {
      sum += f;
      width += f > 0.0 ? 1.0 : 0.0;
    }
    for (const double f : truth.normal)
      truth.tangential.push_back(f > 0.0 ? friction * sum / width : 0.0);
    DftFriction inverse(array, rubber, friction);
    const FrictionSolution solution = inverse.solve(sampled_readings(array, rubber, truth));
    rows += "| " + std::string(name(quantity)) + " | " + printed[which++] + " | " +
            three(mean_absolute_error(solution.normal, truth.normal)) + " and " +
            three(mean_absolute_error(solution.tangential, truth.tangential)) + " | " +
            std::to_string(solution.width) + " |\n";
    chapter.plots.push_back({"Example 3.2 from " + std::string(name(quantity)),
                             "y",
                             "traction",
                             positions(array),
                             {{"normal, reconstructed", solution.normal, 1},
                              {"tangential, reconstructed", solution.tangential, 2},
                              {"normal, designed", truth.normal, 0, true},
                              {"tangential, designed", truth.tangential, 3, true}}});
    chapter.names.push_back("example-3.2-" + std::string(name(quantity)));
  }
  chapter.text =
      "## Example 3.2: a rectangle with constant friction (figure 3.7)\n\n"
      "mu = 0.5 is known, f_t is taken for constant over the contact, whose width is found from "
      "the readings. Load, mu and width are not stated in the thesis; here a punch over nine "
      "samples.\n\n| read as | printed, normal and tangential | here | taxels in contact found "
      "|\n|---|---|---|---|\n" +
      rows +
      "\nA strain is cut off more by the array's ends than a stress, as the thesis says: hence "
      "the larger errors.\n\n{0}\n{1}\n\n";
  return chapter;
}

Chapter forty_one_sensors() {
  Chapter chapter;
  std::string rows;
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0}};
  for (const Quantity quantity : {Quantity::stress_x, Quantity::strain_x}) {
    std::array<double, 2> errors{};
    std::size_t which = 0;
    for (const std::size_t count : {std::size_t{121}, std::size_t{41}}) {
      const SensorArray array = array_of(count, 0.5, {quantity});
      const TractionField truth = sample(contacts, array);
      const std::vector<double> f = dft_of(array, sampled_readings(array, rubber, truth));
      errors[which++] = mean_absolute_error(f, truth.normal);
      if (count == 41) {
        chapter.plots.push_back({"41 sensors, from " + std::string(name(quantity)),
                                 "y",
                                 "traction",
                                 positions(array),
                                 {{"reconstructed", f, 1}, {"designed", truth.normal, 0, true}}});
        chapter.names.push_back("figure-3.8-" + std::string(name(quantity)));
      }
    }
    rows += "| " + std::string(name(quantity)) + " | " + three(errors[0]) + " | " +
            three(errors[1]) + " |\n";
  }
  chapter.text =
      "## Forty-one sensors (figure 3.8)\n\nThe thesis shows, without numbers, that truncation "
      "spoils the strain first. A cylinder of half width 2, mean errors:\n\n| read as | 121 "
      "sensors | 41 sensors |\n|---|---|---|\n" +
      rows + "\n{0}\n{1}\n\n";
  return chapter;
}

namespace {

/// One reconstruction by the closed form and by tikhonov, for each alpha.
Chapter chapter_four(const std::string& example, const std::vector<Quantity>& reads,
                     const std::array<double, 2>& alphas, double friction) {
  Chapter chapter;
  const Material material{1.0, 0.45};
  const std::size_t unknowns = reads.size();
  const SensorArray array = array_of(81, 0.25, reads);
  const std::vector<Contact> contacts = {RigidContact{.half_width = 2.0, .friction = friction}};
  const TractionField truth = sample(contacts, array);
  const std::vector<double> g = sampled_readings(array, material, truth);
  const LinearProblem problem =
      make_problem(array, material, {.unknowns = unknowns, .smoothing_length = 1.0});
  drawing::Plot plot{"Example " + example, "y", "traction", positions(array), {}};
  std::string rows;
  for (const double alpha : alphas) {
    std::vector<double> f(unknowns * 81);
    std::vector<double> other(f.size());
    (void)closed_form(problem, alpha).solve(g, f);
    (void)tikhonov(problem, alpha).solve(g, other);
    const auto part = [&](std::size_t u) { return std::span(f).subspan(u * 81, 81); };
    rows += "| " + three(alpha) + " | " + three(mean_absolute_error(part(0), truth.normal));
    const std::size_t colour = plot.curves.size() / unknowns + 1;
    plot.curves.push_back(
        {"normal, alpha " + three(alpha), {part(0).begin(), part(0).end()}, colour});
    if (unknowns == 2) {
      rows += " | " + three(mean_absolute_error(part(1), truth.tangential));
      plot.curves.push_back(
          {"tangential, alpha " + three(alpha), {part(1).begin(), part(1).end()}, colour});
    }
    rows += " | " + three(power_of_ten_above(relative_l2_error(f, other))) + " |\n";
  }
  plot.curves.push_back({"normal, designed", truth.normal, 0, true});
  if (unknowns == 2) plot.curves.push_back({"tangential, designed", truth.tangential, 3, true});
  chapter.plots = {plot};
  chapter.names = {"example-" + example};
  chapter.text = rows;
  return chapter;
}

}  // namespace

Chapter example_4_1() {
  Chapter chapter = chapter_four("4.1", {Quantity::strain_x}, {1e-3, 1e-4}, 0.0);
  chapter.text =
      "## Example 4.1: a cylinder without friction (figure 4.1)\n\n"
      "81 sensors, depth 1.5, nu = 0.45, E = 1, smoothing length 1; the load is not stated: half "
      "width 2, force 1, pitch 0.25. The corrected closed form (4.14, 4.15); no number is "
      "printed.\n\n| alpha | mean error | differs from `tikhonov` by less than |\n|---|---|---|\n" +
      chapter.text + "\n{0}\n\n";
  return chapter;
}

Chapter example_4_2() {
  Chapter chapter =
      chapter_four("4.2", {Quantity::strain_x, Quantity::strain_y}, {1e-5, 1e-4}, 0.5);
  chapter.text =
      "## Example 4.2: a cylinder with friction (figure 4.2)\n\n"
      "Both tractions from two strains, f_t = 0.5 f_v, the corrected (4.26, 4.27); the rest as in "
      "4.1.\n\n| alpha | mean error, normal | tangential | differs from `tikhonov` by less than "
      "|\n|---|---|---|---|\n" +
      chapter.text +
      "\n{0}\n\nWithout alpha this system is exactly singular on an odd number of sensors "
      "(`tactile-net identify scenes/two-strains.toml` says why): alpha decides what the readings "
      "do not. The thesis' remark that two depths serve at nu = 0.5 is right, but for the mean "
      "tangential traction, which shows only where it stops.\n\n";
  return chapter;
}

}  // namespace tactile_net::thesis
