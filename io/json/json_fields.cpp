// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Finds fields of a JSON object and checks their types.
#include "io/json/json_fields.h"

#include <cmath>
#include <optional>

#include "io/file/errors.h"

namespace mw::io {
namespace {

/// Returns what an error quotes of a value.
std::string quoted(const Json& value) {
  constexpr std::size_t kMax = 60;
  if (value.is_structured()) return value.is_array() ? "an array" : "an object";
  std::string out = value.dump_ascii();
  if (out.size() > kMax) out = out.substr(0, kMax) + "...";
  return out;
}

std::optional<std::int64_t> whole(const Json& value) {
  if (value.is_unsigned()) {
    const std::uint64_t number = value.integer();
    if (number > static_cast<std::uint64_t>(INT64_MAX)) return std::nullopt;
    return static_cast<std::int64_t>(number);
  }
  if (value.is_integer()) return static_cast<std::int64_t>(value.integer());
  if (!value.is_float()) return std::nullopt;
  const double number = value.number();
  if (!(number >= -0x1p63 && number < 0x1p63) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::int64_t>(number);
}

}  // namespace

JsonFields::JsonFields(const Json& object, std::string file, std::string where)
    : object_(&object), file_(std::move(file)), where_(std::move(where)) {
  if (object.is_object()) return;
  fail_input(file_, where_.empty() ? "JSON" : where_, quoted(object) + " is no JSON object");
}

std::string JsonFields::name_of(std::string_view key) const {
  return where_.empty() ? std::string(key) : mw::io::text(where_, ".", key);
}

bool JsonFields::has(std::string_view key) const {
  const Json* found = object_->find(key);
  return found != nullptr && !found->is_null();
}

bool JsonFields::is_array(std::string_view key) const {
  return at(key).is_array();
}

const Json& JsonFields::at(std::string_view key) const {
  const Json* found = object_->find(key);
  if (found == nullptr) fail(key, "the field is missing", "get a whole copy of the file");
  return *found;
}

const Json::Array& JsonFields::array_at(std::string_view key) const {
  const Json& value = at(key);
  if (!value.is_array()) fail_type(name_of(key), "an array", value);
  return value.elements();
}

std::string JsonFields::text(std::string_view key) const {
  const Json& value = at(key);
  if (!value.is_string()) fail_type(name_of(key), "a text", value);
  return value.text();
}

std::vector<std::string> JsonFields::texts(std::string_view key) const {
  std::vector<std::string> out;
  for (const Json& value : array_at(key)) {
    if (!value.is_string()) fail_type(name_of(key), "an array of texts", value);
    out.push_back(value.text());
  }
  return out;
}

bool JsonFields::flag(std::string_view key) const {
  const Json& value = at(key);
  if (!value.is_boolean()) fail_type(name_of(key), "true or false", value);
  return value.boolean();
}

std::int64_t JsonFields::integer(std::string_view key) const {
  const Json& value = at(key);
  const auto number = whole(value);
  if (!number) fail_type(name_of(key), "a whole number", value);
  return *number;
}

std::vector<std::int64_t> JsonFields::integers(std::string_view key) const {
  return integers_in(at(key), name_of(key));
}

double JsonFields::number(std::string_view key) const {
  const Json& value = at(key);
  if (!value.is_number()) fail_type(name_of(key), "a number", value);
  return value.number();
}

std::vector<double> JsonFields::numbers(std::string_view key) const {
  std::vector<double> out;
  for (const Json& value : array_at(key)) {
    if (!value.is_number()) fail_type(name_of(key), "an array of numbers", value);
    out.push_back(value.number());
  }
  return out;
}

std::array<std::int64_t, 3> JsonFields::integers3(std::string_view key) const {
  return integers3_in(array_at(key), name_of(key));
}

std::array<double, 3> JsonFields::numbers3(std::string_view key) const {
  const std::vector<double> all = numbers(key);
  if (all.size() != 3) fail(key, mw::io::text("has ", all.size(), " numbers instead of 3"));
  return {all[0], all[1], all[2]};
}

JsonFields JsonFields::object(std::string_view key) const {
  return {at(key), file_, name_of(key)};
}

std::size_t JsonFields::count(std::string_view key) const {
  return array_at(key).size();
}

JsonFields JsonFields::element(std::string_view key, std::size_t index) const {
  return {array_at(key)[index], file_, mw::io::text(name_of(key), "[", index, "]")};
}

std::array<std::int64_t, 3> JsonFields::first_integers3(std::string_view key) const {
  const Json::Array& values = array_at(key);
  if (values.empty()) fail(key, "the array is empty");
  return integers3_in(values[0], name_of(key) + "[0]");
}

std::vector<std::int64_t> JsonFields::integers_in(const Json& array, std::string_view name) const {
  if (!array.is_array()) fail_type(name, "an array", array);
  std::vector<std::int64_t> out;
  for (const Json& value : array.elements()) {
    const auto number = whole(value);
    if (!number) fail_type(name, "an array of whole numbers", value);
    out.push_back(*number);
  }
  return out;
}

std::array<std::int64_t, 3> JsonFields::integers3_in(const Json& array,
                                                     std::string_view name) const {
  const std::vector<std::int64_t> all = integers_in(array, name);
  if (all.size() != 3) {
    fail_input(file_, name, mw::io::text("has ", all.size(), " numbers instead of 3"));
  }
  return {all[0], all[1], all[2]};
}

void JsonFields::fail(std::string_view key, std::string_view reason,
                      std::string_view way_out) const {
  fail_input(file_, name_of(key), reason, way_out);
}

void JsonFields::fail_type(std::string_view name, std::string_view wanted,
                           const Json& found) const {
  fail_input(file_, name, mw::io::text(quoted(found), " where ", wanted, " is wanted"),
             "the file is damaged or not of this format");
}

}  // namespace mw::io
