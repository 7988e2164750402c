// The interface for C says what the C++ class says, to the last bit, and lets no exception out.
#include <unistd.h>

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/plan_file.hpp"
#include "tactile_net/tactile_net.h"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/realtime/c_calls.h"
#include "tests/realtime/plans.hpp"
#include "tests/realtime/skin_plans.hpp"

using namespace tactile_net;

namespace {

/// A plan's file, for as long as this lives.
class PlanFile {
 public:
  explicit PlanFile(const EstimatorPlan& plan)
      : path_((std::filesystem::temp_directory_path() /
               ("tactile-net-c-" + std::to_string(::getpid()) + ".plan"))
                  .string()) {
    const std::vector<std::byte> bytes = encode_plan(plan);
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  PlanFile(const PlanFile&) = delete;
  PlanFile& operator=(const PlanFile&) = delete;
  ~PlanFile() { std::filesystem::remove(path_); }

  [[nodiscard]] const char* path() const { return path_.c_str(); }

 private:
  std::string path_;
};

/// A line with everything that a frame can say, and a skin.
std::vector<EstimatorPlan> telling_plans() {
  EstimatorPlan line = made_plan({.count = 21, .channels = 2, .unknowns = 2});
  line.noise_rms = line.residual_limit = 0.05;
  line.force_deviation = 0.01;
  line.border = {0, 20};
  EstimatorPlan skin = made_skin_plan({.rows = 6, .columns = 5});
  skin.noise_rms = skin.residual_limit = 0.05;
  skin.cells->deviations.assign(skin.values, 0.3);
  return {line, skin};
}

void check_same_number(double c, double cpp) {
  CHECK(std::bit_cast<std::uint64_t>(c) == std::bit_cast<std::uint64_t>(cpp));
}

void check_same(const tactile_net_estimate& c, const ContactEstimate& cpp) {
  check_same_number(c.time_s, cpp.time);
  check_same_number(c.normal_force, cpp.normal_force);
  check_same_number(c.force_deviation, cpp.force_deviation);
  check_same_number(c.tangential_force, cpp.tangential_force);
  check_same_number(c.tangential_y, cpp.tangential_y);
  check_same_number(c.tangential_z, cpp.tangential_z);
  check_same_number(c.centre_y_m, cpp.centre);
  check_same_number(c.centre_z_m, cpp.centre_z);
  check_same_number(c.torsion_n_m, cpp.torsion);
  check_same_number(c.angle_rad, cpp.angle);
  check_same_number(c.friction_margin, cpp.friction_margin);
  check_same_number(c.slip_margin, cpp.slip_margin);
  check_same_number(c.margin_centre_y_m, cpp.margin_centre);
  check_same_number(c.margin_centre_z_m, cpp.margin_centre_z);
  for (std::size_t k = 0; k < 3; ++k) {
    check_same_number(c.force_in_space[k], cpp.space.force[k]);
    check_same_number(c.moment_in_space_n_m[k], cpp.space.moment[k]);
    check_same_number(c.centre_in_space_m[k], cpp.space.centre[k]);
  }
  check_same_number(c.residual_rms, cpp.residual_rms);
  CHECK(c.contacts == cpp.contacts);
  CHECK(c.touching == cpp.touching);
  CHECK(c.outlier == cpp.outlier);
  CHECK(c.age == cpp.age);
  CHECK(c.contact == cpp.contact);
  CHECK(c.pulls == cpp.pulls);
  CHECK(c.implausible == cpp.implausible);
  CHECK(c.misfit == cpp.misfit);
  CHECK(c.beyond_edge == cpp.beyond_edge);
  CHECK(c.baseline_moved == cpp.baseline_moved);
  CHECK(c.saturated == cpp.saturated);
}

/// What a call that gave null says.
std::string why_null(const tactile_net_estimator* estimator) {
  REQUIRE(estimator == nullptr);
  return tactile_net_last_error();
}

}  // namespace

TEST_CASE("a program in C gets the bits that a program in C++ gets", "[c_interface]") {
  for (const EstimatorPlan& plan : telling_plans()) {
    CAPTURE(plan.label);
    const PlanFile file(plan);
    const std::vector<double> frame = random_values(plan.readings(), 3);
    const std::vector<double> baseline = random_values(plan.readings(), 4);
    std::vector<double> in_c(4 * plan.tractions());
    tactile_net_estimate estimates[4];
    REQUIRE(call_everything(file.path(), frame.data(), baseline.data(), 7, in_c.data(),
                            estimates) == 0);

    ContactEstimator estimator(plan);
    std::vector<double> tractions(plan.tractions());
    ContactEstimate expected{.tractions = tractions};
    for (std::size_t k = 0; k < 4; ++k) {
      CAPTURE(k);
      if (k == 0) REQUIRE(estimator.set_dead(7));
      if (k == 1) {
        estimator.revive();
        REQUIRE(estimator.set_baseline(baseline) == FrameStatus::ok);
      }
      if (k == 3) estimator = ContactEstimator(plan);
      const double time = k < 3 ? 0.5 + static_cast<double>(k > 0) : 2.5;
      REQUIRE(estimator.update(frame, expected, time) == FrameStatus::ok);
      check_same(estimates[k], expected);
      for (std::size_t i = 0; i < tractions.size(); ++i)
        check_same_number(in_c[k * tractions.size() + i], tractions[i]);
    }
  }
}

TEST_CASE("C sees what a plan is for", "[c_interface]") {
  const std::vector<EstimatorPlan> plans = telling_plans();
  for (const EstimatorPlan& plan : plans) {
    const std::vector<std::byte> bytes = encode_plan(plan);
    tactile_net_estimator* const estimator =
        tactile_net_decode(TACTILE_NET_INTERFACE, bytes.data(), bytes.size());
    REQUIRE(estimator != nullptr);
    const tactile_net_plan& seen = *tactile_net_plan_of(estimator);
    CHECK(seen.label == plan.label);
    CHECK(seen.readings == plan.readings());
    CHECK(seen.tractions == plan.tractions());
    CHECK(seen.tractions == seen.unknowns * seen.rows * seen.columns);
    CHECK(seen.unknowns == plan.unknowns);
    CHECK(seen.is_skin == plan.cells.has_value());
    CHECK(seen.is_curved == plan.space.has_value());
    CHECK(seen.spacing_y_m == (plan.cells ? plan.cells->spacing_y : plan.spacing));
    CHECK(seen.spacing_z_m == (plan.cells ? plan.cells->spacing_z : 0.0));
    CHECK(seen.centre_y_m == (plan.cells ? plan.cells->centre_y : plan.centre));
    CHECK(seen.centre_z_m == (plan.cells ? plan.cells->centre_z : 0.0));
    tactile_net_destroy(estimator);
  }
  CHECK(tactile_net_interface() == TACTILE_NET_INTERFACE);
}

TEST_CASE("C is told why there is no estimator, and no exception gets there", "[c_interface]") {
  const EstimatorPlan plan = made_plan({});
  std::vector<std::byte> bytes = encode_plan(plan);
  const auto decoded = [&](int version) {
    return why_null(tactile_net_decode(version, bytes.data(), bytes.size()));
  };
  CHECK_THAT(decoded(TACTILE_NET_INTERFACE + 1), ContainsSubstring("version 2 of tactile_net.h"));
  bytes[bytes.size() / 2] ^= std::byte{1};
  CHECK_THROWS_WITH(decode_plan(bytes), decoded(TACTILE_NET_INTERFACE));
  CHECK_THAT(why_null(tactile_net_decode(TACTILE_NET_INTERFACE, nullptr, 5)),
             ContainsSubstring("the plan is a null pointer"));
  CHECK_THAT(why_null(tactile_net_load(TACTILE_NET_INTERFACE, nullptr)),
             ContainsSubstring("path of the plan is a null pointer"));
  CHECK_THAT(why_null(tactile_net_copy(nullptr)), ContainsSubstring("estimator is a null pointer"));
  CHECK_THAT(why_null(tactile_net_load(TACTILE_NET_INTERFACE, "/no/such.plan")),
             ContainsSubstring("/no/such.plan: cannot be opened"));
  // Longer than the room for it: cut off, and ended.
  const std::string long_name(5000, 'x');
  CHECK(why_null(tactile_net_load(TACTILE_NET_INTERFACE, long_name.c_str())) ==
        std::string(1023, 'x'));
}

TEST_CASE("C's readings in other numbers, its counters and its held answers are those of C++",
          "[c_interface]") {
  const EstimatorPlan plan = made_plan({});
  const std::vector<std::byte> bytes = encode_plan(plan);
  tactile_net_estimator* const estimator =
      tactile_net_decode(TACTILE_NET_INTERFACE, bytes.data(), bytes.size());
  REQUIRE(estimator != nullptr);
  std::vector<std::int16_t> counts(2 * plan.readings(), 999);
  for (std::size_t i = 0; i < plan.readings(); ++i)
    counts[2 * i] = static_cast<std::int16_t>(100 * i);
  const auto in_c = [&](tactile_net_type type, double scale) {
    return tactile_net_readings{counts.data(), plan.readings(), type, 4, scale};
  };
  const ReadingLayout layout{.stride = 4, .scale = 0.3};
  ContactEstimator same(plan);
  const auto update_both = [&](const tactile_net_readings& readings, const ReadingView& view) {
    std::vector<double> one(plan.tractions());
    std::vector<double> other(plan.tractions());
    tactile_net_estimate estimate{};
    ContactEstimate expected{.tractions = other};
    CHECK(tactile_net_update_from(estimator, &readings, 0.5, one.data(), &estimate) ==
          static_cast<int>(same.update(view, expected, 0.5)));
    check_same(estimate, expected);
    CHECK(one == other);
    return estimate;
  };
  const ReadingView good(counts.data(), plan.readings(), layout);
  CHECK(update_both(in_c(TACTILE_NET_INT16, 0.3), good).normal_force != 0.0);
  const ReadingView unscaled(counts.data(), plan.readings(), {.stride = 4});
  update_both(in_c(TACTILE_NET_INT16, 0.0), unscaled);
  const tactile_net_readings baseline = in_c(TACTILE_NET_UINT16, 0.5);
  CHECK(tactile_net_set_baseline_from(estimator, &baseline) == TACTILE_NET_OK);
  CHECK(same.set_baseline(ReadingView(counts.data(), ReadingType::uint16, plan.readings(),
                                      {.stride = 4, .scale = 0.5})) == FrameStatus::ok);
  const tactile_net_options hold{false, true, 0};
  tactile_net_set_options(estimator, &hold);
  same.set_options({.hold = true});
  update_both(in_c(TACTILE_NET_INT16, 0.3), good);
  // A type that there is not, and what is not there at all.
  const ReadingView none(counts.data(), 0);
  CHECK(update_both(in_c(static_cast<tactile_net_type>(5), 0.3), none).age == 1);
  tactile_net_readings nothing = in_c(TACTILE_NET_INT16, 0.3);
  nothing.first = nullptr;
  CHECK(update_both(nothing, none).age == 2);
  counts[0] = 32767;
  CHECK(update_both(in_c(TACTILE_NET_INT16, 1e304),
                    ReadingView(counts.data(), plan.readings(), {.stride = 4, .scale = 1e304}))
            .age == 3);

  tactile_net_counters counted{};
  tactile_net_get_counters(estimator, &counted);
  CHECK(FrameCounters{counted.frames, counted.wrong_size, counted.not_finite, counted.too_large} ==
        same.counters());
  CHECK(counted.frames == 6);
  CHECK(counted.wrong_size == 2);
  CHECK(counted.not_finite + counted.too_large == 1);
  tactile_net_reset_counters(estimator);
  tactile_net_get_counters(estimator, &counted);
  CHECK(counted.frames == 0);
  tactile_net_destroy(estimator);
}

TEST_CASE("what is refused leaves C's memory untouched, and has a name", "[c_interface]") {
  const std::vector<std::byte> bytes = encode_plan(made_plan({}));
  tactile_net_estimator* const estimator =
      tactile_net_decode(TACTILE_NET_INTERFACE, bytes.data(), bytes.size());
  REQUIRE(estimator != nullptr);
  const std::size_t n = tactile_net_plan_of(estimator)->readings;
  std::vector<double> frame(n, 1.0);
  std::vector<double> tractions(tactile_net_plan_of(estimator)->tractions, 17.0);
  tactile_net_estimate estimate{};
  estimate.normal_force = 5.0;
  const auto status = [&] {
    return tactile_net_update(estimator, frame.data(), n, 1.0, tractions.data(), &estimate);
  };
  frame[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(status() == TACTILE_NET_NOT_FINITE);
  CHECK(tactile_net_set_baseline(estimator, frame.data(), n) == TACTILE_NET_NOT_FINITE);
  frame[3] = 1e308;
  CHECK(status() == TACTILE_NET_TOO_LARGE);
  CHECK_FALSE(tactile_net_set_dead(estimator, n));
  CHECK(estimate.normal_force == 5.0);
  CHECK(tractions == std::vector<double>(tractions.size(), 17.0));
  tactile_net_destroy(estimator);

  using std::string_view;
  CHECK(tactile_net_status_name(TACTILE_NET_OK) == string_view("ok"));
  CHECK(tactile_net_status_name(TACTILE_NET_WRONG_SIZE) == string_view("wrong_size"));
  CHECK(tactile_net_status_name(TACTILE_NET_NOT_FINITE) == string_view("not_finite"));
  CHECK(tactile_net_status_name(TACTILE_NET_TOO_LARGE) == string_view("too_large"));
  CHECK(tactile_net_status_name(99) == string_view("unknown"));
}

TEST_CASE("C gets contacts one by one, and rules over steps towards constraints", "[c_interface]") {
  EstimatorPlan plan = telling_plans()[1];
  add_cone(plan, 0.5);
  const PlanFile file(plan);
  tactile_net_estimator* const in_c = tactile_net_load(TACTILE_NET_INTERFACE, file.path());
  REQUIRE(in_c != nullptr);
  CHECK(tactile_net_plan_of(in_c)->steps == plan.cone->steps);
  CHECK(tactile_net_plan_of(in_c)->friction_limit == 0.5);
  ContactEstimator in_cpp(plan);
  std::vector<double> f(plan.tractions());
  std::array<ContactRow, 4> rows;
  ContactEstimate expected{.tractions = f, .rows = rows};
  std::array<tactile_net_contact, 4> contacts{};
  tactile_net_estimate found{};
  const auto update = [&](unsigned seed) {
    const std::vector<double> readings = random_values(plan.readings(), seed);
    REQUIRE(in_cpp.update(readings, expected) == FrameStatus::ok);
    REQUIRE(tactile_net_update(in_c, readings.data(), readings.size(), 0.0, nullptr, &found) ==
            TACTILE_NET_OK);
    check_same_number(found.unfinished, expected.unfinished);
    check_same_number(found.unfinished_share, expected.unfinished_share);
    CHECK(found.steps == expected.steps);
  };
  update(1);
  CHECK(tactile_net_contacts(in_c, contacts.data(), contacts.size()) == 0);  // not asked for
  const tactile_net_options options{false, false, contacts.size()};
  tactile_net_set_options(in_c, &options);
  std::size_t told = 0;
  for (unsigned seed = 1; seed < 8; ++seed) {
    update(seed);
    REQUIRE(tactile_net_contacts(in_c, contacts.data(), contacts.size()) == expected.rows_found);
    for (std::size_t i = 0; i < expected.rows_found; ++i, ++told) {
      check_same_number(contacts[i].normal_force, rows[i].normal_force);
      check_same_number(contacts[i].tangential_z, rows[i].tangential_z);
      check_same_number(contacts[i].slip_margin, rows[i].slip_margin);
      check_same_number(contacts[i].force_deviation, rows[i].force_deviation);
      CHECK(contacts[i].cells == rows[i].cells);
      CHECK(contacts[i].id > 0);
    }
  }
  CHECK(told > 0);
  CHECK(tactile_net_contacts(in_c, contacts.data(), 0) == 0);

  in_cpp.set_work({.steps = 3});
  tactile_net_set_work(in_c, 3, 0.0);
  update(2);
  CHECK(found.steps == 3);
  tactile_net_stop(in_c, true);
  tactile_net_estimator* const copy = tactile_net_copy(in_c);
  const std::vector<double> readings = random_values(plan.readings(), 2);
  tactile_net_update(in_c, readings.data(), readings.size(), 0.0, nullptr, &found);
  CHECK(found.steps == 0);
  tactile_net_update(copy, readings.data(), readings.size(), 0.0, nullptr, &found);
  CHECK(found.steps == 3);  // it has a flag of its own
  tactile_net_stop(in_c, false);
  tactile_net_update(in_c, readings.data(), readings.size(), 0.0, nullptr, &found);
  CHECK(found.steps == 3);
  tactile_net_destroy(copy);
  tactile_net_destroy(in_c);
}
