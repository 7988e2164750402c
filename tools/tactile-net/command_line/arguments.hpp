/// @file
/// How a command says which arguments it takes, and where their values go.
///
///     Arguments arguments(command);
///     arguments.add_option("-o,--output", options.output, output_file({"cir"}), "Deck");
///     arguments.add_choice("--precision", options.precision, all_precisions, "Of the plan");
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line/table.hpp"
#include "commands/share.hpp"
#include "tactile_net/numeric/text.hpp"

namespace tactile_net::tool {

// What values are.
[[nodiscard]] Value text(std::string name);
[[nodiscard]] Value number();
[[nodiscard]] Value file(std::string name = "FILE", std::vector<std::string> endings = {});
[[nodiscard]] Value output_file(std::vector<std::string> endings);
/// One that goes to standard output where nobody names a file.
[[nodiscard]] Value main_output(std::vector<std::string> endings);
[[nodiscard]] Value folder();
[[nodiscard]] Value choice(std::vector<std::string> choices);

// Text read into what a command's options hold. @throw std::invalid_argument  it is no number
void read(const std::string& text, std::string& value);
void read(const std::string& text, double& value);
void read(const std::string& text, std::size_t& value);
void read(const std::string& text, Share& value);

template <class T>
void read(const std::string& text, std::optional<T>& value) {
  T inner{};
  read(text, inner);
  value = std::move(inner);
}

/// Items between commas, as "1.0,1.5".
template <class T>
void read(const std::string& text, std::vector<T>& values) {
  values.clear();
  for (const std::string_view item : split(text, ','))
    read(std::string(item), values.emplace_back());
}

// What help says of a value that nobody gave; empty: nothing.
[[nodiscard]] std::string standard(const std::string& value);
[[nodiscard]] std::string standard(double value);

template <class T>
[[nodiscard]] std::string standard(const std::optional<T>& /*value*/) {
  return {};
}

template <class T>
[[nodiscard]] std::string standard(const std::vector<T>& /*values*/) {
  return {};
}

class Arguments {
 public:
  /// @param command  must outlive this, and what the values go into the command's parsing
  explicit Arguments(CommandTable& command) : command_(command) {}

  /// @param names  "-o,--output"; without a dash, "SCENE", an argument known by its place
  template <class T>
  Argument& add_option(const std::string& names, T& target, Value value, std::string text) {
    return add(names, std::move(value), std::move(text), standard(target),
               [&target](const std::string& given) { read(given, target); });
  }

  /// One or more, known by their place: the last that a command takes.
  Argument& add_list(const std::string& name, std::vector<std::string>& target, Value value,
                     std::string text) {
    Argument& argument = add(name, std::move(value), std::move(text), {},
                             [&target](const std::string& given) { target.push_back(given); });
    argument.required = true;
    argument.many = true;
    return argument;
  }

  Argument& add_flag(const std::string& names, bool& target, std::string text) {
    return add(names, {}, std::move(text), {}, [&target](const std::string&) { target = true; });
  }

  /// One of the enumerators, by their names. `target`: an enumerator, or an optional one.
  template <class Target, class All>
  Argument& add_choice(const std::string& names, Target& target, const All& all, std::string text) {
    std::vector<std::string> choices;
    std::string first;
    for (const auto one : all) {
      choices.emplace_back(name(one));
      if constexpr (!is_optional<Target>)
        if (one == target) first = choices.back();
    }
    const std::vector values(std::begin(all), std::end(all));
    return add(names, choice(std::move(choices)), std::move(text), first,
               [&target, values](const std::string& given) {
                 for (const auto one : values)
                   if (name(one) == given) target = one;
               });
  }

 private:
  template <class T>
  static constexpr bool is_optional = requires(T value) {
    value.has_value();
  };

  Argument& add(const std::string& names, Value value, std::string text, std::string standard,
                std::function<void(const std::string&)> set);

  CommandTable& command_;
};

}  // namespace tactile_net::tool
