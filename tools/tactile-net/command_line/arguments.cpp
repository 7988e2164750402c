#include "command_line/arguments.hpp"

#include <sstream>
#include <stdexcept>

#include "tactile_net/numeric/number_text.hpp"

namespace tactile_net::tool {

Value text(std::string name) { return {.kind = Value::Kind::text, .name = std::move(name)}; }

Value number() { return text("NUMBER"); }

Value file(std::string name, std::vector<std::string> endings) {
  return {.kind = Value::Kind::file, .name = std::move(name), .endings = std::move(endings)};
}

Value output_file(std::vector<std::string> endings) {
  Value value = file("FILE", std::move(endings));
  value.is_output = true;
  return value;
}

Value main_output(std::vector<std::string> endings) {
  Value value = output_file(std::move(endings));
  value.is_standard_output = true;
  return value;
}

Value folder() { return {.kind = Value::Kind::folder, .name = "FOLDER"}; }

Value choice(std::vector<std::string> choices) {
  return {.kind = Value::Kind::choice, .choices = std::move(choices)};
}

void read(const std::string& text, std::string& value) { value = text; }

void read(const std::string& text, double& value) {
  if (!read_number(text, value)) throw std::invalid_argument("'" + text + "' is not a number");
}

void read(const std::string& text, std::size_t& value) {
  const auto number = whole_number(text);
  if (!number) throw std::invalid_argument("'" + text + "' is not a whole number from 0");
  value = *number;
}

void read(const std::string& text, Share& value) {
  const std::size_t sign = text.find_last_not_of("% ") + 1;
  const std::string ending = text.substr(sign);
  const bool percent = ending == "%" || ending == " %";
  if ((!percent && !ending.empty()) || !read_number(text.substr(0, sign), value.value))
    throw std::invalid_argument("'" + text + "' is not a share, such as 0.3% or 0.003");
  if (percent) value.value /= 100.0;
}

std::string standard(const std::string& value) { return value; }

std::string standard(double value) { return shortest(value); }

Argument& Arguments::add(const std::string& names, Value value, std::string text,
                         std::string standard, std::function<void(const std::string&)> set) {
  Argument argument{.value = std::move(value),
                    .text = std::move(text),
                    .standard = std::move(standard),
                    .set = std::move(set)};
  std::istringstream parts(names);
  for (std::string one; std::getline(parts, one, ',');) argument.names.push_back(one);
  command_.arguments.push_back(std::move(argument));
  return command_.arguments.back();
}

}  // namespace tactile_net::tool
