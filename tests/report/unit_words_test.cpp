#include "tactile_net/report/words/unit_words.hpp"

#include "tactile_net/lab/data_verdict.hpp"
#include "tactile_net/numeric/number_text.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/remark_words.hpp"
#include "tactile_net/report/words/summary_words.hpp"
#include "tactile_net/scene/reader.hpp"
#include "tests/catch.hpp"

namespace tactile_net::report {
namespace {

TEST_CASE("a scene without units has bare numbers", "[unit_words]") {
  const Scene scene;
  CHECK(in_unit(scene, Dimension::stress, 4810.0) == brief(4810.0));
  CHECK(in_unit(scene, Dimension::stress, 4810.0, 20.0) == plus_minus(4810.0, 20.0));
  const ScaledUnit axis = axis_unit(scene, Dimension::length, 0.01);
  CHECK(axis.label == "unit of length");
  CHECK(axis.factor == 1.0);
}

TEST_CASE("a scene with units has the SI unit of each dimension", "[unit_words]") {
  Scene scene;
  scene.units.emplace();
  CHECK(in_unit(scene, Dimension::stress, 4810.0) == "4.81 kPa");
  CHECK(in_unit(scene, Dimension::force, 0.98) == "0.98 N/m");
  CHECK(in_unit(scene, Dimension::length, 1.2e-3) == "1.2 mm");
  CHECK(in_unit(scene, Dimension::none, 1.2e-3) == "0.0012");
  const ScaledUnit axis = axis_unit(scene, Dimension::length, 0.01);
  CHECK(axis.label == "mm");
  CHECK(axis.factor == 1000.0);
}

TEST_CASE("what is said of a reading has the names and the units of its scene", "[unit_words]") {
  const std::string rest =
      "pitch = 2.0\ndepth = 1.0\n[material]\nyoungs_modulus = 200.0\npoisson_ratio = 0.45\n";
  const std::string units = "[units]\nlength = \"mm\"\nmodulus = \"kPa\"\nstress = \"kPa\"\n";
  const std::string line = "[sensor]\ncount = 9\nreads = [\"stress_x\", \"strain_x\"]\n" + rest;
  const DataVerdict data{
      .doubts = {DataDoubt::bad_taxel, DataDoubt::offset}, .taxel = 5, .offset = {4810.0, 2e-4}};
  const auto said = [&](const std::string& text) {
    const Scene scene = parse_scene(text, "pad.toml");
    const std::string words = in_words(lab::data_doubted(data, scene));
    CHECK(in_words(lab::Remark(lab::data_doubted(data, scene))) == words);
    CHECK_THAT(words, ContainsSubstring("(taxel 5)") &&
                          ContainsSubstring("(stress_x " +
                                            in_unit(scene, Dimension::stress, data.offset[0]) +
                                            ", strain_x " + brief(data.offset[1]) + ")"));
    return words;
  };
  CHECK_THAT(said(units + line), ContainsSubstring("4.81 kPa"));
  CHECK_THAT(said(line), !ContainsSubstring("Pa"));

  // The same taxel of a skin of three rows is one name, whoever speaks of it.
  const AnyScene skin = parse_any_scene(
      "[sensor]\nrows = 3\ncolumns = 4\nreads = [\"stress_x\"]\n" + rest, "skin.toml");
  const std::string name = taxel_name(std::get<SkinScene>(skin).sensor, 5);
  CHECK(name == "1_1");
  CHECK_THAT(data_word(data, std::get<SkinScene>(skin)), StartsWith("bad_taxel_" + name + "+"));
  lab::SolvedFrames solved;
  solved.frames = 2;
  solved.bad_taxels[5] = 2;
  CHECK_THAT(in_words(solved, skin).back(), ContainsSubstring(": " + name + " in 2 frames"));
}

}  // namespace
}  // namespace tactile_net::report
