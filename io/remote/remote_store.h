// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A store of chunks on a web server.
#pragma once

#include <string_view>

#include "io/remote/disk_cache.h"
#include "io/remote/http_client.h"
#include "io/store/place.h"

namespace mw::io {

/// The place of an address (io/remote/address.h).  Nothing is asked of the server yet.
/// A file that was read in parts and has another version later is an error: kInput.
/// Memory: 4 MiB of a body are held, the rest is in a file without a name in $TMPDIR or /tmp.
/// cache: where chunks and parts of files are kept for later runs; null: nowhere.  Documents that
/// tell of a store are asked for in each run; what was kept when they were others does not count,
/// and all else is taken as it was kept.  Files that are not there are asked for again.
/// ERRORS: mw::Error(kUsage) for an address that is none; those of DiskCache.
[[nodiscard]] Place remote_place(std::string_view address, const CacheFolder* cache = nullptr,
                                 const HttpLimits& limits = {});

}  // namespace mw::io
