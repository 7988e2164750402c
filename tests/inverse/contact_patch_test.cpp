#include "tactile_net/inverse/contact_patch.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/catch.hpp"
#include "tests/inverse/slopes.hpp"

using namespace tactile_net;

namespace {

constexpr Surface long_line{.count = 61, .spacing = 0.5};
constexpr double quiet_rms = 1e-4;  // noise's rms

/// What presses about a place, and drags.
struct Bump {
  double place, half_width, pressure, friction;
};

std::vector<double> tractions_of(const std::vector<Bump>& bumps) {
  const std::size_t n = long_line.count;
  std::vector<double> f(2 * n);
  for (const Bump& bump : bumps)
    for (std::size_t i = 0; i < n; ++i) {
      const double apart = (long_line.position(i) - bump.place) / bump.half_width;
      if (std::abs(apart) >= 1.0) continue;
      const double p = bump.pressure * std::sqrt(1.0 - apart * apart);
      f[i] += p;
      f[n + i] += bump.friction * p;
    }
  return f;
}

const Bump left_bump{-8.0, 3.0, 1.0, 0.3};
const Bump right_bump{7.25, 2.0, 2.0, -0.1};

std::vector<ContactPatch> found_in(std::span<const double> f, const PatchOptions& options = {}) {
  const ErringTractions erring(3, f.size(), 5);
  return patches_of(long_line, f, erring.covariance, quiet_rms,
                    resultant_of(long_line, f, erring.covariance, quiet_rms), options);
}

void check_alike(const ContactPatch& found, const ContactPatch& expected) {
  const auto check = [](const std::optional<Uncertain>& a, const std::optional<Uncertain>& b) {
    REQUIRE(a.has_value() == b.has_value());
    if (a) CHECK_THAT(a->value, WithinRel(b->value, 1e-12));
  };
  CHECK(found.cells == expected.cells);
  check(found.wrench.normal, expected.wrench.normal);
  check(found.wrench.tangential_y, expected.wrench.tangential_y);
  check(found.wrench.centre_y, expected.wrench.centre_y);
  check(found.friction, expected.friction);
  check(found.slip_margin, expected.slip_margin);
  check(found.extent, expected.extent);
}

}  // namespace

TEST_CASE("contacts on a line are each what it is alone, and their sum is the whole",
          "[contact_patch][property]") {
  const PatchOptions options{.friction_limit = 0.5};
  const std::vector<double> f = tractions_of({left_bump, right_bump});
  const std::vector<ContactPatch> both = found_in(f, options);
  REQUIRE(both.size() == 2);
  check_alike(both[0], found_in(tractions_of({right_bump}), options).front());
  check_alike(both[1], found_in(tractions_of({left_bump}), options).front());
  CHECK_THAT(both[1].friction->value, WithinRel(0.3, 1e-12));
  CHECK_THAT(both[1].slip_margin->value, WithinRel(0.4, 1e-12));
  CHECK_THAT(both[1].wrench.centre_y->value, WithinAbs(-8.0, 1e-12));

  const ErringTractions erring(3, f.size(), 5);
  const UncertainResultant whole = resultant_of(long_line, f, erring.covariance, quiet_rms);
  double force = 0.0;
  double drag = 0.0;
  double moment = 0.0;
  for (const ContactPatch& patch : both) {
    force += patch.wrench.normal.value;
    drag += patch.wrench.tangential_y->value;
    moment += patch.wrench.normal.value * patch.wrench.centre_y->value;
  }
  CHECK_THAT(force, WithinRel(whole.normal.value, 1e-12));
  CHECK_THAT(drag, WithinRel(whole.tangential->value, 1e-12));
  CHECK_THAT(moment, WithinRel(whole.normal.value * whole.centre->value, 1e-12));
  // The whole is as near to slipping as its worst contact.
  const ContactPatch* const worst = nearest_to_slipping(both);
  const auto nearest = nearest_to_slipping(long_line, f, erring.covariance, quiet_rms, whole);
  REQUIRE(worst == &both[1]);
  REQUIRE(nearest);
  CHECK(worst->wrench.normal.value == nearest->normal.value);
  CHECK(worst->wrench.tangential_y->deviation == nearest->tangential->deviation);
}

TEST_CASE("one contact on a line is the whole, and what does not press is none",
          "[contact_patch]") {
  const std::vector<double> f = tractions_of({left_bump});
  const ErringTractions erring(3, f.size(), 5);
  const auto found = [&](double noise) {
    return patches_of(long_line, f, erring.covariance, noise,
                      resultant_of(long_line, f, erring.covariance, noise));
  };
  const UncertainResultant whole = resultant_of(long_line, f, erring.covariance, quiet_rms);
  const std::vector<ContactPatch> one = found(quiet_rms);
  REQUIRE(one.size() == 1);
  CHECK(one.front().wrench.normal.value == whole.normal.value);
  CHECK(one.front().wrench.normal.deviation == whole.normal.deviation);
  CHECK_FALSE(one.front().slip_margin);
  CHECK_FALSE(one.front().wrench.torsion);
  CHECK(found(quiet_rms * whole.normal.value / whole.normal.deviation).empty());
  CHECK(found_in(std::vector<double>(f.size())).empty());
  std::vector<double> pulls = f;
  for (double& value : pulls) value = -value;
  CHECK(found_in(pulls).empty());
}

TEST_CASE("deviations of a contact on a line are the slopes of its values",
          "[contact_patch][property]") {
  std::vector<double> f = tractions_of({left_bump, right_bump});
  f[long_line.count / 2] = -0.05;  // where the line is parted, however it errs
  const ErringTractions erring(3, f.size(), 9);
  const auto found = [&](std::span<const double> tractions) {
    return patches_of(long_line, tractions, erring.covariance, quiet_rms,
                      resultant_of(long_line, tractions, erring.covariance, quiet_rms),
                      {.friction_limit = 0.5});
  };
  const std::vector<ContactPatch> patches = found(f);
  REQUIRE(patches.size() == 2);
  for (std::size_t k = 0; k < patches.size(); ++k) {
    CAPTURE(k);
    const auto check = [&](const auto& of) {
      const Uncertain number = of(patches[k]);
      const double slopes = erring.deviation(
          f, [&](std::span<const double> moved) { return of(found(moved)[k]).value; });
      CHECK_THAT(number.deviation, WithinRel(quiet_rms * slopes, 1e-5));
    };
    check([](const ContactPatch& one) { return one.wrench.normal; });
    check([](const ContactPatch& one) { return *one.wrench.tangential_y; });
    check([](const ContactPatch& one) { return *one.wrench.centre_y; });
    check([](const ContactPatch& one) { return *one.friction; });
    check([](const ContactPatch& one) { return *one.slip_margin; });
    check([](const ContactPatch& one) { return *one.extent; });
  }
}

TEST_CASE("a mirrored line has mirrored contacts, in any unit the same ones",
          "[contact_patch][property]") {
  const std::size_t n = long_line.count;
  const std::vector<double> f = tractions_of({left_bump, right_bump});
  std::vector<double> mirrored(f.size());
  for (std::size_t i = 0; i < n; ++i) {
    mirrored[i] = f[n - 1 - i];
    mirrored[n + i] = -f[2 * n - 1 - i];
  }
  const PatchOptions options{.friction_limit = 0.5};
  const std::vector<ContactPatch> own = found_in(f, options);
  const std::vector<ContactPatch> others = found_in(mirrored, options);
  REQUIRE(own.size() == others.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    CHECK_THAT(others[k].wrench.normal.value, WithinRel(own[k].wrench.normal.value, 1e-12));
    CHECK_THAT(others[k].wrench.centre_y->value, WithinRel(-own[k].wrench.centre_y->value, 1e-12));
    CHECK_THAT(others[k].wrench.tangential_y->value,
               WithinRel(-own[k].wrench.tangential_y->value, 1e-12));
    CHECK_THAT(others[k].slip_margin->value, WithinRel(own[k].slip_margin->value, 1e-12));
    CHECK_THAT(others[k].extent->value, WithinRel(own[k].extent->value, 1e-12));
    CHECK(others[k].cells.front() == n - 1 - own[k].cells.back());
  }

  // Squares of such numbers are none.
  const double unit = GENERATE(1e-150, 1e150);
  const ErringTractions erring(3, f.size(), 5);
  std::vector<double> large = f;
  for (double& value : large) value *= unit;
  const std::vector<ContactPatch> scaled =
      patches_of(long_line, large, erring.covariance, quiet_rms * unit,
                 resultant_of(long_line, large, erring.covariance, quiet_rms * unit), options);
  REQUIRE(scaled.size() == own.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    CHECK_THAT(scaled[k].wrench.normal.value, WithinRel(unit * own[k].wrench.normal.value, 1e-12));
    CHECK_THAT(scaled[k].friction->value, WithinRel(own[k].friction->value, 1e-12));
    CHECK(scaled[k].friction->deviation > 0.5 * own[k].friction->deviation);
    CHECK(scaled[k].friction->deviation < 2.0 * own[k].friction->deviation);
    CHECK_THAT(scaled[k].extent->value, WithinRel(own[k].extent->value, 1e-12));
    CHECK_THAT(scaled[k].extent->deviation, WithinRel(own[k].extent->deviation, 1e-9));
  }
}

TEST_CASE("the length of a contact is that of an even pressure, less what smoothing may have added",
          "[contact_patch]") {
  const std::size_t n = long_line.count;
  constexpr std::size_t pressed = 12;
  std::vector<double> f(2 * n);
  std::fill_n(f.begin() + 20, pressed, 3.0);
  const double length = pressed * long_line.spacing;
  const auto extent = [&](double smoothed) {
    return *found_in(f, {.smoothed_variance = smoothed}).front().extent;
  };
  const Uncertain own = extent(0.0);
  CHECK_THAT(own.value, WithinRel(length, 1e-12));
  CHECK(own.deviation < 0.01 * length);
  // What may be a point looks as long as it is smoothed: anything up to that.
  const Uncertain any = extent(length * length);
  CHECK_THAT(any.value, WithinRel(0.5 * length, 1e-12));
  CHECK_THAT(any.deviation, WithinRel(length / std::sqrt(12.0), 1e-3));
  const Uncertain less = extent(0.01 * length * length);
  CHECK(less.value < own.value);
  CHECK(less.value > any.value);
  CHECK(less.deviation > own.deviation);
}

TEST_CASE("a friction limit that is none is refused", "[contact_patch]") {
  ContactPatch patch;
  CHECK_THROWS_WITH(judge_slip(patch, 0.0), ContainsSubstring("limit"));
  judge_slip(patch, 0.5);
  CHECK_FALSE(patch.friction);
  CHECK(nearest_to_slipping(std::vector{patch}) == nullptr);
}
