#include "tactile_net/system/file_lock.hpp"

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

struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "tactile-net-lock-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path path;
};

}  // namespace

TEST_CASE("who comes second is told who was first", "[lock]") {
  const Folder folder;
  const fs::path file = folder.path / "lock";
  {
    RunLock first;
    CHECK(first.take(file) == std::nullopt);
    RunLock second;
    CHECK(second.take(file) == LockOwner{::getpid(), ""});
  }
  CHECK_FALSE(fs::exists(file));
  RunLock third;
  CHECK(third.take(file) == std::nullopt);
}

TEST_CASE("the lock of a process that was killed is taken over", "[lock]") {
  const Folder folder;
  const fs::path file = folder.path / "lock";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    RunLock lock;
    if (lock.take(file)) ::_exit(1);
    std::ofstream(folder.path / "ready") << "x";
    for (;;) ::pause();
  }
  while (!fs::exists(folder.path / "ready")) ::usleep(1000);
  RunLock lock;
  CHECK(lock.take(file) == LockOwner{child, ""});
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(fs::exists(file));  // nobody could remove it
  CHECK(lock.take(file) == std::nullopt);
  RunLock another;
  CHECK(another.take(file) == LockOwner{::getpid(), ""});
}

TEST_CASE("a link in the place of a lock file is not followed", "[lock]") {
  const Folder folder;
  std::ofstream(folder.path / "mine") << "mine";
  fs::create_symlink(folder.path / "mine", folder.path / "lock");
  RunLock lock;
  CHECK(lock.take(folder.path / "lock") == std::nullopt);
  std::string text;
  std::ifstream(folder.path / "mine") >> text;
  CHECK(text == "mine");
}

TEST_CASE("where no lock can be made nobody is named", "[lock]") {
  RunLock lock;
  CHECK(lock.take("/proc/none/lock") == std::nullopt);
}

TEST_CASE("a machine of another name is named", "[lock]") {
  const Folder folder;
  const fs::path file = folder.path / "lock";
  RunLock first;
  CHECK(first.take(file) == std::nullopt);
  std::ofstream(file) << "77 elsewhere\n";
  RunLock second;
  CHECK(second.take(file) == LockOwner{77, "elsewhere"});
}
