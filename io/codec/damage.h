// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How all codecs word what is wrong with packed bytes.
#pragma once

#include <cstddef>
#include <string_view>

namespace mw::io {

/// What errors name: the codec and the file (or the chunk in it) that the packed bytes are from.
struct PackedName {
  std::string_view codec;
  std::string_view file;
};

/// Throws mw::Error(kInput): "FILE: CODEC: REASON; get a whole copy of the store".
[[noreturn]] void fail_packed(const PackedName& name, std::string_view reason);

/// The same for bytes that unpack to more than they may.
[[noreturn]] void fail_too_much(const PackedName& name, std::size_t max);

/// Throws mw::Error(kResource): the library could not get the memory that it works with.
[[noreturn]] void fail_no_memory(const PackedName& name);

}  // namespace mw::io
