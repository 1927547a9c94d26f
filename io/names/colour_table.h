// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tables with a label a line and numbers between blanks (ITK-SNAP, FreeSurfer, 3D Slicer), and the
// numbers in the text of all tables of names.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/names/label_names.h"
#include "kernels/core/label.h"

namespace mw::io {

/// A whole number from -2^63 to 2^64-1, two's complement; also with ".0" behind it, as tables of
/// floats have it.
[[nodiscard]] std::optional<RawLabel> label_of(std::string_view text);
/// Finite.
[[nodiscard]] std::optional<double> number_of(std::string_view text);
/// A whole number from 0 to 255.
[[nodiscard]] std::optional<std::uint8_t> byte_of(std::string_view text);
/// From 0 to 255, of a number from 0 to 1.
[[nodiscard]] std::optional<std::uint8_t> byte_of_share(double share);

/// ERRORS: mw::Error(kInput), always: "FILE: line LINE: REASON; ...".
[[noreturn]] void fail_line(std::string_view file, std::size_t line, std::string_view reason,
                            std::string_view way_out);

/// A row of a table, and where it stands.
struct ReadName {
  LabelName name;
  std::size_t line = 0;
};

/// ERRORS: mw::Error(kInput) when a label, or a name that is not empty, is there twice: the line of
///         the second says where the first is.
[[nodiscard]] LabelNames names_of_rows(const std::vector<ReadName>& rows, std::string_view file);

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
