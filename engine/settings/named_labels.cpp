// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of options by their names.
#include "engine/settings/named_labels.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "engine/settings/near_words.h"
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
         !(begins_like_a_number(token) && read_all(token, number));
}

/// Where what begins there ends.
std::size_t end_of(std::string_view text, std::size_t at) {
  const char* const separators = text[at] == '@' ? "," : ",;=";
  if (text[at] == '"') at = std::min(text.find('"', at + 1), text.size());
  return std::min(text.find_first_of(separators, at), text.size());
}

/// The text, with what `number` says in the place of each name.
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

[[noreturn]] void refuse(const std::string& name, const io::LabelNames& names) {
  std::vector<std::string> known;
  for (const io::LabelName& row : names.rows()) {
    if (!row.name.empty()) known.push_back(row.name);
  }
  if (known.empty()) {
    throw Error(ErrorKind::kUsage, "no label has a name, and so none is called '" + name +
                                       "'; give numbers, or names with --names FILE");
  }
  const std::vector<std::string> near = near_words(name, known);
  const char* const which = near.empty() ? "; names are " : "; near it: ";
  throw Error(ErrorKind::kUsage,
              "no label is called '" + name + "'" + which + listed(near.empty() ? known : near));
}

std::vector<RawLabel> labels_called(const io::LabelNames& names,
                                    const std::function<bool(const std::string&)>& is_it) {
  std::vector<RawLabel> out;
  for (const io::LabelName& row : names.rows()) {
    if (is_it(row.name)) out.push_back(row.label);
  }
  return out;
}

bool is_same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Returns text that parse_label() reads, with a sign where the number has one.
std::string number_of(std::string_view token, const io::LabelNames& names) {
  const bool quoted = token.size() >= 2 && token.starts_with('"') && token.ends_with('"');
  const std::string name(quoted ? token.substr(1, token.size() - 2) : token);
  std::vector<RawLabel> found =
      labels_called(names, [&](const std::string& other) { return other == name; });
  if (found.empty()) {
    found = labels_called(names, [&](const std::string& other) {
      return std::equal(name.begin(), name.end(), other.begin(), other.end(), is_same_letter);
    });
  }
  if (const std::size_t bar = token.find('|'); found.empty() && !quoted && bar != token.npos) {
    return number_of(token.substr(0, bar), names) + "|" + number_of(token.substr(bar + 1), names);
  }
  if (found.empty() && begins_like_a_number(token)) return std::string(token);
  if (found.empty()) refuse(name, names);
  if (found.size() == 1) return io::text(static_cast<std::int64_t>(found[0]));
  throw Error(ErrorKind::kUsage, io::text("'", name, "' is what labels ", found[0], " and ",
                                          found[1], " are called; give the number"));
}

}  // namespace

bool has_names(std::string_view text) {
  bool any = false;
  (void)replaced(text, [&](std::string_view) {
    any = true;
    return "";
  });
  return any;
}

std::string with_numbers(std::string_view text, const io::LabelNames& names) {
  return replaced(text, [&](std::string_view token) { return number_of(token, names); });
}

}  // namespace mw::engine
