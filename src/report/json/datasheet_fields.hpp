/// @file
/// Private. What JSON tells of a datasheet.
#pragma once

#include "report/json/network_values.hpp"
#include "tactile_net/lab/datasheet.hpp"
#include "tactile_net/report/words/datasheet_words.hpp"

namespace tactile_net {

template <>
struct Enumerators<lab::DatasheetFigure::Kind> {
  using Kind = lab::DatasheetFigure::Kind;
  static constexpr Enumerator<Kind> all[] = {
      {Kind::error, "error", "Of the answer at rest, relative."},
      {Kind::offset, "offset", "Of the answer without readings, over the answer with them."},
      {Kind::settling, "settling", "From a step of all readings to its end, seconds."},
      {Kind::noise, "noise", "Root mean square of all outputs over the answer."},
      {Kind::supply_current, "supply_current", "What the op-amps take and give, ampere."}};
};

template <>
struct Enumerators<lab::DatasheetFigure::Verdict> {
  using Verdict = lab::DatasheetFigure::Verdict;
  static constexpr Enumerator<Verdict> all[] = {
      {Verdict::no_limit, "no_limit", "The scene states no limit of it."},
      {Verdict::passes, "pass", "95 of 100 of all builds are within the limit."},
      {Verdict::fails, "fail", "They are not."},
      {Verdict::open, "open", "The draws are too few to say."}};
};

template <>
struct Fields<lab::DatasheetFigure> {
  using One = lab::DatasheetFigure;
  static constexpr auto all = std::tuple{
      field("figure", &One::kind, "Which figure it is."),
      field(
          "unit", [](const One& one) { return report::unit_of(one.kind); },
          "Of its values, limit too: s, A, or 1 of what is relative."),
      field("builds", &One::builds, "How many builds were drawn, with which nothing was chosen."),
      field(
          "min", [](const One& one) { return if_finite(one.least); },
          "The least of them; null: unstable, as all below."),
      field(
          "typ", [](const One& one) { return if_finite(one.typical); }, "Their median."),
      field(
          "max", [](const One& one) { return if_finite(one.p95_most); },
          "95 of 100 of all builds are within it, with a confidence of 97.5 %."),
      field(
          "p95", [](const One& one) { return if_finite(one.p95); },
          "What 95 of 100 of the builds that were drawn are within."),
      field(
          "p95_least", [](const One& one) { return if_finite(one.p95_least); },
          "With `max`, what 95 of 100 of all builds are within lies between (Clopper and Pearson, "
          "95 %)."),
      field("limit", &One::limit, "The scene's limit; null: it states none."),
      field("verdict", &One::verdict, "What the figure and its limit come to.")};
};

template <>
struct Fields<lab::Datasheet> {
  using One = lab::Datasheet;
  static constexpr auto all = std::tuple{
      field("realization", &One::realization, "How the network is built."),
      field("opamps", &One::opamps, "How many op-amps it takes."),
      field("opamp_part", &One::opamp_part, "The op-amps' part; empty: the scene names none."),
      field("ordered", &One::ordered,
            "Whether it is of the parts to order, not of the scene's own circuit."),
      field("on_board", &One::on_board,
            "Whether the circuit has the capacitances of its board's copper."),
      field("loads", &One::loads, "At how many places the contacts were tried."),
      field("settling_accuracy", &One::settling_accuracy,
            "Settled means: within this of the end, relative."),
      field("unstable", &One::unstable, "How many of the builds over time are unstable."),
      field("passes", &One::passes, "Whether no limit is missed."),
      field("figures", &One::figures, "The figures, each with its limit and its verdict."),
      field(
          "conditions", [](const One& one) { return report::in_words(one); },
          "What they hold for, and what is not told, a sentence each.")};
};

}  // namespace tactile_net
