#include "tactile_net/report/words/data_words.hpp"

#include "numeric/named.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/remark_words.hpp"

namespace tactile_net::report {
namespace {

constexpr Named<DataDoubt> doubt_sentences[] = {
    {DataDoubt::implausible,
     "the readings would strain the pad by more than its own size: check the units of the readings "
     "and of Young's modulus"},
    {DataDoubt::pulls,
     "only tractions that pull explain the readings, and no contact pulls: check that compression "
     "is positive, that the baseline is of an unloaded pad, and pad and depth"},
    {DataDoubt::bad_taxel, "one taxel contradicts all others: list it under [dead_taxels]"},
    {DataDoubt::offset,
     "a channel reads a constant too much, or one load lies over the whole array: take the "
     "baseline anew"},
    {DataDoubt::misfit,
     "no contact explains the readings within the noise stated: pad, depth, calibration or noise "
     "is not as the scene says"},
    {DataDoubt::friction_limit,
     "contacts explain the readings only with more friction than friction_limit allows: the limit "
     "may be too low, or the baseline or the gain of the readings of drag is wrong"},
};

std::string number_of(DataDoubt doubt, const lab::remark::DataDoubted& doubted) {
  const DataVerdict& data = doubted.data;
  switch (doubt) {
    case DataDoubt::implausible:
      return " (strain " + brief(data.strain) + ")";
    case DataDoubt::bad_taxel:
      return " (taxel " + doubted.taxel + ")";
    case DataDoubt::offset:
      return " (" + in_words(doubted.offsets) + ")";
    case DataDoubt::pulls:
    case DataDoubt::misfit:
    case DataDoubt::friction_limit:
      if (!(data.residual_limit > 0.0)) return {};  // the noise is not known
      return " (a contact leaves " + brief(data.residual_rms / data.residual_limit, 2) +
             " times as much as noise does)";
  }
  return {};
}

std::string word_of(const DataVerdict& data, const auto& name_of_taxel) {
  if (data.consistent()) return data.noise_known ? "ok" : "noise_unknown";
  std::string text;
  for (const DataDoubt doubt : data.doubts) {
    text += (text.empty() ? "" : "+") + std::string(name(doubt));
    if (doubt == DataDoubt::bad_taxel && data.taxel) text += "_" + name_of_taxel(*data.taxel);
  }
  return text;
}

}  // namespace

std::string_view in_words(DataDoubt doubt) noexcept { return name_in<doubt_sentences>(doubt); }

std::string in_words(const lab::remark::DataDoubted& doubted) {
  std::string text;
  for (const DataDoubt doubt : doubted.data.doubts)
    text += (text.empty() ? "" : "; ") + std::string(name(doubt)) + ": " +
            std::string(in_words(doubt)) + number_of(doubt, doubted);
  return text;
}

std::string data_word(const DataVerdict& data) {
  return word_of(data, [](std::size_t taxel) { return std::to_string(taxel); });
}

std::string data_word(const DataVerdict& data, const SkinScene& scene) {
  return word_of(data, [&](std::size_t taxel) { return taxel_name(scene.sensor, taxel); });
}

}  // namespace tactile_net::report
