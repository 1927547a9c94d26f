// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of options by their names.
#include "engine/settings/named_labels.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "engine/settings/number_text.h"
#include "engine/settings/size_text.h"
#include "io/file/errors.h"
#include "io/file/text_numbers.h"

namespace mw::engine {
namespace {

constexpr std::size_t kMaxListed = 8;

bool begins_like_a_number(std::string_view text) {
  return !text.empty() && std::string_view("0123456789+-.").find(text[0]) != text.npos;
}

bool is_name(std::string_view token) {
  double number = 0;
  return !token.empty() && token != "*" && !token.starts_with('@') && !names_image(token) &&
         !(begins_like_a_number(token) && read_number(token, number));
}

/// Returns where the part of the text that begins at `at` ends.  Names in quotes, which may follow
/// '|', can have separators in them.
std::size_t end_of(std::string_view text, std::size_t at) {
  const bool is_file = text[at] == '@';
  const std::string_view separators = is_file ? "," : ",;=";
  bool may_quote = !is_file;
  for (; at < text.size(); ++at) {
    if (may_quote && text[at] == '"') at = std::min(text.find('"', at + 1), text.size() - 1);
    if (separators.find(text[at]) != separators.npos) return at;
    may_quote = !is_file && (text[at] == '|' || (may_quote && text[at] == ' '));
  }
  return at;
}

/// Returns the text with what `number` returns in the place of each name.
std::string replaced(std::string_view text,
                     const std::function<std::string(std::string_view)>& number) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end = end_of(text, at);
    const std::string_view token = io::trimmed(text.substr(at, end - at));
    out += is_name(token) ? number(token) : std::string(text.substr(at, end - at));
    if (end < text.size()) out += text[end];
    at = end;
  }
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kMaxListed); ++i) {
    out += (i == 0 ? "" : ", ") + names[i];
  }
  return out + (names.size() > kMaxListed ? ", ..." : "");
}

[[noreturn]] void refuse_unknown(const std::string& name, const io::LabelNames& names) {
  std::vector<std::string> known;
  for (const io::LabelName& row : names.rows()) {
    if (!row.name.empty()) known.push_back(row.name);
  }
  if (known.empty()) {
    io::fail_usage("no label has a name, and so none is called '" + name +
                   "'; give numbers, or give labels names (--names)");
  }
  const std::vector<std::string> near = near_words(name, known);
  const char* const which = near.empty() ? "; names are " : "; near it: ";
  io::fail_usage("no label is called '" + name + "'" + which + listed(near.empty() ? known : near));
}

std::string number_text(RawLabel label, bool is_signed) {
  return is_signed ? io::text(static_cast<std::int64_t>(label)) : io::text(label);
}

[[noreturn]] void refuse_several(const std::string& name, const std::vector<RawLabel>& found,
                                 bool is_signed) {
  std::vector<std::string> numbers;
  for (const RawLabel label : found) numbers.push_back(number_text(label, is_signed));
  io::fail_usage("labels " + listed(numbers) + " are called '" + name + "'; give the number");
}

bool is_same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Returns the labels of just that name; if there are none, those that differ in capitals alone.
std::vector<RawLabel> labels_called(const std::string& name, const io::LabelNames& names) {
  std::vector<RawLabel> exact, alike;
  for (const io::LabelName& row : names.rows()) {
    if (row.name.empty()) continue;
    if (row.name == name) exact.push_back(row.label);
    if (std::ranges::equal(row.name, name, is_same_letter)) alike.push_back(row.label);
  }
  return exact.empty() ? alike : exact;
}

bool is_quoted(std::string_view token) {
  return token.size() >= 2 && token.starts_with('"') && token.find('"', 1) == token.size() - 1;
}

/// Returns where the '|' of a pair is, behind a first name that may be in quotes.
std::size_t bar_of(std::string_view token) {
  return token.find('|', token.starts_with('"') ? std::min(token.find('"', 1), token.size()) : 0);
}

std::string name_in(std::string_view token) {
  return io::clean_name(is_quoted(token) ? token.substr(1, token.size() - 2) : token);
}

/// Returns the label of that name; is_signed says how messages write numbers.
RawLabel label_called(std::string_view token, const io::LabelNames& names, bool is_signed) {
  const std::string name = name_in(token);
  const std::vector<RawLabel> found = labels_called(name, names);
  if (found.empty()) refuse_unknown(name, names);
  if (found.size() > 1) refuse_several(name, found, is_signed);
  return found.front();
}

/// Returns text that parse_label() reads, with a sign where the number has one.
std::string number_of(std::string_view text, const io::LabelNames& names) {
  const std::string_view token = io::trimmed(text);
  if (token == "*") return "*";  // in "A|*"
  const bool is_known = !labels_called(name_in(token), names).empty();
  const std::size_t bar = bar_of(token);
  if (!is_known && !is_quoted(token) && bar != token.npos) {
    return number_of(token.substr(0, bar), names) + "|" + number_of(token.substr(bar + 1), names);
  }
  if (!is_known && begins_like_a_number(token)) return std::string(token);
  return number_text(label_called(token, names, true), true);
}

bool is_whole_number(std::string_view text) {
  const std::size_t sign = text.starts_with('-') ? 1 : 0;
  return text.size() > sign && text.find_first_not_of("0123456789", sign) == text.npos;
}

}  // namespace

RawLabel find_label(std::string_view text, const io::LabelNames& names, bool is_signed) {
  const std::string_view token = io::trimmed(text);
  if (!is_whole_number(token)) return label_called(token, names, is_signed);
  const RawLabel label = parse_label(token);
  const bool is_high = label >> 63U != 0;
  if (!is_high || is_signed == token.starts_with('-')) return label;
  io::fail_usage("label ", token, ": labels are ",
                 is_signed ? "signed, below 2^63" : "not negative");
}

bool has_names(std::string_view text) {
  bool any = false;
  (void)replaced(text, [&](std::string_view) {
    any = true;
    return "";
  });
  return any;
}

void check_sizes(std::string_view text) {
  bool follows_equals = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end = end_of(text, at);
    const std::string_view token = text.substr(at, end - at);
    const bool ends_with_equals = end < text.size() && text[end] == '=';
    // A file may have "=" in its name.
    if (follows_equals && !ends_with_equals && !names_image(token)) (void)parse_size(token);
    follows_equals = ends_with_equals;
    at = end;
  }
  if (follows_equals) (void)parse_size("");  // the text ends with "="
}

std::string with_numbers(std::string_view text, const io::LabelNames& names) {
  return replaced(text, [&](std::string_view token) { return number_of(token, names); });
}

}  // namespace mw::engine
