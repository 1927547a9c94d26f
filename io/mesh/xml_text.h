// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Text in XML, out and in.
#pragma once

#include <pugixml.hpp>
#include <string>

#include "io/file/source/byte_source.h"

namespace mw::io {

/// The text as it stands in an attribute in double quotes, or in an element.
[[nodiscard]] std::string xml_escaped(std::string_view text);

/// Parses a file whole.
/// ERRORS: mw::Error(kInput) naming file and place when it is truncated, no XML, or larger than
/// max_bytes.
void parse_xml(const ByteSource& source, std::uint64_t max_bytes, pugi::xml_document& document);

}  // namespace mw::io
