// A part of the table in docs/internals/numerics.md, whose rows have four times as many contacts.
#include "tests/coverage/coverage.hpp"

#include <string>

#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::coverage;

namespace {

constexpr std::size_t contacts_each = 100;

}  // namespace

TEST_CASE("two deviations hold the truth of a contact inside a coarse array", "[coverage]") {
  struct Case {
    Setting setting;
    double least;  // share of contacts
  };
  const Contacts contacts(contacts_each);
  for (const auto& [setting, least] :
       {Case{{.pitch = 2.0}, 0.92}, Case{{.pitch = 1.0, .unknowns = 2}, 0.92},
        Case{{.pitch = 4.0}, 0.9}}) {
    CAPTURE(setting.pitch, setting.unknowns);
    REQUIRE(basis(setting) == SurfaceBasis::hats);
    const Score found = score(setting, contacts);
    CHECK(found.force_within >= least);
    CHECK(found.centre_within >= least);
    CHECK(found.field_within >= least);
    if (setting.unknowns == 2) CHECK(found.tangential_within >= least);
    // Nor is a band an excuse: the deviation is of the error's size. Narrower strips, which the
    // readings of coarse taxels do not exclude, err more.
    if (setting.pitch <= 2.0)
      CHECK(at_share(found.force_deviations, 0.5) <= 6.0 * at_share(found.force_errors, 0.5));
  }
}

TEST_CASE("two deviations hold the force of a contact narrower than the depth, wherever it presses",
          "[coverage]") {
  const Contacts contacts(contacts_each, {.half_widths = {.least = 0.1, .most = 0.5}});
  for (const double pitch : {1.0, 2.0})
    for (const char* constraint : {"", "nonnegative = true\n"}) {
      CAPTURE(pitch, constraint);
      const Setting setting{.pitch = pitch, .noise = 1e-3, .reconstruct = constraint};
      const Score found = score(setting, contacts);
      CHECK(found.force_within >= 0.95);
      CHECK(at_share(found.force_deviations, 0.5) <= 5.0 * at_share(found.force_errors, 0.5));
    }
}

TEST_CASE("two deviations hold the force of a contact that hangs over an array's end",
          "[coverage]") {
  const Contacts contacts(contacts_each, {.place = Place::overhangs});
  for (const Setting& setting :
       {Setting{.pitch = 1.0}, Setting{.pitch = 2.0}, Setting{.pitch = 4.0}, Setting{.pitch = 0.5},
        Setting{.pitch = 0.25, .stated = false},
        Setting{.pitch = 0.25, .unknowns = 2, .stated = false}}) {
    CAPTURE(setting.pitch, setting.unknowns);
    const Score found = score(setting, contacts);
    CHECK(found.force_within >= 0.93);
    CHECK(found.centre_within >= 0.93);
  }
}

TEST_CASE("two deviations hold the truth under constraints, over the ends too", "[coverage]") {
  const Contacts inside(contacts_each);
  const Contacts over(contacts_each, {.place = Place::overhangs});
  const std::string cone = "friction_limit = 0.8\n";
  for (const Setting& setting :
       {Setting{.pitch = 0.5, .reconstruct = "nonnegative = true\n"},
        Setting{.pitch = 2.0, .reconstruct = "nonnegative = true\nalpha_on_active_set = true\n"},
        Setting{.pitch = 0.5, .unknowns = 2, .reconstruct = cone},
        Setting{.pitch = 0.5,
        .unknowns = 2,
        .reconstruct = cone + "tangential_weight = \"evidence\"\n"}}) {
    CAPTURE(setting.pitch, setting.unknowns, setting.reconstruct);
    const Score found = score(setting, inside);
    CHECK(found.force_within >= 0.92);
    CHECK(found.centre_within >= 0.92);
    CHECK(found.field_within >= 0.92);
    if (setting.unknowns == 2) CHECK(found.tangential_within >= 0.92);
    // Of coarse taxels more: constraints find these strips, a narrower one they would not.
    const double most = setting.pitch > 1.0 ? 9.0 : 7.0;
    CHECK(at_share(found.force_deviations, 0.5) <= most * at_share(found.force_errors, 0.5));
    CHECK(score(setting, over).force_within >= 0.93);
  }
}

TEST_CASE("two deviations hold the truth where each channel has an offset that nobody knows",
          "[coverage]") {
  const Contacts inside(contacts_each);
  const std::string unknown = "offset = true\n";
  for (const Setting& setting :
       {Setting{.pitch = 2.0, .offset = 0.3, .reconstruct = unknown},
        Setting{.pitch = 1.0, .unknowns = 2, .offset = 0.3, .reconstruct = unknown},
        Setting{.pitch = 0.5, .offset = 0.3, .reconstruct = unknown},
        Setting{.pitch = 0.5, .offset = 0.3, .reconstruct = unknown + "nonnegative = true\n"}}) {
    CAPTURE(setting.pitch, setting.unknowns, setting.reconstruct);
    const Score found = score(setting, inside);
    CHECK(found.force_within >= 0.92);
    // A centre is a moment over a force: its band is of first order, and this force is known to
    // 0.4.
    CHECK(found.centre_within >= (setting.reconstruct == unknown ? 0.92 : 0.85));
    CHECK(found.field_within >= 0.92);
    if (setting.unknowns == 2) CHECK(found.tangential_within >= 0.92);
    CHECK(at_share(found.force_deviations, 0.5) <= 2.0 * at_share(found.force_errors, 0.5));
  }
}

TEST_CASE("two deviations hold the truth of a contact inside a dense array", "[coverage]") {
  const Contacts contacts(contacts_each);
  for (const Setting& setting : {Setting{.pitch = 0.5}, Setting{.pitch = 0.5, .grid = true},
                                 Setting{.pitch = 0.25, .stated = false}}) {
    CAPTURE(setting.grid, setting.stated);
    const Score found = score(setting, contacts);
    CHECK(found.force_within >= 0.92);
    CHECK(found.centre_within >= 0.92);
    CHECK(found.field_within >= 0.92);
  }
}
