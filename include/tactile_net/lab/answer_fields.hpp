/// @file
/// What an answer tells, number by number, of a line and of a skin: each key once, with a sentence
/// (numeric/fields.hpp). JSON and its schema are made from it.
///
///     lab::AnswerTold told = lab::answer_told(answer, grid.count(), {});
///     for_each_field<lab::AnswerTold>([&](const auto& one) { say(one.key, one.text); });
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tactile_net/lab/answer.hpp"
#include "tactile_net/lab/contact_tracker.hpp"
#include "tactile_net/numeric/fields.hpp"
#include "tactile_net/skin/load.hpp"

namespace tactile_net {

namespace lab {

/// A value for each component: of a line the normal and the tangential one, of a skin the normal
/// one and those along y and z.
template <class T>
struct ByComponent {
  std::array<std::optional<T>, 3> all{};
};

/// Values of one component after another. @param places  values of a component, > 0
[[nodiscard]] inline ByComponent<std::vector<double>> by_component(
    const std::vector<double>& values, std::size_t places) {
  ByComponent<std::vector<double>> told;
  for (std::size_t c = 0; c < told.all.size(); ++c)
    if (const auto one = component(values, places, c); !one.empty())
      told.all[c].emplace(one.begin(), one.end());
  return told;
}

/// What all tractions amount to. Of a line the drag and the centre along y are the only ones.
struct ResultantTold : UncertainWrench {
  std::optional<Uncertain> angle{};
};

[[nodiscard]] inline ResultantTold resultant_told(const FrameAnswer& answer) {
  if (!answer.bands) return {answer.wrench};
  const UncertainResultant& whole = answer.bands->resultant;
  return {{.normal = whole.normal, .tangential_y = whole.tangential, .centre_y = whole.centre},
          whole.angle};
}

/// Of a curved skin's wrench; absent: it is flat.
[[nodiscard]] inline IfAny<std::array<Uncertain, 3>> in_space(
    const UncertainWrench& wrench, std::array<Uncertain, 3> SpaceWrench::*which) {
  if (!wrench.space) return {};
  return {(*wrench.space).*which};
}

/// How the search under constraints ended.
struct ConstraintsTold {
  double residual = 0.0;
  std::size_t iterations = 0;
  std::size_t free = 0;
  std::size_t apart = 0;
  std::size_t sliding = 0;
  std::size_t sticking = 0;

  static constexpr auto described = std::tuple{
      field("residual", &ConstraintsTold::residual,
            "What is left of the optimality conditions, relative."),
      field("iterations", &ConstraintsTold::iterations, "Iterations, of a line sets tried."),
      field("free", &ConstraintsTold::free, "Variables that are not held at zero.", Of::lines),
      field("apart", &ConstraintsTold::apart, "Cells that nothing touches.", Of::skins),
      field("sliding", &ConstraintsTold::sliding, "Cells that slide.", Of::skins),
      field("sticking", &ConstraintsTold::sticking, "Cells that touch and do not slide.",
            Of::skins)};
};

[[nodiscard]] inline std::optional<ConstraintsTold> constraints_told(const FrameAnswer& answer) {
  if (const auto& line = answer.constrained)
    return ConstraintsTold{
        .residual = line->kkt_residual, .iterations = line->iterations, .free = line->free.size()};
  if (const auto& cone = answer.cone)
    return ConstraintsTold{.residual = cone->residual,
                           .iterations = cone->iterations,
                           .apart = cone->separation,
                           .sliding = cone->slip,
                           .sticking = cone->stick};
  return std::nullopt;
}

/// An answer, with what its numbers need to be told.
struct AnswerTold {
  const FrameAnswer& answer;
  std::size_t places = 1;                     ///< tractions of a component
  std::optional<double> tangential_weight{};  ///< estimated or stated; absent: with one component
};

/// @param weight  that the scene states
[[nodiscard]] inline AnswerTold answer_told(const FrameAnswer& answer, std::size_t places,
                                            std::optional<double> weight) {
  AnswerTold told{.answer = answer, .places = places};
  if (answer.alpha.known() && answer.tractions.size() > places)
    told.tangential_weight =
        answer.alpha.tangential_weight ? answer.alpha.tangential_weight : weight;
  return told;
}

}  // namespace lab

template <class T>
struct Fields<lab::ByComponent<T>> {
  static constexpr Measure unit =
      std::is_same_v<T, std::vector<double>> ? Measure::stress : Measure::none;
  static constexpr auto all =
      std::tuple{field(
                     "normal", [](const auto& told) { return told.all[0]; }, unit,
                     "Along the depth; pressure is positive."),
                 field(
                     "tangential", [](const auto& told) { return told.all[1]; }, unit,
                     "Along the line; null: there is none.", Of::lines),
                 field(
                     "tangential_y", [](const auto& told) { return told.all[1]; }, unit,
                     "Along y; null: there is none.", Of::skins),
                 field(
                     "tangential_z", [](const auto& told) { return told.all[2]; }, unit,
                     "Along z; null: there is none.", Of::skins)};
};

template <>
struct Fields<UncertainWrench> {
  using W = UncertainWrench;
  static constexpr auto all = std::tuple{
      field("normal", &W::normal, Measure::load, "The normal force."),
      field("tangential", &W::tangential_y, Measure::load,
            "The tangential force; null: it was not solved for.", Of::lines),
      field("tangential_y", &W::tangential_y, Measure::load,
            "The tangential force along y; null: it was not solved for.", Of::skins),
      field("tangential_z", &W::tangential_z, Measure::load,
            "The tangential force along z; null: it was not solved for.", Of::skins),
      field("centre", &W::centre_y, Measure::length,
            "The centre of pressure; null: nothing presses.", Of::lines),
      field(
          "centre",
          [](const W& wrench) {
            return wrench.centre_y && wrench.centre_z
                       ? std::optional(std::array{*wrench.centre_y, *wrench.centre_z})
                       : std::nullopt;
          },
          Measure::length, "The centre of pressure, y and z; null: nothing presses.", Of::skins),
      field("torsion", &W::torsion, Measure::moment,
            "The moment about x through the centre of pressure, from y towards z.", Of::skins),
      field(
          "force", [](const W& wrench) { return lab::in_space(wrench, &SpaceWrench::force); },
          Measure::load,
          "Of a curved skin the force that acts on it, along the sensor's x, y and z; absent: it "
          "is flat.",
          Of::skins),
      field(
          "moment", [](const W& wrench) { return lab::in_space(wrench, &SpaceWrench::moment); },
          Measure::moment, "The moment of that force about the point that the scene names.",
          Of::skins),
      field(
          "centre_in_space",
          [](const W& wrench) {
            return IfAny<std::array<Uncertain, 3>>{wrench.space ? wrench.space->centre
                                                                : std::nullopt};
          },
          Measure::length,
          "The mean of the places of a curved skin that press, in the sensor's axes: it lies below "
          "a convex surface; absent: nothing presses.",
          Of::skins),
      field(
          "above",
          [](const W& wrench) {
            return IfAny<std::array<double, 3>>{wrench.space ? wrench.space->above : std::nullopt};
          },
          Measure::length, "The place of the surface above that.", Of::skins)};
};

template <>
struct Fields<lab::ResultantTold> {
  static constexpr auto all = std::tuple_cat(
      Fields<UncertainWrench>::all,
      std::tuple{field("angle", &lab::ResultantTold::angle, Measure::angle,
                       "The angle between the force and the normal; null: it was not solved for, "
                       "or nothing presses.",
                       Of::lines)});
};

/// Of the loads themselves, exact.
template <>
struct Fields<SkinWrench> {
  static constexpr auto all = std::tuple{
      field(
          "normal", [](const SkinWrench& wrench) { return wrench.force[0]; }, Measure::load,
          "The normal force."),
      field(
          "tangential_y", [](const SkinWrench& wrench) { return wrench.force[1]; }, Measure::load,
          "The tangential force along y."),
      field(
          "tangential_z", [](const SkinWrench& wrench) { return wrench.force[2]; }, Measure::load,
          "The tangential force along z."),
      field(
          "centre",
          [](const SkinWrench& wrench) -> std::optional<std::array<double, 2>> {
            const auto centre = wrench.centre();
            if (!centre) return std::nullopt;
            return std::array{centre->y, centre->z};
          },
          Measure::length, "The centre of pressure, y and z; null: nothing presses."),
      field(
          "torsion", [](const SkinWrench& wrench) { return wrench.torsion(); }, Measure::moment,
          "The moment about x through the centre of pressure, from y towards z.")};
};

/// Where the cells of a skin are.
template <>
struct Fields<SurfaceGrid> {
  static constexpr auto all =
      std::tuple{field(
                     "y",
                     [](const SurfaceGrid& grid) {
                       std::vector<double> y;
                       for (std::size_t row = 0; row < grid.rows; ++row) y.push_back(grid.y(row));
                       return y;
                     },
                     Measure::length, "Of the middle of each row's cells."),
                 field(
                     "z",
                     [](const SurfaceGrid& grid) {
                       std::vector<double> z;
                       for (std::size_t column = 0; column < grid.columns; ++column)
                         z.push_back(grid.z(column));
                       return z;
                     },
                     Measure::length, "Of the middle of each column's cells."),
                 field(
                     "spacing",
                     [](const SurfaceGrid& grid) {
                       return std::array{grid.spacing_y, grid.spacing_z};
                     },
                     Measure::length, "From cell to cell, along y and along z.")};
};

template <>
struct Fields<ContactEllipse> {
  static constexpr auto all =
      std::tuple{field("radius", &ContactEllipse::radius, Measure::length, "The longer radius."),
                 field("second_radius", &ContactEllipse::second_radius, Measure::length,
                       "The radius across it."),
                 field("angle", &ContactEllipse::angle, Measure::angle,
                       "Of the longer radius, from y towards z.")};
};

/// Of a contact by itself, wherever it is told.
inline constexpr auto contact_fields = std::tuple_cat(
    within(&ContactPatch::wrench, Fields<UncertainWrench>::all),
    std::tuple{
        field("friction", &ContactPatch::friction,
              "Drag over force: the least friction that holds it; null: nothing drags."),
        field("slip_margin", &ContactPatch::slip_margin,
              "The share of the friction limit that drag and torsion leave; below 0 it slips; "
              "null: no limit is stated."),
        field("length", &ContactPatch::extent, Measure::length,
              "Over which the same force would press with the same sum of squares if it were even.",
              Of::lines),
        field("area", &ContactPatch::extent, Measure::area,
              "Over which the same force would press with the same sum of squares if it were even.",
              Of::skins),
        field("ellipse", &ContactPatch::ellipse,
              "By the second moments of its pressure and Hertz' law; null: they are no ellipse's.",
              Of::skins)});

template <>
struct Fields<ContactPatch> {
  static constexpr auto all = std::tuple_cat(
      std::tuple{field("cells", &ContactPatch::cells,
                       "Places or cells that it touches, from 0; a cell is row * columns + "
                       "column.")},
      contact_fields);
};

template <>
struct Fields<lab::FollowedContact> {
  static constexpr auto all = std::tuple_cat(
      std::tuple{field("id", &lab::FollowedContact::id,
                       "Stays with a contact over the frames, from 1; none is used twice.")},
      within(&lab::FollowedContact::patch, contact_fields));
};

template <>
struct Fields<SkinFriction> {
  static constexpr auto all = std::tuple{
      field("ratio", &SkinFriction::ratio, "Drag over force."),
      field("least_limit", &SkinFriction::least_limit,
            "The least friction that explains the cells that bear 90 % of the force."),
      field("contacts", &SkinFriction::contacts,
            "Contacts that lie apart; the rest is of the one nearest to slipping."),
      field(
          "centre",
          [](const SkinFriction& friction) -> std::optional<std::array<Uncertain, 2>> {
            const auto& wrench = friction.wrench;
            if (!wrench || !wrench->centre_y || !wrench->centre_z) return std::nullopt;
            return std::array{*wrench->centre_y, *wrench->centre_z};
          },
          Measure::length, "Of that contact, y and z; null: it is the only one."),
      field("slip_margin", &SkinFriction::slip_margin,
            "The share of the friction limit that drag and torsion leave; below 0 it slips; null: "
            "no limit is stated.")};
};

template <>
struct Fields<NoiseEstimate> {
  static constexpr auto all = std::tuple{
      field("stated", &NoiseEstimate::stated_rms, Measure::reading,
            "As the scene has it; null: it states none."),
      field(
          "residual", [](const NoiseEstimate& noise) { return if_finite(noise.residual_rms); },
          Measure::reading, "As the residual shows it."),
      field(
          "model", [](const NoiseEstimate& noise) { return if_finite(noise.model_rms); },
          Measure::reading,
          "The part of the residual beyond the noise stated: an error of pad, depth or "
          "calibration.")};
};

template <>
struct Fields<DataVerdict> {
  using D = DataVerdict;
  static constexpr auto all = std::tuple{
      field("doubts", &D::doubts, "Why no contact can have caused them, worst first."),
      field("noise_known", &D::noise_known, "False: a misfit is never found."),
      field("strain", &D::strain,
            "The largest reading, or the mean normal traction, over what strains the pad by 1."),
      field(
          "residual",
          [](const D& data) {
            return data.noise_known ? std::optional(data.residual_rms) : std::nullopt;
          },
          "Root mean square of a weighted reading that the best contact found leaves; null: the "
          "noise is not known."),
      field(
          "residual_limit",
          [](const D& data) {
            return data.noise_known ? std::optional(data.residual_limit) : std::nullopt;
          },
          "What that exceeds in one honest frame of a thousand."),
      field("taxel", &D::taxel, "The one that is doubted; null: none is."),
      field(
          "offset",
          [](const D& data) {
            return data.offset.empty() ? std::nullopt : std::optional(data.offset);
          },
          Measure::reading, "The constant that is doubted, of each channel; null: none is.")};
};

template <>
struct Fields<lab::FrameAnswer::BandProbes> {
  using B = lab::FrameAnswer::BandProbes;
  static constexpr auto all = std::tuple{
      field("tractions", &B::tractions, "How many the deviation was solved for."),
      field(
          "least", [](const B& bands) { return if_finite(bands.least); },
          "The estimated deviation over that one, less 1, at the least; negative: too narrow."),
      field(
          "most", [](const B& bands) { return if_finite(bands.most); }, "The same at the most.")};
};

template <>
struct Fields<lab::FrameAnswer::Iteration> {
  using I = lab::FrameAnswer::Iteration;
  static constexpr auto all =
      std::tuple{field("steps", &I::steps, "Of conjugate gradients."),
                 field(
                     "estimate", [](const I& iteration) { return if_finite(iteration.estimate); },
                     "How far from the minimiser they ended, over the tractions' size."),
                 field("bands", &I::bands,
                       "How good the deviations of single cells are, which are estimated.")};
};

template <>
struct Fields<lab::AnswerTold> {
  using A = lab::AnswerTold;
  static constexpr auto all = std::tuple{
      field(
          "verdict", [](const A& told) { return told.answer.verdict; },
          "Whether the answer can be trusted: ok, or what is wrong."),
      field(
          "alpha",
          [](const A& told) {
            return told.answer.alpha.known() ? std::optional(told.answer.alpha.value)
                                             : std::nullopt;
          },
          "How much is smoothed; null: the method does not smooth."),
      field(
          "alpha_rule",
          [](const A& told) {
            return told.answer.alpha.known() ? std::optional(source(told.answer.alpha))
                                             : std::nullopt;
          },
          "The rule that chose alpha, or given."),
      field(
          "answer",
          [](const A& told) {
            return IfAny<AnswerKind>{
                told.answer.mixture != nullptr ? std::optional(AnswerKind::mixture) : std::nullopt};
          },
          "What forces and bands are of: mixture; absent: of the one alpha."),
      field("tangential_weight", &A::tangential_weight,
            "Of the tangential tractions' stabiliser over the normal one's; null: only one "
            "component was solved for, or there is no alpha."),
      field(
          "offsets",
          [](const A& told) {
            return told.answer.offsets.empty() ? std::nullopt : std::optional(told.answer.offsets);
          },
          Measure::reading,
          "The constants found in each channel's readings; null: the scene does not ask for them."),
      field(
          "tractions",
          [](const A& told) {
            return told.answer.tractions.empty()
                       ? std::nullopt
                       : std::optional(lab::by_component(told.answer.tractions, told.places));
          },
          "The tractions, of a skin the means over cells, row after row along y; null: there is no "
          "answer."),
      field(
          "deviations",
          [](const A& told) {
            return told.answer.has_bands()
                       ? std::optional(lab::by_component(told.answer.deviations, told.places))
                       : std::nullopt;
          },
          "One standard deviation of each, of noise and of what alpha smooths away; null: not "
          "known."),
      field(
          "low",
          [](const A& told) {
            return IfAny<lab::ByComponent<std::vector<double>>>{
                told.answer.low.empty()
                    ? std::nullopt
                    : std::optional(lab::by_component(told.answer.low, told.places))};
          },
          "The lower end of each traction's interval, of 95 % or what the scene says; absent: only "
          "deviations are known."),
      field(
          "high",
          [](const A& told) {
            return IfAny<lab::ByComponent<std::vector<double>>>{
                told.answer.high.empty()
                    ? std::nullopt
                    : std::optional(lab::by_component(told.answer.high, told.places))};
          },
          "The upper end."),
      field(
          "alpha_quartiles",
          [](const A& told) {
            const auto& mixture = told.answer.mixture;
            return IfAny<std::vector<double>>{
                mixture == nullptr ? std::nullopt
                                   : std::optional(std::vector{mixture->alpha_quantile(0.25),
                                                               mixture->alpha_quantile(0.75)})};
          },
          "Half of what the readings leave possible of alpha lies between these, where the answer "
          "is the mixture; absent: it is not."),
      field(
          "cells", [](const A& told) { return told.answer.cells; },
          "The cells that touch: row * columns + column.", Of::skins),
      field(
          "contacts", [](const A& told) { return told.answer.patches.size(); },
          "How many contacts lie apart.", Of::skins),
      field(
          "unseen",
          [](const A& told) {
            return told.answer.has_bands() ? std::optional(told.answer.unseen) : std::nullopt;
          },
          "The share of the force found where no live taxel is near; null: not known.", Of::skins),
      field(
          "resultant",
          [](const A& told) {
            return told.answer.has_bands() ? std::optional(lab::resultant_told(told.answer))
                                           : std::nullopt;
          },
          "What the tractions amount to, of a skin those of the cells that touch; null: their "
          "deviations are not known."),
      field(
          "patches",
          [](const A& told) {
            return told.answer.bands ? told.answer.bands->patches : told.answer.patches;
          },
          "Each contact by itself, the strongest first."),
      field(
          "friction", [](const A& told) { return told.answer.friction; },
          "How near the contact that needs the most friction is to slipping; null: nothing drags.",
          Of::skins),
      field(
          "ellipse", [](const A& told) { return told.answer.ellipse; },
          "Of the strongest contact, by the second moments of its pressure and Hertz' law; null: "
          "nothing touches.",
          Of::skins),
      field(
          "noise",
          [](const A& told) {
            return told.answer.has_bands() ? std::optional(told.answer.noise) : std::nullopt;
          },
          "The noise of the weighted readings, root mean square; null: not known."),
      field(
          "data", [](const A& told) { return told.answer.data; },
          "Whether the readings can be those of a contact; null: not judged."),
      field(
          "condition",
          [](const A& told) {
            return told.answer.condition ? if_finite(told.answer.condition->value) : std::nullopt;
          },
          "How much the system multiplies relative errors; null: not known."),
      field(
          "condition_kind",
          [](const A& told) {
            return told.answer.condition ? std::optional(told.answer.condition->kind)
                                         : std::nullopt;
          },
          "What number that is."),
      field(
          "condition_of",
          [](const A& told) {
            return told.answer.condition ? std::optional(told.answer.condition->matrix)
                                         : std::nullopt;
          },
          "The matrix that it is of."),
      field(
          "error_bound",
          [](const A& told) {
            return told.answer.error_bound ? if_finite(*told.answer.error_bound) : std::nullopt;
          },
          "How far rounding may have moved the tractions, over their 2-norm; null: no bound is "
          "known."),
      field(
          "constraints", [](const A& told) { return lab::constraints_told(told.answer); },
          "How the search under constraints ended; null: there are none."),
      field(
          "iteration",
          [](const A& told) { return IfAny<lab::FrameAnswer::Iteration>{told.answer.iteration}; },
          "How the iteration ended, of a skin with more tractions than a matrix holds; absent: "
          "there was none.",
          Of::skins)};
};

}  // namespace tactile_net
