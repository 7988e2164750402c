#include "tactile_net/system/printable.hpp"

#include "tests/catch.hpp"

using namespace tactile_net;

TEST_CASE("text that drives nothing stays as it is", "[printable]") {
  CHECK(printable("a\tb 1.5 µs \"left\" 手 😀") == "a\tb 1.5 µs \"left\" 手 😀");
  CHECK(printable("") == "");
}

TEST_CASE("what would drive a terminal is written as its number", "[printable]") {
  CHECK(printable("a\x1b[2Jb") == "a\\x1b[2Jb");                 // clears the screen
  CHECK(printable("\x1b]0;title\x07") == "\\x1b]0;title\\x07");  // sets the window's title
  CHECK(printable("\xC2\x9B"
                  "31m") == "\\x9b31m");  // the same in one code point
  CHECK(printable(std::string("\0\r\b\x7F", 4)) == "\\x00\\x0d\\x08\\x7f");
  CHECK(printable("a\nb") == "a\\x0ab");         // a second line could be a message of its own
  CHECK(printable("\xFF\xC3") == "\\xff\\xc3");  // not UTF-8
}

TEST_CASE("what would make a name look like another is written as its number", "[printable]") {
  CHECK(printable("exe.\u202Efdp.toml") == "exe.\\u202efdp.toml");
  CHECK(printable("a\u2028b\u2066c\u200F") == "a\\u2028b\\u2066c\\u200f");
}

TEST_CASE("of several lines only the line feeds stay", "[printable]") {
  CHECK(printable_lines("a\nb\r\x1b\n") == "a\nb\\x0d\\x1b\n");
}

TEST_CASE("a JSON document says the same, in its own escapes", "[printable]") {
  CHECK(printable_json("{\n\t\"a\": \"\x7F\u202E\xC2\x9B\"}") ==
        "{\n\t\"a\": \"\\u007f\\u202e\\u009b\"}");
}
