// In children of their own: what a signal handler would do, done.
#include "tactile_net/system/leftovers.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/catch.hpp"

using namespace tactile_net;
namespace fs = std::filesystem;

namespace {

fs::path made_folder() {
  std::string name = (fs::temp_directory_path() / "tactile-net-left-XXXXXX").string();
  REQUIRE(::mkdtemp(name.data()) != nullptr);
  return name;
}

/// Runs it in a child that ends without any destructor. @return its exit status
int in_child(const auto& what) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    what();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("files and whole folders go, and what was released stays", "[leftovers]") {
  const fs::path folder = made_folder();
  for (const char* name : {"file", "kept"}) std::ofstream(folder / name) << "x";
  fs::create_directories(folder / "tree/below/deeper");
  for (int i = 0; i < 300; ++i)  // more than one read of the folder's entries
    std::ofstream(folder / "tree/below" / ("a-file-with-a-long-name-" + std::to_string(i))) << "x";
  CHECK(in_child([&] {
          const Leftover file(folder / "file");
          const Leftover tree(folder / "tree");
          Leftover kept(folder / "kept");
          kept.release();
          remove_leftovers();
        }) == 0);
  CHECK_FALSE(fs::exists(folder / "file"));
  CHECK_FALSE(fs::exists(folder / "tree"));
  CHECK(fs::exists(folder / "kept"));
  fs::remove_all(folder);
}

TEST_CASE("a link in a folder that goes is removed, not followed", "[leftovers]") {
  const fs::path folder = made_folder();
  fs::create_directories(folder / "mine");
  std::ofstream(folder / "mine/data") << "x";
  fs::create_directories(folder / "tree");
  fs::create_symlink(folder / "mine", folder / "tree/link");
  CHECK(in_child([&] {
          const Leftover tree(folder / "tree");
          remove_leftovers();
        }) == 0);
  CHECK_FALSE(fs::exists(folder / "tree"));
  CHECK(fs::exists(folder / "mine/data"));
  fs::remove_all(folder);
}

TEST_CASE("a child goes with its group", "[leftovers]") {
  CHECK(in_child([] {
          const pid_t child = ::fork();
          if (child == 0) {
            ::setpgid(0, 0);
            ::alarm(20);  // if nobody ends it
            for (;;) ::pause();
          }
          const LeftoverChild entered(child);
          remove_leftovers();
          if (::kill(child, 0) == 0) ::_exit(1);
        }) == 0);
}

TEST_CASE("a forked child removes nothing of its parent's", "[leftovers]") {
  const fs::path folder = made_folder();
  const Leftover mine(folder);
  CHECK(in_child([] { remove_leftovers(); }) == 0);
  CHECK(fs::exists(folder));
  fs::remove_all(folder);
}

TEST_CASE("the table is full at some time, and empties again", "[leftovers]") {
  const fs::path folder = made_folder();
  CHECK(in_child([&] {
          for (int round = 0; round < 3; ++round) {
            std::vector<Leftover> many;
            for (int i = 0; i < 100; ++i) many.emplace_back(folder / "none");
          }
          const Leftover last(folder);
          remove_leftovers();
        }) == 0);
  CHECK_FALSE(fs::exists(folder));
}
