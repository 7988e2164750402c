#include "tests/lab/sound_recordings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

#include "tactile_net/lab/simulated_frame.hpp"
#include "tactile_net/lab/skin_simulation.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/lab/scene_parts.hpp"

namespace tactile_net {
namespace {

std::string number(double value) { return std::to_string(value); }

/// @param place  of a share of the way along which contacts move
std::string contact_course(Course course, double force, Random& random, const auto& place) {
  const auto at = [&](double t, double share, double way) {
    return "{ t = " + number(t) + ", force = " + number(std::max(share * force, 1e-6)) + ", " +
           place(way) + " }";
  };
  const double shift = random.uniform(-0.1, 0.1);
  std::string points;
  switch (course) {
    case Course::pressed:
      points = at(0.2, 0, 0) + ", " + at(0.35, 0.6, 0) + ", " + at(0.5, 0, 0) + ", " +
               at(0.8, 0, 1) + ", " + at(0.95 + shift, 1, 1) + ", " + at(1.2, 0, 1);
      break;
    case Course::held:
      points = at(0.4 + shift, 0, 0) + ", " + at(0.45 + shift, 1, 0) + ", " +
               at(random.uniform(0.6, 1.5), 1, 0) + ", " + at(1.55, 0, 0);
      break;
    case Course::lasting:
      points = at(0.0, 1, 0) + ", " + at(1.6, 1, 0);
      break;
    case Course::sliding:
      points = at(0.0, 1, 0) + ", " + at(0.8 + shift, 1, 1) + ", " + at(1.6, 1, 0);
      break;
    case Course::swaying:
      points = at(0.0, 1, 0) + ", " + at(0.4, 1.03, 0) + ", " + at(0.8, 0.97, 0.05) + ", " +
               at(1.2, 1.02, 0) + ", " + at(1.6, 1, 0);
      break;
    case Course::idle:
      points = at(0.0, 0, 0) + ", " + at(1.6, 0, 0);
      break;
  }
  return "trajectory = [" + points + "]\n";
}

Course course_of(const RecordingKind& kind, Random& random) {
  const auto any = random.one_of({Course::pressed, Course::held, Course::lasting, Course::sliding,
                                  Course::swaying, Course::idle});
  return kind.course.value_or(any);
}

std::string pad_table(const std::string& reads, double depth, std::uint64_t seed) {
  return "depth = " + number(depth) + "\nreads = [" + reads +
         "]\n[material]\nyoungs_modulus = 4e5\npoisson_ratio = 0.45\n[noise]\nrms = " +
         number(pad_noise) + "\nseed = " + std::to_string(seed) +
         "\n[time]\nrate = 100.0\nframes = " + std::to_string(frames_recorded) + "\n[[contact]]\n";
}

/// What stands between the transducers and the file.
template <typename Recording>
Recording through(Chain chain, Random& random, Recording recording) {
  const double step = pad_noise * (chain == Chain::fine_steps     ? random.uniform(0.05, 0.5)
                                   : chain == Chain::coarse_steps ? random.uniform(1.0, 6.0)
                                                                  : 0.1);
  const double threshold = chain == Chain::threshold ? pad_noise * random.uniform(3.0, 6.0) : 0.0;
  if (chain == Chain::noise) return recording;
  for (auto& frame : recording.frames)
    for (double& reading : frame) {
      if (std::abs(reading) < threshold) reading = 0.0;
      reading = step * std::round(reading / step);
    }
  return recording;
}

/// A threshold leaves nothing of a sensor that nothing touches.
Chain chain_of(const RecordingKind& kind, Course course, Random& random) {
  if (course == Course::idle)
    return kind.chain.value_or(random.one_of({Chain::noise, Chain::coarse_steps}));
  const auto any = random.one_of(
      {Chain::noise, Chain::noise, Chain::fine_steps, Chain::coarse_steps, Chain::threshold});
  return kind.chain.value_or(any);
}

}  // namespace

RecordedLine honest_line(std::uint64_t seed, const RecordingKind& kind) {
  Random random(seed);
  const double depth = 1e-3 * random.uniform(1.0, 4.0);
  const double pitch = depth * kind.pitch_in_depths.value_or(random.one_of({0.35, 0.5, 1.0, 1.6}));
  const double half = std::max(4.0 * depth, 4.0 * pitch);
  const auto count = static_cast<std::size_t>(2.0 * half / pitch) + 1;
  const auto any = random.one_of<std::string>({"\"stress_x\"", "\"stress_x\", \"shear_xy\""});
  const std::string reads = kind.reads.empty() ? any : kind.reads;
  const double width = depth * random.uniform(0.5, 1.5);
  const double peak = pad_noise * random.uniform(kind.least_peak, 500.0);
  const double from = half * random.uniform(-0.5, 0.5);
  const double to = half * random.uniform(-0.5, 0.5);
  const auto place = [&](double way) { return "center = " + number(from + way * (to - from)); };
  const Course course = course_of(kind, random);
  const bool drags = reads.find("shear") != reads.npos;
  const std::string contact =
      "shape = \"cylinder\"\nhalf_width = " + number(width) +
      (drags ? "\nfriction = " + number(random.uniform(0.0, 0.4)) : std::string()) + '\n' +
      contact_course(course, 1.6 * peak * (depth + 0.5 * width), random, place);
  return through(chain_of(kind, course, random), random,
                 record_with<lab::SensorRecording>(parse_scene(
                     "[sensor]\ncount = " + std::to_string(count) + "\npitch = " + number(pitch) +
                         '\n' + pad_table(reads, depth, seed) + contact,
                     "line.toml")));
}

RecordedSkin honest_skin(std::uint64_t seed, const RecordingKind& kind) {
  Random random(seed);
  const double depth = 1e-3 * random.uniform(1.0, 4.0);
  const double pitch = depth * kind.pitch_in_depths.value_or(random.one_of({0.6, 1.0, 1.6}));
  const auto rows = random.one_of<std::size_t>({5, 6, 7, 8});
  const auto columns = random.one_of<std::size_t>({5, 6, 7});
  const auto any = random.one_of<std::string>({"\"stress_x\"", "\"stress_x\"", three_stresses});
  const std::string reads = kind.reads.empty() ? any : kind.reads;
  const double radius = depth * random.uniform(0.7, 1.6);
  const double peak = pad_noise * random.uniform(kind.least_peak, 500.0);
  const auto somewhere = [&](std::size_t taxels) {
    return 0.25 * static_cast<double>(taxels) * pitch * random.uniform(-1.0, 1.0);
  };
  const double y[2] = {somewhere(rows), somewhere(rows)};
  const double z[2] = {somewhere(columns), somewhere(columns)};
  const auto place = [&](double way) {
    return "place = [" + number(y[0] + way * (y[1] - y[0])) + ", " +
           number(z[0] + way * (z[1] - z[0])) + "]";
  };
  const Course course = course_of(kind, random);
  const bool drags = reads.find("shear") != reads.npos;
  const std::string contact =
      "shape = \"sphere\"\nradius = " + number(radius) +
      (drags ? "\nfriction = " + number(random.uniform(0.0, 0.4)) +
                   "\ndirection = " + number(random.uniform(0.0, 360.0))
             : std::string()) +
      '\n' +
      contact_course(course, 2.1 * peak * (depth * depth + 0.7 * radius * radius), random, place);
  return through(
      chain_of(kind, course, random), random,
      record_with<lab::SkinRecording>(std::get<SkinScene>(parse_any_scene(
          "[sensor]\nrows = " + std::to_string(rows) + "\ncolumns = " + std::to_string(columns) +
              "\npitch = " + number(pitch) + '\n' + pad_table(reads, depth, seed) + contact,
          "skin.toml"))));
}

}  // namespace tactile_net
