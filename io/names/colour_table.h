// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tables that have one label a line and numbers between blanks (ITK-SNAP, FreeSurfer, 3D Slicer),
// and the numbers in the text of all tables of names.
// Format: http://www.itksnap.org/docs/fullmanual.php
// Format: https://surfer.nmr.mgh.harvard.edu/fswiki/LabelsClutsAnnotationFiles
// Format: https://slicer.readthedocs.io/en/latest/user_guide/modules/colors.html
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/names/label_names.h"
#include "kernels/core/label.h"

namespace mw::io {

/// Returns a whole number from -2^63 to 2^64-1 in two's complement; ".0" may follow it, as in
/// tables of floats.  This and the next ones return nothing for another text.
[[nodiscard]] std::optional<RawLabel> label_of(std::string_view text);
/// Returns a finite number.
[[nodiscard]] std::optional<double> number_of(std::string_view text);
/// Returns a whole number from 0 to 255.
[[nodiscard]] std::optional<std::uint8_t> byte_of(std::string_view text);
/// Returns a number from 0 to 1 as one from 0 to 255; nothing for another number.
[[nodiscard]] std::optional<std::uint8_t> byte_of_share(double share);

/// Throws mw::Error(kInput): "FILE: line LINE: REASON; WAY_OUT".
[[noreturn]] void fail_line(std::string_view file, std::size_t line, std::string_view reason,
                            std::string_view way_out);

/// A row of a table, and the line where it stands.
struct ReadName {
  LabelName name;
  std::size_t line = 0;
};

/// Returns the names of rows.
/// ERRORS: mw::Error(kInput) when a label, or a name that is not empty, is there twice, naming the
///         lines of both.
[[nodiscard]] LabelNames names_of_rows(const std::vector<ReadName>& rows, std::string_view file);

/// Whether a line is one of these:
///   IDX R G B A VIS MSH "NAME"   label descriptions of ITK-SNAP; A from 0 to 1
///   ID NAME R G B A              colour tables of FreeSurfer and Slicer (.ctbl); A may be missing,
///                                and FreeSurfer 8 has the class of a tissue behind some
///   ID NAME CODE                 tables of the AAL atlas; CODE, a number, is skipped
///   ID NAME                      tables without colours
/// Only with all four numbers may NAME have blanks in it.
[[nodiscard]] bool is_colour_table_line(std::string_view line);

/// Skips lines that are empty or begin with '#' or "//".  A is the opacity in a table of 3D Slicer,
/// which has the ending .ctbl or the comment "# Color table file" in front of its rows.  In any
/// other table where more than half of the labels but 0 have an A of 0 it is the transparency, as
/// FreeSurfer has it, and else the opacity.
/// ERRORS: mw::Error(kInput) naming file and line.
[[nodiscard]] LabelNames parse_colour_table(std::string_view text, std::string_view file);

/// Whether a line of such a table, or of one in CSV, is empty or a comment.
[[nodiscard]] bool is_comment_line(std::string_view line);

}  // namespace mw::io
