// Any bytes are frames or an InputError: drawn at random, and real files with a few bytes changed.
#include <cmath>
#include <random>
#include <sstream>

#include "frames/npy.hpp"
#include "tactile_net/frames/csv.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

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
