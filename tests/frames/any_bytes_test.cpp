// Any bytes are frames or an InputError: drawn at random, and real files with a few bytes changed.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "frames/npy.hpp"
#include "tactile_net/frames/board_file.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"
#include "tests/damaged.hpp"

using namespace tactile_net;
using namespace tactile_net::frames;

namespace {

constexpr std::size_t readings = 3;

/// Reads all; true if it was frames, each of which is as it must be.
template <class Frames>
bool is_read(const std::string& bytes, const std::string& places, bool missing) {
  std::istringstream in(bytes);
  try {
    Frames source(in, "f",
                  {.names = {"stress_x_0", "stress_x_1", "stress_x_2"},
                   .unread = {false, true, false},
                   .taxels = readings,
                   .places = places,
                   .accept_missing = missing});
    std::vector<double> values(readings);
    for (std::size_t frames = 0; source.next(values); ++frames) {
      CHECK(frames <= bytes.size());
      CHECK(values[1] == 0.0);
      CHECK((missing || (std::isfinite(values[0]) && std::isfinite(values[2]))));
      CHECK_FALSE(std::isinf(values[0]));
      CHECK(source.time().find_first_of(",;\"\n") == std::string_view::npos);
    }
    return true;
  } catch (const InputError& error) {
    CHECK(error.diagnostics().size() == 1);
    CHECK(error.diagnostics()[0].file == "f");
  } catch (const std::invalid_argument& error) {
    CHECK_THAT(std::string(error.what()), StartsWith("columns: "));
  }
  return false;
}

template <class Frames>
std::size_t count_read(const std::vector<std::string>& seeds, const std::string& letters) {
  std::mt19937 draw(7);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(draw() % n); };
  std::size_t read = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes;
    if (round % 4 == 0) {
      for (std::size_t left = below(120); left > 0; --left)
        bytes += round % 8 == 0 ? static_cast<char>(below(256)) : letters[below(letters.size())];
    } else {
      bytes = seeds[below(seeds.size())];
      for (std::size_t left = below(5); left > 0 && !bytes.empty(); --left) {
        const std::size_t at = below(bytes.size());
        if (round % 3 == 0)
          bytes.erase(at, 1 + below(4));
        else if (round % 3 == 1)
          bytes[at] = letters[below(letters.size())];
        else
          bytes.insert(at, bytes.substr(below(bytes.size()), below(20)));
      }
    }
    CAPTURE(round, bytes);
    const char* places[] = {"", "", "2-4", "t=1,2-4", "1,3,2"};
    if (is_read<Frames>(bytes, places[below(5)], below(2) == 0)) ++read;
  }
  return read;
}

std::string npy(const std::string& dictionary, std::size_t bytes) {
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(dictionary.size()) + '\0' +
         dictionary + std::string(bytes, '\x3f');
}

}  // namespace

TEST_CASE("any text is frames or is refused in words", "[frames][fuzz]") {
  const std::size_t read = count_read<CsvFrames>(
      {"t,stress_x_0,stress_x_1,stress_x_2\n0,1,2,3\n1,4,5,6\n",
       "stress_x_0;stress_x_1;stress_x_2\n1,5;2,5;3\n4;;nan\n",
       "# stress_x_0 stress_x_1 stress_x_2\n1 2 3\n4 5 6\n", "1\t2\t3\n4\t5\t6\n",
       "\xef\xbb\xbfsep=;\n\"taxel 1\";\"taxel 2\";\"taxel 3\"\r\n1;2;3\r\n",
       "time [s],a,b,c\n2024-01-01,1,2,3\n"},
      "0123456789.,;\t \n\r\"#-+eExnaNAstr_[]()%=\xef\xbb\xbf");
  CHECK(read > 100);
  CHECK(read < 2900);
}

TEST_CASE("any bytes are an array of frames or are refused in words", "[frames][fuzz]") {
  const std::size_t read = count_read<NpyFrames>(
      {npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", 48),
       npy("{'descr': '>i2', 'fortran_order': True, 'shape': (5, 4), }", 40),
       npy("{'descr': '|u1', 'fortran_order': True, 'shape': (7, 1, 3), }", 21),
       npy("{'descr': '<f4', 'fortran_order': False, 'shape': (3,), }", 12)},
      "0123456789, ()'<>|bfiu:{}TrueFals\x93");
  CHECK(read > 100);
  CHECK(read < 2900);
}

TEST_CASE("any bytes are a board's responses or are refused in words", "[frames][fuzz]") {
  const auto path = std::filesystem::temp_directory_path() /
                    ("tactile-net-responses-" + std::to_string(getpid()) + ".csv");
  const std::vector<std::string> inputs = {"I0", "I1"};
  const std::vector<std::string> outputs = {"n0", "n1"};
  const std::vector<std::string> seeds = {
      "I0,I1,n0,n1\n1e-3,0,0.5,0.1\n0,1e-3,0.1,0.5\n",
      "\xef\xbb\xbf# at rest, and a voltage that is not known\r\nn1,n0,x,I1,I0\r\n"
      "0.01,0.02,a,0,0\r\n0.2,,b,0,1e-3\r\n0.1,nan,c,1e-3,0\r\n"};
  std::mt19937 random(3);
  int taken = 0;
  constexpr int rounds = 2000;
  for (int round = 0; round < rounds; ++round) {
    const std::string bytes =
        test::damaged(seeds[random() % 2], "0123456789.,;\"\n\r\te-In#", random);
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    CAPTURE(round, bytes);
    try {
      const BoardResponses read = read_board_file(path, inputs, outputs, 0.0);
      ++taken;
      CHECK(read.currents.rows == read.voltages.rows);
      CHECK((read.noise > 0.0 && std::isfinite(read.noise)));
      for (const double ampere : read.currents.values) CHECK(std::isfinite(ampere));
      for (const double volt : read.voltages.values) CHECK_FALSE(std::isinf(volt));
    } catch (const InputError& error) {
      CHECK(error.diagnostics().size() == 1);
      CHECK(error.diagnostics()[0].file == path.string());
    }
  }
  std::filesystem::remove(path);
  CHECK(taken > rounds / 50);
  CHECK(taken < rounds);
}

TEST_CASE("a board's responses are read as instruments and spreadsheets write them", "[frames]") {
  const auto path = std::filesystem::temp_directory_path() /
                    ("tactile-net-measured-" + std::to_string(getpid()) + ".csv");
  const std::vector<std::string> inputs = {"I0", "I1"};
  const std::vector<std::string> outputs = {"n0", "n1"};
  const auto read = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
    return read_board_file(path, inputs, outputs, 0.0);
  };
  const std::string text = "I0,I1,n0,n1\n0,0,0.25,0\n0.5,0,1.5,0.125\n0,0.5,-0.5,2.5\n";
  const BoardResponses plain = read(text);
  CHECK(plain.voltages.values == std::vector<double>{1.25, 0.125, -0.75, 2.5});
  const auto with = [](std::string changed, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = changed.find(from, at)) != changed.npos; at += to.size())
      changed.replace(at, from.size(), to);
    return changed;
  };
  const std::string semicolons = with(text, ",", ";");
  for (const std::string& other :
       {with(text, "\n", "\r\n"), "\xef\xbb\xbf" + text, with(text, ",", "\t"), semicolons,
        with(semicolons, ".", ","), with(with(text, "n0", "\"n0\""), "1.5", "\"1.5\"")}) {
    CAPTURE(other);
    const BoardResponses found = read(other);
    CHECK(found.currents.values == plain.currents.values);
    CHECK(found.voltages.values == plain.voltages.values);
    CHECK(found.noise == plain.noise);
  }
  // The rest is the mean of what is known of it; a voltage may be missing, a current not.
  CHECK(read(text + "0,0,NaN,\n").voltages.values == plain.voltages.values);
  CHECK(std::isnan(read(with(text, "1.5", "n/a")).voltages(0, 0)));
  CHECK_THROWS_WITH(read(with(text, "0.5,0,", "nan,0,")), ContainsSubstring("ampere"));
  // Squares of such would overflow, and explain any board.
  for (const char* number : {"1e308", "-2e6"})
    CHECK_THROWS_WITH(read(with(text, "1.5", number)), ContainsSubstring("no board has"));
  CHECK_THROWS_WITH(read(with(text, "0.5,0,", "1e7,0,")), ContainsSubstring("no board has"));
  std::filesystem::remove(path);
}
