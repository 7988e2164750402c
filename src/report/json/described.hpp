/// @file
/// Private. From a type's fields its JSON and the schema of that JSON: what a value may be follows
/// from its type. A type with another shape has a specialization of `JsonForm`. Fields of the other
/// sensor are left out: a schema that is of both allows the one set of keys or the other.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "report/json/document.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net::report {

/// How values of a type stand in JSON, `json(value)`, and what may stand there, `schema()`. Both
/// may have a further parameter: which sensor the values are of.
template <class T>
struct JsonForm;

/// @param of  the sensor whose fields are told; both: every field
template <class T>
[[nodiscard]] Json as_json(const T& value, Of of = Of::both) {
  if constexpr (requires { JsonForm<T>::json(value, of); })
    return JsonForm<T>::json(value, of);
  else
    return JsonForm<T>::json(value);
}

template <class T>
[[nodiscard]] Json schema_of(Of of = Of::both) {
  if constexpr (requires { JsonForm<T>::schema(of); })
    return JsonForm<T>::schema(of);
  else
    return JsonForm<T>::schema();
}

template <>
struct JsonForm<bool> {
  static Json json(bool value) { return value; }
  static Json schema() { return {{"type", "boolean"}}; }
};

template <std::unsigned_integral T>
struct JsonForm<T> {
  static Json json(T value) { return value; }
  static Json schema() { return {{"type", "integer"}, {"minimum", 0}}; }
};

/// Of one that may be infinite, or none, the field's value is an optional one: `if_finite`.
template <>
struct JsonForm<double> {
  static Json json(double value) { return value; }
  static Json schema() { return {{"type", "number"}}; }
};

template <std::convertible_to<std::string_view> T>
struct JsonForm<T> {
  static Json json(std::string_view value) { return value; }
  static Json schema() { return {{"type", "string"}}; }
};

template <class T>
struct JsonForm<std::optional<T>> {
  static Json json(const std::optional<T>& value, Of of) {
    return value ? as_json(*value, of) : Json(nullptr);
  }
  static Json schema(Of of) {
    Json schema = schema_of<T>(of);
    if (schema.contains("type"))
      schema["type"] = {schema["type"], "null"};
    else
      schema = {{"anyOf", {schema, {{"type", "null"}}}}};
    return schema;
  }
};

template <class T>
struct JsonForm<std::vector<T>> {
  static Json json(const std::vector<T>& values, Of of) {
    Json list = Json::array();
    for (const T& one : values) list.push_back(as_json(one, of));
    return list;
  }
  static Json schema(Of of) { return {{"type", "array"}, {"items", schema_of<T>(of)}}; }
};

template <class T, std::size_t size>
struct JsonForm<std::array<T, size>> {
  static Json json(const std::array<T, size>& values, Of of) {
    return as_json(std::vector<T>(values.begin(), values.end()), of);
  }
  static Json schema(Of of) {
    Json schema = schema_of<std::vector<T>>(of);
    schema["minItems"] = schema["maxItems"] = size;
    return schema;
  }
};

template <class T>
[[nodiscard]] std::optional<std::vector<T>> unless_empty(const std::vector<T>& values) {
  return values.empty() ? std::nullopt : std::optional(values);
}

/// An object whose keys are the document's own: names of channels, of effects.
template <class T>
struct JsonForm<std::vector<std::pair<std::string, T>>> {
  static Json json(const std::vector<std::pair<std::string, T>>& values, Of of) {
    Json json = Json::object();
    for (const auto& [key, value] : values) json[key] = as_json(value, of);
    return json;
  }
  static Json schema(Of of) {
    return {{"type", "object"}, {"additionalProperties", schema_of<T>(of)}};
  }
};

/// Row by row.
template <>
struct JsonForm<Matrix> {
  static Json json(const Matrix& matrix) { return matrix_json(matrix); }
  static Json schema() { return schema_of<std::vector<std::vector<double>>>(); }
};

/// By the names of its enumerators, a sentence each.
template <class Enum>
requires std::is_enum_v<Enum>
struct JsonForm<Enum> {
  static Json json(Enum value) { return enumerator_name(value); }
  static Json schema() {
    Json values = Json::array();
    for (const auto& row : Enumerators<Enum>::all)
      values.push_back({{"const", row.name}, {"description", row.text}});
    return {{"oneOf", values}};
  }
};

/// Whoever has it leaves its key out where there is none.
template <class T>
struct JsonForm<IfAny<T>> : JsonForm<T> {};

template <class T>
inline constexpr bool is_if_any = false;
template <class T>
inline constexpr bool is_if_any<IfAny<T>> = true;

/// Whether what is told of a type is not the same of lines and of skins.
template <Described T>
inline constexpr bool differs =
    std::apply([](const auto&... one) { return ((one.of != Of::both) || ...); }, Fields<T>::all);

[[nodiscard]] constexpr bool is_told(Of field, Of of) noexcept {
  return field == Of::both || of == Of::both || field == of;
}

/// Puts the fields of `value` at the end of an object.
template <Described T>
void add_fields(Json& json, const T& value, Of of = Of::both) {
  for_each_field<T>([&](const auto& one) {
    if (!is_told(one.of, of)) return;
    const auto& found = std::invoke(one.access, value);
    if constexpr (!is_if_any<std::remove_cvref_t<decltype(found)>>)
      json[one.key] = as_json(found, of);
    else if (found.value)
      json[one.key] = as_json(*found.value, of);
  });
}

template <Described T>
[[nodiscard]] Json fields_json(const T& value, Of of = Of::both) {
  Json json = Json::object();
  add_fields(json, value, of);
  return json;
}

/// Puts the fields' schemas at the end of an object's properties.
template <Described T>
void describe_fields(Json& properties, Json& required, Of of) {
  for_each_field<T>([&]<class Access>(const Field<Access>& one) {
    if (!is_told(one.of, of)) return;
    using Value = FieldValue<T, Access>;
    Json schema = schema_of<Value>(of);
    schema["description"] = one.text;
    if (one.measure != Measure::none) schema["unit"] = unit_symbol(one.measure);
    properties[one.key] = std::move(schema);
    if constexpr (!is_if_any<Value>) required.push_back(one.key);
  });
}

/// An object that has these properties, every one, and then the fields of each type.
template <Described... T>
[[nodiscard]] Json object_schema(Json properties = Json::object(), Of of = Of::both) {
  if constexpr ((differs<T> || ...))
    if (of == Of::both) {
      Json one_of = Json::array();
      for (const Of which : {Of::lines, Of::skins})
        one_of.push_back(object_schema<T...>(properties, which));
      return Json{{"oneOf", std::move(one_of)}};
    }
  Json required = Json::array();
  for (const auto& [key, schema] : properties.items()) required.push_back(key);
  (describe_fields<T>(properties, required, of), ...);
  return {{"type", "object"},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

template <Described T>
struct JsonForm<T> {
  static Json json(const T& value, Of of) { return fields_json(value, of); }
  static Json schema(Of of) { return object_schema<T>(Json::object(), of); }
};

/// A document: how each begins, then the fields of each value that the sensor has.
template <Described... T>
[[nodiscard]] std::string document_text(const DocumentKind& kind, Of of, const T&... values) {
  Json json = document(kind);
  (add_fields(json, values, of), ...);
  return text_of(json, 2);
}
template <Described... T>
[[nodiscard]] std::string document_text(const DocumentKind& kind, const T&... values) {
  return document_text(kind, Of::both, values...);
}

/// How the schema of each begins. @param title  what the document is, in a line
[[nodiscard]] inline Json schema_head(std::string_view title) {
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
}

/// The object that a document is.
template <Described... T>
[[nodiscard]] Json document_object(const DocumentKind& kind) {
  return object_schema<T...>(
      {{"tactile_net", {{"type", "string"}, {"description", "The version that wrote it."}}},
       {"kind", {{"const", kind.name}}},
       {"schema", {{"const", kind.schema}}}});
}

/// A document's schema.
template <Described... T>
[[nodiscard]] Json document_schema(const DocumentKind& kind, std::string_view title) {
  Json schema = schema_head(title);
  schema.update(document_object<T...>(kind));
  return schema;
}

}  // namespace tactile_net::report
