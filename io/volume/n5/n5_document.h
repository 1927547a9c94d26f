// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// An attributes.json, and where it is from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/json/json.h"
#include "io/json/json_fields.h"

namespace mw::io {

struct N5Document {
  Json json;
  std::string file;

  /// Looks at json, which must outlive it.  ERRORS: mw::Error(kInput) when that is no object.
  [[nodiscard]] JsonFields fields() const { return {json, file}; }
};

/// The attributes of a folder; empty: it has none.
/// ERRORS: mw::Error(kInput) when the file cannot be read or is no JSON.
[[nodiscard]] std::optional<N5Document> read_attributes(const std::filesystem::path& folder);

}  // namespace mw::io
