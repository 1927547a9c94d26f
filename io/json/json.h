// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// JSON values, and their texts.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace mw::io {

class Place;

/// Null, a boolean, a number, a text, an array or an object, whose fields stay in the order in
/// which they came.  No header includes the JSON library that parses and writes texts, since it is
/// slow to compile.
/// ERRORS: std::bad_variant_access where a value is not of the kind that is asked for.
class Json {
 public:
  struct Field;
  struct Part;
  using Array = std::vector<Json>;
  using Object = std::vector<Field>;

  Json();
  Json(std::nullptr_t);
  template <std::same_as<bool> T>
  Json(T value) : Json(Value(value)) {}
  template <std::signed_integral T>
  Json(T value) : Json(Value(std::int64_t{value})) {}
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) Json(T value) : Json(Value(std::uint64_t{value})) {}
  /// Infinities and NaN are written as null.
  Json(double value);
  Json(const char* text);
  Json(std::string_view text);
  Json(std::string text);
  /// Makes an array of the elements of any container.
  template <typename T>
  requires(!std::convertible_to<T, std::string_view>) && requires(const T& t) { t.begin(); }
  Json(const T& values) : Json(Array(values.begin(), values.end())) {}
  Json(Array elements);
  Json(Object fields);
  /// {{"key", value}, ...} is an object; any other list is an array.
  Json(std::initializer_list<Part> parts);

  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();

  [[nodiscard]] static Json array();
  [[nodiscard]] static Json object();

  [[nodiscard]] bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  [[nodiscard]] bool is_boolean() const { return std::holds_alternative<bool>(value_); }
  [[nodiscard]] bool is_string() const { return std::holds_alternative<std::string>(value_); }
  [[nodiscard]] bool is_array() const { return std::holds_alternative<Array>(value_); }
  [[nodiscard]] bool is_object() const { return std::holds_alternative<Object>(value_); }
  [[nodiscard]] bool is_structured() const { return is_array() || is_object(); }
  /// True for a number that is whole, not negative, and written as such.
  [[nodiscard]] bool is_unsigned() const { return std::holds_alternative<std::uint64_t>(value_); }
  [[nodiscard]] bool is_float() const { return std::holds_alternative<double>(value_); }
  [[nodiscard]] bool is_integer() const;
  [[nodiscard]] bool is_number() const { return is_integer() || is_float(); }
  /// True for null, and for an array or object that has no elements.
  [[nodiscard]] bool empty() const;

  [[nodiscard]] bool boolean() const { return std::get<bool>(value_); }
  [[nodiscard]] const std::string& text() const { return std::get<std::string>(value_); }
  /// Returns the value of an integer; a negative one in two's complement.
  [[nodiscard]] std::uint64_t integer() const;
  /// Returns the value of any number.
  [[nodiscard]] double number() const;
  [[nodiscard]] const Array& elements() const { return std::get<Array>(value_); }
  [[nodiscard]] const Object& items() const { return std::get<Object>(value_); }
  [[nodiscard]] Object& items() { return std::get<Object>(value_); }
  [[nodiscard]] bool contains(std::string_view key) const { return find(key) != nullptr; }
  /// Returns the value of an object's key; nullptr if the object does not have it.
  [[nodiscard]] const Json* find(std::string_view key) const;
  /// Returns the value of an object's key.  ERRORS: std::out_of_range if it does not have it.
  [[nodiscard]] const Json& operator[](std::string_view key) const;
  [[nodiscard]] friend bool operator==(const Json& json, std::string_view text) {
    return json.is_string() && json.text() == text;
  }

  /// Returns the field, which is null if it is new.  A null becomes an object.
  [[nodiscard]] Json& operator[](std::string_view key);
  /// Adds an element to an array.  A null becomes an array.
  void push_back(Json element);
  /// Adds the fields of another object; they replace those with the same keys.
  void update(Json other);
  void erase(std::string_view key);

  /// Return the text on one line, on lines with indents of two, and on one line in ASCII.  Bytes
  /// that are no UTF-8 become U+FFFD.
  [[nodiscard]] std::string dump() const;
  [[nodiscard]] std::string dump_indented() const;
  [[nodiscard]] std::string dump_ascii() const;

 private:
  using Value = std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string,
                             Array, Object>;
  explicit Json(Value value);

  Value value_;
};

struct Json::Field {
  std::string key;
  Json value;
};

/// A value on its way into an array or object, which can be moved out although lists are const.
struct Json::Part {
  template <typename T>
  requires std::constructible_from<Json, T&&> Part(T&& from) : value(std::forward<T>(from)) {}
  Part(std::initializer_list<Part> parts) : value(parts) {}

  mutable Json value;
};

/// The largest document that is read.  Reading one takes up to 40 times its text.
inline constexpr std::uint64_t kMaxJsonBytes = 4ULL << 20U;
/// The deepest nesting that is read.
inline constexpr int kMaxJsonDepth = 64;

/// Parses a text.  Fields are in the order of their keys; of several with one key the last counts.
/// ERRORS: mw::Error(kInput) naming `file` and the place in it when the text is no JSON, or nested
/// deeper than kMaxJsonDepth.
[[nodiscard]] Json parse_json(std::string_view text, std::string_view file);

/// Reads and parses a file of at most `most` bytes.  ERRORS: those of parse_json; kInput when the
/// file is missing or larger; kResource when a server does not answer.
[[nodiscard]] Json read_json(const Place& place, std::uint64_t most = kMaxJsonBytes);

}  // namespace mw::io
