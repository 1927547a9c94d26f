// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A VTK XML file (.vtu, .vtp, .pvtu, .vti), and its arrays as numbers or by their place.
#pragma once

#include <pugixml.hpp>
#include <string>

#include "io/file/source/byte_source.h"
#include "io/vtk_xml/data_array.h"

namespace mw::io {

struct VtkHead;

/// What a VTKFile must be.
struct VtkKind {
  const char* type;     ///< the value of its attribute type, and the name of its first element
  const char* way_out;  ///< what errors say when it is of another type
  /// Contents of inline arrays stay in the file, so that memory does not grow with them: arrays are
  /// found by content_of(), and their numbers and strings are not read.
  bool leaves_contents = false;
};

/// Where the content of an array is in its file.
struct VtkContent {
  enum class Form { kText, kBase64, kRaw };
  Form form = Form::kText;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< of an inline array; the largest number for one that is appended
};

/// Arrays may be appended (raw or base64) or inline (ascii or base64), packed with zlib, LZ4 or xz,
/// or not.
class VtkDocument {
 public:
  /// ERRORS (all members): mw::Error(kInput) naming file and place.
  VtkDocument(const ByteSource& source, VtkKind kind);

  [[nodiscard]] pugi::xml_node grid() const;
  /// Returns the attribute as a whole number; the fallback, if given, when there is no attribute.
  [[nodiscard]] std::uint64_t number(pugi::xml_node node, const char* attribute,
                                     std::optional<std::uint64_t> fallback = {}) const;
  [[nodiscard]] const std::string& file() const { return source_.name(); }
  [[nodiscard]] const VtkEncoding& encoding() const { return encoding_; }
  /// Returns where the content of an array begins.  REQUIRES: array is a DataArray of the document,
  /// whose kind leaves contents.
  [[nodiscard]] VtkContent content_of(pugi::xml_node array) const;
  /// Return the `count` numbers of an array.  REQUIRES: array is a DataArray of the document.
  [[nodiscard]] std::vector<std::uint64_t> integers(pugi::xml_node array, std::uint64_t count);
  [[nodiscard]] std::vector<double> reals(pugi::xml_node array, std::uint64_t count);
  /// Returns strings, of at most 64 MiB if they are binary.
  /// REQUIRES: array is an Array of strings, or a DataArray of bytes; a NUL ends each string.
  [[nodiscard]] std::vector<std::string> strings(pugi::xml_node array);

 private:
  void find_appended(VtkHead& head);
  [[nodiscard]] std::uint64_t appended_place(pugi::xml_node array, const ArrayName& name) const;
  void parse(std::string head);
  [[nodiscard]] std::unique_ptr<ByteStream> stream_of(pugi::xml_node array, const ArrayName& name);
  [[nodiscard]] std::vector<std::byte> bytes_of(pugi::xml_node array, NumberType type,
                                                std::uint64_t count, const ArrayName& name);
  [[nodiscard]] std::string characters(pugi::xml_node array, const ArrayName& name);
  [[nodiscard]] std::string_view appended_text();

  const ByteSource& source_;
  VtkKind kind_;
  pugi::xml_document xml_;
  VtkEncoding encoding_;
  bool appended_ = false;
  bool appended_raw_ = false;
  std::uint64_t appended_start_ = 0;  ///< behind the '_'
  std::string appended_text_;         ///< base64 appended data, read when first needed
};

}  // namespace mw::io
