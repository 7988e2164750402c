// What people's own files look like: each is either understood, with a note where something was
// taken for granted, or refused in words that say what was found and what to do.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "tactile_net/frames/csv.hpp"
#include "tactile_net/scene/diagnostic.hpp"
#include "tests/catch.hpp"

using namespace tactile_net;
using namespace tactile_net::frames;

namespace {

using Names = std::vector<std::string>;

const Names stress_columns{"stress_x_0", "stress_x_1", "stress_x_2", "stress_x_3"};

/// All that a file says.
struct Recording {
  std::vector<std::vector<double>> frames;
  Names times, notes, closing, ignored;
  bool has_time = false;
};

Recording read_csv(const std::string& text, const std::string& places = {}, bool missing = false) {
  std::istringstream in(text);
  CsvFrames source(in, "f.csv",
                   {.names = stress_columns, .places = places, .accept_missing = missing});
  Recording recording;
  std::vector<double> values(stress_columns.size());
  while (source.next(values)) {
    recording.frames.push_back(values);
    recording.times.emplace_back(source.time());
  }
  recording.has_time = source.has_time();
  recording.notes.assign(source.opening_notes().begin(), source.opening_notes().end());
  recording.ignored.assign(source.ignored().begin(), source.ignored().end());
  recording.closing = source.closing_notes();
  CHECK(source.bytes_read() == text.size());
  return recording;
}

std::string csv_refusal(const std::string& text, const std::string& places = {}) {
  try {
    (void)read_csv(text, places);
  } catch (const InputError& error) {
    return error.what();
  }
  return "was read";
}

const std::vector<std::vector<double>> two_frames{{1.5, 2.0, -3.0, 4e3}, {5.0, 6.0, 7.0, 8.0}};
const std::string plain_rows = "1.5,2,-3,4e3\n5,6,7,8\n";
const std::string plain = "stress_x_0,stress_x_1,stress_x_2,stress_x_3\n" + plain_rows;

}  // namespace

TEST_CASE("the same frames are read however the text is laid out", "[frames][reading]") {
  const std::string text = GENERATE_REF(values<std::string>({
      plain,
      "\xef\xbb\xbf" + plain,
      "\xef\xbb\xbfsep=;\nstress_x_0;stress_x_1;stress_x_2;stress_x_3\r\n1,5;2;-3;4e3\r\n5;6;7;8",
      "stress_x_0;stress_x_1;stress_x_2;stress_x_3\n1.5;2;-3;4e3\n5;6;7;8\n",
      "stress_x_0\tstress_x_1\tstress_x_2\tstress_x_3\n1,5\t2\t-3\t4e3\n5\t6\t7\t8\n",
      "stress_x_0,\tstress_x_1,\tstress_x_2,\tstress_x_3\n1.5,\t2,\t-3,\t4e3\n5,\t6,\t7,\t8\n",
      "stress_x_0 stress_x_1  stress_x_2 stress_x_3\n 1.5  2 -3 4e3\n5 6 7 8 \n",
      "stress_x_0 [Pa] stress_x_1 [Pa] stress_x_2 [Pa] stress_x_3 [Pa]\n1,5 2 -3 4e3\n5 6 7 8\n",
      "# a rig\n# of ours\n" + plain,
      "# stress_x_0,stress_x_1,stress_x_2,stress_x_3\n" + plain_rows,
      "# a rig\n# stress_x_0 stress_x_1 stress_x_2 stress_x_3\n1.5 2 -3 4e3\n5 6 7 8\n",
      "% stress_x_0,stress_x_1,stress_x_2,stress_x_3\n" + plain_rows,
      "\"stress_x_0\",\"stress_x_1\",\"stress_x_2\",\"stress_x_3\"\n\"1.5\",2,-3,4e3\n5,6,7,8\n",
      "\"a, b\",stress_x_0,stress_x_1,stress_x_2,stress_x_3\n\"1, 2\",1.5,2,-3,4e3\n,5,6,7,8\n",
      "\n" + plain + "\n\n",
      "stress_x_0,stress_x_1,stress_x_2,stress_x_3\nkPa,kPa,kPa,kPa\n" + plain_rows,
      "stress_x_0,stress_x_1,stress_x_2,stress_x_3\n[kPa],[kPa],,(kPa)\nch0,left,zeroed,\n" +
          plain_rows,
      "Logger 3000\nSerial number: 0007\nStart: 2026-01-05 10:11:12\n\n" + plain,
      "Rate,100\nRange,50\n" + plain,
      "a rig of ours,,,\n" + plain,
      "stress_x,,,\n0,1,2,3\n" + plain_rows,
      "name,stress_x_0,stress_x_1,stress_x_2,stress_x_3\npad,1.5,2,-3,4e3\npad,5,6,7,8\n",
      "%name,stress_x_0,stress_x_1,stress_x_2,stress_x_3\npad,1.5,2,-3,4e3\npad,5,6,7,8\n",
  }));
  CAPTURE(text);
  CHECK(read_csv(text).frames == two_frames);
}

TEST_CASE("names in another spelling are understood, and said", "[frames][reading]") {
  const auto [header, note] = GENERATE(table<std::string, std::string>({
      {"Stress_X_0,STRESS_X_1,stress_x_2,stress_x_3", "'Stress_X_0' as stress_x_0"},
      {"stress_x_00,stress_x_01,stress_x_02,stress_x_03", "'stress_x_00' as stress_x_0"},
      {"stress_x[0],stress_x[1],stress_x[2],stress_x[3]", "'stress_x[0]' as stress_x_0"},
      {"stress_x(0),stress_x(1),stress_x(2),stress_x(3)", "another spelling"},
      {"stress x 0,stress x 1,stress x 2,stress x 3", "another spelling"},
      {"stress-x-0,stress.x.1,stressx_2,stress_x3", "column 'stress_x_2' is missing"},
      {"stress_x_0 [Pa],stress_x_1 [Pa],stress_x_2 [Pa],stress_x_3 [Pa]", "unit [Pa]"},
      {"stress_x[0] (kPa),stress_x[1] (kPa),stress_x[2] (kPa),stress_x[3] (kPa)", "unit [kPa]"},
      {"taxel0,taxel1,taxel2,taxel3", "'taxel0' to 'taxel3' are taken for stress_x_0 to"},
      {"taxel_1,taxel_2,taxel_3,taxel_4", "'taxel_1' to 'taxel_4' are taken for"},
      {"Ch 00,Ch 01,Ch 02,Ch 03", "are taken for"},
      {"0,1,2,3", "'0' to '3' are taken for"},
      {"1,2,3,4", "'1' to '4' are taken for"},
  }));
  CAPTURE(header);
  const std::string text = header + "\n" + plain_rows;
  if (note.find("missing") != std::string::npos) {
    CHECK_THAT(csv_refusal(text), ContainsSubstring(note));
    return;
  }
  const Recording recording = read_csv(text);
  CHECK(recording.frames == two_frames);
  REQUIRE_FALSE(recording.notes.empty());
  CHECK_THAT(recording.notes.front() + recording.notes.back(), ContainsSubstring(note));
}

TEST_CASE("an exact name goes before one that is spelt otherwise", "[frames][reading]") {
  const Recording recording =
      read_csv("Stress_X_0,stress_x_0,stress_x_1,stress_x_2,stress_x_3\n9,1,2,3,4\n");
  CHECK(recording.frames == std::vector<std::vector<double>>{{1, 2, 3, 4}});
  CHECK(recording.ignored == Names{"Stress_X_0"});
  CHECK(recording.notes.empty());
}

TEST_CASE("numbered columns may stand in any order, beside an index", "[frames][reading]") {
  CHECK(read_csv(",taxel2,taxel0,taxel3,taxel1\n7,-3,1.5,4e3,2\n8,7,5,8,6\n").frames == two_frames);
  const Recording pandas = read_csv(",0,1,2,3\n0,1.5,2,-3,4e3\n1,5,6,7,8\n");
  CHECK(pandas.frames == two_frames);
  CHECK(pandas.ignored == Names{""});
}

TEST_CASE("a file without a header is read if it has just the columns", "[frames][reading]") {
  const Recording recording = read_csv(plain_rows);
  CHECK(recording.frames == two_frames);
  REQUIRE(recording.notes.size() == 1);
  CHECK_THAT(recording.notes[0], ContainsSubstring("no header: the 4 columns are taken for"));
}

TEST_CASE("what is not understood is refused with what was found, and a way out",
          "[frames][reading]") {
  const auto [text, message, hint] = GENERATE(table<std::string, std::string, std::string>({
      {"0.1,1,2,3,4\n", "no header: the first line holds numbers", "columns = t=1,2-5"},
      {"a,b,c,d\n1,2,3,4\n", "column 'stress_x_0' is missing and 3 more",
       "'a', 'b', 'c', 'd'; 4 are read here, stress_x_0 to stress_x_3"},
      {"a,b,c,d\n1,2,3,4\n", "missing", "columns = 1-4"},
      {"t,a,b,c,d\n1,2,3,4,5\n", "missing", "columns = t=1,2-5"},
      {"pressure_0,pressure_1,pressure_2,pressure_3\n", "missing", "columns = 1-4"},
      {"strain_x_0,strain_x_1,strain_x_2,strain_x_3\n", "missing", "columns = 1-4"},
      {"taxel0,taxel1,taxel2,taxel3,taxel4\n", "missing", "5 columns: 'taxel0', "},
      {"taxel0,taxel1,taxel2\n", "missing", "the header has 3 columns"},
      {"taxel0,taxel1,taxel2,taxel4\n", "missing", "columns = 1-4"},
      {"a|b|c|d\n", "missing", "1 column: 'a|b|c|d'; 4 are read here"},
      {"stress_x_0 [Pa],stress_x[0],stress_x_1,stress_x_2,stress_x_3\n", "may both be stress_x_0",
       "say which by columns"},
      {"stress_x_0,stress_x_1,stress_x_2,stress_x_3,stress_x_1\n", "f.csv:1:45", ""},
  }));
  CAPTURE(text);
  const std::string said = csv_refusal(text);
  CHECK_THAT(said, StartsWith("f.csv:1:") && ContainsSubstring(message) && ContainsSubstring(hint));
}

TEST_CASE("columns are read where a list says that they stand", "[frames][reading]") {
  const std::string rows = "0.5,9,1.5,2,-3,4e3\n0.6,9,5,6,7,8\n";
  const std::string named = "when,b,c,d,e,f\n" + rows;
  for (const char* places : {"3-6", "3,4,5-6", "c,d,e,f", "c,4-5,F"}) {
    CAPTURE(places);
    const Recording recording = read_csv(named, places);
    CHECK(recording.frames == two_frames);
    CHECK_FALSE(recording.has_time);
  }
  for (const std::string& text : {named, rows}) {
    const Recording recording = read_csv(text, "t=1,3-6");
    CHECK(recording.frames == two_frames);
    CHECK(recording.times == Names{"0.5", "0.6"});
    CHECK(recording.ignored.size() == 1);
  }
  CHECK(read_csv("6,5,4,3,2,1\n", "6,5,4,3").frames ==
        std::vector<std::vector<double>>{{1, 2, 3, 4}});
  CHECK(read_csv("t,b,c,d,e,f\n" + rows, "3-6").has_time);  // by its name
}

TEST_CASE("a row of numbers beside a word is a frame, not a header", "[frames][reading]") {
  const Recording recording = read_csv("7,pad,1.5,2,-3,4e3\n8,pad,5,6,7,8\n", "t=1,3-6");
  CHECK(recording.frames == two_frames);
  CHECK(recording.times == Names{"7", "8"});
  // Where the word's column holds numbers below, it names them.
  CHECK(read_csv("t,10,20,35,50\n7,1.5,2,-3,4e3\n8,5,6,7,8\n", "2-5").frames == two_frames);
}

TEST_CASE("numbers of columns below their names are no frame, and that is said",
          "[frames][reading]") {
  std::string names;
  std::string numbers;
  std::string row;
  for (int i = 0; i < 9; ++i) {
    const std::string comma = i > 0 ? "," : "";
    names += comma + (i < 4 ? "stress_x_" : "other_") + std::to_string(i);
    numbers += comma + std::to_string(i);
    row += comma + std::to_string(10 - i) + ".5";
  }
  const Recording recording = read_csv(names + "\n" + numbers + "\n" + row + "\n");
  CHECK(recording.frames == std::vector<std::vector<double>>{{10.5, 9.5, 8.5, 7.5}});
  REQUIRE(recording.notes.size() == 1);
  CHECK_THAT(recording.notes[0], ContainsSubstring("line 2"));
}

TEST_CASE("a file that is named has its frames counted from its first row", "[frames][reading]") {
  const std::string before = GENERATE("", "a logger of ours\n", "# made by hand\n\n");
  const std::string below = GENERATE("", "kPa,kPa,kPa,kPa\n");
  const auto lines = static_cast<int>(std::count(before.begin(), before.end(), '\n') +
                                      std::count(below.begin(), below.end(), '\n'));
  const std::string text = before + plain.substr(0, 44) + below + plain_rows + "1,2,x,4\n";
  CAPTURE(text);
  CHECK_THAT(csv_refusal(text), StartsWith("f.csv:" + std::to_string(lines + 4) + ":5"));
}

TEST_CASE("decimal commas, thousands and a matrix row a line are named", "[frames][reading]") {
  const std::string head = plain.substr(0, 44);
  const auto [text, hint] = GENERATE_COPY(table<std::string, std::string>({
      {head + "1,50,-2,00,3,10,4,00\n", "decimal commas"},
      {"1,50,-2,00,3,10,4,00\n", "decimal commas"},
      {head + "\"1,5\",\"2\",\"3\",\"4\"\n", "decimal comma"},
      {head + "\"1,234.5\",2,3,4\n", "thousands"},
      {"stress_x_0;stress_x_1;stress_x_2;stress_x_3\n1.234,5;2;3;4\n", "thousands"},
  }));
  CAPTURE(text);
  CHECK_THAT(csv_refusal(text), ContainsSubstring(hint));
  std::istringstream matrix("0.5,1\n2,3\n\n4,5\n6,7\n");
  const auto open = [&] {
    CsvFrames(matrix, "f.csv", {.names = stress_columns, .taxels = 4, .rows = 2});
  };
  CHECK_THROWS_WITH(open(), ContainsSubstring("join the 2 lines of a frame"));
}

namespace {

/// The seconds of every frame, and whether they are known to be seconds.
struct Clock {
  std::vector<double> seconds;
  Names times;
  bool known = true;
};

Clock clock_of(const std::string& text, const std::string& places = {}) {
  std::istringstream in(text);
  CsvFrames source(in, "f.csv", {.names = stress_columns, .places = places});
  Clock clock;
  std::vector<double> values(stress_columns.size());
  while (source.next(values)) {
    clock.seconds.push_back(source.seconds().value_or(-1.0));
    clock.times.emplace_back(source.time());
  }
  clock.known = source.time_unit_known();
  return clock;
}

}  // namespace

TEST_CASE("times are seconds by the unit in their name or by their size", "[frames][reading]") {
  const auto [name, first, second, step] =
      GENERATE(table<std::string, std::string, std::string, double>({
          {"t", "0", "0.25", 0.25},
          {"time_ms", "0", "10", 0.01},
          {"t [us]", "100", "350", 250e-6},
          {"timestamp_us", "100", "350", 250e-6},
          {"header.stamp_ns", "100", "350", 250e-9},
          {"timestamp", "1712345678950350000", "1712345678960350000", 0.01},
          {"timestamp", "1712345678950350", "1712345678960350", 0.01},
          {"time", "1712345678950", "1712345678960", 0.01},
          {"time", "1712345678.95", "1712345678.96", 0.01},
      }));
  CAPTURE(name, first);
  const Clock clock =
      clock_of(name + ',' + plain.substr(0, 44) + first + ",1,2,3,4\n" + second + ",1,2,3,4\n");
  CHECK(clock.known);
  CHECK(clock.times == Names{first, second});  // every digit
  REQUIRE(clock.seconds.size() == 2);
  CHECK_THAT(clock.seconds[1] - clock.seconds[0], WithinAbs(step, 5e-7) || WithinRel(step, 1e-9));
}

TEST_CASE("whole numbers of no stated unit are not called seconds", "[frames][reading]") {
  CHECK_FALSE(clock_of("t," + plain.substr(0, 44) + "0,1,2,3,4\n10,1,2,3,4\n").known);
  CHECK_FALSE(clock_of("t," + plain.substr(0, 44) + "0.0,1,2,3,4\n10.0,1,2,3,4\n").known);
  CHECK(clock_of("t [s]," + plain.substr(0, 44) + "0,1,2,3,4\n10,1,2,3,4\n").known);
}

TEST_CASE("seconds and nanoseconds in two columns are one time", "[frames][reading]") {
  const Names both{"1712345678.950000000", "1712345679.000000007"};
  const std::string rows = "1712345678,950000000,1.5,2,-3,4e3\n1712345679,7,5,6,7,8\n";
  for (const char* names : {"secs,nsecs,", "header.stamp.sec,header.stamp.nanosec,"}) {
    const Clock clock = clock_of(names + plain.substr(0, 44) + rows);
    CHECK(clock.times == both);
    CHECK(clock.known);
  }
  CHECK(clock_of(rows, "t=1+2,3-6").times == both);
  CHECK_THAT(csv_refusal("secs,nsecs," + plain.substr(0, 44) + "1,2000000000,1,2,3,4\n"),
             StartsWith("f.csv:2:3"));
}

TEST_CASE("a counter of 32 bits that begins anew is named", "[frames][reading]") {
  const std::string head = "timestamp_us," + plain.substr(0, 44);
  const Recording wraps = read_csv(head + "4294960000,1,2,3,4\n2704,1,2,3,4\n");
  CHECK(wraps.closing.size() == 2);
  CHECK(read_csv(head + "4000,1,2,3,4\n2704,1,2,3,4\n").closing.size() == 1);
}

TEST_CASE("a list of columns that does not fit is refused in words", "[frames][reading]") {
  const auto [places, message] = GENERATE(table<std::string, std::string>({
      {"1-3", "names 3 columns of readings, and 4 are read"},
      {"2-9", "there is no column 9: the file has 5"},
      {"0-3", "there is no column 0"},
      {"4-1", "runs backwards"},
      {"1,1,2,3", "column 1 stands twice"},
      {"t=1,1-4", "column 1 stands twice"},
      {"t=1,t=2,2-5", "two columns of times"},
      {"a,b,c,x", "the file has no column 'x'"},
      {"1,,2,3", "an item is empty"},
      {"t=1+2,2-5", "column 2 stands twice"},
      {"t=1+,2-5", "no column ''"},
      {"1-99999999999999999999", "no column"},
      {"", ""},
  }));
  CAPTURE(places);
  if (places.empty()) return;
  CHECK_THROWS_WITH(read_csv("a,b,c,d,e\n1,2,3,4,5\n", places),
                    StartsWith("columns: ") && ContainsSubstring(message));
}

TEST_CASE("a column of times is kept, by any of its names, wherever it stands",
          "[frames][reading]") {
  const std::string name =
      GENERATE("t", "T", "time", "Time", "TIME [s]", "t [s]", "time_s", "t (s)", "\"t [ms]\"");
  CAPTURE(name);
  const Recording first = read_csv(name + "," + plain.substr(0, 43) + "\n0.5,1.5,2,-3,4e3\n");
  const Recording last = read_csv(plain.substr(0, 43) + "," + name + "\n1.5,2,-3,4e3,0.5\n");
  for (const Recording& recording : {first, last}) {
    CHECK(recording.has_time);
    CHECK(recording.times == Names{"0.5"});
    CHECK(recording.ignored.empty());
    CHECK(recording.notes.size() == (name.find("ms") != std::string::npos ? 1u : 0u));
  }
}

TEST_CASE("what is not a time is none", "[frames][reading]") {
  for (const char* name : {"T [K]", "T (degC)", "temperature", "t1", "index"}) {
    CAPTURE(name);
    CHECK_FALSE(read_csv(std::string(name) + "," + plain.substr(0, 43) + "\n1,1,2,3,4\n").has_time);
  }
  const Recording both = read_csv("time,t," + plain.substr(0, 43) + "\n7,8,1,2,3,4\n");
  CHECK(both.times == Names{"8"});
  CHECK(both.ignored == Names{"time"});
}

TEST_CASE("times may be dates, and with decimal commas are written with points",
          "[frames][reading]") {
  const std::string head = "t;" + std::string("stress_x_0;stress_x_1;stress_x_2;stress_x_3\n");
  CHECK(read_csv(head + "0,25;1;2;3;4\n").times == Names{"0.25"});
  CHECK(read_csv(head + "2024-05-01T12:00:00.5Z;1;2;3;4\n").times ==
        Names{"2024-05-01T12:00:00.5Z"});
  CHECK_THAT(csv_refusal(head + "soon;1;2;3;4\n"),
             ContainsSubstring("'soon' is not a number (column t)"));
  CHECK_THAT(csv_refusal(head + "1\"x;1;2;3;4\n"), ContainsSubstring("f.csv:2:1"));
}

TEST_CASE("time that runs backwards is noted with its place", "[frames][reading]") {
  const std::string head = "t," + plain.substr(0, 43) + "\n";
  CHECK(read_csv(head + "1,1,2,3,4\n1,1,2,3,4\n2,1,2,3,4\n").closing.empty());
  const Recording back = read_csv(head + "1,1,2,3,4\n3,1,2,3,4\n2,1,2,3,4\n1,1,2,3,4\n");
  REQUIRE(back.closing.size() == 1);
  CHECK_THAT(back.closing[0], ContainsSubstring("backwards 2 times, first at frame 2 (line 4)"));
}

TEST_CASE("values that are missing are NaN where that is accepted, and refused elsewhere",
          "[frames][reading]") {
  const std::string field = GENERATE("", " ", "nan", "NaN", "NA", "n/a", "null", "None", "-",
                                     "#DIV/0!", "#N/A", "inf", "-Inf", "\"\"", "<NA>");
  CAPTURE(field);
  const std::string text = "t," + plain.substr(0, 43) + "\n0,1,2,3,4\n1,1," + field + ",3,4\n";
  const Recording recording = read_csv(text, {}, true);
  REQUIRE(recording.frames.size() == 2);
  CHECK(std::isnan(recording.frames[1][1]));
  CHECK(recording.frames[1][2] == 3.0);
  const std::string said = csv_refusal(text);
  CHECK_THAT(said, StartsWith("f.csv:3:5: error: ") && ContainsSubstring("(column stress_x_1)") &&
                       ContainsSubstring("missing = skip"));
}

TEST_CASE("what is no value is an error whatever is accepted", "[frames][reading]") {
  const std::string row = GENERATE("1,abc,3,4", "1,0x1F,3,4", "1,1e999,3,4", "1,2,3", "1,2,3,4,5",
                                   "1,\"1,234\",3,4", "1,1.2.3,3,4");
  CAPTURE(row);
  CHECK_THROWS_AS(read_csv(plain + row + "\n", {}, true), InputError);
}

TEST_CASE("numbers with a comma and with a point do not stand in one file", "[frames][reading]") {
  const std::string head = "stress_x_0;stress_x_1;stress_x_2;stress_x_3\n";
  CHECK_THAT(
      csv_refusal(head + "1,5;2;3;4\n1.234;2;3;4\n"),
      StartsWith("f.csv:3:1: error: '1.234' has a decimal point, a number before it a comma"));
  CHECK_THAT(csv_refusal(head + "1.5;2;3,5;4\n"), ContainsSubstring("'3,5' has a decimal comma"));
  CHECK_THAT(csv_refusal(head + "1.234,5;2;3;4\n"), ContainsSubstring("not a number"));
}

TEST_CASE("files of another kind are named as such, with the way out", "[frames][reading]") {
  using namespace std::string_literals;
  const auto [start, message, hint] = GENERATE(table<std::string, std::string, std::string>({
      {"\xff\xfet\0,\0a\0\n\0"s, "is UTF-16", "iconv"},
      {"\xfe\xff\0t\0,\0a\0\n"s, "is UTF-16", "iconv"},
      {"t\0,\0a\0\n\0"s, "is UTF-16", "iconv"},
      {"\0t\0,\0a\0\n"s, "is UTF-16", "iconv"},
      {"PK\x03\x04 and more"s, "zip archive, as .npz and .xlsx files are", "numpy.load"},
      {"\x1f\x8b\x08"s, "compressed by gzip", "gunzip -c"},
      {"\x89HDF\r\n"s, "HDF5", "numpy.save"},
      {"%PDF-1.4\n"s, "PDF", "CSV"},
      {"abc\0\0\0\n"s, "holds a zero byte", "CSV file or a .npy"},
      {"stress_x_0,stress_x_1\r1,2\r"s, "old Macs", "tr "},
  }));
  CAPTURE(message);
  CHECK_THAT(csv_refusal(start), ContainsSubstring(message) && ContainsSubstring(hint));
  CHECK_THAT(csv_refusal(start + std::string(3'000'000, 'x')), ContainsSubstring(message));
}

TEST_CASE("a header alone is no frames", "[frames][reading]") {
  CHECK(read_csv(plain.substr(0, 44)).frames.empty());
  CHECK(read_csv("# stress_x_0,stress_x_1,stress_x_2,stress_x_3\n").frames.empty());
  CHECK_THAT(csv_refusal(""), ContainsSubstring("the file is empty"));
  CHECK_THAT(csv_refusal(std::string(2'000'000, 'x')), ContainsSubstring("longer than"));
  CHECK_THAT(csv_refusal("\xef\xbb\xbf"), ContainsSubstring("the file is empty"));
}
