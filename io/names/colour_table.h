// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tables with a label a line and numbers between blanks: ITK-SNAP, FreeSurfer, 3D Slicer.
#pragma once

#include <string_view>

#include "io/names/label_names.h"

namespace mw::io {

/// Whether a line is one of these:
///   IDX R G B A VIS MSH "NAME"   label descriptions of ITK-SNAP; A from 0 to 1
///   ID NAME R G B A              colour tables of FreeSurfer and Slicer (.ctbl); A may be missing
///   ID NAME CODE                 as of the AAL atlas; CODE is skipped
///   ID NAME                      the same without colours
/// Only with all four numbers may NAME have blanks in it.
[[nodiscard]] bool is_colour_table_line(std::string_view line);

/// Lines that are empty or begin with '#' or "//" are skipped.  FreeSurfer counts A the other way
/// round, and has 0 everywhere: in a table without any other A labels are opaque.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] LabelNames parse_colour_table(std::string_view text, std::string_view file);

/// Whether a line of such a table, or of a table in CSV, is no row.
[[nodiscard]] bool is_comment_line(std::string_view line);

}  // namespace mw::io
