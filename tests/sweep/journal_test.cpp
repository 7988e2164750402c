#include "tactile_net/sweep/journal.hpp"

#include <filesystem>
#include <fstream>
#include <string>

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
    sweep::Row row = sweep::failed_row(study.point(index), "");
    row.method = method;
    row.verdict = "ok";
    row.error = error;
    rows.push_back(row);
  }
  return rows;
}

struct Journals {
  StudyFolder folder;
  sweep::Study study = folder.study(two_points);
  std::string head = sweep::text(sweep::head_of(study));
  std::string first = sweep::lines(rows_of(study, 0), study.keep());
  std::string second = sweep::lines(rows_of(study, 1), study.keep());

  [[nodiscard]] sweep::Rows read(const std::string& name) const {
    sweep::Rows rows(sweep::head_of(study));
    rows.add(folder / name);
    return rows;
  }
  [[nodiscard]] sweep::Table merged() const {
    return sweep::merge(std::vector<fs::path>{folder / "."});
  }
};

}  // namespace

TEST_CASE("the order of journals and lines is nothing to the table", "[sweep]") {
  const Journals in_order;
  in_order.folder.write("a.journal", in_order.head + in_order.first + in_order.second);
  const sweep::Table table = in_order.merged();
  CHECK(table.rows.size() == 4);
  CHECK(table.sha256 == sha256_text(table.csv));
  CHECK(table.csv.starts_with("index,sensor.depth,seed,method,alpha,verdict,error,"));

  const Journals apart;
  apart.folder.write("a.journal", apart.head + apart.second);
  fs::create_directory(apart.folder / "shard");
  apart.folder.write("shard/b.journal", apart.head + apart.first + apart.first);
  CHECK(apart.merged().csv == table.csv);
}

TEST_CASE("a torn last line is no row, wherever it was torn", "[sweep]") {
  const Journals journals;
  const std::string whole = journals.head + journals.first + journals.second;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    // Every place around a line's end, and some of the others.
    const std::size_t end = whole.find('\n', size);
    if (end - size > 2 && size % 23 != 0) continue;
    const fs::path file = journals.folder.write("a.journal", whole.substr(0, size));
    const std::size_t expected = size < journals.head.size() + journals.first.size() ? 0 : 1;
    if (journals.read("a.journal").done() != expected) {
      CAPTURE(size);
      FAIL("a torn line was taken for a row, or a whole one was not");
    }
    sweep::drop_torn_line(file);
    const std::string kept = test::content(file);
    if (!(kept.empty() || (kept.ends_with('\n') && kept.size() >= journals.head.size())) ||
        !whole.starts_with(kept)) {
      CAPTURE(size, kept);
      FAIL("what stays is not whole lines behind a whole head");
    }
    std::ofstream(file, std::ios::app)
        << (kept.empty() ? journals.head : "") << journals.first << journals.second;
    if (journals.read("a.journal").done() != 2) FAIL("what is appended then is not read");
  }
}

TEST_CASE("points that no journal has are counted, and the first is named", "[sweep]") {
  const Journals journals;
  journals.folder.write("a.journal", journals.head + journals.second);
  CHECK_THROWS_AS(journals.merged(), sweep::MissingPoints);
  CHECK_THROWS_WITH(journals.merged(), StartsWith("point 0 of 2 is missing"));
}

TEST_CASE("half of a point's methods are not the point", "[sweep]") {
  const Journals journals;
  const std::string half = journals.second.substr(0, journals.second.find('\n') + 1);
  journals.folder.write("a.journal", journals.head + journals.first + half);
  CHECK_THROWS_WITH(journals.merged(), StartsWith("point 1 of 2 is missing"));
}

TEST_CASE("an answer counts more than a worker's death, in any order", "[sweep]") {
  const Journals journals;
  const std::string death = sweep::death_line(
      sweep::failed_row(journals.study.point(1), "its worker died"), journals.study.keep());
  journals.folder.write("a.journal", journals.head + journals.first + death);
  CHECK(journals.merged().rows.back().failure == "its worker died");
  journals.folder.write("b.journal", journals.head + journals.second);
  const std::string csv = journals.merged().csv;
  journals.folder.write("c.journal", journals.head + death);
  CHECK(journals.merged().csv == csv);
  CHECK(csv.find("died") == csv.npos);
}

TEST_CASE("journals of other studies, other versions and others' files are refused", "[sweep]") {
  const Journals journals;
  const auto refusal = [&](const std::string& text) {
    journals.folder.write("a.journal", text);
    try {
      (void)journals.read("a.journal");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  sweep::JournalHead other = sweep::head_of(journals.study);
  other.hash[0] = other.hash[0] == 'a' ? 'b' : 'a';
  CHECK_THAT(refusal(sweep::text(other)), ContainsSubstring("the journal of another study"));
  other = sweep::head_of(journals.study);
  other.version = "0.0.1";
  CHECK_THAT(refusal(sweep::text(other)), ContainsSubstring("written by tactile-net 0.0.1"));
  CHECK_THAT(refusal("dear diary\nmonday\n"), ContainsSubstring("is not a journal of a sweep"));
  CHECK_THAT(refusal(journals.head + "1/2,0,garbage\n" + journals.first),
             ContainsSubstring("a.journal:3: error: is not a row of this sweep"));
  CHECK_THAT(refusal(journals.head + std::string(40, '\0') + '\n'),
             ContainsSubstring("is not a row of this sweep"));
  CHECK_THAT(refusal(journals.head + journals.first +
                     sweep::lines(rows_of(journals.study, 0, 0.6), kept_by_default())),
             ContainsSubstring("has another answer to point 0"));
  CHECK(refusal(journals.head + journals.first).empty());
}

TEST_CASE("folders without journals say so", "[sweep]") {
  const StudyFolder folder;
  CHECK_THROWS_WITH(sweep::merge(std::vector<fs::path>{folder / "."}),
                    ContainsSubstring("holds no journal of a sweep"));
  CHECK_THROWS_WITH(sweep::merge(std::vector<fs::path>{folder / "none"}),
                    ContainsSubstring("is not a folder"));
}
