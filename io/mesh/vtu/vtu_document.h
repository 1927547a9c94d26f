// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The XML of a .vtu file, and its arrays as numbers.
#pragma once

#include <pugixml.hpp>
#include <string>

#include "io/file/byte_source.h"
#include "io/mesh/vtu/data_array.h"

namespace mw::io {

/// Arrays may be appended (raw or base64) or inline (ascii or base64), packed with zlib or not.
class VtuDocument {
 public:
  /// ERRORS of all: mw::Error(kInput) naming file and place.
  explicit VtuDocument(const ByteSource& source);

  [[nodiscard]] pugi::xml_node grid() const;
  [[nodiscard]] const std::string& file() const { return source_.name(); }
  /// REQUIRES: array is a DataArray of the document.
  [[nodiscard]] std::vector<std::uint64_t> integers(pugi::xml_node array, std::uint64_t count);
  [[nodiscard]] std::vector<double> reals(pugi::xml_node array, std::uint64_t count);
  /// REQUIRES: array is an Array of strings, each with a NUL behind it.  At most 64 MiB of them.
  [[nodiscard]] std::vector<std::string> strings(pugi::xml_node array);

 private:
  void find_appended(std::string& head);
  void parse(std::string head);
  [[nodiscard]] std::unique_ptr<ByteStream> stream_of(pugi::xml_node array, const ArrayName& name);
  [[nodiscard]] std::vector<std::byte> bytes_of(pugi::xml_node array, NumberType type,
                                                std::uint64_t count, const ArrayName& name);
  [[nodiscard]] std::string characters(pugi::xml_node array, const ArrayName& name);
  [[nodiscard]] std::string_view appended_text();

  const ByteSource& source_;
  pugi::xml_document xml_;
  VtkEncoding encoding_;
  bool appended_ = false;
  bool appended_raw_ = false;
  std::uint64_t appended_start_ = 0;  ///< behind the '_'
  std::string appended_text_;         ///< base64 appended data, read when first needed
};

}  // namespace mw::io
