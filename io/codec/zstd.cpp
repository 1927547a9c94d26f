// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Unpacks and packs Zstandard.
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <new>

#include "io/codec/codec.h"
#include "io/codec/stream.h"
#include "io/file/errors.h"

namespace mw::io {
namespace {

/// The most bytes that a block of Zstandard holds; it takes 4 packed bytes or more.
constexpr std::size_t kBlockBytes = std::size_t{128} << 10U;

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

class ZstdDecoder : public StreamDecoder {
 public:
  explicit ZstdDecoder(const PackedName& name) : name_(name), context_(ZSTD_createDCtx()) {
    constexpr int kWindowBits = std::countr_zero(kMaxZstdWindow);
    if (!context_) fail_no_memory(name);
    ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, kWindowBits);
  }

  [[nodiscard]] Step step(std::span<const std::byte> packed, std::span<std::byte> out) override {
    ZSTD_inBuffer from{packed.data(), packed.size(), 0};
    ZSTD_outBuffer to{out.data(), out.size(), 0};
    const std::size_t verdict = ZSTD_decompressStream(context_.get(), &to, &from);
    const bool failed = ZSTD_isError(verdict) != 0;
    if (failed) refuse_large(ZSTD_getErrorCode(verdict));
    return {.taken = from.pos,
            .given = to.pos,
            .ended = verdict == 0,
            .wrong = failed ? ZSTD_getErrorName(verdict) : nullptr};
  }
  void restart() override {}  // the library does so by itself

 private:
  void refuse_large(ZSTD_ErrorCode code) const {
    if (code == ZSTD_error_memory_allocation) fail_no_memory(name_);
    if (code != ZSTD_error_frameParameter_windowTooLarge) return;
    throw Error(ErrorKind::kResource,
                text(name_.file, ": zstd: looks back more than ", kMaxZstdWindow,
                     " bytes, too far for a chunk of this size; give more --memory, or pack it at "
                     "level 19 or below"));
  }

  PackedName name_;
  std::unique_ptr<ZSTD_DCtx, FreeContext> context_;
};

}  // namespace

// Unpacks at once into place: a stream would take a window as large as the frame claims.
std::vector<std::byte> unpack_zstd(std::span<const std::byte> packed, std::size_t max,
                                   std::string_view name) {
  const PackedName named{"zstd", name};
  // To make a context costs more than to unpack a small chunk.
  thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
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

std::unique_ptr<StreamDecoder> zstd_decoder(const PackedName& name) {
  return std::make_unique<ZstdDecoder>(name);
}

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
