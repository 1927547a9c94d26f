// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Holds JSON values; a library parses and writes texts.
#include "io/json/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/file/errors.h"
#include "io/store/place.h"

namespace mw::io {
namespace {

using Library = nlohmann::json;

/// Returns what is neither array nor object.  Only such values of the library's are made here: its
/// arrays and objects ask for memory when they are destroyed, and end the program where it is out.
Library plain_value(const Json& value) {
  if (value.is_boolean()) return value.boolean();
  if (value.is_string()) return value.text();
  if (value.is_unsigned()) return value.integer();
  if (value.is_integer()) return static_cast<std::int64_t>(value.integer());
  if (value.is_float()) return value.number();
  return nullptr;
}

/// Writes values, with lines for elements that are indented by two, or without any space.
class Writer {
 public:
  Writer(bool indents, bool ascii) : indents_(indents), ascii_(ascii) {}
  [[nodiscard]] std::string text(const Json& value) {
    write(value, 0);
    return std::move(out_);
  }

 private:
  void write(const Json& value, std::size_t depth) {
    if (value.is_object()) {
      write_rows(value.items(), "{}", depth, [&](const Json::Field& field) {
        write(field.key, 0);
        out_ += indents_ ? ": " : ":";
        write(field.value, depth + 1);
      });
    } else if (value.is_array()) {
      write_rows(value.elements(), "[]", depth,
                 [&](const Json& element) { write(element, depth + 1); });
    } else {
      out_ += plain_value(value).dump(-1, ' ', ascii_, Library::error_handler_t::replace);
    }
  }
  template <class Rows, class Write>
  void write_rows(const Rows& rows, std::string_view brackets, std::size_t depth,
                  const Write& write_row) {
    out_ += brackets[0];
    for (const auto& row : rows) {
      if (&row != rows.data()) out_ += ',';
      begin_line(depth + 1);
      write_row(row);
    }
    if (!rows.empty()) begin_line(depth);
    out_ += brackets[1];
  }
  void begin_line(std::size_t depth) {
    if (indents_) out_.append(1, '\n').append(2 * depth, ' ');
  }

  bool indents_;
  bool ascii_;
  std::string out_;
};

/// Returns the library's message without the name and number in front, "[json.exception...] ".
std::string_view reason_of(const Library::exception& error) {
  const std::string_view what = error.what();
  const std::size_t end = what.find("] ");
  return end == what.npos ? what : what.substr(end + 2);
}

/// Takes what the library reads of a text, piece by piece, and makes a value of it; see
/// plain_value().
class Builder : public nlohmann::json_sax<Library> {
 public:
  explicit Builder(std::string_view file) : file_(file) {}
  [[nodiscard]] Json&& value() { return std::move(value_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(std::int64_t value) override { return add(value); }
  bool number_unsigned(std::uint64_t value) override { return add(value); }
  bool number_float(double value, const std::string& /*text*/) override { return add(value); }
  bool string(std::string& text) override { return add(std::move(text)); }
  bool binary(Library::binary_t& /*bytes*/) override { return false; }
  bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
  bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
  bool end_array() override { return close(); }
  bool key(std::string& text) override {
    check_depth();
    keys_.push_back(std::move(text));
    return true;
  }
  /// Fields are sorted by key; of several of one key the last counts.
  bool end_object() override {
    Json::Object& fields = open_.back().items();
    std::ranges::stable_sort(fields, {}, &Json::Field::key);
    const auto same = [](const Json::Field& one, const Json::Field& other) {
      return one.key == other.key;
    };
    const auto rest = std::unique(fields.rbegin(), fields.rend(), same);
    fields.erase(fields.begin(), rest.base());
    return close();
  }
  bool parse_error(std::size_t /*at*/, const std::string& /*token*/,
                   const Library::exception& error) override {
    fail_input(file_, "JSON", reason_of(error), "the file is damaged or not JSON");
  }

 private:
  void check_depth() const {
    if (open_.size() <= kMaxJsonDepth) return;
    fail_input(file_, "JSON", mw::io::text("nested deeper than ", kMaxJsonDepth, " levels"),
               "the file is damaged");
  }
  bool open(Json empty) {
    check_depth();
    open_.push_back(std::move(empty));
    return true;
  }
  bool close() {
    Json whole = std::move(open_.back());
    open_.pop_back();
    put(std::move(whole));
    return true;
  }
  bool add(Json value) {
    check_depth();
    put(std::move(value));
    return true;
  }
  void put(Json value) {
    if (open_.empty()) {
      value_ = std::move(value);
    } else if (open_.back().is_array()) {
      open_.back().push_back(std::move(value));
    } else {
      open_.back().items().push_back({std::move(keys_.back()), std::move(value)});
      keys_.pop_back();
    }
  }

  std::string_view file_;
  std::vector<Json> open_;         ///< arrays and objects that have not ended
  std::vector<std::string> keys_;  ///< of the fields whose values are not there yet
  Json value_;
};

}  // namespace

Json::Json() = default;
Json::Json(std::nullptr_t) {}
Json::Json(double value) : value_(value) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string_view text) : value_(std::string(text)) {}
Json::Json(std::string text) : value_(std::move(text)) {}
Json::Json(Array elements) : value_(std::move(elements)) {}
Json::Json(Object fields) : value_(std::move(fields)) {}
Json::Json(Value value) : value_(std::move(value)) {}

Json::Json(std::initializer_list<Part> parts) {
  const bool is_object = std::all_of(parts.begin(), parts.end(), [](const Part& part) {
    const Array* pair = std::get_if<Array>(&part.value.value_);
    return pair != nullptr && pair->size() == 2 && pair->front().is_string();
  });
  value_ = is_object ? Value(Object()) : Value(Array());
  for (const Part& part : parts) {
    if (!is_object) {
      push_back(std::move(part.value));
      continue;
    }
    Array& pair = std::get<Array>(part.value.value_);
    (*this)[pair[0].text()] = std::move(pair[1]);
  }
}

Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json Json::array() {
  return Array();
}

Json Json::object() {
  return Object();
}

bool Json::is_integer() const {
  return is_unsigned() || std::holds_alternative<std::int64_t>(value_);
}

bool Json::empty() const {
  if (is_array()) return elements().empty();
  return is_object() ? items().empty() : is_null();
}

std::uint64_t Json::integer() const {
  if (is_unsigned()) return std::get<std::uint64_t>(value_);
  return static_cast<std::uint64_t>(std::get<std::int64_t>(value_));
}

double Json::number() const {
  if (is_float()) return std::get<double>(value_);
  if (is_unsigned()) return static_cast<double>(integer());
  return static_cast<double>(std::get<std::int64_t>(value_));
}

const Json* Json::find(std::string_view key) const {
  const auto found = std::find_if(items().begin(), items().end(),
                                  [&](const Field& field) { return field.key == key; });
  return found == items().end() ? nullptr : &found->value;
}

const Json& Json::operator[](std::string_view key) const {
  const Json* found = find(key);
  if (found == nullptr) throw std::out_of_range(mw::io::text("no field ", key));
  return *found;
}

Json& Json::operator[](std::string_view key) {
  if (is_null()) value_ = Object();
  for (Field& field : items()) {
    if (field.key == key) return field.value;
  }
  items().push_back({std::string(key), nullptr});
  return items().back().value;
}

void Json::push_back(Json element) {
  if (is_null()) value_ = Array();
  std::get<Array>(value_).push_back(std::move(element));
}

void Json::update(Json other) {
  for (Field& field : other.items()) {
    (*this)[field.key] = std::move(field.value);
  }
}

void Json::erase(std::string_view key) {
  std::erase_if(items(), [&](const Field& field) { return field.key == key; });
}

std::string Json::dump() const {
  return Writer(false, false).text(*this);
}

std::string Json::dump_indented() const {
  return Writer(true, false).text(*this);
}

std::string Json::dump_ascii() const {
  return Writer(false, true).text(*this);
}

Json parse_json(std::string_view text, std::string_view file) {
  Builder builder(file);
  Library::sax_parse(text, &builder);
  return builder.value();
}

Json read_json(const Place& place, std::uint64_t most) {
  const auto source = place.open_if_there(most);
  if (!source)
    fail_input(place.string(), {}, "cannot open: there is no such file", "check the path");
  const std::optional<std::string> content = read_whole(*source, most);
  if (!content) {
    fail_input(source->name(), "JSON",
               text("the file has ", source->size(), " bytes, and at most ", most,
                    " are read of a description"),
               "check that it is the store's own");
  }
  return parse_json(*content, source->name());
}

}  // namespace mw::io
