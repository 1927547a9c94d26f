// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
#include "io/codec/pack_zstd.h"

#include <zstd.h>

#include <new>

namespace mw::io {

ZstdPacker::ZstdPacker(int level) : context_(ZSTD_createCCtx()), level_(level) {
  if (context_ == nullptr) throw std::bad_alloc();
}

ZstdPacker::~ZstdPacker() {
  ZSTD_freeCCtx(context_);
}

void ZstdPacker::append(std::span<const std::byte> bytes, std::vector<std::byte>& out) {
  const std::size_t before = out.size();
  out.resize(before + ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compressCCtx(context_, out.data() + before, out.size() - before,
                                             bytes.data(), bytes.size(), level_);
  if (ZSTD_isError(size) != 0) throw std::bad_alloc();
  out.resize(before + size);
}

}  // namespace mw::io
