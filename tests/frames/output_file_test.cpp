#include "tactile_net/frames/output_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tactile_net/frames/folder_lock.hpp"
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

TEST_CASE("who writes a file while another does has its own, and the last one stands",
          "[frames][output]") {
  const Folder folder;
  const fs::path path = folder.path / "f.txt";
  OutputFile one(path);
  OutputFile two(path);
  one.stream() << "one";
  two.stream() << "the other";
  one.commit();
  CHECK(text_of(path) == "one");
  two.commit();
  CHECK(text_of(path) == "the other");
  CHECK(names_in(folder.path) == std::vector<std::string>{"f.txt"});
}

TEST_CASE("a file that is replaced keeps who may read and write it", "[frames][output]") {
  const Folder folder;
  const fs::path out = folder.path / "out";
  const auto permissions = [](const fs::path& path) { return fs::status(path).permissions(); };
  {
    OutputFolder first(out);
    first.write("f.csv", "1");
    CHECK(first.commit().empty());
  }
  write_file(folder.path / "new", "");
  std::ofstream(folder.path / "own") << "";
  CHECK(permissions(folder.path / "new") == permissions(folder.path / "own"));
  CHECK(permissions(out / "f.csv") == permissions(folder.path / "own"));

  for (const unsigned mode : {0600U, 0640U, 0444U, 0664U}) {
    CAPTURE(mode);
    const auto stated = static_cast<fs::perms>(mode);
    fs::permissions(out / "f.csv", stated);
    fs::create_symlink("f.csv", out / "link");
    for (const fs::path& name : {out / "f.csv", out / "link"}) {
      OutputFile file(name);
      file.stream() << "secret" << std::flush;
      // Nor is it open to more while it is being written.
      for (const std::string& there : names_in(out))
        CHECK((permissions(out / there) & ~stated & ~fs::perms::owner_all) == fs::perms::none);
      file.commit();
      CHECK(permissions(out / "f.csv") == stated);
    }
    OutputFile half(out / "f.csv");
    (void)half.commit_partial();
    CHECK(permissions(out / "f.csv.partial") == stated);
    fs::remove(out / "f.csv.partial");
    fs::remove(out / "link");
    OutputFolder again(out);
    again.write("f.csv", "2");
    CHECK(again.commit().empty());
    CHECK(permissions(out / "f.csv") == stated);
  }
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
  fs::create_symlink("nowhere", folder.path / "link");
  CHECK_THROWS_WITH(OutputFolder(folder.path / "link"),
                    ContainsSubstring("a link to a folder that is not there"));
  CHECK_THROWS_WITH(OutputFolder(folder.path / std::string(300, 'x')),
                    ContainsSubstring("cannot be created: File name too long"));
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

TEST_CASE("one run at a time writes into a folder, by whatever name", "[frames][output]") {
  const Folder folder;
  fs::create_directory(folder.path / "out");
  fs::create_directory_symlink(folder.path / "out", folder.path / "link");
  {
    const OutputFolder first(folder.path / "out");
    for (const fs::path& name :
         {folder.path / "out", folder.path / "out/", folder.path / "./out", folder.path / "link"})
      CHECK_THROWS_WITH(OutputFolder(name),
                        ContainsSubstring(name.string()) &&
                            ContainsSubstring("process " + std::to_string(::getpid())));
    const OutputFolder other(folder.path / "other");
  }
  CHECK_NOTHROW(OutputFolder(folder.path / "out"));
  const FolderLock lock(folder.path / "out");
  CHECK_THROWS_AS(FolderLock(folder.path / "out"), CannotCreate);
}

TEST_CASE("what killed runs left of an output goes when it is written anew", "[frames][output]") {
  const Folder folder;
  const auto hour_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const char* name : {"f.csv.partial-1", "f.csv.partial-22", "f.csv.partial-mine",
                           "g.csv.partial-1", "f.csv.partial-", "locked.partial-1"}) {
    std::ofstream(folder.path / name) << "half";
    fs::last_write_time(folder.path / name, hour_ago);
  }
  std::ofstream(folder.path / "f.csv.partial-3") << "young";  // may be about to be locked
  const auto lock = tactile_net::FileLock::of(folder.path / "locked.partial-1");
  REQUIRE(lock.has_value());
  write_file(folder.path / "f.csv", "whole");
  write_file(folder.path / "locked", "whole");
  std::vector<std::string> names = names_in(folder.path);
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"f.csv", "f.csv.partial-", "f.csv.partial-3",
                                          "f.csv.partial-mine", "g.csv.partial-1", "locked",
                                          "locked.partial-1"});

  fs::create_directory(folder.path / "out.partial-9");
  std::ofstream(folder.path / "out.partial-9/report.html") << "half";
  fs::last_write_time(folder.path / "out.partial-9", hour_ago);
  { const OutputFolder out(folder.path / "out"); }
  CHECK_FALSE(fs::exists(folder.path / "out.partial-9"));
}

TEST_CASE("a full disk is named with its reason, whoever writes", "[frames][output]") {
  const std::string reason = "/dev/full could not be written: No space left on device";
  CHECK_THROWS_WITH(write_file("/dev/full", "x"), ContainsSubstring(reason));
  CHECK_THROWS_WITH(write_file("/dev/full", std::string(1 << 20, 'x')), ContainsSubstring(reason));
  OutputFile file("/dev/full");
  const std::string block(1 << 16, 'x');
  CHECK_THROWS_WITH(file.stream().write(block.data(), std::ssize(block)),
                    ContainsSubstring(reason));
}
