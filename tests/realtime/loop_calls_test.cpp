// What a loop asks of an estimator besides its frames: readings in other numbers, counters, answers
// that are held, denormals that are flushed.
#include <bit>
#include <cfenv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "tactile_net/realtime/contact_estimator.hpp"
#include "tactile_net/realtime/reading_view.hpp"
#include "tests/catch.hpp"
#include "tests/inverse/problems.hpp"
#include "tests/not_finite.hpp"
#include "tests/realtime/answer.hpp"
#include "tests/realtime/plans.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

using namespace tactile_net;

namespace {

EstimatorPlan loop_plan() { return made_plan({.count = 13, .channels = 2, .unknowns = 2}); }

std::vector<std::uint64_t> bits_of(std::span<const double> values) {
  std::vector<std::uint64_t> bits;
  for (const double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

/// Numbers of a type, its ends among them, some `stride` bytes apart from `offset` on, in bytes
/// that are those of NaN.
template <class T>
struct Laid {
  Laid(std::size_t count, std::ptrdiff_t stride, std::size_t offset, double scale)
      : layout{.stride = stride, .scale = scale}, bytes(offset + count * 64 + 64, 0xff) {
    const std::vector<double> random = random_values(count, 7);
    const std::ptrdiff_t step = stride == 0 ? static_cast<std::ptrdiff_t>(sizeof(T)) : stride;
    first = bytes.data() + offset;
    if (step < 0) first -= static_cast<std::ptrdiff_t>(count - 1) * step;
    for (std::size_t i = 0; i < count; ++i) {
      T number = static_cast<T>(1000.0 * (random[i] + 2.0));
      if (i == 0) number = std::numeric_limits<T>::lowest() / 2;
      if (i == 1) number = std::numeric_limits<T>::max() / 2;
      if (i == 2 && std::numeric_limits<T>::is_integer) number = std::numeric_limits<T>::lowest();
      if (i == 3 && std::numeric_limits<T>::is_integer) number = std::numeric_limits<T>::max();
      if (sizeof(T) == sizeof(double) && i < 2) number = static_cast<T>(0.1);
      std::memcpy(first + static_cast<std::ptrdiff_t>(i) * step, &number, sizeof number);
      in_doubles.push_back(scale * static_cast<double>(number));
    }
  }
  [[nodiscard]] ReadingView view(ReadingType type) const {
    return {first, type, in_doubles.size(), layout};
  }
  ReadingLayout layout;
  std::vector<unsigned char> bytes;
  unsigned char* first;
  std::vector<double> in_doubles;
};

/// Every layout of one type is the copy in doubles: frames and baselines, to the bit.
template <class T>
void check_type(ReadingType type) {
  const EstimatorPlan plan = loop_plan();
  const std::size_t n = plan.readings();
  for (const std::ptrdiff_t stride : {0, 8, 11, 64, -9})
    for (const std::size_t offset : {0U, 3U})
      for (const double scale : {1.0, 0.3, -1e-3}) {
        if (stride != 0 && std::abs(stride) < static_cast<std::ptrdiff_t>(sizeof(T))) continue;
        CAPTURE(stride, offset, scale);
        const Laid<T> laid(n, stride, offset, scale);
        ContactEstimator estimator(plan);
        const Answer expected = answer(estimator, laid.in_doubles, 0.25);
        Answer given(estimator);
        REQUIRE(estimator.update(laid.view(type), given.estimate, 0.25) == FrameStatus::ok);
        CHECK(given.bits() == expected.bits());

        const std::vector<double> frame = random_values(n, 9);
        ContactEstimator other(plan);
        REQUIRE(estimator.set_baseline(laid.view(type)) == FrameStatus::ok);
        REQUIRE(other.set_baseline(laid.in_doubles) == FrameStatus::ok);
        CHECK(answer(estimator, frame).bits() == answer(other, frame).bits());
      }
}

}  // namespace

TEST_CASE("readings in other numbers give the bits of their copy in doubles", "[loop_calls]") {
  SECTION("float64") { check_type<double>(ReadingType::float64); }
  SECTION("float32") { check_type<float>(ReadingType::float32); }
  SECTION("int16") { check_type<std::int16_t>(ReadingType::int16); }
  SECTION("uint16") { check_type<std::uint16_t>(ReadingType::uint16); }
  SECTION("int32") { check_type<std::int32_t>(ReadingType::int32); }
}

TEST_CASE("a view knows the type of what it is given", "[loop_calls]") {
  const auto value_of = [](auto number) {
    double value = 0.0;
    ReadingView(&number, 1, {.scale = 2.0}).copy_to(&value);
    return value;
  };
  CHECK(value_of(0.1) == 0.2);
  CHECK(value_of(0.1F) == 2.0 * static_cast<double>(0.1F));
  CHECK(value_of(std::int16_t{-32768}) == -65536.0);
  CHECK(value_of(std::uint16_t{65535}) == 131070.0);
  CHECK(value_of(std::int32_t{-2147483647 - 1}) == -4294967296.0);
}

TEST_CASE("readings in other numbers are refused as those in doubles are", "[loop_calls]") {
  ContactEstimator estimator(loop_plan());
  const std::size_t n = estimator.readings();
  std::vector<float> frame(n, 1.0F);
  Answer untouched(estimator);
  const auto before = untouched.bits();
  const auto status = [&](const ReadingView& view) {
    return estimator.update(view, untouched.estimate);
  };
  CHECK(status(ReadingView(frame.data(), n - 1)) == FrameStatus::wrong_size);
  CHECK(estimator.set_baseline(ReadingView(frame.data(), n - 1)) == FrameStatus::wrong_size);
  frame[5] = std::numeric_limits<float>::quiet_NaN();
  CHECK(status(ReadingView(frame.data(), n)) == FrameStatus::not_finite);
  CHECK(estimator.set_baseline(ReadingView(frame.data(), n)) == FrameStatus::not_finite);
  frame[5] = std::numeric_limits<float>::max();
  CHECK(status(ReadingView(frame.data(), n, {.scale = 1e300})) == FrameStatus::not_finite);
  CHECK(status(ReadingView(frame.data(), n, {.scale = 1e269})) == FrameStatus::too_large);
  CHECK(untouched.bits() == before);
  CHECK(estimator.counters() ==
        FrameCounters{.frames = 4, .wrong_size = 1, .not_finite = 2, .too_large = 1});
}

TEST_CASE("every frame is counted, and what was refused by its status", "[loop_calls]") {
  ContactEstimator estimator(loop_plan());
  const std::size_t n = estimator.readings();
  const std::vector<double> good = random_values(n, 3);
  std::vector<double> bad = good;
  bad[1] = not_a_number;
  std::vector<double> huge = good;
  huge[1] = 1e308;
  Answer out(estimator);
  CHECK(estimator.counters() == FrameCounters{});
  (void)answer(estimator, good);
  (void)estimator.update(bad, out.estimate);
  (void)estimator.update(huge, out.estimate);
  (void)estimator.update(std::span(good).first(n - 1), out.estimate);
  (void)estimator.update(bad, out.estimate);
  const FrameCounters five{.frames = 5, .wrong_size = 1, .not_finite = 2, .too_large = 1};
  CHECK(estimator.counters() == five);
  CHECK(five.refused() == 4);
  CHECK(ContactEstimator(estimator).counters() == FrameCounters{});
  (void)estimator.set_baseline(bad);  // no frame
  CHECK(estimator.counters() == five);

  // A batch: a block and a tile and some more, two of them broken.
  constexpr std::size_t frames = 27;
  std::vector<double> batch;
  for (std::size_t k = 0; k < frames; ++k) {
    const std::vector<double>& next = k == 2 ? bad : k == 26 ? huge : good;
    batch.insert(batch.end(), next.begin(), next.end());
  }
  std::vector<double> room(frames * estimator.tractions());
  std::vector<ContactEstimate> estimates(frames);
  for (std::size_t k = 0; k < frames; ++k)
    estimates[k].tractions =
        std::span(room).subspan(k * estimator.tractions(), estimator.tractions());
  estimator.reset_counters();
  CHECK(estimator.update_batch(batch, estimates) == FrameStatus::not_finite);
  CHECK(estimator.counters() == FrameCounters{.frames = 27, .not_finite = 1, .too_large = 1});
  CHECK(estimator.update_batch(std::span(batch).first(1), estimates) == FrameStatus::wrong_size);
  CHECK(estimator.counters() ==
        FrameCounters{.frames = 28, .wrong_size = 1, .not_finite = 1, .too_large = 1});
}

TEST_CASE("a refused frame gets the last good answer with its age, where that is asked for",
          "[loop_calls]") {
  ContactEstimator estimator(loop_plan());
  const std::size_t n = estimator.readings();
  std::vector<double> bad = random_values(n, 4);
  bad[0] = infinite;
  Answer out(estimator);
  const auto nothing = out.bits();
  const auto refuse = [&] {
    CHECK(estimator.update(bad, out.estimate, 9.0) == FrameStatus::not_finite);
  };
  estimator.set_options({.hold = true});
  CHECK(estimator.options().hold);
  refuse();  // there is no good one yet
  CHECK(out.bits() == nothing);
  CHECK(out.estimate.age == 0);

  const Answer good = answer(estimator, random_values(n, 3), 0.5);
  CHECK(good.estimate.age == 0);
  refuse();
  CHECK(out.bits() == good.bits());  // its time, too
  CHECK(out.estimate.age == 1);
  CHECK(out.estimate.tractions.data() == out.tractions.data());
  out = Answer(estimator);
  CHECK(estimator.update(std::span<const double>{}, out.estimate) == FrameStatus::wrong_size);
  CHECK(out.bits() == good.bits());
  CHECK(out.estimate.age == 2);
  ContactEstimate no_room{.normal_force = 5.0};
  CHECK(estimator.update(bad, no_room) == FrameStatus::wrong_size);
  CHECK(no_room.normal_force == 5.0);
  CHECK(no_room.age == 0);
  ContactEstimator copy = estimator;  // it has the option, and no answer
  CHECK(copy.options().hold);
  Answer of_copy(copy);
  CHECK(copy.update(bad, of_copy.estimate) == FrameStatus::not_finite);
  CHECK(of_copy.bits() == nothing);

  const Answer next = answer(estimator, random_values(n, 5), 0.75);
  CHECK(next.estimate.age == 0);
  refuse();
  CHECK(out.bits() == next.bits());
  CHECK(out.estimate.age == 1);
  // The estimate that was held becomes a good one again.
  CHECK(estimator.update(random_values(n, 3), out.estimate, 0.5) == FrameStatus::ok);
  CHECK(out.bits() == good.bits());
  CHECK(out.estimate.age == 0);

  estimator.set_options({});
  out = Answer(estimator);
  refuse();
  CHECK(out.bits() == nothing);
  estimator.set_options({.hold = true});  // what was held is forgotten
  refuse();
  CHECK(out.bits() == nothing);
}

TEST_CASE("holding answers changes none", "[loop_calls]") {
  for (const EstimatorPlan& plan : {loop_plan(), made_skin_plan({})}) {
    ContactEstimator plain(plan);
    ContactEstimator holding(plan);
    holding.set_options({.hold = true});
    for (unsigned seed = 1; seed < 5; ++seed) {
      const std::vector<double> frame = random_values(plan.readings(), seed);
      CHECK(answer(plain, frame).bits() == answer(holding, frame).bits());
    }
  }
}

TEST_CASE("denormals are flushed while a frame is computed, where that is asked for, and only then",
          "[loop_calls]") {
  for (const Structure structure : structures) {
    const EstimatorPlan plan = made_plan({.structure = structure});
    ContactEstimator estimator(plan);
    const std::vector<double> tiny(plan.readings(), 1e-310);
    const std::vector<double> good = random_values(plan.readings(), 3);
    const Answer kept = answer(estimator, tiny);
    CHECK(bits_of(kept.tractions) != bits_of(std::vector<double>(kept.tractions.size())));
    const Answer expected = answer(estimator, good);
    estimator.set_options({.flush_denormals = true});
    CHECK(answer(estimator, good).bits() == expected.bits());
#if defined(__SSE2__) || defined(__aarch64__)
    for (const double traction : answer(estimator, tiny).tractions) CHECK(traction == 0.0);
    std::vector<double> room(plan.tractions());
    std::vector<ContactEstimate> one{{.tractions = room}};
    CHECK(estimator.update_batch(tiny, one) == FrameStatus::ok);
    for (const double traction : room) CHECK(traction == 0.0);
#endif
    const volatile double small = 1e-310;
    CHECK(0.5 * small != 0.0);  // after it the host has them as before
  }
}

TEST_CASE("the floating-point environment is the host's again after every frame", "[loop_calls]") {
  ContactEstimator estimator(loop_plan());
  const std::size_t n = estimator.readings();
  const std::vector<double> good = random_values(n, 3);
  std::vector<double> bad = good;
  bad[1] = not_a_number;
  Answer out(estimator);
  const auto call_all = [&] {
    (void)estimator.update(good, out.estimate);
    (void)estimator.update(bad, out.estimate);
    (void)estimator.update(std::span(good).first(1), out.estimate);
    (void)estimator.update_batch(good, {&out.estimate, 1});
    (void)estimator.update_batch(bad, {&out.estimate, 1});
    (void)estimator.update_batch(bad, {});
  };
  for (const bool flush : {false, true}) {
    estimator.set_options({.flush_denormals = flush});
    for (const int rounding : {FE_TONEAREST, FE_UPWARD}) {
      std::fesetround(rounding);
      std::feclearexcept(FE_ALL_EXCEPT);
      call_all();
      const bool same = std::fegetround() == rounding;
      const bool inexact = std::fetestexcept(FE_INEXACT) != 0;  // the frames' own is not lost
      std::fesetround(FE_TONEAREST);
      CHECK(same);
      CHECK(inexact);
    }
#if defined(__SSE2__)
    for (const unsigned host : {0x0000U, 0x8000U, 0x0040U, 0x8040U}) {
      const unsigned before = _mm_getcsr();
      _mm_setcsr((before & ~0x8040U) | host);
      call_all();
      const unsigned after = _mm_getcsr();
      _mm_setcsr(before);
      CHECK((after & 0x8040U) == host);
    }
#endif
  }
}
