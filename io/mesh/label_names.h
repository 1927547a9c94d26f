// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which cell array of another tool's file is the label.
#pragma once

#include <string>
#include <vector>

namespace mw::io {

/// Among the names of integer cell arrays: `label`, else `Label`, `labels`, `material` or
/// `medit:ref`, else the only one, else null.
[[nodiscard]] const std::string* choose_label(const std::vector<std::string>& names);

}  // namespace mw::io
