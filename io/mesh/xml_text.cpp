// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Text in XML, out and in.
#include "io/mesh/xml_text.h"

#include <new>

#include "io/file/errors.h"

namespace mw::io {
namespace {

/// What is no XML is known by that, however much it is.
bool begins_with_tag(const ByteSource& source) {
  constexpr std::size_t kMaxBlanks = 4096;
  const std::vector<std::byte> head = read_prefix(source, kMaxBlanks);
  const std::string_view start(reinterpret_cast<const char*>(head.data()), head.size());
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != start.npos && start[first] == '<';
}

}  // namespace

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

void parse_xml(const ByteSource& source, std::uint64_t max_bytes, pugi::xml_document& document) {
  if (!begins_with_tag(source)) {
    fail_input(source.name(), {}, "is no XML: it does not begin with a tag", "give another file");
  }
  const std::optional<std::string> content = read_whole(source, max_bytes);
  if (!content) {
    fail_input(source.name(), {}, text("more than ", max_bytes, " bytes of XML"));
  }
  const pugi::xml_parse_result result = document.load_buffer(content->data(), content->size());
  if (result) return;
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  fail_input(source.name(), text("byte ", std::to_string(result.offset)),
             text("no well-formed XML (", result.description(), ")"),
             "the file is truncated or damaged: write it anew");
}

}  // namespace mw::io
