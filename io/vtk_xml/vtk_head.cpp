// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Reads the text of a VTK XML file, with or without the contents of its arrays.
#include "io/vtk_xml/vtk_head.h"

#include <algorithm>
#include <string_view>

#include "io/file/errors.h"

namespace mw::io {
namespace {

constexpr std::string_view kAppendedTag = "<AppendedData";
constexpr std::string_view kArrayTag = "<DataArray";
constexpr std::string_view kRootTag = "<VTKFile";
constexpr std::uint64_t kReadBytes = 1 << 20;
constexpr std::uint64_t kTagBytes = 4096;
constexpr std::uint64_t kMaxTagBytes = 64 << 20;

void check_root(const std::string& begin, const ByteSource& source) {
  if (begin.find(kRootTag) != std::string::npos) return;
  fail_input(source.name(), "XML", "no VTKFile begins here", "give a VTK XML file");
}

/// Copies the text, tag by tag, and notes contents of arrays in their place.
class Outline {
 public:
  explicit Outline(const ByteSource& source) : cursor_(source) {}

  VtkHead read() {
    while (!head_.tag && cursor_.peek() >= 0) {
      if (cursor_.peek() == '<') {
        copy_tag();
      } else {
        copy();
      }
    }
    return std::move(head_);
  }

 private:
  void copy() {
    if (head_.xml.size() > kMaxTagBytes) {
      fail_input(cursor_.source().name(), "XML", "more than 64 MiB of tags",
                 "the file is damaged or no image");
    }
    head_.xml += static_cast<char>(cursor_.peek());
    cursor_.take();
  }

  void copy_tag() {
    const std::size_t first = head_.xml.size();
    const std::uint64_t offset = cursor_.offset();
    copy_to_end_of_tag(first);
    const std::string_view tag = std::string_view(head_.xml).substr(first);
    if (tag.starts_with(kAppendedTag)) {
      head_.tag = first;
      head_.tag_in_file = offset;
    } else if (tag.starts_with(kArrayTag) && !tag.ends_with("/>")) {
      skip_content();
    }
  }

  /// A '>' in an attribute, or in a comment, ends nothing.
  void copy_to_end_of_tag(std::size_t first) {
    constexpr std::string_view kComment = "<!--", kCommentEnd = "-->";
    char quote = '\0';
    while (cursor_.peek() >= 0) {
      const auto c = static_cast<char>(cursor_.peek());
      copy();
      const std::string_view tag = std::string_view(head_.xml).substr(first);
      const bool is_comment = tag.starts_with(kComment);
      if (is_comment ? tag.size() > kComment.size() + 1 && tag.ends_with(kCommentEnd)
                     : c == '>' && quote == '\0') {
        return;
      }
      if (c == quote) {
        quote = '\0';
      } else if (quote == '\0' && (c == '"' || c == '\'')) {
        quote = c;
      }
    }
  }

  void skip_content() {
    const std::uint64_t begin = cursor_.offset();
    while (cursor_.peek() >= 0 && cursor_.peek() != '<') cursor_.take();
    head_.xml += text(begin, " ", cursor_.offset());
  }

  ByteCursor cursor_;
  VtkHead head_;
};

}  // namespace

void fail_too_much_text(const std::string& file, std::string_view field) {
  fail_input(file, field, text("more than ", kMaxVtkTextBytes, " bytes of text"),
             "save the arrays as binary data: appended, raw");
}

bool append_text(const ByteSource& source, std::uint64_t start, std::uint64_t count,
                 std::string& text) {
  const std::size_t before = text.size();
  const std::uint64_t from = start + before;
  text.resize(before + (source.size_within(from + count) - from));
  source.read_at(from, std::as_writable_bytes(std::span(text)).subspan(before));
  return text.size() > before;
}

VtkHead read_head(const ByteSource& source) {
  VtkHead head;
  std::string& xml = head.xml;
  std::size_t found = std::string::npos;
  while (found == std::string::npos) {
    const std::size_t before = xml.size();
    if (before > kMaxVtkTextBytes) fail_too_much_text(source.name(), "XML");
    if (!append_text(source, 0, kReadBytes, xml)) break;
    if (before == 0) check_root(xml, source);
    found = xml.find(kAppendedTag, before - std::min(before, kAppendedTag.size()));
  }
  if (found == std::string::npos) return head;
  // The chunk may have cut the start tag.
  static_cast<void>(append_text(source, 0, kTagBytes, xml));
  head.tag = head.tag_in_file = found;
  xml.resize(std::min(xml.find('>', found), xml.size() - 1) + 1);
  return head;
}

VtkHead read_outline(const ByteSource& source) {
  std::string begin;
  static_cast<void>(append_text(source, 0, kReadBytes, begin));
  check_root(begin, source);
  return Outline(source).read();
}

}  // namespace mw::io
