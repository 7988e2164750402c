// Every derived thing once: the linker puts a counter before the makers of what is expensive
// (--wrap, see CMakeLists.txt), under their mangled names.
#include <map>
#include <string>

#include "tactile_net/lab/method.hpp"
#include "tactile_net/lab/run.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tactile_net/simulator/ngspice.hpp"
#include "tests/catch.hpp"

namespace {
std::map<std::string, int> made;
}  // namespace

using namespace tactile_net;

// NOLINTBEGIN: the names are the linker's.
extern "C" {
#define COUNTED(result, symbol, label, parameters, arguments) \
  result __real_##symbol parameters;                          \
  result __wrap_##symbol parameters {                         \
    ++made[label];                                            \
    return __real_##symbol arguments;                         \
  }
COUNTED(LinearProblem,
        _ZN11tactile_net12make_problemERKNS_11SensorArrayERKNS_8MaterialERKNS_18LineProblemOptionsE,
        "problem", (const SensorArray& a, const Material& m, const LineProblemOptions& o),
        (a, m, o))
COUNTED(void, _ZN11tactile_net14TikhonovFamilyC1ERKNS_13LinearProblemE, "family",
        (void* self, const LinearProblem& p), (self, p))
COUNTED(void, _ZN11tactile_net18TractionCovarianceC1ERKNS_14TikhonovFamilyEdd, "covariance",
        (void* self, const TikhonovFamily& f, double a, double b), (self, f, a, b))
COUNTED(ModeSpace, _ZN11tactile_net12hidden_modesERKNS_13LinearProblemERKNS_14TikhonovFamilyE,
        "modes", (const LinearProblem& p, const TikhonovFamily& f), (p, f))
COUNTED(void, _ZN11tactile_net11AlphaTablesC1ESt4spanIKdLm18446744073709551615EEmS3_, "tables",
        (void* self, std::span<const double> gamma, std::size_t rows,
         std::span<const double> shares),
        (self, gamma, rows, shares))
COUNTED(AlphaSweep,
        _ZN11tactile_net11sweep_alphaERKNS_11FilterFrameERKNS_11AlphaTablesESt8optionalIdE, "sweep",
        (const FilterFrame& f, const AlphaTables& t, std::optional<double> n), (f, t, n))
COUNTED(
    AlphaChoice,
    _ZN11tactile_net12choose_aloneERKNS_11FilterFrameERKNS_11AlphaTablesENS_9AlphaRuleESt8optionalIdE,
    "prior", (const FilterFrame& f, const AlphaTables& t, AlphaRule r, std::optional<double> n),
    (f, t, r, n))
COUNTED(
    void,
    _ZN11tactile_net15LongArrayFamilyC1ERKNS_11SensorArrayERKNS_8MaterialERKNS_18LineProblemOptionsE,
    "sections", (void* self, const SensorArray& a, const Material& m, const LineProblemOptions& o),
    (self, a, m, o))
COUNTED(
    void,
    _ZN11tactile_net11FftTikhonovC1ERKNS_11SensorArrayERKNS_8MaterialERKNS_18LineProblemOptionsEd,
    "gradients",
    (void* self, const SensorArray& a, const Material& m, const LineProblemOptions& o,
     double alpha),
    (self, a, m, o, alpha))
#undef COUNTED
}
// NOLINTEND

TEST_CASE("run makes every problem, every family, every look for hidden modes once",
          "[lab][once]") {
  Scene scene = read_scene(SCENES "/thesis/cylinder.toml");
  REQUIRE(scene.reconstruct.methods.size() == 3);
  Ngspice ngspice;
  SECTION("with the scene's alpha") {
    made.clear();
    const lab::Experiment experiment = lab::run(scene, ngspice);
    CHECK(experiment.succeeded());
    CHECK(made["sweep"] == 0);
    CHECK(made["tables"] == 1);  // for the bands
  }
  SECTION("with a rule, for all methods") {
    scene.reconstruct.alpha.reset();
    made.clear();
    const lab::Experiment experiment = lab::run(scene, ngspice);
    CHECK(experiment.succeeded());
    CHECK(made["sweep"] == 1);
    CHECK(made["tables"] == 2);
  }
  CHECK(made["problem"] == 2);  // the scene's, and that which reaches beyond the ends for the bands
  CHECK(made["family"] == 2);
  CHECK(made["covariance"] == 0);  // windows of loads in its place
  CHECK(made["modes"] == 1);
  CHECK(made["prior"] == 1);
}

TEST_CASE("frames of a recording share what does not depend on them", "[lab][once]") {
  Scene scene = read_scene(SCENES "/thesis/cylinder.toml");
  scene.reconstruct.alpha.reset();
  const std::size_t frames = 4;
  SECTION("matrices") {
    made.clear();
    const auto solver = lab::make_solver(scene, Method::tikhonov);
    std::vector<double> readings(scene.sensor.count, 0.1);
    std::vector<double> f(solver->tractions());
    for (std::size_t k = 0; k < frames; ++k) {
      readings[40 + k] += 1.0;
      CHECK(solver->solve(readings, f).status == FrameStatus::ok);
    }
    CHECK(made["problem"] == 1);
    CHECK(made["family"] == 1);
    CHECK(made["tables"] == 1);
    CHECK(made["sweep"] == static_cast<int>(frames));
  }
  SECTION("transforms of large arrays") {
    scene.sensor.count = lab::large;
    made.clear();
    const auto solver = lab::make_solver(scene, Method::tikhonov);
    std::vector<double> readings(scene.sensor.count);
    std::vector<double> f(solver->tractions());
    for (std::size_t k = 0; k < frames; ++k) {
      readings[500 + k] += 1.0;
      CHECK(solver->solve(readings, f).status == FrameStatus::ok);
    }
    CHECK(made["sections"] == 1);
    CHECK(made["gradients"] == 1);
    CHECK(made["tables"] == 1);
    CHECK(made["problem"] == 1);  // of a section
  }
}
