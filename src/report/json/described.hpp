/// @file
/// Private. From a type's fields its JSON and the schema of that JSON: what a value may be follows
/// from its type. A type with another shape has a specialization of `JsonForm`.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "numeric/named.hpp"
#include "report/json/document.hpp"
#include "tactile_net/numeric/fields.hpp"

namespace tactile_net::report {

/// How values of a type stand in JSON, `json(value)`, and what may stand there, `schema()`.
template <class T>
struct JsonForm;

template <class T>
[[nodiscard]] Json as_json(const T& value) {
  return JsonForm<T>::json(value);
}

template <class T>
[[nodiscard]] Json schema_of() {
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

/// Of one that may be infinite, or none, the field's value is an optional one: `finite`.
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
  static Json json(const std::optional<T>& value) {
    return value ? as_json(*value) : Json(nullptr);
  }
  static Json schema() {
    Json schema = schema_of<T>();
    if (schema.contains("type"))
      schema["type"] = {schema["type"], "null"};
    else
      schema = {{"anyOf", {schema, {{"type", "null"}}}}};
    return schema;
  }
};

template <class T>
struct JsonForm<std::vector<T>> {
  static Json json(const std::vector<T>& values) {
    Json list = Json::array();
    for (const T& one : values) list.push_back(as_json(one));
    return list;
  }
  static Json schema() { return {{"type", "array"}, {"items", schema_of<T>()}}; }
};

template <class T, std::size_t size>
struct JsonForm<std::array<T, size>> {
  static Json json(const std::array<T, size>& values) {
    return as_json(std::vector<T>(values.begin(), values.end()));
  }
  static Json schema() {
    Json schema = schema_of<std::vector<T>>();
    schema["minItems"] = schema["maxItems"] = size;
    return schema;
  }
};

/// By the names of its enumerators, a sentence each.
template <class Enum>
requires std::is_enum_v<Enum>
struct JsonForm<Enum> {
  static Json json(Enum value) { return name_in<Enumerators<Enum>::all>(value); }
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

template <Described T>
struct JsonForm<T> {
  static Json json(const T& value) {
    Json json = Json::object();
    add(json, value);
    return json;
  }
  static Json schema() { return schema_after(Json::object()); }

  /// Puts the fields of `value` at the end of an object.
  static void add(Json& json, const T& value) {
    for_each_field<T>([&](const auto& one) {
      const auto& found = std::invoke(one.access, value);
      if constexpr (!is_if_any<std::remove_cvref_t<decltype(found)>>)
        json[one.key] = as_json(found);
      else if (found.value)
        json[one.key] = as_json(*found.value);
    });
  }

  /// An object that has these properties, every one, and then the fields.
  static Json schema_after(Json properties) {
    Json required = Json::array();
    for (const auto& [key, schema] : properties.items()) required.push_back(key);
    for_each_field<T>([&]<class Access>(const Field<Access>& one) {
      using Value = FieldValue<T, Access>;
      Json schema = schema_of<Value>();
      schema["description"] = one.text;
      if (one.measure != Measure::none) schema["unit"] = unit_symbol(one.measure);
      properties[one.key] = std::move(schema);
      if constexpr (!is_if_any<Value>) required.push_back(one.key);
    });
    return {{"type", "object"},
            {"properties", properties},
            {"required", required},
            {"additionalProperties", false}};
  }
};

/// A document: how each begins, then the fields.
template <Described T>
[[nodiscard]] std::string document_text(const DocumentKind& kind, const T& value) {
  Json json = document(kind);
  JsonForm<T>::add(json, value);
  return text_of(json, 2);
}

/// Its schema. @param title  what the document is, in a line
template <Described T>
[[nodiscard]] Json document_schema(const DocumentKind& kind, std::string_view title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(JsonForm<T>::schema_after(
      {{"tactile_net", {{"type", "string"}, {"description", "The version that wrote it."}}},
       {"kind", {{"const", kind.name}}},
       {"schema", {{"const", kind.schema}}}}));
  return schema;
}

}  // namespace tactile_net::report
