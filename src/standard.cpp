#include "standard.hpp"  // what is precompiled needs a file to belong to
