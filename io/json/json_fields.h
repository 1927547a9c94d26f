// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Fields of a JSON object with the types that a format demands.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/json/json.h"

namespace mw::io {

/// Reads the fields of an object in a document; both must outlive it.
/// ERRORS (all members but has): mw::Error(kInput) naming file and field, "scales[0].size", when
/// the field is missing or of another type.
class JsonFields {
 public:
  /// where is the name of the object in errors; it is empty for the whole document.
  JsonFields(const Json& object, std::string file, std::string where = {});

  [[nodiscard]] const std::string& file() const { return file_; }
  /// Returns the name of a field in errors.
  [[nodiscard]] std::string name_of(std::string_view key) const;
  /// True if the field is there, and not null.
  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool is_array(std::string_view key) const;

  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
  [[nodiscard]] bool flag(std::string_view key) const;
  /// Returns a whole number, which may be written as 1.0 and must fit into 64 signed bits.
  [[nodiscard]] std::int64_t integer(std::string_view key) const;
  [[nodiscard]] std::vector<std::int64_t> integers(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  /// Return the three numbers of an array.
  [[nodiscard]] std::array<std::int64_t, 3> integers3(std::string_view key) const;
  [[nodiscard]] std::array<double, 3> numbers3(std::string_view key) const;

  [[nodiscard]] JsonFields object(std::string_view key) const;
  /// Return the length of an array of objects, and one of them.  REQUIRES: index < count(key).
  [[nodiscard]] std::size_t count(std::string_view key) const;
  [[nodiscard]] JsonFields element(std::string_view key, std::size_t index) const;
  /// Returns the first element of an array of arrays of three numbers.
  [[nodiscard]] std::array<std::int64_t, 3> first_integers3(std::string_view key) const;

  /// Throws mw::Error(kInput) about the field.
  [[noreturn]] void fail(std::string_view key, std::string_view reason,
                         std::string_view way_out = {}) const;

 private:
  [[nodiscard]] const Json& at(std::string_view key) const;
  [[nodiscard]] const Json::Array& array_at(std::string_view key) const;
  [[nodiscard]] std::vector<std::int64_t> integers_in(const Json& array,
                                                      std::string_view name) const;
  [[nodiscard]] std::array<std::int64_t, 3> integers3_in(const Json& array,
                                                         std::string_view name) const;
  [[noreturn]] void fail_type(std::string_view name, std::string_view wanted,
                              const Json& found) const;

  const Json* object_;
  std::string file_;
  std::string where_;
};

}  // namespace mw::io
