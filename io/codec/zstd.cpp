// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks Zstandard by libzstd.
#include "io/codec/unpackers.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <memory>

#include "io/codec/damage.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

/// A block holds at most that, and takes 4 bytes or more.
constexpr std::size_t kBlockBytes = std::size_t{128} << 10U;

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

}  // namespace

// At once into its place, not as a stream: a stream's window is as large as the frame claims.
std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                   std::string_view name) {
  const PackedName named{"zstd", name};
  const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  if (!context) fail_no_memory(named);
  std::vector<std::byte> out(std::min(max, (packed.size() / 4 + 1) * kBlockBytes));
  const std::size_t count =
      ZSTD_decompressDCtx(context.get(), out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(count) != 0) {
    const ZSTD_ErrorCode code = ZSTD_getErrorCode(count);
    if (code == ZSTD_error_dstSize_tooSmall) fail_too_much(named, max);
    if (code == ZSTD_error_memory_allocation) fail_no_memory(named);
    fail_packed(named, text("damaged or truncated (", ZSTD_getErrorName(count), ")"));
  }
  out.resize(count);
  return out;
}

}  // namespace mw::io
