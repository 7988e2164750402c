#include "tests/catch.hpp"  // what is precompiled needs a file to belong to
