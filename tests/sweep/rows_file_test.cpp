#include "tactile_net/sweep/rows_file.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tactile_net/frames/cannot_create.hpp"
#include "tactile_net/numeric/sha256.hpp"
#include "tactile_net/sweep/merge.hpp"
#include "tests/catch.hpp"
#include "tests/sweep/small_study.hpp"

using namespace tactile_net;
using test::StudyFolder;
namespace fs = std::filesystem;

namespace {

const std::string two_points =
    "scene = \"pad.toml\"\n[[axis]]\nkey = \"sensor.depth\"\nvalues = [1, 2]\n";

/// Two rows for a point, as by two methods.
std::vector<sweep::Row> rows_of(const sweep::Study& study, std::size_t index, double error = 0.5) {
  std::vector<sweep::Row> rows;
  for (const char* method : {"tikhonov", "dft"}) {
    const sweep::Point point = study.point(index);
    rows.push_back({.index = index, .seed = point.seed, .method = method, .verdict = "ok"});
    for (const AxisValue& value : point.values) rows.back().values.push_back(value.plain);
    rows.back().error = error;
  }
  return rows;
}

struct Files {
  StudyFolder folder;
  sweep::Study study = folder.study(two_points);
  std::string head = sweep::text(sweep::head_of(study));
  std::string first = sweep::lines(rows_of(study, 0), study.keep());
  std::string second = sweep::lines(rows_of(study, 1), study.keep());

  [[nodiscard]] sweep::Table merged(const std::vector<std::string>& names) const {
    std::vector<fs::path> files;
    for (const std::string& name : names) files.push_back(folder / name);
    return sweep::merge(files);
  }
};

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("the order of files and of points in them is nothing to the table", "[sweep]") {
  const Files in_order;
  in_order.folder.write("a.csv", in_order.head + in_order.first + in_order.second);
  const sweep::Table table = in_order.merged({"a.csv"});
  CHECK(table.rows.size() == 4);
  CHECK(table.sha256 == sha256_text(table.csv));
  CHECK(table.csv.starts_with("index,sensor.depth,seed,method,alpha,verdict,error,"));

  const Files apart;
  apart.folder.write("a.csv", apart.head + apart.second);
  apart.folder.write("b.csv", apart.head + apart.first + apart.first);
  apart.folder.write("begun.csv", apart.head.substr(0, 30));
  CHECK(apart.merged({"a.csv", "b.csv"}).csv == table.csv);
  CHECK(apart.merged({"begun.csv", "b.csv", "a.csv"}).csv == table.csv);
}

TEST_CASE("a file that was cut anywhere lacks points, and is gone on with", "[sweep]") {
  const Files files;
  const std::string whole = files.head + files.first + files.second;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // Every place around a line's end, and some of the others.
    const std::size_t end = whole.find('\n', size);
    if (end - size > 2 && size % 23 != 0) continue;
    const fs::path path = files.folder.write("a.csv", whole.substr(0, size));
    CAPTURE(size);
    const bool has_first = size >= files.head.size() + files.first.size();
    {
      sweep::Rows rows(sweep::head_of(files.study));
      rows.add(path);
      if (rows.points().size() != (has_first ? 1 : 0)) FAIL("half a point was taken for a whole");
      sweep::RowsFile file(files.study, path);
      if (file.rows().has(0) != has_first || file.rows().has(1)) FAIL("as read alone");
      const std::string kept = test::content(path);
      if (kept != files.head + (has_first ? files.first : ""))
        FAIL("what stays is not whole points behind a whole head");
      if (!has_first) file.append(files.first);
      file.append(files.second);
    }
    if (test::content(path) != whole) FAIL("it does not end as if it had not been cut");
  }
}

TEST_CASE("points that no file has are counted and named", "[sweep]") {
  const Files files;
  files.folder.write("a.csv", files.head + files.second);
  CHECK_THROWS_AS(files.merged({"a.csv"}), sweep::MissingPoints);
  CHECK_THROWS_WITH(files.merged({"a.csv"}), StartsWith("point 0 of 2 is missing"));
  const std::string half = files.second.substr(0, files.second.find('\n') + 1);
  files.folder.write("a.csv", files.head + files.first + half);
  CHECK_THROWS_WITH(files.merged({"a.csv"}), StartsWith("point 1 of 2 is missing"));
  CHECK_THROWS_WITH(throw sweep::MissingPoints({3, 7, 8, 9, 12}, 20),
                    StartsWith("5 of 20 points are missing, 3, 7:10, 12:"));
}

TEST_CASE("files of other studies, other versions and others' own are refused and stay",
          "[sweep]") {
  const Files files;
  const auto refused = [&](const std::string& text) {
    const fs::path path = files.folder.write("a.csv", text);
    const std::string why = refusal([&] { sweep::Rows(sweep::head_of(files.study)).add(path); });
    CHECK(refusal([&] { sweep::RowsFile(files.study, path); }) == why);
    CHECK(test::content(path) == text);
    return why;
  };
  sweep::RowsHead other = sweep::head_of(files.study);
  other.study[0] = other.study[0] == 'a' ? 'b' : 'a';
  CHECK_THAT(refused(sweep::text(other)), ContainsSubstring("the rows of another study"));
  other = sweep::head_of(files.study);
  other.version = "0.0.1";
  CHECK_THAT(refused(sweep::text(other)), ContainsSubstring("written by tactile-net 0.0.1"));
  CHECK_THAT(refused("dear diary\nmonday\n"), ContainsSubstring("is not a file of rows"));
  CHECK_THAT(refused("no line's end"), ContainsSubstring("is not a file of rows"));
  CHECK_THAT(refused(files.head + "1/2,0,garbage\n" + files.first),
             ContainsSubstring("a.csv:3: error: is not a row of this sweep"));
  CHECK_THAT(refused(files.head + std::string(40, '\0') + '\n'),
             ContainsSubstring("is not a row of this sweep"));
  CHECK_THAT(refused(files.head + files.first + files.head),
             ContainsSubstring("a.csv:5: error: is not a row of this sweep"));
  CHECK_THAT(refused(files.head + files.first +
                     sweep::lines(rows_of(files.study, 0, 0.6), kept_by_default())),
             ContainsSubstring("has another answer to point 0"));
  CHECK(refused(files.head + files.first).empty());
}

TEST_CASE("what is no file is known at once", "[sweep]") {
  const Files files;
  const auto open = [&](const fs::path& path) { sweep::RowsFile(files.study, path); };
  CHECK_THROWS_AS(open(files.folder / "."), frames::CannotCreate);
  CHECK_THROWS_AS(open(files.folder / "none/rows.csv"), frames::CannotCreate);
  CHECK_THROWS_AS(open("/dev/null"), frames::CannotCreate);
  CHECK_THAT(refusal([&] { (void)files.merged({"."}); }), ContainsSubstring("is a folder"));
  CHECK_THAT(refusal([&] { (void)files.merged({"none"}); }), ContainsSubstring("cannot be read"));
  CHECK_THAT(refusal([&] { (void)files.merged({}); }), ContainsSubstring("has no row"));
}

TEST_CASE("a file has one writer at a time", "[sweep]") {
  const Files files;
  const fs::path path = files.folder / "rows.csv";
  {
    const sweep::RowsFile file(files.study, path);
    CHECK_THROWS_WITH(sweep::RowsFile(files.study, path),
                      ContainsSubstring("another sweep writes into this file"));
  }
  CHECK(sweep::RowsFile(files.study, path).rows().points().empty());

  // A child on its way to another program has the file too, and keeps nobody from it.
  auto file = std::make_unique<sweep::RowsFile>(files.study, path);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::pause();
    ::_exit(0);
  }
  file.reset();
  CHECK_NOTHROW(sweep::RowsFile(files.study, path));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST_CASE("a point that a full disk has no room for leaves nothing", "[sweep]") {
  const Files files;
  const fs::path path = files.folder / "rows.csv";
  sweep::RowsFile file(files.study, path);
  file.append(files.first);
  const std::string before = test::content(path);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlim_t all = limit.rlim_cur;
  limit.rlim_cur = before.size() + 10;
  ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::string why;
  try {
    file.append(files.second);
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  limit.rlim_cur = all;
  ::setrlimit(RLIMIT_FSIZE, &limit);
  CHECK_THAT(why, ContainsSubstring("rows.csv could not be written"));
  CHECK(test::content(path) == before);
  file.append(files.second);
  CHECK(files.merged({"rows.csv"}).rows.size() == 4);
}
