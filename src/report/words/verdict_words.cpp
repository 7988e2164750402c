#include "tactile_net/report/words/verdict_words.hpp"

#include "numeric/named.hpp"

namespace tactile_net::report {
namespace {

using lab::Verdict;

constexpr Named<Verdict> verdict_sentences[] = {
    {Verdict::ok, "the answer passed its checks"},
    {Verdict::failed, "there is no answer"},
    {Verdict::border,
     "the best alpha is at the end of the range searched: the readings contain too little, or the "
     "noise or the pad is not as stated"},
    {Verdict::unstable,
     "the answer depends on how much is smoothed: ten times the alpha would give another one"},
    {Verdict::no_root, "no alpha fits: there is no signal above the noise"},
    {Verdict::rules_disagree,
     "the rules for alpha give different answers: the readings do not fix how much to smooth"},
    {Verdict::noise_needed,
     "too few taxels to tell noise from contact: state the noise's rms under [noise], and take the "
     "rule evidence"},
    {Verdict::noise_amplified, "dft makes the readings' noise more than 10 000 times as large"},
    {Verdict::sign_change,
     "a wavelength that the sensors cannot see lies between those of the dft"},
    {Verdict::cut_off,
     "the contact may reach beyond the taxels, or where they are dead: what presses there is not "
     "measured, and the force is a lower bound"},
    {Verdict::not_one_contact, "the readings are not those of a single contact that drags"},
    {Verdict::drag_in_noise, "the noise could hide the drag"},
    {Verdict::no_contact, "nothing presses, or no more than the noise hides"},
    {Verdict::null_mode, "part of the traction shows in no reading and was set to zero"},
    {Verdict::not_converged, "the iteration did not converge"},
    {Verdict::iteration_limit, "the search for the constraints' optimum was stopped"},
    {Verdict::unconstrained,
     "it may pull or slip although the scene says that nothing does: only tikhonov obeys that"},
    {Verdict::oversmoothed, "more than half of the readings is left unexplained"},
    {Verdict::ill_conditioned, "rounding alone may have changed it"},
    {Verdict::inaccurate, "the circuit is more than 1 % off"},
    {Verdict::clipped,
     "taxels read the end of their range, and what they would read beyond it is not known: more "
     "may press than is found"},
    {Verdict::undetermined,
     "the readings do not tell the force: its value is mostly assumed; see identify for what these "
     "sensors tell"},
    {Verdict::coarse,
     "the taxels lie more than two depths apart, or 1.75 under constraints: what presses between "
     "them is a guess"},
    {Verdict::doubted,
     "no contact explains the readings: the verdict on the data says what may be wrong"},
};

}  // namespace

std::string_view in_words(Verdict verdict) noexcept { return name_in<verdict_sentences>(verdict); }

}  // namespace tactile_net::report
