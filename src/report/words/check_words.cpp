#include "tactile_net/report/words/check_words.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "report/words/check_parts.hpp"
#include "tactile_net/numeric/counted.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/numeric/text.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/option_words.hpp"

namespace tactile_net::report {
namespace {

namespace finding = lab::finding;
using Indices = std::vector<std::size_t>;

std::string taxels(const auto& scene, const Indices& indices, const char* does, const char* do_) {
  std::vector<std::string> names;
  for (const std::size_t index : indices) names.push_back(taxel_name(scene.sensor, index));
  return (indices.size() == 1 ? "taxel " : "taxels ") + join(names, ", ") + ' ' +
         (indices.size() == 1 ? does : do_);
}

std::string times(std::size_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

/// Raw numbers that would read zero: the scene's own gain and offset are kept.
std::vector<double> baseline_of(const finding::Baseline& found, const Scene& scene) {
  std::vector<double> readings = found.values;
  if (scene.calibration)
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i] += scene.calibration->offset[i];
  return raw_numbers(scene, readings);
}

std::string dead_advice(const Indices& found, const auto& scene) {
  Indices all = scene.dead_taxels;
  all.insert(all.end(), found.begin(), found.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<std::string> indices;
  for (const std::size_t taxel : all) indices.push_back(index_of(scene, taxel));
  return "under [dead_taxels], indices = [" + join(indices, ", ") +
         "]: the answer is then found without " + (found.size() == 1 ? "it" : "them");
}

/// A line's scene has [calibration]; a skin's file is changed itself.
std::string by_calibration(const Scene&, const char* line, const char*) { return line; }
std::string by_calibration(const SkinScene&, const char*, const char* skin) { return skin; }

struct Words {
  std::string seen{};
  std::string advice{};
};

// --- frames

Words say(const finding::NoFrames&, const auto&) {
  return {"the recording holds no frame", "was it closed before it was copied?"};
}
Words say(const finding::TimeBackwards& f, const auto&) {
  const std::string seen =
      "time runs backwards " + times(f.count) + ", first at frame " + std::to_string(f.first);
  if (f.rollovers > 0)
    return {
        seen + ": a counter of 32 bits that begins anew behind 2^32 - 1",
        "add 4294967296 (2^32), in the counter's unit, to the times behind; forces do not depend "
        "on it"};
  return {seen,
          "are these several recordings in one file? Sort the rows by time, or "
          "cut the file there"};
}
Words say(const finding::TimeRepeats& f, const auto&) {
  return {"time stands still " + times(f.count) + ", first at frame " + std::to_string(f.first),
          "rows may stand twice, or the clock is too coarse: write times with more digits; seconds "
          "and nanoseconds in two columns are joined by " +
              option(Option::columns, "t=1+2")};
}
Words say(const finding::FramesRepeat& f, const auto&) {
  return {std::to_string(f.frames.count()) +
              " frames equal the frame before in every reading: " + in_words(f.frames),
          "a logger that is faster than the sensor writes rows twice: leave "
          "the copies out"};
}
Words say(const finding::ValuesMissing& f, const auto& scene) {
  Words words{std::to_string(f.values) + " values are missing, in " + in_words(f.frames), {}};
  if (f.taxels.empty()) {
    words.advice = "solve with " + option(Option::missing, "estimate") +
                   ", which finds such frames from the other taxels, or with " +
                   option(Option::missing, "skip") + ", which leaves them out";
  } else {
    words.seen +=
        "; " + taxels(scene, f.taxels, "misses", "miss") + " more than half of its frames";
    words.advice = dead_advice(f.taxels, scene);
  }
  return words;
}

Words say(const finding::CodesForMissing& f, const auto& scene) {
  std::vector<std::string> seen;
  std::vector<std::string> codes;
  if (scene.calibration)
    for (const double one : scene.calibration->missing) codes.push_back(shortest(one));
  for (const finding::CodesForMissing::Code& code : f.codes) {
    codes.push_back(shortest(code.number));
    seen.push_back(codes.back() + " (in " + std::to_string(code.fields) + " fields" +
                   (code.frames == 0 ? ""
                    : code.frames == 1
                        ? ", one whole frame among them"
                        : ", " + std::to_string(code.frames) + " whole frames among them") +
                   ")");
  }
  return {join(seen, ", ") + (f.codes.size() == 1 ? " stands" : " stand") +
              " far from all other numbers: codes for missing values? Nothing else was judged",
          "under [calibration], missing = [" + join(codes, ", ") +
              "]: these fields are then gaps; or numbers below zero lost their sign (255 of a byte "
              "is -1). Then check again"};
}

Words say(const finding::SignsLost& f, const auto& scene) {
  const auto all = channels(scene.sensor);
  std::vector<std::string> names;
  for (const std::size_t channel : f.channels) names.push_back(all[channel].name);
  return {"numbers of " + join(names, ", ") + " jump by nearly " + shortest(f.codes) + ", " +
              times(f.jumps) + ", and none lies between: those below zero lost their sign (" +
              shortest(f.codes - 2.0) + " is -2). Nothing else was judged",
          "read them as whole numbers with a sign: take " + shortest(f.codes) + " off those of " +
              shortest(0.5 * f.codes) + " and more"};
}

Words say(const finding::FramesNormalised& f, const auto&) {
  return {"the largest reading of " + std::to_string(f.frames) + " frames is the same number, " +
              shortest(f.number) +
              ", now one taxel's and now another's: each frame was divided by its own largest "
              "reading. Forces of such frames mean nothing, and nothing else was judged",
          "record the numbers before they are divided; where each frame's divisor was kept, "
          "multiply by it"};
}

/// "5", "2.1"
std::string frames_apart(double every) {
  return std::abs(every - std::round(every)) < 0.05 ? fixed(every, 0) : fixed(every, 1);
}

Words say(const finding::SlowChannels& f, const auto& scene) {
  const auto all = channels(scene.sensor);
  const auto rate = [&](std::size_t k) {
    return "new in one of " + frames_apart(f.every[k]) + " frames only (frame " +
           std::to_string(f.last[k]) + " is such a one)";
  };
  const std::string take =
      "take one of " + frames_apart(f.every.front()) + " frames, those in which they are new";
  if (f.all)
    return {"all readings are " + rate(0) + ": the file is written faster than the sensor reads",
            take + "; copies are no measurements, and their mean is not more certain"};
  std::vector<std::string> each;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < f.channels.size(); ++k) {
    names.push_back(all[f.channels[k]].name);
    each.push_back(names.back() + " is " + rate(k));
  }
  // Of five frames on average, which are 5.02 where the recording ends, the oldest value is 4 old.
  const double oldest = std::ceil(*std::max_element(f.every.begin(), f.every.end()) - 0.05) - 1.0;
  return {join(each, ", ") +
              ", while the others change: forces mix what is new with what is up to " +
              counted(static_cast<std::size_t>(oldest), "frame") + " old",
          take + "; or put values between those of " + join(names, " and ") +
              " that are new (interpolate), before the file is solved"};
}

// --- taxels

Words say(const finding::DeadTaxels& f, const auto& scene) {
  if (f.taxels.size() == taxels_of(scene))
    return {"no taxel feels anything in any frame",
            "is the sensor connected, and are these its columns? " + option(Option::columns) +
                " names others"};
  return {taxels(scene, f.taxels, "feels", "feel") +
              " nothing: zero in every frame, or silent while " +
              by_calibration(scene, "both", "all") + " neighbours feel a load",
          dead_advice(f.taxels, scene)};
}
Words say(const finding::StuckTaxels& f, const auto& scene) {
  return {taxels(scene, f.taxels, "is", "are") + " stuck: taxel " +
              taxel_name(scene.sensor, f.worst) + " holds one value for " +
              std::to_string(f.frames) + " frames, from frame " + std::to_string(f.first) +
              " on, though the others change",
          dead_advice(f.taxels, scene)};
}
Words say(const finding::NoisyTaxels& f, const auto& scene) {
  return {taxels(scene, f.taxels, "is", "are") + " noisy: taxel " +
              taxel_name(scene.sensor, f.worst) + " has " + brief(f.times) +
              " times the noise of the others",
          dead_advice(f.taxels, scene) + "; or mend the contact"};
}
Words say(const finding::SingleFrameSpikes& f, const auto& scene) {
  return {taxels(scene, f.taxels, "jumps", "jump") + " for single frames, " +
              std::to_string(f.frames) + " at least, and those beside do not: by " +
              brief(f.times) + " times the noise in taxel " + taxel_name(scene.sensor, f.worst) +
              ", frame " + std::to_string(f.frame) + "; no load does that",
          "a loose contact, or a bit lost on the way? empty these fields, and solve with " +
              option(Option::missing, "estimate") +
              ", which finds them from the other taxels; as they are, the verdict on the data of "
              "such frames is bad_taxel"};
}
Words say(const finding::EqualReadings& f, const auto& scene) {
  constexpr std::size_t most_named = 8;
  const bool of_one_channel = channels(scene.sensor).size() == 1;
  const std::vector<std::string> names = reading_names(scene.sensor);
  std::vector<std::string> groups;
  for (const Indices& group : f.groups) {
    if (groups.size() == most_named) break;
    std::vector<std::string> each;
    for (const std::size_t reading : group)
      each.push_back(of_one_channel ? taxel_name(scene.sensor, reading) : names[reading]);
    groups.push_back(join(each, " and "));
  }
  std::string seen = (of_one_channel ? "taxels " : "") + join(groups, ", ");
  if (groups.size() < f.groups.size())
    seen += ", and " + std::to_string(f.groups.size() - groups.size()) + " more,";
  return {seen + " are equal in all " + std::to_string(f.frames) +
              " frames, noise and all: they are one reading, there twice",
          "two inputs on one wire, or a column twice in the file? Until that is mended, " +
              dead_advice(f.taxels, scene) + "; the one that is right may stay"};
}
Words say(const finding::SaturatedTaxels& f, const auto& scene) {
  return {taxels(scene, f.taxels, "is", "are") + " cut off at the end of the range: " +
              std::to_string(f.frames) + " equal readings of " + reading(scene, 0, f.limit),
          "press less hard or set a larger range: what is cut off cannot be "
          "found again, and "
          "forces come out too small there"};
}
Words say(const finding::WornTaxels& f, const auto& scene) {
  return {taxels(scene, f.taxels, "reads", "read") +
              " far less than the other taxels predict: taxel " +
              taxel_name(scene.sensor, f.worst) + " " + brief(f.share, 2) +
              " times what a contact that explains the others would make it read",
          dead_advice(f.taxels, scene) + "; or calibrate their gains anew"};
}
Words say(const finding::TaxelsLeftOut& f, const auto& scene) {
  return {taxels(scene, f.taxels, "is", "are") +
              " left out of all frames, as if under [dead_taxels]: the recording shows " +
              (f.taxels.size() == 1 ? "it" : "them") + " to be dead, stuck or worn",
          dead_advice(f.taxels, scene) + " in every recording, streams too"};
}

// --- rest

std::string baseline_advice(const finding::Baseline&, const SkinScene&) {
  return "subtract the mean of frames without a load from the file's numbers; or under "
         "[reconstruct], "
         "offset = true finds a constant for each quantity";
}
std::string baseline_advice(const finding::Baseline& f, const Scene& scene) {
  constexpr std::size_t most_listed = 128;
  const std::vector<double> raw = baseline_of(f, scene);
  if (raw.size() > most_listed)
    return "under [calibration], baseline_frames = [FIRST, LAST], frames without a load; " +
           option(Option::json) + " has the baseline of every reading";
  std::string advice = "under [calibration], baseline = [";
  for (std::size_t i = 0; i < raw.size(); ++i) advice += (i > 0 ? ", " : "") + brief(raw[i], 5);
  return advice + "]";
}

Words say(const finding::Baseline& f, const auto& scene) {
  Words words{"the readings do not go back to zero: at rest (" + std::to_string(f.frames) +
                  " quiet frames) they are up to " + reading(scene, 0, f.largest) + " off, " +
                  brief(f.times) + " times the noise, and no load explains that",
              {}};
  if (f.loaded) {
    words.advice =
        "a contact seems to be in it too: record some frames without a load, "
        "and " +
        by_calibration(scene, "write under [calibration], baseline_frames = [FIRST, LAST]",
                       "take their mean off the file's numbers");
    return words;
  }
  words.advice = baseline_advice(f, scene);
  return words;
}
Words say(const finding::ZeroUnderLoad& f, const auto& scene) {
  const std::string frames =
      f.first == f.last ? "frame " + std::to_string(f.first)
                        : "frames " + std::to_string(f.first) + " to " + std::to_string(f.last);
  return {"in " + frames + " the pad is pulled with " +
              in_unit(scene.units, load_dimension(scene), f.force) +
              " as a contact would press: the zero was taken while something touched",
          f.first == f.last
              ? "take the zero anew, of frames in which nothing touches"
              : "take the zero of the frames that are loaded least: under [calibration], "
                "baseline_frames = [" +
                    std::to_string(f.first) + ", " + std::to_string(f.last) + "]"};
}
Words say(const finding::Drift& f, const auto& scene) {
  std::string seen = "the readings drift: at rest they change by up to " +
                     reading(scene, 0, f.largest) + " from frame " + std::to_string(f.from) +
                     " to frame " + std::to_string(f.to) + ", " + brief(f.times) +
                     " times the noise, and no load explains that";
  if (f.loaded)
    return {
        seen,
        "the sensor is loaded in every frame, so no frame is a zero: under [reconstruct], offset "
        "= true finds a constant for each quantity with the loads"};
  return {seen,
          "take the zero anew between presses (ContactEstimator::set_baseline "
          "does at run time), or "
          "cut the recording and " +
              by_calibration(scene, "give each part its own baseline_frames under [calibration]",
                             "take each part's own zero off its numbers") +
              (scene.reconstruct.offset ? ""
                                        : "; where all taxels drift alike, under [reconstruct], "
                                          "offset = true finds it in each frame")};
}

// --- noise and scale

Words say(const finding::NoiseTaken& f, const auto& scene) {
  const auto all = channels(scene.sensor);
  std::vector<std::string> each;
  for (std::size_t c = 0; c < all.size(); ++c)
    each.push_back(reading(scene, c, f.of_channel[c]) + " of " + all[c].name);
  return {"the scene states no noise: " + join(each, " and ") + ", as still frames show, is taken",
          all.size() == 1 ? noise_line(scene, 0, f.of_channel.front())
                          : "state it, an rms for each quantity, under [noise]"};
}
Words say(const finding::NoiseDiffers& f, const auto& scene) {
  return {"the noise is " + reading(scene, f.channel, f.estimated) + ", " +
              brief(f.estimated / f.stated) + " times the " + reading(scene, f.channel, f.stated) +
              " that the scene states for " + channels(scene.sensor)[f.channel].name,
          noise_line(scene, f.channel, f.estimated)};
}
Words say(const finding::NoiseColoured& f, const auto&) {
  return {
      "the noise is not white: what a reading is off in one frame it is "
      "off by " +
          percent(f.correlation) + " of that in the next",
      "a filter or slow electronics remembers: frames are not independent, "
      "and a mean of many "
      "is less sure than it looks"};
}
Words say(const finding::ResidualDiffers& f, const auto&) {
  if (f.times < 1.0)
    return {"tractions explain the readings " + brief(1.0 / f.times) +
                " times better than the noise stated allows",
            "is noise.rms too large, or were the readings smoothed?"};
  return {"tractions leave " + brief(f.times) + " times the noise stated unexplained",
          "pad, depth, pitch or the gain of some taxels is not what the scene "
          "says; or noise.rms "
          "is too small"};
}
Words say(const finding::ScaleBy1000& f, const auto& scene) {
  const bool small = f.times < 1.0;
  Words words{"what is left of the readings is " + brief(small ? 1.0 / f.times : f.times) +
                  " times " + (small ? "below" : "above") +
                  " the noise stated: are the readings in " + (small ? "kPa" : "mPa") +
                  ", the scene in Pa?",
              {}};
  if (!scene.units) {
    words.seen = "what is left of the readings is " + brief(small ? 1.0 / f.times : f.times) +
                 " times " + (small ? "below" : "above") +
                 " the noise stated: are readings and noise in the same unit, "
                 "as Pa and " +
                 (small ? "kPa?" : "mPa?");
    const std::string times = small ? "1000" : "0.001";
    words.advice =
        (small ? "under [units], stress = \"kPa\", and noise.rms in "
                 "kPa too; or, with "
                 "all else in SI, "
               : "") +
        by_calibration(scene, "under [calibration], gain = ", "multiply the file's numbers by ") +
        times;
    return words;
  }
  words.advice = small
                     ? std::string("under [units], stress = \"kPa\", and noise.rms in kPa too")
                     : "check stress under [units], " +
                           by_calibration(scene, "gain under [calibration] and ", "") + "noise.rms";
  return words;
}

// --- calibration

Words say(const finding::GainsChanged& f, const auto& scene) {
  const std::vector<std::string> names = reading_names(scene.sensor);
  std::vector<std::string> each;
  for (std::size_t i = 0; i < f.readings.size(); ++i)
    each.push_back(names[f.readings[i]] + (f.changes[i] > 0.0 ? " +" : " ") +
                   fixed(100.0 * f.changes[i], 1) + " ± " + fixed(100.0 * f.sds[i], 1) + " %");
  return {"recalibrate: " + join(each, ", ") +
              ": no load explains these beside the other readings with the gains of [calibration]",
          "press again, and calibrate: docs/calibration.md; gains about 1 % apart stay unseen"};
}

// --- sign, stiffness, geometry

Words say(const finding::WholePadPulled& f, const auto& scene) {
  return {"the whole pad is pulled in " + std::to_string(f.pulled) + " of " +
              std::to_string(f.loaded) + " loaded frames",
          "compression is positive here: " +
              by_calibration(scene, "under [calibration], gain = -1 turns the sign",
                             "turn the sign of the file's numbers")};
}
Words say(const finding::OrderMirrored& f, const Scene&) {
  return {"in " + std::to_string(f.frames) + " of " + std::to_string(f.of) +
              " loaded frames the readings fit better if the taxels are numbered from the other "
              "end of y",
          "reverse the order of each quantity's columns; if the order is right, change the sign of "
          "the shear"};
}
Words say(const finding::OrderMirrored& f, const SkinScene&) {
  std::vector<std::string> how;
  std::vector<std::string> instead;
  if (f.exchanged) {
    how.emplace_back("with rows and columns exchanged");
    instead.emplace_back("the names of what is read along y and along z");
  }
  if (f.along_y) {
    how.emplace_back("from the other end of y");
    instead.emplace_back("the sign of what is read along y");
  }
  if (f.along_z) {
    how.emplace_back("from the other end of z");
    instead.emplace_back("the sign of what is read along z");
  }
  return {"in " + std::to_string(f.frames) + " of " + std::to_string(f.of) +
              " loaded frames the readings fit better if the taxels are numbered " +
              join(how, " and "),
          "put the taxels into the scene's order; if the order is right, change " +
              join(instead, " and ")};
}
Words say(const finding::OrderSerpentine& f, const auto&) {
  const std::string what = f.columns ? "column" : "row";
  return {"in " + std::to_string(f.frames) + " of " + std::to_string(f.of) +
              " loaded frames the readings fit better if every second " + what + ", from " + what +
              ' ' + std::to_string(f.first) + " on, is read backwards",
          "is the skin wired in serpentines? Reverse the order of the taxels in " + what + "s " +
              std::to_string(f.first) + ", " + std::to_string(f.first + 2) +
              ", ... of the file's numbers"};
}
Words say(const finding::StrainTooLarge& f, const auto& scene) {
  return {"the readings say that the pad is strained by " + percent(f.strain) +
              ": a pad that is solved as linear cannot be",
          "displacements and pitch are in different units, or strains are in percent: see " +
              by_calibration(scene, "[units] and gain under [calibration]", "[units]") +
              "; of markers in pixels, gain is what a pixel measures"};
}
Words say(const finding::TractionExceedsModulus& f, const auto& scene) {
  return {
      "the largest traction is " + brief(f.times) + " times Young's modulus: no pad survives that",
      "readings and youngs_modulus are in different units, or strains are "
      "in percent: see " +
          by_calibration(scene, "[units] and gain under [calibration]", "[units]")};
}
Words say(const finding::DeformationTiny& f, const auto&) {
  return {"the largest traction is only " + brief(f.times) + " of Young's modulus: hardly a touch",
          "are the readings in kPa and youngs_modulus in Pa? Under [units], "
          "stress = \"kPa\""};
}
Words say(const finding::MixedUnits& f, const auto& scene) {
  return {"a modulus of " + in_unit(scene.units, Dimension::stress, f.modulus) + " and an array " +
              in_unit(scene.units, Dimension::length, f.length) +
              " long look like different units (Pa with mm, or MPa with m): "
              "forces come out in "
              "neither N/m nor N/mm",
          "state what they are: under [units], length = \"mm\" and modulus = "
          "\"Pa\", or as they "
          "are"};
}
Words say(const finding::DepthBeyondArray& f, const auto& scene) {
  return {"the taxels lie " + in_unit(scene.units, Dimension::length, f.depth) +
              " deep, deeper than the array is long (" +
              in_unit(scene.units, Dimension::length, f.length) + "): it sees little but the force",
          "are depth and pitch in the same unit?"};
}
Words say(const finding::PitchCoarse& f, const auto& scene) {
  return {"the taxels are " + in_unit(scene.units, Dimension::length, f.pitch) +
              " apart and only " + in_unit(scene.units, Dimension::length, f.depth) +
              " deep: what presses between two of them is missed",
          "are depth and pitch in the same unit? If so: a pitch of at most "
          "twice the depth"};
}

Words words_of(const lab::Finding& finding, const AnyScene& any) {
  return std::visit([](const auto& one, const auto& scene) { return say(one, scene); }, finding,
                    any);
}

}  // namespace

std::string in_words(const lab::Finding& finding, const AnyScene& scene) {
  return words_of(finding, scene).seen;
}

std::string advice(const lab::Finding& finding, const AnyScene& scene) {
  return words_of(finding, scene).advice;
}

}  // namespace tactile_net::report
