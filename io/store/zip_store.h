// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A ZIP archive as a store of chunks.
#pragma once

#include <memory>

#include "io/file/source/byte_source.h"
#include "io/store/place.h"

namespace mw::io {

/// Returns the place of an archive, in which "PATH.zip/a/b" is the file a/b.  Files that are stored
/// are read in place, also in parts; files that are deflated are unpacked whole, above 4 MiB to an
/// unlinked temporary file, and their CRC-32 is checked.
/// ERRORS: mw::Error(kInput) naming the archive where its directory is damaged; as they are read,
/// naming the file, where it is packed in another way or encrypted.
[[nodiscard]] Place zip_place(std::shared_ptr<const ByteSource> archive);

}  // namespace mw::io
