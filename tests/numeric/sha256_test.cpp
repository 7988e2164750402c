#include "tactile_net/numeric/sha256.hpp"

#include <string>

#include "tests/catch.hpp"

using namespace tactile_net;

// FIPS 180-4's own examples, and the million "a" of NIST's.
TEST_CASE("digests are those of the standard", "[sha256]") {
  CHECK(sha256_text("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_text("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_text(std::string(1'000'000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("every length around a block's end has a digest of its own", "[sha256]") {
  std::string last;
  for (std::size_t size = 50; size < 140; ++size) {
    const std::string digest = sha256_text(std::string(size, '\0'));
    CHECK(digest != last);
    last = digest;
  }
}
