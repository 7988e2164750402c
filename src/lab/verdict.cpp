#include "tactile_net/lab/verdict.hpp"

#include <cmath>

#include "numeric/named.hpp"
#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/lab/condition.hpp"

namespace tactile_net::lab {
namespace {

constexpr Named<Verdict> verdicts[] = {{Verdict::ok, "ok"},
                                       {Verdict::failed, "failed"},
                                       {Verdict::border, "border"},
                                       {Verdict::unstable, "unstable"},
                                       {Verdict::no_root, "no_root"},
                                       {Verdict::rules_disagree, "rules_disagree"},
                                       {Verdict::noise_needed, "noise_needed"},
                                       {Verdict::noise_amplified, "noise_amplified"},
                                       {Verdict::sign_change, "sign_change"},
                                       {Verdict::cut_off, "cut_off"},
                                       {Verdict::not_one_contact, "not_one_contact"},
                                       {Verdict::drag_in_noise, "drag_in_noise"},
                                       {Verdict::no_contact, "no_contact"},
                                       {Verdict::null_mode, "null_mode"},
                                       {Verdict::not_converged, "not_converged"},
                                       {Verdict::iteration_limit, "iteration_limit"},
                                       {Verdict::unconstrained, "unconstrained"},
                                       {Verdict::oversmoothed, "oversmoothed"},
                                       {Verdict::ill_conditioned, "ill_conditioned"},
                                       {Verdict::inaccurate, "inaccurate"},
                                       {Verdict::clipped, "clipped"},
                                       {Verdict::undetermined, "undetermined"},
                                       {Verdict::coarse, "coarse"},
                                       {Verdict::doubted, "doubted"}};
constexpr Named<Condition::Kind> condition_kinds[] = {{Condition::Kind::exact, "exact"},
                                                      {Condition::Kind::bound, "bound"},
                                                      {Condition::Kind::noise_gain, "noise_gain"}};
constexpr Named<Condition::Matrix> condition_matrices[] = {
    {Condition::Matrix::stacked, "stacked"},
    {Condition::Matrix::eliminated, "eliminated"},
    {Condition::Matrix::circular, "circular"},
    {Condition::Matrix::kernel, "kernel"},
    {Condition::Matrix::normal, "normal"}};

/// Of alpha's choice, or of where a contact ends: nothing of it holds where nothing presses.
bool is_of_a_contact(Verdict verdict) {
  switch (verdict) {
    case Verdict::border:
    case Verdict::unstable:
    case Verdict::no_root:
    case Verdict::rules_disagree:
    case Verdict::noise_needed:
    case Verdict::oversmoothed:
    case Verdict::cut_off:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string_view name(Verdict verdict) noexcept { return name_in<verdicts>(verdict); }

std::optional<Verdict> verdict_named(std::string_view name) noexcept {
  return named_in<verdicts>(name);
}

Verdict verdict_of(AlphaVerdict verdict) noexcept {
  switch (verdict) {
    case AlphaVerdict::ok:
      return Verdict::ok;
    case AlphaVerdict::border:
      return Verdict::border;
    case AlphaVerdict::unstable:
      return Verdict::unstable;
    case AlphaVerdict::no_root:
      return Verdict::no_root;
    case AlphaVerdict::rules_disagree:
      return Verdict::rules_disagree;
    case AlphaVerdict::noise_needed:
      return Verdict::noise_needed;
  }
  return Verdict::failed;
}

Verdict verdict_of(DftVerdict verdict) noexcept {
  switch (verdict) {
    case DftVerdict::ok:
      return Verdict::ok;
    case DftVerdict::noise_amplified:
      return Verdict::noise_amplified;
    case DftVerdict::sign_change:
      return Verdict::sign_change;
    case DftVerdict::cut_off:
      return Verdict::cut_off;
  }
  return Verdict::failed;
}

Verdict verdict_of(const FrictionSolution& solution) noexcept {
  switch (solution.verdict) {
    case FrictionVerdict::ok:
      return Verdict::ok;
    case FrictionVerdict::dft:
      return verdict_of(solution.dft);
    case FrictionVerdict::not_one_contact:
      return Verdict::not_one_contact;
    case FrictionVerdict::drag_in_noise:
      return Verdict::drag_in_noise;
    case FrictionVerdict::no_contact:
      return Verdict::no_contact;
  }
  return Verdict::failed;
}

Verdict overall(Verdict answer, const std::optional<DataVerdict>& data,
                const std::optional<Uncertain>& force) noexcept {
  constexpr double deviations = 3.0;  // that noise alone hardly ever makes a force of
  if (!data) return answer;
  const bool pressed = force && std::abs(force->value) > deviations * force->deviation;
  if (data->noise_alone && data->consistent() && !pressed && is_of_a_contact(answer))
    return Verdict::no_contact;
  if (answer != Verdict::ok) return answer;
  if (!data->consistent()) return Verdict::doubted;
  const auto tells = [](const Uncertain& one) {
    return one.interval ? std::abs(one.value) > one.interval->high - one.interval->low
                        : std::abs(one.value) > one.deviation;
  };
  const bool told = !force || tells(*force);
  return told || data->noise_alone || !data->noise_known ? Verdict::ok : Verdict::undetermined;
}

std::string_view source(const ChosenAlpha& alpha) noexcept {
  return alpha.rule ? name(*alpha.rule) : "given";
}

std::string_view name(Condition::Kind kind) noexcept { return name_in<condition_kinds>(kind); }

std::string_view name(Condition::Matrix matrix) noexcept {
  return name_in<condition_matrices>(matrix);
}

}  // namespace tactile_net::lab
