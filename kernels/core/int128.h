// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Whole numbers of 128 bits: sums of exact volumes need some 80.
#pragma once

namespace mw {

__extension__ using Int128 = __int128;

}  // namespace mw
