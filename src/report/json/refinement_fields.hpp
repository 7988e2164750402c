/// @file
/// Private. What JSON tells of a refinement.
#pragma once

#include "report/json/network_values.hpp"
#include "report/json/self_test_fields.hpp"
#include "tactile_net/lab/circuit_refinement.hpp"
#include "tactile_net/report/words/refinement_words.hpp"

namespace tactile_net {

template <>
struct Enumerators<lab::CircuitRefinement::Way::Kind> {
  using Kind = lab::CircuitRefinement::Way::Kind;
  static constexpr Enumerator<Kind> all[] = {
      {Kind::alone, "alone", "The circuit with the parts that it has."},
      {Kind::better_parts, "better_parts", "All its resistors of a better class, to first order."},
      {Kind::refined, "refined", "Refined in numbers."},
      {Kind::numbers, "numbers", "No circuit: f = M g."}};
};

template <>
struct Fields<RefinementBound> {
  using One = RefinementBound;
  static constexpr auto all = std::tuple{
      field("condition", &One::condition, "The condition number of P."),
      field("z", &One::z, "What relative errors of K count; 0: the circuit has no arrays of K."),
      field("rho", &One::rho,
            "The same of the stabiliser, or of P where there are no arrays of K."),
      field("fixed", &One::fixed,
            "|X| of what every build has: values of a series, steps of cells, the op-amps' gain."),
      field("kernel", &One::kernel, "The share of K and K' in `parts`."),
      field("stabiliser", &One::stabiliser, "That of the stabiliser, or of P."),
      field("common", &One::common,
            "That of the voltages that both inputs of a lattice's amplifiers have."),
      field("parts", &One::parts, "|X| of no build is above it: t of theorem T9."),
      field("parts_of_most", &One::parts_of_most,
            "|X| of at most one build in a million is above it."),
      field("to_circuit", &One::to_circuit, "The share of the converters to the circuit."),
      field("from_circuit", &One::from_circuit,
            "That of those from it, with its offset and its noise."),
      field("contraction", &One::contraction,
            "What a cycle leaves of the error's energy at most, relative; 1: nothing is proven."),
      field("contraction_of_most", &One::contraction_of_most,
            "The same of all builds but one in a million.")};
};

template <>
struct Fields<RefinementTrials::Cycle> {
  using One = RefinementTrials::Cycle;
  static constexpr auto all = std::tuple{
      field(
          "median_error", [](const One& one) { return if_finite(one.median); },
          "The median of |f - f*|_2 / |f*|_2 after this cycle; null: that build is unstable, as "
          "all below."),
      field(
          "p95_error", [](const One& one) { return if_finite(one.p95); },
          "What 95 of 100 builds are within."),
      field(
          "worst_error", [](const One& one) { return if_finite(one.worst); }, "The largest."),
      field(
          "adverse_error", [](const One& one) { return if_finite(one.adverse); },
          "That of the build whose errors conspire.")};
};

template <>
struct Fields<RefinementTrials> {
  using One = RefinementTrials;
  static constexpr auto all = std::tuple{
      field("builds", &One::builds, "How many builds were drawn: the boards of `tolerance`."),
      field("stable", &One::stable, "How many of them are stable."),
      field("median_deviation", &One::median_deviation, "The median of their |X|."),
      field("worst_deviation", &One::worst_deviation, "The largest."),
      field("adverse_deviation", &One::adverse_deviation,
            "|X| of a build whose errors conspire, found by ascent."),
      field("cycles", &One::cycles, "Errors after each cycle, the circuit's own answer first."),
      field("median_cycles", &One::median_cycles,
            "After how many cycles the median build has the accuracy; null: not within these."),
      field("p95_cycles", &One::p95_cycles, "The same of 95 of 100 builds."),
      field("self_test", &One::self_test,
            "The first step of refinement as a test of the board by itself."),
      field("single_floor", &One::single_floor,
            "Where the error ends with residuals in single precision."),
      field("double_floor", &One::double_floor, "The same in double precision."),
      field("cycle_products", &One::cycle_products,
            "Multiplications of a cycle, but for the first, which has none."),
      field("frame_products", &One::frame_products, "Those of the whole answer in numbers.")};
};

template <>
struct Fields<lab::CircuitRefinement::Way> {
  using One = lab::CircuitRefinement::Way;
  static constexpr auto all = std::tuple{
      field("way", &One::kind, "How the answer is made."),
      field("tolerance", &One::tolerance,
            "Of all its resistors; 0: it has none, or they are not of one class."),
      field(
          "error", [](const One& one) { return if_finite(one.error); },
          "What 95 of 100 builds are within, relative; null: unstable."),
      field("price", &One::price, "Of resistors, op-amps and converters; null: not known."),
      field("seconds", &One::seconds, Measure::time,
            "Until the answer, without arithmetic; null: not known."),
      field("products", &One::products, "Multiplications until the answer."),
      field("cycles", &One::cycles, "How many cycles; 0: it is not refined.")};
};

/// How it is refined.
template <typename One>
constexpr auto refinement_options_fields = std::tuple{
    field(
        "accuracy", [](const One& one) { return one.options.accuracy; },
        "The relative error to come to."),
    field(
        "step", [](const One& one) { return one.options.step; },
        "How far a cycle goes along the circuit's answer."),
    field(
        "bits",
        [](const One& one) { return static_cast<std::size_t>(one.options.converters->bits); },
        "Of the converters."),
    field(
        "gain", [](const One& one) { return one.options.converters->gain; },
        "How far the gain of each channel is off, within +-."),
    field(
        "noise", [](const One& one) { return one.options.converters->noise; },
        "Of the circuit's answer, standard deviation over the range."),
    field(
        "conversion_seconds", [](const One& one) { return one.options.converters->conversion; },
        Measure::time, "How long a conversion takes.")};

template <>
struct Fields<lab::CircuitRefinement> {
  using One = lab::CircuitRefinement;
  static constexpr auto all = std::tuple_cat(
      std::tuple{field("verdict", &One::verdict, "What is proven."),
                 field("proven_cycles", &One::proven_cycles,
                       "After how many cycles every build that the verdict speaks of has the "
                       "accuracy; null: "
                       "refused."),
                 field(
                     "text", [](const One& one) { return report::verdict_in_words(one); },
                     "The same in a sentence.")},
      refinement_options_fields<One>,
      std::tuple{
          field("bound", &One::bound, "What tolerances alone say of X = P^-1/2 (P^ - P) P^-1/2."),
          field("trials", &One::trials, "What builds do."),
          field("ways", &One::ways, "Whether it pays: the ways to an answer beside each other.")});
};

template <>
struct Fields<lab::SimulatedRefinement::Cycle> {
  using One = lab::SimulatedRefinement::Cycle;
  static constexpr auto all = std::tuple{
      field("simulated_error", &One::simulated,
            "|f - f*|_2 / |f*|_2 after this cycle, the circuit's answers by ngspice."),
      field("error", &One::numbers, "The same in numbers alone."),
      field("difference", &One::difference,
            "How far ngspice's answer is from the numbers' to the same currents, relative: what "
            "the build's equations leave out.")};
};

template <>
struct Fields<lab::SimulatedRefinement> {
  using One = lab::SimulatedRefinement;
  static constexpr auto all = std::tuple_cat(
      std::tuple{
          field(
              "agrees", [](const One& one) { return one.agrees(); },
              "Whether the errors after every cycle are within three times of each other."),
          field(
              "text", [](const One& one) { return report::in_words(one); }, "In sentences."),
          field("cycles", &One::cycles, "Errors after each cycle; empty: the build is not stable."),
          field("ngspice_seconds", &One::simulator_seconds, Measure::time,
                "How long ngspice took.")},
      refinement_options_fields<One>);
};

}  // namespace tactile_net
