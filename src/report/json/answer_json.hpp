/// @file
/// Private. The enumerations of an answer as JSON: by their names, with a sentence each where they
/// have one.
#pragma once

#include "report/json/described.hpp"
#include "tactile_net/lab/answer_fields.hpp"
#include "tactile_net/report/words/data_words.hpp"
#include "tactile_net/report/words/verdict_words.hpp"

namespace tactile_net::report {

/// @tparam last  enumerator
template <class Enum, Enum last>
struct NamesForm {
  static Json json(Enum value) { return name(value); }
  static Json schema() {
    Json values = Json::array();
    for (std::size_t i = 0; i <= static_cast<std::size_t>(last); ++i) {
      const auto value = static_cast<Enum>(i);
      Json one = {{"const", name(value)}};
      if constexpr (requires { in_words(value); }) one["description"] = in_words(value);
      values.push_back(std::move(one));
    }
    return {{"oneOf", values}};
  }
};

template <>
struct JsonForm<lab::Verdict> : NamesForm<lab::Verdict, lab::Verdict::doubted> {};
template <>
struct JsonForm<DataDoubt> : NamesForm<DataDoubt, DataDoubt::friction_limit> {};
template <>
struct JsonForm<lab::Condition::Kind>
    : NamesForm<lab::Condition::Kind, lab::Condition::Kind::noise_gain> {};
template <>
struct JsonForm<lab::Condition::Matrix>
    : NamesForm<lab::Condition::Matrix, lab::Condition::Matrix::normal> {};

}  // namespace tactile_net::report
