// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A store of chunks on a web server.
#pragma once

#include <string_view>

#include "io/remote/disk_cache.h"
#include "io/remote/http_client.h"
#include "io/store/place.h"

namespace mw::io {

/// Returns the place of an address (io/remote/address.h), without asking the server for anything.
/// A file that was read in parts and has another version later is an error (kInput).
/// Memory: a body of up to 4 MiB; a larger one is in a file without a name in $TMPDIR or /tmp.
/// Chunks and parts of files are kept in cache for later runs, unless it is null.  Documents that
/// tell of a store are fetched in each run; answers that were kept when these were different are
/// not used, all others are.  Files that are not there are asked for again.
/// ERRORS: mw::Error(kUsage) for an address that is none; those of DiskCache.
[[nodiscard]] Place remote_place(std::string_view address, const CacheFolder* cache = nullptr,
                                 const HttpLimits& limits = {});

}  // namespace mw::io
