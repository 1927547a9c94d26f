// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A store of chunks on a web server.
#pragma once

#include <string_view>

#include "io/remote/http_client.h"
#include "io/store/place.h"

namespace mw::io {

/// The place of an address (io/remote/address.h).  Nothing is asked of the server yet.
/// A file that was read in parts and has another version later is an error: kInput.
/// Memory: 4 MiB of a body are held, the rest is in a file without a name in $TMPDIR or /tmp.
/// ERRORS: mw::Error(kUsage) for an address that is none.
[[nodiscard]] Place remote_place(std::string_view address, const HttpLimits& limits = {});

}  // namespace mw::io
