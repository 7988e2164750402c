#include "tactile_net/report/words/check_words.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/scene_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/report/words/unit_words.hpp"

namespace tactile_net::report {
namespace {

namespace finding = lab::finding;
using Indices = std::vector<std::size_t>;

std::string listed(const Indices& indices) {
  std::string text;
  for (const std::size_t index : indices)
    text += (text.empty() ? "" : ", ") + std::to_string(index);
  return text;
}

std::string taxels(const Indices& indices, const char* does, const char* do_) {
  return (indices.size() == 1 ? "taxel " : "taxels ") + listed(indices) + ' ' +
         (indices.size() == 1 ? does : do_);
}

std::string times(std::size_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

Quantity quantity_of(const Scene& scene, std::size_t channel) {
  return channels(scene.sensor)[channel].quantity;
}

/// A reading, with its unit where the scene states units.
std::string reading(const Scene& scene, std::size_t channel, double value) {
  return is_strain(quantity_of(scene, channel)) ? brief(value)
                                                : in_unit(scene, Dimension::stress, value);
}

/// The same number as the scene's file would have it.
std::string in_file(const Scene& scene, std::size_t channel, double value) {
  if (scene.units && !is_strain(quantity_of(scene, channel)))
    value = scene.units->stress.from_si(value);
  return brief(value);
}

/// The line of [noise] that states what was estimated; every quantity where the scene names each.
std::string noise_line(const Scene& scene, std::size_t channel, double rms) {
  const std::string number = in_file(scene, channel, rms);
  if (channel_count(scene.sensor) == 1) return "under [noise], rms = " + number;
  return "under [noise], rms = { " + std::string(name(quantity_of(scene, channel))) + " = " +
         number + ", ... }";
}

/// Raw numbers that would read zero: the scene's own gain and offset are kept.
std::vector<double> baseline_of(const finding::Baseline& found, const Scene& scene) {
  std::vector<double> readings = found.values;
  if (scene.calibration)
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] += scene.calibration->offset[i];
  return raw_numbers(scene, readings);
}

std::string dead_advice(const Indices& found, const Scene& scene) {
  Indices all = scene.dead_taxels;
  all.insert(all.end(), found.begin(), found.end());
  std::sort(all.begin(), all.end());
  return "under [dead_taxels], indices = [" + listed(all) + "]: the answer is then found without " +
         (found.size() == 1 ? "it" : "them");
}

struct Words {
  std::string seen{};
  std::string advice{};
};

// --- frames -------------------------------------------------------------------------------------

Words say(const finding::NoFrames&, const Scene&) {
  return {"the recording holds no frame", "was it closed before it was copied?"};
}
Words say(const finding::TimeBackwards& f, const Scene&) {
  return {"time runs backwards " + times(f.count) + ", first at frame " + std::to_string(f.first),
          "are these several recordings in one file? Sort the rows by time, or cut the file there"};
}
Words say(const finding::TimeRepeats& f, const Scene&) {
  return {"time stands still " + times(f.count) + ", first at frame " + std::to_string(f.first),
          "rows may stand twice, or the clock is too coarse: write times with more digits"};
}
Words say(const finding::FramesRepeat& f, const Scene&) {
  return {std::to_string(f.frames.count()) +
              " frames equal the frame before in every reading: " + in_words(f.frames),
          "a logger that is faster than the sensor writes rows twice: leave the copies out"};
}
Words say(const finding::ValuesMissing& f, const Scene& scene) {
  Words words{std::to_string(f.values) + " values are missing, in " + in_words(f.frames), {}};
  if (f.taxels.empty()) {
    words.advice =
        "solve --missing estimate finds such frames from the other taxels, --missing skip leaves "
        "them out";
  } else {
    words.seen += "; " + taxels(f.taxels, "misses", "miss") + " more than half of its frames";
    words.advice = dead_advice(f.taxels, scene);
  }
  return words;
}

// --- taxels -------------------------------------------------------------------------------------

Words say(const finding::DeadTaxels& f, const Scene& scene) {
  if (f.taxels.size() == scene.sensor.count)
    return {"no taxel feels anything in any frame",
            "is the sensor connected, and are these its columns? --columns names others"};
  return {taxels(f.taxels, "feels", "feel") +
              " nothing: zero in every frame, or silent while both "
              "neighbours feel a load",
          dead_advice(f.taxels, scene)};
}
Words say(const finding::StuckTaxels& f, const Scene& scene) {
  return {taxels(f.taxels, "is", "are") + " stuck: taxel " + std::to_string(f.worst) +
              " holds one value for " + std::to_string(f.frames) + " frames, from frame " +
              std::to_string(f.first) + " on, though the others change",
          dead_advice(f.taxels, scene)};
}
Words say(const finding::NoisyTaxels& f, const Scene& scene) {
  return {taxels(f.taxels, "is", "are") + " noisy: taxel " + std::to_string(f.worst) + " has " +
              brief(f.times) + " times the noise of the others",
          dead_advice(f.taxels, scene) + "; or mend the contact"};
}
Words say(const finding::SingleFrameSpikes& f, const Scene&) {
  return {taxels(f.taxels, "jumps", "jump") + " for single frames, " + std::to_string(f.frames) +
              " at least, and those beside do not: by " + brief(f.times) +
              " times the noise in taxel " + std::to_string(f.worst) + ", frame " +
              std::to_string(f.frame) + "; no load does that",
          "a loose contact, or a bit lost on the way? empty these fields, and solve --missing "
          "estimate finds them from the other taxels; as they are, solve doubts such frames "
          "(bad_taxel)"};
}
Words say(const finding::SaturatedTaxels& f, const Scene& scene) {
  return {taxels(f.taxels, "is", "are") + " cut off at the end of the range: " +
              std::to_string(f.frames) + " equal readings of " + reading(scene, 0, f.limit),
          "press less hard or set a larger range: what is cut off cannot be found again, and "
          "forces come out too small there"};
}

// --- rest ---------------------------------------------------------------------------------------

Words say(const finding::Baseline& f, const Scene& scene) {
  Words words{"the readings do not go back to zero: at rest (" + std::to_string(f.frames) +
                  " quiet frames) they are up to " + reading(scene, 0, f.largest) + " off, " +
                  brief(f.times) + " times the noise, and no load explains that",
              {}};
  if (f.loaded) {
    words.advice =
        "a contact seems to be in it too: record some frames without a load, and write under "
        "[calibration], baseline_frames = [FIRST, LAST]";
    return words;
  }
  constexpr std::size_t most_listed = 128;
  const std::vector<double> raw = baseline_of(f, scene);
  if (raw.size() > most_listed) {
    words.advice =
        "under [calibration], baseline_frames = [FIRST, LAST], frames without a load; --json has "
        "the baseline of every reading";
    return words;
  }
  words.advice = "under [calibration], baseline = [";
  for (std::size_t i = 0; i < raw.size(); ++i)
    words.advice += (i > 0 ? ", " : "") + brief(raw[i], 5);
  words.advice += "]";
  return words;
}
Words say(const finding::Drift& f, const Scene& scene) {
  return {"the readings drift: at rest they change by up to " + reading(scene, 0, f.largest) +
              " from frame " + std::to_string(f.from) + " to frame " + std::to_string(f.to) + ", " +
              brief(f.times) + " times the noise, and no load explains that",
          "take the zero anew between presses (ContactEstimator::set_baseline does at run time), "
          "or cut the recording and give each part its own baseline_frames under [calibration]"};
}

// --- noise and scale ----------------------------------------------------------------------------

Words say(const finding::NoiseTaken& f, const Scene& scene) {
  const std::vector<Channel> all = channels(scene.sensor);
  std::vector<std::string> each;
  for (std::size_t c = 0; c < all.size(); ++c)
    each.push_back(reading(scene, c, f.of_channel[c]) + " of " + all[c].name);
  return {"the scene states no noise: " + join(each, " and ") + ", as still frames show, is taken",
          all.size() == 1 ? noise_line(scene, 0, f.of_channel.front())
                          : "state it, an rms for each quantity, under [noise]"};
}
Words say(const finding::NoiseDiffers& f, const Scene& scene) {
  return {"the noise is " + reading(scene, f.channel, f.estimated) + ", " +
              brief(f.estimated / f.stated) + " times the " + reading(scene, f.channel, f.stated) +
              " that the scene states for " + channels(scene.sensor)[f.channel].name,
          noise_line(scene, f.channel, f.estimated)};
}
Words say(const finding::NoiseColoured& f, const Scene&) {
  return {"the noise is not white: what a reading is off in one frame it is off by " +
              percent(f.correlation) + " of that in the next",
          "a filter or slow electronics remembers: frames are not independent, and a mean of many "
          "is less sure than it looks"};
}
Words say(const finding::ResidualDiffers& f, const Scene&) {
  if (f.times < 1.0)
    return {"tractions explain the readings " + brief(1.0 / f.times) +
                " times better than the noise stated allows",
            "is noise.rms too large, or were the readings smoothed?"};
  return {"tractions leave " + brief(f.times) + " times the noise stated unexplained",
          "pad, depth, pitch or the gain of some taxels is not what the scene says; or noise.rms "
          "is too small"};
}
Words say(const finding::ScaleBy1000& f, const Scene& scene) {
  const bool small = f.times < 1.0;
  Words words{"what is left of the readings is " + brief(small ? 1.0 / f.times : f.times) +
                  " times " + (small ? "below" : "above") +
                  " the noise stated: are the readings in " + (small ? "kPa" : "mPa") +
                  ", the scene in Pa?",
              {}};
  if (!scene.units) {
    words.seen = "what is left of the readings is " + brief(small ? 1.0 / f.times : f.times) +
                 " times " + (small ? "below" : "above") +
                 " the noise stated: are readings and noise in the same unit, as Pa and " +
                 (small ? "kPa?" : "mPa?");
    words.advice = small ? "under [units], stress = \"kPa\", and noise.rms in kPa too; or, with "
                           "all else in SI, under [calibration], gain = 1000"
                         : "under [calibration], gain = 0.001";
    return words;
  }
  words.advice = small ? "under [units], stress = \"kPa\", and noise.rms in kPa too"
                       : "check stress under [units], gain under [calibration] and noise.rms";
  return words;
}

// --- sign, stiffness, geometry ------------------------------------------------------------------

Words say(const finding::WholePadPulled& f, const Scene&) {
  return {"the whole pad is pulled in " + std::to_string(f.pulled) + " of " +
              std::to_string(f.loaded) + " loaded frames",
          "compression is positive here: under [calibration], gain = -1 turns the sign"};
}
Words say(const finding::TractionExceedsModulus& f, const Scene&) {
  return {"the largest traction is " + brief(f.times) + " times Young's modulus: no pad bears that",
          "readings and youngs_modulus are in different units, or strains are in percent: see "
          "[units] and gain under [calibration]"};
}
Words say(const finding::DeformationTiny& f, const Scene&) {
  return {"the largest traction is only " + brief(f.times) + " of Young's modulus: hardly a touch",
          "are the readings in kPa and youngs_modulus in Pa? Under [units], stress = \"kPa\""};
}
Words say(const finding::MixedUnits& f, const Scene& scene) {
  return {"a modulus of " + in_unit(scene, Dimension::stress, f.modulus) + " and an array " +
              in_unit(scene, Dimension::length, f.length) +
              " long look like different units (Pa with mm, or MPa with m): forces come out in "
              "neither N/m nor N/mm",
          "state what they are: under [units], length = \"mm\" and modulus = \"Pa\", or as they "
          "are"};
}
Words say(const finding::DepthBeyondArray& f, const Scene& scene) {
  return {"the taxels lie " + in_unit(scene, Dimension::length, f.depth) +
              " deep, deeper than the array is long (" +
              in_unit(scene, Dimension::length, f.length) + "): it sees little but the force",
          "are depth and pitch in the same unit?"};
}
Words say(const finding::PitchCoarse& f, const Scene& scene) {
  return {"the taxels are " + in_unit(scene, Dimension::length, f.pitch) + " apart and only " +
              in_unit(scene, Dimension::length, f.depth) +
              " deep: what presses between two of them is missed",
          "are depth and pitch in the same unit? If so: a pitch of at most twice the depth"};
}

Words words_of(const lab::Finding& finding, const Scene& scene) {
  return std::visit([&](const auto& one) { return say(one, scene); }, finding);
}

std::string frames_in_words(const lab::ReadingsCheck& check) {
  std::string text = std::to_string(check.frames) + (check.frames == 1 ? " frame" : " frames") +
                     " of " + std::to_string(reading_count(check.scene.sensor)) + " readings";
  const lab::RecordingClock& clock = check.clock;
  if (clock.timed == 0) return text + ", without times";
  text += ", t from " + brief(clock.first, 6) + " to " + brief(clock.last, 6) + " s";
  if (const auto rate = clock.rate()) {
    text += ", " + brief(*rate, 4) + " frames/s";
    if (clock.longest > 3.0 / *rate)
      text += " on average, with a gap of " + duration(clock.longest);
  }
  return text;
}

std::string channel_in_words(const lab::ReadingsCheck& check, std::size_t index) {
  const lab::CheckedChannel& channel = check.channels[index];
  std::string text = channel.name + " from " + reading(check.scene, index, channel.least) + " to " +
                     reading(check.scene, index, channel.largest);
  if (channel.noise) {
    text += "; noise " + reading(check.scene, index, *channel.noise) + " rms";
    text += channel.stated ? ", stated " + reading(check.scene, index, *channel.stated)
                           : ", not stated: " + noise_line(check.scene, index, *channel.noise);
  } else if (channel.stated) {
    text += "; noise stated " + reading(check.scene, index, *channel.stated) + ", not judged";
  }
  return text;
}

std::string judged_in_words(const lab::ReadingsCheck& check) {
  if (check.still == 0)
    return "too few frames in which nothing moves: noise, baseline and drift are not judged";
  const std::string seen = "noise judged by " + std::to_string(check.still) + " of " +
                           std::to_string(check.sampled) +
                           " groups of three frames, in which nothing moves";
  if (check.quiet == 0) return seen + "; no rest comes back: baseline and drift are not judged";
  return seen + "; " + std::to_string(check.quiet) + " of them at rest";
}

}  // namespace

std::string in_words(const lab::Finding& finding, const Scene& scene) {
  return words_of(finding, scene).seen;
}

std::string advice(const lab::Finding& finding, const Scene& scene) {
  return words_of(finding, scene).advice;
}

std::vector<std::string> understood_in_words(const lab::ReadingsCheck& check) {
  std::vector<std::string> facts{frames_in_words(check)};
  if (check.frames == 0) return facts;
  for (std::size_t c = 0; c < check.channels.size(); ++c)
    facts.push_back(channel_in_words(check, c));
  if (check.peak)
    facts.push_back("largest reading " +
                    reading(check.scene, check.peak->channel, check.peak->reading) + ", in frame " +
                    std::to_string(check.peak->frame) + ": a normal traction of " +
                    in_unit(check.scene, Dimension::stress, check.peak->traction) +
                    ", a force of " + in_unit(check.scene, Dimension::force, check.peak->force));
  facts.push_back(judged_in_words(check));
  if (check.residual)
    facts.push_back("what no traction explains is " + brief(*check.residual) +
                    " times the noise stated, by " + std::to_string(check.solved) +
                    (check.solved == 1 ? " frame that was solved" : " frames that were solved"));
  return facts;
}

void print_check(std::ostream& out, const lab::ReadingsCheck& check) {
  out << sensor_in_words(check.scene) << "; " << material_in_words(check.scene) << '\n';
  for (const std::string& fact : understood_in_words(check)) out << "  " << fact << '\n';
  out << '\n';
  if (check.findings.empty()) out << "nothing suspicious\n";
  for (std::size_t i = 0; i < check.findings.size(); ++i) {
    const Words words = words_of(check.findings[i], check.scene);
    out << i + 1 << ". " << words.seen << "\n   -> " << words.advice << '\n';
  }
}

}  // namespace tactile_net::report
