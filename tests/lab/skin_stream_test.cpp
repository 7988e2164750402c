// A skin's recording solved by several threads: the same answers in the same order as by one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "lab/in_order.hpp"
#include "tactile_net/lab/recording_solver.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"
#include "tests/lab/skin_frames.hpp"

using namespace tactile_net;

namespace {

SkinScene sliding(const std::string& more, std::size_t side = 4) {
  const std::string taxels = std::to_string(side);
  return std::get<SkinScene>(parse_any_scene(
      "[sensor]\nrows = " + taxels + "\ncolumns = " + taxels +
          "\npitch = 1.0\ndepth = 1.5\n"
          "reads = [\"stress_x\", \"shear_xy\", \"shear_xz\"]\n"
          "[material]\nyoungs_modulus = 1.0\npoisson_ratio = 0.45\n"
          "[time]\nrate = 10.0\nframes = 10\n[[contact]]\nshape = \"sphere\"\nradius = 1.5\n"
          "friction = 0.4\ntrajectory = [{ t = 0, force = 0.02, place = [-1.0, 0.0] }, "
          "{ t = 0.9, force = 0.3, place = [1.5, 0.5] }]\n[noise]\nrms = 5e-4\n" +
          more,
      "skin.toml"));
}

/// What a frame amounts to, number by number.
std::vector<double> answer_numbers(const std::optional<lab::FrameAnswer>& answer) {
  if (!answer) return {};
  std::vector<double> all = answer->tractions;
  all.insert(all.end(), answer->deviations.begin(), answer->deviations.end());
  all.insert(all.end(), answer->wrench.covariance.begin(), answer->wrench.covariance.end());
  all.insert(all.end(),
             {answer->alpha.value, answer->wrench.normal.value, answer->wrench.normal.deviation,
              answer->data->residual_rms, answer->noise.rms(), static_cast<double>(answer->verdict),
              static_cast<double>(answer->cells.size())});
  return all;
}

struct Solved {
  std::vector<std::vector<double>> answers;
  lab::SolvedFrames summary;
  std::vector<std::size_t> dead;  // of the problem that solved the last one
};

Solved solved_recording(const SkinScene& scene, const std::vector<std::vector<double>>& frames,
                        std::size_t threads, const lab::RecordingSolverOptions& options) {
  lab::RecordingSolver solver(lab::SkinSceneProblem(scene), Method::tikhonov, options);
  Solved result;
  std::size_t at = 0;
  solver.solve_all(
      [&](std::vector<double>& readings, std::optional<double>&) {
        if (at == frames.size()) return false;
        readings = frames[at++];
        return true;
      },
      [&](std::span<const double>, const std::optional<lab::FrameAnswer>& answer) {
        result.answers.push_back(answer_numbers(answer));
      },
      threads);
  result.summary = solver.solved();
  result.dead = std::get<lab::SkinSceneProblem>(solver.problem()).scene().dead_taxels;
  return result;
}

void check_threads(const SkinScene& scene) {
  std::vector<std::vector<double>> frames = frames_of(scene);
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  frames[3][14] = missing;
  frames[5].assign(frames[5].size(), missing);
  for (double& reading : frames[6]) reading = -reading;  // doubted
  frames[7][15] += 0.2;                                  // one liar
  frames[9][14] = missing;
  const lab::RecordingSolverOptions options{.missing = lab::Missing::estimate};
  lab::RecordingSolver one(lab::SkinSceneProblem{scene}, Method::tikhonov, options);
  std::vector<std::vector<double>> expected;
  for (std::vector<double> readings : frames)
    expected.push_back(answer_numbers(one.solve(readings)));
  REQUIRE(expected[5].empty());
  const Solved found = solved_recording(scene, frames, 4, options);
  CHECK(found.answers == expected);
  CHECK(found.summary.frames == one.solved().frames);
  CHECK(found.summary.verdicts == one.solved().verdicts);
  CHECK(found.summary.estimated.count() == 2);
  CHECK(found.summary.skipped.count() == 1);
  CHECK(found.dead == std::vector<std::size_t>{14});
}

}  // namespace

TEST_CASE("a recording's answers are the same bits by any number of threads",
          "[lab][skin][stream][threads]") {
  const std::string more = GENERATE("", "[reconstruct]\nfriction_limit = 0.8\nalpha = 1e-3\n",
                                    "[saturation]\nrange = [-1.0, 0.02]\n");
  CAPTURE(more);
  check_threads(sliding(more));
}

TEST_CASE("what frames share is one for all threads, and is not kept for threads that have ended",
          "[lab][skin][stream][threads]") {
  const lab::SkinSceneProblem problem(sliding("[reconstruct]\nfriction_limit = 0.8\n"));
  std::vector<std::weak_ptr<const ConeTikhonov>> cones;
  std::vector<std::weak_ptr<const lab::SkinSceneProblem>> rests;
  const auto ask = [&](double alpha, std::size_t taxel) {
    std::thread thread([&] {
      cones.push_back(problem.cone(alpha));
      rests.push_back(problem.left_with({taxel}));
    });
    thread.join();
  };
  for (std::size_t k = 0; k < 5; ++k) ask(1e-3 * static_cast<double>(k + 1), k);
  const auto gone = [](const auto& one) { return one.expired(); };
  CHECK(std::count_if(cones.begin(), cones.end(), gone) == 4);
  CHECK(std::count_if(rests.begin(), rests.end(), gone) == 4);
  const auto cone = cones.back().lock();
  const auto rest = rests.back().lock();
  REQUIRE(cone);
  REQUIRE(rest);
  ask(5e-3, 4);
  CHECK(cones.back().lock() == cone);
  CHECK(rests.back().lock() == rest);

  // What is in use is nobody else's to take away.
  ask(7e-3, 7);
  CHECK_FALSE(cones.back().expired());
  ask(5e-3, 4);
  CHECK(cones.back().lock() == cone);
  CHECK(rests.back().lock() == rest);
}

TEST_CASE("threads do not change a larger skin's answers, nor those of an alpha under friction",
          "[lab][skin][stream][long]") {
  check_threads(sliding("[reconstruct]\nfriction_limit = 0.8\n", 5));
}

TEST_CASE("frames that share an alpha are solved one after the other", "[lab][skin][stream]") {
  const SkinScene scene = sliding("[reconstruct]\nalpha = \"aicc\"\ntangential_weight = 1.0\n");
  const std::vector<std::vector<double>> frames = frames_of(scene);
  const lab::RecordingSolverOptions options{.share_alpha = 4};
  CHECK(solved_recording(scene, frames, 3, options).answers ==
        solved_recording(scene, frames, 1, options).answers);
}

TEST_CASE("a frame that fails does so after all before it were used",
          "[lab][skin][stream][threads]") {
  const SkinScene scene = sliding("");
  std::vector<std::vector<double>> frames = frames_of(scene);
  frames[6][0] = std::numeric_limits<double>::quiet_NaN();
  const auto threads = GENERATE(std::size_t{1}, std::size_t{4});
  std::size_t used = 0;
  std::size_t at = 0;
  lab::RecordingSolver solver{lab::SkinSceneProblem(scene)};
  const auto next = [&](std::vector<double>& readings, std::optional<double>&) {
    if (at == frames.size()) return false;
    readings = frames[at++];
    return true;
  };
  const auto use = [&](std::span<const double>, const std::optional<lab::FrameAnswer>&) { ++used; };
  CHECK_THROWS_AS(solver.solve_all(next, use, threads), std::invalid_argument);
  CHECK(used == 6);
  CHECK(solver.solved().frames == 6);
}

TEST_CASE("jobs come back in their order from the threads that did them",
          "[lab][stream][threads]") {
  struct Job {
    int number = 0;
    int square = 0;
  };
  for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
    CAPTURE(threads);
    std::mutex mutex;
    std::set<std::thread::id> workers;
    int read = 0;
    std::vector<int> squares;
    const auto run = [&](int count, int bad_read, int bad_work) {
      read = 0;
      squares.clear();
      lab::in_order<Job>(
          threads,
          [&](Job& job) {
            if (read == bad_read) throw std::runtime_error("read");
            job.number = read;
            return read++ < count;
          },
          [&](Job& job) {
            const std::lock_guard lock(mutex);
            workers.insert(std::this_thread::get_id());
            if (job.number == bad_work) throw std::runtime_error("work");
            job.square = job.number * job.number;
          },
          [&](const Job& job) { squares.push_back(job.square); });
    };
    run(200, -1, -1);
    REQUIRE(squares.size() == 200);
    for (int i = 0; i < 200; ++i) REQUIRE(squares[static_cast<std::size_t>(i)] == i * i);
    CHECK(workers.contains(std::this_thread::get_id()) == (threads == 1));
    CHECK_THROWS_WITH(run(200, 70, -1), "read");
    CHECK(squares.size() == 70);
    CHECK_THROWS_WITH(run(200, -1, 50), "work");
    CHECK(squares.size() == 50);
    run(0, -1, -1);
    CHECK(squares.empty());
  }
}
