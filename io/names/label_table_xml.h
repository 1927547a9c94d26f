// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The label table of Connectome Workbench, as it stands in the header of NIfTI files.
#pragma once

#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// The first <LabelTable> of an XML text: <Label Key="1" Red=".." Green=".." Blue=".." Alpha="..">
/// with the name inside, colours from 0 to 1.  Nothing where the text is no such XML; a label with
/// a damaged key or colour has none.
[[nodiscard]] LabelNames parse_label_table(std::string_view xml);

}  // namespace mw::io
