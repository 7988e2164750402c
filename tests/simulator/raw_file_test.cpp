#include "tactile_net/simulator/raw_file.hpp"

#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>

#include "tests/catch.hpp"

using namespace tactile_net;

namespace {

/// A raw file in the temporary folder, removed at the end.
class File {
 public:
  explicit File(const std::string& content) { std::ofstream(path_, std::ios::binary) << content; }
  ~File() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                ("tactile-net-test-" + std::to_string(::getpid()) + ".raw");
};

std::string header(const std::string& flags, const std::string& points, const std::string& form) {
  return "Title: * test\nDate: today\nPlotname: Operating Point\nFlags: " + flags +
         "\nNo. Variables: 2\nNo. Points: " + points +
         "\nVariables:\n\t0\tV(N0)\tvoltage\n\t1\tv(n1)\tvoltage\n" + form + ":\n";
}

template <std::size_t n>
std::string bytes(const std::array<double, n>& values) {
  std::string text(n * sizeof(double), '\0');
  std::memcpy(text.data(), values.data(), text.size());
  return text;
}

}  // namespace

TEST_CASE("binary real values are read point by point", "[raw_file]") {
  const File file(header("real", "2       ", "Binary") + bytes<4>({1.0, 2.0, 3.0, 4.0}));
  const RawFile raw = read_raw_file(file.path());
  CHECK(raw.title == "* test");
  CHECK(raw.plot == "Operating Point");
  CHECK(raw.points == 2);
  CHECK(raw.vector("v(n0)")[1] == 3.0);
  CHECK(raw.vector("v(n1)")[0] == 2.0);
  CHECK(raw.imaginary.empty());
}

TEST_CASE("binary complex values are read in pairs", "[raw_file]") {
  const File file(header("complex", "1", "Binary") + bytes<4>({1.0, 2.0, 3.0, 4.0}));
  const RawFile raw = read_raw_file(file.path());
  CHECK(raw.values[1][0] == 3.0);
  CHECK(raw.imaginary[1][0] == 4.0);
}

TEST_CASE("a frequency's imaginary part is 0, whatever the file holds", "[raw_file]") {
  std::string content = header("complex", "1", "Binary") + bytes<4>({1.0, 2.0, 3.0, 4.0});
  content.replace(content.find("V(N0)\tvoltage"), 13, "frequency\tfrequency\tgrid=3");
  const File file(content);
  const RawFile raw = read_raw_file(file.path());
  CHECK(raw.vector("frequency")[0] == 1.0);
  CHECK(raw.imaginary[0][0] == 0.0);
  CHECK(raw.imaginary[1][0] == 4.0);
}

TEST_CASE("the text form is read too", "[raw_file]") {
  const File file(header("real", "1", "Values") + "0\t1.5\n\t-2.5e-3\n");
  const RawFile raw = read_raw_file(file.path());
  CHECK(raw.vector("v(n1)")[0] == -2.5e-3);
}

TEST_CASE("a short or lying file is an error, never a stale number", "[raw_file]") {
  const auto refused = [](const std::string& content) {
    const File file(content);
    CHECK_THROWS_AS(read_raw_file(file.path()), std::runtime_error);
  };
  refused("");
  refused("garbage");
  refused(header("real", "2", "Binary") + bytes<3>({1.0, 2.0, 3.0}));
  refused(header("real", "1000000000000000000", "Binary") + bytes<2>({1.0, 2.0}));
  refused(header("real", "-1", "Binary"));
  refused(header("real", "1", "Values") + "0\t1.5\n");
  refused(header("real", "1", "Values") + "0\t1.5\tabc\n");
  refused(header("real", "1", "Nothing"));
  CHECK_THROWS_WITH(read_raw_file("no-such.raw"), ContainsSubstring("no such raw file"));
}

TEST_CASE("a vector that is not there is named", "[raw_file]") {
  const File file(header("real", "1", "Binary") + bytes<2>({1.0, 2.0}));
  CHECK_THROWS_WITH((void)read_raw_file(file.path()).vector("v(n7)"), ContainsSubstring("v(n7)"));
}
