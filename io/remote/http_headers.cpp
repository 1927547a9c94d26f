// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/remote/http_headers.h"

#include <algorithm>
#include <charconv>

#include "io/file/text_numbers.h"

namespace mw::io {
namespace {

bool is_same_letters(std::string_view a, std::string_view b) {
  return lower_case(a) == lower_case(b);
}

/// Takes a number off the front of text; false when there is none.
bool take_number(std::string_view& text, std::uint64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_letter(std::string_view& text, char letter) {
  if (text.empty() || text.front() != letter) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<ContentRange> parse_content_range(std::string_view text) {
  constexpr std::string_view kUnit = "bytes ";
  if (!text.starts_with(kUnit)) return std::nullopt;
  text.remove_prefix(kUnit.size());
  ContentRange out;
  const bool is_whole = take_number(text, out.first) && take_letter(text, '-') &&
                        take_number(text, out.last) && take_letter(text, '/') &&
                        take_number(text, out.file_bytes) && text.empty();
  const bool is_sound = out.first <= out.last && out.last < out.file_bytes;
  return is_whole && is_sound ? std::optional(out) : std::nullopt;
}

void HttpHeaders::add(std::string_view line) {
  if (line.starts_with("HTTP/")) {
    *this = {};
    has_frames = !line.starts_with("HTTP/1");
    const std::size_t blank = std::min(line.find(' '), line.size() - 1);
    std::from_chars(line.data() + blank + 1, line.data() + line.size(), status);
    return;
  }
  const std::size_t colon = line.find(':');
  if (colon == line.npos) return;
  const std::string_view name = line.substr(0, colon);
  const std::string value(trimmed(line.substr(colon + 1)));
  if (is_same_letters(name, "content-range")) content_range = value;
  if (is_same_letters(name, "content-encoding")) content_encoding = value;
  if (is_same_letters(name, "content-length")) content_length = value;
  if (is_same_letters(name, "transfer-encoding")) transfer_encoding = value;
  if (is_same_letters(name, "etag")) etag = value;
  if (is_same_letters(name, "last-modified")) last_modified = value;
}

std::string HttpHeaders::version() const {
  return etag.empty() || etag.starts_with("W/") ? last_modified : etag;
}

bool HttpHeaders::has_end() const {
  return has_frames || !content_length.empty() || is_same_letters(transfer_encoding, "chunked");
}

bool HttpHeaders::is_packed() const {
  return !content_encoding.empty() && !is_same_letters(content_encoding, "identity");
}

}  // namespace mw::io
