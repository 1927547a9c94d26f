// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of options and arguments by their numbers or their names: one rule for all.
#pragma once

#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::engine {

// The rule: a number is that label, even if another label is called so.  Other text is a name and
// stands for the label whose name is written the same, or else for the one whose name differs in
// capitals alone.  Text in double quotes is always a name.  Blanks at the ends do not count.

/// Returns the label that a text stands for, such as "7", "-1" or "Lesion".  is_signed tells
/// whether the labels may be negative, in two's complement.
/// ERRORS: mw::Error(kUsage) for a number that none of them can be, for a name that no label has,
///         with those that are near to it, and for a name that several have.
[[nodiscard]] RawLabel find_label(std::string_view text, const io::LabelNames& names,
                                  bool is_signed);

/// Returns whether some label in the text of an option, such as "1,Lesion=3", is not a number.
[[nodiscard]] bool has_names(std::string_view text);

/// Checks the text of sizes, such as "Lesion=3,*=5", before labels are looked up, so that a size
/// which is no number is not taken for a name.  A size is what follows the last "=" of a part.
/// ERRORS: those of parse_size().
void check_sizes(std::string_view text);

/// Returns the text of an option with numbers in the place of names.  What is between commas,
/// semicolons and equals signs is a label, unless it is a number of any kind, "*", or a file:
/// "@FILE", or an image of sizes by its ending.  A name that has one of these signs in it stands in
/// double quotes.  In "A|B" both sides are labels or "*", unless one label is called so.  What
/// begins like a number and is no name stays as it is, for the option to refuse. ERRORS: those of
/// find_label() for names.
[[nodiscard]] std::string with_numbers(std::string_view text, const io::LabelNames& names);

}  // namespace mw::engine
