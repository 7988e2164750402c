#include "tactile_net/frames/output_file.hpp"

#include <cstdlib>
#include <iterator>
#include <sstream>

#include "tests/catch.hpp"

using namespace tactile_net::frames;
namespace fs = std::filesystem;

namespace {

/// A temporary folder that is removed at the end.
struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "tactile-net-frames-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  return names;
}

}  // namespace

TEST_CASE("a file is there as a whole or not at all", "[frames][output]") {
  const Folder folder;
  const fs::path path = folder.path / "f.txt";
  {
    OutputFile file(path);
    file.stream() << "half";
    CHECK_FALSE(file.is_direct());
    CHECK_FALSE(fs::exists(path));
  }
  CHECK(names_in(folder.path).empty());
  write_file(path, "one");
  CHECK(text_of(path) == "one");
  {
    OutputFile file(path);
    file.stream() << "two";
  }
  CHECK(text_of(path) == "one");
  CHECK(names_in(folder.path) == std::vector<std::string>{"f.txt"});
}

TEST_CASE("what is not whole stands under a name that says so", "[frames][output]") {
  const Folder folder;
  const fs::path path = folder.path / "f.csv";
  write_file(path, "whole");
  OutputFile file(path);
  file.stream() << "half";
  CHECK(file.commit_partial() == folder.path / "f.csv.partial");
  CHECK(text_of(folder.path / "f.csv.partial") == "half");
  CHECK(text_of(path) == "whole");
  std::ostringstream out;
  OutputFile direct("-", &out);
  direct.stream() << "half";
  CHECK(direct.commit_partial().empty());
  CHECK(out.str() == "half");
}

TEST_CASE("standard output is the stream that is passed", "[frames][output]") {
  std::ostringstream out;
  for (const char* path : {"-", ""}) {
    OutputFile file(path, &out);
    CHECK(file.is_direct());
    file.stream() << "text" << path;
    file.commit();
  }
  CHECK(out.str() == "text-text");
  std::ostringstream full;
  OutputFile file("-", &full);
  full.setstate(std::ios::badbit);
  CHECK_THROWS_AS(file.commit(), std::runtime_error);
}

TEST_CASE("a file that cannot be created is told before anything is written", "[frames][output]") {
  const Folder folder;
  CHECK_THROWS_AS(OutputFile(folder.path), CannotCreate);
  CHECK_THROWS_AS(OutputFile(folder.path / "none/f.txt"), CannotCreate);
  write_file(folder.path / "f.txt", "mine");
  CHECK_THROWS_AS(OutputFolder(folder.path / "f.txt"), CannotCreate);
  CHECK(text_of(folder.path / "f.txt") == "mine");
}

TEST_CASE("a folder's files appear together, and what else is there is returned",
          "[frames][output]") {
  const Folder folder;
  const fs::path path = folder.path / "out";
  {
    const OutputFolder abandoned(path);
    abandoned.write("a.csv", "0");
  }
  CHECK(names_in(folder.path).empty());
  OutputFolder first(path);
  first.write("a.csv", "1");
  CHECK_FALSE(fs::exists(path));
  CHECK(first.commit().empty());
  CHECK(text_of(path / "a.csv") == "1");

  for (const char* name : {"z.svg", "b.csv", "mine.txt"}) write_file(path / name, "mine");
  OutputFolder second(path);
  second.write("a.csv", "2");
  CHECK(second.commit() == std::vector<std::string>{"b.csv", "z.svg"});
  CHECK(text_of(path / "a.csv") == "2");
  CHECK(text_of(path / "b.csv") == "mine");

  OutputFolder third(path);
  third.write("b.csv", "3");
  third.write("d.csv", "3");
  fs::create_directory(path / "d.csv");
  CHECK_THROWS_AS(third.commit(), CannotCreate);
  CHECK(text_of(path / "b.csv") == "mine");
}
