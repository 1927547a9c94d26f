// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Text in XML, out and in.
#include "io/mesh/xml_text.h"

#include <new>

#include "io/file/errors.h"

namespace mw::io {

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

void parse_xml(const ByteSource& source, std::uint64_t most_bytes, pugi::xml_document& document) {
  if (source.size() > most_bytes) {
    fail_input(source.name(), {}, text("more than ", most_bytes, " bytes of XML"));
  }
  std::string content(source.size(), '\0');
  source.read_at(0, std::as_writable_bytes(std::span(content)));
  const pugi::xml_parse_result result = document.load_buffer(content.data(), content.size());
  if (result) return;
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  fail_input(source.name(), text("byte ", std::to_string(result.offset)),
             text("no well-formed XML (", result.description(), ")"),
             "the file is truncated or damaged: write it anew");
}

}  // namespace mw::io
