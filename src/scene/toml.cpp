// toml++: its functions, for all that includes it.
#define TOML_IMPLEMENTATION
#include <toml++/toml.h>
