// toml++: its functions, for all that includes it.
#define TOML_IMPLEMENTATION
// A damaged text can fail its assertions (parse_key), where it goes on to say what is wrong.
#define TOML_ASSERT(condition) static_cast<void>(0)
#include <toml++/toml.h>
