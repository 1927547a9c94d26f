// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Labels of options by their names.
#pragma once

#include <string>
#include <string_view>

#include "io/names/label_names.h"

namespace mw::engine {

/// Whether some label in the text of an option, such as "1,Lesion=3", is not a number.
[[nodiscard]] bool has_names(std::string_view text);

/// The text with numbers in the place of names: what is between commas, semicolons and equals
/// signs, blanks around it left out, and is neither a number nor a file ("@FILE", or an image of
/// sizes) nor "*".  In "A|B" both sides are labels, unless one label is called so.  A name that has
/// such a sign in it stands in double quotes.  Capitals count only where names differ by nothing
/// else. What begins like a number and is no name stays as it is. ERRORS: mw::Error(kUsage) listing
/// names that are near to one that is unknown, and the labels
///         that share one.
[[nodiscard]] std::string with_numbers(std::string_view text, const io::LabelNames& names);

}  // namespace mw::engine
