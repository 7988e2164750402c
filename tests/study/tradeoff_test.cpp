#include "tactile_net/study/tradeoff.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tactile_net/scene/reader.hpp"
#include "tactile_net/study/processor.hpp"
#include "tests/catch.hpp"
#include "tests/replaced.hpp"
#include "tests/study/ticking.hpp"

using namespace tactile_net;
using namespace tactile_net::study;
using test::tick;
using test::ticking;

namespace {

using Family = WorkCurve::Family;
using Kind = Job::Kind;

StudySection found(const Job& job, double seconds) {
  WorkPoint point;
  point.curve = {.family = Family::job, .job = job};
  point.seconds = seconds;
  return {.job = job, .points = {point}};
}

StudySection refused(const Job& job) {
  StudySection section = found(job, 0.0);
  section.points.front().failure = Failure{.what = "not today"};
  return section;
}

/// Jobs that find what they are told, and remember that they ran.
struct Jobs {
  std::vector<StudyJob> list{};
  std::atomic<int> runs{0};
  std::atomic<int> at_once{0};
  std::atomic<int> timed_in_company{0};
  std::atomic<int> most_at_once{0};

  void add(const Job& job, bool timed, double seconds) {
    list.push_back({.job = job, .weight = 1.0, .timed = timed, .run = [=, this] {
                      ++runs;
                      const int now = ++at_once;
                      if (timed && now > 1) ++timed_in_company;
                      if (now > most_at_once) most_at_once = now;
                      std::this_thread::sleep_for(std::chrono::milliseconds(2));
                      --at_once;
                      return found(job, seconds);
                    }});
  }
};

struct Saved final : StudyObserver {
  std::vector<std::size_t> sections{};  // how many each save saw
  std::vector<bool> complete{};
  std::size_t stop_after = 1000;  // saves
  std::size_t throw_at = 1000;    // save
  std::atomic<std::size_t> count{0};

  void save(const Study& study) override {
    sections.push_back(study.sections.size());
    complete.push_back(study.complete);
    if (++count == throw_at) throw std::runtime_error("the disk is full");
  }
  [[nodiscard]] bool stop() const override { return count >= stop_after; }
};

constexpr std::array digital_kinds = {Kind::products, Kind::factorisations, Kind::fft};

void add_all(Jobs& jobs) {
  for (std::size_t i = 0; i < digital_kinds.size(); ++i)
    jobs.add({digital_kinds[i]}, true, 1.0 + static_cast<double>(i));
  for (const Realization realization : realizations)
    jobs.add({Kind::settling, realization}, false, 10.0);
}

const std::string pressed_line =
    "[sensor]\ncount = 21\npitch = 0.5\ndepth = 1.0\nreads = [\"strain_x\"]\n"
    "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
    "[[contact]]\nshape = \"cylinder\"\nhalf_width = 2.0\nforce = 1.0\n"
    "[reconstruct]\nalpha = 1e-3\n";

Study digital_study(const std::string& text, StudyObserver& observer = silent_study) {
  return tradeoff(parse_scene(text, "s.toml"), {.circuits = false, .clock = ticking}, observer);
}

/// The failures of that curve.
std::vector<Failure> failures(const Study& study, const WorkCurve& curve) {
  std::vector<Failure> list;
  for (const WorkPoint& point : study.points())
    if (point.curve == curve && point.failure) list.push_back(*point.failure);
  return list;
}

}  // namespace

TEST_CASE("a study keeps the jobs' order and is saved after each; what is timed runs alone",
          "[tradeoff][threads]") {
  Jobs jobs;
  add_all(jobs);
  Study study;
  Saved saved;
  run_jobs(study, jobs.list, {}, ticking, saved);
  CHECK(study.complete);
  REQUIRE(study.sections.size() == jobs.list.size());
  for (std::size_t i = 0; i < jobs.list.size(); ++i)
    CHECK(study.sections[i].job == jobs.list[i].job);
  REQUIRE(saved.sections.size() == jobs.list.size() + 1);  // and once at the end
  for (std::size_t i = 0; i < jobs.list.size(); ++i) {
    CHECK(saved.sections[i] == i + 1);
    CHECK(saved.complete[i] == (i + 1 == jobs.list.size()));
  }
  CHECK(jobs.timed_in_company == 0);
  CHECK(jobs.most_at_once <= 2);
  CHECK(jobs.runs == static_cast<int>(jobs.list.size()));
}

TEST_CASE("a study goes on from an earlier one, and does again what had failed",
          "[tradeoff][threads]") {
  Jobs jobs;
  add_all(jobs);
  Study study;
  Saved saved;
  run_jobs(study, jobs.list,
           {found({Kind::fft}, 77.0), refused({Kind::products}), found({Kind::parts}, 5.0)},
           ticking, saved);
  CHECK(study.complete);
  CHECK(jobs.runs == static_cast<int>(jobs.list.size()) - 1);
  REQUIRE(study.sections.size() == jobs.list.size());  // parts: no job of this study
  CHECK(study.sections[0].points.front().seconds == 1.0);
  CHECK(study.sections[0].whole());
  CHECK(study.sections[2].points.front().seconds == 77.0);

  Jobs none;
  add_all(none);
  run_jobs(study, none.list, std::vector<StudySection>(study.sections), ticking, saved);
  CHECK(none.runs == 0);
  CHECK(study.complete);
}

TEST_CASE("a study that is stopped keeps what was done before, and says that it is a part",
          "[tradeoff][threads]") {
  for (const std::size_t after : {1U, 2U, 4U}) {
    CAPTURE(after);
    Jobs jobs;
    add_all(jobs);
    Study study;
    Saved saved;
    saved.stop_after = after;
    run_jobs(study, jobs.list, {}, ticking, saved);
    CHECK_FALSE(study.complete);
    CHECK(study.sections.size() == after);  // what was under way is cut off: no result
    CHECK(jobs.runs <= static_cast<int>(after) + 1);
  }
}

TEST_CASE("a study that is stopped before its first job begins none, and tells of none",
          "[tradeoff][threads]") {
  struct Stopped final : StudyObserver {
    std::atomic<int> told{0};
    std::atomic<int> saved{0};
    void progress(const StudyProgress&) override { ++told; }
    void save(const Study&) override { ++saved; }
    [[nodiscard]] bool stop() const override { return true; }
  };
  for (int again = 0; again < 100; ++again) {  // whether the worker or who watches is first: luck
    Jobs jobs;
    add_all(jobs);
    Study study;
    Stopped observer;
    run_jobs(study, jobs.list, {}, ticking, observer);
    REQUIRE(jobs.runs == 0);
    REQUIRE(observer.told == 0);
    REQUIRE(observer.saved == 1);
    REQUIRE_FALSE(study.complete);
    REQUIRE(study.sections.empty());
  }
}

TEST_CASE("progress names a job that has begun, not one that was taken over",
          "[tradeoff][threads]") {
  struct Watcher final : StudyObserver {
    std::vector<Job> told{};
    void progress(const StudyProgress& progress) override { told.push_back(progress.job); }
  } watcher;
  Jobs jobs;
  add_all(jobs);
  Study study;
  run_jobs(study, jobs.list, {found({Kind::products}, 1.0), found({Kind::fft}, 1.0)}, ticking,
           watcher);
  for (const Job& job : watcher.told) {
    CHECK_FALSE(job == Job{Kind::products});
    CHECK_FALSE(job == Job{Kind::fft});
  }
}

TEST_CASE("a study that cannot be saved ends with the reason", "[tradeoff]") {
  for (const std::size_t at : {1U, 5U}) {
    Jobs jobs;
    add_all(jobs);
    Study study;
    Saved saved;
    saved.throw_at = at;
    CHECK_THROWS_WITH(run_jobs(study, jobs.list, {}, ticking, saved), "the disk is full");
    CHECK(jobs.runs <= static_cast<int>(at) + 1);
  }
}

TEST_CASE("progress names a job, grows, and knows no pace before a job is done", "[tradeoff]") {
  struct Watcher final : StudyObserver {
    std::vector<StudyProgress> seen{};
    void progress(const StudyProgress& progress) override { seen.push_back(progress); }
  } watcher;
  Jobs jobs;
  add_all(jobs);
  Study study;
  run_jobs(study, jobs.list, {found({Kind::products}, 1.0)}, ticking, watcher);
  REQUIRE_FALSE(watcher.seen.empty());
  double before = 0.1;  // the first of ten is taken over
  for (const StudyProgress& progress : watcher.seen) {
    CHECK(progress.share >= before);
    CHECK(progress.share <= 1.0);
    CHECK_FALSE(progress.stopping);
    if (progress.share == 0.1) CHECK_FALSE(progress.seconds_left);
    if (progress.seconds_left) CHECK(*progress.seconds_left >= 0.0);
    before = progress.share;
  }
}

TEST_CASE("by a clock of its own a study of the arithmetic is the same twice, times included",
          "[tradeoff]") {
  const Study one = digital_study(pressed_line);
  const Study two = digital_study(pressed_line);
  CHECK(one.complete);
  CHECK(one.sections == two.sections);
  CHECK(one.sections.size() == 6);
  CHECK(one.processor == processor_name());
  CHECK(one.input.agreement < 1e-12);
  CHECK_FALSE(one.input.constraints());
  for (const WorkPoint& point : one.points()) {
    CHECK(point.measured());
    CHECK_THAT(point.seconds, WithinRel(tick, 1e-15));
  }
  const std::vector<WorkPoint> points = one.points();
  for (const Family family :
       {Family::product, Family::closed_form, Family::factorisation, Family::ring_filter,
        Family::division, Family::conjugate_gradients, Family::active_set, Family::fewer_taxels,
        Family::integral, Family::discrete_sum})
    CHECK(std::any_of(points.begin(), points.end(),
                      [&](const WorkPoint& point) { return point.curve.family == family; }));
}

TEST_CASE("a grid's steps are doubled, and the answer stays as long as the pad cannot tell",
          "[tradeoff]") {
  const Study study = digital_study(replaced(pressed_line, "[reconstruct]",
                                             "[reconstruct]\nsurface = \"grid\"\nspacing = 0.125"));
  std::vector<WorkPoint> points = study.points();
  std::erase_if(
      points, [](const WorkPoint& point) { return point.curve.family != Family::coarser_surface; });
  REQUIRE(points.size() >= 2);
  const double own = study.input.solution_error;
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i, points[i].knob.count, own);
    CHECK(points[i].knob.kind == Knob::Kind::surface_values);
    if (i > 0) CHECK(points[i].knob.count < points[i - 1].knob.count);
    REQUIRE(points[i].error_to_truth);
    CHECK_FALSE(points[i].error_to_solution);
  }
  CHECK_THAT(*points.front().error_to_truth, WithinAbs(own, 0.02));
}

TEST_CASE("what a method cannot do is a failure of its kind, and leaves the others", "[tradeoff]") {
  const WorkCurve coarse{.family = Family::fewer_taxels};
  const Study dead = digital_study(pressed_line + "[dead_taxels]\nindices = [3]\n");
  CHECK(failures(dead, coarse) == std::vector<Failure>{{.kind = Failure::Kind::dead_taxels}});
  const Study prime = digital_study(replaced(pressed_line, "count = 21", "count = 24"));
  CHECK(failures(prime, coarse) ==
        std::vector<Failure>{{.kind = Failure::Kind::no_stride, .count = 24}});

  const Study shallow =
      digital_study(replaced(replaced(pressed_line, "depth = 1.0", "depth = 1e-5"), "\"strain_x\"",
                             "\"shear_xy\", \"stress_x\"") +
                    "[forward]\nmodel = \"sampled\"\n");
  const auto whole_job =
      failures(shallow, {.family = Family::job, .job = Job{Kind::forward_model}});
  REQUIRE(whole_job.size() == 1);
  CHECK(whole_job.front().kind == Failure::Kind::refused);
  CHECK_FALSE(whole_job.front().what.empty());
  CHECK(shallow.complete);
  CHECK(fastest_frame(shallow.points()));
}

TEST_CASE("a scene without a reading other than zero cannot be studied", "[tradeoff]") {
  std::string noise = pressed_line;
  noise.erase(noise.find("[[contact]]"), noise.find("[reconstruct]") - noise.find("[[contact]]"));
  CHECK_THROWS_AS(digital_study(noise), std::invalid_argument);
}

TEST_CASE("a time is the median of at least five batches that are long enough for the clock",
          "[stopwatch]") {
  double now = 0.0;
  double step = 4e-6;
  std::size_t calls = 0;
  const lab::Seconds seconds = lab::time_of(
      [&] {
        now += step;
        step = calls++ < 40 ? 4e-6 : 8e-6;
      },
      1e-4, [&] { return now; });
  // 1 + 2 + 4 + 8 calls until a batch takes 32 us, then five batches of eight: 25 calls of 4 us
  // are left, so three of these batches are fast, one is mixed, one is slow.
  CHECK(calls == 55);
  CHECK_THAT(seconds.median, WithinRel(4e-6, 1e-9));
  CHECK_THAT(seconds.low, WithinRel(4e-6, 1e-9));
  CHECK(seconds.high > 4e-6);
  CHECK(seconds.high < 8e-6);
}
