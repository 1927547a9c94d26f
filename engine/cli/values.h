// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Values of options from text and back.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/report/figures.h"
#include "engine/settings/number_text.h"
#include "io/mesh/element.h"
#include "kernels/core/index.h"
#include "kernels/core/label.h"

namespace mw::cli {

using engine::format_number;
using engine::parse_integer;
using engine::parse_label;
using engine::parse_number;
using engine::parse_switch;
using report::format_bytes;
using report::format_fixed;
using report::format_label;

/// All of these take the whole text.  ERRORS: mw::Error(kUsage) saying what was expected.
[[nodiscard]] std::array<double, 3> parse_numbers(std::string_view text);  ///< "X,Y,Z"
[[nodiscard]] Index3 parse_shape(std::string_view text);                   ///< "X,Y,Z", each >= 1
[[nodiscard]] Box3 parse_box(std::string_view text);  ///< "X0,Y0,Z0,X1,Y1,Z1", half-open
[[nodiscard]] std::vector<RawLabel> parse_labels(std::string_view text);  ///< "1,2,5"
[[nodiscard]] io::Element parse_element(std::string_view text);           ///< "tet4", "tet10"
/// Bytes: "4096", "512M", "1.5G", "4GiB", "1gb"; K M G T alone or with iB are powers of 1024, with
/// B of 1000.  A fraction of a byte is left off.
[[nodiscard]] std::uint64_t parse_size(std::string_view text);

}  // namespace mw::cli
