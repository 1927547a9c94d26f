// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How all codecs word what is wrong with packed bytes.
#include "io/codec/damage.h"

#include "io/file/errors.h"

namespace mw::io {

void fail_packed(const PackedName& name, std::string_view reason) {
  fail_input(name.file, name.codec, reason, "get a whole copy of the store");
}

void fail_too_much(const PackedName& name, std::size_t max) {
  fail_packed(name, text("unpacks to more than the ", max, " bytes that it should hold"));
}

void fail_no_memory(const PackedName& name) {
  throw Error(ErrorKind::kResource, text(name.file, ": ", name.codec, ": no memory to unpack it"));
}

}  // namespace mw::io
