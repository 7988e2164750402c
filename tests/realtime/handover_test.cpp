#include "tactile_net/realtime/handover.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// Counts the living, and notes which thread destroyed it.
struct Part {
  explicit Part(int value_) : value(value_), copy(value_) { ++alive; }
  ~Part() {
    --alive;
    value = copy = -1;
    if (std::this_thread::get_id() == loop) ++freed_in_the_loop;
  }
  int value, copy;
  static inline std::atomic<int> alive{0};
  static inline std::atomic<int> freed_in_the_loop{0};
  static inline std::atomic<std::thread::id> loop{};
};

}  // namespace

TEST_CASE("what is offered is taken once, and the old object comes back to the maker",
          "[handover]") {
  {
    Handover<Part> handover;
    auto current = std::make_unique<Part>(1);
    CHECK_FALSE(handover.exchange(current));
    CHECK(current->value == 1);

    handover.offer(std::make_unique<Part>(2));
    CHECK(Part::alive == 2);
    CHECK(handover.exchange(current));
    CHECK(current->value == 2);
    CHECK(Part::alive == 2);  // the loop freed nothing
    CHECK_FALSE(handover.exchange(current));
    handover.collect();
    CHECK(Part::alive == 1);
    handover.collect();
    CHECK(Part::alive == 1);
  }
  CHECK(Part::alive == 0);
}

TEST_CASE("a second offer replaces the first, and nothing offered withdraws it", "[handover]") {
  {
    Handover<Part> handover;
    handover.offer(std::make_unique<Part>(1));
    handover.offer(std::make_unique<Part>(2));
    CHECK(Part::alive == 1);
    std::unique_ptr<Part> current;  // a loop that starts with nothing
    CHECK(handover.exchange(current));
    REQUIRE(current);
    CHECK(current->value == 2);
    handover.offer(std::make_unique<Part>(3));
    handover.offer(nullptr);
    CHECK_FALSE(handover.exchange(current));
    CHECK(current->value == 2);
  }
  CHECK(Part::alive == 0);
}

TEST_CASE("an offer collects what came back, and what nobody collects goes with the handover",
          "[handover]") {
  {
    Handover<Part> handover;
    auto current = std::make_unique<Part>(1);
    handover.offer(std::make_unique<Part>(2));
    CHECK(handover.exchange(current));
    // The maker offers, which collects 1; the loop takes 3 and gives back 2.
    handover.offer(std::make_unique<Part>(3));
    CHECK(Part::alive == 2);
    CHECK(handover.exchange(current));
    CHECK(current->value == 3);
    CHECK(Part::alive == 2);
  }
  CHECK(Part::alive == 0);  // what was never collected goes with the handover
}

TEST_CASE("nothing is exchanged before the maker has collected", "[handover]") {
  // The loop's exchange between the two steps of an offer, played by what the first step destroys.
  struct Hooked {
    explicit Hooked(int number) : value(number) { ++alive; }
    ~Hooked() {
      --alive;
      if (at_end) at_end();
    }
    int value;
    std::function<void()> at_end{};
    int& alive = count();
    static int& count() {
      static int living = 0;
      return living;
    }
  };
  {
    Handover<Hooked> handover;
    auto current = std::make_unique<Hooked>(1);
    current->at_end = [&] {
      handover.offer(std::make_unique<Hooked>(3));
      handover.exchange(current);
    };
    handover.offer(std::make_unique<Hooked>(2));
    REQUIRE(handover.exchange(current));
    handover.offer(std::make_unique<Hooked>(4));  // collects 1; the loop takes 3, gives back 2
    CHECK(current->value == 3);
    CHECK_FALSE(handover.exchange(current));  // or 2 would be lost
    handover.collect();
    CHECK(handover.exchange(current));
    CHECK(current->value == 4);
  }
  CHECK(Hooked::count() == 0);
}

TEST_CASE("a maker and a loop: no object is lost, seen half made, or freed in the loop",
          "[handover][threads]") {
  constexpr int offers = 200000;
  int taken = 0;
  int torn = 0;
  int backwards = 0;
  {
    Handover<Part> handover;
    std::atomic<bool> done{false};
    std::atomic<bool> ready{false};
    std::thread loop([&] {
      auto current = std::make_unique<Part>(0);
      Part::loop = std::this_thread::get_id();
      ready = true;
      for (bool last = false; !last;) {
        last = done;
        const int before = current->value;
        if (!handover.exchange(current)) continue;
        ++taken;
        torn += current->value != current->copy;
        backwards += current->value <= before;
      }
      Part::loop = std::thread::id();
    });
    while (!ready) std::this_thread::yield();
    for (int i = 1; i <= offers; ++i) {
      handover.offer(std::make_unique<Part>(i));
      if (i % 1024 == 0) std::this_thread::yield();
    }
    done = true;
    loop.join();
  }
  CHECK(taken > 0);
  CHECK(torn == 0);
  CHECK(backwards == 0);
  CHECK(Part::freed_in_the_loop == 0);
  CHECK(Part::alive == 0);
}
