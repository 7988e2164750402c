#include "tactile_net/lab/identify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace {

using namespace tactile_net;
using namespace tactile_net::lab;

Scene small(const std::string& reads, const std::string& material = "poisson_ratio = 0.3\n",
            const std::string& depth = "1.0", const std::string& rest = "") {
  return parse_scene("[sensor]\ncount = 15\npitch = 1.0\ndepth = " + depth + "\nreads = [" + reads +
                         "]\n[material]\nyoungs_modulus = 1.0\n" + material + rest,
                     "s.toml");
}

template <typename Reason>
const Reason* find(const Survey& survey) {
  for (const HiddenReason& reason : survey.reasons)
    if (const auto* found = std::get_if<Reason>(&reason)) return found;
  return nullptr;
}

}  // namespace

TEST_CASE("a contact between two taxels is one too", "[identify]") {
  const Scene scene = small("\"stress_x\"", "poisson_ratio = 0.3\n", "0.5",
                            "[noise]\nrms = 1e-3\n[[contact]]\nshape = \"cylinder\"\ncenter = 0.5\n"
                            "half_width = 0.3\nforce = 1.0\n");
  CHECK_FALSE(needs_traction(scene, {}));
}

TEST_CASE("stress with shear hides nothing, and no reason is given", "[identify]") {
  const Survey survey = identify(small("\"stress_x\", \"shear_xy\""));
  CHECK(survey.own.identifiability->null_space.dimension == 0);
  CHECK_FALSE(hides_anything(survey.own));
  CHECK(survey.reasons.empty());
}

TEST_CASE("two strains lose the tangential mean to odd kernels and a mode to the odd count",
          "[identify]") {
  const Survey survey = identify(small("\"strain_x\", \"strain_y\""));
  CHECK(survey.own.identifiability->null_space.dimension == 1);
  REQUIRE(survey.reasons.size() == 2);
  const auto* odd = find<hidden_reason::OddKernels>(survey);
  REQUIRE(odd != nullptr);
  CHECK(odd->component == Traction::tangential_y);
  const auto* symmetry = find<hidden_reason::Symmetry>(survey);
  REQUIRE(symmetry != nullptr);
  CHECK(symmetry->taxels == 15);
  CHECK(symmetry->lost == 1);
}

TEST_CASE("the advice keeps one quantity and hides nothing", "[identify]") {
  const Survey survey = identify(small("\"strain_x\", \"strain_y\""));
  REQUIRE(survey.advice.exchange.has_value());
  const SensorChoice& other = survey.alternatives[*survey.advice.exchange];
  CHECK_FALSE(hides_anything(other));
  CHECK(tells_more(other, survey.own));
  CHECK(other.depths == survey.own.depths);
  REQUIRE(other.reads.size() == 2);
  CHECK(std::count(other.reads.begin(), other.reads.end(), Quantity::shear_xy) == 1);
}

TEST_CASE("each advice names another alternative, and the best is the best",
          "[identify][property]") {
  for (const char* reads : {"\"stress_x\"", "\"shear_xy\"", "\"strain_x\", \"strain_y\"",
                            "\"stress_x\", \"stress_y\""}) {
    CAPTURE(reads);
    const Survey survey = identify(small(reads));
    const auto& [exchange, pair_here, best] = survey.advice;
    if (pair_here) CHECK(pair_here != exchange);
    if (best) CHECK((best != exchange && best != pair_here));
    const auto last = best ? best : pair_here ? pair_here : exchange;
    if (!last || survey.alternatives[*last].unknowns != 2) continue;
    for (const SensorChoice& choice : survey.alternatives)
      if (choice.unknowns == 2) CHECK_FALSE(tells_more(choice, survey.alternatives[*last]));
  }
}

TEST_CASE("at nu = 0.5 the reason is that two strains are one", "[identify]") {
  const Survey survey = identify(small("\"strain_x\", \"strain_y\"", "poisson_ratio = 0.5\n"));
  CHECK(find<hidden_reason::OneStrain>(survey) != nullptr);
  CHECK(find<hidden_reason::Proportional>(survey) == nullptr);
  const auto* mean = find<hidden_reason::MeanUnread>(survey);
  REQUIRE(mean != nullptr);
  CHECK(mean->component == Traction::normal);
}

TEST_CASE("shear alone is odd under a normal traction", "[identify]") {
  const Survey survey = identify(small("\"shear_xy\""));
  CHECK(survey.own.unknowns == 1);
  const auto* odd = find<hidden_reason::OddKernels>(survey);
  REQUIRE(odd != nullptr);
  CHECK(odd->component == Traction::normal);
  CHECK(hides_mean(survey.own, Traction::normal));
  CHECK(survey.advice.exchange.has_value());
}

TEST_CASE("a deep sensor loses short waves to smoothing, as exp(-2 pi depth / wavelength)",
          "[identify]") {
  const Survey survey = identify(small("\"stress_x\"", "poisson_ratio = 0.3\n", "30.0"));
  const auto* smoothing = find<hidden_reason::Smoothing>(survey);
  REQUIRE(smoothing != nullptr);
  CHECK(smoothing->depth == 30.0);
  CHECK(smoothing->wavelength == survey.own.identifiability->null_space.shortest);
  CHECK_THAT(std::log(smoothing->left) * smoothing->wavelength,
             WithinRel(-2.0 * 3.14159265358979 * 30.0, 1e-12));
}

TEST_CASE("what only a dead taxel would show is the dead taxel's fault", "[identify]") {
  const Survey survey = identify(
      small("\"stress_x\"", "poisson_ratio = 0.3\n", "1.0", "[dead_taxels]\nindices = [3]\n"));
  CHECK(find<hidden_reason::DeadTaxels>(survey) != nullptr);
  CHECK(find<hidden_reason::Smoothing>(survey) == nullptr);
}

TEST_CASE("the noise assumed is the scene's where it states one", "[identify]") {
  const std::string stated = "[noise]\nrms = { stress_x = 1e-3 }\n";
  const Scene scene = small("\"stress_x\"", "poisson_ratio = 0.3\n", "1.0", stated);
  CHECK(identify(scene, {.traction = 1.0}).noise.kind == AssumedNoise::Kind::stated);
  CHECK(identify(scene, {.traction = 1.0}).noise.share > 0.0);
  const Survey given = identify(scene, {.traction = 2.0, .relative_noise = 0.05});
  CHECK(given.noise.kind == AssumedNoise::Kind::share);
  CHECK(given.noise.share == 0.05);
  CHECK(given.traction == 2.0);
  const Survey assumed = identify(small("\"stress_x\""));
  CHECK(assumed.noise.kind == AssumedNoise::Kind::share);
  CHECK(assumed.noise.share == 0.01);
}

TEST_CASE("noise that is stated without a contact asks how strong a load is", "[identify]") {
  const std::string noise = "[noise]\nrms = { stress_x = 1e-3 }\n";
  const Scene scene = small("\"stress_x\"", "poisson_ratio = 0.3\n", "1.0", noise);
  CHECK(needs_traction(scene, {}));
  CHECK_THROWS_AS(identify(scene), std::invalid_argument);
  CHECK_FALSE(needs_traction(scene, {.traction = 1.0}));
  CHECK_FALSE(needs_traction(scene, {.relative_noise = 0.1}));
  CHECK_FALSE(needs_traction(small("\"stress_x\""), {}));
}

TEST_CASE("what is told does not depend on the unit of stress", "[identify]") {
  const auto told = [](double pascal) {
    const Scene scene = small("\"stress_x\", \"shear_xy\"", "poisson_ratio = 0.3\n", "1.0",
                              "[noise]\nrms = " + shortest(1e-3 * pascal) + "\n");
    const std::vector<double> largest = {0.5 * pascal, 0.1 * pascal};
    const double traction = traction_behind(scene, largest);
    return std::pair(traction / pascal,
                     *identify(scene, {.traction = traction}).own.resolvable(SkinRipple::pressure));
  };
  const auto [traction, wavelength] = told(1.0);
  CHECK(traction >= 0.5);  // no ripple reads as much as it presses
  const auto [same_traction, same_wavelength] = told(6895.0);
  CHECK_THAT(same_traction, WithinRel(traction, 1e-12));
  CHECK(same_wavelength == wavelength);
  CHECK_THROWS_AS(traction_behind(small("\"stress_x\""), {}), std::invalid_argument);
  const std::vector<double> nothing = {0.0};
  CHECK_THROWS_AS(traction_behind(small("\"stress_x\""), nothing), std::invalid_argument);
}

TEST_CASE("a line's survey is told in the parts of a skin's", "[identify]") {
  const Scene scene = small("\"strain_x\", \"strain_y\"");
  const SensorChoice own = identify(scene).own;
  // Of k = 0 every kernel of the tangential traction is odd: the mean, and no other wave, is lost.
  REQUIRE(own.hidden.size() == 1);
  CHECK(own.hidden.front().direction == WaveDirection::mean);
  CHECK(own.hidden.front().divergence);
  CHECK_FALSE(own.hidden.front().normal);
  CHECK(own.array->tractions == 30);
  CHECK(own.array->hidden == own.identifiability->null_space.dimension);
  CHECK(own.array->tractions - own.array->hidden == own.identifiability->rank);
  CHECK(std::isinf(own.resolutions.front().wavelength()));
  CHECK_THAT(own.resolutions[3].wavelength(), WithinRel(15.0 / 3.0, 1e-12));
  CHECK(resolvable_drag(own) == own.resolvable(SkinRipple::drag_along));
  CHECK_FALSE(own.resolvable(SkinRipple::drag_across));
}

TEST_CASE("what a line's readings are of a wave are their kernels over the noise", "[identify]") {
  const Scene scene = small("\"stress_x\", \"shear_xy\"");
  const Survey survey = identify(scene, {.traction = 2.0, .relative_noise = 0.01});
  REQUIRE(survey.shares.size() == 2);
  // In a half plane of a wave k: stress_x = -(1 + k x) exp(-k x) p, shear_xy = k x exp(-k x) p in
  // size, and with the roles of p and q exchanged -k x exp(-k x) q, (1 - k x) exp(-k x) q.
  const double kx = 2.0 * 3.14159265358979 / survey.wave;
  const auto& [normal, drag, across] = survey.shares[0].signal;
  CHECK_THAT(normal / drag, WithinRel((1.0 + kx) / kx, 1e-9));
  CHECK_THAT(survey.shares[1].signal[1] / survey.shares[1].signal[0],
             WithinRel((1.0 - kx) / kx, 1e-9));
  CHECK(across == 0.0);
  // Twice the noise is half of it.
  const Survey noisier = identify(scene, {.traction = 2.0, .relative_noise = 0.02});
  CHECK_THAT(noisier.shares[1].signal[0], WithinRel(0.5 * survey.shares[1].signal[0], 1e-12));
}

TEST_CASE("more noise leaves longer ripples to be told", "[identify]") {
  const Scene scene = small("\"stress_x\", \"shear_xy\"");
  CHECK(coarsest(identify(scene, {.relative_noise = 1e-4}).own) <
        coarsest(identify(scene, {.relative_noise = 0.1}).own));
}

TEST_CASE("an amplitude or a noise that is none is refused", "[identify]") {
  const Scene scene = small("\"stress_x\"");
  const double bad = GENERATE(-1.0, 0.0, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_AS(identify(scene, {.traction = bad}), std::invalid_argument);
  CHECK_THROWS_AS(identify(scene, {.relative_noise = bad}), std::invalid_argument);
}
