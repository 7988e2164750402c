#include "tactile_net/lab/verdict.hpp"

#include "tactile_net/lab/alpha.hpp"
#include "tactile_net/lab/condition.hpp"

namespace tactile_net::lab {

std::string_view name(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::failed:
      return "failed";
    case Verdict::border:
      return name(AlphaVerdict::border);
    case Verdict::unstable:
      return name(AlphaVerdict::unstable);
    case Verdict::no_root:
      return name(AlphaVerdict::no_root);
    case Verdict::rules_disagree:
      return name(AlphaVerdict::rules_disagree);
    case Verdict::noise_amplified:
      return name(DftVerdict::noise_amplified);
    case Verdict::sign_change:
      return name(DftVerdict::sign_change);
    case Verdict::cut_off:
      return name(DftVerdict::cut_off);
    case Verdict::not_one_contact:
      return name(FrictionVerdict::not_one_contact);
    case Verdict::drag_in_noise:
      return name(FrictionVerdict::drag_in_noise);
    case Verdict::no_contact:
      return name(FrictionVerdict::no_contact);
    case Verdict::null_mode:
      return "null_mode";
    case Verdict::not_converged:
      return "not_converged";
    case Verdict::iteration_limit:
      return "iteration_limit";
    case Verdict::oversmoothed:
      return "oversmoothed";
    case Verdict::ill_conditioned:
      return "ill_conditioned";
    case Verdict::inaccurate:
      return "inaccurate";
  }
  return "";
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

std::string_view source(const ChosenAlpha& alpha) noexcept {
  return alpha.rule ? name(*alpha.rule) : "given";
}

std::string_view name(Condition::Kind kind) noexcept {
  switch (kind) {
    case Condition::Kind::exact:
      return "exact";
    case Condition::Kind::bound:
      return "bound";
    case Condition::Kind::noise_gain:
      return "noise_gain";
  }
  return "";
}

}  // namespace tactile_net::lab
